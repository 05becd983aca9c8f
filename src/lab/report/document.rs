//! A report before it is a page or Markdown.

/// A title and what stands under it. All texts are plain, as they are to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportDocument {
    /// What it is about.
    pub title: String,
    /// From top to bottom.
    pub blocks: Vec<ReportBlock>,
}

/// A piece of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum ReportBlock {
    /// That of a chapter.
    Chapter(String),
    /// That of a part of a chapter.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// One line each.
    Items(Vec<String>),
    /// Lines to be typed, or the text of a file.
    Code(String),
    /// Rows of figures.
    Table(ReportTable),
    /// Beside each other, as far as there is room.
    Plots(Vec<ReportPlot>),
}

/// Figures in rows and columns.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportTable {
    /// The names of the columns.
    pub head: Vec<String>,
    /// As many cells each as there are columns.
    pub rows: Vec<Vec<String>>,
    /// So many columns, the first ones, hold words; the others numbers.
    pub words: usize,
}

/// A drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportPlot {
    /// What it shows.
    pub caption: String,
    /// The element `svg`.
    pub svg: String,
}

/// Text of its own for each of some words.
pub(super) fn cells<const N: usize>(words: [&str; N]) -> Vec<String> {
    words.map(str::to_owned).into()
}
