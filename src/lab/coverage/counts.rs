//! Counts while a match is played.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;

use super::table::{Coverage, MachineCoverage, StateCoverage, StrategyCoverage, TransitionCoverage};
use crate::clock::Clock;
use crate::ids::{RobotId, Team};
use crate::robot::OffPitch;
use crate::strategy::{Activity, Machine, StateRef, Strategies, Strategy, TransitionId};

/// What is counted of one match.
pub struct MatchCoverage {
    robots: QueryState<(&'static RobotId, &'static Activity), Without<OffPitch>>,
    teams: [TeamCounts; 2],
    /// What was counted under strategies that were replaced since.
    before: Coverage,
    /// The last tick that was counted.
    counted: Option<u64>,
}

/// What is counted of one team, since it has its strategy.
struct TeamCounts {
    /// The name of the strategy's file.
    name: String,
    strategy: Arc<Strategy>,
    /// Whether a robot of the team was on the pitch.
    plays: bool,
    /// By machine and state.
    states: BTreeMap<(usize, StateRef), StateCount>,
    taken: BTreeMap<TransitionId, u64>,
    /// The length of a tick, s.
    dt: f32,
}

/// How often a state was entered, and for how many ticks robots were in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct StateCount {
    entered: u64,
    ticks: u64,
}

impl MatchCoverage {
    /// Nothing is counted yet of the match in this world, whose teams play strategies of these names.
    pub fn new(world: &mut World, names: [String; 2]) -> MatchCoverage {
        let robots = world.query_filtered();
        let strategies = world.resource::<Strategies>().0.clone();
        let dt = world.resource::<Clock>().dt;
        let mut names = names.into_iter();
        let teams =
            strategies.map(|strategy| TeamCounts::new(names.next().unwrap_or_default(), strategy, dt));
        MatchCoverage { robots, teams, before: Coverage::default(), counted: None }
    }

    /// Counts the tick that is just over. One that was counted before does not count again, as after a rewind.
    pub fn observe(&mut self, world: &World) {
        let Some(tick) = world.resource::<Clock>().tick.checked_sub(1) else { return };
        if self.counted.is_some_and(|counted| counted >= tick) {
            return;
        }
        self.counted = Some(tick);
        self.follow_strategies(world.resource::<Strategies>());
        self.robots.update_archetypes(world);
        for (id, activity) in self.robots.iter_manual(world) {
            self.teams[id.team.index()].count(activity, tick);
        }
    }

    fn follow_strategies(&mut self, strategies: &Strategies) {
        for team in Team::BOTH {
            let (counts, now) = (&mut self.teams[team.index()], &strategies.0[team.index()]);
            if !Arc::ptr_eq(&counts.strategy, now) {
                let fresh = TeamCounts::new(counts.name.clone(), now.clone(), counts.dt);
                let old = std::mem::replace(counts, fresh);
                counts.plays = old.plays;
                if old.strategy.machines == now.machines {
                    (counts.states, counts.taken) = (old.states, old.taken);
                } else {
                    self.before.add(&old.coverage(false));
                }
            }
        }
    }

    /// All that was counted.
    pub fn sum(&self) -> Coverage {
        let mut sum = self.before.clone();
        self.teams.iter().filter(|team| team.plays).for_each(|team| sum.add(&team.coverage(true)));
        sum
    }
}

impl TeamCounts {
    fn new(name: String, strategy: Arc<Strategy>, dt: f32) -> TeamCounts {
        TeamCounts { name, strategy, plays: false, states: BTreeMap::new(), taken: BTreeMap::new(), dt }
    }

    fn count(&mut self, activity: &Activity, tick: u64) {
        self.plays = true;
        let machine = activity.machine(&self.strategy);
        let state = self.strategy.state(machine, activity.state);
        let around =
            state.within.iter().map(|composite| StateRef::Composite(*composite)).zip(&activity.entered);
        for (state, since) in around.chain([(StateRef::Plain(activity.state), &activity.since)]) {
            let count = self.states.entry((machine, state)).or_default();
            count.ticks += 1;
            count.entered += u64::from(*since == tick);
        }
        for id in activity.taken_in(tick).filter_map(|taken| taken.transition) {
            *self.taken.entry(id).or_default() += 1;
        }
    }
    /// What was counted; also that the team has played, if it has come to its last strategy.
    fn coverage(&self, is_last: bool) -> Coverage {
        let machines = self.strategy.machines.iter().enumerate();
        let machines = machines.map(|(index, machine)| (machine.name.clone(), self.counted(index, machine)));
        let counted = StrategyCoverage { played: u64::from(is_last), machines: machines.collect() };
        Coverage { strategies: BTreeMap::from([(self.name.clone(), counted)]) }
    }

    fn counted(&self, index: usize, machine: &Machine) -> MachineCoverage {
        let states = machine.all_states().map(|of| {
            let count = self.states.get(&(index, of)).copied().unwrap_or_default();
            let ways =
                machine.transitions_of(of).iter().enumerate().map(|(number, way)| TransitionCoverage {
                    when: way.label.clone(),
                    go: machine.name_of(machine.target(way)).to_owned(),
                    taken: self
                        .taken
                        .get(&TransitionId { machine: index, of, number })
                        .copied()
                        .unwrap_or_default(),
                });
            let state = StateCoverage {
                entered: count.entered,
                seconds: count.ticks as f64 * f64::from(self.dt),
                transitions: ways.collect(),
            };
            (machine.name_of(of).to_owned(), state)
        });
        MachineCoverage { states: states.collect() }
    }
}
