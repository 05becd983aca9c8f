//! Scenarios of which one file holds several, and what they change of a strategy's teamwork.

use std::fs;

use touchline::data::AssetKind;
use touchline::game::{Choice, MatchPlan};
use touchline::ids::Team;
use touchline::lab::scenario::{ScenarioPlan, ScenarioRef};
use touchline::strategy::teamwork::Protocol;

use super::{Own, shipped};
use crate::support::assets;

const TWO: &str = r#"(
    source: "a test",
    seconds: 1,
    seeds: 2,
    home: (strategy: "hammerheads_swap", line_up: "at_home"),
    ball: (at: (-4.2, -2.2)),
    expect: [Never(what: RoleOf("home 3", "halfback"))],
    variants: {
        "hardened": (
            name: "One is hardened",
            expect: [Always(what: RoleOf("home 1", "halfback"))],
            depends_on: HardenedSwap,
        ),
        "paper": (
            name: "The other is the paper's",
            home: (teamwork: (role_swap: (protocol: Paper(on_missing_ack: RollBack, unlock: AtTimeout)))),
            seconds: 0.5,
            expect: [Always(what: RoleOf("home 2", "floater"))],
        ),
    },
)"#;

#[test]
fn a_variant_is_the_file_with_what_it_says_itself() {
    let own = Own::new();
    let path = own.write("two.ron", TWO);
    let plans =
        ScenarioPlan::read_all(&assets(), &path.clone().into()).unwrap_or_else(|error| panic!("{error}"));
    let [hardened, paper] = &plans[..] else { panic!("{} variants", plans.len()) };
    assert_eq!((hardened.scenario.seconds, paper.scenario.seconds), (1.0, 0.5));
    assert_eq!(hardened.scenario.seeds, paper.scenario.seeds);
    assert_eq!(hardened.scenario.expect[0], paper.scenario.expect[0], "the file's own come first");
    assert_eq!([hardened.scenario.expect.len(), paper.scenario.expect.len()], [2, 2]);
    assert_ne!(hardened.scenario.expect[1], paper.scenario.expect[1]);
    let swap = |plan: &ScenarioPlan| {
        let played = plan.with_seed(1);
        played.team(Team::Home).strategy.teamwork.role_swap.clone().expect("the team swaps roles")
    };
    assert_eq!(swap(hardened).protocol, Protocol::Hardened);
    assert!(matches!(swap(paper).protocol, Protocol::Paper(_)));
    assert_eq!((swap(hardened).policy, swap(hardened).timers), (swap(paper).policy, swap(paper).timers));
    let third = hardened.scenario.players().nth(3).expect("all players of the line-up");
    assert_eq!((third.pose.position.x, third.pose.position.y), (2.5, 1.2));
    let named = ScenarioRef { path, variant: Some("paper".into()) };
    assert_eq!(ScenarioPlan::read(&assets(), &named).expect("it is sound").scenario, paper.scenario);
}

#[test]
fn every_variant_is_played_under_its_name_or_the_one_that_is_named() {
    let own = Own::new();
    own.write("two.ron", TWO);
    let lines =
        ["ok    One is hardened [hardened] (2 seeds)", "ok    The other is the paper's [paper] (2 seeds)"];
    let (told, code) = own.check(&["--junit", "report.xml", "two.ron"]);
    let last = "1 scenario: all sound";
    assert_eq!((told.lines().collect::<Vec<_>>(), code), (vec![lines[0], lines[1], last], Some(0)));
    let junit = fs::read_to_string(own.path("report.xml")).expect("the report is written");
    assert!(
        junit.contains("classname=\"two.ron:hardened\"") && junit.contains("classname=\"two.ron:paper\"")
    );
    let (told, _) = own.check(&["two.ron:paper"]);
    assert_eq!(told.lines().collect::<Vec<_>>(), [lines[1], last]);
    for (name, line) in [("two.ron", lines[0]), ("two.ron:paper", lines[1])] {
        let output = own.touchline(&["play", name]);
        let told = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(told.trim_end(), line.replace("2 seeds", "1 seed"));
    }
    let (told, code) = own.check(&["two.ron:papyrus"]);
    let fault = "fault two.ron:8:15: variants: there is no variant `papyrus`; known: hardened, paper";
    assert_eq!((told.lines().next(), code), (Some(fault), Some(2)));
}

#[test]
fn a_fault_is_told_where_the_file_or_the_variant_has_it() {
    let own = Own::new();
    for (piece, instead, fault) in [
        ("seconds: 1,", "seconds: -1,", ":3:14: seconds: must be at least 0.001 s, not -1"),
        ("seconds: 0.5", "seconds: -1", ":17:22: variants.paper.seconds: must be at least 0.001 s, not -1"),
        (
            "            name: \"One is hardened\",\n",
            "",
            ":9:21: variants.hardened: the field `name` is missing",
        ),
        ("strategy: \"hammerheads_swap\", ", "", ":5:11: home: the field `strategy` is missing"),
        ("at_home", "nowhere", ":5:51: home.line_up: there is no line-up `nowhere`; known: at_home"),
        (
            "\"home 3\", \"half",
            "\"home 7\", \"half",
            ":7:33: expect[0].Never.what.RoleOf[0]: there is no robot",
        ),
        (
            "\"floater\"",
            "\"boater\"",
            ":18:52: variants.paper.expect[0].Always.what.RoleOf[1]: there is no role `boater`",
        ),
        (
            "unlock: AtTimeout)",
            "unlock: AtTimeout), timers: (acks: -1)",
            "variants.paper.home.teamwork.role_swap.timers.acks: must be at least 0.001 s, not -1",
        ),
        (
            "seconds: 0.5",
            "depends_on: HardenedSwap",
            "variants.paper.depends_on: the hardened role swap is not on in the home team's strategy",
        ),
        (
            "seconds: 0.5",
            "variants: {\"x\": ()}",
            ":17:23: variants.paper.variants: a variant has none of its own",
        ),
        (
            "seconds: 0.5",
            "second: 1",
            ":17:13: variants.paper.second: there is no field `second`; known: name",
        ),
    ] {
        assert!(TWO.contains(piece), "{piece}");
        own.write("two.ron", TWO.replacen(piece, instead, 1));
        let (told, code) = own.check(&["two.ron"]);
        let first = told.lines().next().unwrap_or_default();
        assert!(first.starts_with("fault two.ron:") && first.contains(fault), "{fault}: {told}");
        assert_eq!(code, Some(2));
    }
}

#[test]
fn two_variants_of_one_name_are_told_apart() {
    let own = Own::new();
    own.write("two.ron", TWO.replacen("The other is the paper's", "One is hardened", 1));
    let (told, code) = own.check(&["two.ron"]);
    let fault = "fault two.ron:15:19: variants.paper.name: is also the name of two.ron:hardened";
    assert_eq!((told.lines().nth(1), code), (Some(fault), Some(2)), "{told}");
}

#[test]
fn a_side_without_players_lines_up_as_for_its_own_kick_off() {
    let own = Own::new();
    let text = TWO.replacen(", line_up: \"at_home\"", "", 1);
    let plan = ScenarioPlan::read(&assets(), &own.write("two.ron", text).into());
    let plan = plan.unwrap_or_else(|error| panic!("{error}"));
    let places: Vec<_> = plan.scenario.players().map(|player| player.pose.position).collect();
    assert_eq!(places, plan.with_seed(1).team(Team::Home).strategy.kick_off.ours);
}

#[test]
fn a_match_changes_the_teamwork_of_its_own_strategy_and_of_no_other() {
    let own = Own::new();
    let text = shipped(AssetKind::Match, "friendly");
    let change = "strategy: \"hammerheads_2001\", teamwork: (talk: (claim_radius: 2.5))";
    let read = |text: String, home: Option<&str>| {
        let file = Some(own.write("mine.ron", text).to_string_lossy().into_owned());
        MatchPlan::read(&assets(), &Choice { file, home: home.map(str::to_owned), ..Choice::default() })
    };
    let changed = text.replacen("strategy: \"hammerheads_2001\"", change, 1);
    assert_ne!(changed, text);
    let talk = |plan: MatchPlan| plan.team(Team::Home).strategy.teamwork.talk;
    let usual = talk(read(text, None).expect("the match is sound"));
    let played = talk(read(changed.clone(), None).expect("the match is sound"));
    assert_eq!((played.claim_radius, played.claim_every), (2.5, usual.claim_every));
    assert_eq!(talk(read(changed.clone(), Some("hammerheads_2001")).expect("it is sound")), usual);
    let error = read(changed.replacen("2.5", "-2.5", 1), None).expect_err("it is refused").to_string();
    assert!(
        error.contains("mine.ron:") && error.contains("home.teamwork.talk.claim_radius: must be"),
        "{error}"
    );
}
