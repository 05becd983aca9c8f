//! All teams of a tuning beside each other: what each has come to by the same means.

use super::file::TuningFile;
use super::plan::TuningPlan;
use super::report::{TunedValue, TuningReport, mean_of};
use crate::lab::experiment::ClaimVerdict;
use crate::lab::report::{ReportBlock, ReportTable};
use crate::lab::statistics::PairedDifference;

/// A paragraph and a table of what a tuning has come to, a line for each of its teams.
pub fn teams_beside_each_other(plan: &TuningPlan, reports: &[TuningReport]) -> Vec<ReportBlock> {
    let parameters = plan.file.parameters.iter().map(|parameter| parameter.name.clone());
    let words = |words: [&str; 2]| words.map(str::to_owned);
    let head = words(["team", "verdict"]).into_iter().chain(parameters);
    let table = ReportTable {
        head: head.chain(words(["in training", "held out [95 %]"])).collect(),
        rows: reports.iter().map(line).collect(),
        words: 2,
    };
    vec![ReportBlock::Text(means(&plan.file)), ReportBlock::Table(table)]
}

fn means(file: &TuningFile) -> String {
    let TuningFile { candidates, races, training, held_out, objective, .. } = file;
    let (training, held_out, column) = (training.number, held_out.number, objective.metric.column());
    let column = column.replace('_', " ");
    let most = objective.better.words();
    format!(
        "Each team was tuned by the same means: {races} races of {candidates} candidates on {training} seeds, for {most} of {column}. \
         Then the winner and the values of before played {held_out} seeds that were held out. The differences are those of {column}, \
         tuned less before; those in training flatter the winner, which was chosen by them."
    )
}

fn line(report: &TuningReport) -> Vec<String> {
    let team = report.team.as_ref().unwrap_or(&report.name);
    let values = report.values.iter().map(|TunedValue { before, tuned, .. }| match before == tuned {
        true => before.to_string(),
        false => format!("{before} -> {tuned}"),
    });
    let worth = |difference: &Option<PairedDifference>| {
        difference.as_ref().map_or_else(|| "-".into(), |difference| mean_of(difference).to_string())
    };
    let line = [team.clone(), verdict(report).to_owned()].into_iter().chain(values);
    line.chain([worth(&report.training), worth(&report.held_out)]).collect()
}

fn verdict(report: &TuningReport) -> &'static str {
    match (report.has_changed(), report.better) {
        (false, _) => "no candidate won",
        (true, ClaimVerdict::Held) => "better",
        (true, ClaimVerdict::DidNotHold) => "worse",
        (true, ClaimVerdict::CannotBeSaid) => "cannot be said",
    }
}
