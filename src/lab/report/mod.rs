//! Experiments, and the tunings before them, as something to read: what was played, what came out, which claims held, as a page for a browser and as Markdown.
//!
//! Rows become a [`ReportDocument`] of text, tables and plots; that becomes HTML, with the plots as SVG in it, or Markdown, which has
//! the tables alone. All of it is pure.

mod chapter;
mod document;
mod evaluated;
mod figure_part;
mod html;
mod level_comparison;
mod markdown;
mod metric_title;
mod overview;
mod plot;
mod seeds_needed;

pub use chapter::chapter_head;
pub use document::{ReportBlock, ReportDocument, ReportPlot, ReportTable};
use evaluated::Evaluated;
pub use evaluated::ReportedExperiment;

impl ReportDocument {
    /// Reports experiments, in their order, after chapters of something else; `command` is what writes the report again.
    pub fn of(
        experiments: &[ReportedExperiment],
        chapters: Vec<ReportBlock>,
        command: &str,
    ) -> ReportDocument {
        let evaluated: Vec<Evaluated> = experiments.iter().map(Evaluated::of).collect();
        let mut blocks = overview::blocks(&evaluated, command);
        blocks.extend(chapters);
        blocks.extend(evaluated.iter().flat_map(chapter::blocks));
        ReportDocument { title: "Results of experiments".into(), blocks }
    }
}
