//! A match that is put back to an earlier tick, or into another world, plays on as it did.

use std::collections::BTreeMap;

use bevy::prelude::*;
use touchline::game::{Choice, Match, MatchPlan};
use touchline::rng::{Dice, Seed};
use touchline::robot::Head;
use touchline::schedule::{Tick, TickSystems};
use touchline::state::{Snapshot, replay};

use crate::support::{assets, friendly};

/// Minutes of a half.
const HALF: f32 = 0.2;
/// Ticks of each match from which it is played again.
const LOOKS: usize = 20;

fn plan(file: &str, radio: &str, home: &str, away: &str) -> MatchPlan {
    let name = |name: &str| Some(name.to_owned());
    let choice = Choice {
        file: name(file),
        radio: name(radio),
        home: name(home),
        away: name(away),
        half_minutes: Some(HALF),
        seed: 5,
        ..Choice::default()
    };
    MatchPlan::read(&assets(), &choice).expect("the shipped files are sound")
}

fn tick(world: &mut World) {
    world.run_schedule(Tick);
}

fn finish(game: &mut Match) -> u64 {
    while !game.is_over() {
        game.tick();
    }
    game.record().digest
}

/// Copies a match at random ticks, then puts it back to each of them and plays it to its end: in the same world, and in another
/// one where it had just begun.
fn check(plan: &MatchPlan) {
    check_at(plan, LOOKS);
}

/// As [`check`], at so many ticks.
fn check_at(plan: &MatchPlan, looks: usize) {
    let mut game = Match::new(plan);
    let mut dice = Dice::new(Seed(plan.seed), "looks", None);
    let most = 2.0 * HALF * 60.0 * 60.0;
    let mut ticks: Vec<u64> = (0..looks).map(|_| (dice.uniform() * most) as u64).collect();
    ticks.sort_unstable();
    let mut snapshots = Vec::new();
    for tick in ticks {
        while game.clock().tick < tick {
            game.tick();
        }
        snapshots.push(Snapshot::take(game.world_mut()));
    }
    let digest = finish(&mut game);
    let end = Snapshot::take(game.world_mut());
    for (number, snapshot) in snapshots.iter().enumerate() {
        let mut fresh = Match::new(plan);
        let again = if number % 2 == 0 { &mut game } else { &mut fresh };
        snapshot.restore(again.world_mut()).expect("it is the same match");
        let tick = again.clock().tick;
        assert!(finish(again) == digest, "the match parted after tick {tick}");
        let difference = end.difference(&Snapshot::take(again.world_mut()));
        assert!(difference.is_none(), "after tick {tick}: {}", difference.expect("there is one"));
    }
}

#[test]
fn trailers_with_a_perfect_radio_play_on_from_any_tick() {
    check(&plan("friendly", "perfect", "hammerheads_swap", "hammerheads_2001"));
}

#[test]
fn trailers_with_an_awful_radio_play_on_from_any_tick() {
    check(&plan("friendly", "awful", "hammerheads_2001", "hammerheads_swap"));
}

#[test]
fn trailers_without_a_word_play_on_from_any_tick() {
    check(&plan("friendly", "perfect", "ball_chasers", "hammerheads_2001"));
}

#[test]
fn dogs_that_book_the_ball_play_on_from_any_tick() {
    check(&plan("four_legged_2005", "perfect", "chaos_b3p", "hammerheads_swap"));
}

#[test]
fn dogs_that_book_the_ball_over_an_awful_radio_play_on_from_any_tick() {
    check(&plan("four_legged_2005", "awful", "hammerheads_swap", "chaos_b3p"));
}

#[test]
fn dogs_that_chase_the_ball_play_on_from_any_tick() {
    check(&plan("four_legged_2005", "awful", "ball_chasers", "chaos_b3p"));
}

#[test]
fn a_dog_that_sees_by_pictures_plays_on_from_any_tick() {
    let mut plan = plan("four_legged_images", "good", "chaos_b3p", "chaos_b3p");
    // Pictures take their time: one robot sees by them, and it goes for the ball, and few ticks are looked at.
    let of_model = self::plan("four_legged_2005", "good", "chaos_b3p", "chaos_b3p").teams[0].senses.clone();
    let of_pictures = plan.teams[0].senses.clone();
    for team in &mut plan.teams {
        (team.senses, team.senses_of) = (of_model.clone(), BTreeMap::new());
    }
    plan.teams[0].senses_of.insert(2, of_pictures);
    check_at(&plan, 4);
}

#[test]
fn a_snapshot_is_put_back_into_its_own_match_only() {
    let mut dogs = Match::new(&plan("four_legged_2005", "good", "chaos_b3p", "chaos_b3p"));
    let mut fewer = Match::new(&friendly(1, HALF));
    fewer.tick();
    let before = Snapshot::take(fewer.world_mut());
    let error = Snapshot::take(dogs.world_mut()).restore(fewer.world_mut()).expect_err("it is another match");
    assert!(error.to_string().contains("trailer"), "{error}");
    assert_eq!(before.difference(&Snapshot::take(fewer.world_mut())), None);
}

#[test]
fn equal_states_have_equal_digests_and_a_tick_makes_another() {
    let [mut one, mut other] = [3, 3].map(|seed| Match::new(&friendly(seed, HALF)));
    let digest = |game: &mut Match| Snapshot::take(game.world_mut()).digest();
    assert_eq!(digest(&mut one), digest(&mut other));
    one.tick();
    assert_ne!(digest(&mut one), digest(&mut other));
    other.tick();
    assert_eq!(digest(&mut one), digest(&mut other));
}

#[test]
fn each_tick_of_a_match_comes_out_the_same_twice() {
    let mut game = Match::new(&plan("friendly", "awful", "hammerheads_swap", "hammerheads_swap"));
    while game.clock().tick < 300 {
        let difference = replay(game.world_mut(), tick).expect("nothing joins");
        assert_eq!(difference, None, "in tick {}", game.clock().tick);
    }
}

/// A counter that no snapshot knows.
fn turn_heads_more_and_more(mut turned: Local<f32>, mut heads: Query<&mut Head>) {
    *turned += 0.1;
    heads.iter_mut().for_each(|mut head| head.pan = *turned);
}

#[test]
fn the_first_thing_that_does_not_repeat_itself_is_named() {
    let mut game = Match::new(&friendly(1, HALF));
    game.world_mut().schedule_scope(Tick, |_, schedule| {
        schedule.add_systems(turn_heads_more_and_more.in_set(TickSystems::Record));
    });
    let difference = replay(game.world_mut(), tick).expect("nothing joins").expect("a counter went on");
    assert_eq!(difference.to_string(), "robot away 0's Head: `pan: 0.1,` and then `pan: 0.2,`");
}
