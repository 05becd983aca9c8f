//! Ratings from who beat whom, with draws: the most likely strengths in Davidson's model.

use std::f64::consts::LN_10;

use crate::ops;

/// How the matches of two teams ended, those of the first one. Counts may be parts of a match.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairCounts {
    /// Won by the first.
    pub won: f64,
    /// Drawn.
    pub drawn: f64,
    /// Won by the second.
    pub lost: f64,
}

impl PairCounts {
    /// All of them.
    pub fn matches(self) -> f64 {
        self.won + self.drawn + self.lost
    }

    /// Those of the first team, where a draw is half a point.
    pub fn points(self) -> f64 {
        self.won + self.drawn / 2.0
    }

    /// Together with more matches.
    #[must_use]
    pub fn and(self, more: PairCounts) -> PairCounts {
        PairCounts { won: self.won + more.won, drawn: self.drawn + more.drawn, lost: self.lost + more.lost }
    }

    /// Those of the second team.
    #[must_use]
    pub fn turned(self) -> PairCounts {
        PairCounts { won: self.lost, lost: self.won, ..self }
    }
}

/// Strengths of teams, and how often equal ones draw.
///
/// In the model of R. R. Davidson (*On extending the Bradley-Terry model to accommodate ties in paired comparison experiments*, 1970) two
/// teams of strengths `p` and `q` win and draw as `p : q : ν √(p q)`. The most likely strengths give every team as many points as it has,
/// and as many draws in all as there were.
#[derive(Clone, Debug, PartialEq)]
pub struct Ratings {
    /// The logarithms of the strengths; their mean is 0.
    pub logs: Vec<f64>,
    /// Davidson's ν: 0 if nobody ever draws, 2 if equal teams draw every second match.
    pub draws: f64,
}

/// Points of Elo's scale between two teams of which one wins ten times as often as the other: 400.
const ELO: f64 = 400.0;
/// The mean rating on Elo's scale.
const MEAN_ELO: f64 = 1500.0;
/// No more steps than these.
const SWEEPS: usize = 1000;
/// A change of a logarithm that is none.
const STILL: f64 = 1e-11;
/// No step is longer than this, and no logarithm gets larger than `FARTHEST`: who has won all has no finite strength.
const STEP: f64 = 1.0;
const FARTHEST: f64 = 20.0;

impl Ratings {
    /// The most likely strengths of so many teams; of each pair of them, by their places, how its matches ended. The likelihood has one
    /// maximum, which is climbed along one logarithm after the other by Newton's steps.
    pub fn fit(teams: usize, pairs: &[([usize; 2], PairCounts)]) -> Ratings {
        let drawn: f64 = pairs.iter().map(|(_, counts)| counts.drawn).sum();
        let mut model = Model { logs: vec![0.0; teams], log_draws: (drawn > 0.0).then_some(0.0) };
        for _ in 0..SWEEPS {
            let mut change = model.log_draws.map_or(0.0, |_| model.climb_draws(pairs, drawn));
            for team in 0..teams {
                change = model.climb_team(pairs, team).max(change);
            }
            if change < STILL {
                break;
            }
        }
        let centre = model.logs.iter().sum::<f64>() / teams.max(1) as f64;
        let logs = model.logs.iter().map(|log| log - centre).collect();
        Ratings { logs, draws: model.log_draws.map_or(0.0, ops::exp_f64) }
    }

    /// On Elo's scale, where the mean is 1500 and 400 more win ten times as often.
    pub fn elo(&self) -> Vec<f64> {
        self.logs.iter().map(|log| MEAN_ELO + ELO * log / LN_10).collect()
    }
}

struct Model {
    logs: Vec<f64>,
    /// `None` if there are no draws.
    log_draws: Option<f64>,
}

impl Model {
    /// How likely the first of two teams wins, draws and loses.
    fn outcomes(&self, [first, second]: [usize; 2]) -> [f64; 3] {
        let ahead = self.logs[first] - self.logs[second];
        let won = ops::exp_f64(ahead / 2.0);
        let lost = 1.0 / won;
        let drawn = self.log_draws.map_or(0.0, ops::exp_f64);
        [won, drawn, lost].map(|part| part / (won + drawn + lost))
    }

    /// Returns by how much it changed.
    fn climb_team(&mut self, pairs: &[([usize; 2], PairCounts)], team: usize) -> f64 {
        let (mut missing, mut spread) = (0.0, 0.0);
        for (pair, counts) in pairs {
            let [won, drawn, lost] = self.outcomes(*pair);
            let (expected, points) = match pair.iter().position(|place| *place == team) {
                Some(0) => (won + drawn / 2.0, counts.points()),
                Some(_) => (lost + drawn / 2.0, counts.matches() - counts.points()),
                None => continue,
            };
            missing += points - counts.matches() * expected;
            let square = drawn / 4.0 + if pair[0] == team { won } else { lost };
            spread += counts.matches() * (square - expected * expected);
        }
        step(&mut self.logs[team], missing, spread)
    }

    fn climb_draws(&mut self, pairs: &[([usize; 2], PairCounts)], all: f64) -> f64 {
        let (mut missing, mut spread) = (all, 0.0);
        for (pair, counts) in pairs {
            let [_, drawn, _] = self.outcomes(*pair);
            missing -= counts.matches() * drawn;
            spread += counts.matches() * drawn * (1.0 - drawn);
        }
        self.log_draws.as_mut().map_or(0.0, |log| step(log, missing, spread))
    }
}

fn step(log: &mut f64, missing: f64, spread: f64) -> f64 {
    if spread <= 0.0 {
        return 0.0;
    }
    let before = *log;
    *log = (before + (missing / spread).clamp(-STEP, STEP)).clamp(-FARTHEST, FARTHEST);
    (*log - before).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(won: f64, drawn: f64, lost: f64) -> PairCounts {
        PairCounts { won, drawn, lost }
    }

    #[track_caller]
    fn assert_near(value: f64, expected: f64) {
        assert!((value - expected).abs() < 1e-6, "{value}, not {expected}");
    }

    #[test]
    fn of_two_teams_the_strengths_are_as_their_wins_and_draws_are_as_the_closed_form_has_them() {
        for (won, drawn, lost) in [(10.0, 5.0, 5.0), (30.0, 0.0, 3.0), (7.0, 20.0, 9.0)] {
            let ratings = Ratings::fit(2, &[([0, 1], counts(won, drawn, lost))]);
            assert_near(ratings.logs[0] - ratings.logs[1], ops::ln_f64(won / lost));
            assert_near(ratings.draws, drawn / f64::sqrt(won * lost));
            assert_near(ratings.logs[0] + ratings.logs[1], 0.0);
        }
        let ratings = Ratings::fit(2, &[([1, 0], counts(10.0, 0.0, 1.0))]);
        assert_near(ratings.elo()[1] - ratings.elo()[0], 400.0);
        assert_near(ratings.elo()[0] + ratings.elo()[1], 3000.0);
    }

    #[test]
    fn the_strengths_that_made_the_results_are_found_again() {
        let truth = Model { logs: vec![0.9, 0.2, -0.3, -0.8], log_draws: Some(ops::ln_f64(0.6)) };
        let pairs = [[0, 1], [0, 2], [0, 3], [2, 1], [1, 3], [3, 2]].map(|pair| {
            let [won, drawn, lost] = truth.outcomes(pair).map(|share| 40.0 * share);
            (pair, counts(won, drawn, lost))
        });
        let ratings = Ratings::fit(4, &pairs);
        ratings.logs.iter().zip(&truth.logs).for_each(|(log, truth)| assert_near(*log, *truth));
        assert_near(ratings.draws, 0.6);
    }

    #[test]
    fn teams_that_beat_each_other_in_a_circle_are_equal() {
        let pairs = [
            ([0, 1], counts(3.0, 1.0, 1.0)),
            ([1, 2], counts(3.0, 1.0, 1.0)),
            ([2, 0], counts(3.0, 1.0, 1.0)),
        ];
        Ratings::fit(3, &pairs).logs.iter().for_each(|log| assert_near(*log, 0.0));
    }

    #[test]
    fn who_wins_all_gets_a_finite_rating() {
        let ratings = Ratings::fit(2, &[([0, 1], counts(5.0, 0.0, 0.0))]);
        assert!(ratings.elo().iter().all(|elo| elo.is_finite()) && ratings.logs[0] > 5.0, "{ratings:?}");
        assert!(Ratings::fit(0, &[]).logs.is_empty());
    }
}
