//! The page of the radio's panel with the message sequence chart: a lane for each robot, an arrow for each message, an amber
//! bar where a robot is locked.

use bevy_egui::egui::{self, Color32, Pos2, Rect, RichText, Stroke, pos2, vec2};

use super::data::{RadioData, RadioView};
use super::filter::is_of_a_swap;
use super::history::HistorySpan;
use super::lanes::{NAMES, TEXT, show_lanes, show_spans};
use super::layout::{Arrow, Axes, End, Labels};
use super::locks::{attempt_story, lock_story};
use super::{message_row, words};
use crate::app::view::colours;
use crate::comms::messages::TeamMessage;
use crate::comms::radio::Transmission;
use crate::comms::tcm::Data;
use crate::game::requests::Requests;
use crate::ids::RobotId;
use crate::robot::Health;

/// A message may have been sent so long before the time that is shown and arrive within it, s.
const LONGEST_WAY: f32 = 4.0;
/// The pointer means an arrow that is no farther away than this, in points.
const NEAR: f32 = 5.0;
/// More arrows than this are drawn without tips and labels; than the first, with labels of role swaps only.
const CROWDED: usize = 150;
const MANY: usize = 700;

/// Shows the page; the tick to go to, if a person wants to.
pub fn show(
    ui: &mut egui::Ui,
    robots: &[(RobotId, Health)],
    heard: &RadioData,
    view: &mut RadioView,
    requests: &mut Requests,
) -> Option<u64> {
    show_filters(ui, view);
    let wanted = message_row::show(ui, heard, view, requests);
    let lanes: Vec<RobotId> = robots.iter().map(|(robot, _)| *robot).collect();
    let (axes, response) = show_lanes(ui, lanes.len(), heard, view);
    show_names(ui, response.rect, &axes, robots, view);
    let painter = ui.painter_at(axes.rect);
    for (lane, robot) in lanes.iter().enumerate() {
        let shown = view.filter.shows(*robot);
        let colour = colours::egui(colours::QUIET).gamma_multiply(if shown { 0.6 } else { 0.2 });
        painter.hline(axes.rect.x_range(), axes.y(lane), (1.0, colour));
    }
    let told_of_lock = paint_locks(&painter, &axes, &lanes, heard, response.hover_pos());
    let pointed = paint_messages(&painter, &axes, &lanes, heard, view, response.hover_pos());
    if response.clicked() {
        view.message = pointed.map(|message| message.id);
    }
    let told = pointed.map(|message| words::story(message, &heard.clock));
    if let Some(told) = told.or(told_of_lock) {
        response.on_hover_text_at_pointer(told);
    }
    wanted
}

/// The time that is shown, and the kinds of messages.
fn show_filters(ui: &mut egui::Ui, view: &mut RadioView) {
    ui.horizontal_wrapped(|ui| {
        show_spans(ui, view);
        ui.separator();
        for known in TeamMessage::TYPES {
            let mut shown = view.filter.shows_kind(known.number);
            let tip = "Whether these messages are shown, here and on the pitch";
            if ui.checkbox(&mut shown, known.name).on_hover_text(tip).changed() {
                view.filter.show_kind(known.number, shown);
            }
        }
        ui.separator();
        show_key(ui);
    });
}

/// How lost and late messages and locks look.
fn show_key(ui: &mut egui::Ui) {
    let mut sample = |words: &str, paint: &dyn Fn(&egui::Painter, Rect)| {
        let (rect, _) = ui.allocate_exact_size(vec2(20.0, 14.0), egui::Sense::hover());
        paint(ui.painter(), rect);
        ui.weak(words);
    };
    let late = Stroke::new(1.5, colours::egui(colours::TEXT));
    sample("lost", &|painter, rect| cross(painter, rect.center(), colours::egui(colours::PENALTY)));
    sample("late", &|painter, rect| {
        let ends = [rect.left_center(), rect.right_center()];
        painter.extend(egui::Shape::dashed_line(&ends, late, 4.0, 3.0));
    });
    sample("locked", &|painter, rect| {
        painter.rect_filled(rect.shrink2(vec2(0.0, 3.5)), 2.0, colours::egui(colours::LOCK));
    });
}

fn show_names(
    ui: &mut egui::Ui,
    rect: Rect,
    axes: &Axes,
    robots: &[(RobotId, Health)],
    view: &mut RadioView,
) {
    for (lane, (robot, health)) in robots.iter().enumerate() {
        let place = Rect::from_center_size(pos2(rect.left() + NAMES / 2.0, axes.y(lane)), vec2(NAMES, 20.0));
        let mut shown = view.filter.shows(*robot);
        let mut name = RichText::new(robot.to_string()).color(colours::egui(colours::team_text(robot.team)));
        if health.crashed {
            name = name.strikethrough();
        }
        let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(place).id_salt(robot.to_string()));
        let tip = "Whether messages from and to this robot are shown, here and on the pitch";
        if inner.checkbox(&mut shown, name).on_hover_text(tip).changed() {
            view.filter.show(*robot, shown);
        }
    }
}

/// Bars on the lanes: full where a robot is locked, an outline where it attempts a swap. What the one under the pointer
/// tells.
fn paint_locks(
    painter: &egui::Painter,
    axes: &Axes,
    lanes: &[RobotId],
    heard: &RadioData,
    pointer: Option<Pos2>,
) -> Option<String> {
    let amber = colours::egui(colours::LOCK);
    let mut told = None;
    for span in heard.locks.spans() {
        let Some(bar) = lock_bar(span, axes, lanes) else { continue };
        painter.rect_filled(bar, 1.5, amber);
        if is_meant(bar, pointer) {
            told = Some(lock_story(span, &heard.clock));
        }
    }
    for span in heard.attempts.spans() {
        let Some(bar) = lock_bar(span, axes, lanes) else { continue };
        painter.rect_stroke(bar, 1.5, (1.5, amber), egui::StrokeKind::Inside);
        if is_meant(bar, pointer) {
            told = Some(attempt_story(span, &heard.clock));
        }
    }
    told
}

/// Where the bar of a span is; none if it is not within the time that is shown.
fn lock_bar<T>(span: &HistorySpan<T>, axes: &Axes, lanes: &[RobotId]) -> Option<Rect> {
    let y = axes.y(lanes.iter().position(|robot| *robot == span.robot)?);
    let from = axes.x(span.from as f64);
    let until = axes.x(span.until.map_or(axes.now, |until| until as f64)).max(from + 2.0);
    (until >= axes.rect.left()).then(|| Rect::from_x_y_ranges(from..=until, y - 3.5..=y + 3.5))
}

fn is_meant(bar: Rect, pointer: Option<Pos2>) -> bool {
    pointer.is_some_and(|pointer| bar.expand(2.0).contains(pointer))
}

/// The message under the pointer.
fn paint_messages<'a>(
    painter: &egui::Painter,
    axes: &Axes,
    lanes: &[RobotId],
    heard: &'a RadioData,
    view: &RadioView,
    pointer: Option<Pos2>,
) -> Option<&'a Transmission> {
    let first = axes.start() - f64::from(LONGEST_WAY / heard.clock.dt);
    let recent = heard.radio.transmissions().rev().take_while(|message| message.sent as f64 >= first);
    let shown = recent.filter(|message| view.filter.passes(message));
    let arrows: Vec<(&Transmission, Arrow)> =
        shown.filter_map(|message| Some((message, axes.arrow(message, lanes)?))).collect();
    let pointed = pointer.and_then(|pointer| {
        let distances = arrows.iter().map(|(message, arrow)| (arrow.distance(pointer), *message, arrow));
        distances.filter(|(distance, ..)| *distance < NEAR).min_by(|a, b| a.0.total_cmp(&b.0))
    });
    let many = arrows.len() > MANY;
    for (message, arrow) in &arrows {
        paint_arrow(painter, message, arrow, many);
    }
    let labels = if many { Vec::new() } else { paint_labels(painter, axes, &arrows) };
    let clicked = arrows.iter().find(|(message, _)| Some(message.id) == view.message);
    let of_label = || {
        let (_, place) = labels.iter().find(|(label, _)| pointer.is_some_and(|at| label.contains(at)))?;
        arrows.get(*place).map(|(message, arrow)| (*message, arrow))
    };
    let pointed = pointed.map(|(_, message, arrow)| (message, arrow)).or_else(of_label);
    for (_, arrow) in clicked.map(|(message, arrow)| (*message, arrow)).into_iter().chain(pointed) {
        painter.line_segment([arrow.from, arrow.to], (3.0, colours::egui(colours::PILOT)));
    }
    pointed.map(|(message, _)| message)
}

fn colour(message: &Transmission, end: End) -> Color32 {
    match end {
        End::Lost(_) => colours::egui(colours::LOST),
        _ if is_of_a_swap(message.packet.kind) => colours::egui(colours::PILOT),
        _ => colours::egui(colours::team_text(message.packet.from.team)).gamma_multiply(0.75),
    }
}

fn paint_arrow(painter: &egui::Painter, message: &Transmission, arrow: &Arrow, plain: bool) {
    let colour = colour(message, arrow.end);
    let stroke = Stroke::new(if is_of_a_swap(message.packet.kind) { 1.6 } else { 1.1 }, colour);
    let ends = [arrow.from, arrow.to];
    if message.late && !plain {
        painter.extend(egui::Shape::dashed_line(&ends, stroke, 5.0, 3.5));
    } else {
        painter.line_segment(ends, stroke);
    }
    match arrow.end {
        End::Arrived if !plain => tip(painter, arrow, colour),
        End::Arrived => {}
        End::OnItsWay => {
            painter.circle_filled(arrow.to, 2.5, colour);
        }
        End::Lost(_) => cross(painter, arrow.to, colours::egui(colours::PENALTY)),
    }
}

fn tip(painter: &egui::Painter, arrow: &Arrow, colour: Color32) {
    let along = (arrow.to - arrow.from).normalized();
    let back = arrow.to - 6.0 * along;
    let aside = 3.0 * along.rot90();
    painter.add(egui::Shape::convex_polygon(
        vec![arrow.to, back + aside, back - aside],
        colour,
        Stroke::NONE,
    ));
}

fn cross(painter: &egui::Painter, at: Pos2, colour: Color32) {
    let stroke = Stroke::new(1.8, colour);
    painter.line_segment([at + vec2(-3.5, -3.5), at + vec2(3.5, 3.5)], stroke);
    painter.line_segment([at + vec2(-3.5, 3.5), at + vec2(3.5, -3.5)], stroke);
}

/// Role swaps first and the newest first; a message to the whole team has one label. Where labels are, and of which arrow each is.
fn paint_labels(
    painter: &egui::Painter,
    axes: &Axes,
    arrows: &[(&Transmission, Arrow)],
) -> Vec<(Rect, usize)> {
    let mut labels = Labels::default();
    let mut painted = Vec::new();
    let font = egui::FontId::proportional(TEXT);
    for important in [true, false] {
        if !important && arrows.len() > CROWDED {
            break;
        }
        let mut last = None;
        let numbered = arrows.iter().enumerate();
        for (number, (message, arrow)) in
            numbered.filter(|(_, (message, _))| is_of_a_swap(message.packet.kind) == important)
        {
            let text = message.label();
            let what = (text.clone(), message.packet.from, message.sent);
            if last.replace(what.clone()) == Some(what) {
                continue;
            }
            let galley = painter.layout_no_wrap(text, font.clone(), colour(message, arrow.end));
            let size = galley.size() + vec2(4.0, -2.0);
            let Some(place) = labels.place(arrow, size, axes.rect, important) else { continue };
            painter.rect_filled(place, 2.0, Color32::from_black_alpha(225));
            let at = place.center() - galley.size() / 2.0;
            painter.galley(at, galley, Color32::WHITE);
            painted.push((place, number));
        }
    }
    painted
}
