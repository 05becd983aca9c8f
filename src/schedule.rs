//! The simulation is one schedule. [`Tick`] holds every system that affects a match, as one chain of sets, in the order in
//! which data flows. The headless runner and the window both run it, and nothing that affects a match runs elsewhere.

use bevy::ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, SingleThreadedExecutor};
use bevy::prelude::*;

use crate::clock::Clock;
use crate::rng::Seed;
use crate::state::RegisterState;

pub(crate) fn plugin(app: &mut App) {
    app.match_resource::<Clock>().reflected().starts_empty();
    app.match_resource::<Seed>().reflected();
    app.init_schedule(Tick).edit_schedule(Tick, |schedule| {
        schedule.set_executor(SingleThreadedExecutor::new());
        schedule
            .set_build_settings(ScheduleBuildSettings { ambiguity_detection: LogLevel::Error, ..default() });
        schedule.configure_sets(
            (
                TickSystems::Script,
                TickSystems::Deliver,
                TickSystems::Sense,
                TickSystems::WorldModel,
                TickSystems::Teamwork,
                TickSystems::Behaviour,
                TickSystems::Motor,
                TickSystems::Drive,
                TickSystems::Physics,
                TickSystems::Referee,
                TickSystems::Transmit,
                TickSystems::Record,
            )
                .chain(),
        );
    });
}

/// The schedule that advances a match by one tick.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tick;

/// The stages of a [`Tick`], in their order. Each component and resource of a match is written by one of them, but for a few
/// that `tests/single_writer.rs` lists with their reasons.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TickSystems {
    /// What comes from outside: the pilot's keys and the inspector's requests.
    Script,
    /// Messages in flight that are due reach their robots.
    Deliver,
    /// Truth becomes percepts: partial, noisy, late.
    Sense,
    /// Percepts become beliefs.
    WorldModel,
    /// Roles and what robots arrange among themselves.
    Teamwork,
    /// State machines choose activities.
    Behaviour,
    /// Motor schemas become a steering intent.
    Motor,
    /// Intents become forces on wheels and ball.
    Drive,
    /// The rigid-body step.
    Physics,
    /// The rules of the game.
    Referee,
    /// What robots want to say goes on air. Last, so a message takes a tick at least.
    Transmit,
    /// Digest, statistics and invariants; the clock moves on.
    Record,
}
