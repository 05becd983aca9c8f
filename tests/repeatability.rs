//! Seed, assets and requests determine a match, bit for bit.

use std::sync::Arc;

use touchline::game::requests::{Request, Requests};
use touchline::game::{Match, start_match};
use touchline::ids::{RobotId, Team};
use touchline::robot::pilot::Pilot;

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
    let slow = changed_strategy("ball_chasers", "speed: 0.7", "speed: 0.1");
    let mut game = Match::new(&plan);
    while !game.is_over() {
        if game.clock().tick == 600 {
            let request = Request::ChangeStrategy { team: Team::Away, strategy: Arc::clone(&slow) };
            game.world_mut().resource_mut::<Requests>().ask(request);
        }
        game.tick();
    }
    assert_ne!(game.record().digest, digest_of(&plan));
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
