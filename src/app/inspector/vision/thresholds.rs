//! The thresholds of a class: from which to which value of each channel, as a bar and two numbers.

use bevy_egui::egui::{self, Rect, Sense, pos2, vec2};

use crate::app::inspector::tuner::ROW;
use crate::app::view::colours;
use crate::vision::{ColourBox, ColourClass, ColourTable};

/// Widths of a channel's letter, of a number and of the bar between two, in points.
const LETTER: f32 = 16.0;
const NUMBER: f32 = 40.0;
const BAR: f32 = 150.0;

/// A channel: its letter, what it is, and its place in a box.
struct YuvChannel {
    letter: &'static str,
    tip: &'static str,
    of: fn(&mut ColourBox) -> &mut (u8, u8),
}

const CHANNELS: [YuvChannel; 3] = [
    YuvChannel { letter: "Y", tip: "Brightness, from 0 to 255", of: |colour| &mut colour.y },
    YuvChannel { letter: "U", tip: "Blue against brightness; 128 is no colour", of: |colour| &mut colour.u },
    YuvChannel { letter: "V", tip: "Red against brightness; 128 is no colour", of: |colour| &mut colour.v },
];

/// Everything is of a class that begins with this; a person narrows it.
const WHOLE: ColourBox = ColourBox { y: (0, 255), u: (0, 255), v: (0, 255) };

/// Shows the thresholds of a class, which can be changed; `file` has those to go back to.
pub fn show(ui: &mut egui::Ui, class: ColourClass, file: Option<&ColourTable>, table: &mut ColourTable) {
    let filed = file.and_then(|file| file.0.get(&class).copied());
    let before = table.0.get(&class).copied();
    let mut now = before;
    ui.horizontal(|ui| {
        ui.weak(match now {
            Some(_) => format!("Thresholds of {class}"),
            None => format!("{class} has no thresholds: no pixel is of it"),
        });
        if now.is_some() {
            let none = ui.small_button("Forget").on_hover_text("No pixel is of the class until it is taught");
            if none.clicked() {
                now = None;
            }
        } else if ui.small_button("Begin").on_hover_text("Begins with all pixels").clicked() {
            now = Some(WHOLE);
        }
        if file.is_some() && now != filed {
            let reset = ui.add(egui::Button::new("⟲").frame(false));
            if reset.on_hover_text("Reset this class to the file's thresholds").clicked() {
                now = filed;
            }
        }
    });
    if let Some(colour) = &mut now {
        for channel in &CHANNELS {
            let filed = filed.map(|mut filed| *(channel.of)(&mut filed));
            row(ui, channel, class, filed, (channel.of)(colour));
        }
    }
    if now == before {
        return;
    }
    match now {
        Some(colour) => table.0.insert(class, colour),
        None => table.0.remove(&class),
    };
}

fn row(
    ui: &mut egui::Ui,
    channel: &YuvChannel,
    class: ColourClass,
    filed: Option<(u8, u8)>,
    range: &mut (u8, u8),
) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.add_sized([LETTER, ROW], egui::Label::new(channel.letter)).on_hover_text(channel.tip);
        let (least, most) = *range;
        let changed = filed.is_some_and(|filed| filed != *range);
        number(ui, &mut range.0, 0..=most, changed).on_hover_text("The least value; drag, or click to type");
        bar(ui, class, filed, *range).on_hover_text(channel.tip);
        number(ui, &mut range.1, least..=255, changed)
            .on_hover_text("The greatest value; drag, or click to type");
    });
}

fn number(
    ui: &mut egui::Ui,
    value: &mut u8,
    range: std::ops::RangeInclusive<u8>,
    changed: bool,
) -> egui::Response {
    ui.scope(|ui| {
        if changed {
            ui.visuals_mut().override_text_color = Some(colours::egui(colours::CHANGED));
        }
        let number = egui::DragValue::new(value).range(range).speed(0.5).update_while_editing(false);
        ui.add_sized([NUMBER, ROW], number)
    })
    .inner
}

/// All values from left to right, those of the class filled, those of its file between marks.
fn bar(ui: &mut egui::Ui, class: ColourClass, filed: Option<(u8, u8)>, range: (u8, u8)) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(vec2(BAR, ROW), Sense::hover());
    let ground = rect.shrink2(vec2(0.0, 4.0));
    let at = |value: f32| ground.left() + ground.width() * value / 256.0;
    let painter = ui.painter();
    painter.rect_filled(ground, 2.0, colours::egui(colours::SUNKEN));
    let (left, right) = (at(f32::from(range.0)), at(f32::from(range.1) + 1.0));
    let filled = Rect::from_min_max(pos2(left, ground.top()), pos2(right, ground.bottom()));
    painter.rect_filled(filled, 2.0, colours::egui(colours::class(class)));
    for value in filed.into_iter().flat_map(|(least, most)| [f32::from(least), f32::from(most) + 1.0]) {
        painter.vline(at(value), rect.y_range(), (1.0, colours::egui(colours::CHANGED)));
    }
    response
}
