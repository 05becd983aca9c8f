//! A strategy that can be played, and the pieces that it consists of: names are indices, numbers are sound.

use std::collections::BTreeMap;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::language::{Feature, Point, Schema};
use super::role::RoleRef;
use super::teamwork::Teamwork;
use crate::geometry::Zone;

/// A strategy that can be played: every name is an index, every number is sound.
#[derive(Clone, Debug, PartialEq)]
pub struct Strategy {
    pub name: String,
    pub description: String,
    /// Length and width in metres of the pitch that its file was written for.
    pub pitch: Option<Vec2>,
    pub robot_kinds: Vec<String>,
    pub roles: Vec<RoleSpec>,
    /// Index into `roles` for each robot at kick-off, by number.
    pub players: Vec<usize>,
    pub kick_off: KickOff,
    /// Places of all players by number, at which scenarios begin.
    pub line_ups: BTreeMap<String, Vec<Vec2>>,
    pub machines: Vec<Machine>,
    pub assemblages: Vec<Assemblage>,
    pub teamwork: Teamwork,
    /// How many memories its stateful operators need.
    pub slots: usize,
}

/// A role and what it consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct RoleSpec {
    pub name: String,
    pub tag: String,
    pub part: Part,
}

/// A role plays a machine itself or acts as other roles by turns.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    Plays(Play),
    ActsAs(Vec<SubRole>),
}

/// What a role that plays itself consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct Play {
    pub machine: usize,
    /// The zone of control (figure 2).
    pub danger_zone: Zone,
    /// A robot that has looked around for the ball from one of them in vain goes on to the next.
    pub homebases: Vec<Vec2>,
    pub homebase_rule: HomebaseRule,
}

/// Which of its homebases a role takes (section V-B).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum HomebaseRule {
    /// The one that is nearest to the robot.
    #[default]
    Nearest,
    /// The nearest on the other side of the field than the goalie entered its area by.
    AwayFromGoalie,
    /// The one that is farthest from the team mate in a role.
    FarthestFrom(RoleRef),
    /// The nearest that is not also the nearest for the team mate in a role.
    NotNearestOf(RoleRef),
}

/// Another role, and when to act in it.
#[derive(Clone, Debug, PartialEq)]
pub struct SubRole {
    pub when: Feature,
    pub role: usize,
}

/// A finite state machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    pub name: String,
    pub start: usize,
    pub states: Vec<State>,
}

/// An activity.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    pub name: String,
    pub assemblage: Option<usize>,
    pub speed: f32,
    pub reverse: bool,
    pub turn: Turn,
    /// Whether it is an acquire behaviour, in which the ball can be claimed.
    pub acquires: bool,
    /// Whether the robot tries to hold the ball.
    pub hold: bool,
    /// Kicks by name, the first that the robot's kind has.
    pub kicks: Vec<String>,
    pub transitions: Vec<Transition>,
}

/// What a standing robot turns to.
#[derive(Clone, Debug, PartialEq)]
pub enum Turn {
    Stay,
    Face(Point),
    /// rad/s
    Spin(f32),
}

/// A way out of a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    pub when: Feature,
    pub go: usize,
    /// The feature as the file has it, for people.
    pub label: String,
}

/// Weighted motor schemas.
#[derive(Clone, Debug, PartialEq)]
pub struct Assemblage {
    pub name: String,
    pub combination: Combination,
    pub terms: Vec<Term>,
}

/// How the vectors of an assemblage become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    WeightedSum,
    WinnerTakeAll,
}

/// A motor schema and its weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    pub weight: f32,
    pub name: String,
    pub schema: Schema,
}

impl Strategy {
    /// Whether robots that play `before` can play on with this strategy.
    ///
    /// # Errors
    /// Says why they cannot, in words for people.
    pub fn can_follow(&self, before: &Strategy) -> Result<(), String> {
        let (had, has) = (before.players.len(), self.players.len());
        if had != has {
            return Err(format!("it has {has} players, and {had} are on the pitch; restart to change that"));
        }
        Ok(())
    }

    pub fn state(&self, machine: usize, state: usize) -> &State {
        &self.machines[machine].states[state]
    }
}

pub(super) fn stretched(places: &[Vec2], scale: Vec2) -> Vec<Vec2> {
    places.iter().map(|place| *place * scale).collect()
}

/// Where people put the robots for a kick-off, by number: x, y in the team frame, looking at the opponents' goal.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KickOff {
    /// When this team kicks off.
    pub ours: Vec<Vec2>,
    /// When the opponents do.
    pub theirs: Vec<Vec2>,
}

impl KickOff {
    pub(super) fn scaled(&self, scale: Vec2) -> KickOff {
        KickOff { ours: stretched(&self.ours, scale), theirs: stretched(&self.theirs, scale) }
    }
}
