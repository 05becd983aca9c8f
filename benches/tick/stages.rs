//! Which stage of a tick takes how much.

use std::time::{Duration, Instant};

use bevy::ecs::schedule::Schedules;
use bevy::prelude::*;
use touchline::clock::TICK_HZ;
use touchline::game::{Match, MatchPlan};
use touchline::schedule::{Tick, TickSystems};

const STAGES: [TickSystems; 12] = [
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
];
/// For which the stages are watched, s of the match.
const SECONDS: f32 = 300.0;

/// When the last stage was over, and how long each has taken.
#[derive(Resource)]
struct StageTimes {
    last: Instant,
    spent: [Duration; STAGES.len()],
}

/// Plays with a clock between the stages, and prints what each takes.
pub fn print(plan: &MatchPlan) {
    let mut game = Match::new(plan);
    let spent = [Duration::ZERO; STAGES.len()];
    game.world_mut().insert_resource(StageTimes { last: Instant::now(), spent });
    game.world_mut().resource_mut::<Schedules>().get_mut(Tick).map(put_clocks).expect("a match has ticks");
    let ticks = (SECONDS * TICK_HZ) as u32;
    for _ in 0..ticks {
        game.world_mut().resource_mut::<StageTimes>().last = Instant::now();
        game.tick();
    }
    let StageTimes { spent, .. } = game.world().resource::<StageTimes>();
    let whole: Duration = spent.iter().sum();
    println!("stages of a tick, of {:.2} µs with clocks between them:", (whole / ticks).as_secs_f64() * 1e6);
    for (stage, spent) in STAGES.iter().zip(spent) {
        let (mean, share) = (spent.as_secs_f64() * 1e6 / f64::from(ticks), spent.div_duration_f64(whole));
        println!("  {:<12}{mean:7.2} µs {:5.1} %", format!("{stage:?}"), 100.0 * share);
    }
}

fn put_clocks(schedule: &mut Schedule) {
    for (place, stage) in STAGES.into_iter().enumerate() {
        let clock = move |mut times: ResMut<StageTimes>| {
            let now = Instant::now();
            let spent = now - times.last;
            times.spent[place] += spent;
            times.last = now;
        };
        match STAGES.get(place + 1) {
            Some(next) => schedule.add_systems(clock.after(stage).before(*next)),
            None => schedule.add_systems(clock.after(stage)),
        };
    }
}
