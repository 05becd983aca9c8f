//! What is laid out, and what comes of it.

use bevy_egui::egui::{Pos2, Rect, Vec2};

/// What is laid out. Sizes are in points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartSketch {
    /// The boxes.
    pub boxes: Vec<SketchedBox>,
    /// The box at the far left, by its index.
    pub start: usize,
    /// The lines between them.
    pub lines: Vec<SketchedLine>,
    /// For each frame the band in which it lies itself: 0 outside of all frames, else one more than the index of a frame before it.
    pub frames: Vec<usize>,
}

/// A box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SketchedBox {
    /// Its least size.
    pub size: Vec2,
    /// Its band: 0 outside of all frames, else one more than the index of the innermost frame around it.
    pub band: usize,
}

/// A line from one box to another, or to itself, with a label on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SketchedLine {
    /// The box at its beginning.
    pub from: usize,
    /// The box at its end.
    pub to: usize,
    /// The size of the label; none without one.
    pub label: Option<Vec2>,
}

/// Where everything is, from (0, 0) on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartLayout {
    /// In the order of the sketch; none smaller than it was sketched.
    pub boxes: Vec<Rect>,
    /// In the order of the sketch.
    pub lines: Vec<Route>,
    /// In the order of the sketch.
    pub frames: Vec<Rect>,
    /// The size of the whole.
    pub size: Vec2,
}

/// The way of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Its pieces from the beginning to the end; there is none under its label.
    pub pieces: Vec<[Pos2; 2]>,
    /// The label, or its place, if it has none.
    pub label: Rect,
}

/// Between two boxes or labels of a column, in points.
pub(super) const GAP: f32 = 7.0;
/// Between a frame and what is in it, in points.
pub(super) const FRAME: f32 = 9.0;
/// Around the whole, in points.
pub(super) const MARGIN: f32 = 14.0;

/// The places of a piece of a line, from 0 at its beginning to 1 at its end: it leaves and arrives level.
pub fn along([from, to]: [Pos2; 2], share: f32) -> Pos2 {
    let back = 1.0 - share;
    let ease = share * share * (3.0 - 2.0 * share);
    // A cubic Bézier curve whose inner control points are halfway across.
    let x = from.x * back.powi(3) + 3.0 * (from.x + to.x) / 2.0 * back * share + to.x * share.powi(3);
    Pos2::new(x, from.y + (to.y - from.y) * ease)
}

/// The inner control points of a piece's curve.
pub fn controls([from, to]: [Pos2; 2]) -> [Pos2; 2] {
    let middle = (from.x + to.x) / 2.0;
    [Pos2::new(middle, from.y), Pos2::new(middle, to.y)]
}
