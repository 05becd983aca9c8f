//! The radio's panel, across the window below the pitch: what the robots of a team say to each other, how much of it arrives,
//! and what a person may do to the radio and to the robots.

mod booking_beliefs;
mod bookings;
mod chart;
mod filter;
mod history;
mod lanes;
mod layout;
mod locks;
mod robots;
#[cfg(test)]
mod samples;
mod toolbar;
mod words;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiPrimaryContextPass, egui};
use booking_beliefs::BookingBelief;
use history::History;
use locks::SwapAttempt;

use super::low_panel::{LowDock, LowPanel};
use crate::app::view::state::{Overlay, PanelSystems, Playback, Screen, Selected, shows};
use crate::clock::Clock;
use crate::comms::radio::{Conditions, RadioLog, Traffic};
use crate::game::record::Record;
use crate::game::requests::Requests;
use crate::ids::{RobotId, Team};
use crate::protocol::role_swap::Lock;
use crate::robot::{Condition, Robot};
use crate::strategy::Strategies;

pub use filter::{Filter, is_of_a_swap};
pub use layout::way_of_a_lost_one;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<RadioView>().add_plugins((locks::plugin, booking_beliefs::plugin)).add_systems(
        EguiPrimaryContextPass,
        dock.in_set(PanelSystems::Low).run_if(in_state(Screen::Match).and_then(shows(Overlay::Radio))),
    );
}

/// What of the radio is looked at.
#[derive(Resource, Clone, Debug, Default)]
pub struct RadioView {
    pub filter: Filter,
    span: ChartSpan,
    page: RadioPage,
    /// The team that is looked at while no robot is selected: that of the last one.
    team: Option<Team>,
}

/// The time that the chart shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum ChartSpan {
    Two,
    #[default]
    Ten,
    Thirty,
    Sixty,
}

impl ChartSpan {
    const ALL: [ChartSpan; 4] = [ChartSpan::Two, ChartSpan::Ten, ChartSpan::Thirty, ChartSpan::Sixty];

    fn seconds(self) -> u16 {
        match self {
            ChartSpan::Two => 2,
            ChartSpan::Ten => 10,
            ChartSpan::Thirty => 30,
            ChartSpan::Sixty => 60,
        }
    }
}

/// What the panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum RadioPage {
    #[default]
    Messages,
    Bookings,
    Robots,
}

/// What there is to see of the radio.
#[derive(SystemParam)]
struct RadioData<'w, 's> {
    clock: Res<'w, Clock>,
    pace: Res<'w, Playback>,
    log: Res<'w, RadioLog>,
    traffic: Res<'w, Traffic>,
    conditions: Res<'w, Conditions>,
    locks: Res<'w, History<Lock>>,
    attempts: Res<'w, History<SwapAttempt>>,
    beliefs: Res<'w, History<BookingBelief>>,
    record: Res<'w, Record>,
    strategies: Res<'w, Strategies>,
    selected: Res<'w, Selected>,
    robots: Query<'w, 's, (&'static RobotId, &'static Robot)>,
}

impl RadioData<'_, '_> {
    /// Whether a team books the ball.
    fn books(&self, team: Team) -> bool {
        self.strategies.of(team).teamwork.ball_booking.is_some()
    }

    /// The robots of a team, by number.
    fn team(&self, team: Team) -> Vec<(RobotId, Condition)> {
        let robots = self.robots.iter().filter(|(id, _)| id.team == team);
        let mut robots: Vec<_> = robots.map(|(id, robot)| (*id, robot.condition)).collect();
        robots.sort_unstable_by_key(|(id, _)| *id);
        robots
    }
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
) -> Result {
    let team = heard.selected.0.map(|robot| robot.team).or(view.team).unwrap_or(Team::Home);
    view.team = Some(team);
    let robots = heard.team(team);
    let toolbar = |ui: &mut egui::Ui, (view, requests): &mut (&mut RadioView, &mut Requests)| {
        toolbar::show(ui, team, &heard, view, requests);
    };
    let page = |ui: &mut egui::Ui, (view, requests): &mut (&mut RadioView, &mut Requests)| {
        egui::ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
            ui.set_min_width(WIDTH);
            match view.page {
                RadioPage::Messages => chart::show(ui, &robots, &heard, view),
                RadioPage::Bookings => bookings::show(ui, team, &robots, &heard, view),
                RadioPage::Robots => robots::show(ui, &robots, &heard, requests),
            }
        });
    };
    dock.show(PANEL, &mut (&mut *view, &mut *requests), toolbar, page)
}
