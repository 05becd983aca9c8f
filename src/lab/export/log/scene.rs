//! Drawings of a log, as Foxglove's `SceneUpdate`, and the frames that they go with. Bodies are drawn once and go with their frames.

use bevy::math::{Quat, Vec2, Vec3};
use serde::Serialize;

use crate::geometry::{Pose, unit};
use crate::lab::export::drawing::pitch_drawing;
use crate::lab::export::figure::{Drawing, Figure};
use crate::lab::export::moment::{MatchMoment, RobotMoment};
use crate::lab::export::outlines::{BodyPart, Ink, RobotOutlines};
use crate::lab::export::palette;
use crate::pitch::Pitch;

/// The frame of the pitch: x east, y north, z up.
const PITCH: &str = "pitch";
const BALL: &str = "ball";
/// How much higher each figure of the pitch lies than the one before, m.
const LAYER: f32 = 0.0004;
/// The height of a robot as a share of its reach.
const HEIGHT: f32 = 0.7;
/// The height of what is painted on a robot over it, m.
const PAINT: f32 = 0.003;
/// The height of beliefs over the carpet, m.
const BELIEFS: f32 = 0.04;

#[derive(Clone, Copy, Debug, Serialize)]
struct SceneTime {
    sec: u64,
    nsec: u32,
}

impl SceneTime {
    const FOR_EVER: SceneTime = SceneTime { sec: 0, nsec: 0 };

    fn at(seconds: f64) -> SceneTime {
        let nanoseconds = (seconds * 1e9).round() as u64;
        SceneTime { sec: nanoseconds / 1_000_000_000, nsec: (nanoseconds % 1_000_000_000) as u32 }
    }
}

#[derive(Clone, Copy, Debug, Serialize)]
struct ScenePoint {
    x: f32,
    y: f32,
    z: f32,
}

impl From<Vec3> for ScenePoint {
    fn from(point: Vec3) -> ScenePoint {
        let [x, y, z] = point.to_array().map(rounded);
        ScenePoint { x, y, z }
    }
}

/// To a ten-thousandth, which keeps files short: nobody measures in drawings.
fn rounded(value: f32) -> f32 {
    (value * 1e4).round() / 1e4
}

#[derive(Clone, Copy, Debug, Serialize)]
struct SceneRotation {
    x: f32,
    y: f32,
    z: f32,
    w: f32,
}

impl SceneRotation {
    fn about_z(angle: f32) -> SceneRotation {
        let [x, y, z, w] = Quat::from_rotation_z(angle).to_array().map(rounded);
        SceneRotation { x, y, z, w }
    }
}

#[derive(Clone, Copy, Debug, Serialize)]
struct ScenePose {
    position: ScenePoint,
    orientation: SceneRotation,
}

impl ScenePose {
    fn at(point: Vec3) -> ScenePose {
        ScenePose { position: point.into(), orientation: SceneRotation::about_z(0.0) }
    }
}

#[derive(Clone, Copy, Debug, Serialize)]
struct SceneColour {
    r: f32,
    g: f32,
    b: f32,
    a: f32,
}

impl SceneColour {
    fn of(colour: u32, a: f32) -> SceneColour {
        let [_, r, g, b] = colour.to_be_bytes().map(|byte| f32::from(byte) / 255.0);
        SceneColour { r, g, b, a }
    }
}

/// What comes or changes in a scene.
#[derive(Debug, Serialize)]
pub(super) struct SceneUpdate {
    deletions: [(); 0],
    entities: Vec<SceneEntity>,
}

impl SceneUpdate {
    fn of(entities: Vec<SceneEntity>) -> SceneUpdate {
        SceneUpdate { deletions: [], entities }
    }
}

#[derive(Debug, Serialize)]
struct SceneEntity {
    timestamp: SceneTime,
    frame_id: String,
    id: String,
    lifetime: SceneTime,
    frame_locked: bool,
    metadata: [(); 0],
    arrows: [(); 0],
    cubes: [(); 0],
    spheres: Vec<SceneSphere>,
    cylinders: [(); 0],
    lines: Vec<SceneLine>,
    triangles: Vec<SceneTriangles>,
    texts: Vec<SceneText>,
    models: [(); 0],
}

impl SceneEntity {
    fn new(frame: &str, id: String, now: f64) -> SceneEntity {
        SceneEntity {
            timestamp: SceneTime::at(now),
            frame_id: frame.to_owned(),
            id,
            lifetime: SceneTime::FOR_EVER,
            frame_locked: true,
            metadata: [],
            arrows: [],
            cubes: [],
            spheres: Vec::new(),
            cylinders: [],
            lines: Vec::new(),
            triangles: Vec::new(),
            texts: Vec::new(),
            models: [],
        }
    }
}

#[derive(Debug, Serialize)]
struct SceneSphere {
    pose: ScenePose,
    size: ScenePoint,
    color: SceneColour,
}

#[derive(Debug, Serialize)]
struct SceneLine {
    #[serde(rename = "type")]
    kind: u8,
    pose: ScenePose,
    thickness: f32,
    scale_invariant: bool,
    points: Vec<ScenePoint>,
    color: SceneColour,
    colors: [(); 0],
    indices: [(); 0],
}

/// Kinds of lines.
const STRIP: u8 = 0;
const LOOP: u8 = 1;
const PAIRS: u8 = 2;

impl SceneLine {
    fn new(kind: u8, points: impl IntoIterator<Item = Vec3>, width: f32, color: SceneColour) -> SceneLine {
        SceneLine {
            kind,
            pose: ScenePose::at(Vec3::ZERO),
            thickness: width,
            scale_invariant: false,
            points: points.into_iter().map(ScenePoint::from).collect(),
            color,
            colors: [],
            indices: [],
        }
    }
}

#[derive(Debug, Serialize)]
struct SceneTriangles {
    pose: ScenePose,
    points: Vec<ScenePoint>,
    color: SceneColour,
    colors: [(); 0],
    indices: [(); 0],
}

impl SceneTriangles {
    fn new(points: impl IntoIterator<Item = Vec3>, color: SceneColour) -> SceneTriangles {
        let points = points.into_iter().map(ScenePoint::from).collect();
        SceneTriangles { pose: ScenePose::at(Vec3::ZERO), points, color, colors: [], indices: [] }
    }

    /// A convex polygon at a height.
    fn face(outline: &[Vec2], z: f32, color: SceneColour) -> SceneTriangles {
        let corners =
            (1..outline.len().saturating_sub(1)).flat_map(|i| [outline[0], outline[i], outline[i + 1]]);
        SceneTriangles::new(corners.map(|corner| corner.extend(z)), color)
    }

    /// The walls from the ground up to a face.
    fn walls(outline: &[Vec2], z: f32, color: SceneColour) -> SceneTriangles {
        let sides = (0..outline.len()).map(|i| (outline[i], outline[(i + 1) % outline.len()]));
        let corners = sides.flat_map(|(a, b)| {
            [a.extend(0.0), b.extend(0.0), b.extend(z), a.extend(0.0), b.extend(z), a.extend(z)]
        });
        SceneTriangles::new(corners, color)
    }
}

#[derive(Debug, Serialize)]
struct SceneText {
    pose: ScenePose,
    billboard: bool,
    font_size: f32,
    scale_invariant: bool,
    color: SceneColour,
    text: String,
}

/// Where the frames of bodies are.
#[derive(Debug, Serialize)]
pub(super) struct FrameTransforms {
    transforms: Vec<FrameTransform>,
}

#[derive(Debug, Serialize)]
struct FrameTransform {
    timestamp: SceneTime,
    parent_frame_id: String,
    child_frame_id: String,
    translation: ScenePoint,
    rotation: SceneRotation,
}

/// The frame of a part of a robot.
fn frame_name(robot: &RobotMoment, part: BodyPart) -> String {
    match part {
        BodyPart::Unit => robot.id.to_string(),
        BodyPart::Trailer => format!("{}/trailer", robot.id),
        BodyPart::Head => format!("{}/head", robot.id),
    }
}

/// The frames of ball, robots, trailers and heads.
pub(super) fn frames(moment: &MatchMoment, ball_radius: f32) -> FrameTransforms {
    let transform = |parent: &str, child: String, pose: Pose, z: f32| FrameTransform {
        timestamp: SceneTime::at(moment.seconds),
        parent_frame_id: parent.to_owned(),
        child_frame_id: child,
        translation: pose.position.extend(z).into(),
        rotation: SceneRotation::about_z(pose.heading),
    };
    let ball = Pose { position: moment.ball, heading: 0.0 };
    let mut transforms = vec![transform(PITCH, BALL.into(), ball, ball_radius)];
    for robot in &moment.robots {
        let unit = frame_name(robot, BodyPart::Unit);
        if robot.kind.neck.is_some() {
            let position = RobotOutlines::of(&robot.kind).neck;
            let head = Pose { position, heading: robot.pan };
            transforms.push(transform(&unit, frame_name(robot, BodyPart::Head), head, 0.0));
        }
        let trailer = robot.trailer.map(|pose| (frame_name(robot, BodyPart::Trailer), pose));
        transforms.extend(trailer.map(|(name, pose)| transform(PITCH, name, pose, 0.0)));
        transforms.push(transform(PITCH, unit, robot.pose, 0.0));
    }
    FrameTransforms { transforms }
}

/// The pitch, each figure a little over the one before.
pub(super) fn pitch(pitch: &Pitch, now: f64) -> SceneUpdate {
    let Drawing { figures, .. } = pitch_drawing(pitch);
    let mut entity = SceneEntity::new(PITCH, "pitch".into(), now);
    for (number, figure) in figures.iter().enumerate() {
        let z = LAYER * number as f32;
        let raised = |points: &[Vec2]| points.iter().map(|point| point.extend(z)).collect::<Vec<_>>();
        match figure {
            Figure::Polygon { points, fill } => {
                let colour = SceneColour::of(fill.colour, fill.opacity);
                entity.triangles.push(SceneTriangles::face(points, z, colour));
            }
            Figure::Disc { centre, radius, fill } => {
                let colour = SceneColour::of(fill.colour, fill.opacity);
                entity.triangles.push(SceneTriangles::face(&round(*centre, *radius), z, colour));
            }
            Figure::Line { points, width, tint, .. } => {
                let colour = SceneColour::of(tint.colour, tint.opacity);
                entity.lines.push(SceneLine::new(LOOP, raised(points), *width, colour));
            }
            Figure::Circle { centre, radius, width, tint, .. } => {
                let colour = SceneColour::of(tint.colour, tint.opacity);
                let points = raised(&round(*centre, *radius));
                entity.lines.push(SceneLine::new(LOOP, points, *width, colour));
            }
            Figure::Text { .. } => {}
        }
    }
    SceneUpdate::of(vec![entity])
}

/// Robots and ball, each in the frames of its parts.
pub(super) fn bodies(moment: &MatchMoment, ball_radius: f32) -> SceneUpdate {
    let mut ball = SceneEntity::new(BALL, BALL.into(), moment.seconds);
    ball.spheres.push(SceneSphere {
        pose: ScenePose::at(Vec3::ZERO),
        size: Vec3::splat(2.0 * ball_radius).into(),
        color: SceneColour::of(palette::BALL, 1.0),
    });
    let mut entities = vec![ball];
    for robot in &moment.robots {
        let outlines = RobotOutlines::of(&robot.kind);
        for part in [BodyPart::Trailer, BodyPart::Unit, BodyPart::Head] {
            entities.extend(body(robot, part, &outlines, moment.seconds));
        }
    }
    SceneUpdate::of(entities)
}

fn body(robot: &RobotMoment, of: BodyPart, outlines: &RobotOutlines, now: f64) -> Option<SceneEntity> {
    let parts: Vec<_> = outlines.parts.iter().filter(|part| part.of == of).collect();
    if parts.is_empty() {
        return None;
    }
    let name = frame_name(robot, of);
    let mut entity = SceneEntity::new(&name, name.clone(), now);
    let top = HEIGHT * outlines.reach;
    for (layer, part) in parts.into_iter().enumerate() {
        let z = top + PAINT * layer as f32;
        let colour = match part.ink {
            Ink::Body | Ink::Dark => palette::ROBOT,
            Ink::Edge => palette::ROBOT_EDGE,
            Ink::Head => palette::HEAD,
            Ink::Team => palette::team(robot.id.team),
        };
        let colour = SceneColour::of(colour, 1.0);
        entity.triangles.push(SceneTriangles::face(&part.points, z, colour));
        if matches!(part.ink, Ink::Body | Ink::Edge | Ink::Head) {
            entity.triangles.push(SceneTriangles::walls(&part.points, z, colour));
        }
    }
    if of == outlines.plate_on {
        entity.texts.push(SceneText {
            pose: ScenePose::at(outlines.plate.extend(1.5 * top)),
            billboard: true,
            font_size: 1.5 * outlines.plate_half,
            scale_invariant: false,
            color: SceneColour::of(palette::CHALK, 1.0),
            text: robot.id.number.to_string(),
        });
    }
    Some(entity)
}

/// What robots believe of themselves and the ball: dashed circles, each with a line to the truth.
pub(super) fn beliefs(moment: &MatchMoment, ball_radius: f32) -> SceneUpdate {
    let entities = moment.robots.iter().map(|robot| {
        let mut entity = SceneEntity::new(PITCH, format!("beliefs of {}", robot.id), moment.seconds);
        let colour = SceneColour::of(palette::team(robot.id.team), 0.9);
        let mut believe = |at: Vec2, truth: Vec2, radius: f32| {
            let raised = |point: Vec2| point.extend(BELIEFS);
            entity.lines.push(SceneLine::new(
                PAIRS,
                round(at, radius).into_iter().map(raised),
                0.015,
                colour,
            ));
            entity.lines.push(SceneLine::new(STRIP, [raised(at), raised(truth)], 0.008, colour));
        };
        if let Some(pose) = robot.believed {
            believe(pose.position, robot.pose.position, robot.kind.reach());
        }
        if let Some(at) = robot.believed_ball {
            believe(at, moment.ball, ball_radius);
        }
        entity
    });
    SceneUpdate::of(entities.collect())
}

/// The corners of a circle; in pairs they are dashes.
fn round(centre: Vec2, radius: f32) -> Vec<Vec2> {
    const CORNERS: u8 = 24;
    let turn = std::f32::consts::TAU / f32::from(CORNERS);
    (0..CORNERS).map(|corner| centre + radius * unit(turn * f32::from(corner))).collect()
}
