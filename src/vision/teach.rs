//! How people teach a camera its colours: they click on pixels, and look at what becomes of the picture.

use super::colours::{ColourBox, ColourClass, ColourTable};
use super::image::{Image, Yuv};

impl ColourTable {
    /// Teaches what is at a point of a picture: widens the thresholds of a class until they hold the pixel and its neighbours, but
    /// for the least and the greatest of their values, and what is within a margin of them in each channel.
    pub fn teach_at(&mut self, class: ColourClass, image: &Image, (x, y): (usize, usize), margin: u8) {
        if let Some(patch) = patch_at(image, x, y) {
            self.widen(class, patch.widened(margin));
        }
    }

    /// Narrows the thresholds of a class on the side that is nearest to a pixel, until they do not hold it. A class of which
    /// nothing is left is not known any more.
    pub fn forget(&mut self, class: ColourClass, pixel: Yuv) {
        let Some(colour) = self.0.get(&class).filter(|colour| colour.holds(pixel)) else { return };
        match colour.without(pixel) {
            Some(rest) => self.0.insert(class, rest),
            None => self.0.remove(&class),
        };
    }

    fn widen(&mut self, class: ColourClass, colour: ColourBox) {
        let wider = self.0.get(&class).map_or(colour, |known| known.joined(colour));
        self.0.insert(class, wider);
    }
}

/// What is at a point of a picture: the box of its pixel and of the middle seven of each channel of a patch of nine.
fn patch_at(image: &Image, x: usize, y: usize) -> Option<ColourBox> {
    let clicked = image.at(x, y)?;
    let rows = y.saturating_sub(1)..=y + 1;
    let near: Vec<Yuv> =
        rows.flat_map(|y| (x.saturating_sub(1)..=x + 1).filter_map(move |x| image.at(x, y))).collect();
    let middle = |channel: fn(&Yuv) -> u8| {
        let mut values: Vec<u8> = near.iter().map(channel).collect();
        values.sort_unstable();
        let spare = usize::from(values.len() > 2);
        let (least, most) = (values[spare], values[values.len() - 1 - spare]);
        let own = channel(&clicked);
        (least.min(own), most.max(own))
    };
    Some(ColourBox { y: middle(|pixel| pixel.y), u: middle(|pixel| pixel.u), v: middle(|pixel| pixel.v) })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn pixel() -> impl Strategy<Value = Yuv> {
        any::<(u8, u8, u8)>().prop_map(|(y, u, v)| Yuv { y, u, v })
    }

    fn class() -> impl Strategy<Value = ColourClass> {
        prop::sample::select(ColourClass::ALL.to_vec())
    }

    /// A picture in one colour.
    fn plain(pixel: Yuv) -> Image {
        let mut image = Image::new(3, 3);
        image.pixels.fill(pixel);
        image
    }

    proptest! {
        #[test]
        fn a_taught_pixel_is_of_its_class_and_a_forgotten_one_is_not(
            clicks in prop::collection::vec((any::<bool>(), class(), pixel(), 0_u8..30), 0..20),
            class in class(),
            pixel in pixel(),
            margin in 0_u8..30,
        ) {
            let mut table = ColourTable::default();
            for (teaches, class, pixel, margin) in clicks {
                if teaches {
                    table.teach_at(class, &plain(pixel), (1, 1), margin);
                } else {
                    table.forget(class, pixel);
                }
            }
            let before = table.0.get(&class).copied();
            table.teach_at(class, &plain(pixel), (1, 1), margin);
            let taught = table.0[&class];
            prop_assert!(taught.holds(pixel));
            prop_assert!(before.is_none_or(|before| before.joined(taught) == taught), "it never narrows");
            table.forget(class, pixel);
            prop_assert!(!table.0.get(&class).is_some_and(|colour| colour.holds(pixel)));
        }
    }

    #[test]
    fn forgetting_narrows_the_nearest_side_only() {
        let colour = ColourBox { y: (50, 200), u: (80, 120), v: (140, 220) };
        let mut table = ColourTable([(ColourClass::Orange, colour)].into());
        table.forget(ColourClass::Orange, Yuv { y: 100, u: 117, v: 170 });
        assert_eq!(table.0[&ColourClass::Orange], ColourBox { u: (80, 116), ..colour });
    }

    #[test]
    fn a_class_of_which_nothing_is_left_is_not_known_any_more() {
        let only = Yuv { y: 10, u: 20, v: 30 };
        let mut table = ColourTable::default();
        table.teach_at(ColourClass::Red, &plain(only), (0, 0), 0);
        table.forget(ColourClass::Red, only);
        assert_eq!(table, ColourTable::default());
    }

    #[test]
    fn a_click_leaves_out_a_spark_beside_it() {
        let mut image = plain(Yuv { y: 100, u: 90, v: 180 });
        image.pixels[0] = Yuv { y: 255, u: 128, v: 128 };
        image.pixels[5].y = 104;
        image.pixels[6].y = 96;
        image.pixels[7].y = 97;
        let mut table = ColourTable::default();
        table.teach_at(ColourClass::Orange, &image, (1, 1), 4);
        let expected = ColourTable(
            [(ColourClass::Orange, ColourBox { y: (93, 108), u: (86, 94), v: (176, 184) })].into(),
        );
        assert_eq!(table, expected);
        table.teach_at(ColourClass::Orange, &image, (3, 0), 4);
        assert_eq!(table, expected, "beyond the picture's edge nothing is taught");
    }
}
