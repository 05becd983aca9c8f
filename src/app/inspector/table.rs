//! Tables whose columns stand still: words begin at the left, figures end at the right, each heading with a tooltip.

use bevy_egui::egui::{self, Align2, Rect, Response, RichText, Sense, TextStyle, Ui, WidgetText, pos2, vec2};

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    pub name: &'static str,
    pub tip: &'static str,
    /// In points; one of width 0 takes the room that the others leave.
    pub width: f32,
    pub kind: ColumnKind,
}

/// What is in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    Words,
    Figures,
    /// Figures that are quiet where they are nothing.
    Counts,
}

/// A column of words.
pub const fn words(name: &'static str, width: f32, tip: &'static str) -> Column {
    Column { name, tip, width, kind: ColumnKind::Words }
}

/// A column of figures.
pub const fn figures(name: &'static str, width: f32, tip: &'static str) -> Column {
    Column { name, tip, width, kind: ColumnKind::Figures }
}

/// A column of figures that are quiet where they are nothing.
pub const fn counts(name: &'static str, width: f32, tip: &'static str) -> Column {
    Column { name, tip, width, kind: ColumnKind::Counts }
}

/// Room between words and the column after them, in points.
const GAP: f32 = 8.0;

/// The width of the columns that have one.
pub fn width(columns: &[Column]) -> f32 {
    columns.iter().map(|column| column.width).sum()
}

/// Where the columns are in a row, from left to right.
fn places(columns: &[Column], row: Rect) -> impl Iterator<Item = Rect> {
    let left_over = (row.width() - width(columns)).max(0.0);
    columns.iter().scan(row.left(), move |left, column| {
        let from = *left;
        *left += if column.width == 0.0 { left_over } else { column.width };
        Some(Rect::from_min_max(pos2(from, row.top()), pos2(*left, row.bottom())))
    })
}

/// The headings, each with its tooltip.
pub fn heading(ui: &mut Ui, columns: &[Column]) {
    let (rect, _) = space(ui, columns);
    for (column, place) in columns.iter().zip(places(columns, rect)) {
        // Wider words reach over the column before, which has a short heading then.
        write(ui, column, place, f32::INFINITY, RichText::new(column.name).weak().into());
        if !column.tip.is_empty() {
            let id = ui.id().with(("heading", place.left() as i32));
            ui.interact(place, id, Sense::hover()).on_hover_text(column.tip);
        }
    }
}

/// A row with a cell for each column.
pub fn row(ui: &mut Ui, columns: &[Column], cells: impl IntoIterator<Item: Into<WidgetText>>) -> Response {
    let (rect, response) = space(ui, columns);
    if response.hovered() {
        ui.painter().rect_filled(rect.expand2(vec2(2.0, 0.0)), 2.0, ui.visuals().faint_bg_color);
    }
    paint(ui, rect, columns, cells);
    response
}

/// Paints a row where there is room for it already.
pub fn paint(ui: &Ui, row: Rect, columns: &[Column], cells: impl IntoIterator<Item: Into<WidgetText>>) {
    for ((column, place), cell) in columns.iter().zip(places(columns, row)).zip(cells) {
        let text: WidgetText = cell.into();
        let quiet = column.kind == ColumnKind::Counts && matches!(text.text(), "0" | "0.0");
        let gap = if column.kind == ColumnKind::Words && column.width > 0.0 { GAP } else { 2.0 };
        write(ui, column, place, place.width() - gap, if quiet { text.weak() } else { text });
    }
}

fn space(ui: &mut Ui, columns: &[Column]) -> (Rect, Response) {
    let whole = columns.iter().any(|column| column.width == 0.0);
    let width = if whole { ui.available_width() } else { width(columns) };
    let height = ui.text_style_height(&TextStyle::Body) + 2.0;
    ui.allocate_exact_size(vec2(width, height), Sense::hover())
}

/// Writes a text into its place; the whole of it where it had to be cut.
fn write(ui: &Ui, column: &Column, place: Rect, room: f32, text: WidgetText) -> Option<String> {
    let galley = text.into_galley(ui, Some(egui::TextWrapMode::Truncate), room, TextStyle::Body);
    let align = if column.kind == ColumnKind::Words { Align2::LEFT_CENTER } else { Align2::RIGHT_CENTER };
    let at = align.align_size_within_rect(galley.size(), place).min;
    let cut = galley.elided.then(|| galley.text().to_owned());
    ui.painter().galley(at, galley, ui.visuals().text_color());
    cut
}

/// A row of a name and one line of text beside it, which is cut off where the panel ends.
pub fn line(ui: &mut Ui, name: &str, text: impl Into<WidgetText>) -> Response {
    const LINE: [Column; 2] = [words("", 86.0, ""), words("", 0.0, "")];
    let (rect, response) = space(ui, &LINE);
    let mut places = places(&LINE, rect);
    let (Some(left), Some(right)) = (places.next(), places.next()) else { return response };
    write(ui, &LINE[0], left, left.width(), RichText::new(name).weak().into());
    match write(ui, &LINE[1], right, right.width(), text.into()) {
        Some(whole) => response.on_hover_text(whole),
        None => response,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_lie_beside_each_other_and_fill_the_row() {
        let lefts = |columns: &[Column], width: f32| {
            let row = Rect::from_min_size(pos2(10.0, 0.0), vec2(width, 16.0));
            let places: Vec<Rect> = places(columns, row).collect();
            assert_eq!(places.last().map(|place| place.right()), Some(row.right()));
            places.iter().map(|place| place.left()).collect::<Vec<_>>()
        };
        let fixed = [words("a", 100.0, ""), figures("b", 50.0, ""), counts("c", 25.0, "")];
        assert_eq!(lefts(&fixed, width(&fixed)), [10.0, 110.0, 160.0]);
        let one_takes_the_rest = [words("a", 0.0, ""), figures("b", 50.0, "")];
        assert_eq!(lefts(&one_takes_the_rest, 200.0), [10.0, 160.0]);
    }
}
