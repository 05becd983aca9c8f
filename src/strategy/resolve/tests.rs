//! How large and how deep a strategy may be, and which numbers it may hold.

use std::fmt::Write;

use crate::data::{AssetFolder, Source};
use crate::strategy::language::{Feature, Point, ZoneName};
use crate::strategy::{HomebaseRule, Play, Strategy, played};

/// A strategy of one player with these pieces.
fn with(pieces: &str) -> String {
    format!(
        r#"(name: "x", robot_kinds: ["cye"], players: ["r"], kick_off: (ours: [(-1, 0)], theirs: [(-1, 0)]),
        machines: {{"m": (start: "s", states: {{"s": (turn: Spin(90), speed: 0.5)}})}},
        roles: {{"r": Plays(tag: "R", machine: "m", danger_zone: (min: (-1, -1), max: (1, 1)), homebases: [(0, 0)])}},
        {pieces})"#
    )
}

fn read(text: &str) -> Result<Strategy, String> {
    let source = Source::new("x.ron", text);
    let read = Strategy::parse(&AssetFolder::new("none"), &source, None).map_err(|error| error.to_string());
    if let Err(error) = &read {
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    read
}

/// So many percepts, each made of the one before it.
fn chain(count: usize, link: impl Fn(usize) -> String) -> String {
    let mut percepts = String::from(r#"percepts: {"p0": Ball"#);
    for i in 1..count {
        write!(percepts, r#", "p{i}": {}"#, link(i - 1)).unwrap();
    }
    with(&format!("{percepts}}}"))
}

#[test]
fn names_may_stand_for_names_but_not_without_end() {
    let named = |i| format!(r#"Named("p{i}")"#);
    assert!(read(&chain(30, named)).is_ok());
    let error = read(&chain(900, named)).unwrap_err();
    assert!(error.contains(": percepts.p"), "{error}");
    assert!(error.contains("nested too deeply: 64 values inside each other at most"), "{error}");
    let error = read(&chain(100_000, named)).unwrap_err();
    assert!(
        error.ends_with("percepts: the number of its pieces must be at most 1000, not 100000"),
        "{error}"
    );
}

#[test]
fn names_that_use_names_twice_do_not_grow_without_end() {
    let twice = |i| format!(r#"Midpoint(Named("p{i}"), Named("p{i}"))"#);
    assert!(read(&chain(8, twice)).is_ok());
    let error = read(&chain(60, twice)).unwrap_err();
    assert!(
        error.contains("percepts.p") && error.contains("becomes too large: 50000 values at most"),
        "{error}"
    );
}

#[test]
fn all_kinds_of_pieces_are_bounded() {
    let pieces = |kind: &str, first: &str, both: &str| {
        let mut text = format!(r#"{kind}: {{"p0": {first}"#);
        for i in 1..60 {
            write!(text, r#", "p{i}": {}"#, both.replace('#', &format!("\"p{}\"", i - 1))).unwrap();
        }
        with(&format!("{text}}}"))
    };
    for (kind, first, both) in [
        ("point_sets", "Teammates", "Union([Named(#), Named(#)])"),
        ("features", "HasBall", "All([Is(#), Is(#)])"),
        ("features", "HasBall", "Lasting(what: Any([Is(#), Is(#)]), seconds: 1)"),
    ] {
        let error = read(&pieces(kind, first, both)).unwrap_err();
        assert!(error.contains(kind) && error.contains("becomes too large"), "{error}");
    }
}

#[test]
fn a_blend_holds_neither_itself_nor_what_is_not_there_nor_too_much() {
    for (assemblages, expected) in [
        (r#""a": Blend([(run: "a", desirability: Degree(1))])"#, "a.Blend[0].run: `a` is a blend of itself"),
        (
            r#""a": Blend([(run: "b", desirability: Degree(1))]), "b": Blend([(run: "a", desirability: Degree(1))])"#,
            "a.Blend[0].run: `a` is a blend of itself",
        ),
        (
            r#""a": Blend([(run: "c", desirability: Degree(1))])"#,
            "a.Blend[0].run: there is no assemblage `c`; known: a",
        ),
        (
            r#""a": WeightedSum([]), "b": Blend([(run: "a", desirability: Distance(a: Own, b: Ball, full: 1, none: 1))])"#,
            "b.Blend[0].desirability.none: must not be the same as full, 1 m",
        ),
    ] {
        let error = read(&with(&format!("assemblages: {{{assemblages}}}"))).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
    let twice = |count: usize| {
        let mut text = String::from(r#"assemblages: {"a0": WeightedSum([])"#);
        for i in 1..count {
            let part = format!(r#"(run: "a{}", desirability: Degree(1))"#, i - 1);
            write!(text, r#", "a{i}": Blend([{part}, {part}])"#).unwrap();
        }
        with(&format!("{text}}}"))
    };
    assert!(read(&twice(8)).is_ok());
    assert!(read(&twice(40)).unwrap_err().contains("becomes too large"));
}

#[test]
fn values_nested_too_deeply_are_an_error_with_a_place() {
    for (open, close) in [("Not(", ")"), ("All([", "])"), ("Lasting(seconds: 1, what: ", ")")] {
        let nested = |depth| {
            with(&format!(r#"features: {{"f": {}HasBall{}}}"#, open.repeat(depth), close.repeat(depth)))
        };
        assert!(read(&nested(30)).is_ok());
        for depth in [70, 100, 200, 10_000] {
            let error = read(&nested(depth)).unwrap_err();
            assert!(error.starts_with("x.ron:4:"), "{error}");
        }
    }
    for bracket in ["(", "[", "{", "[(", "Some("] {
        let error = read(&bracket.repeat(100_000)).unwrap_err();
        assert!(error.starts_with("x.ron:1:"), "{error}");
    }
}

#[test]
fn every_number_has_a_bound() {
    for (pieces, expected) in [
        (r#"percepts: {"p": BallIn(1e30)}"#, "percepts.p: must be at most 86400 s, not 1e30"),
        (r#"percepts: {"p": At(0, -1e9)}"#, "percepts.p[1]: must be at least -1000 m, not -1e9"),
        (r#"percepts: {"p": Intercept(max_speed: 1e9)}"#, "max_speed: must be at most 50 m/s, not 1e9"),
        (
            r#"percepts: {"p": Toward(from: Ball, to: OurGoal, distance: 1e9)}"#,
            "distance: must be at most 1000 m, not 1e9",
        ),
        (r#"zones: {"z": (min: (0, 0), max: (1e9, 1))}"#, "zones.z.max[0]: must be at most 1000 m, not 1e9"),
        (r#"zones: {"z": (min: (0, 2), max: (1, 1))}"#, "zones.z: its min must be below its max"),
        (r#"features: {"f": After(1e30)}"#, "features.f: must be at most 86400 s, not 1e30"),
        (r#"features: {"f": Facing(point: Ball, within: 400)}"#, "within: must be at most 360°, not 400"),
        (r#"schemas: {"s": Constant(1e30, 0)}"#, "schemas.s[0]: must be at most 1000, not 1e30"),
        (r#"schemas: {"s": Noise(period: 1e30)}"#, "period: must be at most 86400 s, not 1e30"),
        (
            r#"assemblages: {"a": Blend([(run: "a", weight: 1e30, desirability: Degree(1))])}"#,
            "assemblages.a.Blend[0].weight: must be at most 1000, not 1e30",
        ),
        (
            r#"assemblages: {"a": WeightedSum([]), "b": Blend([(run: "a", desirability: Degree(1.5))])}"#,
            "assemblages.b.Blend[0].desirability: must be at most 1, not 1.5",
        ),
        (r#"assemblages: {"a": WeightedSum([(1e30, "s")])}"#, "[0][0]: must be at most 1000, not 1e30"),
        ("pitch: (1e-30, 5)", "pitch[0]: must be at least 1 m, not 1e-30"),
        ("teamwork: (talk: (position_every: 1e30))", "position_every: must be at most 86400 s, not 1e30"),
        ("teamwork: (talk: (claim_radius: 1e30))", "claim_radius: must be at most 1000 m, not 1e30"),
        (
            "teamwork: (action_arbitration: (max_age: 1e30))",
            "teamwork.action_arbitration.max_age: must be at most 86400 s, not 1e30",
        ),
        (
            "teamwork: (mechanisms: [ActionArbitration, RoleSwap])",
            "teamwork.mechanisms: ActionArbitration and RoleSwap broadcast different values: a team has one of them",
        ),
        ("teamwork: (ball_booking: (timeout: 1e30))", "timeout: must be at most 86400 s, not 1e30"),
    ] {
        let error = read(&with(pieces)).unwrap_err();
        assert!(error.starts_with("x.ron:") && error.contains(expected), "{error}");
    }
    for (from, to, expected) in [
        ("Spin(90)", "Spin(1e30)", "states.s.turn: must be at most 3600°/s, not 1e30"),
        ("speed: 0.5", "speed: 1.5", "states.s.speed: must be at most 1, not 1.5"),
        ("homebases: [(0, 0)]", "homebases: [(0, 1e30)]", "homebases[0][1]: must be at most 1000 m"),
        ("ours: [(-1, 0)]", "ours: [(-1e30, 0)]", "kick_off.ours[0][0]: must be at least -1000 m"),
    ] {
        let error = read(&with("").replace(from, to)).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

/// A strategy whose machine has these states and starts in `s`.
fn with_states(states: &str) -> Result<Strategy, String> {
    read(&with("").replace(r#"{"s": (turn: Spin(90), speed: 0.5)}"#, &format!("{{{states}}}")))
}

#[test]
fn states_within_states_become_one_row_that_knows_what_is_around_each() {
    let strategy = with_states(
        r#""s": (on: [(when: HasBall, go: "play")]),
        "play": (acquires: true, start: "hit", on: [(when: HasBooked, go: "s")], states: {
            "aim": (on: [(when: HoldsBall, go: "hit")]),
            "hit": (start: "kick", states: {"kick": (on: [(when: Always, go: "play")]), "nudge": ()}),
        })"#,
    );
    let machine = &strategy.expect("it is sound").machines[0];
    let paths: Vec<String> = machine.states.iter().map(|state| machine.path(state)).collect();
    assert_eq!(paths, ["play/aim", "play/hit/kick", "play/hit/nudge", "s"]);
    assert_eq!(machine.states[machine.start].name, "s");
    let to = |state: &str, way: usize| {
        let transition = &machine.states[machine.find(state).unwrap()].transitions[way];
        (machine.states[transition.go].name.as_str(), transition.around)
    };
    assert_eq!(to("s", 0), ("kick", 0), "a composite state is entered at its start, and that at its own");
    assert_eq!(to("aim", 0), ("kick", 1), "`hit` begins, `play` around it goes on");
    assert_eq!(to("kick", 0), ("kick", 0), "`play` itself begins anew");
    let acquires = |name: &str| machine.states[machine.find(name).unwrap()].acquires;
    assert_eq!(["aim", "nudge", "s"].map(acquires), [true, true, false]);
    let ways = machine.composites.iter().map(|state| (state.name.as_str(), state.transitions.len()));
    assert_eq!(ways.collect::<Vec<_>>(), [("play", 1), ("hit", 0)]);
}

#[test]
fn what_is_wrong_with_states_within_states_is_said_at_its_place() {
    for (states, expected) in [
        (
            r#""s": (start: "b", states: {"a": ()})"#,
            "machines.m.states.s.start: there is no state `b`; known: a",
        ),
        (
            r#""s": (start: "s", states: {"a": ()})"#,
            "machines.m.states.s.start: there is no state `s`; known: a",
        ),
        (r#""s": (start: "a", states: {})"#, "machines.m.states.s.states: needs at least one state"),
        (
            r#""s": (states: {"a": ()})"#,
            "machines.m.states.s: `start` must say which of its `states` is the first",
        ),
        (
            r#""s": (start: "a")"#,
            "machines.m.states.s.start: a state without `states` of its own has no start",
        ),
        (
            r#""s": (start: "a", states: {"a": ()}), "t": (start: "a", states: {"a": ()})"#,
            "machines.m.states.t.states.a: another state of this machine has the same name",
        ),
        (
            r#""s": (start: "a", states: {"a": (on: [(when: Always, go: "c")]), "b": ()})"#,
            "machines.m.states.s.states.a.on[0].go: there is no state `c`; known: a, b, s",
        ),
        (
            r#""s": (start: "a", on: [(when: Always, go: "c")], states: {"a": ()})"#,
            "machines.m.states.s.on[0].go: there is no state `c`; known: a, s",
        ),
        (
            r#""s": (start: "a", run: "x", states: {"a": ()})"#,
            "machines.m.states.s.run: must be said of the states in it",
        ),
        (
            r#""s": (start: "a", speed: 0.5, states: {"a": ()})"#,
            "machines.m.states.s.speed: must be said of the states in it",
        ),
    ] {
        let error = with_states(states).unwrap_err();
        assert!(error.starts_with("x.ron:2:") && error.contains(expected), "{error}");
    }
}

#[test]
fn states_may_hold_states_but_not_without_end() {
    let nested = |depth: usize| {
        let mut states = String::from(r#""s": ()"#);
        for level in 0..depth {
            let start = if level == 0 { "s".to_owned() } else { format!("s{}", level - 1) };
            states = format!(r#""s{level}": (start: "{start}", states: {{{states}}})"#);
        }
        read(
            &with("")
                .replace(r#"{"s": (turn: Spin(90), speed: 0.5)}"#, &format!("{{{states}}}"))
                .replace(r#"start: "s", states: {"s1"#, r#"start: "s1", states: {"s1"#),
        )
    };
    assert_eq!(nested(2).map(|strategy| strategy.machines[0].composites.len()), Ok(2));
    for depth in [100, 1000] {
        assert!(nested(depth).is_err());
    }
}

/// A strategy with these roles besides a keeper, which plays a machine, and a floater, which acts as it.
fn with_roles(roles: &str, features: &str) -> String {
    format!(
        r#"(name: "x", robot_kinds: ["cye"], players: ["keeper"], kick_off: (ours: [(-1, 0)], theirs: [(-1, 0)]),
        machines: {{"m": (start: "s", states: {{"s": (on: [(when: {features}, go: "s")])}})}},
        roles: {{
            "keeper": Plays(tag: "K", machine: "m", danger_zone: (min: (-3, -1), max: (-1, 1)), homebases: [(-2, 0), (-1, 0)]),
            "floater": ActsAs(tag: "F", sub_roles: [(when: Always, role: "keeper")]),
            {roles}
        }})"#
    )
}

#[test]
fn who_stands_in_for_a_role_plays_its_machine_in_its_zone_from_its_homebases() {
    let strategy = read(&with_roles(
        r#""second": StandsIn(tag: "S", role: "keeper", homebase_rule: FarthestFrom("keeper"))"#,
        "Always",
    ));
    let strategy = strategy.unwrap_or_else(|error| panic!("{error}"));
    let play = |name: &str| {
        played(strategy.roles.iter().find(|role| role.name == name).expect("it has that role")).clone()
    };
    let (keeper, second) = (play("keeper"), play("second"));
    assert!(matches!(second.homebase_rule, HomebaseRule::FarthestFrom(_)));
    assert_eq!(Play { homebase_rule: keeper.homebase_rule.clone(), ..second }, keeper);
}

#[test]
fn a_zone_of_control_is_that_of_a_role_that_has_one() {
    let asks = |role: &str| format!(r#"In(zone: DangerZoneOf("{role}"), point: Ball)"#);
    let second = r#""second": StandsIn(tag: "S", role: "keeper")"#;
    for role in ["keeper", "second"] {
        let strategy = read(&with_roles(second, &asks(role))).unwrap_or_else(|error| panic!("{error}"));
        let when = &strategy.machines[0].states[0].transitions[0].when;
        let zone = played(&strategy.roles[strategy.players[0]]).danger_zone;
        assert_eq!(*when, Feature::In { zone: ZoneName::Exactly(zone), point: Point::Ball });
    }
    for (roles, features, told) in [
        (second, asks("floater"), "`floater` has no zone of control of its own"),
        (second, asks("striker"), "striker"),
        (
            r#""second": StandsIn(tag: "S", role: "floater")"#,
            "Always".into(),
            "stands in for a role that plays a machine",
        ),
        (
            r#""second": StandsIn(tag: "S", role: "second")"#,
            asks("second"),
            "`second` has no zone of control of its own",
        ),
        (r#""second": StandsIn(tag: "S", role: "striker")"#, "Always".into(), "striker"),
    ] {
        let error = read(&with_roles(roles, &features)).unwrap_err();
        assert!(error.contains(told), "{error}");
    }
}
