//! How well the classes are cut: of each class the pixels that are missed and those that are falsely of it, against the truth.

use bevy_egui::egui;
use egui::text::{LayoutJob, TextFormat};

use crate::app::inspector::table::{Column, counts, figures, heading, row, words};
use crate::app::view::style::SMALL;
use crate::app::view::{colours, format};
use crate::vision::{ColourClass, Quality};

const CLASSES: [Column; 6] = [
    words("class", 84.0, "Click one to teach it"),
    figures("recall", 48.0, "Share of the pixels of this class that are taken for it, %"),
    figures("precision", 62.0, "Share of the pixels taken for this class that are of it, %"),
    counts("missed", 52.0, "Pixels of this class that are not taken for it"),
    counts("false", 46.0, "Pixels taken for this class that are not of it"),
    counts("found", 46.0, "Pixels taken for this class"),
];

/// Shows a row for each class; a click on one chooses it.
pub fn show(ui: &mut egui::Ui, quality: &Quality, chosen: &mut ColourClass) {
    heading(ui, &CLASSES);
    for class in ColourClass::ALL {
        let of = quality.class(class);
        let cells: [egui::WidgetText; CLASSES.len()] = [
            named(class).into(),
            percent(of.recall()).into(),
            percent(of.precision()).into(),
            of.missed.to_string().into(),
            of.false_alarms.to_string().into(),
            (of.hits + of.false_alarms).to_string().into(),
        ];
        let shown = row(ui, &CLASSES, cells);
        if *chosen == class {
            let bar = shown.rect.with_max_x(shown.rect.left() - 2.0).with_min_x(shown.rect.left() - 5.0);
            ui.painter().rect_filled(bar, 1.0, colours::egui(colours::PILOT));
        }
        if shown.interact(egui::Sense::click()).clicked() {
            *chosen = class;
        }
    }
}

/// The name of a class after a square in its colour.
pub fn named(class: ColourClass) -> LayoutJob {
    let mut job = LayoutJob::default();
    let mut append = |text: &str, colour| {
        job.append(text, 0.0, TextFormat::simple(egui::FontId::proportional(SMALL), colours::egui(colour)));
    };
    append("■ ", colours::class(class));
    append(&class.to_string(), colours::TEXT);
    job
}

fn percent(share: Option<f32>) -> String {
    share.map_or(format::UNKNOWN.into(), |share| format::fixed(100.0 * share, 1))
}
