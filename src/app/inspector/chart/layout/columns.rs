//! Which columns there are and what stands in each: boxes by their distance from the start, labels between them, and places where
//! long lines pass.

use std::collections::VecDeque;

use bevy_egui::egui::{Vec2, vec2};

use super::sketch::{ChartSketch, SketchedLine};

/// Something that takes a place in a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Item {
    pub kind: ItemKind,
    /// Boxes stand in even columns.
    pub column: usize,
    pub band: usize,
    pub size: Vec2,
}

/// What takes a place, by its index in the sketch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ItemKind {
    Box(usize),
    Label(usize),
    /// A line passes.
    Pass(usize),
}

/// The columns of a chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// Boxes first, in the order of the sketch.
    pub items: Vec<Item>,
    /// The items of each column, from top to bottom.
    pub columns: Vec<Vec<usize>>,
    /// The items of each line, from its beginning to its end, each in a column beside the last; nothing for a loop.
    pub chains: Vec<Vec<usize>>,
    /// The lines at each box: those that begin or end at its left side, at its right side, and loops.
    pub ends: Vec<BoxEnds>,
}

/// How many ends of lines are at a box, and the room that its loops take above it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoxEnds {
    pub left: usize,
    pub right: usize,
    pub loops: Vec2,
}

/// Height of a line where it passes, and between the ends of lines at a box, in points.
const PASS: f32 = 5.0;
pub const END: f32 = 7.0;
/// Above a box with a loop, below the loop's label, in points.
pub const LOOP: f32 = 10.0;

impl Columns {
    pub fn of(sketch: &ChartSketch) -> Columns {
        let ranks = ranks(sketch);
        let last = ranks.iter().copied().max().unwrap_or(0);
        let mut columns = Columns { columns: vec![Vec::new(); 2 * last + 2], ..Columns::default() };
        columns.ends = vec![BoxEnds::default(); sketch.boxes.len()];
        for (index, (sketched, rank)) in sketch.boxes.iter().zip(&ranks).enumerate() {
            columns.add(ItemKind::Box(index), 2 * rank, sketched.band, sketched.size);
        }
        for (index, line) in sketch.lines.iter().enumerate() {
            let chain = columns.chain(sketch, index, line, [ranks[line.from], ranks[line.to]]);
            columns.chains.push(chain);
        }
        columns.enlarge_boxes();
        columns
    }

    fn add(&mut self, kind: ItemKind, column: usize, band: usize, size: Vec2) -> usize {
        self.items.push(Item { kind, column, band, size });
        self.columns[column].push(self.items.len() - 1);
        self.items.len() - 1
    }

    /// The items that a line runs through.
    fn chain(
        &mut self,
        sketch: &ChartSketch,
        index: usize,
        line: &SketchedLine,
        ranks: [usize; 2],
    ) -> Vec<usize> {
        let size = line.label.unwrap_or(vec2(0.0, PASS));
        if line.from == line.to {
            let loops = &mut self.ends[line.from].loops;
            *loops = vec2(loops.x.max(size.x), loops.y + size.y + LOOP);
            return Vec::new();
        }
        let band = common_band(sketch, sketch.boxes[line.from].band, sketch.boxes[line.to].band);
        let [from, to] = ranks.map(|rank| 2 * rank);
        let between: Vec<usize> = match from.cmp(&to) {
            std::cmp::Ordering::Less => (from + 1..to).collect(),
            std::cmp::Ordering::Greater => (to + 1..from).rev().collect(),
            std::cmp::Ordering::Equal => vec![self.emptier_side(from)],
        };
        let leaves_left = between.first().is_some_and(|column| *column < from);
        let arrives_right = between.last().is_some_and(|column| *column > to);
        self.count_end(line.from, leaves_left);
        self.count_end(line.to, !arrives_right);
        let mut chain = vec![line.from];
        for (place, column) in between.into_iter().enumerate() {
            let (kind, size) = match place {
                0 => (ItemKind::Label(index), size),
                _ => (ItemKind::Pass(index), vec2(0.0, PASS)),
            };
            chain.push(self.add(kind, column, band, size));
        }
        chain.push(line.to);
        chain
    }

    /// The column of labels beside one of boxes that holds less.
    fn emptier_side(&self, column: usize) -> usize {
        let height = |column: &usize| -> f32 {
            self.columns[*column].iter().map(|item| self.items[*item].size.y).sum()
        };
        let left = column.checked_sub(1);
        left.into_iter()
            .chain([column + 1])
            .min_by(|a, b| height(a).total_cmp(&height(b)))
            .unwrap_or(column + 1)
    }

    fn count_end(&mut self, at: usize, left: bool) {
        let ends = &mut self.ends[at];
        *(if left { &mut ends.left } else { &mut ends.right }) += 1;
    }

    /// A box has room for all ends of lines, and for its loops above it.
    fn enlarge_boxes(&mut self) {
        for (item, ends) in self.items.iter_mut().zip(&self.ends) {
            let room = END * (ends.left.max(ends.right) + 1) as f32;
            item.size = vec2(item.size.x.max(ends.loops.x), item.size.y.max(room) + ends.loops.y);
        }
    }

    /// Items in columns beside each other that a line joins, with that at the left first.
    pub fn links(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let pairs = self.chains.iter().flat_map(|chain| chain.windows(2));
        pairs.map(|pair| {
            let is_forward = self.items[pair[0]].column < self.items[pair[1]].column;
            if is_forward { [pair[0], pair[1]] } else { [pair[1], pair[0]] }
        })
    }

    /// What lies beside each item along its lines: at its left and at its right.
    pub fn neighbours(&self) -> Vec<[Vec<usize>; 2]> {
        let mut neighbours = vec![[Vec::new(), Vec::new()]; self.items.len()];
        for [left, right] in self.links() {
            neighbours[left][1].push(right);
            neighbours[right][0].push(left);
        }
        neighbours
    }
}

/// How many lines each box is from the first one; of those that no line leads to, from the first of them.
fn ranks(sketch: &ChartSketch) -> Vec<usize> {
    let mut ranks = vec![None; sketch.boxes.len()];
    for start in [sketch.start].into_iter().chain(0..sketch.boxes.len()) {
        if ranks.get(start) != Some(&None) {
            continue;
        }
        ranks[start] = Some(0);
        let mut open = VecDeque::from([(start, 0)]);
        while let Some((at, rank)) = open.pop_front() {
            for line in sketch.lines.iter().filter(|line| line.from == at) {
                if ranks[line.to].is_none() {
                    ranks[line.to] = Some(rank + 1);
                    open.push_back((line.to, rank + 1));
                }
            }
        }
    }
    ranks.into_iter().map(Option::unwrap_or_default).collect()
}

/// The innermost band around both.
fn common_band(sketch: &ChartSketch, mut a: usize, mut b: usize) -> usize {
    // A frame lies in a band of a lower number.
    while a != b {
        let inner = if a > b { &mut a } else { &mut b };
        *inner = sketch.frames[*inner - 1];
    }
    a
}
