//! What a strategy rests on: bases from anywhere, and reading it again.

use std::path::Path;

use touchline::data::{AssetKind, DataError};
use touchline::game::{Choice, MatchPlan};
use touchline::ids::Team;
use touchline::lab::scenario::ScenarioPlan;
use touchline::strategy::Strategy;

use super::{Own, shipped};
use crate::support::assets;

/// A strategy that says no more than its base.
fn based_on(base: &str) -> String {
    format!("(\n    name: \"Mine\",\n    based_on: \"{base}\",\n)\n")
}

/// The teams of the shipped match on the smaller pitch, home with a strategy of one's own.
fn on_the_small_pitch(strategy: &Path) -> Result<MatchPlan, DataError> {
    let home = Some(strategy.to_string_lossy().into_owned());
    MatchPlan::read(&assets(), &Choice { file: Some("four_legged_2005".into()), home, ..Choice::default() })
}

#[test]
fn a_strategy_anywhere_is_based_on_one_beside_it_or_among_the_assets_or_at_a_path() {
    let own = Own::new();
    let chasers = shipped(AssetKind::Strategy, "ball_chasers");
    own.write("mine.ron", based_on("hammerheads_2001"));
    own.write("beside.ron", based_on("ball_chasers"));
    own.write("teams/path.ron", based_on("../elsewhere/base"));
    own.write("teams/whole.ron", based_on("../elsewhere/base.ron"));
    own.write("elsewhere/base.ron", chasers.replace("\"Ball chasers\"", "\"Base\""));
    // One of the same name is based on the shipped one, not on itself.
    own.write("ball_chasers.ron", based_on("ball_chasers"));
    for (name, players) in
        [("mine", 4), ("beside", 4), ("teams/path", 4), ("teams/whole", 4), ("ball_chasers", 4)]
    {
        let path = own.path(&format!("{name}.ron"));
        let strategy =
            Strategy::read(&assets(), &path, None).strategy.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((strategy.name.as_str(), strategy.players.len()), ("Mine", players), "{name}");
    }
    let (own_files, shipped_base) = (
        |name: &str| Strategy::read(&assets(), &own.path(name), None).files,
        assets().file(AssetKind::Strategy, "ball_chasers"),
    );
    let beside = own.path("ball_chasers.ron");
    assert_eq!(own_files("beside.ron"), [own.path("beside.ron"), beside.clone(), shipped_base.clone()]);
    assert_eq!(own_files("ball_chasers.ron"), [beside, shipped_base]);
}

#[test]
fn teamwork_is_filled_from_the_base_field_by_field() {
    let own = Own::new();
    let teamwork = "teamwork: (talk: (ball_every: 9), role_swap: (policy: Optimal(), timers: (locks: 0.7)))";
    let path =
        own.write("mine.ron", based_on("hammerheads_swap").replace(")\n", &format!("    {teamwork},\n)\n")));
    let read = |path: &Path| Strategy::read(&assets(), path, None).strategy;
    let mine = read(&path).unwrap_or_else(|error| panic!("{error}")).teamwork;
    let mut base =
        read(&assets().file(AssetKind::Strategy, "hammerheads_swap")).expect("it is sound").teamwork;
    assert_ne!(mine, base);
    base.talk.ball_every = 9.0;
    let swap = base.role_swap.as_mut().expect("the base swaps roles");
    swap.policy = mine.role_swap.clone().expect("mine does, too").policy;
    swap.timers.locks = 0.7;
    assert_eq!(mine, base);
    let path =
        own.write("lacking.ron", based_on("ball_chasers").replace(")\n", &format!("    {teamwork},\n)\n")));
    let told = read(&path).expect_err("nothing says how roles are swapped").to_string();
    assert!(told.contains(":4:50: teamwork.role_swap: the field `protocol` is missing"), "{told}");
}

#[test]
fn bases_that_are_missing_in_a_circle_too_many_or_wrong_are_told_with_their_place() {
    let own = Own::new();
    own.write("missing.ron", based_on("nobody"));
    own.write("one.ron", based_on("other"));
    own.write("other.ron", based_on("one"));
    own.write("self.ron", based_on("./self.ron"));
    for number in 0..20 {
        own.write(&format!("row{number}.ron"), based_on(&format!("row{}", number + 1)));
    }
    own.write("row20.ron", shipped(AssetKind::Strategy, "ball_chasers"));
    own.write("above.ron", based_on("wrong"));
    own.write("wrong.ron", "(\n    name: \"Wrong\",\n    players: [\"nobody\"],\n)\n");
    for (name, file, line, field, words) in [
        (
            "missing.ron",
            "missing.ron",
            3,
            "based_on",
            "there is no strategy `nobody` beside this file or among the assets",
        ),
        ("one.ron", "other.ron", 3, "based_on", "`one` is based on itself, by way of this file"),
        ("self.ron", "self.ron", 3, "based_on", "is based on itself"),
        ("row0.ron", "row8.ron", 3, "based_on", "more than 8 strategies are based on one another"),
        ("above.ron", "wrong.ron", 3, "players[0]", "there is no role `nobody`"),
    ] {
        let read = Strategy::read(&assets(), &own.path(name), None);
        let error = read.strategy.expect_err("the strategy is wrong");
        let told = error.to_string();
        assert_eq!(
            (error.path, error.line, error.field.to_string().as_str()),
            (own.path(file), Some(line), field),
            "{told}"
        );
        assert!(error.message.contains(words), "{told}");
    }
    let deepest = Strategy::read(&assets(), &own.path("row12.ron"), None);
    assert!(deepest.strategy.is_ok(), "eight bases are not too many");
    assert_eq!(deepest.files.len(), 9);
}

#[test]
fn a_strategy_is_read_again_as_it_was_read_for_the_match() {
    let own = Own::new();
    let base = own.write("base.ron", shipped(AssetKind::Strategy, "hammerheads_2001"));
    let path = own.write("mine.ron", based_on("base"));
    let plan = on_the_small_pitch(&path).unwrap_or_else(|error| panic!("{error}"));
    let team = plan.team(Team::Home);
    assert_eq!(team.strategy_files, [path.clone(), base.clone()]);
    let again = plan.reread(Team::Home, &assets());
    assert_eq!(again.strategy.as_ref(), Ok(&*team.strategy), "read again, positions are stretched otherwise");
    assert_ne!(
        Strategy::read(&assets(), &path, None).strategy.as_ref(),
        Ok(&*team.strategy),
        "nothing is stretched"
    );

    // A change of the base is one of the strategy.
    own.write(
        "base.ron",
        shipped(AssetKind::Strategy, "hammerheads_2001").replace("speed: 0.7", "speed: 0.6"),
    );
    let changed = plan.reread(Team::Home, &assets()).strategy.expect("the base is sound");
    assert_ne!(changed, *team.strategy);
    let fresh = on_the_small_pitch(&path).expect("the match is sound");
    assert_eq!(changed, *fresh.team(Team::Home).strategy);
}

#[test]
fn a_strategy_that_a_match_would_refuse_is_refused_when_it_is_read_again() {
    let own = Own::new();
    let text = shipped(AssetKind::Strategy, "hammerheads_2001");
    let path = own.write("mine.ron", &text);
    let plan = on_the_small_pitch(&path).unwrap_or_else(|error| panic!("{error}"));
    let fault = |text: String| {
        own.write("mine.ron", text);
        let reading = plan.reread(Team::Home, &assets());
        (reading.strategy.expect_err("it is refused").to_string(), reading.files)
    };
    let (told, _) = fault(text.replace("[\"cye\", \"aibo_ers7\"]", "[\"cye\"]"));
    assert!(told.contains("mine.ron:12:18: robot_kinds: cannot be played by a `aibo_ers7`"), "{told}");
    let fewer = text.replace(", \"forward\"],\n    kick_off", "],\n    kick_off");
    let last = [", (-0.6, 0.0)]", ", (-0.95, 0.3)]", ", (2.5, 1.2)]"];
    let (told, _) = fault(last.iter().fold(fewer, |text, last| text.replace(last, "]")));
    assert!(told.contains("mine.ron:14:14: players: it has 3 players, and 4 are on the pitch"), "{told}");
    // A base that is not there yet is watched for.
    let (told, files) = fault(based_on("coming"));
    assert!(told.contains("there is no strategy `coming`"), "{told}");
    assert_eq!(files, [path, own.path("coming.ron"), assets().file(AssetKind::Strategy, "coming")]);
}

#[test]
fn a_scenarios_roles_are_given_to_a_strategy_that_is_read_again() {
    let own = Own::new();
    let strategy = own.write("team.ron", shipped(AssetKind::Strategy, "hammerheads_2001"));
    let scenario = format!(
        "(name: \"Mine\", source: \"a test\", game: \"four_legged_2005\", seconds: 1, ball: (at: (1, 0)),
          home: (strategy: {:?}, teamwork: (talk: (claim_radius: 3)), robot: \"aibo_ers7\", players: [(number: 0, at: (0, 0), role: \"forward\")]),
          expect: [Eventually(what: InZone(what: Ball, zone: Half(Home)), within: 1)])",
        strategy.to_string_lossy()
    );
    let scenario = own.write("scenario.ron", scenario);
    let plan = ScenarioPlan::read(&assets(), &scenario.into())
        .unwrap_or_else(|error| panic!("{error}"))
        .with_seed(1);
    let team = plan.team(Team::Home);
    let own_roles =
        Strategy::read(&assets(), &strategy, None).strategy.expect("the strategy is sound").players;
    assert_ne!(team.strategy.players, own_roles);
    assert_eq!(team.strategy.teamwork.talk.claim_radius, 3.0);
    assert_eq!(plan.reread(Team::Home, &assets()).strategy.as_ref(), Ok(&*team.strategy));
    own.write(
        "team.ron",
        shipped(AssetKind::Strategy, "hammerheads_2001").replace("\"forward\"", "\"striker\""),
    );
    let told = plan.reread(Team::Home, &assets()).strategy.expect_err("there is no such role").to_string();
    assert!(
        told.contains("roles: there is no role `forward`, which the scenario gives to player 0"),
        "{told}"
    );
}
