//! From vectors to a steering intent.

use std::f32::consts::{FRAC_PI_2, PI};

use super::*;
use crate::mind::perception::fixture::Situation;
use crate::strategy::language::{Point, Schema};
use crate::strategy::{Assemblage, Combination, Influence, Term};
use crate::testing::{idle, strategy};

/// The odometry's heading, which has nothing to do with where the robot believes it looks.
const ODOMETRY: f32 = 1.0;

fn driving(speed: f32) -> State {
    let (name, transitions) = ("test".into(), vec![]);
    State {
        name,
        assemblage: Some(0),
        speed,
        reverse: false,
        turn: Turn::Stay,
        acquires: false,
        hold: false,
        kicks: vec![],
        transitions,
        within: vec![],
    }
}

/// What a robot intends that looks along +y with the ball at (2, 0).
fn intent(sum: Vec2, state: &State) -> SteeringIntent {
    let here = Situation::at(0.0, 0.0, 90.0).ball(2.0, 0.0);
    intend(sum, state, &here.senses(), &mut Memory::new(0), ODOMETRY)
}

/// The turn to the wanted heading, rad, and the speed.
#[track_caller]
fn steered(intent: SteeringIntent) -> (f32, f32) {
    match intent {
        SteeringIntent::Steer { heading, speed, .. } => (wrap_angle(heading - ODOMETRY), speed),
        _ => panic!("{intent:?} does not steer"),
    }
}

#[track_caller]
fn assert_steers(intent: SteeringIntent, turn: f32, speed: f32) {
    let got = steered(intent);
    let off = wrap_angle(got.0 - turn).abs();
    assert!(off < 1e-5 && (got.1 - speed).abs() < 1e-6, "got {got:?}, want {:?}", (turn, speed));
}

#[test]
fn a_robot_steers_along_the_sum_at_its_length_times_the_speed_of_the_activity() {
    assert_steers(intent(Vec2::new(0.0, 0.5), &driving(0.8)), 0.0, 0.4);
    assert_steers(intent(Vec2::new(0.5, 0.0), &driving(1.0)), -FRAC_PI_2, 0.5);
    assert_steers(intent(Vec2::new(-3.0, 0.0), &driving(0.8)), FRAC_PI_2, 0.8);
}

#[test]
fn a_sum_that_is_short_means_to_crawl_and_a_shorter_one_to_stand_still() {
    assert_steers(intent(Vec2::new(0.0, STANDSTILL), &driving(0.8)), 0.0, CRAWL * 0.8);
    assert_steers(intent(Vec2::new(0.0, CRAWL - 0.01), &driving(0.8)), 0.0, CRAWL * 0.8);
    assert_eq!(intent(Vec2::new(0.0, STANDSTILL - 0.001), &driving(0.8)), SteeringIntent::Stop);
}

#[test]
fn the_turn_is_the_short_way_round_across_half_a_turn() {
    let here = Situation::at(0.0, 0.0, 170.0);
    let sum = crate::geometry::unit(-170f32.to_radians());
    let intent = intend(sum, &driving(1.0), &here.senses(), &mut Memory::new(0), 3.1);
    let SteeringIntent::Steer { heading, .. } = intent else { panic!("{intent:?}") };
    assert!((heading - 3.1 - 20f32.to_radians()).abs() < 1e-5, "{heading}");
}

#[test]
fn in_reverse_the_rear_leads_along_the_sum() {
    let reverse = State { reverse: true, ..driving(0.5) };
    assert_steers(intent(Vec2::new(0.0, -1.0), &reverse), 0.0, -0.5);
    assert_steers(intent(Vec2::new(1.0, 0.0), &reverse), FRAC_PI_2, -0.5);
    assert_eq!(intent(Vec2::ZERO, &reverse), SteeringIntent::Stop, "an assemblage that wants nothing");
}

#[test]
fn without_an_assemblage_a_robot_in_reverse_backs_straight_off() {
    let back_off = State { assemblage: None, reverse: true, ..driving(0.4) };
    assert_steers(intent(Vec2::ZERO, &back_off), 0.0, -0.4);
    let rest = State { reverse: false, ..back_off };
    assert_eq!(intent(Vec2::ZERO, &rest), SteeringIntent::Stop);
}

#[test]
fn a_standing_robot_turns_as_its_activity_says_and_a_driving_one_does_not() {
    let spinning = State { turn: Turn::Spin(-2.0), ..driving(1.0) };
    assert_eq!(intent(Vec2::ZERO, &spinning), SteeringIntent::Spin(-2.0));
    assert_steers(intent(Vec2::Y, &spinning), 0.0, 1.0);
    let facing = |point| State { turn: Turn::Face(point), ..driving(1.0) };
    assert_steers(intent(Vec2::ZERO, &facing(Point::Ball)), -FRAC_PI_2, 0.0);
    assert_steers(intent(Vec2::new(0.0, -1.0), &facing(Point::Ball)), PI, 1.0);
}

#[test]
fn a_robot_cannot_turn_to_what_it_does_not_know_or_stands_on() {
    let facing = |point| State { turn: Turn::Face(point), ..driving(1.0) };
    assert_eq!(intent(Vec2::ZERO, &facing(Point::Own)), SteeringIntent::Stop);
    let blind = Situation::at(0.0, 0.0, 90.0);
    let intent = intend(Vec2::ZERO, &facing(Point::Ball), &blind.senses(), &mut Memory::new(0), ODOMETRY);
    assert_eq!(intent, SteeringIntent::Stop);
}

fn combined(combination: Combination, terms: &[(f32, Schema)]) -> Contributions {
    let term = |(weight, schema): &(f32, Schema)| Term {
        weight: *weight,
        name: "term".into(),
        influence: Influence::Schema(schema.clone()),
    };
    let assemblage = Assemblage { name: "test".into(), combination, terms: terms.iter().map(term).collect() };
    let mut dice = Dice::new(Seed(1), "test", None);
    let blind = Situation::at(1.0, 1.0, 90.0);
    let (strategy, senses) = (idle(), blind.senses());
    let mut memory = Memory::new(0);
    Combining { strategy: &strategy, senses: &senses, memory: &mut memory, dice: &mut dice }
        .combine(&assemblage)
}

fn to_ball() -> Schema {
    Schema::GoTo { target: Point::Ball, controlled_zone: 0.0, dead_zone: 0.0 }
}

fn terms() -> [(f32, Schema); 4] {
    let east = Schema::GoTo { target: Point::At(Vec2::new(3.0, 1.0)), controlled_zone: 4.0, dead_zone: 0.0 };
    [
        (2.0, east),
        (5.0, to_ball()),
        (-0.75, Schema::Constant(Vec2::new(0.0, 2.0))),
        (1.0, Schema::Constant(Vec2::new(-1.0, 1.0))),
    ]
}

#[test]
fn a_weighted_sum_adds_what_the_schemas_want_times_their_weights() {
    let contributions = combined(Combination::WeightedSum, &terms());
    let unweighted = [Vec2::new(0.5, 0.0), Vec2::ZERO, Vec2::new(0.0, 2.0), Vec2::new(-1.0, 1.0)];
    assert_eq!(contributions.vectors, unweighted, "in the order of the terms; an unknown ball pulls nowhere");
    assert_eq!(contributions.sum, Vec2::new(1.0 - 1.0, -1.5 + 1.0));
}

#[test]
fn the_winner_takes_all_by_its_weighted_length() {
    let contributions = combined(Combination::WinnerTakeAll, &terms());
    assert_eq!(contributions.vectors.len(), 4);
    assert_eq!(contributions.sum, Vec2::new(0.0, -1.5), "1.5 beats 1.41 and 1");
}

#[test]
fn an_assemblage_without_terms_or_with_unknown_ones_wants_nothing() {
    for combination in [Combination::WeightedSum, Combination::WinnerTakeAll, Combination::Blend] {
        assert_eq!(combined(combination, &[]), Contributions::default());
        assert_eq!(combined(combination, &[(1.0, to_ball())]).sum, Vec2::ZERO);
    }
}

/// A robot that covers the east while the ball is far and goes north to it as it comes near, and on the way a blend in a blend.
const BLENDED: &str = r#"
    schemas: {"east": Constant(1, 0), "north": Constant(0, 1), "hard_north": Constant(0, 2)},
    assemblages: {
        "cover": WeightedSum([(1.0, "east")]),
        "fetch": WinnerTakeAll([(1.0, "north"), (1.0, "hard_north")]),
        "play": Blend([
            (run: "cover", desirability: Not(Distance(a: Own, b: Ball, full: 1.0, none: 2.0))),
            (run: "fetch", desirability: Distance(a: Own, b: Ball, full: 1.0, none: 2.0)),
        ]),
        "whole": Blend([
            (run: "play", weight: 3.0, desirability: If(Known(Ball))),
            (run: "cover", desirability: Degree(1.0)),
        ]),
    },
    machines: {"m": (start: "s", states: {"s": ()})},
    roles: {"r": Plays(tag: "R", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)])},
"#;

/// What the named assemblage wants of a robot with the ball so many metres to the north of it.
fn blended(name: &str, ball: Option<f32>) -> Contributions {
    let strategy = strategy("r", BLENDED);
    let assemblage = strategy.assemblages.iter().find(|assemblage| assemblage.name == name);
    let here = Situation::at(0.0, 0.0, 90.0);
    let here = match ball {
        Some(y) => here.ball(0.0, y),
        None => here,
    };
    let (senses, mut dice) = (here.senses(), Dice::new(Seed(1), "test", None));
    let mut memory = Memory::new(strategy.slots);
    Combining { strategy: &strategy, senses: &senses, memory: &mut memory, dice: &mut dice }
        .combine(assemblage.expect("the strategy has it"))
}

#[test]
fn assemblages_are_blended_as_far_as_each_is_desirable() {
    assert_eq!(blended("play", Some(0.5)).sum, Vec2::new(0.0, 2.0));
    assert_eq!(blended("play", Some(2.5)).sum, Vec2::X);
    let between = blended("play", Some(1.25));
    assert_eq!(between.sum, Vec2::new(0.25, 1.5));
    assert_eq!(
        between.vectors,
        [Vec2::new(0.25, 0.0), Vec2::new(0.0, 1.5)],
        "each times how desirable it is"
    );
}

#[test]
fn a_blend_may_be_part_of_a_blend() {
    assert_eq!(blended("whole", Some(0.5)).sum, Vec2::new(0.25, 1.5), "three parts to one");
    assert_eq!(blended("whole", None).sum, Vec2::X, "what is not desirable does not count");
}
