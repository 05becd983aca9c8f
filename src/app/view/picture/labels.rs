//! Text on the pitch: numbers on the robots' plates, and beside each robot its role, its activity where there is room for it,
//! and signs of what is wrong with it. Drawn by egui's painter under all panels.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::camera::PitchCamera;
use super::label_placement::{LabelPlace, LabelPlacement};
use super::rings::SELECTED;
use super::robots::{Plate, reach};
use super::status_icons;
use super::status_icons::StatusIcon;
use super::visuals::BodyVisual;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::state::{FreeArea, Overlay, Overlays, PanelSystems, Screen, Selected, nearest_within};
use crate::app::view::style::{SMALL, font};
use crate::comms::radio::Interference;
use crate::ids::RobotId;
use crate::mind::teamwork::Swapping;
use crate::pitch::BallKind;
use crate::robot::pilot::Pilot;
use crate::robot::{OffPitch, Robot};
use crate::strategy::{Activity, Role, Strategies, Strategy};
use crate::world::ball::Ball;
use crate::world::referee::MatchState;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<LabelPlacement>().add_systems(
        EguiPrimaryContextPass,
        write_on_pitch.in_set(PanelSystems::Pitch).run_if(in_state(Screen::Match)),
    );
}

/// Activities are shown for all robots from this scale on, points to a metre.
const NEAR: f32 = 150.0;
/// Reach of the rings around a robot, in its own reaches.
const RINGS: f32 = SELECTED + 0.08;
/// Share of a robot's reach around the middle of each of its bodies that labels keep off.
const BODY: f32 = 0.6;
/// The smallest plate that a number can be read on, and how near to the edge of the pitch's area a robot is told that waits
/// out of sight, in points.
const PLATE: f32 = 13.0;
const EDGE: f32 = 14.0;
/// Height of a number, as a share of its plate's.
const NUMBER: f32 = 0.8;
const LARGEST_NUMBER: f32 = 34.0;

#[derive(QueryData)]
struct Labelled {
    id: &'static RobotId,
    robot: &'static Robot,
    swapping: Option<&'static Swapping>,
    role: &'static Role,
    activity: &'static Activity,
    off_pitch: Has<OffPitch>,
    piloted: Has<Pilot>,
}

/// What a label says: lines with their colours.
fn lines(
    of: &LabelledItem,
    strategy: &Strategy,
    state: &MatchState,
    with_activity: bool,
) -> Vec<(String, Color)> {
    let mut lines = Vec::with_capacity(3);
    let tag = |role: usize| strategy.roles.get(role).map_or("", |role| role.tag.as_str());
    let (own, acting) = (of.role.0, of.activity.acting_as);
    let role = if tag(own) == tag(acting) {
        tag(own).to_owned()
    } else {
        format!("{} as {}", tag(own), tag(acting))
    };
    lines.push((role, colours::PILOT));
    if of.off_pitch {
        lines.push((off_text(state, *of.id), colours::PENALTY));
    } else if of.piloted {
        lines.push(("you".into(), colours::PILOT));
    } else if with_activity {
        let machine = strategy.machines.get(of.activity.machine(strategy));
        let activity = machine.and_then(|machine| machine.states.get(of.activity.state));
        lines.extend(activity.map(|activity| (activity.name.replace('_', " "), colours::TEXT)));
    }
    lines
}

/// How much longer a robot is off the pitch.
pub fn off_text(state: &MatchState, robot: RobotId) -> String {
    match state.removed.iter().find(|removal| removal.robot == robot) {
        // A referee box, or the script that took it off, decides when it comes back.
        Some(removal) if !removal.seconds_left.is_finite() => "taken off".into(),
        Some(removal) if removal.seconds_left > 0.0 => format!("off for {} s", removal.seconds_left.ceil()),
        _ => "waits to return".into(),
    }
}

fn write_on_pitch(
    mut contexts: EguiContexts,
    (area, camera, overlays, selected): (Res<FreeArea>, Res<PitchCamera>, Res<Overlays>, Res<Selected>),
    (state, strategies, interference): (Res<MatchState>, Res<Strategies>, Res<Interference>),
    // Labels keep their places from frame to frame, so that they do not hop about.
    (mut placed, mut kept): (ResMut<LabelPlacement>, Local<BTreeMap<RobotId, LabelPlace>>),
    shown: Query<(&BodyVisual, Option<&Plate>)>,
    robots: Query<Labelled>,
    (kind, ball): (Res<BallKind>, Query<(), With<Ball>>),
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let layer = egui::LayerId::new(egui::Order::Background, egui::Id::new("text on the pitch"));
    let painter = ctx.layer_painter(layer).with_clip_rect(area.0);
    placed.clear(area.0);
    if area.0.width() < 2.0 * EDGE || area.0.height() < 2.0 * EDGE {
        return Ok(());
    }
    for (shown, plate) in &shown {
        let reach = match (ball.get(shown.body), plate, robots.get(shown.body)) {
            (Ok(()), ..) => kind.radius,
            (_, Some(plate), _) => BODY * plate.reach,
            (.., Ok(robot)) => BODY * reach(&robot.robot.kind),
            _ => continue,
        };
        let reach = reach * camera.scale;
        let body = egui::Rect::from_center_size(
            camera.to_screen(shown.pose.position),
            egui::Vec2::splat(2.0 * reach),
        );
        placed.add_body(body);
    }
    let mut labelled: Vec<_> = shown.iter().filter_map(|(drawn, plate)| Some((*drawn, *plate?))).collect();
    labelled.sort_unstable_by_key(|(_, plate)| (selected.0 != Some(plate.of), plate.of));
    for (drawn, plate) in labelled {
        let mut at = camera.to_screen(drawn.pose.to_field(plate.middle));
        let unit = shown.iter().find(|(shown, _)| shown.robot == Some(plate.of)).map(|(unit, _)| unit);
        let Some((unit, robot)) = unit.and_then(|unit| Some((unit, robots.get(unit.body).ok()?))) else {
            continue;
        };
        let mut middle = at.lerp(camera.to_screen(unit.pose.position), 0.5);
        let mut reach = plate.reach * camera.scale;
        let edge = area.0.shrink(EDGE);
        if robot.off_pitch && !edge.contains(middle) {
            // Robots that wait out of sight are told at the edge.
            (at, middle, reach) = (nearest_within(edge, at), nearest_within(edge, middle), PLATE);
        }
        write_number(&painter, at, &plate, camera.scale);
        let locked = robot.swapping.is_some_and(|swapping| swapping.machine.lock().is_some());
        let cut_off = interference.cut_off.contains(robot.id);
        let signs = StatusIcon::of(robot.robot.health, robot.off_pitch, cut_off, locked);
        let corner = nearest_within(edge, middle + egui::vec2(0.8, -0.8) * reach);
        let corner =
            if corner.distance(at) < 1.5 * PLATE { at + egui::vec2(1.5 * PLATE, 0.0) } else { corner };
        for (place, sign) in signs.iter().enumerate() {
            sign.paint(&painter, corner + egui::vec2((2.0 * status_icons::RADIUS + 2.0) * place as f32, 0.0));
        }
        let is_selected = selected.0 == Some(plate.of);
        if !(overlays.shows(Overlay::Labels) || is_selected || robot.off_pitch) {
            continue;
        }
        let with_activity = is_selected || camera.scale > NEAR;
        let lines = lines(&robot, strategies.of(plate.of.team), &state, with_activity);
        let galley = lay_out(&painter, &lines);
        let choice = kept.entry(plate.of).or_default();
        let room = galley.size() + 2.0 * PADDING;
        let reach = if is_selected || robot.piloted { RINGS * reach } else { reach };
        let (rect, taken) = placed.place(middle, reach + 4.0, room, *choice);
        *choice = taken;
        painter.rect_filled(rect, 4.0, GROUND);
        painter.galley(rect.center_top() + egui::vec2(0.0, PADDING.y), galley, egui::Color32::WHITE);
    }
    Ok(())
}

/// A robot's number, on a plate of its own where the drawn one is too small for it or out of sight.
fn write_number(painter: &egui::Painter, at: egui::Pos2, plate: &Plate, scale: f32) {
    let drawn = 2.0 * plate.half * scale;
    if drawn < PLATE || !painter.clip_rect().shrink(1.5 * EDGE).contains(at) {
        let own = egui::Rect::from_center_size(at, egui::Vec2::splat(PLATE.max(drawn)));
        painter.rect_filled(own, 2.0, paint(colours::team(plate.of.team)));
    }
    let size = (NUMBER * drawn).clamp(SMALL, LARGEST_NUMBER).round();
    let number = plate.of.number.to_string();
    painter.text(at, egui::Align2::CENTER_CENTER, number, font(size), paint(colours::ROBOT));
}

/// The ground of a label, dark enough for white text upon a white wall.
pub const GROUND: egui::Color32 = egui::Color32::from_black_alpha(190);

/// Room around a label's text, in points.
pub const PADDING: egui::Vec2 = egui::vec2(5.0, 1.0);

/// Lines of text with their colours, centred under each other.
pub fn lay_out(painter: &egui::Painter, lines: &[(String, Color)]) -> Arc<egui::Galley> {
    let mut job = egui::text::LayoutJob { halign: egui::Align::Center, ..default() };
    for (number, (line, colour)) in lines.iter().enumerate() {
        let format = egui::TextFormat { font_id: font(SMALL), color: paint(*colour), ..default() };
        if number > 0 {
            job.append("\n", 0.0, format.clone());
        }
        job.append(line, 0.0, format);
    }
    painter.layout_job(job)
}
