//! Duels of a strategy against itself: neither side of a duel and neither team has an advantage.

use touchline::lab::duel::{DuelChoice, DuelPlan, DuelReport, DuelTeams};

use crate::support::assets;

/// Even trials of one robot against one of the same strategy.
fn one_against_one(file: &str, strategy: &str, trials: u32) -> DuelReport {
    let strategy = Some(strategy.to_owned());
    let choice = DuelChoice {
        file: Some(file.to_owned()),
        home: strategy.clone(),
        away: strategy,
        teams: DuelTeams([1, 1]),
        trials,
        seed: 10_000,
        seconds: 20.0,
    };
    DuelPlan::read(&assets(), &choice).expect("the shipped files are sound").run(|_| true)
}

/// With 100 decided trials a fair duel lies within 0.35 to 0.65 with a probability of 99.7 %, and one whose true share is 0.75
/// lies outside with 98 %: the test finds great advantages and no small ones.
#[test]
fn a_strategy_wins_half_of_the_balls_against_itself_as_either_side_and_either_team() {
    for (file, strategy) in [("friendly", "ball_chasers"), ("four_legged_2005", "chaos_plain")] {
        let report = one_against_one(file, strategy, 240);
        assert!(report.home.of >= 100, "{report}");
        for share in [report.first.brought_out, report.home] {
            assert!((0.35..=0.65).contains(&share.share), "{file}: {report}");
        }
    }
}
