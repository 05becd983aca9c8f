//! What a robot is doing: where it stands in its strategy.

use std::collections::VecDeque;

use bevy::prelude::*;
use smallvec::SmallVec;

use super::pieces::{Machine, Part, Play, RoleSpec, StateRef, Strategy};
use crate::geometry::Zone;

/// Homebases from which a robot has looked around in vain since it knew the ball last, the latest last.
pub type Searched = SmallVec<[Vec2; 4]>;

/// What a robot is doing: the role it acts in, the state of that role's machine, and since when.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component)]
pub struct Activity {
    /// Index into the strategy's roles: the role itself, or the sub-role that the robot acts in.
    pub acting_as: usize,
    /// Index into the states of that role's machine.
    pub state: usize,
    /// The tick in which the state was entered.
    pub since: u64,
    /// The ticks in which the composite states around it were entered, the outermost first.
    pub entered: SmallVec<[u64; 4]>,
    /// Where the robot goes when it has nothing better to do, m in the team frame.
    pub homebase: Vec2,
    /// The homebases from which it has looked for the ball in vain.
    pub searched: Searched,
    /// The last transitions, oldest first.
    pub history: VecDeque<TransitionTaken>,
}

/// A transition that was taken.
#[derive(Clone, Debug, PartialEq, Eq, Reflect)]
pub struct TransitionTaken {
    /// When it was taken.
    pub tick: u64,
    /// The state before.
    pub from: String,
    /// The state after.
    pub to: String,
    /// The feature that fired.
    pub because: String,
    /// The transition of the strategy that was played then; none where the robot went on in another sub-role.
    pub transition: Option<TransitionId>,
}

/// A transition of a strategy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Reflect)]
pub struct TransitionId {
    /// The machine's index.
    pub machine: usize,
    /// The state that has it.
    pub of: StateRef,
    /// Its place among those of the state.
    pub number: usize,
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
        let machine = &strategy.machines[play.machine];
        let mut activity = Activity {
            acting_as,
            state: machine.start,
            since: tick,
            entered: SmallVec::new(),
            homebase: play.homebases[0],
            searched: Searched::new(),
            history: VecDeque::new(),
        };
        activity.enter(machine, machine.start, 0, tick);
        activity
    }

    /// Goes to a state of a machine. Of the composite states that it is in, the outermost `kept` go on; others begin.
    pub fn enter(&mut self, machine: &Machine, state: usize, kept: usize, tick: u64) {
        self.entered.truncate(kept);
        self.entered.resize(machine.states[state].within.len(), tick);
        self.state = state;
        self.since = tick;
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
        let (before, machine) = (&old.machines[self.machine(old)], &new.machines[play.machine]);
        let was = &before.states[self.state];
        let mut activity = Activity { acting_as, ..self.clone() };
        match machine.find(&was.name) {
            Some(state) => {
                // A composite state that is new around the state has been there for as long as the state itself.
                let entered = |name: &str| {
                    let known = before.names_of(was).zip(&self.entered).find(|(around, _)| *around == name);
                    known.map_or(self.since, |(_, tick)| *tick)
                };
                let now = &machine.states[state];
                activity.entered = machine.names_of(now).take(now.within.len()).map(entered).collect();
                activity.state = state;
            }
            None => activity.enter(machine, machine.start, 0, tick),
        }
        activity
    }

    /// Keeps a transition, and forgets the oldest.
    pub fn note(&mut self, taken: TransitionTaken) {
        if self.history.len() == HISTORY {
            self.history.pop_front();
        }
        self.history.push_back(taken);
    }

    /// The transitions that were taken in a tick, in their order.
    pub fn taken_in(&self, tick: u64) -> impl Iterator<Item = &TransitionTaken> {
        let fresh = self.history.iter().rev().take_while(|taken| taken.tick == tick).count();
        self.history.iter().skip(self.history.len() - fresh)
    }
}

/// A role that plays itself; loading makes sure that `acting_as` is one.
pub fn played(spec: &RoleSpec) -> &Play {
    match &spec.part {
        Part::Plays(play) => play,
        Part::ActsAs(_) => unreachable!("{} acts as other roles and has no machine", spec.name),
    }
}
