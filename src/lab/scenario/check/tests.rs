use bevy::prelude::Vec2;

use crate::data::ron_options;
use crate::ids::Team;
use crate::lab::scenario::Event;
use crate::lab::scenario::stage::{EXAMPLE, checked};

/// What is wrong with the example if one part of its text is another.
fn trouble(part: &str, instead: &str) -> String {
    assert!(EXAMPLE.contains(part), "{part}");
    checked(&EXAMPLE.replacen(part, instead, 1)).unwrap_err().to_string()
}

/// What is wrong with a condition.
fn fault_of(condition: &str) -> String {
    let error = trouble("RolesDistinct(Home)", condition);
    let (place, message) = error.split_once(": expect[1].Always.what").unwrap();
    assert!(place.starts_with("x.ron:22:"), "{error}");
    message.trim_start_matches(['.', ':', ' ']).to_owned()
}

#[test]
fn a_sound_scenario_is_brought_into_order() {
    let scenario = checked(EXAMPLE).unwrap();
    assert_eq!(scenario.seeds, [1, 2, 3]);
    assert_eq!(scenario.ticks(1.0 / 60.0), 1200);
    let ids: Vec<String> = scenario.players().map(|player| player.id.to_string()).collect();
    assert_eq!(ids, ["home 1", "home 2", "home 3"]);
    let home = scenario.sides[Team::Home.index()].as_ref().unwrap();
    assert_eq!(home[0].role.as_deref(), Some("halfback"));
    assert_eq!(home[1].pose.position, Vec2::new(-1.2, -1.0));
    assert!((home[1].pose.heading - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    assert!(home[1].on && !home[2].on);
    assert_eq!(scenario.sides[Team::Away.index()], None);
    let times: Vec<f32> = scenario.script.iter().map(|event| event.at).collect();
    assert_eq!(times, [1.0, 3.0]);
    assert!(matches!(scenario.script[1].what, Event::Crash(_)));
}

#[test]
fn faults_name_line_and_field() {
    assert_eq!(
        trouble(r#"role: "halfback""#, r#"role: "half""#),
        "x.ron:10:48: home.players[1].role: \
         there is no role `half`; known: goalie, halfback, floater, forward"
    );
    assert_eq!(
        trouble(r#"Crash("home 1")"#, r#"Crash("home 0")"#),
        "x.ron:17:29: script[0].what.Crash: there is no robot `home 0`; known: home 1, home 2, home 3"
    );
    assert_eq!(
        trouble(r#"ActingAs("home 2", "halfback")"#, r#"ActivityOf("home 2", ["push", "pull"])"#),
        "x.ron:21:56: expect[0].Eventually.what.ActivityOf[1][1]: \
         there is no activity `pull`; known: search, acquire, push"
    );
}

#[test]
fn the_head_of_a_scenario_is_checked() {
    for (part, instead, expected) in [
        ("The floater takes over from a halfback that breaks down", " ", "name: must say"),
        ("seconds: 20", "seconds: 0", "seconds: must be at least 0.001 s, not 0"),
        ("seconds: 20", "seconds: NaN", "seconds: must be a number, not NaN"),
        ("seconds: 20", "seconds: 1e30", "x.ron:5:14: seconds: must be at most 86400 s, not 1e30"),
        ("seeds: 3", "seeds: 0", "seeds: the number of seeds must be at least 1, not 0"),
        ("seeds: 3", "seeds: 20000", "seeds: the number of seeds must be at most 10000, not 20000"),
        ("seeds: 3", "seeds: [4, 5, 4]", "seeds[2]: the seed 4 is given twice"),
        ("seeds: 3", r#"radio: "lousy""#, "radio: there is no radio `lousy`; known: lossy, perfect"),
        ("at: (-1.5, 0.5)", "at: (-1.5, 5)", "ball.at: (-1.5, 5) is not on the pitch"),
        ("at: (-1.5, 0.5)", "at: (x: [0, 5], y: [1])", "ball.at: (5, 1) is not on the pitch"),
        ("at: (-1.5, 0.5)", "at: (x: [0, 1, 0], y: [1])", "ball.at: (0, 1) is given twice"),
        ("at: (-1.5, 0.5)", "at: (x: [], y: [1])", "ball.at: the number of places must be at least 1, not 0"),
        ("seeds: 3", "seeds: 3, may_fail: 3", "may_fail: must be less than the number of seeds, 3"),
        ("velocity: (0.5, 0.0)", "velocity: (0.5, inf)", "ball.velocity[1]: must be at most 50 m/s, not inf"),
        (
            "velocity: (0.5, 0.0)",
            "velocity: (-1e30, 0.0)",
            "ball.velocity[0]: must be at least -50 m/s, not -1e30",
        ),
        (r#"from: "home 2""#, r#"from: "away 2""#, "faults[0].from: there is no robot `away 2`"),
        ("which: First", "which: Nth(0)", "faults[0].which: packets are counted from 1"),
    ] {
        let error = trouble(part, instead);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn players_are_checked() {
    for (part, instead, expected) in [
        ("number: 1", "number: 2", "home.players[1].number: home 2 is given twice"),
        ("number: 1", "number: 4", "[1].number: there is no player with number `4`; known: 0, 1, 2, 3"),
        ("at: (-2.2, 0.8)", "at: (-2.2, NaN)", "home.players[1].at[1]: must be a number, not NaN"),
        ("facing: 90", "facing: inf", "home.players[0].facing: must be at most 360°, not inf"),
    ] {
        let error = trouble(part, instead);
        assert!(error.contains(expected), "{error}");
    }
    let start = EXAMPLE.find("players: [").unwrap();
    let end = EXAMPLE.find("    ball:").unwrap();
    let nobody = format!("{}players: []),{}", &EXAMPLE[..start], &EXAMPLE[end..]);
    let error = checked(&nobody).unwrap_err();
    assert_eq!(error.field.to_string(), "home.players");
}

#[test]
fn what_stands_in_something_else_is_refused_with_both_places() {
    for (part, instead, expected) in [
        (
            "at: (-2.2, 0.8)",
            "at: (-1.25, -1.3)",
            "x.ron:10:29: home.players[1].at: home 1 at (-1.25, -1.3) would stand in home 2, which is at \
             (-1.2, -1) by home.players[0].at",
        ),
        (
            "at: (-2.2, 0.8)",
            "at: (-4.2, 1.5)",
            "home.players[1].at: home 1 at (-4.2, 1.5) would stand in a wall",
        ),
        (
            "at: (-1.5, 0.5)",
            "at: (-2.6, 0.8)",
            "x.ron:14:16: ball.at: the ball at (-2.6, 0.8) would stand in home 1, which is at (-2.2, 0.8) by \
             home.players[1].at",
        ),
        ("at: (-1.5, 0.5)", "at: (-1.5, 2.45)", "ball.at: the ball at (-1.5, 2.45) would stand in a wall"),
    ] {
        let error = trouble(part, instead);
        assert!(error.contains(expected), "{error}");
    }
    assert!(checked(&EXAMPLE.replacen("at: (-1.5, 0.5)", "at: (-1.85, 0.8)", 1)).is_ok(), "before its jaws");
}

#[test]
fn the_script_is_checked() {
    for (instead, expected) in [
        ("at: -1, what: Heal", "script[0].at: must be at least 0 s, not -1"),
        ("at: 21, what: Heal", "script[0].at: 21 s is after the end, which is at 20 s"),
        (r#"at: 1, what: Radio("x")"#, "what.Radio: there is no radio `x`; known: lossy, perfect"),
        ("at: 1, what: Ball(at: (0, 9))", "what.Ball.at: (0, 9) is not on the pitch"),
        (r#"at: 1, what: Push(robot: "home 1", by: (0, NaN))"#, "Push.by[1]: must be a number, not NaN"),
        (
            r#"at: 1, what: Push(robot: "home 1", by: (1e30, 0))"#,
            "Push.by[0]: must be at most 50 m/s, not 1e30",
        ),
        (
            "at: 1, what: Ball(at: (0, 0), velocity: (0, 1e9))",
            "Ball.velocity[1]: must be at most 50 m/s, not 1e9",
        ),
        (
            r#"at: 1, what: Kidnap(robot: "home 1", to: (9, 0), facing: 0)"#,
            "Kidnap.to: (9, 0) is not on the pitch",
        ),
        (
            r#"at: 1, what: Mislead(robot: "home 1", by: (0, 1e9))"#,
            "Mislead.by[1]: must be at most 1000 m, not 1e9",
        ),
        (r#"at: 1, what: Mislead(robot: "home 0", by: (1, 0))"#, "Mislead.robot: there is no robot `home 0`"),
        (r#"at: 1, what: Revive(robot: "home 0", memory: Lost)"#, "Revive.robot: there is no robot `home 0`"),
        (r#"at: 1, what: Partition([], ["home 1"])"#, "Partition[0]: needs at least one robot"),
        (
            r#"at: 1, what: Partition(["home 1"], ["home 2", "home 1"])"#,
            "Partition[1][1]: home 1 cannot be on both sides",
        ),
        (
            r#"at: 1, what: Partition(["home 1", "home 1"], ["home 2"])"#,
            "Partition[0][1]: `home 1` is given twice",
        ),
        (
            r#"at: 1, what: InitiateSwap(robot: "home 1", roles: [("floater", "back")])"#,
            "InitiateSwap.roles[0][1]: there is no role `back`",
        ),
        (
            r#"at: 1, what: InitiateSwap(robot: "home 1", roles: [("floater", "forward")])"#,
            "InitiateSwap.roles: must take and give the same roles, each once",
        ),
        (r#"at: 1, what: InitiateSwap(robot: "home 1", roles: [])"#, "must take and give"),
    ] {
        let error = trouble(r#"at: 3, what: Crash("home 1")"#, instead);
        assert!(error.contains("script[0]") && error.contains(expected), "{error}");
    }
}

#[test]
fn the_times_of_expectations_lie_within_the_scenario() {
    for (part, instead, expected) in [
        ("within: 5", "within: 18", "expect[0].Eventually.within: 21 s is after the end, which is at 20 s"),
        ("within: 5", "within: -1", "expect[0].Eventually.within: must be at least 0 s, not -1"),
        ("after: 3", "after: -3", "expect[0].Eventually.after: must be at least 0 s, not -3"),
        ("until: 10", "until: 30", "expect[2].Never.until: 30 s is after the end"),
        ("until: 10", "until: 1", "expect[2].Never.until: 1 s is before the start at 2 s"),
    ] {
        let error = trouble(part, instead);
        assert!(error.contains(expected), "{error}");
    }
    let (start, rest) = EXAMPLE.split_once("expect: [").unwrap();
    let (_, end) = rest.split_once("    ],\n").unwrap();
    let error = checked(&format!("{start}expect: [],\n{end}")).unwrap_err();
    assert!(error.message.contains("expects nothing"));
}

#[test]
fn conditions_that_mean_nothing_are_faults() {
    for (condition, expected) in [
        (r#"RoleOf("home 1", "back")"#, "RoleOf[1]: there is no role `back`"),
        (r#"ActingAs("home 0", "goalie")"#, "ActingAs[0]: there is no robot `home 0`"),
        (r#"ActivityOf("home 1", [])"#, "ActivityOf[1]: needs at least one activity"),
        (r#"Claims("away 1")"#, "Claims: there is no robot `away 1`"),
        (r#"Holder(robot: "home 1", seen_by: "home 0")"#, "Holder.seen_by: there is no robot `home 0`"),
        ("Distance(from: Ball, to: At(0, 0))", "Distance: needs `below` or `above`"),
        ("Distance(from: Ball, to: At(0, NaN), below: 1)", "Distance.to.At[1]: must be a number, not NaN"),
        ("Distance(from: Ball, to: At(0, 0), below: -1)", "Distance.below: must be at least 0 m, not -1"),
        (
            "Distance(from: Ball, to: At(0, 0), below: 1, above: 2)",
            "Distance.below: nothing is below 1 and above 2",
        ),
        (
            r#"Behind(what: Robot("home 0"), of: Ball, toward: Goal(Away), near: 0, far: 1, aside: (0, 1))"#,
            "Behind.what.Robot: there is no robot `home 0`",
        ),
        (
            "Behind(what: BallAtStart, of: Ball, toward: Goal(Away), near: 2, far: 1, aside: (0, 1))",
            "Behind: needs `near` before `far`",
        ),
        ("Speed(of: Goal(Home), below: 1)", "Speed.of: does not move"),
        ("Speed(of: Ball, below: 0)", "Speed.below: nothing is below 0"),
        (
            "InZone(what: Ball, zone: Rectangle(min: (1, 0), max: (0, 1)))",
            "InZone.zone.Rectangle: its min must be below its max",
        ),
        ("Sent(kind: Lock, at_least: 0)", "Sent.at_least: at least 0 always holds"),
        ("Delivered(kind: Lock, since: 21)", "Delivered.since: 21 s is after the end"),
        ("Goals(team: Home)", "Goals: needs `at_least` or `at_most`"),
        ("Goals(team: Home, at_least: 2, at_most: 1)", "Goals.at_most: 1 is less than"),
        (r#"Touching("home 1", "home 0")"#, "Touching[1]: there is no robot `home 0`"),
        (r#"Touching("home 1", "home 1")"#, "Touching: home 1 does not touch itself"),
        (r#"Drives("home 0")"#, "Drives: there is no robot `home 0`"),
        ("Driving(team: Home)", "Driving: needs `at_least` or `at_most`"),
        ("Driving(team: Away, at_most: 1)", "Driving.team: away does not take part"),
        ("MateContacts(team: Home)", "MateContacts: needs `at_least` or `at_most`"),
        ("MateContacts(team: Away, at_most: 1)", "MateContacts.team: away does not take part"),
        ("MateContactTime(team: Home, below: -1)", "MateContactTime.below: must be at least 0 s, not -1"),
        ("RolesDistinct(Away)", "away does not take part"),
        ("Unlocked(Away)", "away does not take part"),
        ("RolesAre(Home, {})", "RolesAre[1]: needs at least one robot"),
        (r#"RolesAre(Home, {0: "goalie"})"#, "RolesAre[1].0: there is no robot `home 0`"),
        ("All([])", "All: needs at least one condition"),
        ("Any([RolesDistinct(Home), Any([])])", "Any[1].Any: needs at least one condition"),
        ("Not(RolesDistinct(Away))", "Not: away does not take part"),
        ("For(seconds: 25, what: RolesDistinct(Home))", "For.seconds: 25 s is after the end"),
    ] {
        let fault = fault_of(condition);
        assert!(fault.starts_with(expected), "{condition}: {fault}");
    }
}

#[test]
fn mates_are_of_one_team() {
    let away = r#"away: (strategy: "ball_chasers", players: [(number: 1, at: (1, 0))]), ball:"#;
    let text = EXAMPLE.replacen("ball:", away, 1);
    assert!(checked(&text).is_ok());
    let text = text.replacen("RolesDistinct(Home)", r#"Locked(robot: "home 1", by: "away 1")"#, 1);
    let error = checked(&text).unwrap_err();
    assert_eq!(error.message, "away 1 is no team mate of home 1");
}

#[test]
fn a_checked_script_can_be_shown_as_data() {
    let scenario = checked(EXAMPLE).unwrap();
    let text = ron_options().to_string(&scenario.script[1]).unwrap();
    assert_eq!(text, r#"(at:3.0,what:Crash("home 1"))"#);
}

/// What is wrong if the first expectation must be met with a probability.
fn trouble_of_probability(seeds: &str, numbers: &str) -> String {
    let first = r#"Eventually(what: ActingAs("home 2", "halfback"), within: 5, after: 3)"#;
    let text = EXAMPLE.replacen("seeds: 3,", seeds, 1);
    let text = text.replacen(first, &format!("Probability(of: {first}, {numbers})"), 1);
    checked(&text)
        .map_or_else(|error| error.to_string(), |scenario| format!("{} seeds", scenario.seeds.len()))
}

#[test]
fn a_probability_is_one_that_the_seeds_can_show() {
    let sound = "at_least: 0.9, confidence: 0.95";
    for (seeds, numbers, expected) in [
        ("", sound, "500 seeds"),
        ("seeds: 60,", sound, "60 seeds"),
        ("seeds: 60,", "at_least: 1, confidence: 0.95", "at_least: must be at most 0.999, not 1"),
        ("seeds: 60,", "at_least: 0, confidence: 0.95", "at_least: must be at least 0.001, not 0"),
        ("seeds: 60,", "at_least: NaN, confidence: 0.95", "at_least: must be a number, not NaN"),
        ("seeds: 60,", "at_least: 0.9, confidence: 1", "confidence: must be at most 0.9999, not 1"),
        ("seeds: 60,", "at_least: 0.9, confidence: 0.2", "confidence: must be at least 0.5, not 0.2"),
        (
            "seeds: 10,",
            sound,
            "x.ron:21:106: expect[0].Probability.at_least: 10 seeds can never show it, though all of them meet it: `seeds` \
             must allow more",
        ),
        ("seeds: 60, may_fail: 2,", sound, "x.ron:4:26: may_fail: does not go with `Probability`"),
        ("may_fail: 0,", sound, "may_fail: does not go with `Probability`"),
    ] {
        let error = trouble_of_probability(seeds, numbers);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn what_is_probable_is_checked_like_any_other_expectation() {
    let within = |of: &str| {
        let first = r#"Eventually(what: ActingAs("home 2", "halfback"), within: 5, after: 3)"#;
        let text = EXAMPLE.replacen("seeds: 3,", "", 1);
        let tested = format!("Probability(of: {of}, at_least: 0.9, confidence: 0.95)");
        checked(&text.replacen(first, &tested, 1)).unwrap_err().to_string()
    };
    let error = within(r#"Finally(what: RoleOf("home 9", "goalie"))"#);
    assert!(error.contains("Probability.of.Finally.what.RoleOf[0]: there is no robot `home 9`"), "{error}");
    let error = within("Probability(of: Finally(what: RolesDistinct(Home)), at_least: 0.8, confidence: 0.9)");
    assert!(error.contains("Probability.of: a probability of a probability means nothing"), "{error}");
}
