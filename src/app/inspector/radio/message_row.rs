//! The message that was clicked in the chart, and what a person may do to it.

use bevy_egui::egui;

use super::data::{RadioData, RadioView};
use super::words;
use crate::comms::radio::TransmissionState;
use crate::game::requests::{RadioChange, Request, Requests};

/// Shows the message, if one was clicked and is still known. The tick to go to, if a person wants to.
pub fn show(
    ui: &mut egui::Ui,
    heard: &RadioData,
    view: &mut RadioView,
    requests: &mut Requests,
) -> Option<u64> {
    let id = view.message?;
    let Some(message) = heard.radio.transmissions().rev().find(|sent| sent.id == id) else {
        view.message = None;
        return None;
    };
    let mut wanted = None;
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
        let just_sent = message.sent + 1;
        let tip = "Back to where it has just been sent: there it can be dropped";
        let back = ui.add_enabled(heard.clock.tick != just_sent, egui::Button::new("Go there"));
        if back.on_hover_text(tip).clicked() {
            wanted = Some(just_sent);
        }
        ask(ui, "Drop", "It never arrives", is_under_way, RadioChange::Drop(id));
        ask(ui, "Deliver", "It arrives in the next tick", !has_arrived, RadioChange::Deliver(id));
        if ui.button("×").on_hover_text("Look at no message").clicked() {
            view.message = None;
        }
    });
    wanted
}
