//! How high each item stands: as near to its neighbours as the order in its column allows, band under band.

use super::columns::Columns;
use super::sketch::{FRAME, GAP, MARGIN};

/// Passes over all columns.
const SWEEPS: usize = 16;

/// The middle of each item.
pub fn rows(columns: &Columns, frames: &[usize]) -> Vec<f32> {
    let mut middles = vec![0.0; columns.items.len()];
    let bands = frames.len() + 1;
    for band in 0..bands {
        settle(columns, band, &mut middles);
    }
    stack(columns, frames, 0, MARGIN, &mut middles);
    middles
}

/// Puts the items of one band as near to their neighbours in it as may be.
fn settle(columns: &Columns, band: usize, middles: &mut [f32]) {
    let is_in = |item: &usize| columns.items[*item].band == band;
    let neighbours: Vec<Vec<usize>> = (columns.neighbours().into_iter())
        .map(|[left, right]| left.into_iter().chain(right).filter(is_in).collect())
        .collect();
    let own: Vec<Vec<usize>> =
        columns.columns.iter().map(|column| column.iter().copied().filter(is_in).collect()).collect();
    for sweep in 0..=SWEEPS {
        for step in 0..own.len() {
            let column = &own[if sweep % 2 == 0 { step } else { own.len() - 1 - step }];
            let wanted: Vec<f32> = (column.iter())
                .map(|item| {
                    let beside = &neighbours[*item];
                    let sum: f32 = beside.iter().map(|other| middles[*other]).sum();
                    if beside.is_empty() { middles[*item] } else { sum / beside.len() as f32 }
                })
                .collect();
            let heights: Vec<f32> = column.iter().map(|item| columns.items[*item].size.y).collect();
            for (item, middle) in column.iter().zip(spread(&wanted, &heights)) {
                middles[*item] = middle;
            }
        }
    }
}

/// Moves a band, and the frames in it below its own items, down to a height; returns where it ends.
fn stack(columns: &Columns, frames: &[usize], band: usize, top: f32, middles: &mut [f32]) -> f32 {
    let own: Vec<usize> = (0..columns.items.len()).filter(|item| columns.items[*item].band == band).collect();
    let half = |item: &usize| columns.items[*item].size.y / 2.0;
    let least = own.iter().map(|item| middles[*item] - half(item)).fold(f32::INFINITY, f32::min);
    let mut bottom = top;
    for item in &own {
        middles[*item] += top - least;
        bottom = bottom.max(middles[*item] + half(item));
    }
    for (frame, _) in frames.iter().enumerate().filter(|(_, around)| **around == band) {
        bottom = stack(columns, frames, frame + 1, bottom + GAP + FRAME, middles) + FRAME;
    }
    bottom
}

/// The middles nearest to those wanted (least squares) of things of these heights that lie in order and do not touch: with the
/// heights taken off, an isotonic regression by pooling neighbours (Ayer and others, 1955).
fn spread(wanted: &[f32], heights: &[f32]) -> Vec<f32> {
    let mut offsets = Vec::with_capacity(heights.len());
    let mut offset = 0.0;
    for (place, height) in heights.iter().enumerate() {
        if place > 0 {
            offset += (heights[place - 1] + height) / 2.0 + GAP;
        }
        offsets.push(offset);
    }
    // Pools of a sum and a number of places.
    let mut pools: Vec<(f32, usize)> = Vec::new();
    for (wanted, offset) in wanted.iter().zip(&offsets) {
        pools.push((wanted - offset, 1));
        while let [.., (before, some), (after, more)] = pools[..]
            && before / some as f32 > after / more as f32
        {
            pools.truncate(pools.len() - 2);
            pools.push((before + after, some + more));
        }
    }
    let levels = pools.iter().flat_map(|(sum, count)| std::iter::repeat_n(sum / *count as f32, *count));
    levels.zip(offsets).map(|(level, offset)| level + offset).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn what_does_not_touch_stays_and_what_does_is_moved_aside_by_the_same_distance() {
        assert_eq!(spread(&[0.0, 100.0], &[10.0, 10.0]), [0.0, 100.0]);
        assert_eq!(spread(&[50.0, 50.0], &[10.0, 10.0]), [50.0 - 8.5, 50.0 + 8.5]);
    }

    proptest! {
        #[test]
        fn things_lie_in_order_and_apart(things in proptest::collection::vec((-200.0f32..200.0, 1.0f32..50.0), 1..20)) {
            let (wanted, heights): (Vec<f32>, Vec<f32>) = things.into_iter().unzip();
            let middles = spread(&wanted, &heights);
            for place in 1..middles.len() {
                let between = middles[place] - middles[place - 1];
                prop_assert!(between >= (heights[place] + heights[place - 1]) / 2.0 + GAP - 0.01);
            }
        }
    }
}
