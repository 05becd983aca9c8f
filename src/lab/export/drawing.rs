//! What is drawn: the pitch, and a moment of a match on it.

use std::f32::consts::TAU;

use bevy::math::Vec2;

use super::figure::{Drawing, Figure, Tint};
use super::moment::{MatchMoment, RobotMoment};
use super::outlines::{BodyPart, Ink, RobotOutlines, box_at};
use super::palette;
use super::trails::Trails;
use crate::geometry::{Pose, unit};
use crate::ids::Team;
use crate::pitch::Pitch;

/// Width of lines along walls and of those that are painted, of walls and of mowing stripes, m.
const LINE: f32 = 0.04;
const PAINTED: f32 = 0.025;
const WALL: f32 = 0.12;
const STRIPE: f32 = 0.75;
/// Room around the pitch, m.
const MARGIN: f32 = 0.12;
/// Width of the line around a part of a robot, m.
const EDGE: f32 = 0.012;
/// Width of lines that tell what a robot believes, and the length of their dashes, m.
const BELIEF: f32 = 0.018;
const DASH: f32 = 0.06;

/// The pitch as it lies there.
pub fn pitch_drawing(pitch: &Pitch) -> Drawing {
    let (half, post, deep) = (pitch.half_size(), pitch.goal.width / 2.0, pitch.goal.depth);
    let carpet = half + pitch.margin();
    let mut figures = Vec::new();
    let mut fill = |colour: u32, centre: Vec2, half: Vec2| {
        figures.push(Figure::Polygon { points: box_at(centre, half).into(), fill: Tint::solid(colour) });
    };
    let is_open = pitch.margin() > 0.0;
    let goal = |side: f32, beyond: f32| Vec2::X * (side * (half.x + (deep + beyond) / 2.0));
    if is_open {
        fill(palette::FENCE, Vec2::ZERO, carpet + pitch.walls.thickness);
    } else {
        fill(palette::CHALK, Vec2::ZERO, half + WALL);
        for side in [1.0, -1.0] {
            fill(palette::CHALK, goal(side, WALL), Vec2::new((deep + WALL) / 2.0, post + WALL));
        }
    }
    let line = if is_open { PAINTED } else { LINE };
    // No carpet shows between a wall and its line.
    let carpet = if is_open { carpet } else { carpet - line / 2.0 };
    let stripes = (carpet.x / STRIPE).round().max(1.0) as u16 * 2;
    let width = 2.0 * carpet.x / f32::from(stripes);
    fill(palette::CARPET, Vec2::ZERO, carpet);
    for stripe in (1..stripes).step_by(2) {
        let west = -carpet.x + f32::from(stripe) * width;
        fill(palette::STRIPE, Vec2::new(west + width / 2.0, 0.0), Vec2::new(width / 2.0, carpet.y));
    }
    for (side, colour) in [(-1.0, palette::YELLOW_GOAL), (1.0, palette::BLUE_GOAL)] {
        if is_open {
            let thick = pitch.walls.thickness;
            fill(palette::CHALK, goal(side, thick), Vec2::new((deep + thick) / 2.0, post + thick));
        }
        fill(colour, goal(side, 0.0), Vec2::new(deep / 2.0, post));
    }
    figures.extend(lines(pitch, line));
    let edge = Vec2::new((deep + WALL).max(pitch.margin()), pitch.margin().max(WALL));
    Drawing { half: half + edge + MARGIN, ground: palette::FLOOR, figures }
}

fn lines(pitch: &Pitch, width: f32) -> Vec<Figure> {
    let chalk = Tint::solid(palette::CHALK);
    let half = pitch.half_size();
    let area = pitch.own_penalty_area();
    let frame = |centre: Vec2, half: Vec2| {
        let points = box_at(centre, half - width / 2.0).into();
        Figure::Line { points, closed: true, width, tint: chalk, dash: None }
    };
    let bar = |centre: Vec2, half: Vec2| Figure::Polygon { points: box_at(centre, half).into(), fill: chalk };
    let radius = pitch.centre_circle_radius;
    let mut figures = vec![
        frame(Vec2::ZERO, half),
        bar(Vec2::ZERO, Vec2::new(width / 2.0, half.y)),
        Figure::Circle { centre: Vec2::ZERO, radius, width, tint: chalk, dash: None },
        Figure::Disc { centre: Vec2::ZERO, radius: width, fill: chalk },
    ];
    for side in [1.0, -1.0] {
        figures.push(frame(side * (area.min + area.max) / 2.0, (area.max - area.min) / 2.0));
    }
    for spot in pitch.penalty_spots.iter().filter(|spot| spot.length() > width) {
        let (long, thin) = (width * 1.6, width / 4.0);
        figures.extend([bar(*spot, Vec2::new(long, thin)), bar(*spot, Vec2::new(thin, long))]);
    }
    figures
}

/// A moment on the pitch: the ways that bodies have come, the robots, the ball, and what robots believe, if it is wanted.
pub fn moment_figures(moment: &MatchMoment, trails: &Trails, ball_radius: f32, beliefs: bool) -> Vec<Figure> {
    let mut figures = trails.figures();
    for robot in &moment.robots {
        figures.extend(robot_figures(robot));
    }
    let (centre, radius) = (moment.ball, ball_radius);
    figures.push(Figure::Disc { centre, radius: 1.14 * radius, fill: Tint::solid(palette::BALL_EDGE) });
    figures.push(Figure::Disc { centre, radius: 0.96 * radius, fill: Tint::solid(palette::BALL) });
    if beliefs {
        figures.extend(moment.robots.iter().flat_map(|robot| belief_figures(robot, moment.ball, radius)));
    }
    figures
}

fn robot_figures(robot: &RobotMoment) -> Vec<Figure> {
    let outlines = RobotOutlines::of(&robot.kind);
    let opacity = if robot.off_pitch { 0.45 } else { 1.0 };
    let mut figures = Vec::new();
    for part in &outlines.parts {
        let frame = frame_of(robot, part.of, &outlines);
        let points: Vec<Vec2> = part.points.iter().map(|point| frame.to_field(*point)).collect();
        let colour = match part.ink {
            Ink::Body | Ink::Dark => palette::ROBOT,
            Ink::Edge => palette::ROBOT_EDGE,
            Ink::Head => palette::HEAD,
            Ink::Team => palette::team(robot.id.team),
        };
        figures.push(Figure::Polygon { points: points.clone(), fill: Tint::faint(colour, opacity) });
        if part.ink == Ink::Body {
            let tint = Tint::faint(palette::ROBOT_EDGE, opacity);
            figures.push(Figure::Line { points, closed: true, width: EDGE, tint, dash: None });
        }
    }
    figures.push(Figure::Text {
        at: frame_of(robot, outlines.plate_on, &outlines).to_field(outlines.plate),
        height: 1.1 * outlines.plate_half,
        text: robot.id.number.to_string(),
        tint: Tint::faint(palette::ROBOT, opacity),
    });
    figures
}

/// The pose of a part of a robot.
fn frame_of(robot: &RobotMoment, part: BodyPart, outlines: &RobotOutlines) -> Pose {
    match part {
        BodyPart::Unit => robot.pose,
        BodyPart::Trailer => robot.trailer.unwrap_or(robot.pose),
        BodyPart::Head => {
            let position = robot.pose.to_field(outlines.neck);
            Pose { position, heading: robot.pose.heading + robot.pan }
        }
    }
}

/// Dashed in the team's colour, each with a thin line to what is true of it.
fn belief_figures(robot: &RobotMoment, ball: Vec2, ball_radius: f32) -> Vec<Figure> {
    let Some(believed) = robot.believed else { return Vec::new() };
    let tint = Tint::solid(palette::team(robot.id.team));
    let reach = robot.kind.reach();
    let circle = |centre: Vec2, radius: f32| Figure::Circle {
        centre,
        radius,
        width: BELIEF,
        tint,
        dash: Some(DASH.min(TAU * radius / 20.0)),
    };
    let line = |points: [Vec2; 2], width: f32| Figure::Line {
        points: points.into(),
        closed: false,
        width,
        tint,
        dash: None,
    };
    let place = believed.position;
    let mut figures = vec![
        circle(place, reach),
        line([place, place + 1.3 * reach * unit(believed.heading)], BELIEF),
        line([place, robot.pose.position], BELIEF / 2.0),
    ];
    if let Some(believed) = robot.believed_ball {
        figures.extend([circle(believed, ball_radius), line([believed, ball], BELIEF / 2.0)]);
    }
    figures
}

/// The score in the middle above the pitch, home left, for a picture that has no other place for it.
pub fn score_figures(moment: &MatchMoment, drawing: &Drawing) -> Vec<Figure> {
    const HEIGHT: f32 = 0.2;
    let at = |aside: f32| Vec2::new(aside, drawing.half.y - 0.19);
    let text = |aside: f32, text: String, colour: u32| Figure::Text {
        at: at(aside),
        height: HEIGHT,
        text,
        tint: Tint::solid(colour),
    };
    let ground = Figure::Polygon {
        points: box_at(at(0.0), Vec2::new(0.46, 0.16)).into(),
        fill: Tint::faint(palette::ROBOT, 0.72),
    };
    let [home, away] = moment.score.map(|goals| goals.to_string());
    vec![
        ground,
        text(-0.22, home, palette::team(Team::Home)),
        text(0.0, ":".into(), palette::CHALK),
        text(0.22, away, palette::team(Team::Away)),
    ]
}
