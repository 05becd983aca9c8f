//! Rows of figures that stand still: a name on the left, figures in columns of a fixed width on the right.

use std::sync::Arc;

use bevy_egui::egui::{
    self, Align2, Color32, Galley, Pos2, Rect, Response, Sense, TextStyle, Ui, WidgetText,
};

/// Width of a column of figures, in points: room for `−10.55`.
pub const COLUMN: f32 = 47.0;

/// A row: the name, cut off where the figures begin, and the figures from left to right, aligned to the right.
pub fn row(ui: &mut Ui, name: impl Into<WidgetText>, figures: &[&str]) -> Response {
    let (rect, response) = space(ui);
    paint_row(ui, rect, name, figures, COLUMN);
    response
}

/// Paints a row where there is room for it already, with columns of this width.
pub fn paint_row(ui: &Ui, rect: Rect, name: impl Into<WidgetText>, figures: &[impl AsRef<str>], column: f32) {
    paint_name(ui, rect, name.into(), rect.width() - column * figures.len() as f32);
    let colour = ui.visuals().text_color();
    for (place, figure) in figures.iter().rev().enumerate() {
        paint_figure(ui, rect.right() - column * place as f32, rect, figure.as_ref(), colour);
    }
}

/// The heading of a table: a word over each column.
pub fn heading(ui: &mut Ui, words: &[&str]) {
    let (rect, _) = space(ui);
    let colour = ui.visuals().weak_text_color();
    for (place, word) in words.iter().rev().enumerate() {
        paint_figure(ui, rect.right() - COLUMN * place as f32, rect, word, colour);
    }
}

/// A row of a name and one line of text beside it, which is cut off where the panel ends.
pub fn line(ui: &mut Ui, name: &str, text: impl Into<WidgetText>) -> Response {
    const NAME: f32 = 86.0;
    let (rect, response) = space(ui);
    let weak = egui::RichText::new(name).color(ui.visuals().weak_text_color());
    paint_name(ui, rect, weak.into(), NAME);
    let rest = Rect::from_min_max(Pos2::new(rect.left() + NAME, rect.top()), rect.max);
    match paint_name(ui, rest, text.into(), rest.width()) {
        Some(whole) => response.on_hover_text(whole),
        None => response,
    }
}

fn space(ui: &mut Ui) -> (Rect, Response) {
    let height = ui.text_style_height(&TextStyle::Body) + 2.0;
    ui.allocate_exact_size(egui::vec2(ui.available_width(), height), Sense::hover())
}

/// Paints text from the left; returns the whole of it where it had to be cut.
fn paint_name(ui: &Ui, rect: Rect, text: WidgetText, room: f32) -> Option<String> {
    let galley: Arc<Galley> = text.into_galley(ui, Some(egui::TextWrapMode::Truncate), room, TextStyle::Body);
    let at = Align2::LEFT_CENTER.align_size_within_rect(galley.size(), rect).min;
    let cut = galley.elided.then(|| galley.text().to_owned());
    ui.painter().galley(at, galley, ui.visuals().text_color());
    cut
}

fn paint_figure(ui: &Ui, right: f32, rect: Rect, text: &str, colour: Color32) {
    let font = TextStyle::Body.resolve(ui.style());
    ui.painter().text(Pos2::new(right, rect.center().y), Align2::RIGHT_CENTER, text, font, colour);
}
