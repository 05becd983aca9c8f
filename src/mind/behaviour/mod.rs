//! The Behaviour stage: which sub-role a robot acts in, which homebase it has, and which state its machine is in.
//!
//! At most one transition a decision, the first whose feature holds, as in Clay; those of outer states are asked before those of
//! the states in them (TeamChaos, section 2: a hierarchical finite state machine).

mod homebase;
#[cfg(test)]
mod tests;

use crate::mind::perception::Decider;
use crate::mind::perception::perception;
use crate::strategy::Activity;
use crate::strategy::played;
use bevy::prelude::*;

use crate::clock::Clock;
use crate::mind::perception::{Memory, Perception};
use crate::pitch::BallKind;
use crate::pitch::Pitch;
use crate::robot::{OffPitch, PutDown, RobotStart, StrategyChanged, SwitchedOn};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::Role;
use crate::strategy::language::Feature;
use crate::strategy::{Part, StateRef, Strategies, Strategy, TransitionId, TransitionTaken};

/// What this stage remembers of a robot; the memories of operators are of the Motor stage as well.
pub(crate) fn state(app: &mut App) {
    app.match_component::<Activity>()
        .reflected()
        .starts(|start: &RobotStart, _| Activity::new(&start.strategy, start.role, 0))
        .on(start_again)
        .on(|activity, on: &SwitchedOn, owner| {
            *activity = Activity::new(&on.strategy, role_of(owner), on.tick)
        })
        .on(|activity, StrategyChanged { old, new, tick }, owner| {
            *activity = activity.carried_over(old, new, role_of(owner), *tick);
        });
    app.match_component::<Memory>()
        .starts(|start: &RobotStart, _| Memory::new(start.strategy.slots))
        .on(|memory, put: &PutDown, _| *memory = Memory::new(put.strategy.slots))
        .on(|memory, on: &SwitchedOn, _| *memory = Memory::new(on.strategy.slots))
        .on(|memory, changed: &StrategyChanged, _| *memory = Memory::new(changed.new.slots));
}

pub(super) fn plugin(app: &mut App) {
    state(app);
    app.add_systems(Tick, choose_activities.in_set(TickSystems::Behaviour));
}

/// A robot that was put down begins from the start of its machine; what it did before stays to be seen.
fn start_again(activity: &mut Activity, put: &PutDown, owner: EntityRef) {
    let history = std::mem::take(&mut activity.history);
    *activity = Activity { history, ..Activity::new(&put.strategy, role_of(owner), put.tick) };
}

fn role_of(robot: EntityRef) -> usize {
    robot.get::<Role>().map_or(0, |role| role.0)
}

fn choose_activities(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    ball: Res<BallKind>,
    mut robots: Query<(Decider, &mut Activity), Without<OffPitch>>,
) {
    for (mut mind, mut activity) in &mut robots {
        let input = &mind.input;
        if !input.robot.decides(&clock) {
            continue;
        }
        let strategy = strategies.of(input.id.team);
        let senses = |activity: &Activity| perception(input, activity, strategy, (&clock, &pitch, &ball));
        let memory = &mut *mind.memory;
        memory.begin_decision();
        choose_sub_role(&senses(&activity), strategy, memory, &mut activity, clock.tick);
        let play = played(&strategy.roles[activity.acting_as]);
        let state = strategy.state(play.machine, activity.state);
        let now = senses(&activity);
        homebase::note_search(play, state, &mut activity.searched, &now);
        activity.homebase = homebase::choose(play, activity.homebase, &activity.searched, &now);
        take_transition(&senses(&activity), strategy, memory, &mut activity, &clock);
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
            let choices = sub_roles.iter().map(|sub_role| (*senses, &sub_role.when, sub_role.role));
            match first_that_holds(choices, memory) {
                Some(role) => role,
                None if sub_roles.iter().any(|sub_role| sub_role.role == activity.acting_as) => return,
                None => sub_roles[0].role,
            }
        }
    };
    if wanted == activity.acting_as {
        return;
    }
    let before = strategy.state(activity.machine(strategy), activity.state);
    activity.acting_as = wanted;
    let machine = &strategy.machines[activity.machine(strategy)];
    activity.enter(machine, machine.find(&before.name).unwrap_or(machine.start), 0, tick);
    let after = format!("{} as {}", machine.states[activity.state].name, strategy.roles[wanted].name);
    let (from, because) = (before.name.clone(), "sub-role".into());
    activity.note(TransitionTaken { tick, from, to: after, because, transition: None });
}

/// The first choice whose feature holds. All are asked, so that memories do not depend on their order.
fn first_that_holds<'a, T>(
    choices: impl Iterator<Item = (Perception<'a>, &'a Feature, T)>,
    memory: &mut Memory,
) -> Option<T> {
    choices.fold(None, |first, (senses, feature, choice)| {
        let holds = senses.holds(feature, memory);
        first.or(holds.then_some(choice))
    })
}

fn take_transition(
    senses: &Perception,
    strategy: &Strategy,
    memory: &mut Memory,
    activity: &mut Activity,
    clock: &Clock,
) {
    let index = activity.machine(strategy);
    let machine = &strategy.machines[index];
    let state = &machine.states[activity.state];
    // To an outer state's transitions, the time in the state is the time in the outer one.
    let outer = state.within.iter().zip(&activity.entered).map(|(composite, entered)| {
        let senses = Perception { time_in_state: clock.seconds_since(*entered), ..*senses };
        (senses, StateRef::Composite(*composite))
    });
    let levels = outer.chain([(*senses, StateRef::Plain(activity.state))]);
    let ways = levels.flat_map(|(senses, of)| {
        let ways = machine.transitions_of(of).iter().enumerate();
        ways.map(move |(number, way)| (senses, &way.when, (way, TransitionId { machine: index, of, number })))
    });
    let Some((transition, id)) = first_that_holds(ways, memory) else { return };
    let next = &machine.states[transition.go];
    let shared = state.within.iter().zip(&next.within).take_while(|(old, new)| old == new).count();
    activity.enter(machine, transition.go, shared.min(transition.around), clock.tick);
    activity.note(TransitionTaken {
        tick: clock.tick,
        from: state.name.clone(),
        to: next.name.clone(),
        because: transition.label.clone(),
        transition: Some(id),
    });
}
