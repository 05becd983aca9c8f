//! The page of the radio's panel with the ball bookings: a lane for each robot, and on it, in the colour of the booker, whom the
//! robot believed to have booked the ball. A full bar is the booker itself on its way to the ball.

use bevy_egui::egui::{self, Align2, Pos2, Rect, RichText, Stroke, pos2, vec2};

use super::booking_beliefs::{BookingBelief, story};
use super::data::{RadioData, RadioView};
use super::history::HistorySpan;
use super::lanes::{TEXT, show_lanes, show_spans};
use super::layout::Axes;
use crate::app::view::{colours, format};
use crate::game::record::{BookingFigures, Span};
use crate::ids::{RobotId, Team};
use crate::robot::Health;

/// Heights of a bar: of a robot that goes to the ball itself, and of one that leaves it to another, in points.
const BARS: (f32, f32) = (18.0, 9.0);
/// A bar that is wider than this bears the booker's number.
const NUMBERED: f32 = 13.0;

pub fn show(
    ui: &mut egui::Ui,
    team: Team,
    robots: &[(RobotId, Health)],
    heard: &RadioData,
    view: &mut RadioView,
) {
    if !heard.books(team) {
        ui.add_space(8.0);
        ui.weak(format!("The strategy of {team} books no balls."));
        return;
    }
    ui.horizontal_wrapped(|ui| {
        show_spans(ui, view);
        ui.separator();
        show_key(ui, robots);
        ui.separator();
        show_figures(ui, &heard.record.bookings[team.index()]);
    });
    let (axes, response) = show_lanes(ui, robots.len(), heard, view);
    let painter = ui.painter_at(axes.rect);
    for (lane, (robot, health)) in robots.iter().enumerate() {
        let at = pos2(response.rect.left() + 2.0, axes.y(lane));
        let colour = colours::egui(colours::team_text(robot.team));
        let colour = if health.crashed { colour.gamma_multiply(0.5) } else { colour };
        let font = egui::FontId::proportional(TEXT);
        ui.painter().text(at, Align2::LEFT_CENTER, format!("{robot} believes"), font, colour);
        let quiet = colours::egui(colours::QUIET).gamma_multiply(0.3);
        painter.hline(axes.rect.x_range(), axes.y(lane), (1.0, quiet));
    }
    let told = paint_beliefs(&painter, &axes, robots, heard, response.hover_pos());
    if let Some(told) = told {
        response.on_hover_text_at_pointer(told);
    }
}

/// The bars. What the one under the pointer tells.
fn paint_beliefs(
    painter: &egui::Painter,
    axes: &Axes,
    robots: &[(RobotId, Health)],
    heard: &RadioData,
    pointer: Option<Pos2>,
) -> Option<String> {
    let mut told = None;
    for span in heard.beliefs.spans() {
        let Some(lane) = robots.iter().position(|(robot, _)| *robot == span.robot) else { continue };
        let Some(bar) = bar_of(span, axes, lane) else { continue };
        let colour = colours::egui(colours::number(span.what.booker));
        painter.rect_filled(bar, 2.0, colour);
        let seen = bar.intersect(axes.rect);
        if seen.width() > NUMBERED && span.what.goes {
            let font = egui::FontId::proportional(TEXT);
            let ink = colours::egui(colours::ROBOT);
            painter.text(seen.center(), Align2::CENTER_CENTER, span.what.booker, font, ink);
        }
        if pointer.is_some_and(|pointer| seen.expand2(vec2(1.0, 3.0)).contains(pointer)) {
            painter.rect_stroke(
                bar,
                2.0,
                Stroke::new(1.5, colours::egui(colours::PILOT)),
                egui::StrokeKind::Outside,
            );
            told = Some(story(span, &heard.clock));
        }
    }
    told
}

/// Where the bar of a span is; none if it is not within the time that is shown.
fn bar_of(span: &HistorySpan<BookingBelief>, axes: &Axes, lane: usize) -> Option<Rect> {
    let until = span.until.map_or(axes.now, |until| until as f64);
    if until < axes.start() {
        return None;
    }
    let from = axes.x(span.from as f64);
    let height = if span.what.goes { BARS.0 } else { BARS.1 };
    let half = height.min(axes.lane_height() - 4.0) / 2.0;
    let y = axes.y(lane);
    Some(Rect::from_x_y_ranges(from..=axes.x(until).max(from + 1.0), y - half..=y + half))
}

/// The colour of each booker.
fn show_key(ui: &mut egui::Ui, robots: &[(RobotId, Health)]) {
    ui.weak("booker");
    for (robot, _) in robots {
        let (rect, response) = ui.allocate_exact_size(vec2(18.0, 16.0), egui::Sense::hover());
        ui.painter().rect_filled(rect, 2.0, colours::egui(colours::number(robot.number)));
        let font = egui::FontId::proportional(TEXT);
        let ink = colours::egui(colours::ROBOT);
        ui.painter().text(rect.center(), Align2::CENTER_CENTER, robot.number, font, ink);
        response.on_hover_text(format!(
            "{robot} has booked the ball. Broad: it goes there; narrow: who leaves it to it"
        ));
    }
}

/// How well the booking has done so far.
fn show_figures(ui: &mut egui::Ui, booked: &BookingFigures) {
    let stretch = |ui: &mut egui::Ui, name: &str, stretch: Span, tip: &str| {
        ui.weak(name);
        let told = format::seconds(stretch.total as f32);
        let longest = format::seconds(stretch.longest as f32);
        ui.label(RichText::new(told)).on_hover_text(format!("{tip}. At most {longest} at a stretch"));
    };
    stretch(
        ui,
        "nobody goes",
        booked.nobody_goes,
        "Some robot knew where the ball was, and none went for it",
    );
    stretch(ui, "several go", booked.several_go, "More than one robot went for the ball");
    stretch(
        ui,
        "a farther one",
        booked.farther_goes,
        "A robot was nearer than the one that went, by more than the threshold",
    );
    ui.weak("takeovers");
    let tip = format!(
        "How often another robot began to go for the ball; {} times back to the one before within three seconds",
        booked.alternations
    );
    ui.label(booked.takeovers.to_string()).on_hover_text(tip);
}

#[cfg(test)]
mod tests {
    use super::super::samples::home;
    use super::*;

    fn span(booker: u8, goes: bool, until: Option<u64>) -> HistorySpan<BookingBelief> {
        HistorySpan { robot: home(2), what: BookingBelief { booker, goes }, from: 60, until }
    }

    #[test]
    fn a_bar_lies_on_its_lane_between_its_times_and_one_that_is_over_is_not_shown() {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 80.0));
        let axes = Axes { rect, now: 110.0, span: 100.0, lanes: 2 };
        let bar = bar_of(&span(1, true, Some(90)), &axes, 1).unwrap();
        assert_eq!((bar.x_range(), bar.center().y), (egui::Rangef::new(50.0, 80.0), 60.0));
        assert_eq!(bar_of(&span(1, false, None), &axes, 0).unwrap().right(), 100.0);
        assert_eq!(bar_of(&span(1, false, Some(90)), &Axes { now: 200.0, ..axes }, 0), None);
    }
}
