//! What the robot believes, what is true, and how far apart they are; all in its team frame.

use bevy::prelude::*;
use bevy_egui::egui;

use crate::geometry::wrap_angle;
use crate::ids::Team;
use crate::inspector::figures::{UNKNOWN, coordinates, degrees, fixed};
use crate::inspector::matching::{Pair, error, pair};
use crate::inspector::subject::Looked;
use crate::inspector::{table, tints};

const FRAME: &str =
    "Metres in the team frame: x towards the opponents' goal, y to the left, from the centre spot";

pub(super) fn draw(ui: &mut egui::Ui, robot: &Looked) {
    table::heading(ui, &["believed x", "y", "true x", "y", "off by", "age, s"]);
    own_pose(ui, robot);
    ball(ui, robot);
    for pair in pair(&robot.of.model.robots, &robot.others) {
        other(ui, robot, pair);
    }
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
    table::row(ui, name, &[&bx, &by, &tx, &ty, &off, &age])
}

fn own_pose(ui: &mut egui::Ui, robot: &Looked) {
    let (believed, truth) = (robot.of.model.pose, robot.pose);
    compare(ui, "itself, m", (Some(believed.position), Some(truth.position)), None).on_hover_text(FRAME);
    let off = wrap_angle(believed.heading - truth.heading).abs();
    let [believed, truth, off] = [believed.heading, truth.heading, off].map(degrees);
    table::row(ui, "heading, °", &["", &believed, "", &truth, &off, ""])
        .on_hover_text("0 towards the opponents' goal, positive to the left");
}

fn ball(ui: &mut egui::Ui, robot: &Looked) {
    let (believed, truth) = (robot.of.model.ball, robot.ball);
    let age = believed.map(|ball| robot.since(ball.seen));
    let places = (believed.map(|ball| ball.position), truth.map(|ball| ball.position));
    compare(ui, "ball, m", places, age).on_hover_text(FRAME);
    let velocities = (believed.map(|ball| ball.velocity), truth.map(|ball| ball.velocity));
    compare(ui, "ball, m/s", velocities, None).on_hover_text("The ball's velocity in the team frame");
}

fn other(ui: &mut egui::Ui, robot: &Looked, pair: Pair) {
    let name = match (pair.truth, pair.belief) {
        (Some((id, _)), _) => named(ui, id.to_string(), id.team),
        (None, Some(belief)) => named(ui, format!("{} ?", belief.team), belief.team),
        (None, None) => return,
    };
    let age = pair.belief.map(|belief| robot.since(belief.seen));
    let row = compare(ui, name, pair.places(), age);
    match pair {
        Pair { truth: None, .. } => row.on_hover_text("Believed to be there, but nobody is"),
        Pair { belief: None, .. } => row.on_hover_text("The robot knows nothing of it"),
        _ => row.on_hover_text(FRAME),
    };
}

fn named(ui: &egui::Ui, name: String, team: Team) -> egui::WidgetText {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mut job = egui::text::LayoutJob::default();
    job.append("■ ", 0.0, egui::TextFormat::simple(font.clone(), tints::egui(tints::team(team))));
    job.append(&name, 0.0, egui::TextFormat::simple(font, ui.visuals().text_color()));
    job.into()
}
