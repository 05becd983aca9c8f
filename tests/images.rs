//! Matches of robots that see nothing but pictures.

use std::f32::consts::{PI, TAU};
use std::sync::Arc;

use bevy::prelude::*;
use touchline::data::{AssetKind, DataError};
use touchline::game::requests::{Request, RequestLog, Requests, RobotChange};
use touchline::game::{Choice, Match, MatchPlan, Placed, Situation};
use touchline::geometry::{Pose, unit};
use touchline::ids::{RobotId, Team};
use touchline::mind::world_model::WorldModel;
use touchline::robot::CalibratedCamera;
use touchline::vision::{ColourClass, ColourTable, Resolution};
use touchline::world::ball::Ball;
use touchline::world::sense::{ImageEyes, ImageMemory, Lighting};

use crate::support::assets;

fn plan(file: &str, seed: u64) -> MatchPlan {
    let choice = Choice { file: Some(file.into()), half_minutes: Some(1.0), seed, ..Choice::default() };
    MatchPlan::read(&assets(), &choice).expect("the shipped files are sound")
}

/// What is found of a match while it is played on for so many ticks.
#[derive(Default)]
struct Found {
    /// Pictures in which a ball was recognised.
    balls: usize,
    /// Pictures that show a ball, and those of them in which one was recognised.
    shown: usize,
    recognised: usize,
    /// Of robots that know their place, how far off each is, m.
    places: Vec<f32>,
    /// Of robots that see the ball, how far off they believe it from where it is to them, m.
    sights: Vec<f32>,
}

/// Pixels of a ball that is in the picture for sure.
const ENOUGH: usize = 15;

fn play(game: &mut Match, ticks: u64) -> Found {
    let mut found = Found::default();
    play_on(game, ticks, &mut found);
    found
}

fn play_on(game: &mut Match, ticks: u64, found: &mut Found) {
    for _ in 0..ticks {
        game.tick();
        let attacking = Team::BOTH.map(|team| game.state().attacking(team));
        let tick = game.clock().tick - 1;
        let world = game.world_mut();
        let ball =
            world.query_filtered::<&Pose, With<Ball>>().single(world).expect("there is a ball").position;
        let mut robots = world.query::<(&RobotId, &Pose, &ImageEyes, &ImageMemory, &WorldModel)>();
        for (id, pose, eyes, memory, model) in robots.iter(world) {
            let Some(last) = memory.last().filter(|last| last.tick == tick) else { continue };
            let sees = last.recognised.ball.is_some();
            found.balls += usize::from(sees);
            if eyes.truth().filter(|class| *class == Some(ColourClass::Orange)).count() >= ENOUGH {
                found.shown += 1;
                found.recognised += usize::from(sees);
            }
            let ends = attacking[id.team.index()];
            if let Some(filtered) = memory.filter().pose().filter(|_| model.is_localised()) {
                found.places.push(ends.turn_pose(filtered).position.distance(pose.position));
            }
            if let Some(sighting) = last.recognised.ball {
                found.sights.push(sighting.placed(*pose).distance(ball));
            }
        }
    }
}

fn ask(game: &mut Match, request: Request) {
    game.world_mut().resource_mut::<Requests>().ask(request);
}

fn median(mut values: Vec<f32>) -> f32 {
    values.sort_unstable_by(f32::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f32::NAN)
}

#[test]
fn robots_find_ball_and_place_in_pictures() {
    for (file, place) in [("four_legged_images", 0.35), ("friendly_images", 0.5)] {
        let mut game = Match::new(&plan(file, 3));
        play(&mut game, 34 * 60);
        // So long that there are pictures enough to judge by.
        let mut found = Found::default();
        while found.shown <= 150 && !game.is_over() {
            play_on(&mut game, 60, &mut found);
        }
        let share = found.recognised as f32 / found.shown as f32;
        assert!(found.shown > 150 && share > 0.7, "{file}: {share} of {} balls", found.shown);
        let (places, sights) = (median(found.places), median(found.sights));
        assert!(places < place, "{file}: half of all robots are wrong by {places} m and more");
        assert!(sights < 0.15, "{file}: half of all sightings are wrong by {sights} m and more");
    }
}

/// All robots look at a ball that they stand around.
fn around_the_ball(plan: &MatchPlan) -> Situation {
    let robots: Vec<RobotId> = plan.robots().collect();
    let apart = TAU / robots.len() as f32;
    let placed = robots.into_iter().enumerate().map(|(place, id)| {
        let from_ball = apart * place as f32;
        let at = 0.8 * unit(from_ball);
        (id, Placed { pose: Pose::new(at.x, at.y, from_ball + PI), on: true })
    });
    Situation { refereed: false, robots: placed.collect(), ball: Vec2::ZERO, velocity: Vec2::ZERO }
}

#[test]
fn a_robot_without_colours_sees_nothing_and_one_that_gets_them_back_sees() {
    let mut plan = plan("four_legged_images", 3);
    plan.situation = Some(around_the_ball(&plan));
    let mut game = Match::new(&plan);
    let colours =
        plan.team(Team::Home).senses.calibration.as_ref().expect("it sees by pictures").colours.clone();
    let all = |colours: &ColourTable| {
        plan.robots()
            .map(|id| Request::Robot(id, RobotChange::SetColours(colours.clone())))
            .collect::<Vec<_>>()
    };
    let mut without = colours.clone();
    without.0.remove(&ColourClass::Orange);
    all(&without).into_iter().for_each(|request| ask(&mut game, request));
    assert_eq!(play(&mut game, 120).balls, 0);
    all(&colours).into_iter().for_each(|request| ask(&mut game, request));
    assert!(play(&mut game, 60).balls > 0);
}

#[test]
fn a_match_in_which_somebody_calibrates_is_played_again_from_its_requests() {
    let plan = plan("four_legged_images", 5);
    let robot = RobotId::new(Team::Away, 2);
    let mut settings =
        plan.team(Team::Away).senses.calibration.as_ref().expect("it sees by pictures").settings;
    (settings.gain, settings.resolution) = (1.7, Resolution::Half);
    let mut game = Match::new(&plan);
    game.world_mut().insert_resource(RequestLog::default());
    let dim = Lighting { brightness: 0.6, ..Lighting::default() };
    for (tick, request) in [
        (10, Request::Robot(robot, RobotChange::SetCamera(settings))),
        (20, Request::Robot(robot, RobotChange::SetColours(ColourTable::default()))),
        (30, Request::Light(dim)),
    ] {
        while game.clock().tick < tick {
            game.tick();
        }
        ask(&mut game, request);
    }
    play(&mut game, 90);
    let ticks = game.clock().tick;
    let requests = game.world().resource::<RequestLog>().0.clone();
    assert_eq!(requests.len(), 3);
    let mut again = Match::new(&MatchPlan { script: requests, ..plan });
    (0..ticks).for_each(|_| again.tick());
    assert_eq!(again.record().digest, game.record().digest);
    let world = again.world_mut();
    let mut cameras = world.query::<(&RobotId, &CalibratedCamera)>();
    let of_robot = |wanted: RobotId| {
        move |(id, camera): (&RobotId, &CalibratedCamera)| (*id == wanted).then(|| Arc::clone(&camera.0))
    };
    let camera = cameras.iter(world).find_map(of_robot(robot)).expect("it has one");
    assert_eq!((camera.settings, camera.colours.0.len()), (settings, 0));
}

/// The four-legged match, whose home team has this besides.
fn with_home(besides: &str) -> Result<MatchPlan, DataError> {
    let text =
        std::fs::read_to_string(assets().file(AssetKind::Match, "four_legged_2005")).expect("it is there");
    let changed = text.replacen("home: (", &format!("home: ({besides}, "), 1);
    assert_ne!(changed, text);
    let folder = tempfile::tempdir().expect("there is room for a file");
    let file = folder.path().join("mine.ron");
    std::fs::write(&file, changed).expect("there is room for a file");
    let file = Some(file.to_string_lossy().into_owned());
    MatchPlan::read(&assets(), &Choice { file, ..Choice::default() })
}

#[test]
fn one_robot_of_a_team_may_see_by_pictures() {
    let plan = with_home(r#"sensing_of: {2: "aibo_ers7_images"}"#).expect("it is sound");
    let mut game = Match::new(&plan);
    game.tick();
    let world = game.world_mut();
    let mut seers = world.query_filtered::<&RobotId, With<ImageMemory>>();
    assert_eq!(seers.iter(world).copied().collect::<Vec<_>>(), [RobotId::new(Team::Home, 2)]);
}

#[test]
fn senses_of_a_robot_that_is_not_there_or_that_no_file_has_are_told_with_their_place() {
    let error = |besides: &str| with_home(besides).expect_err("it is not sound").to_string();
    let nobody = error(r#"sensing_of: {4: "aibo_ers7_images"}"#);
    assert!(nobody.contains("home.sensing_of.4: the team has 4 players, from 0 on"), "{nobody}");
    let nothing = error(r#"sensing_of: {1: "nonesuch"}"#);
    assert!(nothing.contains("home.sensing_of.1: ") && nothing.contains("aibo_ers7_images"), "{nothing}");
}
