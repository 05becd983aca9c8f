//! The Behaviour stage: which sub-role a robot acts in, which homebase it has, and which state its machine is in.
//!
//! At most one transition a decision, the first whose feature holds, as in Clay.

mod homebase;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use crate::clock::Clock;
use crate::geometry::Zone;
use crate::ids::RobotId;
use crate::mind::perception::{Memory, Perception};
use crate::mind::teamwork::{Role, TeamPicture};
use crate::mind::world_model::WorldModel;
use crate::pitch::Pitch;
use crate::robot::{OffPitch, Robot};
use crate::schedule::{Tick, TickSystems};
use crate::strategy::language::Feature;
use crate::strategy::{Part, Play, RoleSpec, Strategies, Strategy};
use crate::world::ball::Ball;
use crate::world::handling::Handling;
use crate::world::referee::Orders;
use crate::world::sense::Odometry;

pub use homebase::Searched;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Tick, choose_activities.in_set(TickSystems::Behaviour));
}

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
    pub history: VecDeque<Taken>,
}

/// A transition that was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Taken {
    pub tick: u64,
    pub from: String,
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

    fn note(&mut self, tick: u64, from: &str, to: &str, because: &str) {
        if self.history.len() == HISTORY {
            self.history.pop_front();
        }
        let (from, to, because) = (from.into(), to.into(), because.into());
        self.history.push_back(Taken { tick, from, to, because });
    }
}

/// A role that plays itself; loading makes sure that `acting_as` is one.
fn played(spec: &RoleSpec) -> &Play {
    match &spec.part {
        Part::Plays(play) => play,
        Part::ActsAs(_) => unreachable!("{} acts as other roles and has no machine", spec.name),
    }
}

/// What a robot decides upon, and what its operators remember. Of the Behaviour and Motor stages.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct Mind {
    pub wits: Wits,
    pub memory: &'static mut Memory,
}

/// What a robot decides upon.
#[derive(QueryData)]
pub struct Wits {
    pub id: &'static RobotId,
    pub robot: &'static Robot,
    pub model: &'static WorldModel,
    pub odometry: &'static Odometry,
    pub picture: &'static TeamPicture,
    pub role: &'static Role,
    pub handling: &'static Handling,
    pub orders: &'static Orders,
}

/// The perception of a robot in an activity.
pub fn perception<'a>(
    wits: &WitsItem<'a, '_>,
    activity: &Activity,
    strategy: &'a Strategy,
    (clock, pitch, ball): (&Clock, &'a Pitch, &Ball),
) -> Perception<'a> {
    let seconds_since = |tick: u64| clock.tick.saturating_sub(tick) as f32 * clock.dt;
    Perception {
        team: wits.id.team,
        role: wits.role.0,
        model: wits.model,
        picture: wits.picture,
        teamwork: &strategy.teamwork,
        pitch,
        danger_zone: activity.danger_zone(strategy),
        homebase: activity.homebase,
        now: clock.now() as f32,
        ball_age: wits.model.ball.map(|ball| seconds_since(ball.seen)),
        time_in_state: seconds_since(activity.since),
        holds_ball: wits.handling.holds(),
        stalled_for: wits.odometry.stalled_for,
        front: wits.robot.kind.body.length / 2.0,
        ball_radius: ball.kind.radius,
    }
}

fn choose_activities(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    ball: Single<&Ball>,
    mut robots: Query<(Mind, &mut Activity), Without<OffPitch>>,
) {
    for (mut mind, mut activity) in &mut robots {
        let wits = &mind.wits;
        if !wits.robot.decides(&clock) {
            continue;
        }
        let strategy = strategies.of(wits.id.team);
        let senses = |activity: &Activity| perception(wits, activity, strategy, (&clock, &pitch, &ball));
        let memory = &mut *mind.memory;
        memory.begin_decision();
        choose_sub_role(&senses(&activity), strategy, memory, &mut activity, clock.tick);
        let play = played(&strategy.roles[activity.acting_as]);
        let state = strategy.state(play.machine, activity.state);
        let now = senses(&activity);
        homebase::note_search(play, state, &mut activity.searched, &now);
        activity.homebase = homebase::choose(play, activity.homebase, &activity.searched, &now);
        take_transition(&senses(&activity), strategy, memory, &mut activity, clock.tick);
    }
}

fn choose_sub_role(
    senses: &Perception,
    strategy: &Strategy,
    memory: &mut Memory,
    activity: &mut Activity,
    tick: u64,
) {
    let wanted = match &strategy.roles[senses.role].part {
        Part::Plays(_) => senses.role,
        Part::ActsAs(sub_roles) => {
            let fits = first_that_holds(sub_roles.iter().map(|sub_role| &sub_role.when), senses, memory);
            match fits {
                Some(index) => sub_roles[index].role,
                None if sub_roles.iter().any(|sub_role| sub_role.role == activity.acting_as) => return,
                None => sub_roles[0].role,
            }
        }
    };
    if wanted == activity.acting_as {
        return;
    }
    let before = strategy.state(activity.machine(strategy), activity.state).name.clone();
    activity.acting_as = wanted;
    let machine = &strategy.machines[activity.machine(strategy)];
    activity.state = machine.states.iter().position(|state| state.name == before).unwrap_or(machine.start);
    activity.since = tick;
    let after = format!("{} as {}", machine.states[activity.state].name, strategy.roles[wanted].name);
    activity.note(tick, &before, &after, "sub-role");
}

/// The place of the first feature that holds. All are asked, so that memories do not depend on their order.
fn first_that_holds<'a>(
    features: impl Iterator<Item = &'a Feature>,
    senses: &Perception,
    memory: &mut Memory,
) -> Option<usize> {
    features.enumerate().fold(None, |first, (index, feature)| {
        let holds = senses.holds(feature, memory);
        first.or(holds.then_some(index))
    })
}

fn take_transition(
    senses: &Perception,
    strategy: &Strategy,
    memory: &mut Memory,
    activity: &mut Activity,
    tick: u64,
) {
    let machine = &strategy.machines[activity.machine(strategy)];
    let state = &machine.states[activity.state];
    let features = state.transitions.iter().map(|transition| &transition.when);
    let Some(index) = first_that_holds(features, senses, memory) else { return };
    let transition = &state.transitions[index];
    activity.state = transition.go;
    activity.since = tick;
    activity.note(tick, &state.name, &machine.states[transition.go].name, &transition.label);
}
