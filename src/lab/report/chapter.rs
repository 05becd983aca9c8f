//! An experiment as a chapter: what was played, how to play it again, the claims, and each metric.

use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use super::document::{ReportBlock, ReportTable, cells};
use super::evaluated::Evaluated;
use super::figure_part;
use super::overview::claim_table;

/// The chapter of an experiment.
pub(super) fn blocks(of: &Evaluated) -> Vec<ReportBlock> {
    let file = &of.experiment.file;
    let mut blocks = chapter_head(&file.name, &file.description, what_was_played(of), of.command);
    blocks.push(ReportBlock::Table(treatments(of)));
    if !file.claims.is_empty() {
        blocks.push(ReportBlock::Heading("Claims".into()));
        blocks.push(ReportBlock::Table(claim_table(&[of])));
    }
    blocks.extend(file.metrics.iter().flat_map(|metric| figure_part::blocks(of, *metric)));
    blocks
}

/// How a chapter begins: its title and description, facts of what was played, a line each, and the command that plays it again.
pub fn chapter_head(name: &str, description: &str, facts: Vec<String>, command: &str) -> Vec<ReportBlock> {
    let mut blocks = vec![ReportBlock::Chapter(name.to_owned())];
    if !description.is_empty() {
        blocks.push(ReportBlock::Text(description.to_owned()));
    }
    blocks.extend([
        ReportBlock::Items(facts),
        ReportBlock::Text("What plays these matches again, or goes on with those that are missing:".into()),
        ReportBlock::Code(command.to_owned()),
    ]);
    blocks
}

fn what_was_played(of: &Evaluated) -> Vec<String> {
    let plan = of.experiment;
    let seeds = of.played.iter().map(|row| row.key.seed);
    let range = match (seeds.clone().min(), seeds.max()) {
        (Some(first), Some(last)) => format!("the seeds {first} to {last}"),
        _ => "no seed".into(),
    };
    let sides = if plan.sides() == 2 { ", each once more with the teams on each other's sides" } else { "" };
    let mut items = vec![
        format!(
            "{} treatments with {range}{sides}: {} of {} matches.",
            plan.treatments(),
            of.played.len(),
            plan.matches()
        ),
        format!(
            "Touchline {}; hash of the design {:016x}, of the digests of all matches {:016x}.",
            env!("CARGO_PKG_VERSION"),
            xxh3_64(plan.text.as_bytes()),
            digest(of)
        ),
    ];
    if of.summary.broken > 0 {
        items.push(format!("{} matches broke off; their seeds do not count.", of.summary.broken));
    }
    items
}

/// Of the digests of all matches, in the order of the rows.
fn digest(of: &Evaluated) -> u64 {
    let mut hash = Xxh3::new();
    let digests = of.played.iter().filter_map(|row| row.result.as_ref().ok());
    digests.for_each(|result| hash.update(&result.digest.to_le_bytes()));
    hash.digest()
}

fn treatments(of: &Evaluated) -> ReportTable {
    let factors = of.experiment.file.factors.iter().map(|factor| factor.name.clone());
    let rows = of.summary.treatments.iter().enumerate().map(|(number, treatment)| {
        let levels = treatment.levels.iter().map(|(_, level)| level.clone());
        let [team, opponent] = of.experiment.strategies(number);
        let files = format!("{:016x}", of.experiment.assets_hash(number));
        levels.chain([team.clone(), opponent.clone(), files, treatment.seeds.to_string()]).collect()
    });
    let head = factors.chain(cells(["team", "opponent", "hash of the files", "seeds"]));
    ReportTable { head: head.collect(), rows: rows.collect(), words: of.experiment.file.factors.len() + 3 }
}
