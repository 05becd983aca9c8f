//! Scenarios whose expectations must be met with a probability.

use std::fs;

use serde_json::Value;

use super::Own;

const TWO: &str = r#"(
    source: "a test",
    seconds: 0.1,
    seeds: 40,
    home: (strategy: "ball_chasers", players: [(number: 0, at: (-3, 0))]),
    ball: (at: (2, 2)),
    expect: [Always(what: Speed(of: Ball, below: 9))],
    variants: {
        "met": (
            name: "The ball is near",
            expect: [Probability(of: Finally(what: Distance(from: Ball, to: At(2, 2), below: 1)), at_least: 0.5, confidence: 0.9)],
        ),
        "missed": (
            name: "The ball is far",
            expect: [Probability(of: Finally(what: Distance(from: Ball, to: At(2, 2), above: 1)), at_least: 0.5, confidence: 0.9)],
        ),
    },
)"#;

#[test]
fn seeds_are_played_until_a_probability_is_shown_or_refuted() {
    let own = Own::new();
    own.write("two.ron", TWO);
    let (told, code) = own.check(&["--json", "rows.json", "two.ron"]);
    assert_eq!(code, Some(1), "{told}");
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines[0], "ok    The ball is near [met] (5 seeds)");
    assert_eq!(
        lines[1],
        "      met with 5 of 5 seeds: with a probability of at least 0.5 (confidence 0.9), at the end: the ball is less than 1 m \
         from (2, 2)"
    );
    assert_eq!(lines[2], "FAIL  The ball is far [missed]: 5 of 5 seeds");
    assert!(lines[3].starts_with("      too seldom, met with 0 of 5 seeds: with a probability"), "{told}");
    assert!(
        lines[4].starts_with("      all 5 seeds, tick 6 (0.10 s): expected with a probability"),
        "{told}"
    );
    assert_eq!(lines[5..], ["1 scenario: 1 of 2 scenarios failed"]);
    let rows: Value =
        serde_json::from_str(&fs::read_to_string(own.path("rows.json")).expect("it is written"))
            .expect("it is JSON");
    for (row, (outcome, met, verdict)) in
        [("Passed", 5, "Met"), ("Failed", 0, "Missed")].into_iter().enumerate()
    {
        let row = &rows[row];
        assert_eq!((&row["outcome"], &row["seeds"]), (&outcome.into(), &5.into()), "{row}");
        let probability = &row["probabilities"][0];
        assert_eq!((&probability["met"], &probability["of"]), (&met.into(), &5.into()), "{row}");
        assert_eq!(probability["verdict"], verdict, "{row}");
    }
}

#[test]
fn played_with_one_seed_a_scenario_shows_what_it_came_to_there() {
    let own = Own::new();
    own.write("two.ron", TWO);
    for (name, line) in [
        ("two.ron:met", "ok    The ball is near [met] (1 seed)"),
        ("two.ron:missed", "FAIL  The ball is far [missed]: 1 of 1 seed"),
    ] {
        let output = own.touchline(&["play", name]);
        let told = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(told.lines().next(), Some(line), "{told}");
    }
}
