//! From strategies to matches in which everything goes wrong, to what broke.

use std::path::PathBuf;

use super::case::LENGTH;
use super::pool::{SoakPool, SoakSide};
use super::shrink::shrink;
use crate::data::{AssetFolder, AssetKind, AssetTexts, DataError, no_such};
use crate::game::{Choice, MatchPlan};
use crate::ids::Team;
use crate::lab::all_cores::on_all_cores;
use crate::lab::scenario::{Expectation, Failure, ScenarioFile, ScenarioPlan, ScenarioRef};
use crate::lab::unbroken::unbroken;
use crate::strategy::teamwork::Protocol;

/// What is to be soaked.
#[derive(Clone, Debug, PartialEq)]
pub struct SoakChoice {
    /// The strategies that play against each other; all shipped ones that do not swap roles by the paper's protocol if there are none.
    pub strategies: Vec<String>,
    /// The first match; the others count on from it.
    pub seed: u64,
    /// Simulated time of all matches, h.
    pub hours: f64,
}

/// Matches that can be played.
#[derive(Clone, Debug)]
pub struct SoakPlan {
    assets: AssetFolder,
    pools: Vec<SoakPool>,
    first: u64,
    matches: u64,
}

/// How much was played.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SoakTally {
    /// Whole matches.
    pub matches: u64,
    /// Of simulated time.
    pub hours: f64,
}

/// A match in which something broke.
#[derive(Clone, Debug, PartialEq)]
pub struct SoakFinding {
    /// The match.
    pub seed: u64,
    /// What broke.
    pub failure: Failure,
    /// The smallest match that still breaks it, as a scenario that fails.
    pub smallest: ScenarioFile,
    /// How many matches it took to find that.
    pub tried: u32,
}

/// What is broken where a match breaks the program.
const BREAKS_OFF: &str = "no match breaks off";

/// The matches in which teams play.
const GAMES: [&str; 2] = ["friendly", "four_legged_2005"];

impl SoakPlan {
    /// Finds out which strategy can play which match.
    ///
    /// # Errors
    /// If a file cannot be read, or a strategy that is named can play none.
    pub fn read(assets: &AssetFolder, choice: &SoakChoice) -> Result<SoakPlan, DataError> {
        let known = assets.names(AssetKind::Strategy);
        if let Some(name) = choice.strategies.iter().find(|name| !known.contains(name)) {
            return Err(DataError::new(
                assets.file(AssetKind::Strategy, name),
                no_such("strategy", name, &known),
            ));
        }
        let radios = assets.names(AssetKind::Radio);
        let is_all = choice.strategies.is_empty();
        let wanted = if is_all { &known } else { &choice.strategies };
        let mut pools = Vec::new();
        for game in GAMES {
            let usual = MatchPlan::read(assets, &Choice { file: Some(game.into()), ..Choice::default() })?;
            let sides = wanted.iter().filter_map(|name| side(assets, (game, &usual), name, is_all)).collect();
            let (game, half_size) = (game.to_owned(), usual.pitch.half_size());
            pools.push(SoakPool { game, half_size, sides, radios: radios.clone() });
        }
        pools.retain(|pool| !pool.sides.is_empty());
        if pools.is_empty() {
            return Err(DataError::new(assets.root(), "none of these strategies can play a match"));
        }
        let matches = (choice.hours * 3600.0 / f64::from(LENGTH)).ceil().max(1.0) as u64;
        Ok(SoakPlan { assets: assets.clone(), pools, first: choice.seed, matches })
    }

    /// How many matches there are.
    pub fn matches(&self) -> u64 {
        self.matches
    }

    /// The match of a seed.
    pub fn case(&self, seed: u64) -> ScenarioFile {
        self.pools[(seed % self.pools.len() as u64) as usize].draw(seed)
    }

    /// Plays one match after the other on all cores, until one breaks something or `goes_on` is false; then the smallest such match is
    /// sought. Of several that break something at a time, the first counts.
    ///
    /// # Errors
    /// If a match cannot be read.
    pub fn run(
        &self,
        mut goes_on: impl FnMut(SoakTally) -> bool,
    ) -> Result<(SoakTally, Option<SoakFinding>), DataError> {
        let (mut tally, mut broken) = (SoakTally::default(), None::<(u64, Failure)>);
        let seeds = self.first..self.first.saturating_add(self.matches);
        on_all_cores(
            seeds,
            || (),
            |(), seed| (seed, self.play(&self.case(seed))),
            |(seed, played)| {
                tally.matches += 1;
                tally.hours += f64::from(LENGTH) / 3600.0;
                if let Some(failure) = played?
                    && broken.as_ref().is_none_or(|(first, _)| seed < *first)
                {
                    broken = Some((seed, failure));
                }
                Ok::<_, DataError>(broken.is_none() && goes_on(tally))
            },
        )?;
        Ok((tally, broken.map(|(seed, failure)| self.smallest(seed, failure))))
    }

    fn smallest(&self, seed: u64, failure: Failure) -> SoakFinding {
        let mut file = self.case(seed);
        if failure.expectation != BREAKS_OFF {
            file.expect.retain(|expectation| expectation.to_string() == failure.expectation);
        }
        let same = |file: &ScenarioFile| {
            self.play(file).ok().flatten().filter(|other| other.expectation == failure.expectation)
        };
        let (mut smallest, tried) = shrink(file, |file| same(file).is_some());
        if let Some(last) = same(&smallest) {
            let shorter = (last.seconds as f32).ceil().max(begins(&smallest) + 1.0);
            let shorter = ScenarioFile { seconds: Some(shorter), ..smallest.clone() };
            if same(&shorter).is_some() {
                smallest = shorter;
            }
        }
        smallest.name = Some(format!("Soak {seed}: {}", failure.reason));
        SoakFinding { seed, failure, smallest, tried }
    }

    /// What broke first in a match, if anything did.
    fn play(&self, file: &ScenarioFile) -> Result<Option<Failure>, DataError> {
        let path = PathBuf::from("soak.ron");
        let texts = AssetTexts::from([(path.clone(), file.text().unwrap_or_default())]);
        let plan = ScenarioPlan::read(&self.assets.with_texts(texts), &ScenarioRef::from(path))?;
        let report = match unbroken(|| plan.run(None)) {
            Ok(report) => report,
            Err(reason) => {
                let expectation = BREAKS_OFF.to_owned();
                return Ok(Some(Failure { expectation, tick: 0, seconds: 0.0, reason }));
            }
        };
        let failures = report.runs.into_iter().flat_map(|run| run.verdict.failures);
        Ok(failures.min_by_key(|failure| failure.tick))
    }
}

impl SoakFinding {
    /// The smallest match as a file.
    pub fn text(&self) -> String {
        self.smallest.text().unwrap_or_default()
    }
}

/// The first moment that an expectation is about, s.
fn begins(file: &ScenarioFile) -> f32 {
    let from = file.expect.iter().map(|expectation| match expectation {
        Expectation::Never { from, .. } => *from,
        _ => 0.0,
    });
    from.fold(1.0, f32::max)
}

/// A strategy as a side of a match, if it can play it.
fn side(
    assets: &AssetFolder,
    (game, usual): (&str, &MatchPlan),
    name: &str,
    hardened_only: bool,
) -> Option<SoakSide> {
    let choice = Choice { file: Some(game.into()), home: Some(name.into()), ..Choice::default() };
    let plan = MatchPlan::read(assets, &choice).ok()?;
    let strategy = &plan.team(Team::Home).strategy;
    let protocol = strategy.teamwork.role_swap.as_ref().map(|spec| spec.protocol);
    if hardened_only && matches!(protocol, Some(Protocol::Paper(_) | Protocol::HardenedWithout(_))) {
        return None;
    }
    let names = &usual.team(Team::Home).names;
    Some(SoakSide {
        strategy: name.into(),
        robot: names.robot.clone(),
        sensing: names.sensing.clone(),
        roles: strategy.players.iter().map(|role| strategy.roles[*role].name.clone()).collect(),
        swaps: protocol.is_some(),
        places: [strategy.kick_off.ours.clone(), strategy.kick_off.theirs.clone()],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Source;

    fn plan(strategies: &[&str]) -> SoakPlan {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let strategies = strategies.iter().map(|name| (*name).to_owned()).collect();
        SoakPlan::read(&assets, &SoakChoice { strategies, seed: 1, hours: 1.0 }).expect("they can play")
    }

    #[test]
    fn every_match_is_a_sound_scenario_and_reads_back() {
        let plan = plan(&[]);
        assert_eq!(plan.matches(), 52);
        for seed in 0..60 {
            let file = plan.case(seed);
            let text = file.text().expect("it can be written");
            let source = Source::new("soak.ron", text.as_str());
            assert_eq!(source.parse::<ScenarioFile>().expect("it reads back"), file);
            let path = PathBuf::from("soak.ron");
            let assets = plan.assets.with_texts(AssetTexts::from([(path.clone(), text)]));
            let read = ScenarioPlan::read(&assets, &ScenarioRef::from(path));
            assert!(read.is_ok(), "seed {seed}: {}", read.expect_err("it is not sound"));
        }
    }

    #[test]
    fn the_papers_swap_plays_only_if_it_is_named() {
        let strategies = |plan: SoakPlan| -> Vec<String> {
            plan.pools.into_iter().flat_map(|pool| pool.sides).map(|side| side.strategy).collect()
        };
        let usual = strategies(plan(&[]));
        assert!(usual.contains(&"hammerheads_swap".to_owned()) && usual.contains(&"chaos_b3p".to_owned()));
        assert!(!usual.contains(&"hammerheads_swap_paper".to_owned()));
        assert!(strategies(plan(&["hammerheads_swap_paper"])).len() == 2, "on wheels and on legs");
    }
}
