//! The match on a line: how far it has come, its halves, and what happened where it happened. A click or a drag goes there; a
//! second line below shows another branch.

use bevy::prelude::*;
use bevy_egui::egui;
use egui::{Align2, Pos2, Rect, pos2};

use super::time_scale::TimeScale;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::format;
use crate::app::view::style::{SMALL, font};
use crate::lab::rewind::{BranchId, MatchEvent, MatchEventKind, Rewind};
use crate::world::referee::Decision;

const HEIGHT: f32 = 26.0;
/// Of the line of another branch, in points.
const BESIDE: f32 = 16.0;
/// There is nothing to see on a narrower line, in points.
const NARROWEST: f32 = 120.0;
/// Room for the clocks beside the line, in points.
const CLOCK: f32 = 44.0;
/// The pointer means an event that is no farther away than this, in points.
const NEAR: f32 = 5.0;
/// At most so many events are told at once.
const TOLD: usize = 8;

/// Shows the present branch of a match and perhaps another one; the tick to go to, if a person wants to.
pub fn show_time_line(
    ui: &mut egui::Ui,
    rewind: &Rewind,
    beside: Option<BranchId>,
    now: u64,
    scale: &TimeScale,
) -> Option<u64> {
    let height = HEIGHT + beside.map_or(0.0, |_| BESIDE);
    let size = egui::vec2(ui.available_width(), height);
    if size.x < NARROWEST {
        return None;
    }
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click_and_drag());
    let line = Rect::from_min_size(
        rect.min + egui::vec2(CLOCK, 0.0),
        egui::vec2(rect.width() - 2.0 * CLOCK, HEIGHT),
    );
    let painter = ui.painter();
    paint_line(painter, line, rewind, now, scale);
    let quiet = paint(colours::QUIET);
    let middle = line.center().y;
    let played = rewind.ghost(rewind.present(), now).map_or(0.0, |ghost| f64::from(ghost.played));
    let clocks = [
        (rect.left(), Align2::LEFT_CENTER, scale.clock(now, played).floor()),
        (rect.right(), Align2::RIGHT_CENTER, scale.whole),
    ];
    for (x, align, seconds) in clocks {
        painter.text(pos2(x, middle), align, format::clock(seconds), font(SMALL), quiet);
    }
    if let Some(branch) = beside {
        let below = Rect::from_min_max(pos2(line.left(), line.bottom()), pos2(line.right(), rect.bottom()));
        paint_beside(painter, below, rewind, branch, now, scale);
        let score = rewind.ghost(branch, now).map_or_else(String::new, |ghost| {
            let [home, away] = ghost.score;
            format!("{home} : {away}")
        });
        let at = pos2(rect.left(), below.center().y);
        painter.text(at, Align2::LEFT_CENTER, score, font(SMALL), quiet);
    }
    let pointer = response.interact_pointer_pos().or(response.hover_pos())?;
    let branch = if pointer.y > line.bottom() { beside } else { None }.unwrap_or(rewind.present());
    let near: Vec<&MatchEvent> = (rewind.events(branch))
        .filter(|event| (scale.x(line, event.tick) - pointer.x).abs() < NEAR)
        .collect();
    let nearest = near.iter().min_by(|a, b| {
        let distance = |event: &MatchEvent| (scale.x(line, event.tick) - pointer.x).abs();
        distance(a).total_cmp(&distance(b))
    });
    let at = scale.tick(line, pointer.x).clamp(rewind.start(), rewind.end());
    let wanted = if response.clicked() {
        Some(nearest.map_or(at, |event| event.tick))
    } else {
        response.dragged().then_some(at)
    };
    response.on_hover_text_at_pointer(told(&near, rewind, line, scale, pointer));
    wanted.filter(|wanted| *wanted != now)
}

fn paint_line(painter: &egui::Painter, line: Rect, rewind: &Rewind, now: u64, scale: &TimeScale) {
    let y = line.center().y;
    let x = |tick: u64| scale.x(line, tick);
    painter.hline(line.x_range(), y, (3.0, paint(colours::RAISED)));
    painter.hline(line.left()..=x(rewind.end()), y, (3.0, paint(colours::ACCENT).gamma_multiply(0.5)));
    painter.hline(line.left()..=x(now), y, (3.0, paint(colours::ACCENT)));
    for half in scale.halves {
        painter.vline(x(half), y - 6.0..=y + 6.0, (1.0, paint(colours::QUIET)));
    }
    for event in rewind.events(rewind.present()) {
        mark(painter, pos2(x(event.tick), y), &event.what);
    }
    for (tick, _) in rewind.bookmarks(rewind.present()) {
        flag(painter, pos2(x(tick), y));
    }
    painter.circle(pos2(x(now), y), 4.5, paint(colours::TEXT), (1.5, paint(colours::PANEL)));
}

/// From where it leaves the present branch.
fn paint_beside(
    painter: &egui::Painter,
    line: Rect,
    rewind: &Rewind,
    branch: BranchId,
    now: u64,
    scale: &TimeScale,
) {
    let y = line.center().y;
    let x = |tick: u64| scale.x(line, tick);
    let parts = rewind.parting(branch);
    let colour = paint(colours::QUIET);
    painter.line_segment([pos2(x(parts) - 6.0, line.top() - 6.0), pos2(x(parts), y)], (1.5, colour));
    painter.hline(x(parts)..=x(rewind.branch(branch).end.max(parts)), y, (2.0, colour));
    for event in rewind.events(branch).filter(|event| event.tick >= parts) {
        mark(painter, pos2(x(event.tick), y), &event.what);
    }
    painter.circle_stroke(pos2(x(now), y), 3.5, (1.5, paint(colours::TEXT)));
}

/// What the line says where the pointer is.
fn told(near: &[&MatchEvent], rewind: &Rewind, line: Rect, scale: &TimeScale, pointer: Pos2) -> String {
    let notes = rewind.bookmarks(rewind.present());
    let notes = notes.filter(|(tick, _)| (scale.x(line, *tick) - pointer.x).abs() < NEAR);
    let notes = notes.map(|(_, note)| format!("“{note}”"));
    let time = |event: &MatchEvent| format::clock(scale.clock(event.tick, event.played).floor());
    let events = near.iter().map(|event| format!("{}  {}", time(event), event.what));
    let mut told: Vec<String> = notes.chain(events).collect();
    if told.len() > TOLD {
        let more = told.len() - TOLD;
        told.truncate(TOLD);
        told.push(format!("and {more} more"));
    }
    if told.is_empty() {
        told.push("Click or drag to go to another moment of the match".into());
    }
    told.join("\n")
}

fn mark(painter: &egui::Painter, at: Pos2, what: &MatchEventKind) {
    let stroke = |half: f32, width: f32, colour: Color| {
        painter.vline(at.x, at.y - half..=at.y + half, (width, paint(colour)));
    };
    let below = at + egui::vec2(0.0, 8.0);
    let team = |colour: fn(crate::ids::Team) -> Color| what.team().map_or(colours::TEXT, colour);
    match what {
        MatchEventKind::Call(Decision::Goal { by, .. }) => {
            painter.circle(at, 6.0, paint(colours::team(*by)), (1.5, paint(colours::PILOT)));
        }
        MatchEventKind::Call(Decision::HalfEnded { .. } | Decision::MatchFinished { .. }) => {}
        MatchEventKind::Call(Decision::RobotRemoved { .. }) => stroke(6.0, 2.0, colours::PENALTY),
        MatchEventKind::Call(_) => stroke(5.0, 1.5, colours::TEXT),
        MatchEventKind::RoleTaken { .. } => {
            painter.circle_filled(below, 2.0, paint(team(colours::team_text)));
        }
        MatchEventKind::RolledBack { .. } => {
            painter.circle_stroke(below, 2.5, (1.5, paint(team(colours::team_text))));
        }
        MatchEventKind::Booked { .. } => {
            let end = below + egui::vec2(0.0, 2.5);
            painter.line_segment([below - egui::vec2(0.0, 2.5), end], (1.0, paint(team(colours::team_text))));
        }
        MatchEventKind::LockLost { .. } => {
            painter.circle_stroke(below, 2.5, (1.5, paint(colours::LOCK)));
        }
        MatchEventKind::Broken { .. } => {
            let (left, right) = (egui::vec2(-3.0, 5.0), egui::vec2(3.0, 5.0));
            let corners = vec![below - egui::vec2(0.0, 1.0), below + left, below + right];
            painter.add(egui::Shape::closed_line(corners, (1.5, paint(colours::PENALTY))));
        }
        MatchEventKind::Crashed { .. } => {
            for side in [-1.0, 1.0] {
                let arm = egui::vec2(3.0, 3.0 * side);
                painter.line_segment([below - arm, below + arm], (1.5, paint(colours::PENALTY)));
            }
        }
    }
}

/// A bookmark.
fn flag(painter: &egui::Painter, at: Pos2) {
    let top = at - egui::vec2(0.0, 12.0);
    painter.vline(at.x, top.y..=at.y, (1.5, paint(colours::CALL)));
    let cloth = vec![top, top + egui::vec2(7.0, 3.0), top + egui::vec2(0.0, 6.0)];
    painter.add(egui::Shape::convex_polygon(cloth, paint(colours::CALL), egui::Stroke::NONE));
}
