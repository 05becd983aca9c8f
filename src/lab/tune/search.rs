//! The search of a tuning: the races, and then the matches that judge the winner. What plays the matches is given.

use std::collections::BTreeMap;

use super::plan::{TuningCandidate, TuningPlan, WantedMatches};
use super::race::{RaceEnd, RaceEntrant, RaceRules, race};
use super::row::KnownMatches;
use crate::data::DataError;
use crate::rng::{DEFAULT_SEED, Dice, Seed};

/// Lets candidates race, and then the winner and the values of before play on the seeds that were held out; gives the winner.
/// `play` adds the matches that are asked for to those that are known. With the same matches known it is the same search.
///
/// # Errors
/// If no candidate is allowed, a known match was played from other files, or the first error of `play`.
pub fn search<E: From<DataError>>(
    plan: &TuningPlan,
    known: &mut KnownMatches,
    play: impl FnMut(WantedMatches, &mut KnownMatches) -> Result<(), E>,
) -> Result<RaceEntrant, E> {
    let file = &plan.file;
    let rules = RaceRules {
        candidates: file.candidates as usize,
        races: file.races as usize,
        seeds: file.training.seeds().collect(),
    };
    let mut dice = Dice::new(Seed(DEFAULT_SEED), "tuning", None);
    let mut stage = Stage { plan, known, play, candidates: BTreeMap::new() };
    let scores = |entrants: &[RaceEntrant], seeds: &[u64]| stage.scores(entrants, seeds);
    let winner = race(&plan.space(), &rules, &mut dice, |values| plan.admits(values), scores);
    let winner = winner.map_err(|end| match end {
        RaceEnd::Scores(error) => error,
        RaceEnd::NothingAllowed => {
            DataError::new(plan.path(), RaceEnd::<String>::NothingAllowed.to_string()).into()
        }
    })?;
    let before = RaceEntrant { number: 0, values: plan.space().original, scores: Vec::new() };
    let held_out: Vec<u64> = file.held_out.seeds().collect();
    let judged = if winner.number == before.number { vec![before] } else { vec![before, winner.clone()] };
    stage.scores(&judged, &held_out)?;
    Ok(winner)
}

/// Where candidates get their scores.
struct Stage<'a, P> {
    plan: &'a TuningPlan,
    known: &'a mut KnownMatches,
    play: P,
    candidates: BTreeMap<usize, TuningCandidate>,
}

impl<P> Stage<'_, P> {
    /// The scores of each entrant on each seed, as means of both sides; none for one of which a match broke off.
    fn scores<E: From<DataError>>(
        &mut self,
        entrants: &[RaceEntrant],
        seeds: &[u64],
    ) -> Result<Vec<Option<Vec<f64>>>, E>
    where
        P: FnMut(WantedMatches, &mut KnownMatches) -> Result<(), E>,
    {
        let wanted = self.wanted(entrants, seeds)?;
        if !wanted.matches.is_empty() {
            (self.play)(wanted, self.known)?;
        }
        let score =
            |entrant: &RaceEntrant, seed: u64| Some(self.plan.score(self.known.value(entrant.number, seed)?));
        let of = |entrant| seeds.iter().map(|seed| score(entrant, *seed)).collect();
        Ok(entrants.iter().map(of).collect())
    }

    fn wanted(&mut self, entrants: &[RaceEntrant], seeds: &[u64]) -> Result<WantedMatches, DataError> {
        let candidates =
            entrants.iter().map(|entrant| self.candidate(entrant)).collect::<Result<Vec<_>, _>>()?;
        let mut matches = Vec::new();
        for (place, candidate) in candidates.iter().enumerate() {
            for (seed, swapped) in seeds.iter().flat_map(|seed| [(*seed, false), (*seed, true)]) {
                match self.known.get(candidate.number, seed, swapped) {
                    None => matches.push((place, seed, swapped)),
                    Some(row) if row.assets == candidate.assets_hash() => {}
                    Some(_) => {
                        let message = "matches of it were played from other files than there are now";
                        return Err(DataError::new(self.plan.path(), message));
                    }
                }
            }
        }
        Ok(WantedMatches { candidates, matches })
    }

    fn candidate(&mut self, entrant: &RaceEntrant) -> Result<TuningCandidate, DataError> {
        if let Some(known) = self.candidates.get(&entrant.number) {
            return Ok(known.clone());
        }
        let candidate = self.plan.candidate(entrant.number, &entrant.values)?;
        self.candidates.insert(entrant.number, candidate.clone());
        Ok(candidate)
    }
}
