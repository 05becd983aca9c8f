//! What it costs that a match can go back: `cargo run --release --no-default-features --example rewind_costs [MATCH]`.
//!
//! Plays a whole match twice, without and with its past kept, and prints the time and the memory that this takes; then goes to
//! a hundred ticks of it, and from there a minute back each time.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use touchline::data::{AssetFolder, DataError};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::lab::rewind::{BranchId, Keyframe, Rewind};
use touchline::rng::{Dice, Seed};

fn main() -> ExitCode {
    match measure(std::env::args().nth(1)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Copies of the match at one moment, to measure one.
const COPIES: u32 = 200;
/// Ticks to go to.
const SEEKS: usize = 100;
/// Ticks of a minute.
const MINUTE: u64 = 3600;

fn measure(file: Option<String>) -> Result<(), DataError> {
    let assets = AssetFolder::find(None)?;
    let plan = MatchPlan::read(&assets, &Choice { file, seed: 3, ..Choice::default() })?;
    let begun = Instant::now();
    let mut plain = Match::new(&plan);
    while !plain.is_over() {
        plain.tick();
    }
    let alone = begun.elapsed();
    let mut game = Match::new(&plan);
    let before = resident();
    let begun = Instant::now();
    let mut rewind = Rewind::begin(game.world_mut());
    while !game.is_over() {
        rewind.play(game.world_mut(), |world| world.clear_trackers());
    }
    let kept = begun.elapsed();
    let end = rewind.end();
    assert_eq!(plain.record().digest, game.record().digest, "to be kept changes nothing");
    println!("{}: {end} ticks", plan.name);
    let each = |time: Duration| time.as_secs_f64() * 1e6 / end as f64;
    println!("a tick                 {:7.1} us, {:.1} us with its past kept", each(alone), each(kept));
    let branch = rewind.branch(BranchId(0));
    let track = branch.track.bytes_a_moment() as f64 * end as f64 / 1e6;
    println!("memory of the past     {:7.1} MB", (resident() - before) / 1e6);
    println!("    of it poses        {track:7.1} MB");
    println!("    keyframes          {:7}", branch.keyframes().len());
    measure_copy(&mut game);
    measure_seeks(&mut game, &mut rewind);
    Ok(())
}

fn measure_copy(game: &mut Match) {
    let (before, begun) = (resident(), Instant::now());
    let copies: Vec<Keyframe> = (0..COPIES).map(|_| Keyframe::take(game.world_mut())).collect();
    let each = begun.elapsed() / COPIES;
    let bytes = (resident() - before) / f64::from(COPIES);
    let begun = Instant::now();
    for copy in &copies {
        copy.restore(game.world_mut()).expect("it is the same match");
    }
    let back = begun.elapsed() / COPIES;
    println!("a keyframe             {:7.0} kB", bytes / 1e3);
    println!("    taken in           {:7.0} us", each.as_secs_f64() * 1e6);
    println!("    put back in        {:7.0} us", back.as_secs_f64() * 1e6);
}

fn measure_seeks(game: &mut Match, rewind: &mut Rewind) {
    let mut dice = Dice::new(Seed(1), "seeks", None);
    let mut seek = |tick: u64| {
        let begun = Instant::now();
        rewind.seek(game.world_mut(), tick, &mut |_| ()).expect("it can go back");
        begun.elapsed()
    };
    let end = 72_000;
    let (mut far, mut minutes, mut steps) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..SEEKS {
        let tick = MINUTE + (dice.uniform() * (end - MINUTE) as f32) as u64;
        far.push(seek(tick));
        minutes.push(seek(tick - MINUTE));
        steps.push(seek(tick - MINUTE - 1));
    }
    for (what, mut times) in [("to any tick", far), ("a minute back", minutes), ("a tick back", steps)] {
        times.sort_unstable();
        let [half, most] =
            [times[times.len() / 2], times[times.len() - 1]].map(|time| time.as_secs_f64() * 1e3);
        println!("{what:<22} {half:7.1} ms, at most {most:.1} ms");
    }
}

/// Bytes of memory that this process holds; not a number where the system does not tell.
fn resident() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|text| text.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(f64::NAN, |pages| pages * 4096.0)
}
