//! What stands before the chapters: how the report was made, all claims, and how to read the figures.

use super::document::{ReportBlock, ReportTable, cells};
use super::evaluated::Evaluated;
use super::seeds_needed;
use crate::lab::experiment::JudgedClaim;

const ABOUT: &str = "Touchline plays robot soccer between teams of behaviour-based robots that talk over a bad radio. A chapter is an \
    experiment, the same matches played with one thing changed, or a tuning of the teams before they were compared. A match is a matter of chance, so every change is tried with the same \
    seeds of the dice, and what counts is the difference with equal seeds.";

const HOW_TO_READ: [&str; 8] = [
    "A treatment is one of the ways in which the matches were played. A seed decides all chance of a match. The value of a seed is the \
     mean of its two matches, one with the teams on each other's sides, where sides are swapped.",
    "Figures are those of the team that is named first: rates for a minute of play, shares of the time of play.",
    "mean [95 %]: the mean over all seeds, and the interval that holds the true mean in 95 of 100 cases (Student).",
    "difference [95 %]: what a treatment has more than the other with the same seed, in the mean, with its interval (bootstrap, BCa). If \
     the interval holds 0, these matches do not tell which has more.",
    "p: how likely differences so uneven are if there were none (Wilcoxon's signed-rank test).",
    "d_z: the mean difference in standard deviations of the differences (Cohen): 0.2 is small, 0.8 large.",
    "P(more): the probability of improvement, which is how likely the treatment has more than the other with the same seed; half of the \
     draws count. 0.5 is no difference.",
    "seeds to show it: if the truth is as it seems, so many seeds show the difference by Wilcoxon's test in nine cases of ten. It tells how \
     many matches a question needs; with few seeds it is a rough guess.",
];

const VERDICTS: &str = "A claim held if the whole interval of its difference lies on the side that it names, did not hold if the whole \
    interval lies on the other side, and otherwise, or with fewer than six seeds, it cannot be said. One that says how much there is held if the whole interval of the mean lies in its range, and did not hold if none of it does. Each claim is judged by itself: of twenty claims that are wrong, \
    one may seem to hold.";

/// The beginning of a report.
pub(super) fn blocks(experiments: &[Evaluated], command: &str) -> Vec<ReportBlock> {
    let mut blocks = vec![
        ReportBlock::Text(ABOUT.into()),
        ReportBlock::Text("This report is written from the tables of the matches by".into()),
        ReportBlock::Code(command.to_owned()),
        ReportBlock::Text("and each chapter names the command that plays its matches.".into()),
    ];
    let experiments: Vec<&Evaluated> = experiments.iter().collect();
    if experiments.iter().any(|experiment| !experiment.summary.claims.is_empty()) {
        blocks.push(ReportBlock::Chapter("All claims".into()));
        blocks.push(ReportBlock::Text(VERDICTS.into()));
        blocks.push(ReportBlock::Table(claim_table(&experiments)));
    }
    blocks.extend(seeds_needed::blocks(&experiments));
    blocks.push(ReportBlock::Chapter("How to read the figures".into()));
    blocks.push(ReportBlock::Items(cells(HOW_TO_READ)));
    blocks
}

/// The claims of some experiments with their verdicts.
pub(super) fn claim_table(experiments: &[&Evaluated]) -> ReportTable {
    let rows = experiments.iter().flat_map(|experiment| experiment.summary.claims.iter().map(row));
    let head = cells(["claim", "source", "held against", "verdict", "why"]);
    ReportTable { words: head.len(), head, rows: rows.collect() }
}

fn row(judged: &JudgedClaim) -> Vec<String> {
    let claim = &judged.claim;
    let [of, than] = [&claim.of, &claim.than].map(|levels| levels.join(", "));
    let figure = claim.metric.column().replace('_', " ");
    let verdict = judged.verdict.words().to_owned();
    vec![
        claim.says.clone(),
        claim.source.clone(),
        if claim.is.compares() {
            format!("{figure}: {of} against {than}")
        } else {
            format!("{figure}: {of}")
        },
        verdict,
        judged.reason(),
    ]
}
