//! What a robot is doing: where it stands in its strategy.

use std::collections::VecDeque;

use bevy::prelude::*;
use smallvec::SmallVec;

use super::pieces::{Part, Play, RoleSpec, Strategy};
use crate::geometry::Zone;

/// Homebases from which a robot has looked around in vain since it knew the ball last, the latest last.
pub type Searched = SmallVec<[Vec2; 4]>;
/// What a robot is doing: the role it acts in, the state of that role's machine, and since when.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Activity {
    /// Index into the strategy's roles: the role itself, or the sub-role that the robot acts in.
    pub acting_as: usize,
    /// Index into the states of that role's machine.
    pub state: usize,
    /// The tick in which the state was entered.
    pub since: u64,
    /// Where the robot goes when it has nothing better to do, m in the team frame.
    pub homebase: Vec2,
    /// The homebases from which it has looked for the ball in vain.
    pub searched: Searched,
    /// The last transitions, oldest first.
    pub history: VecDeque<TransitionTaken>,
}

/// A transition that was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TransitionTaken {
    /// When it was taken.
    pub tick: u64,
    /// The state before.
    pub from: String,
    /// The state after.
    pub to: String,
    /// The feature that fired.
    pub because: String,
}

/// Transitions that are kept for people to see.
const HISTORY: usize = 8;

impl Activity {
    /// The first activity of a robot in this role.
    pub fn new(strategy: &Strategy, role: usize, tick: u64) -> Activity {
        let acting_as = match &strategy.roles[role].part {
            Part::Plays(_) => role,
            Part::ActsAs(sub_roles) => sub_roles[sub_roles.len() - 1].role,
        };
        let play = played(&strategy.roles[acting_as]);
        let state = strategy.machines[play.machine].start;
        let homebase = play.homebases[0];
        Activity {
            acting_as,
            state,
            since: tick,
            homebase,
            searched: Searched::new(),
            history: VecDeque::new(),
        }
    }

    /// The machine that the robot runs.
    pub fn machine(&self, strategy: &Strategy) -> usize {
        played(&strategy.roles[self.acting_as]).machine
    }

    /// The robot's zone of control.
    pub fn danger_zone(&self, strategy: &Strategy) -> Zone {
        played(&strategy.roles[self.acting_as]).danger_zone
    }

    /// This activity under a changed strategy: the role and the state of the same names, where they still exist.
    pub fn carried_over(&self, old: &Strategy, new: &Strategy, role: usize, tick: u64) -> Activity {
        let fresh = Activity::new(new, role, tick);
        let acting = &old.roles[self.acting_as].name;
        let Some(acting_as) = new.roles.iter().position(|spec| spec.name == *acting) else { return fresh };
        let Part::Plays(play) = &new.roles[acting_as].part else { return fresh };
        let machine = play.machine;
        let state = &old.state(self.machine(old), self.state).name;
        match new.machines[machine].states.iter().position(|candidate| candidate.name == *state) {
            Some(state) => Activity { acting_as, state, ..self.clone() },
            None => Activity { acting_as, state: new.machines[machine].start, since: tick, ..self.clone() },
        }
    }

    /// Keeps a transition, and forgets the oldest.
    pub fn note(&mut self, tick: u64, from: &str, to: &str, because: &str) {
        if self.history.len() == HISTORY {
            self.history.pop_front();
        }
        let (from, to, because) = (from.into(), to.into(), because.into());
        self.history.push_back(TransitionTaken { tick, from, to, because });
    }
}

/// A role that plays itself; loading makes sure that `acting_as` is one.
pub fn played(spec: &RoleSpec) -> &Play {
    match &spec.part {
        Part::Plays(play) => play,
        Part::ActsAs(_) => unreachable!("{} acts as other roles and has no machine", spec.name),
    }
}
