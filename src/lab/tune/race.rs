//! Iterated racing: which candidates play on which seeds, and which is best. Pure: scores and dice in, a winner out.
//!
//! Candidates play the same seeds side by side, and who is worse than the best so far by Wilcoxon's test of their paired scores leaves
//! the race. The next race begins with the best of the one before and with new candidates about them, ever nearer (Birattari, Stützle,
//! Paquete, Varrentrapp, *A racing algorithm for configuring metaheuristics*, 2002; López-Ibáñez and others, *The irace package*, 2016).

use thiserror::Error;

use crate::lab::statistics::{mean, signed_rank};
use crate::rng::Dice;

/// Where candidates are sought.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSpace {
    /// The values of before: the first candidate.
    pub original: Vec<f64>,
    /// The least and the most of each parameter.
    pub ranges: Vec<(f64, f64)>,
}

/// How candidates race.
#[derive(Clone, Debug, PartialEq)]
pub struct RaceRules {
    /// How many begin each race.
    pub candidates: usize,
    /// How many races there are.
    pub races: usize,
    /// The seeds that they play, in this order.
    pub seeds: Vec<u64>,
}

/// A candidate in the races.
#[derive(Clone, Debug, PartialEq)]
pub struct RaceEntrant {
    /// The number under which it came in; that of the values of before is 0.
    pub number: usize,
    /// One value for each parameter.
    pub values: Vec<f64>,
    /// One for each seed that it played, the first ones; more is better.
    pub scores: Vec<f64>,
}

/// Why races came to no end.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum RaceEnd<E> {
    /// Scores could not be had.
    #[error(transparent)]
    Scores(E),
    /// No values were found that are allowed.
    #[error("of {ATTEMPTS} candidates in a row none keeps the bounds and relations that are stated")]
    NothingAllowed,
}

/// Seeds between two tests.
const STRIDE: usize = 5;
/// Who is worse than the best at this level leaves the race.
const LEVEL: f64 = 0.05;
/// How many go on to the next race.
const ELITE: usize = 3;
/// How far the new candidates of the second race lie about the best of the first, in ranges, as a standard deviation.
const FIRST_SPREAD: f64 = 0.2;
/// How much nearer those of each race lie than those of the one before.
const NEARER: f64 = 0.6;
/// Candidates that may be refused in a row.
const ATTEMPTS: usize = 1000;

/// Lets candidates race, and gives the best of the last race with its scores. `admits` says whether values are allowed; `scores`
/// gives those of each entrant on each seed, and none for one that is to leave at once.
///
/// # Errors
/// If no candidate is allowed, or the first error of the scores.
pub fn race<E>(
    space: &ParameterSpace,
    rules: &RaceRules,
    dice: &mut Dice,
    mut admits: impl FnMut(&[f64]) -> bool,
    mut scores: impl FnMut(&[RaceEntrant], &[u64]) -> Result<Vec<Option<Vec<f64>>>, E>,
) -> Result<RaceEntrant, RaceEnd<E>> {
    let mut field = vec![RaceEntrant { number: 0, values: space.original.clone(), scores: Vec::new() }];
    let mut entered = 1;
    let mut spread = None;
    for _ in 0..rules.races {
        let parents: Vec<Vec<f64>> = field.iter().map(|entrant| entrant.values.clone()).collect();
        while field.len() < rules.candidates {
            let mut attempts = (0..ATTEMPTS).map(|_| space.draw(&parents, spread, dice));
            let values = attempts.find(|values| admits(values)).ok_or(RaceEnd::NothingAllowed)?;
            field.push(RaceEntrant { number: entered, values, scores: Vec::new() });
            entered += 1;
        }
        run(&mut field, &rules.seeds, &mut scores).map_err(RaceEnd::Scores)?;
        field.truncate(ELITE);
        spread = Some(spread.map_or(FIRST_SPREAD, |spread| NEARER * spread));
    }
    field.into_iter().next().ok_or(RaceEnd::NothingAllowed)
}

/// One race; those who are left are in order, the best first.
fn run<E>(
    field: &mut Vec<RaceEntrant>,
    seeds: &[u64],
    scores: &mut impl FnMut(&[RaceEntrant], &[u64]) -> Result<Vec<Option<Vec<f64>>>, E>,
) -> Result<(), E> {
    let mut done = 0;
    while done < seeds.len() && field.len() > 1 {
        let end = (done + STRIDE).min(seeds.len());
        let mut entrants = std::mem::take(field);
        // Those of the race before have played already; who came in together has played as many.
        entrants.sort_by_key(|entrant| (entrant.scores.len(), entrant.number));
        for together in entrants.chunk_by_mut(|one, other| one.scores.len() == other.scores.len()) {
            let from = together[0].scores.len();
            if from >= end {
                field.extend_from_slice(together);
                continue;
            }
            let played = scores(together, &seeds[from..end])?;
            for (entrant, more) in together.iter_mut().zip(played) {
                if let Some(more) = more {
                    entrant.scores.extend(more);
                    field.push(entrant.clone());
                }
            }
        }
        field.sort_by(|one, other| {
            other.so_far(end).total_cmp(&one.so_far(end)).then(one.number.cmp(&other.number))
        });
        done = end;
        if let Some(best) = field.first().cloned() {
            field.retain(|entrant| !is_worse(entrant, &best, done));
        }
    }
    Ok(())
}

/// Whether the test says that one entrant is worse than the best of the first seeds.
fn is_worse(entrant: &RaceEntrant, best: &RaceEntrant, seeds: usize) -> bool {
    let pairs = best.scores.iter().zip(&entrant.scores).take(seeds);
    let differences: Vec<f64> = pairs.map(|(best, score)| best - score).collect();
    signed_rank(&differences).is_some_and(|test| test.p < LEVEL && test.above > test.below)
}

impl RaceEntrant {
    fn so_far(&self, seeds: usize) -> f64 {
        mean(&self.scores[..seeds.min(self.scores.len())]).unwrap_or(f64::NEG_INFINITY)
    }
}

impl ParameterSpace {
    /// New values: anywhere, or about one of the parents.
    fn draw(&self, parents: &[Vec<f64>], spread: Option<f64>, dice: &mut Dice) -> Vec<f64> {
        let about = spread.map(|spread| (&parents[dice.below(parents.len())], spread));
        let ranges = self.ranges.iter().enumerate();
        ranges
            .map(|(place, &(low, high))| {
                let value = match about {
                    None => low + (high - low) * f64::from(dice.uniform()),
                    Some((parent, spread)) => {
                        parent[place] + spread * (high - low) * f64::from(dice.normal(1.0))
                    }
                };
                rounded(value.clamp(low, high)).clamp(low, high)
            })
            .collect()
    }
}

/// With four digits: what a person would write.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::convert::Infallible;

    use super::*;
    use crate::rng::Seed;

    fn space() -> ParameterSpace {
        ParameterSpace { original: vec![0.9, -0.9], ranges: vec![(-1.0, 1.0); 2] }
    }

    fn rules() -> RaceRules {
        RaceRules { candidates: 16, races: 5, seeds: (0..30).collect() }
    }

    fn dice() -> Dice {
        Dice::new(Seed(3), "tuning", None)
    }

    /// Best at (0.3, 0.2); each seed adds luck, which is the same for all.
    fn bowl(entrant: &RaceEntrant, seed: u64) -> f64 {
        let [x, y] = [entrant.values[0] - 0.3, entrant.values[1] - 0.2];
        let mut own = Dice::new(
            Seed(seed),
            "own luck",
            Some(crate::ids::RobotId::new(crate::ids::Team::Home, entrant.number as u8)),
        );
        f64::from(Dice::new(Seed(seed), "luck", None).normal(3.0)) - x * x - y * y
            + f64::from(own.normal(0.05))
    }

    fn play(entrants: &[RaceEntrant], seeds: &[u64]) -> Vec<Option<Vec<f64>>> {
        entrants.iter().map(|entrant| Some(seeds.iter().map(|seed| bowl(entrant, *seed)).collect())).collect()
    }

    #[test]
    fn the_best_place_of_a_bowl_is_found_through_luck_that_all_share() {
        let best = race(
            &space(),
            &rules(),
            &mut dice(),
            |_| true,
            |entrants, seeds| Ok::<_, Infallible>(play(entrants, seeds)),
        );
        let best = best.unwrap();
        assert!((best.values[0] - 0.3).abs() < 0.15 && (best.values[1] - 0.2).abs() < 0.15, "{best:?}");
    }

    #[test]
    fn worse_candidates_leave_early_and_nobody_plays_a_seed_twice() {
        let played = RefCell::new(Vec::new());
        let _ = race(
            &space(),
            &rules(),
            &mut dice(),
            |_| true,
            |entrants, seeds| {
                let pairs =
                    entrants.iter().flat_map(|entrant| seeds.iter().map(|seed| (entrant.number, *seed)));
                played.borrow_mut().extend(pairs);
                Ok::<_, Infallible>(play(entrants, seeds))
            },
        );
        let mut played = played.into_inner();
        let all = played.len();
        assert!(all < 16 * 5 * 30 / 2, "{all}");
        played.sort_unstable();
        played.dedup();
        assert_eq!(played.len(), all);
    }

    #[test]
    fn candidates_are_within_bounds_allowed_and_the_same_each_time() {
        let once = || {
            let mut seen = Vec::new();
            let best = race(
                &space(),
                &rules(),
                &mut dice(),
                |values| values[0] <= values[1] + 2.0,
                |entrants, seeds| {
                    seen.extend(entrants.iter().map(|entrant| entrant.values.clone()));
                    Ok::<_, Infallible>(play(entrants, seeds))
                },
            );
            (best.unwrap(), seen)
        };
        let (best, seen) = once();
        assert_eq!((best, seen.clone()), once());
        let is_sound = |values: &Vec<f64>| values.iter().all(|value| (-1.0..=1.0).contains(value));
        assert!(seen.iter().all(is_sound), "{seen:?}");
    }

    #[test]
    fn nothing_allowed_a_break_and_an_entrant_that_is_to_leave_are_no_winners() {
        let refused = race(&space(), &rules(), &mut dice(), |_| false, |_, _| Ok::<_, ()>(Vec::new()));
        assert_eq!(refused, Err(RaceEnd::NothingAllowed));
        let broken = race(&space(), &rules(), &mut dice(), |_| true, |_, _| Err("enough"));
        assert_eq!(broken, Err(RaceEnd::Scores("enough")));
        let only_first = race(
            &space(),
            &rules(),
            &mut dice(),
            |_| true,
            |entrants, seeds| {
                let scores = |entrant: &RaceEntrant| (entrant.number == 0).then(|| vec![0.0; seeds.len()]);
                Ok::<_, Infallible>(entrants.iter().map(scores).collect())
            },
        );
        assert_eq!(only_first.unwrap().number, 0);
    }
}
