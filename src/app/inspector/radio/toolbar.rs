//! The controls of the radio's panel: whose radio it is, its pages, and what a person does to the air.

use bevy_egui::egui::{self, RichText};

use super::data::{RadioData, RadioPage, RadioView};
use crate::app::inspector::pending::Pending;
use crate::app::view::colours;
use crate::app::view::state::Selected;
use crate::game::requests::{RadioChange, Request, Requests};
use crate::ids::Team;

/// Width of a slider, in points.
const SLIDER: f32 = 90.0;
/// The largest extra delay that the slider offers, s.
const LONGEST_DELAY: f32 = 2.0;

pub fn show(ui: &mut egui::Ui, team: Team, heard: &RadioData, view: &mut RadioView, requests: &mut Requests) {
    let title = RichText::new(format!("Radio, {team}")).size(15.0).strong();
    ui.label(title.color(colours::egui(colours::team_text(team))));
    if heard.selected.as_ref() == &Selected(None) {
        let other = team.opponent();
        if ui.button(format!("Show {other}")).on_hover_text("Or select one of its robots").clicked() {
            view.team = Some(other);
        }
    }
    ui.separator();
    for (page, name, tip) in [
        (RadioPage::Messages, "Messages", "Who told whom what, and when"),
        (RadioPage::Bookings, "Bookings", "Whom each robot believed to have booked the ball"),
        (RadioPage::Robots, "Robots", "Counters of each robot, and what a person may do to it"),
    ] {
        if ui.selectable_label(view.page == page, name).on_hover_text(tip).clicked() {
            view.page = page;
        }
    }
    ui.separator();
    show_weather(ui, heard, requests);
}

/// Extra loss, extra delay and the jam.
fn show_weather(ui: &mut egui::Ui, heard: &RadioData, requests: &mut Requests) {
    ui.spacing_mut().slider_width = SLIDER;
    let interference = &heard.interference;
    let loss = Pending::new(interference.extra_loss, requests, |request| match request {
        Request::Radio(RadioChange::ExtraLoss(share)) => Some(*share),
        _ => None,
    })
    .shown();
    ui.add(egui::Label::new("Extra loss").extend());
    let mut percent = 100.0 * loss;
    let slider = egui::Slider::new(&mut percent, 0.0..=100.0).step_by(1.0).fixed_decimals(0).suffix(" %");
    let tip = "Chance that a message is lost which the radio itself would have brought over";
    if ui.add(slider).on_hover_text(tip).changed() {
        requests.ask(Request::Radio(RadioChange::ExtraLoss(percent / 100.0)));
    }
    let delay = Pending::new(interference.extra_delay, requests, |request| match request {
        Request::Radio(RadioChange::ExtraDelay(seconds)) => Some(*seconds),
        _ => None,
    })
    .shown();
    ui.add(egui::Label::new("Extra delay").extend());
    let mut seconds = delay;
    let slider =
        egui::Slider::new(&mut seconds, 0.0..=LONGEST_DELAY).step_by(0.05).fixed_decimals(2).suffix(" s");
    if ui.add(slider).on_hover_text("Added to the way of every message").changed() {
        requests.ask(Request::Radio(RadioChange::ExtraDelay(seconds)));
    }
    let jammed = Pending::new(interference.jammed, requests, |request| match request {
        Request::Radio(RadioChange::Jam(jammed)) => Some(*jammed),
        _ => None,
    })
    .shown();
    let words = if jammed { "Jammed: end it" } else { "Jam" };
    let tip = "While the radio is jammed, no message of either team gets through";
    if ui.add(egui::Button::new(words).selected(jammed)).on_hover_text(tip).clicked() {
        requests.ask(Request::Radio(RadioChange::Jam(!jammed)));
    }
    if !interference.partitions.is_empty() {
        let heal = ui.button("Heal").on_hover_text("Ends all partitions");
        if heal.clicked() {
            requests.ask(Request::Radio(RadioChange::Heal));
        }
    }
}
