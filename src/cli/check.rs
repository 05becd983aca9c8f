//! `touchline check`: reads assets as a match would and says what is wrong with them, and plays scenarios.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use super::ending::{CommandError, Ending};
use super::interrupt::Interrupt;
use super::whole_file::{check_writable, write_whole};
use crate::data::{AssetFolder, DataError, Source};
use crate::game::{Choice, MatchPlan};
use crate::scenario::{Report, ScenarioPlan, junit};
use crate::strategy::Strategy;

#[derive(Args, Debug, Default)]
pub(super) struct Check {
    /// Strategy and scenario files; everything in the asset folder, if none is given.
    files: Vec<PathBuf>,
    /// Also play each scenario without the mechanism that it depends on: then it must fail.
    #[arg(long)]
    ablate: bool,
    /// Write the scenarios' results to a file, as JUnit XML.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

/// What was found so far, printed as it is found.
struct Findings<'a, W> {
    out: &'a mut W,
    interrupt: Interrupt,
    faults: usize,
    reports: Vec<Report>,
}

impl Check {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        if let Some(path) = &self.junit {
            check_writable(path).map_err(CommandError::file(path))?;
        }
        let mut findings = Findings { out, interrupt: Interrupt::listen(), faults: 0, reports: Vec::new() };
        if self.files.is_empty() {
            self.check_all(assets, &mut findings)?;
        }
        for file in &self.files {
            if is_scenario(file) {
                self.play(assets, file, &mut findings)?;
            } else {
                findings.tell(file, Strategy::read(file).map(drop))?;
            }
        }
        if self.ablate {
            findings.expect_ablations()?;
        }
        if let Some(path) = &self.junit {
            let xml = junit(&findings.reports).map_err(io::Error::other);
            xml.and_then(|xml| write_whole(path, xml.as_bytes())).map_err(CommandError::file(path))?;
        }
        Ok(findings.conclude()?)
    }

    fn check_all(&self, assets: &AssetFolder, findings: &mut Findings<impl Write>) -> io::Result<()> {
        for name in assets.names("strategies") {
            let path = assets.file("strategies", &name);
            findings.tell(&path, Strategy::read(&path).map(drop))?;
        }
        for radio in assets.names("radios") {
            let choice = Choice { radio: Some(radio.clone()), ..Choice::default() };
            findings.tell(&assets.file("radios", &radio), MatchPlan::read(assets, &choice).map(drop))?;
        }
        for name in assets.names("matches") {
            let path = assets.file("matches", &name);
            let choice = Choice { file: Some(name), ..Choice::default() };
            findings.tell(&path, MatchPlan::read(assets, &choice).map(drop))?;
        }
        for name in assets.names("scenarios") {
            self.play(assets, &assets.file("scenarios", &name), findings)?;
        }
        Ok(())
    }

    fn play(&self, assets: &AssetFolder, path: &Path, findings: &mut Findings<impl Write>) -> io::Result<()> {
        let plan = match ScenarioPlan::read(assets, path) {
            Ok(plan) => plan,
            Err(error) => return findings.tell(path, Err(error)),
        };
        let dependency = plan.scenario.depends_on.filter(|_| self.ablate);
        for without in [None].into_iter().chain(dependency.map(Some)) {
            if !findings.interrupt.is_asked() {
                let report = plan.run_until(without, &|| findings.interrupt.is_asked());
                findings.report(report)?;
            }
        }
        Ok(())
    }
}

/// A scenario expects something; a strategy does not.
fn is_scenario(path: &Path) -> bool {
    Source::read(path).is_ok_and(|source| source.text.contains("expect:"))
}

impl<W: Write> Findings<'_, W> {
    fn tell(&mut self, what: &Path, result: Result<(), DataError>) -> io::Result<()> {
        match result {
            Ok(()) => writeln!(self.out, "ok    {}", what.display()),
            Err(error) => {
                self.faults += 1;
                writeln!(self.out, "fault {error}")
            }
        }
    }

    fn report(&mut self, report: Report) -> io::Result<()> {
        writeln!(self.out, "{report}")?;
        self.reports.push(report);
        Ok(())
    }

    fn expect_ablations(&mut self) -> io::Result<()> {
        if self.interrupt.is_asked() || self.reports.iter().any(|report| report.without.is_some()) {
            return Ok(());
        }
        let message = "has no effect: no scenario among the files says what it depends on";
        self.tell(Path::new("--ablate"), Err(DataError::new("--ablate", message)))
    }

    fn conclude(self) -> io::Result<Ending> {
        let played = self.reports.iter().filter(|report| !report.interrupted);
        let failed = played.clone().filter(|report| !report.passed()).count();
        let (played, faults) = (played.count(), self.faults);
        let (words, ending) = if self.interrupt.is_asked() {
            let words =
                format!("interrupted: {failed} of {played} scenarios failed, {faults} with faults so far");
            (words, Ending::Interrupted)
        } else if faults > 0 {
            (format!("{faults} with faults"), Ending::BadInput)
        } else if failed > 0 {
            (format!("{failed} of {played} scenarios failed"), Ending::Failed)
        } else {
            ("all sound".into(), Ending::Done)
        };
        writeln!(self.out, "{words}")?;
        Ok(ending)
    }
}
