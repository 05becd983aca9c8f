//! The page with the messages that a robot has received in part, and with counts of its datagrams.

use bevy_egui::egui::{self, vec2};

use super::modules::Names;
use crate::app::inspector::table::{self, Column, counts, heading, row, words};
use crate::app::view::{colours, format};
use crate::clock::Clock;
use crate::comms::tcm::fragments::{Assembly, AssemblyCounters, Unfinished};
use crate::ids::RobotId;

const OPEN: [Column; 8] = [
    words("from", 96.0, "Who sends the message"),
    words("module", 108.0, "The module that sends it"),
    words("type", 92.0, "The type of its data"),
    counts("number", 66.0, "The number that its sender gave it"),
    counts("have", 76.0, "Fragments that have arrived, of all its fragments"),
    words("", 110.0, "The same as a bar"),
    counts("bytes", 70.0, "Bytes of data that have arrived"),
    counts("age", 64.0, "Time since its first fragment arrived"),
];

/// The counts of datagrams, each with its meaning.
const FATES: [(&str, &str); 9] = [
    ("whole", "Messages that came in a single datagram"),
    ("put together", "Messages put together from several fragments"),
    ("given up", "Messages that were not complete in time"),
    ("pushed out", "Unfinished messages that went for want of room"),
    ("contradicted", "Unfinished messages that a newer fragment contradicted"),
    ("doubled", "Fragments that had arrived before"),
    ("late", "Fragments of messages that were over"),
    ("too large", "Datagrams of messages larger than the limits allow"),
    ("malformed", "Datagrams that are none of the TCM"),
];

pub fn show(ui: &mut egui::Ui, robot: Option<(RobotId, &Assembly)>, clock: &Clock, names: Names) {
    let Some((robot, assembly)) = robot else {
        ui.weak("Select a robot to see which messages it has received in part.");
        return;
    };
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(table::width(&OPEN) + 12.0);
            heading(ui, &OPEN);
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                if assembly.in_assembly().len() == 0 {
                    ui.weak(format!("{robot} waits for no missing fragments."));
                }
                for message in assembly.in_assembly() {
                    show_message(ui, &message, assembly, clock, names);
                }
            });
        });
        ui.separator();
        ui.vertical(|ui| {
            ui.weak("What became of the datagrams");
            for ((name, tip), count) in FATES.into_iter().zip(fates(&assembly.counters())) {
                row(ui, &FATE, [name.to_owned(), count.to_string()]).on_hover_text(tip);
            }
        });
        ui.separator();
        ui.vertical(|ui| {
            let limits = assembly.limits();
            ui.weak("Limits");
            let timeout = format::seconds(format::span(0, limits.timeout, clock.dt));
            for (name, value, tip) in [
                (
                    "unfinished",
                    format!("{} of {}", assembly.in_assembly().len(), limits.messages),
                    "Unfinished messages now, of as many as there may be",
                ),
                ("longest", kilobytes(limits.message_bytes), "The longest message"),
                (
                    "memory",
                    format!("{} of {}", kilobytes(assembly.memory()), kilobytes(limits.memory())),
                    "Memory of the tables, of the most that they may take",
                ),
                ("timeout", timeout, "How long fragments are kept while some are missing"),
            ] {
                row(ui, &LIMIT, [name.to_owned(), value]).on_hover_text(tip);
            }
        });
    });
}

const FATE: [Column; 2] = [words("", 100.0, ""), counts("", 66.0, "")];
const LIMIT: [Column; 2] = [words("", 78.0, ""), counts("", 140.0, "")];

fn kilobytes(bytes: usize) -> String {
    format!("{:.1} kB", bytes as f64 / 1000.0)
}

/// In the order of [`FATES`].
fn fates(counters: &AssemblyCounters) -> [u64; 9] {
    [
        counters.single,
        counters.completed,
        counters.expired,
        counters.evicted,
        counters.contradictory,
        counters.duplicate,
        counters.late,
        counters.too_large,
        counters.malformed_in_all(),
    ]
}

fn show_message(ui: &mut egui::Ui, message: &Unfinished, assembly: &Assembly, clock: &Clock, names: Names) {
    let age = clock.tick.saturating_sub(message.since);
    let cells = [
        message.source.peer.to_string(),
        message.source.module.to_string(),
        names(message.data_type),
        message.counter.to_string(),
        format!("{} of {}", message.have, message.of),
        String::new(),
        message.bytes.to_string(),
        format::seconds(format::span(0, age, clock.dt)),
    ];
    let shown = row(ui, &OPEN, cells);
    let left: f32 = OPEN[..5].iter().map(|column| column.width).sum();
    let room = OPEN[5].width - 16.0;
    let whole = egui::Rect::from_min_size(
        egui::pos2(shown.rect.left() + left + 8.0, shown.rect.center().y - 4.0),
        vec2(room, 8.0),
    );
    let share = f32::from(message.have) / f32::from(message.of.max(1));
    ui.painter().rect_filled(whole, 2.0, colours::egui(colours::SUNKEN));
    let have = whole.with_max_x(whole.left() + share * room);
    ui.painter().rect_filled(have, 2.0, colours::egui(colours::ACCENT));
    let left = assembly.limits().timeout.saturating_sub(age);
    let left = format::seconds(format::span(0, left, clock.dt));
    shown.on_hover_text(format!("It is given up in {left} unless the rest arrives"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_count_stands_beside_its_own_name() {
        let counters = AssemblyCounters {
            single: 1,
            completed: 2,
            duplicate: 6,
            malformed: [9; _],
            ..Default::default()
        };
        let named: Vec<_> = FATES.iter().map(|(name, _)| *name).zip(fates(&counters)).collect();
        assert_eq!(named[..2], [("whole", 1), ("put together", 2)]);
        assert_eq!(named[5], ("doubled", 6));
        assert!(named[8].1 > 0);
    }
}
