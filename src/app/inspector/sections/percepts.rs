//! What the robot's camera showed last, as it sees things: by distance and angle.

use bevy_egui::egui;

use crate::app::inspector::subject::SelectedRobot;
use crate::app::inspector::table;
use crate::app::view::format;
use crate::geometry::Sighting;
use crate::ids::Team;
use crate::robot::{Eyes, Frame};

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot) {
    let eyes = camera(&robot.of.robot.sensing.eyes);
    let Some(frame) = &robot.of.percepts.frame else {
        table::line(ui, "frame", "none yet").on_hover_text(eyes);
        return;
    };
    let age = format::fixed(robot.since(frame.taken), 2);
    table::line(ui, "frame", format!("the newest that has arrived, {age} s old")).on_hover_text(eyes);
    table::line(ui, "ball", frame.ball.map_or("not in the frame".into(), sighted));
    table::line(ui, "robots", robots_in(frame, robot.id.team));
}

fn camera(eyes: &Eyes) -> String {
    match eyes.camera() {
        None => "Perfect eyes: everything, at once".into(),
        Some(camera) => format!(
            "A camera {}° wide that sees the ball up to {} and robots up to {} away, {} frames a second",
            format::fixed(camera.field_of_view, 0),
            format::metres(camera.ball_range),
            format::metres(camera.robot_range),
            format::fixed(camera.frame_hz, 0),
        ),
    }
}

fn sighted(sighting: Sighting) -> String {
    let Sighting { range, bearing } = sighting;
    format!("{}, {}", format::metres(range), format::aside(bearing))
}

fn robots_in(frame: &Frame, own: Team) -> String {
    let mates = frame.robots.iter().filter(|(team, _)| *team == own).count();
    let opponents = frame.robots.len() - mates;
    format!("{} and {}", format::count(mates, "team mate"), format::count(opponents, "opponent"))
}
