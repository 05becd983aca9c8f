//! What a tick costs: Hammerheads against ball chasers, eight Cyes with trailers, real sensing.
//!
//! Prints simulated seconds per second, and those of all robots; the ratio of a whole tick to a bare rapier2d pipeline that steps the same
//! bodies, joints and shapes at the same rate, from situations of the same match; what a tick of two teams that talk and swap roles
//! costs beside one of the same teams without a word; which stage takes how much; what more robots, more cores and more matches cost.

mod bare_world;
mod scaling;
mod stages;

use std::cell::Cell;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use bare_world::BareWorld;
use criterion::{Criterion, criterion_group, criterion_main};
use touchline::clock::TICK_HZ;
use touchline::data::AssetFolder;
use touchline::game::{Choice, Match, MatchPlan};
use touchline::strategy::teamwork::Mechanism;

/// Time spent and how often, summed over all samples.
#[derive(Default)]
struct Spent {
    time: Cell<Duration>,
    times: Cell<u64>,
}

impl Spent {
    fn add(&self, time: Duration, times: u64) -> Duration {
        self.time.set(self.time.get() + time);
        self.times.set(self.times.get() + times);
        time
    }

    fn mean_seconds(&self) -> f64 {
        self.time.get().as_secs_f64() / self.times.get().max(1) as f64
    }
}

fn plan(team: Option<&str>) -> MatchPlan {
    let assets = AssetFolder::new(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets"));
    let team = team.map(str::to_owned);
    let choice = Choice { seed: 1, home: team.clone(), away: team, ..Choice::default() };
    MatchPlan::read(&assets, &choice).unwrap_or_else(|error| panic!("{error}"))
}

/// The same match with teams that say nothing.
fn silenced(mut plan: MatchPlan) -> MatchPlan {
    for team in &mut plan.teams {
        let teamwork = &mut Arc::make_mut(&mut team.strategy).teamwork;
        for mechanism in [Mechanism::Messages, Mechanism::RoleSwap] {
            teamwork.mechanisms = teamwork.mechanisms.without(mechanism);
        }
    }
    plan
}

/// A match that restarts when it is over.
struct Season {
    plan: MatchPlan,
    game: Match,
}

impl Season {
    fn new(plan: MatchPlan) -> Season {
        Season { game: Match::new(&plan), plan }
    }

    fn tick(&mut self) {
        if self.game.is_over() {
            self.game = Match::new(&self.plan);
        }
        self.game.tick();
    }
}

fn ticks(criterion: &mut Criterion) {
    scaling::print_matches(&plan(None));
    let (whole, bare) = (Spent::default(), Spent::default());
    measure(criterion, "whole tick", plan(None), &whole);
    let mut season = Season::new(plan(None));
    let mut situations = Vec::new();
    for tick in 0..60 * 60 * 10 {
        season.tick();
        if tick % 600 == 599 {
            situations.push(BareWorld::of(&mut season.game));
        }
    }
    let mut next = situations.iter().cycle();
    criterion.bench_function("bare rapier step", |bencher| {
        bencher.iter_custom(|times| {
            let (mut time, mut steps) = (Duration::ZERO, 0);
            while steps < times {
                let (more, run) = next.next().expect("there are situations").clone().run();
                (time, steps) = (time + more, steps + run);
            }
            bare.add(time, steps);
            time.mul_f64(times as f64 / steps as f64)
        });
    });
    let (tick, step) = (whole.mean_seconds(), bare.mean_seconds());
    let (talking, silent) = (Spent::default(), Spent::default());
    measure(criterion, "tick of teams that talk", plan(Some("hammerheads_swap")), &talking);
    measure(criterion, "tick of teams that say nothing", silenced(plan(Some("hammerheads_swap"))), &silent);
    let speed = 1.0 / (tick * f64::from(TICK_HZ));
    let robots = plan(None).robots().count() as f64;
    println!("simulated seconds per second: {speed:.0}; of all robots: {:.0}", robots * speed);
    println!("whole tick {:.2} µs / bare rapier step {:.2} µs = {:.2}", tick * 1e6, step * 1e6, tick / step);
    println!("with radio / without = {:.2}", talking.mean_seconds() / silent.mean_seconds());
    stages::print(&plan(None));
    scaling::print(&plan(None));
}

fn measure(criterion: &mut Criterion, name: &str, plan: MatchPlan, spent: &Spent) {
    let mut season = Season::new(plan);
    criterion.bench_function(name, |bencher| {
        bencher.iter_custom(|times| {
            let started = Instant::now();
            (0..times).for_each(|_| season.tick());
            spent.add(started.elapsed(), times)
        });
    });
}

criterion_group!(benches, ticks);
criterion_main!(benches);
