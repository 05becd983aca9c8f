use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use bevy::prelude::*;
use proptest::prelude::*;

use super::*;
use crate::comms::radio::RadioRecord;
use crate::data::{AssetFolder, AssetKind};
use crate::game::record::{DigestPart, TraceDifference};
use crate::game::requests::{BodyChange, RadioChange, Request, Requests, RobotChange};
use crate::game::{Choice, Match};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::ScenarioRef;
use crate::robot::RobotFailure;
use crate::robot::pilot::Pilot;
use crate::strategy::Role;

const HOME_1: RobotId = RobotId::new(Team::Home, 1);
const AWAY_3: RobotId = RobotId::new(Team::Away, 3);

fn shipped() -> AssetFolder {
    AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))
}

fn friendly() -> Recorded {
    Recorded::Match(Choice { seed: 7, half_minutes: Some(0.1), ..Choice::default() })
}

/// Somebody drives, drags, jams, changes a weight, breaks a robot and exchanges a strategy.
fn meddle(game: &mut Match) {
    let levers = Pilot { throttle: 0.8, turn: 0.5, ..Pilot::default() };
    let asked = match game.clock().tick {
        100 => vec![Request::TakeOver(AWAY_3), Request::Steer { robot: AWAY_3, pilot: levers }],
        150 => vec![
            Request::Body(BodyChange::Ball { at: Vec2::new(0.5, 0.3), velocity: Vec2::X }),
            Request::Body(BodyChange::Kidnap { robot: HOME_1, to: Pose::new(-0.5, 0.5, 1.0) }),
        ],
        200 => vec![Request::Radio(RadioChange::Jam(true)), Request::Robot(HOME_1, fail())],
        250 => {
            let assets = shipped();
            let plan = friendly().plans(&assets).unwrap().0;
            let text = assets.read(&assets.file(AssetKind::Strategy, "ball_chasers")).unwrap().text;
            let reading = plan.read_sent(Team::Away, "mine.ron", text.replace("speed: 0.85", "speed: 0.3"));
            let strategy = Arc::new(reading.strategy.unwrap());
            vec![Request::ChangeStrategy { team: Team::Away, strategy, texts: reading.texts }]
        }
        _ => Vec::new(),
    };
    let mut requests = game.world_mut().resource_mut::<Requests>();
    asked.into_iter().for_each(|request| requests.ask(request));
}

fn fail() -> RobotChange {
    RobotChange::Fail(RobotFailure::Frozen)
}

/// Plays and records, to the end or for so many ticks.
fn record(recorded: Recorded, assets: &AssetFolder, path: &Path, ticks: u64) -> (Match, Recorder) {
    let (header, (plan, _)) = ReplayHeader::of(recorded, assets).unwrap();
    let mut recorder = Recorder::create(path, header).unwrap();
    let mut game = Match::new(&plan);
    while !game.is_over() && game.clock().tick < ticks {
        meddle(&mut game);
        game.tick();
        recorder.note(game.world_mut()).unwrap();
    }
    (game, recorder)
}

fn recorded(path: &Path) -> Match {
    let (game, recorder) = record(friendly(), &shipped(), path, u64::MAX);
    recorder.finish().unwrap();
    game
}

/// Plays a replay as far as it goes or up to where it parts.
fn play(replay: &Replay, meddle: impl Fn(&mut Match)) -> (Match, Result<(), Parting>) {
    let mut game = Match::new(&replay.plans().unwrap().0);
    let mut comparison = Comparison::with(replay);
    for _ in 0..replay.ticks() {
        game.tick();
        meddle(&mut game);
        if let Err(parting) = comparison.check(game.world_mut()) {
            return (game, Err(parting));
        }
    }
    (game, Ok(()))
}

fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.replay");
    (folder, path)
}

#[test]
fn a_match_with_a_person_and_a_new_strategy_is_played_again_from_its_file() {
    let (_folder, path) = folder();
    let game = recorded(&path);
    let replay = Replay::read(&path).unwrap();
    assert!(replay.is_whole);
    assert_eq!((replay.ticks(), replay.digest()), (game.clock().tick, Some(game.record().digest)));
    let (again, parting) = play(&replay, |_| {});
    assert_eq!(parting, Ok(()));
    assert_eq!(again.record().digest, game.record().digest);
    assert_eq!(again.state(), game.state());
}

#[test]
fn a_replay_needs_none_of_the_files_that_the_match_was_played_from() {
    let (folder, path) = folder();
    let root = folder.path().join("assets");
    for kind in AssetKind::ALL {
        for file in shipped().files(kind).unwrap() {
            let copy = root.join(kind.folder());
            fs::create_dir_all(&copy).unwrap();
            fs::copy(&file, copy.join(file.file_name().unwrap())).unwrap();
        }
    }
    let choice = Choice { home: Some("hammerheads_swap".into()), ..Choice::default() };
    let (game, recorder) = record(Recorded::Match(choice), &AssetFolder::new(&root), &path, 300);
    recorder.finish().unwrap();
    fs::remove_dir_all(&root).unwrap();
    let replay = Replay::read(&path).unwrap();
    let (again, parting) = play(&replay, |_| {});
    assert_eq!((again.record().digest, parting), (game.record().digest, Ok(())));
}

#[test]
fn a_scenario_is_played_again_with_its_script_once() {
    let (_folder, path) = folder();
    let scenario = ScenarioRef::named(&shipped(), "swap_locks_time_out:paper");
    let recorded = Recorded::Scenario { scenario, place: Vec2::new(0.4, 0.1), seed: 3, without: None };
    let (game, recorder) = record(recorded, &shipped(), &path, 900);
    recorder.finish().unwrap();
    let replay = Replay::read(&path).unwrap();
    let (plan, scenario) = replay.plans().unwrap();
    assert!(scenario.is_some_and(|scenario| !scenario.scenario.script.is_empty()));
    assert!(plan.situation.is_some_and(|situation| situation.ball == Vec2::new(0.4, 0.1)));
    let (again, parting) = play(&replay, |_| {});
    assert_eq!((again.record().digest, parting), (game.record().digest, Ok(())));
}

#[test]
fn a_play_that_parts_is_told_with_tick_robot_and_component() {
    let (_folder, path) = folder();
    recorded(&path);
    let replay = Replay::read(&path).unwrap();
    // Of each part a trace keeps four bits, which one change in sixteen leaves as they are: then the next tick is changed.
    let parts = |change: &dyn Fn(&mut World)| {
        let at = |tick: u64| {
            let (_, parting) = play(&replay, |game| {
                if game.clock().tick == tick + 1 {
                    change(game.world_mut());
                }
            });
            let parting = parting.err()?;
            matches!(parting, Parting::Play { tick: parted, .. } if parted == tick).then_some((tick, parting))
        };
        (333..340).find_map(at).expect("a change is seen")
    };
    let first = |tick, body, part| {
        (tick, Parting::Play { tick, first: Some(TraceDifference { body, part: Some(part) }) })
    };
    let moved = parts(&|world| {
        for (id, mut pose) in world.query::<(&RobotId, &mut Pose)>().iter_mut(world) {
            pose.position.x += if *id == HOME_1 { 1e-4 } else { 0.0 };
        }
    });
    assert_eq!(moved, first(moved.0, Some(Some(HOME_1)), DigestPart::Pose));
    let (tick, parting) = moved;
    let expected = format!("the match parts from its recording at tick {tick}, first in robot home 1: Pose");
    assert_eq!(parting.to_string(), expected);
    let cast = parts(&|world| {
        for (id, mut role) in world.query::<(&RobotId, &mut Role)>().iter_mut(world) {
            role.0 = if *id == AWAY_3 { 1 - role.0.min(1) } else { role.0 };
        }
    });
    assert_eq!(cast, first(cast.0, Some(Some(AWAY_3)), DigestPart::Role));
    let said = parts(&|world| world.insert_resource(RadioRecord::default()));
    assert_eq!(said, first(said.0, None, DigestPart::RadioRecord));
}

#[test]
fn what_the_digest_does_not_hold_is_compared_now_and_then() {
    let (_folder, path) = folder();
    recorded(&path);
    let replay = Replay::read(&path).unwrap();
    let (_, parting) = play(&replay, |game| {
        if game.clock().tick == 600 {
            let mut models =
                game.world_mut().query::<(&RobotId, &mut crate::mind::world_model::WorldModel)>();
            for (id, mut model) in models.iter_mut(game.world_mut()) {
                model.pose.position.x += if *id == HOME_1 { 1.0 } else { 0.0 };
            }
        }
    });
    let state = Parting::State { tick: 599, entity: "robot home 1".into(), kind: "WorldModel".into() };
    assert_eq!(parting, Err(state));
}

#[test]
fn a_file_that_is_cut_off_is_played_to_its_last_whole_second() {
    let (_folder, path) = folder();
    let game = recorded(&path);
    let bytes = fs::read(&path).unwrap();
    let mut lengths = Vec::new();
    for kept in (0..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
        fs::write(&path, &bytes[..kept]).unwrap();
        match Replay::read(&path) {
            Ok(replay) => {
                assert!(!replay.is_whole && replay.ticks() % 60 == 0, "{kept}");
                lengths.push(replay.ticks());
            }
            Err(error) => assert!(lengths.is_empty(), "{error}"),
        }
    }
    assert!(lengths.is_sorted());
    let last = game.clock().tick / 60 * 60;
    assert_eq!(lengths.last(), Some(&last));
    let (_, parting) = play(&Replay::read(&path).unwrap(), |_| {});
    assert_eq!(parting, Ok(()));
}

#[test]
fn another_version_and_no_replay_at_all_are_refused_in_one_line() {
    let (_folder, path) = folder();
    let refused = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        let error = Replay::read(&path).unwrap_err();
        assert!(!error.to_string().contains('\n'));
        error.message
    };
    let ours = env!("CARGO_PKG_VERSION");
    let expected = format!("was recorded by version 99.0, and this is version {ours}");
    assert_eq!(refused(b"touchline replay 99.0\nsomething"), expected);
    assert_eq!(refused(b"(name: \"x\")"), "is not a replay");
    assert_eq!(refused(b""), "is not a replay");
    let missing = Replay::read(Path::new("/no/such.replay")).unwrap_err();
    assert!(missing.to_string().starts_with("/no/such.replay: cannot be read: "), "{missing}");
}

#[test]
fn a_branch_has_what_came_before_it_and_goes_on_in_a_file_of_its_own() {
    let (folder, path) = folder();
    let (mut game, recorder) = record(friendly(), &shipped(), &path, 400);
    let beside = folder.path().join("b.replay");
    let mut branch = recorder.branch(222, &beside).unwrap();
    assert_eq!(branch.ticks(), 222);
    let replay = Replay::read(&beside).unwrap();
    assert_eq!((replay.header.branched, replay.ticks()), (Some(222), 180));
    let mut other = Match::new(&friendly().plans(&shipped()).unwrap().0);
    while other.clock().tick < 330 {
        if other.clock().tick < 222 {
            meddle(&mut other);
        } else if other.clock().tick == 222 {
            other.world_mut().resource_mut::<Requests>().ask(Request::Robot(AWAY_3, fail()));
        }
        other.tick();
        branch.note(other.world_mut()).unwrap();
    }
    let noted = |tick, note: &str| Bookmark { tick, note: note.into() };
    for bookmark in [noted(230, "?"), noted(12, "away with it"), noted(230, "it fails"), noted(12, "")] {
        branch.mark(bookmark).unwrap();
    }
    // A program that dies now has written them.
    assert_eq!(Replay::read(&beside).unwrap().bookmarks(), [noted(230, "it fails")]);
    let third = folder.path().join("c.replay");
    assert_eq!(branch.branch(235, &third).unwrap().bookmarks(), [noted(230, "it fails")]);
    assert_eq!(Replay::read(&third).unwrap().bookmarks(), [noted(230, "it fails")]);
    assert_eq!(branch.branch(225, &third).unwrap().bookmarks(), []);
    branch.finish().unwrap();
    let replay = Replay::read(&beside).unwrap();
    assert_eq!(replay.bookmarks(), [noted(230, "it fails")]);
    let (again, parting) = play(&replay, |_| {});
    assert_eq!((again.clock().tick, parting), (330, Ok(())));
    game.tick();
    assert_ne!(again.record().digest, game.record().digest);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn a_byte_that_is_spoilt_is_found(at in 0.0f64..1.0, bit in 0u8..8) {
        let (_folder, path) = folder();
        let (_, recorder) = record(friendly(), &shipped(), &path, 65);
        recorder.finish().unwrap();
        let sound = Replay::read(&path).unwrap();
        let mut bytes = fs::read(&path).unwrap();
        let at = (at * bytes.len() as f64) as usize;
        bytes[at] ^= 1 << bit;
        fs::write(&path, &bytes).unwrap();
        // A length that was spoilt is as if the file was cut off there.
        let is_found = Replay::read(&path).map_or(true, |read| read.ticks() < sound.ticks() || !read.is_whole);
        prop_assert!(is_found, "byte {at}");
    }
}
