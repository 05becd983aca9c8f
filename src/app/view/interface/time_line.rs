//! The match on a line: how far it has come, its halves, and its goals and calls where they fell.

use bevy::prelude::*;
use bevy_egui::egui;
use egui::{Align2, pos2};

use crate::app::view::colours::{self, egui as paint};
use crate::app::view::format;
use crate::app::view::state::TimelineEvent;
use crate::app::view::style::{SMALL, font};
use crate::world::referee::{Decision, RuleBook};

const HEIGHT: f32 = 22.0;
/// There is nothing to see on a narrower line, in points.
const NARROWEST: f32 = 120.0;
/// The pointer means an event that is no farther away than this, in points.
const NEAR: f32 = 6.0;

/// Where a moment lies on the line, 0 at its beginning and 1 at its end.
fn share(played: f64, book: &RuleBook) -> f32 {
    (played / (f64::from(RuleBook::HALVES) * book.half_seconds())).clamp(0.0, 1.0) as f32
}

/// Shows the line, with a tooltip for the event under the pointer.
pub fn show_time_line(ui: &mut egui::Ui, events: &[TimelineEvent], now: f64, book: &RuleBook) {
    let (rect, response) =
        ui.allocate_exact_size(egui::vec2(ui.available_width(), HEIGHT), egui::Sense::hover());
    if rect.width() < NARROWEST {
        return;
    }
    let painter = ui.painter();
    let line = rect.shrink2(egui::vec2(44.0, 0.0));
    let x = |played: f64| line.left() + share(played, book) * line.width();
    let y = line.center().y;
    painter.hline(line.x_range(), y, (3.0, paint(colours::RAISED)));
    painter.hline(line.left()..=x(now), y, (3.0, paint(colours::ACCENT)));
    let whole = book.half_seconds() * f64::from(RuleBook::HALVES);
    for half in 0..=RuleBook::HALVES {
        let at = x(book.half_seconds() * f64::from(half));
        painter.vline(at, y - 5.0..=y + 5.0, (1.0, paint(colours::QUIET)));
    }
    let quiet = paint(colours::QUIET);
    let left = pos2(rect.left(), y);
    painter.text(left, Align2::LEFT_CENTER, format::clock(now.floor()), font(SMALL), quiet);
    painter.text(pos2(rect.right(), y), Align2::RIGHT_CENTER, format::clock(whole), font(SMALL), quiet);
    for event in events {
        mark(painter, pos2(x(event.played), y), &event.decision);
    }
    painter.circle_filled(pos2(x(now), y), 4.0, paint(colours::TEXT));
    let Some(pointer) = response.hover_pos() else { return };
    let near = |event: &&TimelineEvent| (x(event.played) - pointer.x).abs() < NEAR;
    let told: Vec<String> = (events.iter().filter(near))
        .map(|event| format!("{}  {}", format::clock(event.played.floor()), event.decision))
        .collect();
    if told.is_empty() {
        response.on_hover_text(
            "The match so far: goals in the colour of their team, other calls as small strokes",
        );
    } else {
        response.on_hover_text(told.join("\n"));
    }
}

fn mark(painter: &egui::Painter, at: egui::Pos2, decision: &Decision) {
    match decision {
        Decision::Goal { by, .. } => {
            painter.circle(at, 6.0, paint(colours::team(*by)), (1.5, paint(colours::PILOT)));
        }
        Decision::HalfEnded { .. } | Decision::MatchFinished { .. } => {}
        Decision::RobotRemoved { .. } => {
            painter.vline(at.x, at.y - 6.0..=at.y + 6.0, (2.0, paint(colours::PENALTY)));
        }
        _ => {
            painter.vline(at.x, at.y - 5.0..=at.y + 5.0, (1.5, paint(colours::TEXT)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_time_is_in_the_middle_of_the_line() {
        let book = RuleBook::default();
        assert_eq!(share(book.half_seconds(), &book), 0.5);
        assert_eq!(share(0.0, &book), 0.0);
        assert_eq!(share(1e9, &book), 1.0);
    }
}
