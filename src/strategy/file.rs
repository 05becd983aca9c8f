//! A strategy as it is written: the serde types of `assets/strategies/*.ron`, names not yet looked up.

use std::collections::BTreeMap;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::desirability::Desirability;
use super::language::{Feature, Point, Points, Schema};
use super::pieces::{HomebaseRule, KickOff};
use super::teamwork::TeamworkFile;
use crate::geometry::Zone;

/// A whole strategy file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrategyFile {
    /// Its name for people.
    pub name: String,
    /// What the team does, for people.
    #[serde(default)]
    pub description: String,
    /// The strategy that fills whatever this file leaves out: the name of a file in the same folder or else of one among the
    /// assets, or a path from this file's folder. Of pieces with the same name, this file's own count, and `teamwork` is
    /// filled field by field. The base may have a base in turn.
    #[serde(default)]
    pub based_on: Option<String>,
    /// Length and width in metres of the pitch that its positions are meant for. On another pitch they are stretched.
    #[serde(default)]
    pub pitch: Option<Vec2>,
    /// Kinds of robots that can play it, by their files' names.
    #[serde(default)]
    pub robot_kinds: Vec<String>,
    /// The role of each robot at kick-off, by number.
    #[serde(default)]
    pub players: Vec<String>,
    /// Where robots stand for a kick-off.
    #[serde(default)]
    pub kick_off: KickOff,
    /// Places of all players, by number, at which scenarios begin.
    #[serde(default)]
    pub line_ups: BTreeMap<String, Vec<Vec2>>,
    /// Zones by name.
    #[serde(default)]
    pub zones: BTreeMap<String, Zone>,
    /// Places by name.
    #[serde(default)]
    pub percepts: BTreeMap<String, Point>,
    /// Sets of places by name.
    #[serde(default)]
    pub point_sets: BTreeMap<String, Points>,
    /// Statements by name.
    #[serde(default)]
    pub features: BTreeMap<String, Feature>,
    /// Motor schemas by name.
    #[serde(default)]
    pub schemas: BTreeMap<String, Schema>,
    /// Assemblages by name.
    #[serde(default)]
    pub assemblages: BTreeMap<String, AssemblageFile>,
    /// State machines by name.
    #[serde(default)]
    pub machines: BTreeMap<String, MachineFile>,
    /// Roles by name.
    #[serde(default)]
    pub roles: BTreeMap<String, RoleFile>,
    /// What robots arrange with each other.
    #[serde(default)]
    pub teamwork: TeamworkFile,
}

/// Motor schemas by name, a weight beside each, and how they become one vector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum AssemblageFile {
    /// The sum of all schemas.
    WeightedSum(Vec<(f32, String)>),
    /// The strongest schema alone.
    WinnerTakeAll(Vec<(f32, String)>),
    /// Several assemblages, each as far as it is desirable.
    Blend(Vec<BlendedFile>),
}

/// An assemblage within another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlendedFile {
    /// The assemblage.
    pub run: String,
    /// How much it counts when it is fully desirable.
    #[serde(default = "full_weight")]
    pub weight: f32,
    /// How desirable it is.
    pub desirability: Desirability,
}

fn full_weight() -> f32 {
    1.0
}

/// A finite state machine: each state is an activity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MachineFile {
    /// The first state.
    pub start: String,
    /// States by name.
    pub states: BTreeMap<String, StateFile>,
}

/// What a robot does in a state, and what takes it to another one. A state may hold states of its own: then these say what the
/// robot does, and the transitions of the outer one are taken from each of them, before their own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateFile {
    /// The assemblage that steers; without one the robot stays where it is, or backs straight off if it is in reverse.
    #[serde(default)]
    pub run: Option<String>,
    /// Share of the robot's top speed, 0 to 1.
    #[serde(default = "full_speed")]
    pub speed: f32,
    /// Drives with the rear ahead.
    #[serde(default)]
    pub reverse: bool,
    /// Whether it is an acquire behaviour, in which the ball can be claimed.
    #[serde(default)]
    pub acquires: bool,
    /// Whether the robot tries to hold the ball, if it is of a kind that can.
    #[serde(default)]
    pub hold: bool,
    /// Kicks by name: the first that the robot's kind has is made as soon as the ball is in reach.
    #[serde(default)]
    pub kick: Vec<String>,
    /// What to turn to while standing. Legs turn to it while they walk, too.
    #[serde(default)]
    pub turn: TurnFile,
    /// In order: the first transition whose feature holds is taken, at most one per decision.
    #[serde(default)]
    pub on: Vec<TransitionFile>,
    /// The first of its own states.
    #[serde(default)]
    pub start: Option<String>,
    /// Its own states by name. No two states of a machine have the same name, on whatever level they are.
    #[serde(default)]
    pub states: Option<BTreeMap<String, StateFile>>,
}

fn full_speed() -> f32 {
    1.0
}

/// What a standing robot turns to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum TurnFile {
    /// It does not turn.
    #[default]
    Stay,
    /// Rotates to face a point.
    Face(Point),
    /// Rotates at this many degrees a second.
    Spin(f32),
}

/// A way from one state to another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransitionFile {
    /// When it is taken.
    pub when: Feature,
    /// The next state, on any level. One that holds others is entered at its start.
    pub go: String,
}

/// A role: one that plays a machine, or one that acts as other roles by turns, as the floater does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum RoleFile {
    /// It plays a machine.
    Plays {
        /// One or two letters for the label on the pitch.
        tag: String,
        machine: String,
        /// The zone of control (figure 2); may reach beyond the pitch to allow for errors in localisation.
        danger_zone: Zone,
        /// Where to go without a ball: one of these.
        homebases: Vec<Vec2>,
        #[serde(default)]
        homebase_rule: HomebaseRule,
    },
    /// Plays as another role does: its machine, its zone of control and its homebases.
    StandsIn {
        /// One or two letters for the label on the pitch.
        tag: String,
        /// The role, one that plays a machine.
        role: String,
        /// How it chooses among the homebases; as that role does, if left out.
        #[serde(default)]
        homebase_rule: Option<HomebaseRule>,
    },
    /// The first sub-role whose feature holds; the last one chosen, while none does.
    ActsAs { tag: String, sub_roles: Vec<SubRoleFile> },
}

/// A role that another role acts as.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SubRoleFile {
    /// When it does.
    pub when: Feature,
    /// The role.
    pub role: String,
}
