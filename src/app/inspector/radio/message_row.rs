//! The message that was clicked in the chart, and what a person may do to it.

use bevy_egui::egui;

use super::data::{RadioData, RadioView};
use super::words;
use crate::comms::radio::TransmissionState;
use crate::game::requests::{RadioChange, Request, Requests};

/// Shows the message, if one was clicked and is still known.
pub fn show(ui: &mut egui::Ui, heard: &RadioData, view: &mut RadioView, requests: &mut Requests) {
    let Some(id) = view.message else { return };
    let Some(message) = heard.radio.transmissions().rev().find(|sent| sent.id == id) else {
        view.message = None;
        return;
    };
    ui.horizontal(|ui| {
        let story = words::story(message, &heard.clock);
        ui.label(story.lines().collect::<Vec<_>>().join(", "));
        let is_under_way = matches!(message.state, TransmissionState::InFlight(_));
        let has_arrived = matches!(message.state, TransmissionState::Arrived(_));
        let mut ask = |ui: &mut egui::Ui, text: &str, tip: &str, is_possible, change| {
            if ui.add_enabled(is_possible, egui::Button::new(text)).on_hover_text(tip).clicked() {
                requests.ask(Request::Radio(change));
            }
        };
        ask(ui, "Drop", "It never arrives", is_under_way, RadioChange::Drop(id));
        ask(ui, "Deliver", "It arrives in the next tick", !has_arrived, RadioChange::Deliver(id));
        if ui.button("×").on_hover_text("Look at no message").clicked() {
            view.message = None;
        }
    });
}
