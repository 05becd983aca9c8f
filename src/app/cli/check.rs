//! `touchline check`: reads assets as a match would and says what is wrong with them, and plays scenarios.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use super::ending::{CommandError, Ending};
use super::interrupt::Interrupt;
use super::recording::RunRecorder;
use crate::app::whole_file::{check_writable, write_whole};
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source};
use crate::lab::coverage::{Coverage, CoverageWatcher};
use crate::lab::kinds;
use crate::lab::scenario::{ScenarioOutcome, ScenarioPlan, ScenarioRef, ScenarioReport, junit, rows};

#[derive(Args, Debug, Default)]
pub(super) struct CheckCommand {
    /// Files of any kind; everything in the asset folder, if none is given. A colon and a name behind a scenario's file
    /// single out one of its variants.
    files: Vec<String>,
    /// Also play each scenario without the mechanism that it depends on: then it must fail.
    #[arg(long)]
    ablate: bool,
    /// Write the scenarios' results to a file, as JUnit XML.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write the scenarios' results to a file, as JSON: a row for each scenario and each place of the ball.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Record each run of a scenario in a file of its own in this folder, from which `replay` plays it again.
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// Count how often the scenarios' robots are in each state of their strategies and take each transition, and print a table;
    /// with a file, also write all counts to it, as RON.
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    coverage: Option<Option<PathBuf>>,
}

/// What was found so far, printed as it is found.
struct Findings<'a, W> {
    out: &'a mut W,
    interrupt: Interrupt,
    /// How many files of each kind there were.
    files: BTreeMap<AssetKind, usize>,
    faults: usize,
    /// The scenarios' names, and whose they are.
    scenarios: BTreeMap<String, ScenarioRef>,
    reports: Vec<ScenarioReport>,
    /// What the robots did in all scenarios that were played whole, if that is counted.
    coverage: Option<Coverage>,
}

impl CheckCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        for path in self.junit.iter().chain(&self.json) {
            check_writable(path).map_err(CommandError::file(path))?;
        }
        if let Some(path) = self.coverage_file() {
            check_replaceable(path)?;
        }
        let mut findings = Findings {
            out,
            interrupt: Interrupt::listen(),
            files: BTreeMap::new(),
            faults: 0,
            scenarios: BTreeMap::new(),
            reports: Vec::new(),
            coverage: self.coverage.as_ref().map(|_| Coverage::default()),
        };
        if self.files.is_empty() {
            self.check_all(assets, &mut findings)?;
        }
        for file in &self.files {
            let file = ScenarioRef::at(file);
            match Source::read(&file.path).and_then(|source| kinds::kind_of(&source)) {
                Ok(kind) => self.check(assets, kind, &file, &mut findings)?,
                Err(error) => findings.tell(&file, Err(error))?,
            }
        }
        if self.ablate {
            findings.expect_ablations()?;
        }
        let xml = |reports: &[ScenarioReport]| junit(reports).map_err(io::Error::other);
        let json = |reports: &[ScenarioReport]| {
            serde_json::to_string_pretty(&rows(reports)).map(|text| text + "\n").map_err(io::Error::other)
        };
        write_results(self.junit.as_deref(), xml, &findings.reports)?;
        write_results(self.json.as_deref(), json, &findings.reports)?;
        if let Some(coverage) = &findings.coverage {
            writeln!(findings.out, "{coverage}")?;
            if let Some(path) = self.coverage_file() {
                let written = coverage.to_ron().map_err(io::Error::other);
                written
                    .and_then(|text| write_whole(path, text.as_bytes()))
                    .map_err(CommandError::file(path))?;
            }
        }
        Ok(findings.conclude()?)
    }

    /// Where the counts go.
    fn coverage_file(&self) -> Option<&Path> {
        self.coverage.as_ref()?.as_deref()
    }

    /// Checks what is in each kind's folder as that kind, which is what it is taken for in a match.
    fn check_all(
        &self,
        assets: &AssetFolder,
        findings: &mut Findings<impl Write>,
    ) -> Result<(), CommandError> {
        for kind in AssetKind::ALL {
            for path in assets.files(kind)? {
                self.check(assets, kind, &path.into(), findings)?;
            }
        }
        if findings.files.is_empty() {
            return Err(DataError::new(assets.root(), "there are no assets to check").into());
        }
        Ok(())
    }

    fn check(
        &self,
        assets: &AssetFolder,
        kind: AssetKind,
        file: &ScenarioRef,
        findings: &mut Findings<impl Write>,
    ) -> Result<(), CommandError> {
        *findings.files.entry(kind).or_default() += 1;
        match kinds::read(assets, kind, file) {
            Ok(plans) if plans.is_empty() => findings.tell(file, Ok(()))?,
            Ok(plans) => plans.iter().try_for_each(|plan| match findings.know(plan) {
                Ok(()) => self.play(assets, plan, findings),
                fault => Ok(findings.tell(&plan.origin, fault)?),
            })?,
            Err(error) => findings.tell(file, Err(error))?,
        }
        Ok(())
    }

    fn play(
        &self,
        assets: &AssetFolder,
        plan: &ScenarioPlan,
        findings: &mut Findings<impl Write>,
    ) -> Result<(), CommandError> {
        let dependency = plan.scenario.depends_on.filter(|_| self.ablate);
        for without in [None].into_iter().chain(dependency.map(Some)) {
            if !findings.interrupt.is_asked() {
                let mut recorder = RunRecorder {
                    folder: self.record.as_deref(),
                    interrupt: &findings.interrupt,
                    recorder: None,
                    failed: None,
                    assets,
                    plan,
                    without,
                };
                let coverage = findings.coverage.as_mut().filter(|_| without.is_none());
                let mut counter = CoverageWatcher::new(plan, coverage);
                let report = plan.run_watched(without, &mut (&mut recorder, &mut counter));
                recorder.conclude()?;
                findings.report(report)?;
            }
        }
        Ok(())
    }
}

/// Writes what a format makes of the scenarios' results to a file, if one is wanted.
fn write_results(
    path: Option<&Path>,
    format: impl Fn(&[ScenarioReport]) -> io::Result<String>,
    reports: &[ScenarioReport],
) -> Result<(), CommandError> {
    let Some(path) = path else { return Ok(()) };
    let written = format(reports).and_then(|text| write_whole(path, text.as_bytes()));
    written.map_err(CommandError::file(path))
}

/// Refuses to replace a file that is no table of coverage: it may be one that was to be checked.
fn check_replaceable(path: &Path) -> Result<(), CommandError> {
    if path.is_file() && Coverage::read(path).is_err() {
        let message = "is there already and is no table of coverage, so it is not replaced; what is to be checked comes \
                       before `--coverage`";
        return Err(DataError::new(path, message).into());
    }
    check_writable(path).map_err(CommandError::file(path))
}

impl<W: Write> Findings<'_, W> {
    fn tell(&mut self, what: &impl Display, result: Result<(), DataError>) -> io::Result<()> {
        match result {
            Ok(()) => writeln!(self.out, "ok    {what}"),
            Err(error) => {
                self.faults += 1;
                writeln!(self.out, "fault {error}")
            }
        }
    }

    /// Remembers a scenario's name, by which people tell the results.
    fn know(&mut self, plan: &ScenarioPlan) -> Result<(), DataError> {
        let origin = self.scenarios.entry(plan.scenario.name.clone()).or_insert_with(|| plan.origin.clone());
        if *origin == plan.origin {
            return Ok(());
        }
        let message = format!("is also the name of {origin}");
        Err(plan.error_at(&Field::root().key("name"), message))
    }

    /// How many files of each kind were read.
    fn counts(&self) -> String {
        let counts = self.files.iter().map(|(kind, count)| match count {
            1 => format!("1 {kind}"),
            _ => format!("{count} {}", kind.plural()),
        });
        let counts: Vec<String> = counts.collect();
        if counts.is_empty() { String::new() } else { format!("{}: ", counts.join(", ")) }
    }

    fn report(&mut self, report: ScenarioReport) -> io::Result<()> {
        writeln!(self.out, "{report}")?;
        self.reports.push(report);
        Ok(())
    }

    fn expect_ablations(&mut self) -> io::Result<()> {
        if self.interrupt.is_asked() || self.reports.iter().any(|report| report.without.is_some()) {
            return Ok(());
        }
        let message = "has no effect: no scenario among the files says what it depends on";
        self.tell(&"--ablate", Err(DataError::new("--ablate", message)))
    }

    fn conclude(self) -> io::Result<Ending> {
        let played = self.reports.iter().filter(|report| !report.interrupted);
        let count = |outcome| played.clone().filter(|report| report.outcome() == outcome).count();
        let (failed, undecided) = (count(ScenarioOutcome::Failed), count(ScenarioOutcome::Undecided));
        let (played, faults) = (played.count(), self.faults);
        let undecided_too = if undecided > 0 { format!(", {undecided} undecided") } else { String::new() };
        let (words, ending) = if self.interrupt.is_asked() {
            let words = format!(
                "interrupted: {failed} of {played} scenarios failed{undecided_too}, {faults} with faults so far"
            );
            (words, Ending::Interrupted)
        } else if faults > 0 {
            (format!("{faults} with faults"), Ending::BadInput)
        } else if failed + undecided > 0 {
            (format!("{failed} of {played} scenarios failed{undecided_too}"), Ending::Failed)
        } else {
            ("all sound".into(), Ending::Done)
        };
        writeln!(self.out, "{}{words}", self.counts())?;
        Ok(ending)
    }
}
