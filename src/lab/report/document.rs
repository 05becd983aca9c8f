//! A report before it is a page or Markdown.

use std::fmt::{self, Display, Formatter};

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

/// In columns, as on a terminal.
impl Display for ReportTable {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let lines = || [&self.head].into_iter().chain(&self.rows);
        let width =
            |column: usize| lines().map(|cells| cells[column].chars().count()).max().unwrap_or_default();
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        for cells in lines() {
            let cells = cells.iter().zip(&widths).enumerate().map(|(column, (cell, width))| {
                if column < self.words { format!("{cell:width$}") } else { format!("{cell:>width$}") }
            });
            writeln!(f, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        Ok(())
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_to_the_left_and_numbers_to_the_right() {
        let rows = vec![cells(["a", "10"]), cells(["longer", "9"])];
        let table = ReportTable { head: cells(["team", "goals"]), rows, words: 1 };
        assert_eq!(table.to_string(), "team    goals\na          10\nlonger      9\n");
    }
}
