//! How people teach a camera its colours: they click on pixels, look at what becomes of the picture, and take a step back.

use super::colours::{ColourBox, ColourClass, ColourTable};
use super::image::{Image, Yuv};

/// Steps that can be taken back.
const MOST_STEPS: usize = 256;

/// A colour table that is taught, with its history.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Teaching {
    table: ColourTable,
    done: Vec<ColourTable>,
    undone: Vec<ColourTable>,
}

impl Teaching {
    /// Begins with a table and without history.
    pub fn new(table: ColourTable) -> Teaching {
        Teaching { table, ..Teaching::default() }
    }

    /// The table as it is taught so far.
    pub fn table(&self) -> &ColourTable {
        &self.table
    }

    /// Widens the thresholds of a class until they hold a pixel and what is within a margin of it in each channel.
    pub fn teach(&mut self, class: ColourClass, pixel: Yuv, margin: u8) {
        self.widen(class, ColourBox::around(pixel, margin));
    }

    /// Teaches what is at a point of a picture: the pixel and its neighbours, but for the least and the greatest of their values.
    pub fn teach_at(&mut self, class: ColourClass, image: &Image, (x, y): (usize, usize), margin: u8) {
        if let Some(patch) = patch_at(image, x, y) {
            self.widen(class, patch.widened(margin));
        }
    }

    /// Narrows the thresholds of a class on the side that is nearest to a pixel, until they do not hold it. A class of which
    /// nothing is left is not known any more.
    pub fn forget(&mut self, class: ColourClass, pixel: Yuv) {
        let Some(colour) = self.table.0.get(&class).filter(|colour| colour.holds(pixel)) else { return };
        match colour.without(pixel) {
            Some(rest) => self.set(class, rest),
            None => self.clear(class),
        }
    }

    /// Makes a class one that is never seen.
    pub fn clear(&mut self, class: ColourClass) {
        self.change(|table| {
            table.0.remove(&class);
        });
    }

    /// Sets the thresholds of a class. Those that are the wrong way round are turned.
    pub fn set(&mut self, class: ColourClass, colour: ColourBox) {
        let turned = |(a, b): (u8, u8)| (a.min(b), a.max(b));
        let colour = ColourBox { y: turned(colour.y), u: turned(colour.u), v: turned(colour.v) };
        self.change(|table| {
            table.0.insert(class, colour);
        });
    }

    /// Takes the last step back; whether there was one.
    pub fn undo(&mut self) -> bool {
        let Some(before) = self.done.pop() else { return false };
        self.undone.push(std::mem::replace(&mut self.table, before));
        true
    }

    /// Takes a step again that was taken back; whether there was one.
    pub fn redo(&mut self) -> bool {
        let Some(after) = self.undone.pop() else { return false };
        self.done.push(std::mem::replace(&mut self.table, after));
        true
    }

    /// How many steps can be taken back, and how many taken again.
    pub fn steps(&self) -> (usize, usize) {
        (self.done.len(), self.undone.len())
    }

    fn widen(&mut self, class: ColourClass, colour: ColourBox) {
        let wider = self.table.0.get(&class).map_or(colour, |known| known.joined(colour));
        self.set(class, wider);
    }

    /// A change is a step only if it changes something.
    fn change(&mut self, change: impl FnOnce(&mut ColourTable)) {
        let before = self.table.clone();
        change(&mut self.table);
        if before != self.table {
            self.done.push(before);
            self.undone.clear();
            if self.done.len() > MOST_STEPS {
                self.done.remove(0);
            }
        }
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

    /// One step of a person.
    #[derive(Clone, Debug)]
    enum Click {
        Teach(ColourClass, Yuv, u8),
        Forget(ColourClass, Yuv),
        Clear(ColourClass),
    }

    fn click() -> impl Strategy<Value = Click> {
        prop_oneof![
            (class(), pixel(), 0_u8..30)
                .prop_map(|(class, pixel, margin)| Click::Teach(class, pixel, margin)),
            (class(), pixel()).prop_map(|(class, pixel)| Click::Forget(class, pixel)),
            class().prop_map(Click::Clear),
        ]
    }

    fn act(teaching: &mut Teaching, click: &Click) {
        match *click {
            Click::Teach(class, pixel, margin) => teaching.teach(class, pixel, margin),
            Click::Forget(class, pixel) => teaching.forget(class, pixel),
            Click::Clear(class) => teaching.clear(class),
        }
    }

    proptest! {
        #[test]
        fn a_taught_pixel_is_of_its_class_and_a_forgotten_one_is_not(
            clicks in prop::collection::vec(click(), 0..20),
            class in class(),
            pixel in pixel(),
            margin in 0_u8..30,
        ) {
            let mut teaching = Teaching::default();
            clicks.iter().for_each(|click| act(&mut teaching, click));
            let before = teaching.table().0.get(&class).copied();
            teaching.teach(class, pixel, margin);
            let taught = teaching.table().0[&class];
            prop_assert!(taught.holds(pixel));
            prop_assert!(before.is_none_or(|before| before.joined(taught) == taught), "it never narrows");
            teaching.forget(class, pixel);
            prop_assert!(!teaching.table().0.get(&class).is_some_and(|colour| colour.holds(pixel)));
        }

        #[test]
        fn steps_taken_back_and_again_lead_to_the_same_tables(clicks in prop::collection::vec(click(), 1..40)) {
            let mut teaching = Teaching::default();
            let mut tables = vec![teaching.table().clone()];
            for click in &clicks {
                act(&mut teaching, click);
                if tables.last() != Some(teaching.table()) {
                    tables.push(teaching.table().clone());
                }
            }
            prop_assert_eq!(teaching.steps(), (tables.len() - 1, 0));
            for table in tables.iter().rev().skip(1) {
                prop_assert!(teaching.undo());
                prop_assert_eq!(teaching.table(), table);
            }
            prop_assert!(!teaching.undo());
            for table in &tables[1..] {
                prop_assert!(teaching.redo());
                prop_assert_eq!(teaching.table(), table);
            }
            prop_assert!(!teaching.redo());
        }
    }

    #[test]
    fn forgetting_narrows_the_nearest_side_only() {
        let mut teaching = Teaching::default();
        let colour = ColourBox { y: (50, 200), u: (80, 120), v: (140, 220) };
        teaching.set(ColourClass::Orange, colour);
        teaching.forget(ColourClass::Orange, Yuv { y: 100, u: 117, v: 170 });
        assert_eq!(teaching.table().0[&ColourClass::Orange], ColourBox { u: (80, 116), ..colour });
    }

    #[test]
    fn a_click_leaves_out_a_spark_beside_it() {
        let mut image = Image::new(3, 3);
        image.pixels.fill(Yuv { y: 100, u: 90, v: 180 });
        image.pixels[0] = Yuv { y: 255, u: 128, v: 128 };
        image.pixels[5].y = 104;
        image.pixels[6].y = 96;
        image.pixels[7].y = 97;
        let mut teaching = Teaching::default();
        teaching.teach_at(ColourClass::Orange, &image, (1, 1), 4);
        let expected = ColourBox { y: (93, 108), u: (86, 94), v: (176, 184) };
        assert_eq!(teaching.table().0[&ColourClass::Orange], expected);
        teaching.teach_at(ColourClass::Orange, &image, (3, 0), 4);
        assert_eq!(teaching.steps(), (1, 0), "beyond the picture's edge nothing is taught");
    }

    #[test]
    fn a_new_step_forgets_those_that_were_taken_back() {
        let mut teaching = Teaching::default();
        teaching.teach(ColourClass::Red, Yuv { y: 10, u: 20, v: 30 }, 0);
        teaching.undo();
        teaching.teach(ColourClass::Pink, Yuv { y: 10, u: 20, v: 30 }, 0);
        assert!(!teaching.redo());
    }
}
