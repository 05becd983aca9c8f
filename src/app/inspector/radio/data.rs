//! What there is to see of the radio, and what of it is looked at.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;

use super::booking_beliefs::BookingBelief;
use super::filter::Filter;
use super::history::History;
use super::locks::SwapAttempt;
use crate::app::view::state::{Playback, Selected};
use crate::clock::Clock;
use crate::comms::radio::{Interference, RadioRecord};
use crate::game::record::Record;
use crate::ids::{RobotId, Team};
use crate::protocol::role_swap::Lock;
use crate::robot::{Health, Robot};
use crate::strategy::Strategies;

/// What of the radio is looked at.
#[derive(Resource, Clone, Debug, Default)]
pub struct RadioView {
    pub filter: Filter,
    pub span: ChartSpan,
    pub page: RadioPage,
    /// The team that is looked at while no robot is selected: that of the last one.
    pub team: Option<Team>,
    /// The message that was clicked, by the number of its transmission.
    pub message: Option<u64>,
}

/// The time that the chart shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChartSpan {
    Two,
    #[default]
    Ten,
    Thirty,
    Sixty,
}

impl ChartSpan {
    pub const ALL: [ChartSpan; 4] = [ChartSpan::Two, ChartSpan::Ten, ChartSpan::Thirty, ChartSpan::Sixty];

    pub fn seconds(self) -> u16 {
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
pub enum RadioPage {
    #[default]
    Messages,
    Bookings,
    Robots,
}

/// What there is to see of the radio.
#[derive(SystemParam)]
pub struct RadioData<'w, 's> {
    pub clock: Res<'w, Clock>,
    pub playback: Res<'w, Playback>,
    pub radio: Res<'w, RadioRecord>,
    pub interference: Res<'w, Interference>,
    pub locks: Res<'w, History<Lock>>,
    pub attempts: Res<'w, History<SwapAttempt>>,
    pub beliefs: Res<'w, History<BookingBelief>>,
    pub record: Res<'w, Record>,
    pub strategies: Res<'w, Strategies>,
    pub selected: Res<'w, Selected>,
    pub robots: Query<'w, 's, (&'static RobotId, &'static Robot)>,
}

impl RadioData<'_, '_> {
    /// Whether a team books the ball.
    pub fn books(&self, team: Team) -> bool {
        self.strategies.of(team).teamwork.ball_booking.is_some()
    }

    /// The robots of a team, by number.
    pub fn team(&self, team: Team) -> Vec<(RobotId, Health)> {
        let robots = self.robots.iter().filter(|(id, _)| id.team == team);
        let mut robots: Vec<_> = robots.map(|(id, robot)| (*id, robot.health)).collect();
        robots.sort_unstable_by_key(|(id, _)| *id);
        robots
    }
}
