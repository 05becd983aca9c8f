//! What touching another robot costs in a match: legs that lock, falls, and nothing at all where the robot kind says so.

use std::collections::BTreeMap;
use std::f32::consts::PI;
use std::sync::Arc;

use bevy::prelude::*;
use touchline::game::requests::{Request, Requests};
use touchline::game::{Choice, Match, MatchPlan, Placed, Situation};
use touchline::geometry::Pose;
use touchline::ids::{RobotId, Team};
use touchline::robot::handling::Handling;
use touchline::robot::pilot::Pilot;
use touchline::robot::{ContactCost, Falls, Footing, KickIntent, RobotKind};
use touchline::world::ContactImpulses;
use touchline::world::{BodyEvent, BodyEvents};

use crate::support::{assets, digest_of, robot};

/// The four-legged match between robots with this cost of contact, whose kicks do not mind bumps.
fn plan(contact: Option<ContactCost>) -> MatchPlan {
    let choice = Choice { file: Some("four_legged_2005".into()), seed: 1, ..Choice::default() };
    let mut plan = MatchPlan::read(&assets(), &choice).expect("the shipped match is sound");
    for team in &mut plan.teams {
        team.kind = Arc::new(RobotKind { contact, strike: None, ..RobotKind::clone(&team.kind) });
    }
    plan
}

fn shipped() -> ContactCost {
    let choice = Choice { file: Some("four_legged_2005".into()), ..Choice::default() };
    let plan = MatchPlan::read(&assets(), &choice).expect("the shipped match is sound");
    plan.teams[0].kind.contact.expect("an AIBO's contacts cost something")
}

/// Two robots that look at each other, nose to nose, with the ball far away.
fn nose_to_nose(contact: ContactCost) -> Match {
    let mut plan = plan(Some(contact));
    let start = |x: f32, heading| Placed { pose: Pose::new(x, 0.0, heading), on: true };
    let robots = BTreeMap::from([
        (RobotId::new(Team::Home, 1), start(-0.16, 0.0)),
        (RobotId::new(Team::Away, 1), start(0.16, PI)),
    ]);
    let ball = Vec2::new(0.0, 1.5);
    plan.situation = Some(Situation { refereed: false, robots, ball, velocity: Vec2::ZERO });
    let mut game = Match::new(&plan);
    for team in Team::BOTH {
        game.world_mut().resource_mut::<Requests>().ask(Request::TakeOver(RobotId::new(team, 1)));
    }
    game
}

/// Both are driven alike for a tick; returns who fell.
fn drive(game: &mut Match, pilot: Pilot) -> Vec<Team> {
    for team in Team::BOTH {
        let robot = RobotId::new(team, 1);
        game.world_mut().resource_mut::<Requests>().ask(Request::Steer { robot, pilot });
    }
    game.tick();
    let events = &game.world().resource::<BodyEvents>().0;
    events.iter().filter(|(_, event)| *event == BodyEvent::Fell).map(|(robot, _)| robot.team).collect()
}

fn footing(game: &mut Match, team: Team) -> Footing {
    let mut robots = game.world_mut().query::<(&RobotId, &Footing)>();
    let found = robots.iter(game.world()).find(|(id, _)| **id == RobotId::new(team, 1));
    found.expect("the robot is in the match").1.clone()
}

const AHEAD: Pilot = Pilot { throttle: 1.0, aside: 0.0, turn: 0.0, kick: KickIntent::Nothing, head: None };

#[test]
fn robots_that_press_against_each_other_are_entangled_until_they_part() {
    let mut game = nose_to_nose(ContactCost { falls: None, ..shipped() });
    let touching = |game: &Match| game.world().resource::<ContactImpulses>().robots.len();
    let touched: usize = (0..60).map(|_| (drive(&mut game, AHEAD), touching(&game)).1).sum();
    assert!(touched > 30, "they touch in {touched} of 60 ticks");
    let strain = footing(&mut game, Team::Home).strain;
    assert!(strain > 0.8, "{strain}");
    (0..120).for_each(|_| drop(drive(&mut game, Pilot { throttle: -1.0, ..AHEAD })));
    assert_eq!(touching(&game), 0);
    let strain = footing(&mut game, Team::Away).strain;
    assert!(strain < 0.05, "{strain}");
}

#[test]
fn the_less_is_left_the_slower_an_entangled_robot_gets_away() {
    let way = [1.0, 0.6, 0.3].map(|left| {
        let mut game = nose_to_nose(ContactCost { left, falls: None, stagger: 0.0, ..shipped() });
        (0..60).for_each(|_| drop(drive(&mut game, AHEAD)));
        (0..90).for_each(|_| drop(drive(&mut game, Pilot { throttle: -1.0, ..AHEAD })));
        -robot(&mut game, Team::Home, 1).0.position.x - 0.15
    });
    assert!(way[0] > 1.03 * way[1] && way[1] > 1.03 * way[2] && way[2] > 0.0, "{way:?}");
}

#[test]
fn a_fallen_robot_neither_walks_nor_kicks_until_it_stands_again() {
    let falls = Falls { rate: 5.0, down: (3.0, 3.5) };
    let mut game = nose_to_nose(ContactCost { falls: Some(falls), ..shipped() });
    let fell = (0..300).any(|_| drive(&mut game, AHEAD).contains(&Team::Home));
    assert!(fell && !footing(&mut game, Team::Home).stands());
    (0..60).for_each(|_| drop(drive(&mut game, Pilot { throttle: -1.0, ..AHEAD })));
    let before = robot(&mut game, Team::Home, 1).0;
    (0..60).for_each(|_| {
        drive(&mut game, Pilot { throttle: -1.0, kick: KickIntent::Hold, ..AHEAD });
        let mut handling = game.world_mut().query::<(&RobotId, &Handling)>();
        let home = handling.iter(game.world()).find(|(id, _)| id.team == Team::Home).expect("it plays");
        assert!(!home.1.is_busy() && !home.1.holds());
    });
    let after = robot(&mut game, Team::Home, 1).0;
    assert!(before.position.distance(after.position) < 0.01, "{before:?} {after:?}");
    (0..150).for_each(|_| drop(drive(&mut game, Pilot { throttle: -1.0, ..AHEAD })));
    assert!(footing(&mut game, Team::Home).stands());
    let away = robot(&mut game, Team::Home, 1).0;
    assert!(after.position.distance(away.position) > 0.05, "{after:?} {away:?}");
}

#[test]
fn contact_that_leaves_everything_is_no_contact_cost_at_all() {
    let digest = |contact| {
        let mut plan = plan(contact);
        plan.rules.half_minutes = 1.0;
        digest_of(&plan)
    };
    let free = digest(Some(ContactCost { left: 1.0, ..shipped() }));
    assert_eq!(free, digest(None));
    assert_ne!(free, digest(Some(shipped())));
}
