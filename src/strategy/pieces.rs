//! A strategy that can be played, and the pieces that it consists of: names are indices, numbers are sound.

use std::collections::BTreeMap;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::desirability::Desirability;
use super::language::{Feature, Point, Schema, SchemaKind};
use super::role::RoleRef;
use super::teamwork::Teamwork;
use crate::geometry::Zone;

/// A strategy that can be played: every name is an index, every number is sound.
#[derive(Clone, Debug, PartialEq)]
pub struct Strategy {
    /// Its name for people.
    pub name: String,
    /// What the team does, for people.
    pub description: String,
    /// Length and width in metres of the pitch that its file was written for.
    pub pitch: Option<Vec2>,
    /// The kinds of robots that can play it.
    pub robot_kinds: Vec<String>,
    /// The roles; others refer to them by index.
    pub roles: Vec<RoleSpec>,
    /// Index into `roles` for each robot at kick-off, by number.
    pub players: Vec<usize>,
    /// Where robots stand for a kick-off.
    pub kick_off: KickOff,
    /// Places of all players by number, at which scenarios begin.
    pub line_ups: BTreeMap<String, Vec<Vec2>>,
    /// The state machines; roles refer to them by index.
    pub machines: Vec<Machine>,
    /// The assemblages; states refer to them by index.
    pub assemblages: Vec<Assemblage>,
    /// What robots arrange with each other.
    pub teamwork: Teamwork,
    /// How many memories its stateful operators need.
    pub slots: usize,
    /// What its file names under `features`, for people who watch them.
    pub features: NamedFeatures,
}

/// Features by their names, with memories that are counted apart from those of the strategy that runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedFeatures {
    /// By name.
    pub by_name: BTreeMap<String, Feature>,
    /// How many memories their stateful operators need.
    pub slots: usize,
}

/// A role and what it consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct RoleSpec {
    /// Its name.
    pub name: String,
    /// One or two letters for the label on the pitch.
    pub tag: String,
    /// What it does.
    pub part: Part,
}

/// A role plays a machine itself or acts as other roles by turns.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// It plays a machine.
    Plays(Play),
    /// It acts as other roles by turns.
    ActsAs(Vec<SubRole>),
}

/// What a role that plays itself consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct Play {
    /// The machine's index.
    pub machine: usize,
    /// The zone of control (figure 2).
    pub danger_zone: Zone,
    /// A robot that has looked around for the ball from one of them in vain goes on to the next.
    pub homebases: Vec<Vec2>,
    /// How it chooses its homebase.
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
    /// When the role acts as it.
    pub when: Feature,
    /// The role's index.
    pub role: usize,
}

/// A finite state machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Its name.
    pub name: String,
    /// The first state's index.
    pub start: usize,
    /// The states that a robot can be in: those that hold no others, from all levels.
    pub states: Vec<State>,
    /// The states that hold others.
    pub composites: Vec<CompositeState>,
}

/// A state that holds others: a robot is in it while it is in one of them.
#[derive(Clone, Debug, PartialEq)]
pub struct CompositeState {
    /// Its name.
    pub name: String,
    /// Taken from each state in it, before that state's own. In order; the first whose feature holds is taken.
    pub transitions: Vec<Transition>,
}

/// An activity.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its name.
    pub name: String,
    /// The index of the assemblage that steers.
    pub assemblage: Option<usize>,
    /// Share of the robot's top speed.
    pub speed: f32,
    /// Drives with the rear ahead.
    pub reverse: bool,
    /// What to turn to while standing.
    pub turn: Turn,
    /// Whether it is an acquire behaviour, in which the ball can be claimed.
    pub acquires: bool,
    /// Whether the robot tries to hold the ball.
    pub hold: bool,
    /// Kicks by name, the first that the robot's kind has.
    pub kicks: Vec<String>,
    /// In order; the first whose feature holds is taken.
    pub transitions: Vec<Transition>,
    /// Indices of the composite states around it, the outermost first.
    pub within: Vec<usize>,
}

/// A state on any level of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Reflect)]
pub enum StateRef {
    /// The index of a state that a robot can be in.
    Plain(usize),
    /// The index of a composite state.
    Composite(usize),
}

/// What a standing robot turns to.
#[derive(Clone, Debug, PartialEq)]
pub enum Turn {
    /// It does not turn.
    Stay,
    /// It turns to a point.
    Face(Point),
    /// rad/s
    Spin(f32),
}

/// A way out of a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// When it is taken.
    pub when: Feature,
    /// The next state's index.
    pub go: usize,
    /// How many composite states are around the one that the file names: only those can go on, all others begin.
    pub around: usize,
    /// The feature as the file has it, for people.
    pub label: String,
}

/// Weighted motor schemas, or a blend of other assemblages.
#[derive(Clone, Debug, PartialEq)]
pub struct Assemblage {
    /// Its name.
    pub name: String,
    /// How the terms become one vector.
    pub combination: Combination,
    /// The schemas or assemblages with their weights.
    pub terms: Vec<Term>,
}

/// How the vectors of an assemblage become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    /// The sum of all schemas.
    WeightedSum,
    /// The strongest schema alone.
    WinnerTakeAll,
    /// The mean of assemblages, weighted by how desirable each is (TeamChaos, section 2: tactical behaviours).
    Blend,
}

/// A motor schema or an assemblage, and its weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// How much it counts.
    pub weight: f32,
    /// The name of the schema or the assemblage.
    pub name: String,
    /// What it adds.
    pub influence: Influence,
}

/// What a term adds to an assemblage.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Influence {
    /// The vector of a motor schema.
    Schema(Schema),
    /// The vector of another assemblage, by its index, as far as that is desirable.
    Assemblage { index: usize, desirability: Desirability },
}

impl Term {
    /// What it does to a robot.
    pub fn kind(&self) -> SchemaKind {
        match &self.influence {
            Influence::Schema(schema) => schema.kind(),
            Influence::Assemblage { .. } => SchemaKind::Blended,
        }
    }
}

impl Machine {
    /// The place of the state with this name, if it has one.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.states.iter().position(|state| state.name == name)
    }

    /// The names of the composite states around a state, the outermost first, and its own: what a robot in it is in.
    pub fn names_of<'a>(&'a self, state: &'a State) -> impl Iterator<Item = &'a str> {
        let around = state.within.iter().map(|composite| self.composites[*composite].name.as_str());
        around.chain([state.name.as_str()])
    }

    /// All states: those that hold others first.
    pub fn all_states(&self) -> impl Iterator<Item = StateRef> {
        let composites = (0..self.composites.len()).map(StateRef::Composite);
        composites.chain((0..self.states.len()).map(StateRef::Plain))
    }

    /// The name of a state.
    pub fn name_of(&self, state: StateRef) -> &str {
        match state {
            StateRef::Plain(index) => &self.states[index].name,
            StateRef::Composite(index) => &self.composites[index].name,
        }
    }

    /// The ways out of a state, in the order in which they are asked.
    pub fn transitions_of(&self, state: StateRef) -> &[Transition] {
        match state {
            StateRef::Plain(index) => &self.states[index].transitions,
            StateRef::Composite(index) => &self.composites[index].transitions,
        }
    }

    /// The state that a transition names: a composite state, or the one in which the robot is then.
    pub fn target(&self, transition: &Transition) -> StateRef {
        let inside = self.states[transition.go].within.get(transition.around);
        inside.map_or(StateRef::Plain(transition.go), |composite| StateRef::Composite(*composite))
    }

    /// A state with the composite states around it, such as `play/strike`, for people.
    pub fn path(&self, state: &State) -> String {
        self.names_of(state).collect::<Vec<_>>().join("/")
    }
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

    /// A feature by its name in the file, or by the words of the transition that it is the condition of.
    pub fn feature(&self, name: &str) -> Option<&Feature> {
        let conditions = self
            .machines
            .iter()
            .flat_map(|machine| machine.all_states().flat_map(|state| machine.transitions_of(state)));
        let condition = || conditions.into_iter().find(|way| way.label == name).map(|way| &way.when);
        self.features.by_name.get(name).or_else(condition)
    }

    /// As many memories as any of its features needs.
    pub fn most_slots(&self) -> usize {
        self.slots.max(self.features.slots)
    }

    /// A state of a machine.
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
