//! What is said of one metric of an experiment: means, comparisons, plots.

use super::document::{ReportBlock, ReportTable, cells};
use super::evaluated::Evaluated;
use super::level_comparison::{LevelComparison, level_comparisons};
use super::metric_title::with_unit;
use super::plot::plots;
use crate::lab::experiment::{CONFIDENCE, Factor, MeanWithInterval, Metric, probability};
use crate::lab::statistics::{PairedDifference, compare_pairs};
use crate::rng::{DEFAULT_SEED, Seed};

/// All that is said of a metric.
pub(super) fn blocks(of: &Evaluated, metric: Metric) -> Vec<ReportBlock> {
    let mut blocks = vec![
        ReportBlock::Heading(with_unit(metric)),
        ReportBlock::Text(metric.says().to_owned()),
        ReportBlock::Table(means(of, metric)),
    ];
    for (place, factor) in of.experiment.file.factors.iter().enumerate() {
        if factor.levels.len() > 1 {
            let first = factor.levels.names().swap_remove(0);
            let text = format!("What differs by {} with the same seeds, against {first}:", factor.name);
            blocks.push(ReportBlock::Text(text));
            blocks.push(ReportBlock::Table(differences(of, metric, (place, factor))));
        }
    }
    let drawn = plots(of, metric);
    if !drawn.is_empty() {
        blocks.push(ReportBlock::Plots(drawn));
    }
    blocks
}

fn means(of: &Evaluated, metric: Metric) -> ReportTable {
    let factors = of.experiment.file.factors.iter().map(|factor| factor.name.clone());
    let head = factors.chain(cells(["seeds", "mean [95 %]"])).collect();
    let rows = of.summary.treatments.iter().map(|treatment| {
        let levels = treatment.levels.iter().map(|(_, level)| level.clone());
        let figure = treatment.figures.get(&metric);
        let (value, interval) = figure.map_or((None, None), |figure| (figure.mean, figure.interval));
        let mean = MeanWithInterval { value, interval };
        levels.chain([treatment.seeds.to_string(), mean.to_string()]).collect()
    });
    ReportTable { head, rows: rows.collect(), words: of.experiment.file.factors.len() }
}

fn differences(of: &Evaluated, metric: Metric, (place, factor): (usize, &Factor)) -> ReportTable {
    let file = &of.experiment.file;
    let others = file.factors.iter().filter(|other| other.name != factor.name);
    let words: Vec<String> = [factor].into_iter().chain(others).map(|factor| factor.name.clone()).collect();
    let figures = ["seeds", "difference [95 %]", "p", "d_z", "P(more)", "seeds to show it"];
    let rows = level_comparisons(file, place).into_iter().map(|comparison| {
        let pairs = of.rows.differences(comparison.treatments, metric);
        let LevelComparison { level, among, .. } = comparison;
        let words = [level].into_iter().chain(among);
        words.chain(difference_cells(compare_pairs(&pairs, CONFIDENCE, Seed(DEFAULT_SEED)))).collect()
    });
    let rows = rows.collect();
    ReportTable { words: words.len(), head: words.into_iter().chain(cells(figures)).collect(), rows }
}

fn difference_cells(difference: Option<PairedDifference>) -> Vec<String> {
    let Some(difference) = difference else { return cells(["0", "-", "-", "-", "-", "-"]) };
    let unknown = || "-".to_owned();
    let mean = MeanWithInterval { value: Some(difference.mean), interval: difference.interval };
    let improvement = difference.improvement;
    let more =
        MeanWithInterval { value: Some(improvement.probability), interval: Some(improvement.interval) };
    vec![
        difference.pairs.to_string(),
        format!("{mean:+}"),
        difference.signed_rank.map_or_else(unknown, |test| probability(test.p)),
        difference.cohens_d_z.map_or_else(unknown, |effect| format!("{effect:+.2}")),
        more.to_string(),
        difference.pairs_until_shown.map_or_else(unknown, |pairs| pairs.to_string()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_of_a_difference_is_a_dash() {
        assert_eq!(difference_cells(None), ["0", "-", "-", "-", "-", "-"]);
        let equal = difference_cells(compare_pairs(&[0.0; 4], 0.95, Seed(1)));
        assert_eq!(equal[..4], ["4", "+0.000", "-", "-"]);
        let clear = difference_cells(compare_pairs(&[1.0, 1.5, 2.0, 2.5, 3.0, 3.5], 0.95, Seed(1)));
        assert!(clear[1].starts_with("+2.250 [+1."), "{clear:?}");
        assert_eq!(clear[2], "0.031");
        assert!(clear[4].starts_with("1.000 ["), "{clear:?}");
    }
}
