//! Metrics in words.

use crate::lab::experiment::Metric;

/// "Mate distance (m)".
pub(super) fn with_unit(metric: Metric) -> String {
    let words = metric.column().replace('_', " ");
    let mut letters = words.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    let unit = if metric.unit().is_empty() { String::new() } else { format!(" ({})", metric.unit()) };
    format!("{first}{}{unit}", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metric_is_called_in_words_with_its_unit() {
        assert_eq!(with_unit(Metric::MateContactTime), "Mate contact time (s/min)");
        assert_eq!(with_unit(Metric::GoalDifference), "Goal difference");
    }
}
