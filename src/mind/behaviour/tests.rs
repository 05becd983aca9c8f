//! Decisions of one robot: sub-roles, homebases, transitions, and what is left of them under a changed strategy.

mod hierarchy;

use crate::ids::RobotId;
use crate::mind::teamwork::TeamModel;
use crate::mind::world_model::WorldModel;
use crate::robot::Odometry;
use crate::robot::Orders;
use crate::robot::Robot;
use crate::robot::handling::Handling;
use crate::strategy::Role;
use crate::strategy::TransitionTaken;
use crate::testing::perfect_sensing;
use std::sync::Arc;

use bevy::ecs::system::RunSystemOnce;

use super::*;
use crate::ids::Team;
use crate::mind::perception::fixture::Situation;
use crate::rng::Seed;
use crate::strategy::language::Point;
use crate::testing::{BALL, cye, pitch, strategy};

/// A robot that decides in every third tick, and nothing else.
struct Bench {
    world: World,
    robot: Entity,
    strategy: Arc<Strategy>,
}

/// Ticks between two decisions.
const DECISION: u64 = 3;

impl Bench {
    fn new(strategy: Strategy, role: &str) -> Bench {
        let role = strategy.roles.iter().position(|spec| spec.name == role).expect("the role exists");
        let (strategy, id) = (Arc::new(strategy), RobotId::new(Team::Home, 0));
        let mut world = World::new();
        let clock = Clock::new(60.0);
        world.insert_resource(clock);
        world.insert_resource(pitch());
        world.insert_resource(Strategies([strategy.clone(), strategy.clone()]));
        world.insert_resource(BALL);
        let parts = (
            id,
            Robot::new(Arc::new(cye()), Arc::new(perfect_sensing()), &clock),
            Odometry::new(Seed(1), id),
            WorldModel::default(),
        );
        let mind = (Memory::new(strategy.slots), Role(role), Activity::new(&strategy, role, 0));
        let mind = (mind, TeamModel::new(&strategy), Handling::new(Seed(1), id), Orders::default());
        let robot = world.spawn((parts, mind)).id();
        Bench { world, robot, strategy }
    }

    /// Decides in this situation; ticks in between pass in vain.
    fn decide(&mut self, tick: u64, situation: Situation) -> Activity {
        *self.world.get_mut::<WorldModel>(self.robot).expect("the robot has beliefs") = situation.model;
        self.world.resource_mut::<Clock>().tick = tick;
        self.world.run_system_once(choose_activities).expect("the system runs");
        self.activity()
    }

    fn activity(&self) -> Activity {
        self.world.get::<Activity>(self.robot).expect("the robot does something").clone()
    }

    fn role(&self) -> &str {
        &self.strategy.roles[self.activity().acting_as].name
    }

    fn state(&self) -> &str {
        let activity = self.activity();
        &self.strategy.state(activity.machine(&self.strategy), activity.state).name
    }
}

fn here() -> Situation {
    Situation::at(0.0, 0.0, 0.0)
}

fn taken(tick: u64, from: &str, to: &str, because: impl ToString) -> TransitionTaken {
    let (from, to, because) = (from.into(), to.into(), because.to_string());
    TransitionTaken { tick, from, to, because, transition: None }
}

/// The history in words, without the places of the transitions in the strategy.
fn told(activity: &Activity) -> Vec<TransitionTaken> {
    let history = activity.history.iter().cloned();
    history.map(|taken| TransitionTaken { transition: None, ..taken }).collect()
}

/// A floater that defends while the ball is behind x = 1 and attacks while it is before x = -1, and knows nothing else.
fn floating() -> Strategy {
    strategy(
        "floater",
        r#"
        schemas: {}, assemblages: {},
        machines: {
            "back": (start: "rest", states: {
                "rest": (on: [(when: After(1.0), go: "wait")]),
                "wait": (),
            }),
            "front": (start: "rest", states: {
                "rest": (on: [(when: After(9.0), go: "shoot")]),
                "shoot": (),
            }),
        },
        roles: {
            "attacker": Plays(tag: "A", machine: "front", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(2, 1)]),
            "defender": Plays(tag: "D", machine: "back", danger_zone: (min: (-1, 0), max: (0, 1)), homebases: [(-2, 1)]),
            "libero": Plays(tag: "L", machine: "back", danger_zone: (min: (-1, 0), max: (0, 1)), homebases: [(-3, 1)]),
            "floater": ActsAs(tag: "F", sub_roles: [
                (when: In(zone: Exactly(min: (-9, -9), max: (1, 9)), point: Ball), role: "defender"),
                (when: In(zone: Exactly(min: (-1, -9), max: (9, 9)), point: Ball), role: "attacker"),
            ]),
        },
        "#,
    )
}

#[test]
fn a_robot_acts_in_the_first_sub_role_that_fits_and_keeps_the_last_while_none_does() {
    let mut bench = Bench::new(floating(), "floater");
    bench.decide(0, here().ball(0.0, 0.0));
    assert_eq!(bench.role(), "defender", "both fit");
    bench.decide(3, here());
    assert_eq!(bench.role(), "defender", "none fits");
    bench.decide(6, here().ball(2.0, 0.0));
    assert_eq!(bench.role(), "attacker", "the second fits");
    bench.decide(9, here());
    assert_eq!(bench.role(), "attacker", "none fits");
}

#[test]
fn a_robot_that_acts_in_a_role_it_no_longer_has_takes_one_of_its_own() {
    let mut bench = Bench::new(floating(), "libero");
    let floater = bench.strategy.roles.iter().position(|spec| spec.name == "floater").expect("the floater");
    bench.world.get_mut::<Role>(bench.robot).expect("a role").0 = floater;
    bench.decide(0, here());
    assert_eq!(bench.role(), "defender");
}

#[test]
fn a_new_sub_role_goes_on_in_the_state_of_the_same_name_or_at_its_start_and_times_begin_anew() {
    let mut bench = Bench::new(floating(), "floater");
    assert_eq!((bench.role(), bench.state()), ("attacker", "rest"));
    // Two seconds of rest as an attacker are none as a defender, who would wait after one.
    let activity = bench.decide(120, here().ball(0.0, 0.0));
    assert_eq!((bench.role(), bench.state(), activity.since), ("defender", "rest", 120));
    bench.decide(177, here());
    assert_eq!(bench.state(), "rest");
    bench.decide(180, here());
    assert_eq!(bench.state(), "wait");
    let activity = bench.decide(183, here().ball(2.0, 0.0));
    assert_eq!((bench.role(), bench.state(), activity.since), ("attacker", "rest", 183));
    assert_eq!(activity.homebase, Vec2::new(2.0, 1.0));
    assert_eq!(
        told(&activity),
        [
            taken(120, "rest", "rest as defender", "sub-role"),
            taken(180, "rest", "wait", Feature::After(1.0)),
            taken(183, "wait", "rest as attacker", "sub-role"),
        ]
    );
}

#[test]
fn ticks_between_two_decisions_change_nothing() {
    let mut bench = Bench::new(floating(), "floater");
    let before = bench.activity();
    assert_eq!(bench.decide(DECISION + 1, here().ball(0.0, 0.0)), before);
    assert_ne!(bench.decide(2 * DECISION, here().ball(0.0, 0.0)), before);
}

#[test]
fn the_nearest_homebase_is_chosen_with_some_loyalty_to_the_present_one() {
    let homes =
        "schemas: {}, assemblages: {}, machines: {\"m\": (start: \"s\", states: {\"s\": ()})}, roles: {
        \"r\": Plays(tag: \"R\", machine: \"m\", danger_zone: (min: (0, 0), max: (1, 1)),
            homebases: [(-2, 0), (2, 0)])}";
    let mut bench = Bench::new(strategy("r", homes), "r");
    let mut home_from = |tick, x| bench.decide(tick, Situation::at(x, 0.0, 0.0)).homebase.x;
    assert_eq!(home_from(0, 1.0), 2.0, "the nearest");
    assert_eq!(home_from(3, -0.1), 2.0, "0.2 m nearer is not enough");
    assert_eq!(home_from(6, -0.2), -2.0, "0.4 m is");
    assert_eq!(home_from(9, 0.1), -2.0, "and now the other one is the present one");
}

/// A machine of four states in a ring, each left at once; `first` can be left in two ways.
fn ring(first: &str) -> Strategy {
    strategy(
        "r",
        &format!(
            r#"
            schemas: {{}}, assemblages: {{}},
            machines: {{"m": (start: "first", states: {{
                "first": (on: [{first}]),
                "second": (on: [(when: Always, go: "third")]),
                "third": (on: [(when: Always, go: "fourth")]),
                "fourth": (on: [(when: Always, go: "first")]),
            }})}},
            roles: {{"r": Plays(tag: "R", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)])}},
            "#
        ),
    )
}

#[test]
fn the_first_transition_whose_feature_holds_is_taken_and_one_a_decision_at_most() {
    let ways =
        r#"(when: Known(Ball), go: "fourth"), (when: Always, go: "second"), (when: Always, go: "third")"#;
    let mut bench = Bench::new(ring(ways), "r");
    let activity = bench.decide(3, here());
    assert_eq!((bench.state(), activity.since), ("second", 3));
    assert_eq!(told(&activity), [taken(3, "first", "second", Feature::Always)]);
    bench.decide(6, here());
    assert_eq!(bench.state(), "third");
    let mut bench = Bench::new(ring(ways), "r");
    let activity = bench.decide(3, here().ball(1.0, 0.0));
    assert_eq!(bench.state(), "fourth");
    assert_eq!(told(&activity), [taken(3, "first", "fourth", Feature::Known(Point::Ball))]);
}

#[test]
fn the_history_keeps_the_last_eight_transitions_oldest_first() {
    let mut bench = Bench::new(ring(r#"(when: Always, go: "second")"#), "r");
    for decision in 1..=11 {
        bench.decide(decision * DECISION, here());
    }
    let history = told(&bench.activity());
    assert_eq!(
        history.iter().map(|taken| taken.tick / DECISION).collect::<Vec<_>>(),
        [4, 5, 6, 7, 8, 9, 10, 11]
    );
    assert_eq!(history[0], taken(12, "fourth", "first", Feature::Always));
    assert_eq!(history[7], taken(33, "third", "fourth", Feature::Always));
}

#[test]
fn a_transition_that_was_true_when_its_state_was_left_starts_anew_when_the_state_is_entered_again() {
    let ways = r#"(when: Lasting(what: Always, seconds: 0.1), go: "second")"#;
    let mut bench = Bench::new(ring(ways), "r");
    let mut states = Vec::new();
    for decision in 0..9 {
        bench.decide(decision * DECISION, here());
        states.push(bench.state().to_owned());
    }
    let once = ["first", "first", "second", "third", "fourth", "first"];
    assert_eq!(
        states,
        [&once[..], &["first", "first", "second"]].concat(),
        "it lasted 0.1 s of 0.05 s steps"
    );
}

fn carried(old: &Strategy, new: &Strategy, bench: &Bench) -> Activity {
    let role = new.roles.iter().position(|spec| spec.name == "r").unwrap_or(0);
    bench.activity().carried_over(old, new, role, 99)
}

/// The ring in its second state since tick 3.
fn in_second() -> Bench {
    let mut bench = Bench::new(ring(r#"(when: Always, go: "second")"#), "r");
    bench.decide(3, here());
    assert_eq!(bench.state(), "second");
    bench
}

#[test]
fn under_a_changed_strategy_a_robot_stays_in_the_state_of_the_same_name() {
    let bench = in_second();
    let mut new = (*bench.strategy).clone();
    new.machines[0].states.swap(0, 1);
    new.machines[0].states.reverse();
    let carried = carried(&bench.strategy, &new, &bench);
    assert_ne!(carried.state, bench.activity().state, "it has another number");
    assert_eq!(new.state(carried.machine(&new), carried.state).name, "second");
    assert_eq!((carried.since, carried.history.len()), (3, 1), "nothing happened to the robot");
}

#[test]
fn under_a_changed_strategy_without_its_state_a_robot_starts_and_keeps_its_history() {
    let bench = in_second();
    let mut new = (*bench.strategy).clone();
    for state in &mut new.machines[0].states {
        state.name.insert(0, '*');
    }
    let carried = carried(&bench.strategy, &new, &bench);
    assert_eq!((carried.state, carried.since), (new.machines[0].start, 99));
    assert_eq!(carried.history, bench.activity().history);
}

#[test]
fn under_a_changed_strategy_without_its_role_a_robot_is_as_new_in_the_role_it_gets() {
    let bench = in_second();
    let mut new = floating();
    assert_eq!(carried(&bench.strategy, &new, &bench), Activity::new(&new, 0, 99));
    // A role of the same name that no longer plays a machine itself is no role to act in.
    let floater = new.roles.iter().position(|spec| spec.name == "floater").expect("the floater");
    new.roles[floater].name = "r".into();
    assert_eq!(carried(&bench.strategy, &new, &bench), Activity::new(&new, floater, 99));
}

#[test]
fn a_role_moved_within_the_file_is_still_the_same_role() {
    let bench = in_second();
    let mut new = (*bench.strategy).clone();
    new.roles.insert(0, floating().roles[0].clone());
    assert_eq!(carried(&bench.strategy, &new, &bench).acting_as, 1);
}
