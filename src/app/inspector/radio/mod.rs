//! The radio's panel, across the window below the pitch: what the robots of a team say to each other, how much of it arrives,
//! and what a person may do to the radio and to the robots.

mod belief_history;
mod bookings;
mod chart;
mod filter;
mod layout;
mod locks;
mod robots;
#[cfg(test)]
mod samples;
mod toolbar;
mod words;

use belief_history::BeliefHistory;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use locks::LockHistory;

use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::interface::dock::SizedPanel;
use crate::app::view::state::{
    Action, Edge, FreeArea, Overlay, Overlays, PanelSizes, PanelSystems, Playback, Screen, Selected, shows,
};
use crate::clock::Clock;
use crate::comms::radio::{Conditions, RadioLog, Traffic};
use crate::game::record::Record;
use crate::game::requests::{Request, Requests};
use crate::ids::{RobotId, Team};
use crate::robot::{Condition, Robot};
use crate::strategy::Strategies;

pub use filter::{Filter, is_of_a_swap};
pub use layout::way_of_a_lost_one;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<RadioView>().add_plugins((locks::plugin, belief_history::plugin)).add_systems(
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
    locks: Res<'w, LockHistory>,
    beliefs: Res<'w, BeliefHistory>,
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

/// What the panel asks for, and what waits for the next tick.
struct RadioActions<'a> {
    requests: &'a mut Requests,
    asked: Vec<Request>,
}

impl RadioActions<'_> {
    /// The newest value among the requests that wait, or the one in force.
    fn shown<T>(&self, in_force: T, of: impl Fn(&Request) -> Option<T>) -> T {
        self.requests.iter().filter_map(of).last().unwrap_or(in_force)
    }

    fn ask(&mut self, request: Request) {
        self.asked.push(request);
    }
}

/// Heights of the panel in points: least and most.
const HEIGHT: (f32, f32) = (190.0, 420.0);
/// The width that its pages need, in points; they scroll in a narrower window.
const WIDTH: f32 = 600.0;

fn dock(
    mut contexts: EguiContexts,
    (mut area, mut overlays): (ResMut<FreeArea>, ResMut<Overlays>),
    heard: RadioData,
    (mut view, mut requests): (ResMut<RadioView>, ResMut<Requests>),
    (mut sizes, keyboard): (ResMut<PanelSizes>, Res<Keyboard>),
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let team = heard.selected.0.map(|robot| robot.team).or(view.team).unwrap_or(Team::Home);
    view.team = Some(team);
    let robots = heard.team(team);
    let mut desk = RadioActions { requests: &mut requests, asked: Vec::new() };
    let panel = SizedPanel {
        id: "radio",
        edge: Edge::Bottom,
        least: HEIGHT.0,
        most: HEIGHT.1,
        frame: egui::Frame::side_top_panel(&ctx.global_style()).inner_margin(egui::Margin::symmetric(10, 5)),
    };
    let closed = area.dock_sized(ctx, panel, &mut sizes.bypass_change_detection().radio, |ui| {
        super::panel::set_close(ui);
        egui::ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| {
                let tip = keyboard.tip_that_says("Close the radio's panel", Action::Switch(Overlay::Radio));
                let closed = super::panel::with_close_button(ui, &tip, |ui| {
                    toolbar::show(ui, team, &heard, &mut view, &mut desk);
                });
                ui.separator();
                egui::ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
                    ui.set_min_width(WIDTH);
                    match view.page {
                        RadioPage::Messages => chart::show(ui, &robots, &heard, &mut view),
                        RadioPage::Bookings => bookings::show(ui, team, &robots, &heard, &mut view),
                        RadioPage::Robots => robots::show(ui, &robots, &heard, &mut desk),
                    }
                });
                closed
            })
            .inner
    });
    for request in desk.asked {
        requests.ask(request);
    }
    if closed == Some(true) {
        overlays.set(Overlay::Radio, false);
    }
    Ok(())
}
