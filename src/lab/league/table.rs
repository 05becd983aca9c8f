//! What the matches of a league come to: a table with ratings.

use std::collections::BTreeMap;

use serde::Serialize;

use super::design::LeagueChoice;
use super::rating::{PairCounts, Ratings};
use crate::lab::experiment::{CONFIDENCE, ExperimentPlan, ExperimentRow, Metric};
use crate::lab::report::{ReportBlock, ReportDocument, ReportTable};
use crate::lab::statistics::{Interval, percentile_interval};
use crate::rng::{DEFAULT_SEED, Dice, Seed};

/// The teams of a league, the best one first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeagueTable {
    /// Best first.
    pub rows: Vec<TableRow>,
    /// The seeds that every pair has played on both sides; others do not count.
    pub seeds: usize,
    /// Davidson's ν: how often equal teams draw.
    pub draws: f64,
    /// The points of each team against each other one for a match, in the order of the rows; `None` against itself.
    pub points: Vec<Vec<Option<f64>>>,
}

/// A team of a league.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableRow {
    /// The strategy, as it was named.
    pub strategy: String,
    /// On Elo's scale, with 1500 in the mean.
    pub rating: f64,
    /// In which the rating lies, by bootstrap over the seeds.
    pub interval: Option<Interval>,
    /// Matches won, drawn and lost.
    pub counts: [u32; 3],
    /// Goals less those against for a match.
    pub goal_difference: f64,
}

/// So many samples of the seeds are drawn for the intervals of ratings.
const RESAMPLES: usize = 2000;
/// Each pair is taken to have drawn so many matches besides: without, a team that has won all would have no rating.
const DRAWN_BESIDES: f64 = 1.0;

/// The matches of all pairs with one seed, in the order of the pairs.
type SeedResults = Vec<PairCounts>;

impl LeagueTable {
    /// Sums the rows of a league up.
    pub fn of(choice: &LeagueChoice, plan: &ExperimentPlan, rows: &[ExperimentRow]) -> LeagueTable {
        let pairs: Vec<[usize; 2]> = choice.pairs().collect();
        let (seeds, differences) = by_seed(plan, rows, pairs.len());
        let number = choice.strategies.len();
        let fit = |sample: &[&SeedResults]| Ratings::fit(number, &sums(&pairs, sample));
        let all: Vec<&SeedResults> = seeds.iter().collect();
        let ratings = fit(&all);
        let intervals = intervals(&all, number, |sample| fit(sample).elo());
        let totals = totals(&pairs, &all);
        let mut order: Vec<usize> = (0..number).collect();
        let elo = ratings.elo();
        order.sort_by(|a, b| elo[*b].total_cmp(&elo[*a]));
        let row = |team: &usize| TableRow {
            strategy: choice.strategies[*team].clone(),
            rating: elo[*team],
            interval: intervals[*team],
            counts: counts(&totals[*team]),
            goal_difference: goal_difference(&pairs, &differences, *team),
        };
        let share =
            |a: usize, b: usize| (a != b).then(|| totals[a][b].points() / totals[a][b].matches().max(1.0));
        let points = order.iter().map(|a| order.iter().map(|b| share(*a, *b)).collect()).collect();
        LeagueTable {
            rows: order.iter().map(row).collect(),
            seeds: seeds.len(),
            draws: ratings.draws,
            points,
        }
    }

    /// As text, with the command that plays it again.
    pub fn document(&self, command: &str) -> ReportDocument {
        let blocks = vec![
            ReportBlock::Text(format!(
                "Every strategy against every other with {} seeds, each on both sides. Ratings are on Elo's scale with 1500 in the mean: \
                 400 more win ten times as often. They are the most likely ones in Davidson's model of wins and draws (1970), one drawn \
                 match a pair added, with intervals of 95 % by bootstrap over the seeds.",
                self.seeds
            )),
            ReportBlock::Code(command.to_owned()),
            ReportBlock::Table(self.standings()),
            ReportBlock::Text(
                "Points for a match against each other: 1 for a win, a half for a draw.".into(),
            ),
            ReportBlock::Table(self.cross_table()),
        ];
        ReportDocument { title: "League".into(), blocks }
    }

    /// The teams with their ratings.
    pub fn standings(&self) -> ReportTable {
        let head = ["", "strategy", "rating [95 %]", "won", "drawn", "lost", "goal difference"];
        let row = |(place, row): (usize, &TableRow)| {
            let interval = row.interval.map(|Interval { low, high }| format!(" [{low:.0}, {high:.0}]"));
            let rating = format!("{:.0}{}", row.rating, interval.unwrap_or_default());
            let [won, drawn, lost] = row.counts.map(|count| count.to_string());
            let difference = format!("{:+.2}", row.goal_difference);
            vec![(place + 1).to_string(), row.strategy.clone(), rating, won, drawn, lost, difference]
        };
        ReportTable {
            head: head.map(str::to_owned).into(),
            rows: self.rows.iter().enumerate().map(row).collect(),
            words: 2,
        }
    }

    /// Each against each.
    fn cross_table(&self) -> ReportTable {
        let numbers = (1..=self.rows.len()).map(|place| place.to_string());
        let head = ["", "strategy"].map(str::to_owned).into_iter().chain(numbers).collect();
        let rows = self.rows.iter().zip(&self.points).enumerate().map(|(place, (row, points))| {
            let points =
                points.iter().map(|share| share.map_or_else(String::new, |share| format!("{share:.2}")));
            [(place + 1).to_string(), row.strategy.clone()].into_iter().chain(points).collect()
        });
        ReportTable { head, rows: rows.collect(), words: 2 }
    }
}

/// The results of the seeds that all pairs have played whole, and the goal differences of each pair with them.
fn by_seed(plan: &ExperimentPlan, rows: &[ExperimentRow], pairs: usize) -> (Vec<SeedResults>, Vec<Vec<f64>>) {
    let mut seeds: BTreeMap<u64, Vec<(usize, f64)>> = BTreeMap::new();
    for row in rows {
        let ahead = row.result.as_ref().ok().and_then(|result| result.value(Metric::GoalDifference));
        if let Some(ahead) = ahead {
            seeds.entry(row.key.seed).or_default().push((row.key.treatment, ahead));
        }
    }
    let mut differences = vec![Vec::new(); pairs];
    let mut results = Vec::new();
    for matches in seeds.into_values().filter(|matches| matches.len() as u64 == plan.in_block()) {
        let mut of_pairs = vec![PairCounts::default(); pairs];
        for (pair, ahead) in matches {
            let counts = &mut of_pairs[pair];
            let count = if ahead > 0.0 {
                &mut counts.won
            } else if ahead < 0.0 {
                &mut counts.lost
            } else {
                &mut counts.drawn
            };
            *count += 1.0;
            differences[pair].push(ahead);
        }
        results.push(of_pairs);
    }
    (results, differences)
}

/// The results of each pair with all of some seeds, and the draws besides.
fn sums(pairs: &[[usize; 2]], seeds: &[&SeedResults]) -> Vec<([usize; 2], PairCounts)> {
    let of_pair = |(place, pair): (usize, &[usize; 2])| {
        let begin = PairCounts { drawn: DRAWN_BESIDES, ..PairCounts::default() };
        (*pair, seeds.iter().fold(begin, |sum, seed| sum.and(seed[place])))
    };
    pairs.iter().enumerate().map(of_pair).collect()
}

/// Of each team's rating, from seeds drawn with replacement.
fn intervals(
    seeds: &[&SeedResults],
    teams: usize,
    rate: impl Fn(&[&SeedResults]) -> Vec<f64>,
) -> Vec<Option<Interval>> {
    if seeds.len() < 2 {
        return vec![None; teams];
    }
    let mut dice = Dice::new(Seed(DEFAULT_SEED), "league", None);
    let mut ratings = vec![Vec::with_capacity(RESAMPLES); teams];
    for _ in 0..RESAMPLES {
        let sample: Vec<&SeedResults> = seeds.iter().map(|_| seeds[dice.below(seeds.len())]).collect();
        ratings.iter_mut().zip(rate(&sample)).for_each(|(all, rating)| all.push(rating));
    }
    ratings.into_iter().map(|ratings| percentile_interval(ratings, CONFIDENCE)).collect()
}

/// The results of each team against each other one.
fn totals(pairs: &[[usize; 2]], seeds: &[&SeedResults]) -> Vec<Vec<PairCounts>> {
    let teams = pairs.iter().flatten().max().map_or(0, |last| last + 1);
    let mut totals = vec![vec![PairCounts::default(); teams]; teams];
    for seed in seeds {
        for ([first, second], counts) in pairs.iter().zip(*seed) {
            totals[*first][*second] = totals[*first][*second].and(*counts);
            totals[*second][*first] = totals[*second][*first].and(counts.turned());
        }
    }
    totals
}

/// Won, drawn and lost.
fn counts(against: &[PairCounts]) -> [u32; 3] {
    let sum = against.iter().fold(PairCounts::default(), |sum, counts| sum.and(*counts));
    [sum.won, sum.drawn, sum.lost].map(|count| count as u32)
}

/// Of a team for a match.
fn goal_difference(pairs: &[[usize; 2]], differences: &[Vec<f64>], team: usize) -> f64 {
    let of_pair = |([first, second], differences): (&[usize; 2], &Vec<f64>)| {
        let sign = f64::from(i8::from(*first == team) - i8::from(*second == team));
        let count = if sign == 0.0 { 0 } else { differences.len() };
        (sign * differences.iter().sum::<f64>(), count)
    };
    let all = pairs.iter().zip(differences).map(of_pair);
    let (sum, count) = all.fold((0.0, 0), |(sum, count), (ahead, matches)| (sum + ahead, count + matches));
    if count > 0 { sum / count as f64 } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts_of(won: f64, drawn: f64, lost: f64) -> PairCounts {
        PairCounts { won, drawn, lost }
    }

    #[test]
    fn the_results_of_a_pair_are_those_of_either_team() {
        let pairs = [[0, 1], [0, 2], [1, 2]];
        let seed = vec![counts_of(2.0, 0.0, 0.0), counts_of(1.0, 1.0, 0.0), counts_of(0.0, 1.0, 1.0)];
        let totals = totals(&pairs, &[&seed, &seed]);
        assert_eq!(counts(&totals[0]), [6, 2, 0]);
        assert_eq!(counts(&totals[1]), [0, 2, 6]);
        assert_eq!(counts(&totals[2]), [2, 4, 2]);
        let differences = [vec![2.0, 4.0], vec![1.0, 0.0], vec![0.0, -1.0]];
        assert_eq!(goal_difference(&pairs, &differences, 0), 1.75);
        assert_eq!(goal_difference(&pairs, &differences, 1), -1.75);
        assert_eq!(goal_difference(&pairs, &differences, 2), 0.0);
    }

    #[test]
    fn an_interval_holds_the_rating_and_needs_two_seeds() {
        let pairs = [[0, 1]];
        let seeds: Vec<SeedResults> =
            (0..20).map(|seed| vec![counts_of(1.0, f64::from(seed % 2), 0.5)]).collect();
        let all: Vec<&SeedResults> = seeds.iter().collect();
        let rate = |sample: &[&SeedResults]| Ratings::fit(2, &sums(&pairs, sample)).elo();
        let rating = rate(&all)[0];
        let found = intervals(&all, 2, rate);
        assert!(found[0].is_some_and(|interval| interval.holds(rating)), "{found:?} {rating}");
        assert_eq!(intervals(&all[..1], 2, rate), [None, None]);
    }
}
