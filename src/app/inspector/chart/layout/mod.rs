//! Where the boxes, conditions and lines of a state machine's chart lie: a layered drawing after Sugiyama, Tagawa and Toda (*Methods
//! for visual understanding of hierarchical system structures*, 1981), from left to right. Pure.
//!
//! States stand in columns by how many transitions they are from the start, conditions in columns between those. Every line that
//! passes a column has a place of its own in it, so that no line crosses a box. States within a state lie in a band across all
//! columns, so that nothing else is in its frame.

mod columns;
mod order;
mod routes;
mod rows;
mod sketch;
#[cfg(test)]
pub mod tests;

use columns::Columns;

pub use sketch::{ChartLayout, ChartSketch, SketchedBox, SketchedLine, along, controls};

impl ChartSketch {
    /// Lays the sketch out.
    pub fn lay_out(&self) -> ChartLayout {
        let mut columns = Columns::of(self);
        order::order(&mut columns);
        let heights = rows::rows(&columns, &self.frames);
        routes::draw(self, &columns, &heights)
    }
}
