//! What came out of a duel.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::choice::{DuelChoice, DuelTeams};
use super::judge::{TrialOutcome, TrialResult};
use crate::data::in_one_line;
use crate::ids::Team;
use crate::lab::statistics::Share;

/// The result of a duel. Shares are of the trials that were decided.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DuelReport {
    /// The side that was named for home.
    pub first: SideReport,
    /// The other one.
    pub second: SideReport,
    /// What the team called home won, whichever side that was: near a half if the program favours no team.
    pub home: Share,
    /// Trials that were played.
    pub trials: u32,
    /// Trials in which nobody brought the ball out in time.
    pub undecided: u32,
    /// The seed of the first trial.
    pub seed: u64,
    /// Whether trials are missing.
    pub interrupted: bool,
}

/// One side of a duel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SideReport {
    /// What it plays.
    pub strategy: String,
    /// What its robots are built as.
    pub kind: String,
    /// How many robots it has.
    pub robots: u8,
    /// The trials in which it brought the ball out its way.
    pub brought_out: Share,
}

impl DuelReport {
    pub(super) fn new(names: [[String; 2]; 2], choice: &DuelChoice, results: &[TrialResult]) -> DuelReport {
        let won = |wins: &dyn Fn(Team, Team) -> bool| {
            let won = results.iter().filter(|it| match it.outcome {
                TrialOutcome::Won(team) => wins(team, it.first),
                TrialOutcome::Undecided => false,
            });
            won.count() as u32
        };
        let (trials, decided) = (results.len() as u32, won(&|_, _| true));
        let DuelTeams(robots) = choice.teams;
        let [first, second] = names;
        let side = |[strategy, kind]: [String; 2], robots, won| SideReport {
            strategy,
            kind,
            robots,
            brought_out: Share::new(won, decided),
        };
        DuelReport {
            first: side(first, robots[0], won(&|winner, first| winner == first)),
            second: side(second, robots[1], won(&|winner, first| winner != first)),
            home: Share::new(won(&|winner, _| winner == Team::Home), decided),
            trials,
            undecided: trials - decided,
            seed: choice.seed,
            interrupted: trials < choice.trials,
        }
    }
}

impl Display for DuelReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.interrupted {
            writeln!(f, "interrupted after {} trials; the result so far:", self.trials)?;
        }
        for side in [&self.first, &self.second] {
            let SideReport { robots, brought_out, .. } = side;
            let (strategy, kind) = (in_one_line(&side.strategy), in_one_line(&side.kind));
            writeln!(f, "{strategy}, {robots} x {kind}: {}", Percent(*brought_out))?;
        }
        writeln!(f, "the team called home, of both: {}", Percent(self.home))?;
        write!(f, "{} trials, {} undecided, seed {}", self.trials, self.undecided, self.seed)
    }
}

/// "52.0 % [43.2, 60.7], 52 of 100".
struct Percent(Share);

impl Display for Percent {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Share { won, of, share, low, high } = self.0;
        write!(f, "{:.1} % [{:.1}, {:.1}], {won} of {of}", 100.0 * share, 100.0 * low, 100.0 * high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(results: &[(Team, TrialOutcome)], trials: u32) -> DuelReport {
        let choice = DuelChoice {
            file: None,
            home: None,
            away: None,
            teams: DuelTeams([2, 1]),
            trials,
            seed: 5,
            seconds: 10.0,
        };
        let names = [["a", "cye"], ["b", "cye"]].map(|names| names.map(str::to_owned));
        let results: Vec<_> =
            results.iter().map(|(first, outcome)| TrialResult { first: *first, outcome: *outcome }).collect();
        DuelReport::new(names, &choice, &results)
    }

    #[test]
    fn wins_count_for_the_side_whichever_team_it_was() {
        use Team::{Away, Home};
        use TrialOutcome::{Undecided, Won};
        let report = report(&[(Home, Won(Home)), (Away, Won(Away)), (Home, Won(Away)), (Away, Undecided)], 4);
        assert_eq!((report.first.brought_out.won, report.second.brought_out.won), (2, 1));
        assert_eq!((report.home.won, report.home.of, report.undecided), (1, 3, 1));
        assert!(!report.interrupted);
    }

    #[test]
    fn a_duel_that_was_stopped_says_so() {
        let report = report(&[(Team::Home, TrialOutcome::Won(Team::Home))], 10);
        assert!(report.interrupted && report.to_string().starts_with("interrupted after 1 trials"));
    }

    #[test]
    fn people_read_shares_with_intervals() {
        let text = report(&[(Team::Home, TrialOutcome::Won(Team::Home))], 1).to_string();
        assert!(text.contains("a, 2 x cye: 100.0 % [20.7, 100.0], 1 of 1"), "{text}");
        assert!(text.ends_with("1 trials, 0 undecided, seed 5"), "{text}");
    }
}
