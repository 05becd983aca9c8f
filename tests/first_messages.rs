//! What a robot says first is true: it says nothing that it has not sensed, be it fresh in the match or switched on again.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;
use touchline::clock::{Clock, TICK_HZ};
use touchline::comms::messages::{GoalieBehaviour, TeamMessage};
use touchline::comms::tcm::{Arrived, Data};
use touchline::data::AssetKind;
use touchline::game::requests::{Request, RobotChange};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::geometry::Pose;
use touchline::ids::{RobotId, Team};
use touchline::robot::{Eyes, OdometrySource, PlaceError, Restart, RobotFailure};

use crate::support::{assets, ball, robot};

/// The first message of each kind of each robot since it was switched on, with the tick in which it arrived.
#[derive(Resource, Default)]
struct Firsts(BTreeMap<(RobotId, &'static str), (u64, TeamMessage)>);

fn hear(arrived: On<Arrived<TeamMessage>>, clock: Res<Clock>, mut firsts: ResMut<Firsts>) {
    let from = arrived.from.robot().expect("robots speak to robots");
    let (known, _) = arrived.data.serialise();
    if !matches!(arrived.data, TeamMessage::RoleSwap(_)) {
        firsts.0.entry((from, known.name)).or_insert((clock.tick, arrived.data.clone()));
    }
}

/// The truth at a tick: of the robots in their team frames, and of the ball in the frame of either team.
struct Truth {
    robots: BTreeMap<RobotId, Pose>,
    ball: [Vec2; 2],
}

impl Truth {
    fn of(game: &mut Match, plan: &MatchPlan) -> Truth {
        let ends = Team::BOTH.map(|team| game.state().attacking(team));
        let poses = plan.robots().map(|id| {
            let (pose, _) = robot(game, id.team, id.number);
            (id, ends[id.team.index()].turn_pose(pose))
        });
        let robots = poses.collect();
        let (ball, _) = ball(game);
        Truth { robots, ball: ends.map(|end| end.turn(ball.position)) }
    }
}

/// The match of a shipped strategy against itself over a radio that loses nothing, which fells all robots in play and switches
/// them on again.
fn plan(strategy: &str) -> MatchPlan {
    let file = if strategy.starts_with("chaos") { "four_legged_2005" } else { "friendly" };
    let choice = Choice {
        file: Some(file.into()),
        home: Some(strategy.into()),
        away: Some(strategy.into()),
        radio: Some("perfect".into()),
        half_minutes: Some(0.5),
        seed: 11,
        ..Choice::default()
    };
    let mut plan = MatchPlan::read(&assets(), &choice).expect("the shipped files are sound");
    for team in &mut plan.teams {
        // A ball that the camera made up is sensed, but not near any truth.
        // And a robot that is blocked, pushed or carried errs by as much as it likes.
        if let Eyes::Real { camera, localisation, odometry } =
            &mut Arc::make_mut(&mut team.senses.sensing).eyes
        {
            camera.false_positive = 0.0;
            (localisation.landmarks, localisation.put_down) = (None, PlaceError::default());
            odometry.from = OdometrySource::Motion;
        }
    }
    for id in plan.robots().collect::<Vec<_>>() {
        let then = |tick, treatment| (tick, Request::Robot(id, treatment));
        plan.script.push(then(FALL, RobotChange::Fail(RobotFailure::Crashed)));
        plan.script.push(then(RISE, RobotChange::Revive(Restart::Lost)));
    }
    plan
}

const FALL: u64 = 1200;
const RISE: u64 = 1230;

/// How far what a robot says may lie from the truth: four deviations of its place, m, and of a sight, as a share of its length.
fn errors(plan: &MatchPlan, id: RobotId) -> (f32, f32) {
    match &plan.team(id.team).senses.sensing.eyes {
        Eyes::Perfect | Eyes::Images { .. } => (0.05, 0.05),
        Eyes::Real { camera, localisation, .. } => {
            (4.0 * localisation.position, 4.0 * (localisation.heading.to_radians() + camera.range_noise))
        }
    }
}

/// What is false about a message, given the truth by tick.
fn falsehood(plan: &MatchPlan, id: RobotId, message: &TeamMessage, truths: &[Truth]) -> Option<String> {
    let tick_of = |time: u32| ((f64::from(time) + 0.5) * 0.06).round() as usize;
    let own = |tick: usize| truths[tick].robots[&id].position;
    let ball = |tick: usize| truths[tick].ball[id.team.index()];
    let (error, sight) = errors(plan, id);
    let (is_true, truth) = match message {
        TeamMessage::Position(said) => {
            let truth = own(tick_of(said.time));
            (said.position.distance(truth) <= error, format!("it is at {truth}"))
        }
        TeamMessage::HaveBall(said) => {
            let now = tick_of(said.time);
            // A ball that it saw is where it was, or where it rolled from there, until the robot forgets it.
            let memory = plan.team(id.team).senses.sensing.memory.ball * TICK_HZ;
            let seen = now.saturating_sub(memory as usize)..=now;
            let distance = seen.map(|tick| own(now).distance(ball(tick))).fold(f32::INFINITY, f32::min);
            (
                said.have_ball && distance <= 1.0 + sight,
                format!("the ball was {distance} m away at its nearest"),
            )
        }
        TeamMessage::Goalie(said) => {
            let truth = own(tick_of(said.time));
            let area = plan.pitch.own_penalty_area();
            let is_true = match said.behaviour {
                GoalieBehaviour::Leaving => !area.grown(-error).contains(truth),
                GoalieBehaviour::Entering => area.grown(error).contains(truth),
            };
            (is_true, format!("it is at {truth}"))
        }
        TeamMessage::BallReport(said) => {
            let seen = tick_of(said.time.saturating_sub((said.age * 1000.0) as u32));
            let truth = ball(seen);
            let range = truth.distance(own(seen));
            (said.position.distance(truth) <= error + sight * range, format!("the ball is at {truth}"))
        }
        TeamMessage::Book(_) | TeamMessage::Values(_) | TeamMessage::RoleSwap(_) | TeamMessage::Text(_) => {
            return None;
        }
    };
    (!is_true).then_some(truth)
}

/// Plays a match and checks the first messages of every life of every robot; returns how many there were.
fn check(strategy: &str) -> usize {
    let plan = plan(strategy);
    let mut game = Match::new(&plan);
    game.world_mut().init_resource::<Firsts>();
    game.world_mut().add_observer(hear);
    let (mut truths, mut checked) = (Vec::new(), 0);
    while !game.is_over() {
        truths.push(Truth::of(&mut game, &plan));
        if game.clock().tick == RISE {
            checked += check_firsts(strategy, &plan, &mut game, &truths);
        }
        game.tick();
    }
    checked + check_firsts(strategy, &plan, &mut game, &truths)
}

fn check_firsts(strategy: &str, plan: &MatchPlan, game: &mut Match, truths: &[Truth]) -> usize {
    let firsts = std::mem::take(&mut *game.world_mut().resource_mut::<Firsts>()).0;
    for ((id, kind), (tick, message)) in &firsts {
        let truth = falsehood(plan, *id, message, truths);
        assert_eq!(truth, None, "{strategy}: {id} says in tick {tick}: {message:?}");
        let placed = firsts.get(&(*id, "position")).map(|(tick, _)| *tick);
        assert!(Some(*tick) >= placed && placed.is_some(), "{strategy}: {id} says {kind} before its place");
    }
    firsts.len()
}

#[test]
fn the_first_message_of_each_kind_is_true_or_not_sent() {
    let strategies = assets().names(AssetKind::Strategy);
    let checked: BTreeMap<&str, usize> =
        strategies.iter().map(|strategy| (strategy.as_str(), check(strategy))).collect();
    assert!(checked.len() >= 8, "{checked:?}");
    // Where robots and have-ball or booking come twice from each of eight.
    assert!(checked.values().sum::<usize>() > 200, "{checked:?}");
}
