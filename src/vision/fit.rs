//! Thresholds worked out from pixels of which people, or a renderer, say what they show.

use super::colours::{ColourBox, ColourClass, ColourTable};
use super::image::Yuv;
use super::lookup::ColourLookup;

/// By how much a threshold is moved at once; larger steps first.
const STEPS: [i16; 10] = [16, -16, 8, -8, 4, -4, 2, -2, 1, -1];

/// Rounds over all thresholds, at most.
const MOST_ROUNDS: usize = 40;

/// Equal pixels that show the same.
struct Sample {
    truth: Option<ColourClass>,
    pixel: Yuv,
    count: f32,
}

impl ColourTable {
    /// Thresholds that fit pixels of which it is said what they show; `None` is anything without a class.
    ///
    /// First each channel of a class holds the middle `share` of its values, 0 to 1. Then, where classes overlap or take what is
    /// of no class, thresholds are moved one at a time as long as that makes the score better: for each class the pixels that are
    /// taken for it rightly less those that are wrongly, as a share of those that show it, so that a small ball counts as much as
    /// the carpet. A class without pixels is not in the table.
    pub fn from_samples(
        samples: impl IntoIterator<Item = (Option<ColourClass>, Yuv)>,
        share: f32,
    ) -> ColourTable {
        let samples = counted(samples);
        let boxes =
            ColourClass::ALL.into_iter().filter_map(|class| Some((class, middle(&samples, class, share)?)));
        let mut table = ColourTable(boxes.collect());
        let mut best = score(&table, &samples);
        for _ in 0..MOST_ROUNDS {
            if !improve(&mut table, &samples, &mut best) {
                break;
            }
        }
        table
    }
}

/// Each pixel once, in order.
fn counted(samples: impl IntoIterator<Item = (Option<ColourClass>, Yuv)>) -> Vec<Sample> {
    let mut all: Vec<_> = samples.into_iter().map(|(truth, Yuv { y, u, v })| (truth, y, u, v)).collect();
    all.sort_unstable();
    all.chunk_by(|a, b| a == b)
        .map(|same| {
            let (truth, y, u, v) = same[0];
            Sample { truth, pixel: Yuv { y, u, v }, count: same.len() as f32 }
        })
        .collect()
}

/// The middle share of each channel of a class, if there are pixels of it.
fn middle(samples: &[Sample], class: ColourClass, share: f32) -> Option<ColourBox> {
    let channel = |channel: fn(Yuv) -> u8| {
        let mut counts = [0.0; 256];
        for sample in samples.iter().filter(|sample| sample.truth == Some(class)) {
            counts[usize::from(channel(sample.pixel))] += sample.count;
        }
        let spare = counts.iter().sum::<f32>() * (1.0 - share.clamp(0.0, 1.0)) / 2.0;
        let values = counts.into_iter().enumerate();
        Some((beyond(spare, values.clone())?, beyond(spare, values.rev())?))
    };
    Some(ColourBox {
        y: channel(|pixel| pixel.y)?,
        u: channel(|pixel| pixel.u)?,
        v: channel(|pixel| pixel.v)?,
    })
}

/// The first value that is not among those that are spared.
fn beyond(spare: f32, values: impl Iterator<Item = (usize, f32)>) -> Option<u8> {
    let mut passed = 0.0;
    let mut kept = values.filter(|(_, count)| {
        passed += count;
        *count > 0.0 && passed > spare
    });
    kept.next().map(|(value, _)| value as u8)
}

/// Over all classes: pixels that are taken for a class rightly less those that are wrongly, against those that show it.
fn score(table: &ColourTable, samples: &[Sample]) -> f32 {
    let lookup = ColourLookup::new(table);
    let (mut shown, mut gain) = ([0.0; ColourClass::ALL.len()], [0.0; ColourClass::ALL.len()]);
    for sample in samples {
        if let Some(class) = sample.truth {
            shown[class.index()] += sample.count;
        }
        if let Some(class) = lookup.class_of(sample.pixel) {
            let sign = if sample.truth == Some(class) { 1.0 } else { -1.0 };
            gain[class.index()] += sign * sample.count;
        }
    }
    shown.iter().zip(gain).filter(|(shown, _)| **shown > 0.0).map(|(shown, gain)| gain / shown).sum()
}

/// Moves each threshold once, if that is better; whether any was moved.
fn improve(table: &mut ColourTable, samples: &[Sample], best: &mut f32) -> bool {
    let classes: Vec<ColourClass> = table.0.keys().copied().collect();
    let before = *best;
    for class in classes {
        for (side, step) in (0..6).flat_map(|side| STEPS.map(|step| (side, step))) {
            let Some(moved) = moved(table.0[&class], side, step) else { continue };
            let old = table.0.insert(class, moved);
            let now = score(table, samples);
            if now > *best {
                *best = now;
            } else if let Some(old) = old {
                table.0.insert(class, old);
            }
        }
    }
    *best > before
}

/// With one of the six thresholds moved, if that leaves a box.
fn moved(mut colour: ColourBox, side: usize, step: i16) -> Option<ColourBox> {
    let channel = [&mut colour.y, &mut colour.u, &mut colour.v].into_iter().nth(side / 2)?;
    let end = if side.is_multiple_of(2) { &mut channel.0 } else { &mut channel.1 };
    *end = u8::try_from(i16::from(*end) + step).ok()?;
    (channel.0 <= channel.1).then_some(colour)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud(middle: Yuv, reach: u8) -> impl Iterator<Item = Yuv> {
        (0..200_u32).map(move |number| {
            let off = |factor: u32| (number * factor % (2 * u32::from(reach) + 1)) as u8;
            Yuv { y: middle.y - reach + off(7), u: middle.u - reach + off(11), v: middle.v - reach + off(13) }
        })
    }

    fn labelled(
        class: Option<ColourClass>,
        middle: Yuv,
        reach: u8,
    ) -> impl Iterator<Item = (Option<ColourClass>, Yuv)> {
        cloud(middle, reach).map(move |pixel| (class, pixel))
    }

    #[test]
    fn thresholds_hold_the_middle_of_the_samples() {
        let sparks = [(Some(ColourClass::Pink), Yuv { y: 255, u: 0, v: 0 })];
        let samples = labelled(Some(ColourClass::Pink), Yuv { y: 120, u: 140, v: 190 }, 10).chain(sparks);
        let samples: Vec<_> = samples.collect();
        let table = ColourTable::from_samples(samples.iter().copied(), 0.98);
        let pink = table.0[&ColourClass::Pink];
        let held = samples.iter().filter(|(_, pixel)| pink.holds(*pixel)).count();
        assert!(held >= 196, "{held} {pink:?}");
        assert_eq!(table.0.len(), 1, "classes without samples are left out");
    }

    #[test]
    fn where_classes_meet_the_thresholds_part_them() {
        let (orange, red) = (Yuv { y: 130, u: 90, v: 190 }, Yuv { y: 90, u: 108, v: 186 });
        let samples: Vec<_> = labelled(Some(ColourClass::Orange), orange, 15)
            .chain(labelled(Some(ColourClass::Red), red, 15))
            .chain(labelled(None, Yuv { y: 100, u: 128, v: 128 }, 20))
            .collect();
        let table = ColourTable::from_samples(samples.iter().copied(), 1.0);
        let right = samples.iter().filter(|(truth, pixel)| table.class_of(*pixel) == *truth).count();
        assert_eq!(right, samples.len(), "{table:?}");
    }

    #[test]
    fn a_class_gives_way_to_what_is_of_no_class() {
        let white = labelled(Some(ColourClass::White), Yuv { y: 220, u: 128, v: 128 }, 20);
        let grey = (0..20).flat_map(|_| labelled(None, Yuv { y: 190, u: 128, v: 128 }, 20));
        let samples: Vec<_> = white.chain(grey).collect();
        let all = ColourTable::from_samples(samples.iter().copied(), 1.0).0[&ColourClass::White];
        assert!(all.y.0 > 205, "{all:?}");
    }
}
