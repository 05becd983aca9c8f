//! What people and scenarios ask of a running match.

use std::collections::VecDeque;
use std::sync::Arc;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::comms::radio::{FaultRule, Partition, Radio};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::protocol::role_swap::Reassignment;
use crate::robot::pilot::Pilot;
use crate::robot::{Ailment, Recall, RobotKind, Sensing};
use crate::strategy::Strategy;

/// Something that is to happen at the next tick.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// A person takes the robot over.
    TakeOver(RobotId),
    /// The robot's strategy takes it back.
    HandBack(RobotId),
    /// What the person at the controls does to the robot; see [`Pilot`]. Nothing, if nobody drives it.
    Steer {
        robot: RobotId,
        pilot: Pilot,
    },
    /// The weight of a term of an assemblage, both by index.
    SetWeight {
        team: Team,
        assemblage: usize,
        term: usize,
        weight: f32,
    },
    /// The team plays on with another strategy, or with a changed one, if it [can](Strategy::can_follow).
    ChangeStrategy {
        team: Team,
        strategy: Arc<Strategy>,
    },
    Robot(RobotId, Treatment),
    Air(Weather),
    Body(Shove),
}

/// What befalls a robot.
#[derive(Clone, Debug, PartialEq)]
pub enum Treatment {
    Afflict(Ailment),
    /// All its ailments end; a robot that had crashed is switched on again.
    Revive(Recall),
    /// The referee takes it off until the end of the match.
    Penalise,
    /// It decides that roles should be swapped.
    Swap(Reassignment),
    /// Its body and its senses have other values from now on; its size and the rate of its decisions stay.
    Recalibrate(Calibration),
}

/// The values of a robot that can be calibrated while it plays: its noise, its limits and its senses.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    pub kind: Arc<RobotKind>,
    pub sensing: Arc<Sensing>,
}

/// What befalls the radio.
#[derive(Clone, Debug, PartialEq)]
pub enum Weather {
    /// Another radio from now on.
    Change(Radio),
    ExtraLoss(f32),
    /// s
    ExtraDelay(f32),
    Jam(bool),
    /// The robot hears nobody and is heard by nobody.
    CutOff(RobotId),
    Reconnect(RobotId),
    Part(Partition),
    /// Ends all partitions.
    Heal,
    /// One more fault rule.
    Fault(FaultRule),
}

/// A hand on the pitch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shove {
    /// Puts the ball somewhere, rolling, m and m/s in the pitch frame.
    Ball { at: Vec2, velocity: Vec2 },
    /// Adds to a robot's velocity, m/s in the pitch frame.
    Push { robot: RobotId, by: Vec2 },
    /// Carries a robot off without telling it, to a pose in the pitch frame.
    Kidnap { robot: RobotId, to: Pose },
}

/// What a scenario has planned for later, the next one first.
#[derive(Resource, Clone, Debug, Default)]
pub struct Script(VecDeque<(u64, Request)>);

impl Script {
    /// Requests with their ticks, in any order; those for one tick are made in the order given.
    pub fn new(planned: &[(u64, Request)]) -> Script {
        let mut planned: Vec<_> = planned.to_vec();
        planned.sort_by_key(|(tick, _)| *tick);
        Script(planned.into())
    }
}

/// Makes the requests that are due.
pub(super) fn follow_script(clock: Res<Clock>, mut script: ResMut<Script>, mut requests: ResMut<Requests>) {
    while let Some((_, request)) = script.0.pop_front_if(|(tick, _)| *tick <= clock.tick) {
        requests.ask(request);
    }
}

/// Requests that wait for the next tick.
#[derive(Resource, Clone, Debug, Default)]
pub struct Requests(Vec<Request>);

impl Requests {
    pub fn ask(&mut self, request: Request) {
        self.0.push(request);
    }

    pub fn clear(&mut self) {
        self.0.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// In the order in which they were made.
    pub fn iter(&self) -> impl Iterator<Item = &Request> + '_ {
        self.0.iter()
    }
}
