//! Who may do what, in scenes and in general.

use proptest::prelude::*;
use smallvec::smallvec;

use super::*;
use crate::data::ron_options;

const GOAL: Vec2 = Vec2::new(4.5, 0.0);

/// A robot that looks up the field, with the ball at its origin.
fn at(x: f32, y: f32) -> Standing {
    let (position, ball) = (Vec2::new(x, y), Vec2::ZERO);
    Standing { position, heading: 0.0, ball, tight_control: false, goal: GOAL, doing: None }
}

fn bids(robots: &[Standing]) -> Vec<Bid> {
    let rules = ActionArbitration::default();
    let bid = |(number, robot)| Bid { number, values: rules.values(robot).into(), age: 0.0 };
    (0..).zip(robots).map(bid).collect()
}

/// What each of some robots may do, all of whom know all values.
fn allowed(bids: &[Bid]) -> Vec<Option<PlayerAction>> {
    bids.iter().map(|bid| ActionArbitration::default().allowed(bid.number, bids)).collect()
}

use PlayerAction::{Acquire, Defend, Push, Support};

#[test]
fn the_highest_value_on_each_action_may_execute_it() {
    let robots = [at(-2.5, 0.0), at(-1.0, 0.8), at(-0.5, 0.0)];
    assert_eq!(allowed(&bids(&robots)), [Some(Defend), Some(Support), Some(Acquire)]);
}

#[test]
fn the_ball_is_worth_more_than_a_place_that_is_nearer() {
    // At the place behind the ball, and yet it is the nearest to the ball.
    let robots = [at(-1.2, 1.0), at(-3.0, 1.0), at(-4.0, 0.0)];
    assert_eq!(allowed(&bids(&robots))[0], Some(Acquire));
}

#[test]
fn the_robot_with_the_ball_has_priority_over_it_wherever_the_others_are() {
    // The other is at the best place there is, and was there first.
    let holder = Standing { tight_control: true, ..at(-0.3, 0.1) };
    let other = Standing { doing: Some(Acquire), ..at(-0.4, 0.0) };
    assert_eq!(allowed(&bids(&[other, holder])), [Some(Support), Some(Push)]);
    let turned = Standing { heading: 3.0, ..holder };
    assert_eq!(allowed(&bids(&[other, turned])), [Some(Support), Some(Acquire)], "it cannot push that way");
}

#[test]
fn of_equals_the_one_that_goes_already_goes_on() {
    let (left, right) = (at(-0.4, 1.0), at(-0.4, -1.0));
    assert_eq!(allowed(&bids(&[left, right]))[0], Some(Acquire), "else the lower number");
    let right = Standing { doing: Some(Acquire), ..right };
    assert_eq!(allowed(&bids(&[left, right]))[1], Some(Acquire));
    let nearer = at(-0.4, 0.3);
    assert_eq!(allowed(&bids(&[nearer, right]))[0], Some(Acquire), "but not for good");
}

#[test]
fn a_robot_of_whom_nothing_fresh_or_sound_was_heard_does_not_count() {
    let known = bids(&[at(-2.0, 0.0), at(-0.4, 0.0)]);
    let may = |change: fn(&mut Bid)| {
        let mut bids = known.clone();
        change(&mut bids[1]);
        ActionArbitration::default().allowed(0, &bids)
    };
    assert_ne!(may(|_| ()), Some(Acquire));
    assert_eq!(may(|bid| bid.age = 1.1), Some(Acquire));
    assert_eq!(may(|bid| bid.values.truncate(3)), Some(Acquire));
    assert_eq!(may(|bid| bid.values = smallvec![f32::NAN; 4]), Some(Acquire));
    assert_eq!(ActionArbitration::default().allowed(7, &known), None, "who bids for nothing gets nothing");
}

#[test]
fn every_constant_has_a_bound_and_the_lead_never_beats_the_holder() {
    let read = |text: &str| ron_options().from_str::<ActionArbitration>(text).unwrap().validate();
    assert_eq!(read("()"), Ok(()));
    assert_eq!(read("(half: 0)"), Err(Fault::new("half", "must be at least 0.001 m, not 0")));
    assert_eq!(read("(places: (guard: 2))"), Err(Fault::new("places.guard", "must be at most 1, not 2")));
    let lead = "must be less than possession, 0.5, or the robot with the ball has no priority";
    assert_eq!(read("(possession: 0.5, lead: 0.5)"), Err(Fault::new("lead", lead)));
}

fn standing() -> impl Strategy<Value = Standing> {
    let doing = prop::option::of(prop::sample::select(PlayerAction::ALL.to_vec()));
    (-4.5_f32..4.5, -2.5_f32..2.5, -3.2_f32..3.2, doing).prop_map(|(x, y, heading, doing)| Standing {
        heading,
        doing,
        ..at(x, y)
    })
}

proptest! {
    #[test]
    fn robots_that_know_the_same_values_never_do_the_same(
        robots in prop::collection::vec(standing(), 1..6),
    ) {
        let granted = allowed(&bids(&robots));
        let objects: Vec<Object> = granted.iter().flatten().map(|action| action.object()).collect();
        let twice = (0..objects.len()).any(|i| objects[..i].contains(&objects[i]));
        prop_assert!(!twice, "{granted:?}");
        prop_assert_eq!(objects.len(), robots.len().min(3), "and nobody is idle while something is to be done");
    }

    #[test]
    fn whoever_has_the_ball_may_handle_it_and_nobody_else(
        robots in prop::collection::vec(standing(), 1..6), holder in any::<prop::sample::Index>(),
    ) {
        let (mut robots, holder) = (robots.clone(), holder.index(robots.len()));
        robots[holder].tight_control = true;
        let granted = allowed(&bids(&robots));
        let handles = |number: usize| matches!(granted[number], Some(Push | Acquire));
        prop_assert!((0..robots.len()).all(|number| handles(number) == (number == holder)), "{granted:?}");
    }
}
