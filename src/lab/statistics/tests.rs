//! Everything here is compared with scipy's values, which tests/statistics/scipy_values.py has written.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::average::*;
use super::bootstrap::*;
use super::compare::*;
use super::effect::*;
use super::equivalence::*;
use super::improvement::*;
use super::interval::Interval;
use super::power::*;
use super::probability::log_ratio;
use super::share::*;
use super::signed_rank::*;
use crate::rng::{Dice, Seed};

#[derive(Deserialize)]
struct Values {
    samples: Vec<SampleCase>,
    improvements: Vec<ImprovementCase>,
    proportions: Vec<ProportionCase>,
    powers: Vec<PowerCase>,
    numbers_of_pairs: Vec<PairsCase>,
    sequential: Vec<SequentialCase>,
}

#[derive(Deserialize)]
struct SampleCase {
    name: String,
    values: Vec<f64>,
    average: AverageCase,
    d_z: f64,
    signed_rank: RankCase,
    equivalence: Vec<EquivalenceCase>,
    wilcoxon_pairs: Vec<WilcoxonPairsCase>,
    improvement_of_pairs: Vec<ShareCase>,
    bca: Vec<BcaCase>,
}

#[derive(Deserialize)]
struct ShareCase {
    level: f64,
    share: f64,
    low: f64,
    high: f64,
}

#[derive(Deserialize)]
struct AverageCase {
    mean: f64,
    median: f64,
    /// Shares and what lies at them.
    quantiles: Vec<(f64, f64)>,
    deviation: f64,
    intervals: Vec<(f64, f64, f64)>,
}

#[derive(Deserialize)]
struct RankCase {
    count: usize,
    above: f64,
    below: f64,
    rank_biserial: f64,
    normal: f64,
    exact: Option<f64>,
}

#[derive(Deserialize)]
struct EquivalenceCase {
    margin: f64,
    p: f64,
    low: f64,
    high: f64,
}

#[derive(Deserialize)]
struct WilcoxonPairsCase {
    share: f64,
    power: f64,
    level: f64,
    pairs: Option<u32>,
}

#[derive(Deserialize)]
struct BcaCase {
    statistic: String,
    level: f64,
    resamples: Vec<String>,
    low: f64,
    high: f64,
    percentile: (f64, f64),
}

#[derive(Deserialize)]
struct ImprovementCase {
    first: Vec<f64>,
    second: Vec<f64>,
    level: f64,
    share: f64,
    low: f64,
    high: f64,
}

#[derive(Deserialize)]
struct ProportionCase {
    won: u32,
    of: u32,
    level: f64,
    wilson: (f64, f64),
    exact: (f64, f64),
}

#[derive(Deserialize)]
struct PowerCase {
    effect: f64,
    pairs: u32,
    level: f64,
    power: f64,
}

#[derive(Deserialize)]
struct PairsCase {
    effect: f64,
    power: f64,
    level: f64,
    pairs: u32,
}

#[derive(Deserialize)]
struct SequentialCase {
    met: f64,
    of: f64,
    threshold: f64,
    log_ratio: f64,
}

fn values() -> Values {
    parsed(include_str!("../../../tests/statistics/scipy_values.json"))
}

fn parsed<T: DeserializeOwned>(text: &str) -> T {
    serde_json::from_str(text).expect("the file is what the script writes")
}

/// To 1e-6, of the value itself where it is more than 1.
#[track_caller]
fn assert_near(found: f64, expected: f64, what: &str) {
    let off = (found - expected).abs() / expected.abs().max(1.0);
    assert!(off < 1e-6, "{what}: {found}, scipy has {expected}");
}

#[track_caller]
fn assert_interval(found: Option<Interval>, low: f64, high: f64, what: &str) {
    let found = found.unwrap_or_else(|| panic!("{what}: there is no interval"));
    assert_near(found.low, low, what);
    assert_near(found.high, high, what);
}

/// A tail is compared by its own size, so that small ones count.
#[track_caller]
fn assert_tail(found: f64, expected: f64, what: &str) {
    let off = (found - expected).abs() / expected.max(1e-9);
    assert!(off < 1e-6, "{what}: {found:e}, scipy has {expected:e}");
}

#[test]
fn means_medians_and_their_intervals_are_those_of_scipy() {
    for SampleCase { name, values, average, d_z, .. } in values().samples {
        let spread = SampleMoments::of(&values).expect("it has two values");
        assert_near(mean(&values).expect("it has values"), average.mean, &name);
        assert_near(median(&values).expect("it has values"), average.median, &name);
        for (share, value) in average.quantiles {
            assert_near(quantile(&values, share).expect("it has values"), value, &name);
        }
        assert_near(spread.deviation, average.deviation, &name);
        assert_near(cohens_d_z(&values).expect("it has a spread"), d_z, &name);
        for (level, low, high) in average.intervals {
            assert_interval(mean_interval(&values, level), low, high, &name);
        }
    }
}

#[test]
fn signed_ranks_are_those_of_scipy() {
    let mut exact = 0;
    for SampleCase { name, values, signed_rank: expected, .. } in values().samples {
        let found = signed_rank(&values).expect("it has differences");
        assert_eq!(
            (found.count, found.above, found.below),
            (expected.count, expected.above, expected.below),
            "{name}"
        );
        assert_eq!(found.method == TailMethod::Exact, found.count <= 50, "{name}");
        assert_near(rank_biserial(&values).expect("it has differences"), expected.rank_biserial, &name);
        let by = |method| signed_rank_by(method, &values).expect("it has differences").p;
        assert_tail(by(TailMethod::Normal), expected.normal, &name);
        if let Some(p) = expected.exact {
            exact += 1;
            assert_tail(by(TailMethod::Exact), p, &name);
        }
    }
    assert!(exact >= 8, "{exact} samples are small enough for scipy to count");
}

#[test]
fn of_the_same_resamples_a_bootstrap_interval_is_that_of_scipy() {
    let mut compared = 0;
    for SampleCase { name, values, bca, .. } in values().samples {
        for BcaCase { statistic, level, resamples, low, high, percentile } in bca {
            let resamples: Vec<f64> =
                resamples.iter().map(|value| value.parse().expect("it is a number")).collect();
            let plain = percentile_interval(resamples.clone(), level);
            assert_interval(plain, percentile.0, percentile.1, &format!("{name}, {statistic}, percentile"));
            let found = match statistic.as_str() {
                "mean" => bca_interval(&values, mean_of_some, resamples, level),
                _ => bca_interval(&values, |drawn| median(drawn).unwrap_or(f64::NAN), resamples, level),
            };
            assert_interval(found, low, high, &format!("{name}, {statistic}"));
            compared += 1;
        }
    }
    assert!(compared >= 15, "{compared} intervals");
}

#[test]
fn equivalence_is_that_of_two_tests_of_scipy() {
    for SampleCase { name, values, equivalence: expected, .. } in values().samples {
        for EquivalenceCase { margin, p, low, high } in expected {
            let found = equivalence(&values, margin, 0.95).expect("it has a spread");
            assert_tail(found.p, p, &name);
            assert_interval(Some(found.interval), low, high, &name);
            let is_within = -margin < low && high < margin;
            assert_eq!(found.holds, is_within, "{name}: the interval and the tests agree");
        }
    }
}

#[test]
fn the_probability_of_improvement_is_that_of_mann_and_whitney_with_newcombes_interval() {
    for ImprovementCase { first, second, level, share, low, high } in values().improvements {
        let found = improvement_of_samples(&first, &second, level).expect("it has matches");
        let what = format!("{first:?} against {second:?}");
        assert_near(found.probability, share, &what);
        assert_interval(Some(found.interval), low, high, &what);
    }
}

#[test]
fn the_improvement_of_pairs_is_the_share_of_wins_with_wilsons_interval() {
    for SampleCase { name, values, improvement_of_pairs: expected, .. } in values().samples {
        for ShareCase { level, share, low, high } in expected {
            let found = improvement_of_pairs(&values, level).expect("it has pairs");
            assert_near(found.probability, share, &name);
            assert_interval(Some(found.interval), low, high, &name);
        }
    }
}

#[test]
fn intervals_of_shares_are_those_of_scipy() {
    for ProportionCase { won, of, level, wilson: by_wilson, exact } in values().proportions {
        let what = format!("{won} of {of}, {level}");
        assert_interval(Some(wilson(f64::from(won), f64::from(of), level)), by_wilson.0, by_wilson.1, &what);
        assert_interval(Some(clopper_pearson(won, of, level)), exact.0, exact.1, &what);
    }
}

#[test]
fn power_and_the_number_of_pairs_are_those_of_scipys_noncentral_t() {
    let values = values();
    for PowerCase { effect, pairs, level, power } in values.powers {
        let found = paired_t_power(effect, pairs, level).expect("there are two pairs");
        assert_near(found, power, &format!("{effect} with {pairs} pairs, {level}"));
    }
    for PairsCase { effect, power, level, pairs } in values.numbers_of_pairs {
        assert_eq!(pairs_until_t_test_shows(effect, power, level), Some(pairs), "{effect}, {power}, {level}");
    }
    assert_eq!(pairs_until_t_test_shows(0.0, 0.8, 0.95), None);
}

#[test]
fn pairs_for_wilcoxons_test_are_those_of_noethers_formula() {
    for SampleCase { name, values, wilcoxon_pairs, .. } in values().samples {
        for WilcoxonPairsCase { share, power, level, pairs } in wilcoxon_pairs {
            let found = walsh_share(&values).expect("it has two differences");
            assert_near(found, share, &name);
            assert_eq!(pairs_until_wilcoxon_shows(found, power, level), pairs, "{name}");
        }
    }
}

#[test]
fn the_ratio_of_the_sequential_test_is_that_of_integrals() {
    for SequentialCase { met, of, threshold, log_ratio: expected } in values().sequential {
        let found = if met > threshold * of {
            log_ratio((met, of - met), threshold)
        } else {
            log_ratio((of - met, met), 1.0 - threshold)
        };
        assert_near(found, expected, &format!("{met} of {of} against {threshold}"));
    }
}

#[test]
fn a_bootstrap_interval_holds_the_mean_about_as_often_as_said() {
    let mut dice = Dice::new(Seed(5), "bootstrap test", None);
    let held = (0..300).filter(|_| {
        let values: Vec<f64> = (0..30).map(|_| f64::from(dice.normal(2.0))).collect();
        let resamples = resampled(&values, mean_of_some, 400, &mut dice);
        bca_interval(&values, mean_of_some, resamples, 0.9).is_some_and(|interval| interval.holds(0.0))
    });
    // The bootstrap is a little too sure with 30 values: 88 % are usual. Three deviations are 5 %.
    let held = held.count();
    assert!((245..290).contains(&held), "{held} of 300");
}

#[test]
fn samples_that_say_nothing_have_no_interval_and_no_test() {
    for values in [&[][..], &[1.0], &[2.0; 9]] {
        let resamples = resampled(values, mean_of_some, 50, &mut Dice::new(Seed(1), "bootstrap", None));
        assert_eq!(bca_interval(values, mean_of_some, resamples, 0.95), None, "{values:?}");
        assert_eq!(cohens_d_z(values), None, "{values:?}");
        assert_eq!(equivalence(values, 0.3, 0.95), None, "{values:?}");
    }
    assert_eq!((mean(&[]), median(&[]), quantile(&[], 0.5)), (None, None, None));
    assert_eq!(SampleMoments::of(&[1.0]), None);
    assert_eq!((signed_rank(&[]), signed_rank(&[0.0, 0.0]), rank_biserial(&[0.0])), (None, None, None));
    assert_eq!((improvement_of_pairs(&[], 0.95), improvement_of_samples(&[], &[1.0], 0.95)), (None, None));
    assert_eq!((walsh_share(&[1.0]), paired_t_power(0.5, 1, 0.95)), (None, None));
    assert_eq!(compare_pairs(&[], 0.95, Seed(1)), None);
}

#[test]
fn a_comparison_of_pairs_says_all_of_it_and_says_it_again() {
    let differences = [1.0, 2.0, 0.0, -1.0, 3.0, 2.0, 1.0, 0.0, 4.0, 1.0];
    let found = compare_pairs(&differences, 0.95, Seed(1)).expect("there are pairs");
    assert_eq!((found.pairs, found.mean, found.median), (10, 1.3, 1.0));
    let interval = found.interval.expect("the differences have a spread");
    assert!(
        interval.low > 0.2 && interval.low < 0.8 && interval.high > 1.8 && interval.high < 2.6,
        "{interval:?}"
    );
    assert_eq!(found.improvement.probability, 0.8);
    assert!(found.signed_rank.is_some_and(|test| test.p < 0.05 && test.count == 8), "{found:?}");
    assert_eq!(compare_pairs(&differences, 0.95, Seed(1)), Some(found));
    let drawn =
        |seed| resampled(&differences, mean_of_some, 20, &mut Dice::new(Seed(seed), "bootstrap", None));
    assert_ne!(drawn(1), drawn(2));
}
