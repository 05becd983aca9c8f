//! `touchline league`: every strategy against every other, with ratings.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use super::ending::{CommandError, Ending, print_json};
use super::experiment::{ResultsFolder, play_wanted};
use super::interrupt::Interrupt;
use super::options::SeedOption;
use super::shell_word::quoted;
use crate::app::whole_file::{check_writable, write_whole};
use crate::data::{AssetFolder, AssetKind, Bound, DataError, Source, no_such};
use crate::lab::experiment::ExperimentPlan;
use crate::lab::league::{LeagueChoice, LeagueTable};

#[derive(Args, Debug)]
pub(super) struct LeagueCommand {
    /// The strategies: names among the assets or paths.
    #[arg(required = true, num_args = 2.., value_name = "STRATEGY")]
    strategies: Vec<String>,
    /// The match: a name among the assets or a path.
    #[arg(long = "match", value_name = "MATCH")]
    file: Option<String>,
    /// How many matches each pair plays; even, since each seed is played on both sides.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    matches: u32,
    #[command(flatten)]
    seed: SeedOption,
    /// Minutes of a half.
    #[arg(long, value_name = "MINUTES")]
    minutes: Option<f32>,
    /// The folder of the matches, from which the same command goes on.
    #[arg(long, value_name = "FOLDER", default_value = "league.results")]
    out: PathBuf,
    /// Write the table as Markdown, too.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// Print the table as JSON.
    #[arg(long)]
    json: bool,
}

impl LeagueCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        self.check(assets)?;
        if let Some(file) = &self.markdown {
            check_writable(file).map_err(CommandError::file(file))?;
        }
        let choice = self.choice();
        let plan = ExperimentPlan::of_source(assets, &design(&choice)?)?;
        let (folder, interrupt) = (ResultsFolder::new(self.out.clone()), Interrupt::listen());
        let rows = play_wanted((&plan, &folder), |_| (0..plan.matches()).collect(), &interrupt)?;
        let table = LeagueTable::of(&choice, &plan, &rows);
        if let Some(file) = &self.markdown {
            let text = table.document(&self.command()).to_markdown();
            write_whole(file, text.as_bytes()).map_err(CommandError::file(file))?;
        }
        if self.json {
            print_json(&table, out)?;
        } else {
            write!(out, "{}", table.standings())?;
            writeln!(out, "{} of {} matches in {}", rows.len(), plan.matches(), folder.path().display())?;
        }
        Ok(Ending::of_run(interrupt.is_asked()))
    }

    fn check(&self, assets: &AssetFolder) -> Result<(), DataError> {
        let mut known = BTreeSet::new();
        for name in &self.strategies {
            if !assets.has_file(&assets.file(AssetKind::Strategy, name)) {
                let message = no_such("strategy", name, assets.names(AssetKind::Strategy));
                return Err(DataError::new("league", message));
            }
            if !known.insert(name) {
                return Err(DataError::new("league", format!("{name} is given twice")));
            }
        }
        if !self.matches.is_multiple_of(2) {
            return Err(DataError::new("--matches", "must be even: each seed is played on both sides"));
        }
        let minutes = self.minutes.map_or(Ok(()), |minutes| Bound::MINUTES.check("", minutes));
        minutes.map_err(|fault| DataError::new("--minutes", fault.message))
    }

    fn choice(&self) -> LeagueChoice {
        LeagueChoice {
            strategies: self.strategies.clone(),
            file: self.file.clone(),
            half_minutes: self.minutes,
            first_seed: self.seed.of_match(),
            seeds: self.matches / 2,
        }
    }

    /// What plays the league again.
    fn command(&self) -> String {
        let mut words = vec!["touchline".to_owned(), "league".to_owned()];
        words.extend(self.strategies.iter().map(|name| quoted(Path::new(name))));
        let mut option = |name: &str, value: String| words.extend([name.to_owned(), value]);
        if let Some(file) = &self.file {
            option("--match", quoted(Path::new(file)));
        }
        option("--matches", self.matches.to_string());
        option("--seed", self.seed.of_match().to_string());
        if let Some(minutes) = self.minutes {
            option("--minutes", minutes.to_string());
        }
        option("--out", quoted(&self.out));
        if let Some(file) = &self.markdown {
            option("--markdown", quoted(file));
        }
        words.join(" ")
    }
}

/// The experiment that a league is, as a file.
fn design(choice: &LeagueChoice) -> Result<Source, DataError> {
    let text = ron::ser::to_string_pretty(&choice.design(), ron::ser::PrettyConfig::default());
    let text = text.map_err(|error| DataError::new("league", error.to_string()))?;
    Ok(Source::new("league", text))
}
