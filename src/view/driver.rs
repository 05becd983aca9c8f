//! Time: runs the ticks that are due in a frame. Nothing that affects a match runs anywhere else in the window.

use std::time::{Duration, Instant};

use bevy::ecs::schedule::{ScheduleLabel, SingleThreadedExecutor};
use bevy::prelude::*;

use super::FrameSystems;
use super::dialogues::Open;
use super::state::Pace;
use crate::clock::Clock;
use crate::referee::{MatchState, Phase};
use crate::schedule::Tick;

pub(super) fn plugin(app: &mut App) {
    app.init_schedule(AfterTick)
        .edit_schedule(AfterTick, |schedule| {
            schedule.set_executor(SingleThreadedExecutor::new());
        })
        .add_systems(Update, pass_time.in_set(FrameSystems::Time));
}

/// Run after each tick, to look at the match; what runs here changes nothing of it.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct AfterTick;

/// The time in one frame after which no further tick is begun: at 64 times on a slow machine the window stays responsive.
const FRAME_BUDGET: Duration = Duration::from_millis(25);

fn pass_time(world: &mut World) {
    if world.resource::<Open>().question.is_some() || is_over(world) {
        return;
    }
    let elapsed = world.resource::<Time<Real>>().delta_secs();
    let dt = world.resource::<Clock>().dt;
    let due = world.resource_mut::<Pace>().take_ticks(elapsed, dt);
    let began = Instant::now();
    for _ in 0..due {
        world.run_schedule(Tick);
        world.run_schedule(AfterTick);
        if began.elapsed() > FRAME_BUDGET || is_over(world) {
            break;
        }
    }
}

fn is_over(world: &World) -> bool {
    world.get_resource::<MatchState>().is_none_or(|state| state.phase == Phase::Finished)
}
