//! Thresholds as tables of bits, so that the class of a pixel costs three look-ups whatever the number of classes (after the idea
//! of CMVision: Bruce, Balch and Veloso, Fast and inexpensive color image segmentation for interactive robots, 2000).

use super::colours::{ColourClass, ColourTable};
use super::image::Yuv;

/// A [`ColourTable`] worked out: for each value of each channel, one bit for every class that allows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColourLookup {
    y: [u8; VALUES],
    u: [u8; VALUES],
    v: [u8; VALUES],
    /// The first class of a set of them.
    first: [Option<ColourClass>; VALUES],
}

/// Of a channel, and sets of classes.
const VALUES: usize = 256;

impl ColourLookup {
    /// Works a table out.
    pub fn new(table: &ColourTable) -> ColourLookup {
        let mut lookup = ColourLookup {
            y: [0; VALUES],
            u: [0; VALUES],
            v: [0; VALUES],
            first: std::array::from_fn(first_of),
        };
        for (class, colour) in &table.0 {
            let channels = [(&mut lookup.y, colour.y), (&mut lookup.u, colour.u), (&mut lookup.v, colour.v)];
            for (bits, (least, most)) in channels {
                let allowed = bits.iter_mut().take(usize::from(most) + 1).skip(usize::from(least));
                allowed.for_each(|bits| *bits |= 1 << class.index());
            }
        }
        lookup
    }

    /// The class of a pixel: the same as the [table's](ColourTable::class_of).
    #[inline]
    pub fn class_of(&self, pixel: Yuv) -> Option<ColourClass> {
        let bits = self.y[usize::from(pixel.y)] & self.u[usize::from(pixel.u)] & self.v[usize::from(pixel.v)];
        self.first[usize::from(bits)]
    }
}

fn first_of(set: usize) -> Option<ColourClass> {
    ColourClass::ALL.into_iter().find(|class| set >> class.index() & 1 == 1)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::vision::ColourBox;

    fn channel() -> impl Strategy<Value = (u8, u8)> {
        (any::<u8>(), any::<u8>()).prop_map(|(a, b)| (a.min(b), a.max(b)))
    }

    fn table() -> impl Strategy<Value = ColourTable> {
        let colour = (channel(), channel(), channel()).prop_map(|(y, u, v)| ColourBox { y, u, v });
        let entry = (prop::sample::select(ColourClass::ALL.to_vec()), colour);
        prop::collection::btree_map(entry.0, entry.1, 0..8).prop_map(ColourTable)
    }

    proptest! {
        #[test]
        fn looked_up_classes_are_those_of_the_thresholds(
            table in table(),
            pixels in prop::collection::vec(any::<(u8, u8, u8)>(), 200),
        ) {
            let lookup = ColourLookup::new(&table);
            for (y, u, v) in pixels {
                let pixel = Yuv { y, u, v };
                prop_assert_eq!(lookup.class_of(pixel), table.class_of(pixel));
            }
        }
    }
}
