//! How many seeds it takes to tell two treatments apart by goals, and how many by how they crowd the ball.

use super::document::{ReportBlock, ReportTable, cells};
use super::evaluated::Evaluated;
use super::level_comparison::{LevelComparison, level_comparisons};
use crate::lab::experiment::{CONFIDENCE, Metric};
use crate::lab::statistics::pairs_until_shown;

const ABOUT: &str = "Goals are rare, so that they need many matches to tell two teams apart; what robots do all the time needs fewer. For treatments \
    that differ by one level, the other factors at their first: the seeds that show their difference by Wilcoxon's test in nine cases of ten, if the truth is as it seems, by the goal \
    difference and by how the ball is crowded (agglomeration, within half a metre, where robots are small). 15 is the least that can be told. - is more than a million, or cannot be told.";

/// The measures of a crowd, the one for small robots first.
const CROWDS: [Metric; 2] = [Metric::Agglomeration, Metric::Crowding];

/// The chapter about it; nothing if no experiment shows both.
pub(super) fn blocks(experiments: &[&Evaluated]) -> Vec<ReportBlock> {
    let needed: Vec<SeedsNeeded> = experiments.iter().flat_map(|of| seeds_needed(of)).collect();
    if needed.is_empty() {
        return Vec::new();
    }
    vec![
        ReportBlock::Chapter("How many seeds a question needs".into()),
        ReportBlock::Text(ABOUT.into()),
        ReportBlock::Text(in_all(&needed)),
        ReportBlock::Table(table(&needed)),
    ]
}

/// Two treatments that differ by one level.
struct SeedsNeeded {
    experiment: String,
    of: String,
    by_goals: Option<u32>,
    by_crowd: Option<u32>,
}

fn told(seeds: Option<u32>) -> u32 {
    seeds.unwrap_or(u32::MAX)
}

fn in_all(needed: &[SeedsNeeded]) -> String {
    let fewer = needed.iter().filter(|it| told(it.by_crowd) < told(it.by_goals)).count();
    let more = needed.iter().filter(|it| told(it.by_crowd) > told(it.by_goals)).count();
    format!(
        "Of {} comparisons {fewer} need fewer seeds by the crowd than by goals, {more} need more, and {} as many.",
        needed.len(),
        needed.len() - fewer - more
    )
}

/// Each level of each factor against its first, where the other factors have their first.
fn seeds_needed(of: &Evaluated) -> Vec<SeedsNeeded> {
    let file = &of.experiment.file;
    let Some(crowd) = CROWDS.into_iter().find(|crowd| file.metrics.contains(crowd)) else {
        return Vec::new();
    };
    if !file.metrics.contains(&Metric::GoalDifference) {
        return Vec::new();
    }
    let mut needed = Vec::new();
    for (place, factor) in file.factors.iter().enumerate() {
        let comparisons = level_comparisons(file, place).into_iter();
        for LevelComparison { level, treatments, .. } in comparisons.filter(|it| it.treatments[1] == 0) {
            let seeds = |metric| pairs_until_shown(&of.rows.differences(treatments, metric), CONFIDENCE);
            needed.push(SeedsNeeded {
                experiment: file.name.clone(),
                of: format!("{}: {level} against {}", factor.name, factor.levels.names()[0]),
                by_goals: seeds(Metric::GoalDifference),
                by_crowd: seeds(crowd),
            });
        }
    }
    needed
}

fn table(needed: &[SeedsNeeded]) -> ReportTable {
    let cell = |seeds: Option<u32>| seeds.map_or_else(|| "-".to_owned(), |seeds| seeds.to_string());
    let row =
        |it: &SeedsNeeded| vec![it.experiment.clone(), it.of.clone(), cell(it.by_goals), cell(it.by_crowd)];
    ReportTable {
        head: cells(["experiment", "treatments", "seeds by goals", "seeds by the crowd"]),
        rows: needed.iter().map(row).collect(),
        words: 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_never_shows_needs_more_than_whatever_shows() {
        let needed = |by_goals, by_crowd| SeedsNeeded {
            experiment: "booking".into(),
            of: "on against off".into(),
            by_goals,
            by_crowd,
        };
        let all = [
            needed(Some(90), Some(15)),
            needed(None, Some(70)),
            needed(Some(15), Some(15)),
            needed(Some(20), None),
        ];
        let said = in_all(&all);
        assert_eq!(
            said,
            "Of 4 comparisons 2 need fewer seeds by the crowd than by goals, 1 need more, and 1 as many."
        );
        assert_eq!(table(&all).rows[1][2..], ["-", "70"]);
    }
}
