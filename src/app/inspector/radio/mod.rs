//! The radio's panel, across the window below the pitch: what the robots of a team say to each other, how much of it arrives,
//! and what a person may do to the radio and to the robots.

mod booking_beliefs;
mod bookings;
mod chart;
mod data;
mod filter;
mod history;
mod lanes;
mod layout;
mod locks;
mod message_row;
mod robots;
#[cfg(test)]
mod samples;
mod toolbar;
mod words;

use bevy::prelude::*;
use bevy_egui::{EguiPrimaryContextPass, egui};
use data::{RadioData, RadioPage};

use super::low_panel::{LowDock, LowPanel};
use crate::app::view::state::{Action, Overlay, PanelSystems, Screen, shows};
use crate::game::requests::Requests;
use crate::ids::Team;

pub use data::RadioView;
pub use filter::is_of_a_swap;
pub use layout::way_of_a_lost_one;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<RadioView>().add_plugins((locks::plugin, booking_beliefs::plugin)).add_systems(
        EguiPrimaryContextPass,
        dock.in_set(PanelSystems::Low).run_if(in_state(Screen::Match).and_then(shows(Overlay::Radio))),
    );
}

const PANEL: LowPanel = LowPanel {
    overlay: Overlay::Radio,
    id: "radio",
    heights: (190.0, 420.0),
    closes: "Close the radio's panel",
};
/// The width that its pages need, in points; they scroll in a narrower window.
const WIDTH: f32 = 600.0;

fn dock(
    mut dock: LowDock,
    heard: RadioData,
    mut view: ResMut<RadioView>,
    mut requests: ResMut<Requests>,
    mut actions: MessageWriter<Action>,
) -> Result {
    let team = heard.selected.0.map(|robot| robot.team).or(view.team).unwrap_or(Team::Home);
    view.team = Some(team);
    let robots = heard.team(team);
    let mut wanted = None;
    let toolbar = |ui: &mut egui::Ui, (view, requests): &mut (&mut RadioView, &mut Requests)| {
        toolbar::show(ui, team, &heard, view, requests);
    };
    let page = |ui: &mut egui::Ui, (view, requests): &mut (&mut RadioView, &mut Requests)| {
        egui::ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
            ui.set_min_width(WIDTH);
            match view.page {
                RadioPage::Messages => wanted = chart::show(ui, &robots, &heard, view, requests),
                RadioPage::Bookings => bookings::show(ui, team, &robots, &heard, view),
                RadioPage::Robots => robots::show(ui, &robots, &heard, requests),
            }
        });
    };
    let shown = dock.show(PANEL, &mut (&mut *view, &mut *requests), toolbar, page);
    actions.write_batch(wanted.map(Action::GoTo));
    shown
}
