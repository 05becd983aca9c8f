//! What the robot believes, what is true, and how far apart they are; all in its team frame.

use bevy::prelude::*;
use bevy_egui::egui;

use crate::app::inspector::matching::{BeliefPair, error, pair};
use crate::app::inspector::subject::SelectedRobot;
use crate::app::inspector::table::{self, Column, figures, words};
use crate::app::view::colours;
use crate::app::view::format::{UNKNOWN, coordinates, degrees, fixed, metres, seconds, span};
use crate::geometry::wrap_angle;
use crate::ids::Team;
use crate::protocol::b3p::B3p;

const FRAME: &str =
    "Metres in the team frame: x towards the opponents' goal, y to the left, from the centre spot";

/// Width of a column of figures, in points: room for `−10.55`.
const FIGURE: f32 = 47.0;
const BELIEFS: [Column; 7] = [
    words("", 0.0, ""),
    figures("believed x", FIGURE, FRAME),
    figures("y", FIGURE, FRAME),
    figures("true x", FIGURE, FRAME),
    figures("y", FIGURE, FRAME),
    figures("off by", FIGURE, "Distance from the belief to the truth"),
    figures("age, s", FIGURE, "Time since it was seen"),
];

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot) {
    table::heading(ui, &BELIEFS);
    own_pose(ui, robot);
    ball(ui, robot);
    for pair in pair(&robot.of.model.robots, &robot.others) {
        other(ui, robot, pair);
    }
    if let Some(booking) = robot.of.booking {
        let told = booked(&booking.0, robot.id.number, robot.clock.tick.saturating_sub(1), robot.clock.dt);
        table::line(ui, "the ball is", told).on_hover_text(
            "Ball booking: whom this robot believes to have booked the ball, how far that one was from it, when it \
             last heard so, and how often the ball was booked again",
        );
    }
    if let Some(action) = robot.of.team_model.action {
        table::line(ui, "it may", action.to_string()).on_hover_text(
            "Of all robots of its team it is this one that may execute the action, as it believes",
        );
    }
    let reports: Vec<String> = (robot.of.team_model.map.iter())
        .map(|report| {
            let [x, y] = coordinates(report.position);
            format!("{} saw it at {x}, {y}", report.by)
        })
        .collect();
    if !reports.is_empty() {
        table::line(ui, "mates say", reports.join("; ")).on_hover_text(FRAME);
    }
}

/// The one booking that a robot knows of, in words.
fn booked(machine: &B3p, own: u8, tick: u64, dt: f32) -> String {
    let Some(known) = machine.booking() else { return "not booked".into() };
    let who = if known.robot_booker == own { "itself".into() } else { known.robot_booker.to_string() };
    let ago = seconds(span(known.timestamp, tick, dt));
    let term = if known.term > 0 { format!(", term {}", known.term) } else { String::new() };
    if known.distance.is_infinite() {
        return format!("let go by {who}, {ago} ago{term}");
    }
    let expired = if machine.is_booked(tick) { "" } else { ": expired" };
    format!("booked by {who}, {}, {ago} ago{term}{expired}", metres(known.distance.metres()))
}

/// One row: both vectors, the distance between them, and an age in seconds.
fn compare(
    ui: &mut egui::Ui,
    name: impl Into<egui::WidgetText>,
    places: (Option<Vec2>, Option<Vec2>),
    age: Option<f32>,
) -> egui::Response {
    let text = |v: Option<Vec2>| v.map_or([UNKNOWN.into(), UNKNOWN.into()], coordinates);
    let ([bx, by], [tx, ty]) = (text(places.0), text(places.1));
    let off = error(places).map_or(String::new(), |off| fixed(off, 2));
    let age = age.map_or(String::new(), |age| fixed(age, 1));
    let figures = [bx, by, tx, ty, off, age].map(egui::WidgetText::from);
    table::row(ui, &BELIEFS, [name.into()].into_iter().chain(figures))
}

fn own_pose(ui: &mut egui::Ui, robot: &SelectedRobot) {
    let (believed, truth) = (robot.of.model.pose, robot.pose);
    compare(ui, "itself, m", (Some(believed.position), Some(truth.position)), None).on_hover_text(FRAME);
    let off = wrap_angle(believed.heading - truth.heading).abs();
    let [believed, truth, off] = [believed.heading, truth.heading, off].map(degrees);
    let cells = ["heading, °", "", &believed, "", &truth, &off, ""];
    table::row(ui, &BELIEFS, cells).on_hover_text("0 towards the opponents' goal, positive to the left");
}

fn ball(ui: &mut egui::Ui, robot: &SelectedRobot) {
    let (believed, truth) = (robot.of.model.ball, robot.ball);
    let age = believed.map(|ball| robot.since(ball.seen));
    let places = (believed.map(|ball| ball.position), truth.map(|ball| ball.position));
    compare(ui, "ball, m", places, age).on_hover_text(FRAME);
    let velocities = (believed.map(|ball| ball.velocity), truth.map(|ball| ball.velocity));
    compare(ui, "ball, m/s", velocities, None).on_hover_text("The ball's velocity in the team frame");
}

fn other(ui: &mut egui::Ui, robot: &SelectedRobot, pair: BeliefPair) {
    let name = match (pair.truth, pair.belief) {
        (Some((id, _)), _) => named(ui, id.to_string(), id.team),
        (None, Some(belief)) => named(ui, format!("{} ?", belief.team), belief.team),
        (None, None) => return,
    };
    let age = pair.belief.map(|belief| robot.since(belief.seen));
    let row = compare(ui, name, pair.places(), age);
    match pair {
        BeliefPair { truth: None, .. } => row.on_hover_text("Believed to be there, but nobody is"),
        BeliefPair { belief: None, .. } => row.on_hover_text("The robot knows nothing of it"),
        _ => row.on_hover_text(FRAME),
    };
}

fn named(ui: &egui::Ui, name: String, team: Team) -> egui::WidgetText {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mut job = egui::text::LayoutJob::default();
    job.append("■ ", 0.0, egui::TextFormat::simple(font.clone(), colours::egui(colours::team(team))));
    job.append(&name, 0.0, egui::TextFormat::simple(font, ui.visuals().text_color()));
    job.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::b3p::{Book, BookingInput, BookingSettings, Distance, Rules};

    #[test]
    fn a_booking_is_told_until_it_has_expired_and_then_that_it_has() {
        let settings = BookingSettings {
            rules: Rules::Hardened { release: true },
            threshold: Distance(300),
            timeout: 60,
            renewal: 12,
        };
        let mut machine = B3p::new(3, settings);
        let told = |machine: &B3p, own, tick| booked(machine, own, tick, 1.0 / 60.0);
        assert_eq!(told(&machine, 3, 0), "not booked");
        let book = Book { distance: Distance(840), term: 5, key: Distance(840) };
        machine.step(100, BookingInput::Hear { from: 2, book });
        assert_eq!(told(&machine, 3, 118), "booked by 2, 0.84 m, 0.3 s ago, term 5");
        assert_eq!(told(&machine, 3, 190), "booked by 2, 0.84 m, 1.5 s ago, term 5: expired");
        machine.step(
            200,
            BookingInput::Hear { from: 2, book: Book { distance: Distance::INFINITE, term: 6, ..book } },
        );
        assert_eq!(told(&machine, 2, 200), "let go by itself, 0.0 s ago, term 6");
    }
}
