//! `touchline tune`: the numbers with which a team does best, and what they are worth on seeds that were held out.

mod folder;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use indicatif::ProgressBar;

use self::folder::TuningFolder;
use super::ending::{CommandError, Ending, print_json};
use super::experiment::{folder_beside, quietly};
use super::interrupt::Interrupt;
use super::progress::progress_bar;
use crate::data::{AssetFolder, DataError};
use crate::lab::tune::{
    KnownMatches, RaceEnd, RaceEntrant, RaceRules, TuningCandidate, TuningPlan, TuningReport, race,
};
use crate::rng::{DEFAULT_SEED, Dice, Seed};

#[derive(Args, Debug)]
pub(super) struct TuneCommand {
    /// The tuning: a name among the assets or a path.
    file: String,
    /// The folder of what comes out; the name of the tuning with `.tuned` behind it if not given. Matches that are there already are
    /// not played again.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

impl TuneCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let plan = TuningPlan::read(assets, &self.file)?;
        let path = self.out.clone().unwrap_or_else(|| folder_beside(&self.file, "tuned"));
        let (folder, known) = TuningFolder::begin(path, &plan)?;
        let mut stage = Stage::new(&plan, &folder, known);
        let found = quietly(|| stage.search());
        stage.bar.finish_and_clear();
        match found {
            Ok(winner) => self.tell(&plan, &folder, &winner, &stage.known, out),
            Err(Stopped::Interrupted) => {
                let (count, path) = (stage.known.len(), folder.path().display());
                writeln!(out, "{count} matches in {path}; the same command goes on from there")?;
                Ok(Ending::Interrupted)
            }
            Err(Stopped::Broken(error)) => Err(error),
        }
    }

    fn tell(
        &self,
        plan: &TuningPlan,
        folder: &TuningFolder,
        winner: &RaceEntrant,
        known: &KnownMatches,
        out: &mut impl Write,
    ) -> Result<Ending, CommandError> {
        let report = TuningReport::of(plan, winner, known);
        let text = report.document().to_markdown();
        folder.write("report.md", text.as_bytes())?;
        if winner.number != 0 {
            for (name, text) in plan.files(&winner.values)? {
                folder.write(&name, [&report.comment(), text.as_str()].concat().as_bytes())?;
            }
        }
        match self.json {
            true => print_json(&report, out)?,
            false => {
                write!(out, "{text}")?;
                match winner.number {
                    0 => writeln!(out, "No candidate was better than the values of before.")?,
                    _ => {
                        writeln!(out, "The files with the tuned values are in {}.", folder.path().display())?
                    }
                }
            }
        }
        Ok(Ending::Done)
    }
}

/// Why a search came to no end.
enum Stopped {
    Interrupted,
    Broken(CommandError),
}

impl From<CommandError> for Stopped {
    fn from(error: CommandError) -> Stopped {
        Stopped::Broken(error)
    }
}

/// Plays what a search asks for, unless it is known.
struct Stage<'a> {
    plan: &'a TuningPlan,
    folder: &'a TuningFolder,
    known: KnownMatches,
    candidates: BTreeMap<usize, TuningCandidate>,
    interrupt: Interrupt,
    bar: ProgressBar,
}

impl<'a> Stage<'a> {
    fn new(plan: &'a TuningPlan, folder: &'a TuningFolder, known: KnownMatches) -> Stage<'a> {
        let bar = progress_bar(0, "{spinner} candidate {prefix}, {pos} of {len} matches so far");
        Stage { plan, folder, known, candidates: BTreeMap::new(), interrupt: Interrupt::listen(), bar }
    }

    /// Races, and then plays the winner and the values of before on the seeds that were held out.
    fn search(&mut self) -> Result<RaceEntrant, Stopped> {
        let plan = self.plan;
        let file = &plan.file;
        let rules = RaceRules {
            candidates: file.candidates as usize,
            races: file.races as usize,
            seeds: file.training.seeds().collect(),
        };
        let mut dice = Dice::new(Seed(DEFAULT_SEED), "tuning", None);
        let scores = |entrants: &[RaceEntrant], seeds: &[u64]| self.scores(entrants, seeds);
        let winner = race(&plan.space(), &rules, &mut dice, |values| plan.admits(values), scores);
        let winner = winner.map_err(|end| match end {
            RaceEnd::Scores(stopped) => stopped,
            RaceEnd::NothingAllowed => Stopped::Broken(
                DataError::new(&file.name, RaceEnd::<String>::NothingAllowed.to_string()).into(),
            ),
        })?;
        let before = RaceEntrant { number: 0, values: plan.space().original, scores: Vec::new() };
        let held_out: Vec<u64> = file.held_out.seeds().collect();
        self.scores(&[before, winner.clone()], &held_out)?;
        Ok(winner)
    }

    /// The scores of each entrant on each seed, as means of both sides; none for one of which a match broke off.
    fn scores(&mut self, entrants: &[RaceEntrant], seeds: &[u64]) -> Result<Vec<Option<Vec<f64>>>, Stopped> {
        self.play(entrants, seeds)?;
        let score =
            |entrant: &RaceEntrant, seed: u64| Some(self.plan.score(self.known.value(entrant.number, seed)?));
        let of = |entrant| seeds.iter().map(|seed| score(entrant, *seed)).collect();
        Ok(entrants.iter().map(of).collect())
    }

    fn play(&mut self, entrants: &[RaceEntrant], seeds: &[u64]) -> Result<(), Stopped> {
        let mut candidates = Vec::new();
        for entrant in entrants {
            candidates.push(self.candidate(entrant)?);
        }
        let mut missing = Vec::new();
        for (place, candidate) in candidates.iter().enumerate() {
            for (seed, swapped) in seeds.iter().flat_map(|seed| [(*seed, false), (*seed, true)]) {
                match self.known.get(candidate.number, seed, swapped) {
                    None => missing.push((place, seed, swapped)),
                    Some(row) if row.assets == candidate.assets_hash() => {}
                    Some(_) => {
                        let message =
                            "was played from other files than there are now; name another folder with --out";
                        return Err(Stopped::Broken(DataError::new(self.folder.matches(), message).into()));
                    }
                }
            }
        }
        if missing.is_empty() {
            return Ok(());
        }
        self.bar.inc_length(missing.len() as u64);
        let (known, bar, interrupt) = (&mut self.known, &self.bar, &self.interrupt);
        self.plan.play(&candidates, missing, |row| {
            bar.set_prefix(row.candidate.to_string());
            bar.inc(1);
            known.add(row);
            Ok::<_, Stopped>(!interrupt.is_asked())
        })?;
        self.folder.keep(&self.known)?;
        if self.interrupt.is_asked() { Err(Stopped::Interrupted) } else { Ok(()) }
    }

    fn candidate(&mut self, entrant: &RaceEntrant) -> Result<TuningCandidate, CommandError> {
        if let Some(known) = self.candidates.get(&entrant.number) {
            return Ok(known.clone());
        }
        let candidate = self.plan.candidate(entrant.number, &entrant.values)?;
        self.candidates.insert(entrant.number, candidate.clone());
        Ok(candidate)
    }
}
