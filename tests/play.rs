//! Whole matches: nobody leaves the pitch, nobody hangs, goals are scored.

use std::sync::Arc;

use bevy::prelude::*;
use touchline::data::{AssetKind, Source};
use touchline::game::record::Invariants;
use touchline::game::{Match, MatchPlan};
use touchline::geometry::Pose;
use touchline::ids::RobotId;
use touchline::mind::world_model::WorldModel;
use touchline::pitch::Pitch;
use touchline::robot::{OffPitch, Robot, Sensing, SteeringIntent};
use touchline::strategy::Strategy;
use touchline::world::referee::Phase;

use crate::support::{assets, ball, friendly, strategy_text};

/// What was noticed about a match.
struct Noticed {
    goals: u32,
    /// The longest time that a robot meant to drive without getting anywhere, s.
    longest_stuck: f64,
}

/// A robot that means to drive counts as stuck while it stays within this distance, m.
const STUCK_RADIUS: f32 = 0.2;

/// One robot's attempts to get anywhere.
struct Progress {
    robot: RobotId,
    anchor: Vec2,
    ticks: u32,
    driving: u32,
}

fn watch(plan: &MatchPlan) -> Noticed {
    let mut game = Match::new(plan);
    let mut progress: Vec<Progress> =
        (plan.robots()).map(|robot| Progress { robot, anchor: Vec2::ZERO, ticks: 0, driving: 0 }).collect();
    let mut longest = 0;
    while !game.is_over() {
        game.tick();
        let (ball, _) = ball(&mut game);
        assert!(plan.pitch.holds(ball.position, 0.0), "seed {}: the ball is at {}", plan.seed, ball.position);
        longest = longest.max(look_at_robots(&mut game, &mut progress));
    }
    Noticed { goals: game.state().score.iter().sum(), longest_stuck: f64::from(longest) / 60.0 }
}

/// Ticks for which the most unlucky robot has been stuck.
fn look_at_robots(game: &mut Match, progress: &mut [Progress]) -> u32 {
    let playing = game.state().phase == Phase::Playing;
    let mut robots =
        game.world_mut().query_filtered::<(&RobotId, &Pose, &SteeringIntent), Without<OffPitch>>();
    let pitch = game.world().resource::<Pitch>();
    let mut longest = 0;
    for (id, pose, intent) in robots.iter(game.world()) {
        assert!(pitch.holds(pose.position, 0.0), "{id} is at {}", pose.position);
        let Some(own) = progress.iter_mut().find(|own| own.robot == *id) else { continue };
        if !playing || own.anchor.distance(pose.position) > STUCK_RADIUS {
            (own.anchor, own.ticks, own.driving) = (pose.position, 0, 0);
        }
        own.ticks += 1;
        own.driving += u32::from(matches!(intent, SteeringIntent::Steer { speed, .. } if *speed != 0.0));
        if own.driving * 2 > own.ticks {
            longest = longest.max(own.ticks);
        }
    }
    longest
}

#[test]
fn whole_matches_have_goals_and_nobody_leaves_or_hangs() {
    let mut with_goals = 0;
    for seed in 1..=6 {
        let noticed = watch(&friendly(seed, 5.0));
        println!("seed {seed}: {} goals, stuck for {:.1} s at most", noticed.goals, noticed.longest_stuck);
        with_goals += u32::from(noticed.goals > 0);
        assert!(noticed.longest_stuck < 30.0, "seed {seed}: stuck for {:.0} s", noticed.longest_stuck);
    }
    assert!(with_goals > 4, "goals in {with_goals} of 6 matches only");
}

#[test]
fn perfect_sensing_is_a_switch() {
    let source = Source::read(assets().file(AssetKind::Sensing, "perfect")).expect("the preset can be read");
    let perfect: Arc<Sensing> = Arc::new(source.parse().expect("the preset is sound"));
    let mut plan = friendly(1, 0.5);
    plan.teams.iter_mut().for_each(|team| team.senses.sensing = perfect.clone());
    let mut game = Match::new(&plan);
    let mut checked = 0;
    while !game.is_over() {
        // What robots believe when they decide is what was true when the tick began.
        let (truth, _) = ball(&mut game);
        let ends = game.state().clone();
        let decided = game.clock();
        game.tick();
        if ends.phase != Phase::Playing || game.state().phase != Phase::Playing {
            continue;
        }
        let mut robots = game.world_mut().query::<(&RobotId, &Robot, &WorldModel)>();
        for (id, robot, model) in robots.iter(game.world()) {
            let Some(belief) = model.ball.filter(|_| robot.decides(&decided)) else { continue };
            let truth = ends.attacking(id.team).turn(truth.position);
            assert!(belief.position.distance(truth) < 0.01, "{id} believes {} not {truth}", belief.position);
            checked += 1;
        }
    }
    assert!(checked > 1000);
}

#[test]
fn teams_of_eleven_play() {
    let (path, text) = strategy_text("ball_chasers");
    let four = r#"["front_left", "back_left", "back_right", "front_right"]"#;
    let names = ["front_left", "back_left", "back_right", "front_right"].iter().cycle().take(11);
    let place = |i: u32| format!("({:?}, {:?})", -1.0 - f64::from(i / 4), 1.6 - f64::from(i % 4));
    let places = format!("[{}]", (0..11).map(place).collect::<Vec<_>>().join(", "));
    let kick_off = text.find("ours: [").and_then(|from| Some(from..from + text[from..].find("features:")?));
    let kick_off = kick_off.expect("it has a kick-off");
    let text = text.replacen(&text[kick_off], &format!("ours: {places}, theirs: {places}), "), 1);
    let text = text.replacen(four, &format!("{:?}", names.collect::<Vec<_>>()), 1);
    let strategy =
        Arc::new(Strategy::parse(&assets(), &Source::new(path, text), None).expect("eleven are allowed"));
    let mut plan = friendly(1, 0.5);
    for team in &mut plan.teams {
        team.strategy = strategy.clone();
    }
    assert_eq!(plan.robots().count(), 22);
    let mut game = Match::new(&plan);
    while !game.is_over() {
        game.tick();
    }
    let driven = &game.record().driven;
    assert!(driven.len() == 22 && driven.iter().all(|(_, way)| *way > 0.5), "{driven:?}");
    assert!(game.world().resource::<Invariants>().broken.is_empty());
}
