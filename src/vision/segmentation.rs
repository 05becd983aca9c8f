//! Cuts a picture into blobs of one colour each: thresholds, runs along the rows, runs joined to blobs, and near blobs joined where
//! the whole is still dense (after the idea of CMVision). A [`Segmenter`] is made once and used for picture after picture.

use std::cmp::Reverse;
use std::ops::Range;

use bevy::math::Vec2;

use super::blob::{ColourBlob, PixelBox};
use super::colours::ColourClass;
use super::image::Image;
use super::lookup::ColourLookup;

/// The most blobs of a picture; the smallest are left out.
pub const MOST_BLOBS: usize = 1024;

/// Pixels of the smallest blob: a single one is noise.
const LEAST_AREA: usize = 2;

/// How dense two blobs of a class are together at least, if they are joined.
const LEAST_DENSITY: f32 = 0.6;

/// Pixels between two blobs that are joined, at most.
const WIDEST_GAP: usize = 2;

/// Blobs of a class that are looked at whether they belong together: the largest.
const JOINED_OF_A_CLASS: usize = 24;

/// A picture, cut by colour.
#[derive(Clone, Copy, Debug)]
pub struct Segmented<'a> {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
    /// Of each pixel, in the order of the picture.
    pub classes: &'a [Option<ColourClass>],
    /// The largest first.
    pub blobs: &'a [ColourBlob],
}

impl Segmented<'_> {
    /// The class of a pixel; none beyond the edges.
    pub fn class_at(&self, x: usize, y: usize) -> Option<ColourClass> {
        if x < self.width { self.classes.get(y * self.width + x).copied().flatten() } else { None }
    }

    /// The blobs of a class, the largest first.
    pub fn of_class(&self, class: ColourClass) -> impl Iterator<Item = &ColourBlob> {
        self.blobs.iter().filter(move |blob| blob.class == class)
    }
}

/// The memory in which pictures are cut.
#[derive(Clone, Debug, Default)]
pub struct Segmenter {
    width: usize,
    height: usize,
    classes: Vec<Option<ColourClass>>,
    runs: Vec<Run>,
    sums: Vec<Sum>,
    blobs: Vec<ColourBlob>,
}

/// Neighbouring pixels of a class in a row.
#[derive(Clone, Copy, Debug)]
struct Run {
    class: ColourClass,
    row: u16,
    start: u16,
    /// The first pixel after it.
    end: u16,
    /// A run of the same blob that comes no later; itself, if it is the blob's first.
    parent: u32,
    /// Of a blob's first run: the place of its sum.
    sum: u32,
}

/// What is added up of a blob.
#[derive(Clone, Copy, Debug)]
struct Sum {
    class: ColourClass,
    area: u32,
    /// Twice the sum of the middles of its pixels.
    across: u64,
    down: u64,
    left: u16,
    top: u16,
    right: u16,
    bottom: u16,
}

impl Segmenter {
    /// Cuts a picture, whatever its size.
    pub fn segment(&mut self, image: &Image, lookup: &ColourLookup) -> Segmented<'_> {
        (self.width, self.height) = (image.width, image.height);
        self.classes.clear();
        self.classes.extend(image.pixels.iter().map(|pixel| lookup.class_of(*pixel)));
        self.find_runs();
        self.find_blobs();
        self.segmented()
    }

    /// The picture that was cut last.
    pub fn segmented(&self) -> Segmented<'_> {
        Segmented { width: self.width, height: self.height, classes: &self.classes, blobs: &self.blobs }
    }

    /// Runs of all rows, each row's joined to those of the row above.
    fn find_runs(&mut self) {
        self.runs.clear();
        let mut above = 0..0;
        for (row, classes) in self.classes.chunks_exact(self.width.max(1)).enumerate() {
            let first = self.runs.len();
            push_runs(&mut self.runs, row as u16, classes);
            let here = first..self.runs.len();
            join_rows(&mut self.runs, above, here.clone());
            above = here;
        }
    }

    fn find_blobs(&mut self) {
        self.sums.clear();
        for index in 0..self.runs.len() {
            let root = root_of(&mut self.runs, index as u32) as usize;
            if root == index {
                self.runs[index].sum = self.sums.len() as u32;
                self.sums.push(Sum::nothing(self.runs[index]));
            }
            let run = self.runs[index];
            self.sums[self.runs[root].sum as usize].add(run);
        }
        self.blobs.clear();
        let large = self.sums.iter().filter(|sum| sum.area as usize >= LEAST_AREA);
        self.blobs.extend(large.map(Sum::blob));
        sort(&mut self.blobs);
        self.blobs.truncate(MOST_BLOBS);
        if ColourClass::ALL.into_iter().filter(|class| join_near(&mut self.blobs, *class)).count() > 0 {
            sort(&mut self.blobs);
        }
    }
}

fn push_runs(runs: &mut Vec<Run>, row: u16, classes: &[Option<ColourClass>]) {
    let mut start = 0;
    while let Some(class) = classes.get(start) {
        let length = classes[start..].iter().take_while(|other| *other == class).count();
        if let Some(class) = *class {
            let parent = runs.len() as u32;
            let end = (start + length) as u16;
            runs.push(Run { class, row, start: start as u16, end, parent, sum: 0 });
        }
        start += length;
    }
}

/// Joins runs of a class that meet, also at a corner.
fn join_rows(runs: &mut [Run], above: Range<usize>, here: Range<usize>) {
    let (mut upper, mut lower) = (above.start, here.start);
    while upper < above.end && lower < here.end {
        join_if_they_meet(runs, upper, lower);
        let (upper_end, lower_end) = (runs[upper].end, runs[lower].end);
        if upper_end == lower_end {
            // The next run of either row may meet this one of the other at a corner.
            if upper + 1 < above.end {
                join_if_they_meet(runs, upper + 1, lower);
            }
            if lower + 1 < here.end {
                join_if_they_meet(runs, upper, lower + 1);
            }
        }
        upper += usize::from(upper_end <= lower_end);
        lower += usize::from(lower_end <= upper_end);
    }
}

fn join_if_they_meet(runs: &mut [Run], upper: usize, lower: usize) {
    let (a, b) = (runs[upper], runs[lower]);
    if a.class == b.class && a.start <= b.end && b.start <= a.end {
        unite(runs, upper as u32, lower as u32);
    }
}

fn unite(runs: &mut [Run], a: u32, b: u32) {
    let (a, b) = (root_of(runs, a), root_of(runs, b));
    runs[a.max(b) as usize].parent = a.min(b);
}

/// The first run of a run's blob; shortens the way to it.
fn root_of(runs: &mut [Run], mut index: u32) -> u32 {
    loop {
        let parent = runs[index as usize].parent;
        if parent == index {
            return index;
        }
        let grandparent = runs[parent as usize].parent;
        runs[index as usize].parent = grandparent;
        index = grandparent;
    }
}

impl Sum {
    fn nothing(first: Run) -> Sum {
        Sum {
            class: first.class,
            area: 0,
            across: 0,
            down: 0,
            left: first.start,
            top: first.row,
            right: first.start,
            bottom: first.row,
        }
    }

    fn add(&mut self, run: Run) {
        let length = run.end - run.start;
        self.area += u32::from(length);
        self.across += u64::from(length) * (u64::from(run.start) + u64::from(run.end));
        self.down += u64::from(length) * (2 * u64::from(run.row) + 1);
        self.left = self.left.min(run.start);
        self.right = self.right.max(run.end - 1);
        self.bottom = self.bottom.max(run.row);
    }

    fn blob(&self) -> ColourBlob {
        let doubled = 2.0 * self.area as f32;
        ColourBlob {
            class: self.class,
            area: self.area as usize,
            bounds: PixelBox {
                left: usize::from(self.left),
                top: usize::from(self.top),
                right: usize::from(self.right),
                bottom: usize::from(self.bottom),
            },
            centroid: Vec2::new(self.across as f32 / doubled, self.down as f32 / doubled),
        }
    }
}

/// The largest first; of equal ones the one that is higher, then farther left.
fn sort(blobs: &mut [ColourBlob]) {
    blobs.sort_unstable_by_key(|blob| (Reverse(blob.area), blob.bounds.top, blob.bounds.left, blob.class));
}

/// Joins near blobs of a class as long as they are dense together; whether any were.
fn join_near(blobs: &mut Vec<ColourBlob>, class: ColourClass) -> bool {
    let mut members = [0; JOINED_OF_A_CLASS];
    let mut count = 0;
    let of_class = blobs.iter().enumerate().filter(|(_, blob)| blob.class == class);
    for ((index, _), member) in of_class.zip(&mut members) {
        *member = index;
        count += 1;
    }
    let (before, members) = (blobs.len(), &members[..count]);
    for (place, larger) in members.iter().enumerate() {
        let others = &members[place + 1..];
        let mate = |blobs: &[ColourBlob]| {
            others.iter().copied().find(|other| belong_together(&blobs[*larger], &blobs[*other]))
        };
        while let Some(smaller) = mate(blobs) {
            blobs[*larger] = blobs[*larger].joined(&blobs[smaller]);
            // Empty, and left out below.
            blobs[smaller].area = 0;
        }
    }
    blobs.retain(|blob| blob.area > 0);
    blobs.len() < before
}

fn belong_together(a: &ColourBlob, b: &ColourBlob) -> bool {
    let (across, down) = a.bounds.gap(b.bounds);
    a.area > 0 && b.area > 0 && across.max(down) <= WIDEST_GAP && a.joined(b).density() >= LEAST_DENSITY
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::vision::sketch::{nominal_table, picture};

    fn blobs(rows: &[&str]) -> Vec<ColourBlob> {
        let mut segmenter = Segmenter::default();
        segmenter.segment(&picture(rows), &ColourLookup::new(&nominal_table())).blobs.to_vec()
    }

    fn areas(rows: &[&str]) -> Vec<(ColourClass, usize)> {
        blobs(rows).iter().map(|blob| (blob.class, blob.area)).collect()
    }

    #[test]
    fn a_patch_is_one_blob_with_its_area_box_and_middle() {
        let found = blobs(&["......", "..OO..", ".OOOO.", "..OO.."]);
        let bounds = PixelBox { left: 1, top: 1, right: 4, bottom: 3 };
        let expected =
            ColourBlob { class: ColourClass::Orange, area: 8, bounds, centroid: Vec2::new(3.0, 2.5) };
        assert_eq!(found, [expected]);
    }

    #[test]
    fn arms_that_meet_further_down_are_one_blob() {
        assert_eq!(
            areas(&["Y...Y...Y", "Y...Y...Y", "YYYYY...Y", "........Y", "....YYYYY"]),
            [(ColourClass::Yellow, 9), (ColourClass::Yellow, 9)]
        );
        assert_eq!(areas(&["Y...Y", "Y...Y", ".YYY."]), [(ColourClass::Yellow, 7)], "corners meet");
    }

    #[test]
    fn the_largest_comes_first_and_single_pixels_are_noise() {
        assert_eq!(
            areas(&["PP...R..", "PP.....B", "......BB", "....W..."]),
            [(ColourClass::Pink, 4), (ColourClass::DarkBlue, 3)]
        );
    }

    #[test]
    fn near_patches_are_joined_only_if_the_whole_is_dense() {
        let halves = areas(&["OOO.OOO", "OOO.OOO", "OOO.OOO"]);
        assert_eq!(halves, [(ColourClass::Orange, 18)]);
        let corners = areas(&["OOOO....", "OOOO....", "........", "....OOOO", "....OOOO"]);
        assert_eq!(corners, [(ColourClass::Orange, 8); 2], "a chain of patches is no ball");
        let apart = areas(&["OOO...OOO", "OOO...OOO", "OOO...OOO"]);
        assert_eq!(apart.len(), 2);
    }

    #[test]
    fn a_segmenter_takes_pictures_of_any_size_one_after_the_other() {
        let (lookup, mut segmenter) = (ColourLookup::new(&nominal_table()), Segmenter::default());
        assert_eq!(segmenter.segment(&picture(&["RRR", "RRR"]), &lookup).blobs.len(), 1);
        let small = segmenter.segment(&picture(&["B", "B"]), &lookup);
        assert_eq!((small.blobs[0].class, small.class_at(1, 0)), (ColourClass::DarkBlue, None));
        assert!(segmenter.segment(&Image::default(), &lookup).blobs.is_empty());
    }

    /// Areas of connected patches, found by flooding.
    fn flooded(classes: &[Option<ColourClass>], width: usize) -> Vec<(ColourClass, u32)> {
        let (mut seen, mut found) = (vec![false; classes.len()], Vec::new());
        for start in 0..classes.len() {
            let Some(class) = classes[start] else { continue };
            let (mut open, mut area) = (vec![start], 0);
            while let Some(at) = open.pop() {
                if classes[at] != Some(class) || std::mem::replace(&mut seen[at], true) {
                    continue;
                }
                area += 1;
                let (x, y) = (at % width, at / width);
                for (x, y) in (x.saturating_sub(1)..=(x + 1).min(width - 1))
                    .flat_map(|x| (y.saturating_sub(1)..=y + 1).map(move |y| (x, y)))
                {
                    if y * width < classes.len() {
                        open.push(y * width + x);
                    }
                }
            }
            if area > 0 {
                found.push((class, area));
            }
        }
        found
    }

    proptest! {
        #[test]
        fn runs_make_the_same_patches_as_flooding(
            width in 1_usize..12,
            pixels in prop::collection::vec(prop::sample::select(vec!['.', 'O', 'O', 'G']), 1..120),
        ) {
            let rows: Vec<String> = pixels.chunks_exact(width).map(|row| row.iter().collect()).collect();
            let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
            let mut segmenter = Segmenter::default();
            segmenter.segment(&picture(&rows), &ColourLookup::new(&nominal_table()));
            let mut sums: Vec<_> = segmenter.sums.iter().map(|sum| (sum.class, sum.area)).collect();
            let mut expected = flooded(&segmenter.classes, width);
            sums.sort_unstable();
            expected.sort_unstable();
            prop_assert_eq!(sums, expected);
        }
    }
}
