//! `touchline check`: reads assets as a match would and says what is wrong with them, and plays scenarios.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::BAD_INPUT;
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

/// A scenario failed.
const FAILED: u8 = 1;

/// What was found so far.
#[derive(Default)]
struct Findings {
    faults: usize,
    reports: Vec<Report>,
}

impl Check {
    pub(super) fn run(&self, assets: &AssetFolder) -> Result<ExitCode, DataError> {
        let mut findings = Findings::default();
        for file in &self.files {
            if is_scenario(file) {
                self.play(assets, file, &mut findings);
            } else {
                findings.tell(&file.display().to_string(), Strategy::read(file).map(drop));
            }
        }
        if self.files.is_empty() {
            self.check_all(assets, &mut findings);
        }
        if let Some(path) = &self.junit {
            let xml = junit(&findings.reports).map_err(|error| DataError::new(path, error.to_string()))?;
            std::fs::write(path, xml).map_err(|error| DataError::new(path, error.to_string()))?;
        }
        Ok(findings.conclude())
    }

    fn check_all(&self, assets: &AssetFolder, findings: &mut Findings) {
        for name in assets.names("strategies") {
            let path = assets.file("strategies", &name);
            findings.tell(&path.display().to_string(), Strategy::read(&path).map(drop));
        }
        for radio in assets.names("radios") {
            let choice = Choice { radio: Some(radio.clone()), ..Choice::default() };
            let path = assets.file("radios", &radio);
            findings.tell(&path.display().to_string(), MatchPlan::read(assets, &choice).map(drop));
        }
        for name in assets.names("matches") {
            let path = assets.file("matches", &name);
            let choice = Choice { file: Some(name), ..Choice::default() };
            findings.tell(&path.display().to_string(), MatchPlan::read(assets, &choice).map(drop));
        }
        for name in assets.names("scenarios") {
            self.play(assets, &assets.file("scenarios", &name), findings);
        }
    }

    fn play(&self, assets: &AssetFolder, path: &Path, findings: &mut Findings) {
        let plan = match ScenarioPlan::read(assets, path) {
            Ok(plan) => plan,
            Err(error) => return findings.tell(&path.display().to_string(), Err(error)),
        };
        findings.report(plan.run(None));
        if self.ablate
            && let Some(dependency) = plan.scenario.depends_on
        {
            findings.report(plan.run(Some(dependency)));
        }
    }
}

/// A scenario expects something; a strategy does not.
fn is_scenario(path: &Path) -> bool {
    Source::read(path).is_ok_and(|source| source.text.contains("expect:"))
}

impl Findings {
    fn tell(&mut self, what: &str, result: Result<(), DataError>) {
        match result {
            Ok(()) => println!("ok    {what}"),
            Err(error) => {
                println!("fault {error}");
                self.faults += 1;
            }
        }
    }

    fn report(&mut self, report: Report) {
        println!("{report}");
        self.reports.push(report);
    }

    fn conclude(&self) -> ExitCode {
        let failed = self.reports.iter().filter(|report| !report.passed()).count();
        if self.faults > 0 {
            println!("{} with faults", self.faults);
            return ExitCode::from(BAD_INPUT);
        }
        if failed > 0 {
            println!("{failed} of {} scenarios failed", self.reports.len());
            return ExitCode::from(FAILED);
        }
        println!("all sound");
        ExitCode::SUCCESS
    }
}
