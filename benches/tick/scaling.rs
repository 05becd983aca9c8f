//! What more robots, more cores and more matches cost.

use std::sync::Arc;
use std::time::{Duration, Instant};

use bevy::prelude::Vec2;
use touchline::clock::TICK_HZ;
use touchline::game::{Match, MatchPlan};
use touchline::ops;

/// Robots of each team.
const TEAMS: [usize; 5] = [1, 2, 4, 8, 11];
/// Of each match that is measured, s.
const SECONDS: f32 = 120.0;
/// Of one core and two.
const TURNS: usize = 5;
/// Matches in memory at once.
const MATCHES: usize = 20;

/// Measures and prints what more robots and more cores cost.
pub fn print(plan: &MatchPlan) {
    more_robots(plan);
    more_cores(plan);
}

/// The match between teams of so many robots: the shipped players over again, in a grid in their own halves.
fn with_robots(plan: &MatchPlan, robots: usize) -> MatchPlan {
    let mut plan = plan.clone();
    for team in &mut plan.teams {
        let strategy = Arc::make_mut(&mut team.strategy);
        strategy.players = strategy.players.iter().copied().cycle().take(robots).collect();
        let place = |i: usize| Vec2::new(-0.9 - (i / 4) as f32, 1.5 - (i % 4) as f32);
        let places: Vec<Vec2> = (0..robots).map(place).collect();
        strategy.kick_off.ours.clone_from(&places);
        strategy.kick_off.theirs = places;
    }
    plan
}

fn played(plan: &MatchPlan) -> Duration {
    let mut game = Match::new(plan);
    let started = Instant::now();
    for _ in 0..(SECONDS * TICK_HZ) as u32 {
        game.tick();
    }
    started.elapsed()
}

/// The exponent is the slope of the line through the logarithms, by least squares.
fn more_robots(plan: &MatchPlan) {
    let ticks = f64::from(SECONDS * TICK_HZ);
    let costs = TEAMS.map(|robots| {
        let cost = played(&with_robots(plan, robots)).as_secs_f64() / ticks;
        println!("a tick of {:2} robots: {:6.2} µs", 2 * robots, cost * 1e6);
        (ops::ln_f64(2.0 * robots as f64), ops::ln_f64(cost))
    });
    let count = costs.len() as f64;
    let (x, y) = costs.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let (up, along) = costs.iter().fold((0.0, 0.0), |(up, along), point| {
        (up + (point.0 - x) * (point.1 - y), along + (point.0 - x) * (point.0 - x))
    });
    println!("it grows with their number to the power of {:.2}", up / along);
}

/// One core and two play in turns, so that what else the machine does meanwhile is the same for both.
fn more_cores(plan: &MatchPlan) {
    let (mut alone, mut together) = (Duration::ZERO, Duration::ZERO);
    for _ in 0..TURNS {
        alone += played(plan);
        together += std::thread::scope(|scope| {
            let matches = [0; 2].map(|_| scope.spawn(|| played(plan)));
            matches
                .into_iter()
                .map(|it| it.join().expect("a match comes to its end"))
                .max()
                .unwrap_or_default()
        });
    }
    println!("two cores play {:.2} times what one does", 2.0 * alone.div_duration_f64(together));
}

/// Measures and prints what more matches in memory cost. Comes before all else: memory that was used is not given back.
pub fn print_matches(plan: &MatchPlan) {
    drop(Match::new(plan));
    let before = resident_bytes();
    let started = Instant::now();
    let mut matches: Vec<Match> = (0..MATCHES).map(|_| Match::new(plan)).collect();
    println!("a match starts in {:.2} ms", started.elapsed().as_secs_f64() * 1e3 / MATCHES as f64);
    for game in &mut matches {
        for _ in 0..(10.0 * TICK_HZ) as u32 {
            game.tick();
        }
    }
    if let (Some(before), Some(after)) = (before, resident_bytes()) {
        let each = after.saturating_sub(before) as f64 / MATCHES as f64;
        println!("a running match takes {:.1} MB of memory", each / 1e6);
    }
}

/// The memory of this process, where the system tells it as Linux does.
fn resident_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok()? * 1024)
}
