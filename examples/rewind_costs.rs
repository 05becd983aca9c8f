//! What it costs that a match can go back and is recorded: `cargo run --release --no-default-features --example rewind_costs [MATCH]`.
//!
//! Plays a whole match twice, without and with its past kept, and prints the time and the memory that this takes; then goes to
//! a hundred ticks of it, and from there a minute back each time; begins twenty branches; and records the match three times, while
//! nobody drives and while a person moves a key or a lever in every tick.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use touchline::data::{AssetFolder, DataError};
use touchline::game::requests::{RadioChange, Request, Requests};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::lab::replay::{Recorded, Recorder, ReplayHeader};
use touchline::lab::rewind::{BranchId, GhostMatch, Keyframe, Rewind};
use touchline::rng::{Dice, Seed};
use touchline::robot::pilot::Pilot;

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
/// Branches to begin.
const BRANCHES: usize = 20;
/// Ticks of a minute.
const MINUTE: u64 = 3600;
/// Ticks of the match.
const END: u64 = 72_000;

fn measure(file: Option<String>) -> Result<(), DataError> {
    let assets = AssetFolder::find(None)?;
    let choice = Choice { file, seed: 3, ..Choice::default() };
    let plan = MatchPlan::read(&assets, &choice)?;
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
    measure_branches(&mut game, &mut rewind, &plan);
    measure_recordings(&choice, &assets)
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
    let (mut far, mut minutes, mut steps) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..SEEKS {
        let tick = random_tick(&mut dice);
        far.push(seek(tick));
        minutes.push(seek(tick - MINUTE));
        steps.push(seek(tick - MINUTE - 1));
    }
    tell([("to any tick", far), ("a minute back", minutes), ("a tick back", steps)]);
}

/// A tick that is not in the first minute.
fn random_tick(dice: &mut Dice) -> u64 {
    MINUTE + (dice.uniform() * (END - MINUTE) as f32) as u64
}

/// The times of each thing that was done: the one in the middle and the longest.
fn tell<const N: usize>(measured: [(&str, Vec<Duration>); N]) {
    for (what, mut times) in measured {
        times.sort_unstable();
        let [half, most] =
            [times[times.len() / 2], times[times.len() - 1]].map(|time| time.as_secs_f64() * 1e3);
        println!("{what:<22} {half:7.1} ms, at most {most:.1} ms");
    }
}

/// A branch begins with a tick in which something is asked for; the old future is then brought to its end in a world of its own, so
/// that it can go on beside it.
fn measure_branches(game: &mut Match, rewind: &mut Rewind, plan: &MatchPlan) {
    let mut dice = Dice::new(Seed(2), "branches", None);
    let (mut begins, mut beside) = (Vec::new(), Vec::new());
    for _ in 0..BRANCHES {
        let world = game.world_mut();
        let begun = Instant::now();
        rewind.seek(world, random_tick(&mut dice), &mut |_| ()).expect("it can go back");
        world.resource_mut::<Requests>().ask(Request::Radio(RadioChange::Jam(true)));
        rewind.play(world, |world| world.clear_trackers());
        begins.push(begun.elapsed());
        let begun = Instant::now();
        GhostMatch::new(rewind, plan, BranchId(0)).expect("it is the same match");
        beside.push(begun.elapsed());
        rewind.switch(world, BranchId(0), MINUTE, &mut |_| ()).expect("it can go back");
    }
    tell([("a branch at any tick", begins), ("the old one beside it", beside)]);
}

/// Which levers a person holds after a tick, if anybody drives.
type Hands = fn(&mut Dice) -> Option<Pilot>;

/// Keys are down or up; a lever stands anywhere among a hundred points.
const DRIVERS: [(&str, Hands); 3] = [
    ("nobody drives", |_| None),
    ("another key a tick", |dice| Some(levers(dice, 1.0))),
    ("another lever a tick", |dice| Some(levers(dice, 50.0))),
];

/// Levers that stand at one of so many points on either side.
fn levers(dice: &mut Dice, points: f32) -> Pilot {
    let mut lever = || ((dice.uniform() * (2.0 * points + 1.0)).floor() - points) / points;
    Pilot { throttle: lever(), turn: lever(), ..Pilot::default() }
}

fn measure_recordings(choice: &Choice, assets: &AssetFolder) -> Result<(), DataError> {
    let folder = tempfile::tempdir().expect("there is a place for temporary files");
    let path = folder.path().join("a.replay");
    let robot = RobotId::new(Team::Home, 1);
    for (who, hands) in DRIVERS {
        let (header, (plan, _)) = ReplayHeader::of(Recorded::Match(choice.clone()), assets)?;
        let mut recorder = Recorder::create(&path, header).expect("the folder is there");
        let mut dice = Dice::new(Seed(3), "hands", None);
        let (mut game, mut is_driven) = (Match::new(&plan), false);
        while !game.is_over() {
            let mut requests = game.world_mut().resource_mut::<Requests>();
            if let Some(pilot) = hands(&mut dice) {
                if !is_driven {
                    requests.ask(Request::TakeOver(robot));
                    is_driven = true;
                }
                requests.ask(Request::Steer { robot, pilot });
            }
            game.tick();
            recorder.note(game.world_mut()).expect("there is room for it");
        }
        recorder.finish().expect("there is room for it");
        let bytes = std::fs::metadata(&path).expect("it is there").len();
        println!("recorded, {who:<20} {:.0} kB", bytes as f64 / 1e3);
    }
    Ok(())
}

/// Bytes of memory that this process holds; not a number where the system does not tell.
fn resident() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|text| text.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(f64::NAN, |pages| pages * 4096.0)
}
