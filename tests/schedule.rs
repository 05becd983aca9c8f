//! The Tick schedule itself.

use bevy::prelude::*;
use touchline::game::Match;
use touchline::geometry::{Pose, Twist};
use touchline::ids::Team;

use crate::support::{friendly, robot};

/// Two systems that disturb each other without an order between them make the schedule fail to build.
#[test]
fn the_tick_has_no_ambiguities() {
    let mut game = Match::new(&friendly(1, 1.0));
    game.tick();
}

#[test]
#[should_panic(expected = "conflicting data access")]
fn an_ambiguous_system_is_refused() {
    let mut game = Match::new(&friendly(1, 1.0));
    game.world_mut().schedule_scope(touchline::schedule::Tick, |_, schedule| {
        schedule
            .add_systems(|mut poses: Query<&mut Pose>| poses.iter_mut().for_each(|mut p| p.heading = 0.0));
    });
    game.tick();
}

#[test]
#[cfg_attr(not(debug_assertions), ignore = "the check is in debug builds only")]
#[should_panic(expected = "is nowhere")]
fn a_body_that_is_nowhere_stops_a_debug_build() {
    let mut game = Match::new(&friendly(1, 1.0));
    game.world_mut().spawn((Name::new("ghost"), Pose::new(f32::NAN, 0.0, 0.0), Twist::default()));
    game.tick();
}

#[test]
fn robots_stand_still_until_play_begins() {
    let mut game = Match::new(&friendly(1, 1.0));
    for _ in 0..3 * 60 {
        game.tick();
        let (_, twist) = robot(&mut game, Team::Home, 3);
        assert!(twist.linear.length() < 1e-3, "{twist:?}");
    }
}
