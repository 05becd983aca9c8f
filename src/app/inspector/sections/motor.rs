//! The running assemblage: a row for each motor schema with its vector and its weight, their sum, and the intent that follows.

use bevy::prelude::*;
use bevy_egui::egui::{self, RichText};

use super::panel_actions::PanelActions;
use crate::app::inspector::pending::Pending;
use crate::app::inspector::subject::SelectedRobot;
use crate::app::inspector::table::{self, Column, figures, words};
use crate::app::inspector::tuner::{RESET, ROW, Tuner};
use crate::app::view::{colours, format};
use crate::game::requests::Request;
use crate::geometry::{Attacking, angle, wrap_angle};
use crate::ids::Team;
use crate::robot::{DriveCommand, SteeringIntent};
use crate::strategy::{Combination, Strategy, Term};

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot, actions: &mut PanelActions) {
    match robot.assemblage() {
        Some((index, assemblage)) => {
            let how = match assemblage.combination {
                Combination::WeightedSum => "weighted sum",
                Combination::WinnerTakeAll => "winner takes all",
                Combination::Blend => "blend",
            };
            table::line(ui, "runs", format!("{}, {how}", assemblage.name));
            for (number, term) in assemblage.terms.iter().enumerate() {
                let place = Place { team: robot.id.team, assemblage: index, term: number };
                let vector = robot.of.contributions.vectors.get(number).copied();
                schema(ui, (term, place, vector), robot.ends, actions);
            }
            sum(ui, robot);
        }
        None => {
            table::line(ui, "runs", "no motor schemas in this state");
        }
    }
    outcome(ui, robot);
}

/// Widths of what stands beside a schema's name, in points.
const ICON: f32 = 22.0;
const FIGURE: f32 = 42.0;
const VECTOR: [Column; 3] = [words("", 0.0, ""), figures("", FIGURE, ""), figures("", FIGURE, "")];
const SLIDER: f32 = 62.0;
const VALUE: f32 = 40.0;

const WEIGHT: Tuner = Tuner {
    range: (0.0, 3.0),
    step: 0.05,
    decimals: 2,
    unit: "",
    tip: "The schema's weight, for the whole team, from the next tick on",
    widths: (SLIDER, VALUE),
};

/// The place of a weight: its team, and the indices of its assemblage and of its term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    team: Team,
    assemblage: usize,
    term: usize,
}

impl Place {
    fn weight(self, strategy: &Strategy) -> Option<f32> {
        Some(strategy.assemblages.get(self.assemblage)?.terms.get(self.term)?.weight)
    }
}

fn schema(
    ui: &mut egui::Ui,
    (term, place, vector): (&Term, Place, Option<Vec2>),
    ends: Attacking,
    actions: &mut PanelActions,
) {
    let kind = term.kind();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let fixed = ICON + 2.0 * FIGURE + SLIDER + VALUE + RESET + 3.0 * 4.0;
        let room = egui::vec2((ui.available_width() - fixed).max(40.0) + ICON + 2.0 * FIGURE, ROW);
        ui.allocate_ui(room, |ui| {
            vector_row(ui, &term.name, vector.unwrap_or_default(), colours::schema(kind), ends)
                .on_hover_text(format!("{}: {}", term.name, kind.words()));
        });
        weight(ui, place, term.weight, actions);
    });
}

/// An arrow as it lies on the pitch, a name, a length without a unit and an angle.
fn vector_row(ui: &mut egui::Ui, name: &str, vector: Vec2, tint: Color, ends: Attacking) -> egui::Response {
    let size = egui::vec2(ui.available_width(), ROW);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    let idle = vector.length() < 0.005;
    let painter = ui.painter();
    let centre = rect.left_center() + egui::vec2(ICON / 2.0 - 2.0, 0.0);
    if idle {
        painter.circle_filled(centre, 2.0, colours::egui(tint));
    } else {
        let on_pitch = ends.turn(vector).normalize_or_zero();
        let way = egui::vec2(on_pitch.x, -on_pitch.y) * (5.0 + 4.0 * vector.length().min(1.0));
        painter.arrow(centre - way, 2.0 * way, egui::Stroke::new(2.0, colours::egui(tint)));
    }
    let cells = [
        name.to_owned(),
        if idle { "0".into() } else { format::fixed(vector.length(), 2) },
        if idle { String::new() } else { format!("{}°", format::degrees(angle(vector))) },
    ];
    table::paint(ui, rect.with_min_x(rect.left() + ICON), &VECTOR, cells);
    response
}

fn weight(ui: &mut egui::Ui, place: Place, in_force: f32, actions: &mut PanelActions) {
    let pending = Pending::new(in_force, actions.requests, |request| match *request {
        Request::SetWeight { team, assemblage, term, weight } => {
            (place == Place { team, assemblage, term }).then_some(weight)
        }
        _ => None,
    });
    let before = pending.shown();
    let mut wanted = before;
    let filed = actions.file(place.team).and_then(|plan| place.weight(&plan.strategy)).unwrap_or(in_force);
    WEIGHT.show(ui, &mut wanted, filed);
    if wanted != before && wanted.is_finite() {
        let Place { team, assemblage, term } = place;
        actions.requests.ask(Request::SetWeight { team, assemblage, term, weight: wanted });
    }
}

fn sum(ui: &mut egui::Ui, robot: &SelectedRobot) {
    let fixed = SLIDER + VALUE + RESET + 3.0 * 4.0;
    let room = egui::vec2((ui.available_width() - fixed).max(40.0), ROW);
    ui.allocate_ui(room, |ui| {
        vector_row(ui, "sum", robot.of.contributions.sum, colours::SUM, robot.ends).on_hover_text(
            "Its angle is where to go, in the team frame: 0° to the opponents' goal, positive to the left. \
             Its length is how fast, as a share of the state's speed",
        );
    });
}

fn outcome(ui: &mut egui::Ui, robot: &SelectedRobot) {
    let name = if robot.of.piloted { "would" } else { "intends" };
    table::line(ui, name, intent(robot));
    match robot.of.command {
        DriveCommand::Wheels(speeds) => {
            let [left, right] = [speeds.left, speeds.right].map(format::speed);
            table::line(ui, "wheels", format!("left {left}, right {right}"));
        }
        DriveCommand::Gait(gait) => {
            let [ahead, left] = [gait.ahead, gait.left].map(format::speed);
            let turn = format::fixed(gait.turn.to_degrees(), 0);
            table::line(ui, "legs", format!("{ahead} ahead, {left} to the left, {turn}°/s"));
        }
    }
}

fn intent(robot: &SelectedRobot) -> RichText {
    let words = match *robot.of.intent {
        SteeringIntent::Stop => "to stand still".into(),
        SteeringIntent::Spin(rate) => {
            format!("to turn on the spot, {}°/s {}", rate.abs().to_degrees().round(), side(rate))
        }
        SteeringIntent::Steer { heading, speed, .. } => {
            let turn = wrap_angle(heading - robot.of.odometry.pose.heading);
            let playback = format!(
                "{} ({})",
                format::speed(speed.abs() * robot.of.robot.kind.max_speed()),
                format::percent(speed.abs())
            );
            match speed {
                0.0 => format!("to face {}", format::aside(turn)),
                _ if speed < 0.0 => format!("to back up at {playback}, turning {}", format::aside(turn)),
                _ => format!("to drive {} at {playback}", format::aside(turn)),
            }
        }
    };
    RichText::new(words)
}

fn side(turn: f32) -> &'static str {
    if turn >= 0.0 { "left" } else { "right" }
}
