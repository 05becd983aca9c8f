//! Seed, assets and requests determine a match, bit for bit.

use std::sync::Arc;

use bevy::prelude::Vec2;
use touchline::game::requests::{
    BodyChange, Calibration, RadioChange, Request, RequestLog, Requests, RobotChange,
};
use touchline::game::{Match, MatchPlan, start_match};
use touchline::ids::{RobotId, Team};
use touchline::robot::pilot::Pilot;
use touchline::robot::{Restart, RobotFailure};

use crate::support::{changed_strategy, digest_of, friendly, robot};

#[test]
fn equal_seeds_give_equal_matches_and_other_seeds_others() {
    let first = digest_of(&friendly(7, 0.5));
    assert_eq!(first, digest_of(&friendly(7, 0.5)), "the same match went another way");
    assert_ne!(first, digest_of(&friendly(8, 0.5)));
}

#[test]
fn a_restarted_world_plays_the_same_match() {
    let plan = friendly(3, 0.5);
    let mut game = Match::new(&friendly(4, 0.5));
    for _ in 0..1000 {
        game.tick();
    }
    start_match(game.world_mut(), &plan);
    while !game.is_over() {
        game.tick();
    }
    assert_eq!(game.record().digest, digest_of(&plan), "something survived the restart");
}

#[test]
fn changing_a_weight_in_the_file_changes_the_play() {
    let plan = friendly(7, 0.5);
    let mut changed = plan.clone();
    changed.teams[0].strategy = changed_strategy("hammerheads_2001", "(1.0, \"dock\")", "(0.9, \"dock\")");
    assert_ne!(digest_of(&plan), digest_of(&changed));
}

#[test]
fn a_comment_in_the_file_changes_nothing() {
    let plan = friendly(7, 0.2);
    let mut changed = plan.clone();
    changed.teams[0].strategy = changed_strategy("hammerheads_2001", "players:", "/* line-up */ players:");
    assert_eq!(digest_of(&plan), digest_of(&changed));
}

#[test]
fn a_weight_that_is_set_during_the_match_acts_from_the_next_tick_on() {
    let plan = friendly(7, 0.3);
    let play = |weight: Option<f32>| {
        let mut game = Match::new(&plan);
        while !game.is_over() {
            if let (600, Some(weight)) = (game.clock().tick, weight) {
                let request = Request::SetWeight { team: Team::Home, assemblage: 0, term: 0, weight };
                game.world_mut().resource_mut::<Requests>().ask(request);
            }
            game.tick();
        }
        game.record().digest
    };
    assert_eq!(play(Some(2.0)), play(Some(2.0)));
    assert_ne!(play(Some(2.0)), play(None));
}

#[test]
fn a_strategy_can_be_exchanged_during_the_match() {
    let plan = friendly(7, 0.3);
    let slow = changed_strategy("ball_chasers", "speed: 0.85", "speed: 0.1");
    let mut game = Match::new(&plan);
    while !game.is_over() {
        if game.clock().tick == 600 {
            let request = Request::ChangeStrategy {
                team: Team::Away,
                strategy: Arc::clone(&slow),
                texts: Arc::default(),
            };
            game.world_mut().resource_mut::<Requests>().ask(request);
        }
        game.tick();
    }
    assert_ne!(game.record().digest, digest_of(&plan));
}

#[test]
fn a_match_with_people_and_changed_files_is_played_again_from_its_requests() {
    let (pilot, other) = (RobotId::new(Team::Away, 3), RobotId::new(Team::Home, 1));
    let levers = |throttle| Pilot { throttle, turn: 0.5, ..Pilot::default() };
    let slow = changed_strategy("hammerheads_2001", "(1.0, \"dock\")", "(0.5, \"dock\")");
    let plan = friendly(7, 0.3);
    let team = &plan.teams[0];
    let mut kind = team.kind.as_ref().clone();
    kind.body.friction *= 0.5;
    let calibration = Calibration { kind: Arc::new(kind), sensing: team.senses.sensing.clone() };
    let asked = |tick: u64| match tick {
        400 => vec![Request::TakeOver(pilot), Request::Steer { robot: pilot, pilot: levers(1.0) }],
        500 => vec![
            Request::SetWeight { team: Team::Home, assemblage: 0, term: 0, weight: 2.0 },
            Request::ChangeStrategy { team: Team::Home, strategy: slow.clone(), texts: Arc::default() },
            Request::Radio(RadioChange::ExtraLoss(0.5)),
        ],
        600 => vec![
            Request::Steer { robot: pilot, pilot: levers(-0.5) },
            Request::Robot(other, RobotChange::Recalibrate(calibration.clone())),
            Request::Robot(other, RobotChange::Fail(RobotFailure::Crashed)),
        ],
        700 => vec![
            Request::Robot(other, RobotChange::Revive(Restart::Lost)),
            Request::HandBack(pilot),
            Request::Body(BodyChange::Push { robot: pilot, by: Vec2::new(0.3, 0.1) }),
            Request::Robot(RobotId::new(Team::Away, 1), RobotChange::Penalise),
        ],
        _ => Vec::new(),
    };
    let mut game = Match::new(&plan);
    game.world_mut().insert_resource(RequestLog::default());
    while !game.is_over() {
        let tick = game.clock().tick;
        let mut requests = game.world_mut().resource_mut::<Requests>();
        asked(tick).into_iter().for_each(|request| requests.ask(request));
        game.tick();
    }
    let RequestLog(requests) = game.world().resource::<RequestLog>().clone();
    assert_eq!(requests.len(), 12);
    assert_ne!(game.record().digest, digest_of(&plan));
    let again = MatchPlan { script: requests, ..plan };
    assert_eq!(game.record().digest, digest_of(&again));
}

#[test]
fn a_pilot_drives_within_the_limits_of_the_robot_and_hands_it_back() {
    let id = RobotId::new(Team::Away, 3);
    let mut plan = friendly(2, 0.5);
    plan.pilot = Some(id);
    let mut game = Match::new(&plan);
    let mut fastest = 0.0f32;
    for tick in 0..600 {
        let pilot = Pilot { throttle: 9.0, turn: f32::NAN, ..Pilot::default() };
        let request = match tick {
            0..500 => Request::Steer { robot: id, pilot },
            _ => Request::HandBack(id),
        };
        game.world_mut().resource_mut::<Requests>().ask(request);
        game.tick();
        fastest = fastest.max(robot(&mut game, Team::Away, 3).1.linear.length());
    }
    assert!((0.5..1.0).contains(&fastest), "{fastest} m/s");
    let mut pilots = game.world_mut().query::<&Pilot>();
    assert_eq!(pilots.iter(game.world()).count(), 0);
}
