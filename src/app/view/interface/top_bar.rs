//! The bar across the top: who plays, the score, the clock, and what the referee has just decided.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use egui::{Align2, Color32, FontId, pos2, vec2};

use crate::app::view::colours::{self, egui as paint};
use crate::app::view::format;
use crate::app::view::state::{
    Announcement, FileError, FreeArea, PanelSystems, Playback, Screen, Session, StopReason,
};
use crate::app::view::style::{font, panel_frame};
use crate::geometry::Attacking;
use crate::ids::Team;
use crate::strategy::Strategies;
use crate::world::gamecontroller::BoxNews;
use crate::world::referee::{MatchState, Phase};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        (show_top_bar, show_file_error).chain().in_set(PanelSystems::Top).run_if(in_state(Screen::Match)),
    );
}

const HEIGHT: f32 = 66.0;
/// In a lower window the bar at the bottom needs the room, in points.
const LEAST_WINDOW: f32 = 240.0;
/// Share of the window that a long trouble may cover.
const TROUBLE: f32 = 0.25;
/// From the middle to where the teams' names begin.
const SCORE_HALF: f32 = 52.0;

/// The state of play in words; a match may wait for its referee box.
fn phase_text(state: &MatchState, paused: bool, waits: bool) -> &'static str {
    match state.phase {
        Phase::Finished => "Full time",
        _ if paused => "Paused",
        _ if waits => "Waiting for a referee box",
        _ if state.restraints.stopped => "Stopped: robots stand still",
        Phase::Initial => "Before the kick-off",
        Phase::Ready => "Ready: robots take their places",
        Phase::Set => "Set: robots stand still",
        Phase::Playing => "In play",
    }
}

fn show_top_bar(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    (state, strategies): (Res<MatchState>, Res<Strategies>),
    (announcement, playback, session): (Res<Announcement>, Res<Playback>, Res<Session>),
    (stop, referee_box): (Res<StopReason>, Option<Res<BoxNews>>),
) -> Result {
    if area.0.height() < LEAST_WINDOW {
        return Ok(());
    }
    let panel = egui::Panel::top("top bar")
        .exact_size(HEIGHT)
        .resizable(false)
        .frame(panel_frame(colours::PANEL, egui::Margin::ZERO));
    area.dock(contexts.ctx_mut()?, "top bar", panel, |ui| {
        let rect = ui.available_rect_before_wrap();
        let (middle, first, second) = (rect.center().x, rect.top() + 22.0, rect.top() + 50.0);
        let painter = ui.painter();
        let write = |at: egui::Pos2, align, text: &str, font: FontId, colour: Color| {
            painter.text(at, align, text, font, paint(colour))
        };
        let [home, away] = state.score;
        write(pos2(middle, first), Align2::CENTER_CENTER, ":", font(26.0), colours::TEXT);
        let beside = vec2(9.0, 0.0);
        let score = pos2(middle, first);
        write(score - beside, Align2::RIGHT_CENTER, &home.to_string(), font(30.0), colours::PILOT);
        write(score + beside, Align2::LEFT_CENTER, &away.to_string(), font(30.0), colours::PILOT);
        for team in Team::BOTH.into_iter().filter(|team| session.has(*team)) {
            let side = if team == Team::Home { -1.0 } else { 1.0 };
            let at = pos2(middle + side * SCORE_HALF, first);
            let room = rect.width() / 2.0 - SCORE_HALF - 16.0;
            show_team(ui, at, room, team, &strategies.of(team).name, state.attacking(team));
        }
        let half = if state.half == 1 { "first half" } else { "second half" };
        let clock = format!("{} left, {half}", format::clock(state.time_left));
        let room = rect.width() / 2.0 - 14.0 - 8.0;
        let clock = one_line(ui, &clock, 16.0, room);
        let at = Align2::RIGHT_CENTER.anchor_size(pos2(middle - 14.0, second), clock.size()).min;
        painter.galley(at, clock, paint(colours::TEXT));
        let stopped = stop.0.as_ref().map(|reason| format!("Stopped: {reason}"));
        let (text, colour) = match (&stopped, announcement.text()) {
            (Some(stopped), _) => (stopped.as_str(), colours::BREAKPOINT),
            (None, Some(announcement)) => (announcement, colours::CALL),
            (None, None) => {
                let waits = referee_box.as_ref().is_some_and(|news| news.view.is_none());
                (phase_text(&state, playback.paused, waits), colours::QUIET)
            }
        };
        let text = one_line(ui, text, 16.0, room);
        let at = Align2::LEFT_CENTER.anchor_size(pos2(middle + 14.0, second), text.size()).min;
        painter.galley(at, text, paint(colour));
        let stroke = (1.0, paint(colours::RAISED));
        painter.vline(middle, egui::Rangef::new(second - 9.0, second + 9.0), stroke);
        ui.allocate_rect(rect, egui::Sense::hover());
    });
    Ok(())
}

/// A team from the middle outwards: which way it plays, a plate in its colour, and its name.
fn show_team(ui: &egui::Ui, at: egui::Pos2, room: f32, team: Team, name: &str, ends: Attacking) {
    let (side, align) =
        if team == Team::Home { (-1.0, Align2::RIGHT_CENTER) } else { (1.0, Align2::LEFT_CENTER) };
    let painter = ui.painter();
    let plate = egui::Rect::from_center_size(at + vec2(side * 8.0, 0.0), vec2(16.0, 16.0));
    painter.rect_filled(plate, 3.0, paint(colours::team(team)));
    let way = if ends == Attacking::East { 1.0 } else { -1.0 };
    arrow(painter, plate.center(), way, paint(colours::ROBOT));
    let side_name = if team == Team::Home { "Home" } else { "Away" };
    let label = one_line(ui, &format!("{side_name}: {name}"), 18.0, room - 28.0);
    let text_at = align.anchor_size(at + vec2(side * 26.0, 0.0), label.size()).min;
    painter.galley(text_at, label, paint(colours::team_text(team)));
}

/// A text on one line, cut where the room ends.
fn one_line(ui: &egui::Ui, text: &str, size: f32, room: f32) -> std::sync::Arc<egui::Galley> {
    let format = egui::TextFormat { font_id: font(size), color: Color32::PLACEHOLDER, ..default() };
    let mut job = egui::text::LayoutJob::single_section(text.to_owned(), format);
    job.wrap = egui::text::TextWrapping::truncate_at_width(room.max(20.0));
    ui.painter().layout_job(job)
}

fn arrow(painter: &egui::Painter, at: egui::Pos2, way: f32, colour: Color32) {
    let tip = at + vec2(4.5 * way, 0.0);
    let back = at - vec2(3.5 * way, 0.0);
    let points = vec![tip, back + vec2(0.0, 5.0), back - vec2(0.0, 5.0)];
    painter.add(egui::Shape::convex_polygon(points, colour, egui::Stroke::NONE));
}

fn show_file_error(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    mut file_error: ResMut<FileError>,
) -> Result {
    let Some(text) = file_error.0.clone() else { return Ok(()) };
    let panel = egui::Panel::top("trouble")
        .resizable(false)
        .frame(panel_frame(colours::TROUBLE, egui::Margin::symmetric(12, 6)));
    let room = (TROUBLE * area.0.height()).max(24.0);
    let closed = area.dock(contexts.ctx_mut()?, "trouble", panel, |ui| {
        let lines = egui::ScrollArea::vertical().min_scrolled_height(room).max_height(room);
        let shown = lines.show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let close = ui
                    .button("Close")
                    .on_hover_text("Take this line away. The match plays on with what it had");
                ui.add(egui::Label::new(egui::RichText::new(text).color(Color32::WHITE)).wrap());
                close.clicked()
            })
            .inner
        });
        shown.inner
    });
    if closed {
        file_error.0 = None;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::referee::RuleBook;

    #[test]
    fn a_finished_match_is_not_paused_and_one_that_is_stopped_or_waits_says_so() {
        let state = |phase| {
            let mut state = MatchState::new(Team::Home, &RuleBook::default());
            state.phase = phase;
            state
        };
        assert_eq!(phase_text(&state(Phase::Finished), true, true), "Full time");
        assert_eq!(phase_text(&state(Phase::Playing), true, true), "Paused");
        assert_eq!(phase_text(&state(Phase::Initial), false, true), "Waiting for a referee box");
        assert_eq!(phase_text(&state(Phase::Initial), false, false), "Before the kick-off");
        let mut stopped = state(Phase::Playing);
        stopped.restraints.stopped = true;
        assert_eq!(phase_text(&stopped, false, false), "Stopped: robots stand still");
    }
}
