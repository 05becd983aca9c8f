//! The numbers of the fast model of a camera that fit what was seen best. Pure.

use crate::ops;
use crate::robot::Camera;
use crate::world::sense::detection;

/// The chance that a frame shows what is near, and the end of the range at which it falls to 0.3 of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub detection: f32,
    pub range: f32,
}

/// Width of the bins in which things are counted by range, m.
const BIN: f32 = 0.1;
/// Something is taken for a thing at any range with this chance, and missed with it: without that one freak would rule out a fit.
const FREAK: f64 = 0.01;

/// The most likely detection and range, by trying all: nothing, if nothing was looked at. Looks are at things in full view: their range,
/// m, and whether they were recognised. Ranges up to `most` metres.
pub(super) fn reach(looks: &[(f32, bool)], most: f32, camera: &Camera) -> Option<Reach> {
    let mut bins = vec![[0_u32; 2]; (most / BIN) as usize + 1];
    for &(range, seen) in looks {
        let bin = bins.get_mut((range / BIN) as usize);
        bin.into_iter().for_each(|bin| bin[usize::from(seen)] += 1);
    }
    let likelihood = |reach: &Reach| -> f64 {
        let model = Camera { detection: reach.detection, ..*camera };
        let of_bin = |(index, [missed, seen]): (usize, &[u32; 2])| {
            let chance = detection(&model, (index as f32 + 0.5) * BIN, reach.range);
            let chance = f64::from(chance).clamp(FREAK, 1.0 - FREAK);
            f64::from(*seen) * ops::ln_f64(chance) + f64::from(*missed) * ops::ln_f64(1.0 - chance)
        };
        bins.iter().enumerate().map(of_bin).sum()
    };
    let steps = (most / (BIN / 2.0)) as usize;
    let ranges = (1..=steps).map(|step| step as f32 * (BIN / 2.0));
    let all =
        ranges.flat_map(|range| (1..=100).map(move |part| Reach { detection: part as f32 / 100.0, range }));
    let judged = all.map(|reach| (likelihood(&reach), reach));
    let best = judged.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, reach)| reach).filter(|_| looks.iter().any(|(range, _)| *range < most))
}

/// Standard deviation of measured ranges: this at no range, m, and this times the range squared, 1/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RangeErrors {
    pub floor: f32,
    pub noise: f32,
}

/// Width of the bins in which errors are counted by range, m.
const ERROR_BIN: f32 = 0.25;
/// Fewer errors than this tell no deviation.
const LEAST: usize = 12;

/// The least-squares fit to the deviations at each range, each as heavy as it is certain; nothing, with errors at fewer than two
/// ranges. Errors are pairs of a true range and what was measured too much, m.
pub(super) fn range_errors(errors: &[(f32, f32)]) -> Option<RangeErrors> {
    let most = errors.iter().map(|(range, _)| *range).fold(0.0, f32::max);
    let mut bins = vec![Vec::new(); (most / ERROR_BIN) as usize + 1];
    errors.iter().for_each(|error| bins[(error.0 / ERROR_BIN) as usize].push(*error));
    let points: Vec<[f64; 3]> = (bins.iter().filter(|bin| bin.len() >= LEAST))
        .map(|bin| {
            let n = bin.len() as f64;
            let squared_range = bin.iter().map(|(range, _)| f64::from(range * range)).sum::<f64>() / n;
            let deviation = (bin.iter().map(|(_, error)| f64::from(error * error)).sum::<f64>() / n).sqrt();
            [squared_range, deviation, n / deviation.max(1e-4).powi(2)]
        })
        .collect();
    let sum = |of: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(of).sum::<f64>();
    let (w, wx, wy) = (sum(&|p| p[2]), sum(&|p| p[2] * p[0]), sum(&|p| p[2] * p[1]));
    let (wxx, wxy) = (sum(&|p| p[2] * p[0] * p[0]), sum(&|p| p[2] * p[0] * p[1]));
    let spread = w * wxx - wx * wx;
    if points.len() < 2 || spread <= 0.0 {
        return None;
    }
    let (floor, noise) = ((wy * wxx - wx * wxy) / spread, (w * wxy - wx * wy) / spread);
    let (floor, noise) = match (floor < 0.0, noise < 0.0) {
        (true, _) => (0.0, wxy / wxx),
        (_, true) => (wy / w, 0.0),
        _ => (floor, noise),
    };
    Some(RangeErrors { floor: floor as f32, noise: noise as f32 })
}

/// The root of the mean square; nothing without any.
pub(super) fn root_mean_square(errors: impl Iterator<Item = f32>) -> Option<f32> {
    let (sum, n) = errors.fold((0.0, 0), |(sum, n), error| (sum + f64::from(error * error), n + 1));
    (n > 0).then(|| (sum / f64::from(n)).sqrt() as f32)
}

/// The least visible share at which a thing is recognised half as often as in full view; by the fifths that the fast model
/// distinguishes. Looks are pairs of the visible share and whether the thing was recognised.
pub(super) fn least_share(looks: &[(f32, bool)]) -> Option<f32> {
    let rate = |fifths: u32| {
        let of_share = looks.iter().filter(|(share, _)| (5.0 * share).round() as u32 == fifths);
        let (seen, n) = of_share.fold((0, 0), |(seen, n), look| (seen + u32::from(look.1), n + 1));
        (n as usize >= LEAST).then(|| seen as f32 / n as f32)
    };
    let full = rate(5)?;
    let enough = (1..=5).take_while(|hidden| rate(5 - hidden).is_none_or(|rate| rate >= 0.5 * full)).count();
    Some((5 - enough) as f32 / 5.0)
}

/// The share of those that are so; nothing without any.
pub(super) fn share(all: impl Iterator<Item = bool>) -> Option<f32> {
    let (so, n) = all.fold((0_u32, 0_u32), |(so, n), is_so| (so + u32::from(is_so), n + 1));
    (n > 0).then(|| so as f32 / n as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Dice, Seed};
    use crate::robot::range_deviation;

    const CAMERA: Camera = Camera {
        field_of_view: 57.0,
        frame_hz: 30.0,
        latency: 0.0,
        ball_range: 2.8,
        robot_range: 2.0,
        range_noise: 0.04,
        range_floor: 0.03,
        bearing_noise: 2.0,
        detection: 0.85,
        visible_share: 0.4,
        false_positive: 0.0,
        wrong_team: 0.0,
    };

    #[test]
    fn looks_by_the_fast_model_give_its_detection_and_range_back() {
        let mut dice = Dice::new(Seed(3), "test", None);
        let looks: Vec<(f32, bool)> = (0..6000)
            .map(|_| {
                let range = 4.0 * dice.uniform();
                (range, dice.chance(detection(&CAMERA, range, CAMERA.ball_range)))
            })
            .collect();
        let Reach { detection, range } = reach(&looks, 4.0, &CAMERA).unwrap();
        assert!((detection - 0.85).abs() < 0.02 && (range - 2.8).abs() < 0.08, "{detection} {range}");
        assert_eq!(reach(&[], 4.0, &CAMERA), None);
    }

    #[test]
    fn errors_by_the_fast_model_give_its_noise_and_floor_back() {
        let mut dice = Dice::new(Seed(4), "test", None);
        let errors: Vec<(f32, f32)> = (0..6000)
            .map(|_| {
                let range = 0.2 + 2.5 * dice.uniform();
                (range, dice.normal(range_deviation(&CAMERA, range)))
            })
            .collect();
        let RangeErrors { floor, noise } = range_errors(&errors).unwrap();
        assert!((floor - 0.03).abs() < 0.005 && (noise - 0.04).abs() < 0.004, "{floor} {noise}");
        assert_eq!(range_errors(&errors[..5]), None);
    }

    #[test]
    fn no_fitted_deviation_is_negative() {
        let errors: Vec<(f32, f32)> =
            (0..100).map(|i| if i % 2 == 0 { (0.5, 0.001) } else { (2.0, 0.4) }).collect();
        let fitted = range_errors(&errors).unwrap();
        assert!(fitted.floor == 0.0 && fitted.noise > 0.0, "{fitted:?}");
    }

    #[test]
    fn the_least_share_is_the_last_before_things_are_mostly_missed() {
        let mut looks = Vec::new();
        for (fifths, seen) in [(5, 18), (4, 18), (3, 15), (2, 3), (1, 0), (0, 0)] {
            looks.extend((0..20).map(|n| (fifths as f32 / 5.0, n < seen)));
        }
        assert_eq!(least_share(&looks), Some(0.6));
        assert_eq!(least_share(&[]), None);
    }
}
