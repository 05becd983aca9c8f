use bevy::prelude::Vec2;
use proptest::prelude::*;

use super::*;
use crate::comms::radio::{Delivery, Packet};
use crate::comms::tcm::DataType;
use crate::game::record::RobotContacts;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::stage::{HZ, Stage, expecting};

/// Plays 20 s on a stage that changes from tick to tick, until all is decided.
fn play(expectations: &str, mut change: impl FnMut(u64, &mut Stage)) -> (Verdict, u64) {
    let scenario = expecting(expectations);
    let mut judge = Judge::new(&scenario, scenario.first_place(), 1.0 / HZ);
    let mut stage = Stage::default();
    for tick in 1..=scenario.ticks(1.0 / HZ) {
        change(tick, &mut stage);
        judge.observe(&stage.scene(tick));
        if judge.is_decided() {
            return (judge.verdict(), tick);
        }
    }
    panic!("undecided at the end: {:?}", judge.standings().collect::<Vec<_>>());
}

/// The tick and reason of the only failure.
fn failure(expectations: &str, change: impl FnMut(u64, &mut Stage)) -> (u64, String) {
    let (verdict, _) = play(expectations, change);
    assert_eq!(verdict.failures.len(), 1, "{verdict:?}");
    let failure = &verdict.failures[0];
    assert!((failure.seconds - failure.tick as f64 / f64::from(HZ)).abs() < 1e-4);
    (failure.tick, failure.reason.clone())
}

fn passes(expectations: &str, change: impl FnMut(u64, &mut Stage)) -> bool {
    play(expectations, change).0.passed()
}

/// Whether a condition holds on a stage, and why.
fn holds(condition: &str, set: impl Fn(&mut Stage)) -> (bool, String) {
    let set = |_, stage: &mut Stage| set(stage);
    let (always, _) = play(&format!("Always(what: {condition})"), set);
    let (never, _) = play(&format!("Never(what: {condition})"), set);
    assert_ne!(always.passed(), never.passed(), "{condition}");
    let holds = always.passed();
    let failures = if holds { never.failures } else { always.failures };
    (holds, failures[0].reason.clone())
}

fn no_change(_: u64, _: &mut Stage) {}

/// Home 1 and home 2 have touched twice, for 0.75 s in all, and do so still.
fn touched() -> RobotContacts {
    let mut contacts = RobotContacts::default();
    let pair = [1, 2].map(|number| RobotId::new(Team::Home, number));
    contacts.update(&[pair], 0.0, 0.25);
    contacts.update(&[pair], 1.0, 0.5);
    contacts
}

#[test]
fn eventually_is_met_at_once_when_it_holds() {
    let change = |tick, stage: &mut Stage| stage.robots[1].claims = tick == 100;
    let (verdict, tick) = play(r#"Eventually(what: Claims("home 1"), within: 5)"#, change);
    assert!(verdict.passed());
    assert_eq!(tick, 100);
}

#[test]
fn eventually_fails_at_its_deadline_and_not_before() {
    let text = r#"Eventually(what: RoleOf("home 1", "forward"), within: 5)"#;
    assert_eq!(failure(text, no_change), (300, "home 1 was halfback, not forward".into()));
    let change_at = |when| move |tick, stage: &mut Stage| stage.robots[1].claims = tick == when;
    let text = r#"Eventually(what: Claims("home 1"), within: 5)"#;
    assert!(passes(text, change_at(300)));
    assert_eq!(failure(text, change_at(301)), (300, "home 1 did not claim the ball".into()));
}

#[test]
fn eventually_does_not_count_what_came_before_its_start() {
    let text = r#"Eventually(what: Claims("home 1"), within: 5, after: 2)"#;
    assert!(passes(text, |tick, stage| stage.robots[1].claims = tick <= 120));
    let (tick, _) = failure(text, |tick, stage| stage.robots[1].claims = tick < 120);
    assert_eq!(tick, 420);
}

#[test]
fn always_fails_at_the_first_tick_of_violation() {
    let change = |tick: u64, stage: &mut Stage| {
        if tick >= 77 {
            stage.robots[3].role = "halfback";
        }
    };
    let reason = "home 1 and home 3 were both halfback".to_owned();
    assert_eq!(failure("Always(what: RolesDistinct(Home))", change), (77, reason));
    assert!(passes("Always(what: RolesDistinct(Home), until: 1)", change));
    assert!(passes("Always(what: RolesDistinct(Home))", no_change));
}

#[test]
fn always_and_never_watch_their_time_only() {
    let claims = |tick, stage: &mut Stage| stage.robots[1].claims = (120..=240).contains(&tick);
    assert!(passes(r#"Always(what: Claims("home 1"), from: 2, until: 4)"#, claims));
    assert_eq!(failure(r#"Always(what: Claims("home 1"), from: 2)"#, claims).0, 241);
    assert_eq!(failure(r#"Always(what: Claims("home 1"), until: 4)"#, claims).0, 1);
    assert!(passes(r#"Never(what: Claims("home 1"), from: 4.1)"#, claims));
    let expected = (120, "home 1 claimed the ball".into());
    assert_eq!(failure(r#"Never(what: Claims("home 1"))"#, claims), expected);
}

#[test]
fn finally_looks_at_the_last_tick_alone() {
    let text = r#"Finally(what: Claims("home 1"))"#;
    assert!(passes(text, |tick, stage| stage.robots[1].claims = tick == 1200));
    let (tick, _) = failure(text, |tick, stage| stage.robots[1].claims = tick != 1200);
    assert_eq!(tick, 1200);
}

#[test]
fn failures_of_several_expectations_come_in_their_order() {
    let text = r#"
        Eventually(what: Claims("home 2"), within: 9), Never(what: Claims("home 1")), Always(what: RolesDistinct(Home))
    "#;
    let (verdict, tick) = play(text, |_, stage| stage.robots[1].claims = true);
    let found: Vec<_> = verdict.failures.iter().map(|it| (it.tick, it.expectation.as_str())).collect();
    assert_eq!(found, [(540, "by 9 s: home 2 claims the ball"), (1, "never: home 1 claims the ball")]);
    assert_eq!(tick, 1200);
}

#[test]
fn a_run_that_stops_too_early_has_failed() {
    let scenario = expecting("Always(what: RolesDistinct(Home))");
    let mut judge = Judge::new(&scenario, scenario.first_place(), 1.0 / HZ);
    assert!(!judge.verdict().passed());
    judge.observe(&Stage::default().scene(5));
    assert!(!judge.is_decided());
    assert_eq!(
        judge.standings().collect::<Vec<_>>(),
        [("always: no two robots of home have the same role", None)]
    );
    assert_eq!(judge.verdict().failures[0].tick, 5);
}

#[test]
fn what_has_to_last_starts_afresh_after_a_break() {
    let text = r#"Eventually(what: For(seconds: 2, what: Claims("home 1")), within: 4)"#;
    assert!(passes(text, |tick, stage| stage.robots[1].claims = tick >= 120));
    let (tick, reason) = failure(text, |tick, stage| stage.robots[1].claims = ![100, 150].contains(&tick));
    assert_eq!((tick, reason.as_str()), (240, "home 1 claimed the ball for 1.48 s so far"));
}

#[test]
fn what_has_to_last_is_watched_before_its_time_too() {
    let text = r#"Finally(what: For(seconds: 10, what: Claims("home 1")))"#;
    assert!(passes(text, |_, stage| stage.robots[1].claims = true));
    let inside = r#"Finally(what: Any([Claims("home 2"), For(seconds: 10, what: Claims("home 1"))]))"#;
    assert!(passes(inside, |tick, stage| {
        stage.robots[1].claims = true;
        stage.robots[2].claims = tick < 1200;
    }));
}

#[test]
fn messages_are_counted_from_the_time_asked_for() {
    let send_at = |when: &'static [u64]| {
        move |tick: u64, stage: &mut Stage| {
            if when.contains(&tick) {
                let [from, to] = [1, 2].map(|number| RobotId::new(Team::Home, number));
                let packet = Packet { kind: DataType::LOCK, from, to, bytes: [].into() };
                stage.radio.sent(&packet, &Delivery::on_time(tick), tick);
            }
        }
    };
    let never = r#"Never(what: Sent(kind: Lock, from: "home 1", since: 2))"#;
    assert!(passes(never, send_at(&[60, 120])));
    assert_eq!(failure(never, send_at(&[60, 121])), (121, "1 was sent".into()));
    let twice = "Eventually(what: Sent(kind: Lock, at_least: 2), within: 5)";
    assert!(passes(twice, send_at(&[60, 120])));
    assert_eq!(failure(twice, send_at(&[60, 400])), (300, "1 was sent".into()));
    let delivered = "Eventually(what: Delivered(kind: Lock), within: 5)";
    assert_eq!(failure(delivered, send_at(&[60])), (300, "0 were delivered".into()));
}

/// On a stage, some conditions do not hold and their opposites do.
#[test]
fn every_condition_can_hold_and_fail_and_says_what_was_seen() {
    type Set = fn(&mut Stage);
    let cases: &[(&str, Set, &str, Set, &str)] = &[
        (
            r#"ActingAs("home 2", "forward")"#,
            |_| {},
            "home 2 acted as floater, not forward",
            |it| it.robots[2].acting_as = "forward",
            "home 2 acted as forward",
        ),
        (
            r#"ActivityOf("home 1", ["acquire", "push"])"#,
            |_| {},
            "home 1 was in search, not acquire or push",
            |it| it.robots[1].activity = "push",
            "home 1 was in push",
        ),
        (
            r#"Locked(robot: "home 1", by: "home 2")"#,
            |it| it.robots[1].locked_by = Some(3),
            "home 1 was locked by home 3",
            |it| it.robots[1].locked_by = Some(2),
            "home 1 was locked by home 2",
        ),
        (
            r#"Locked(robot: "home 1")"#,
            |_| {},
            "home 1 was not locked",
            |it| it.robots[1].locked_by = Some(3),
            "home 1 was locked by home 3",
        ),
        (
            "Unlocked(Home)",
            |it| it.robots[1].locked_by = Some(3),
            "home 1 was locked by home 3",
            |_| {},
            "no robot was locked",
        ),
        (
            r#"Holder(robot: "home 1", seen_by: "home 2")"#,
            |it| it.robots[2].holder = Some(3),
            "home 2 took home 3 for the holder",
            |it| it.robots[2].holder = Some(1),
            "home 2 took home 1 for the holder",
        ),
        (
            r#"Distance(from: Ball, to: Robot("home 3"), above: 0.5, below: 1)"#,
            |it| it.ball = Vec2::new(0.0, 0.25),
            "the ball was 0.25 m from home 3",
            |it| it.ball = Vec2::new(0.0, 0.75),
            "the ball was 0.75 m from home 3",
        ),
        (
            "Distance(from: Ball, to: BallAtStart, above: 0.5)",
            |it| it.ball = Vec2::new(0.0, 0.25),
            "the ball was 0.25 m from where the ball was at the start",
            |it| it.ball = Vec2::new(0.0, 0.75),
            "the ball was 0.75 m from where the ball was at the start",
        ),
        (
            "Behind(what: At(-1, 0.5), of: Ball, toward: Goal(Away), near: 0.5, far: 1.5, aside: (0.25, 0.75))",
            |it| it.ball = Vec2::new(1.0, 0.0),
            "(-1, 0.5) was 2.00 m behind the ball and 0.50 m aside",
            |_| {},
            "(-1, 0.5) was 1.00 m behind the ball and 0.50 m aside",
        ),
        (
            r#"Speed(of: Robot("home 1"), above: 0.5)"#,
            |_| {},
            "home 1 went at 0.00 m/s",
            |it| it.robots[1].speed = 0.6,
            "home 1 went at 0.60 m/s",
        ),
        (
            "InZone(what: Ball, zone: Rectangle(min: (1, 1), max: (2, 2)))",
            |_| {},
            "the ball was at (0.00, 0.00)",
            |it| it.ball = Vec2::new(1.0, 2.0),
            "the ball was at (1.00, 2.00)",
        ),
        (
            "Goals(team: Away, at_least: 1, at_most: 1)",
            |it| it.score = [1, 2],
            "away had scored 2",
            |it| it.score = [0, 1],
            "away had scored 1",
        ),
        (
            r#"Touching("home 2", "home 1")"#,
            |_| {},
            "home 2 did not touch home 1, 1.00 m away",
            |it| it.contacts = touched(),
            "home 2 touched home 1, 1.00 m away",
        ),
        (
            r#"Drives("home 1")"#,
            |_| {},
            "home 1 did not drive at the ball",
            |it| it.robots[1].drives = true,
            "home 1 drove at the ball",
        ),
        (
            "Driving(team: Home, at_most: 1)",
            |it| it.robots[1..=2].iter_mut().for_each(|it| it.drives = true),
            "home 1 and home 2 drove at the ball",
            |_| {},
            "nobody drove at the ball",
        ),
        (
            "MateContacts(team: Home, at_least: 2)",
            |_| {},
            "robots of home had touched each other 0 times, for 0.00 s",
            |it| it.contacts = touched(),
            "robots of home had touched each other 2 times, for 0.75 s",
        ),
        (
            "MateContactTime(team: Home, below: 0.5)",
            |it| it.contacts = touched(),
            "robots of home had touched each other 2 times, for 0.75 s",
            |_| {},
            "robots of home had touched each other 0 times, for 0.00 s",
        ),
        (
            r#"RolesAre(Home, {2: "floater", 3: "halfback"})"#,
            |_| {},
            "home 3 was forward, not halfback",
            |it| it.robots[3].role = "halfback",
            "home 2 was floater and home 3 was halfback",
        ),
        (
            r#"Not(Any([Claims("home 1"), Claims("home 2")]))"#,
            |it| it.robots[2].claims = true,
            "home 2 claimed the ball",
            |_| {},
            "home 1 did not claim the ball and home 2 did not claim the ball",
        ),
        (
            r#"All([Claims("home 1"), Claims("home 2")])"#,
            |it| it.robots[2].claims = true,
            "home 1 did not claim the ball",
            |it| it.robots[1..=2].iter_mut().for_each(|it| it.claims = true),
            "home 1 claimed the ball and home 2 claimed the ball",
        ),
    ];
    for (condition, wrong, wrongly, right, rightly) in cases {
        assert_eq!(holds(condition, wrong), (false, wrongly.to_string()), "{condition}");
        assert_eq!(holds(condition, right), (true, rightly.to_string()), "{condition}");
    }
}

#[test]
fn a_holder_is_one_in_the_eyes_of_all_mates_that_are_on() {
    let condition = r#"Holder(robot: "home 1")"#;
    let believe = |stage: &mut Stage, numbers: &[usize]| {
        numbers.iter().for_each(|number| stage.robots[*number].holder = Some(1));
    };
    assert!(holds(condition, |stage| believe(stage, &[0, 2, 3])).0);
    let (met, reason) = holds(condition, |stage| believe(stage, &[0, 2]));
    assert!(!met);
    assert_eq!(
        reason,
        "home 0 took home 1 for the holder, home 2 took home 1 for the holder, home 3 knew no holder"
    );
    let three_off = |stage: &mut Stage| {
        believe(stage, &[0, 2]);
        stage.robots[3].on = false;
    };
    assert!(holds(condition, three_off).0);
    let alone = |stage: &mut Stage| stage.robots.retain(|it| it.id.number == 1);
    assert_eq!(holds(condition, alone), (false, "no team mate was switched on".into()));
}

#[test]
fn robots_that_are_switched_off_have_no_say_in_roles_and_configurations() {
    let same_role = |stage: &mut Stage| {
        stage.robots[1].role = "forward";
        stage.robots[1].on = false;
    };
    assert!(holds("RolesDistinct(Home)", same_role).0);
    let configurations = |known: [Option<u64>; 4]| {
        move |stage: &mut Stage| {
            stage.robots.iter_mut().zip(known).for_each(|(it, known)| it.configuration = known);
            stage.robots[3].on = false;
        }
    };
    let agree = "ConfigurationsAgree(Home)";
    assert!(holds(agree, configurations([Some(7), Some(7), Some(7), Some(8)])).0);
    assert_eq!(
        holds(agree, configurations([Some(7), Some(9), Some(7), None])),
        (false, "home 0 had A, home 1 had B, home 2 had A".into())
    );
    assert!(!holds(agree, configurations([Some(7), Some(7), None, None])).0);
    assert!(!holds(agree, configurations([None; 4])).0);
}

#[test]
fn with_everybody_off_nobody_agrees() {
    let all_off = |stage: &mut Stage| stage.robots.iter_mut().for_each(|it| it.on = false);
    for condition in ["RolesDistinct(Home)", "ConfigurationsAgree(Home)"] {
        assert_eq!(holds(condition, all_off), (false, "no robot of the team was switched on".into()));
    }
}

proptest! {
    #[test]
    fn what_never_holds_does_not_hold_eventually_and_its_opposite_always(
        mut flips in prop::collection::vec(1u64..1300, 0..6),
        (from, length) in (0u64..600, 0u64..600),
    ) {
        flips.sort_unstable();
        let claims = |tick: u64| flips.iter().filter(|flip| **flip <= tick).count() % 2 == 1;
        let run = |text: &str| passes(text, |tick, stage| stage.robots[1].claims = claims(tick));
        let (what, hz) = (r#"Claims("home 1")"#, HZ as f64);
        let [start, seconds, end] = [from, length, from + length].map(|ticks| ticks as f64 / hz);
        let eventually = run(&format!("Eventually(what: {what}, after: {start}, within: {seconds})"));
        let never = run(&format!("Never(what: {what}, from: {start}, until: {end})"));
        let always_not = run(&format!("Always(what: Not({what}), from: {start}, until: {end})"));
        prop_assert_eq!(eventually, (from.max(1)..=(from + length).max(1)).any(claims));
        prop_assert_eq!(never, !eventually);
        prop_assert_eq!(always_not, never);
    }
}
