//! What a script does that only a whole match shows: a person drives a robot, and a team changes its strategy.

use std::path::PathBuf;

use touchline::data::AssetTexts;
use touchline::lab::scenario::{ScenarioPlan, ScenarioRef};

use crate::support::assets;

/// What a scenario with this home team, script and expectations fails to show.
fn failures(home: &str, script: &str, expect: &str) -> Vec<String> {
    let text = format!(
        r#"(name: "x", source: "a test", seconds: 5, seeds: 1, ball: (at: (3.0, 2.0)),
        home: ({home}), script: [{script}], expect: [{expect}])"#
    );
    let path = PathBuf::from("events.ron");
    let assets = assets().with_texts(AssetTexts::from([(path.clone(), text)]));
    let plan =
        ScenarioPlan::read(&assets, &ScenarioRef::from(path)).unwrap_or_else(|error| panic!("{error}"));
    let runs = plan.run(None).runs.into_iter();
    runs.flat_map(|run| run.verdict.failures).map(|failure| failure.reason).collect()
}

#[test]
fn a_person_at_the_levers_drives_a_robot_until_it_is_handed_back() {
    let home = r#"strategy: "ball_chasers", players: [(number: 0, at: (-3.0, 0.0), facing: 180)]"#;
    let away_from_ball = r#"Always(what: InZone(what: Robot("home 0"), zone: Half(Home)), until: 3)"#;
    let drives = r#"(at: 0, what: TakeOver("home 0")), (at: 0.1, what: Steer(robot: "home 0", turn: 0.5))"#;
    let back = r#"(at: 3, what: HandBack("home 0"))"#;
    let moves = r#"Eventually(what: Distance(from: Robot("home 0"), to: At(-3.0, 0.0), above: 0.5), within: 2, after: 3)"#;
    let stays = r#"Always(what: Distance(from: Robot("home 0"), to: At(-3.0, 0.0), below: 0.3), until: 3)"#;
    let expect = format!("{away_from_ball}, {stays}, {moves}");
    assert_eq!(failures(home, &format!("{drives}, {back}"), &expect), [""; 0]);
    assert_eq!(failures(home, "", &expect).len(), 1, "it goes for the ball at once");
}

#[test]
fn a_team_plays_on_with_another_strategy() {
    let home = r#"strategy: "hammerheads_swap", line_up: "at_home""#;
    let changes = r#"(at: 1, what: Strategy(team: Home, name: "hammerheads_2001"))"#;
    let swap = r#"(at: 2, what: InitiateSwap(robot: "home 1", roles: [("halfback", "forward"), ("forward", "halfback")]))"#;
    let expect = r#"Never(what: Sent(kind: Lock, from: "home 1"))"#;
    assert_eq!(failures(home, &format!("{changes}, {swap}"), expect), [""; 0], "the other one does not swap");
    assert_eq!(failures(home, swap, expect).len(), 1);
}
