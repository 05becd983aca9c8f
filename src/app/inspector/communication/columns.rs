//! Tables of figures in columns of fixed widths, each with a tooltip at its heading.

use bevy_egui::egui::{self, Align2, Rect, RichText, Sense, TextStyle, Ui, WidgetText, pos2, vec2};

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    pub name: &'static str,
    pub tip: &'static str,
    /// In points.
    pub width: f32,
    /// Words begin at the left; figures end at the right.
    pub words: bool,
}

/// A column of words.
pub const fn words(name: &'static str, width: f32, tip: &'static str) -> Column {
    Column { name, tip, width, words: true }
}

/// A column of figures.
pub const fn figures(name: &'static str, width: f32, tip: &'static str) -> Column {
    Column { name, tip, width, words: false }
}

/// Room between words and the column after them, in points.
const GAP: f32 = 8.0;

/// The width of a table.
pub fn width(columns: &[Column]) -> f32 {
    columns.iter().map(|column| column.width).sum()
}

/// Where the columns are in a row, from left to right.
fn places(columns: &[Column], row: Rect) -> impl Iterator<Item = Rect> {
    columns.iter().scan(row.left(), move |left, column| {
        let from = *left;
        *left += column.width;
        Some(Rect::from_min_max(pos2(from, row.top()), pos2(*left, row.bottom())))
    })
}

/// The headings, each with its tooltip.
pub fn heading(ui: &mut Ui, columns: &[Column]) {
    let (rect, _) = space(ui, columns);
    for (column, place) in columns.iter().zip(places(columns, rect)) {
        write(ui, column, place, RichText::new(column.name).weak().into());
        ui.interact(place, ui.id().with(("heading", place.left() as i32)), Sense::hover())
            .on_hover_text(column.tip);
    }
}

/// A row; figures that are nothing are quiet.
pub fn row(ui: &mut Ui, columns: &[Column], cells: &[String]) -> egui::Response {
    let (rect, response) = space(ui, columns);
    if response.hovered() {
        ui.painter().rect_filled(rect.expand2(vec2(2.0, 0.0)), 2.0, ui.visuals().faint_bg_color);
    }
    for ((column, place), cell) in columns.iter().zip(places(columns, rect)).zip(cells) {
        let text = RichText::new(cell);
        let quiet = !column.words && matches!(cell.as_str(), "0" | "0.0");
        write(ui, column, place, if quiet { text.weak() } else { text }.into());
    }
    response
}

fn space(ui: &mut Ui, columns: &[Column]) -> (Rect, egui::Response) {
    let height = ui.text_style_height(&TextStyle::Body) + 2.0;
    ui.allocate_exact_size(vec2(width(columns), height), Sense::hover())
}

fn write(ui: &Ui, column: &Column, place: Rect, text: WidgetText) {
    let room = column.width - if column.words { GAP } else { 2.0 };
    let galley = text.into_galley(ui, Some(egui::TextWrapMode::Truncate), room, TextStyle::Body);
    let align = if column.words { Align2::LEFT_CENTER } else { Align2::RIGHT_CENTER };
    let at = align.align_size_within_rect(galley.size(), place).min;
    ui.painter().galley(at, galley, ui.visuals().text_color());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_lie_beside_each_other_and_fill_the_row() {
        let columns = [words("a", 100.0, ""), figures("b", 50.0, ""), figures("c", 25.0, "")];
        let row = Rect::from_min_size(pos2(10.0, 0.0), vec2(width(&columns), 16.0));
        let places: Vec<Rect> = places(&columns, row).collect();
        assert_eq!(places.iter().map(|place| place.left()).collect::<Vec<_>>(), [10.0, 110.0, 160.0]);
        assert_eq!(places[2].right(), row.right());
    }
}
