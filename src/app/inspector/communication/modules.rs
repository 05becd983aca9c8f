//! The page with what each module said and heard of each type, and with the queues in which modules' data wait.

use bevy_egui::egui::{self, RichText};

use super::counters::SummedCounters;
use crate::app::inspector::table::{self, Column, counts, heading, row, words};
use crate::app::view::colours;
use crate::comms::tcm::counters::{Dropped, TypeCount};
use crate::comms::tcm::{DataType, Module};

const TYPES: [Column; 12] = [
    words("module", 108.0, "The part of a robot's program that sends and receives"),
    words("type", 92.0, "The type of the data, as it was registered"),
    counts("sent", 50.0, "Messages sent"),
    counts("kB", 50.0, "Data of the messages sent, in kilobytes, once however many receive them"),
    counts("datagrams", 76.0, "Datagrams sent: each fragment counts once for each receiver"),
    counts("received", 66.0, "Messages received"),
    counts("kB in", 50.0, "Data of the messages received, in kilobytes"),
    counts("queue full", 76.0, "Dropped before sending: the module's queue had no room"),
    counts("too large", 68.0, "Dropped before sending: more fragments than a message may have"),
    counts("over budget", 78.0, "Not sent: it would have gone beyond the team's budget of messages"),
    counts("unknown", 64.0, "Dropped on arrival: nobody has registered for the type"),
    counts("unreadable", 78.0, "Dropped on arrival: the data could not be unserialised"),
];

const QUEUES: [Column; 5] = [
    words("queue of", 108.0, "Each module has a bounded queue at the TcmClient"),
    counts("waiting", 58.0, "Items that wait for the TCM now"),
    counts("put in", 56.0, "Items that the module has put in"),
    counts("taken", 56.0, "Items that the TCM has taken"),
    counts("dropped", 62.0, "Items that found the queue full, or were pushed out by newer ones"),
];

/// A type's name, where somebody has registered it.
pub type Names<'a> = &'a dyn Fn(DataType) -> String;

pub fn show(ui: &mut egui::Ui, sums: &SummedCounters, names: Names) {
    ui.horizontal_top(|ui| {
        let scroll = |name: &str| egui::ScrollArea::vertical().id_salt(name).auto_shrink(false);
        let wide = |ui: &mut egui::Ui, columns: &[Column]| ui.set_width(table::width(columns) + 12.0);
        ui.vertical(|ui| {
            wide(ui, &TYPES);
            heading(ui, &TYPES);
            scroll("types").show(ui, |ui| show_types(ui, sums, names));
        });
        ui.separator();
        ui.vertical(|ui| {
            wide(ui, &QUEUES);
            heading(ui, &QUEUES);
            scroll("queues").show(ui, |ui| show_queues(ui, sums));
        });
    });
}

fn show_types(ui: &mut egui::Ui, sums: &SummedCounters, names: Names) {
    let mut last: Option<Module> = None;
    let (used, idle): (Vec<_>, Vec<_>) =
        sums.types.iter().partition(|(_, count)| **count != TypeCount::default());
    for ((module, data_type), count) in used {
        let first = last.replace(*module) != Some(*module);
        let module = if first { module.to_string() } else { String::new() };
        row(ui, &TYPES, cells(module, names(*data_type), count));
    }
    if sums.others != TypeCount::default() {
        row(ui, &TYPES, cells("others".into(), String::new(), &sums.others))
            .on_hover_text("Kinds of message that have no row, since there are too many");
    }
    row(ui, &TYPES, cells("all".into(), String::new(), &sums.total()));
    if !idle.is_empty() {
        let idle: Vec<String> = idle.into_iter().map(|((_, data_type), _)| names(*data_type)).collect();
        ui.label(RichText::new(format!("Registered and not used so far: {}", idle.join(", "))).weak());
    }
    let strays = format!(
        "Besides: {} from strangers or for others, {} malformed, {} given up as incomplete",
        sums.foreign, sums.malformed, sums.expired
    );
    ui.label(RichText::new(strays).weak()).on_hover_text(
        "Datagrams and messages from nobody in the directory or for somebody else; datagrams that are none of the TCM; \
         messages of which fragments were missing for too long",
    );
}

fn cells(module: String, name: String, count: &TypeCount) -> [String; 12] {
    let [full, large, over, unknown, unreadable] =
        Dropped::ALL.map(|reason| count.dropped_as(reason).to_string());
    [
        module,
        name,
        count.messages_sent.to_string(),
        kilobytes(count.bytes_sent),
        count.datagrams_sent.to_string(),
        count.messages_received.to_string(),
        kilobytes(count.bytes_received),
        full,
        large,
        over,
        unknown,
        unreadable,
    ]
}

fn kilobytes(bytes: u64) -> String {
    format!("{:.1}", bytes as f64 / 1000.0)
}

fn show_queues(ui: &mut egui::Ui, sums: &SummedCounters) {
    if sums.queues.is_empty() {
        ui.weak("no module has said anything yet");
    }
    for (module, (waiting, counters)) in &sums.queues {
        let cells = [
            module.to_string(),
            waiting.to_string(),
            counters.put_in.to_string(),
            counters.handed_over.to_string(),
            counters.dropped.to_string(),
        ];
        let row = row(ui, &QUEUES, cells);
        if counters.dropped > 0 {
            let at = row.rect.left_center() - egui::vec2(4.0, 0.0);
            ui.painter().circle_filled(at, 2.0, colours::egui(crate::app::view::colours::PENALTY));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_a_cell_for_each_column() {
        let count = TypeCount { bytes_sent: 1234, dropped: [1, 2, 3, 4, 5], ..TypeCount::default() };
        let cells = cells("goalie".into(), "goalie".into(), &count);
        assert_eq!(cells.len(), TYPES.len());
        assert_eq!(cells[3], "1.2");
        assert_eq!(cells[7..], ["1", "2", "3", "4", "5"]);
    }

    #[test]
    fn both_tables_fit_beside_each_other_into_a_small_window() {
        assert!(table::width(&TYPES) + table::width(&QUEUES) < 1280.0 - 60.0);
    }
}
