//! What moves, at a moment: robots and the ball.

use bevy::math::Vec2;

use super::material::Material;
use super::raster::Raster;
use super::shot::Viewpoint;
use super::solid::{Outline, Solids, circle, level, rectangle};
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::ops;
use crate::robot::{Drive, RobotKind, jaws};
use crate::vision::ColourClass;
use crate::vision::paint::{HeightBand, RobotPaint};

/// Where ball and robots are when a picture is taken. Made once for a tick, for the cameras of all robots.
#[derive(Clone, Debug, Default)]
pub struct Moment {
    /// Where the ball lies, if there is one.
    pub ball: Option<Vec2>,
    /// Of robots.
    pub solids: Solids,
    shadows: Vec<Shadow>,
}

/// A part of the floor that gets less light.
#[derive(Clone, Debug)]
struct Shadow {
    owner: Option<RobotId>,
    outline: Outline,
    /// 256ths of the light.
    left: u16,
}

/// How far a shadow reaches beyond a robot that throws it, m, and how much light it leaves, in 256ths: the core after the edge.
/// ASSUMPTION: many lamps, so that there is hardly more than the dark under a body.
const SHADOWS: [(f32, u16); 2] = [(0.07, 215), (0.025, 190)];
/// Of an AIBO's head, from its front to the middle and half across, m. ASSUMPTION.
const HEAD: (f32, f32) = (0.05, 0.05);
/// Of an AIBO's head above its body, m. ASSUMPTION.
const NECK: f32 = 0.08;
/// Half across the shaft of a Cye and the camera on it, m. ASSUMPTION.
const SHAFT: (f32, f32) = (0.015, 0.035);
/// Of a Cye's jaws, m. ASSUMPTION: the paper calls the scoop shallow.
const JAWS: f32 = 0.06;

/// What a robot's parts are made of.
#[derive(Clone, Copy)]
struct Looks {
    robot: RobotId,
    paint: RobotPaint,
    body: Material,
    marker: Material,
}

impl Moment {
    /// Forgets all, to be filled anew.
    pub fn clear(&mut self) {
        self.ball = None;
        self.solids.clear();
        self.shadows.clear();
    }

    /// Adds a robot that stands there, with its head turned to the left by so many radians, and its trailer, where it is.
    pub fn add(&mut self, robot: RobotId, kind: &RobotKind, pose: Pose, head: f32, trailer: Option<Pose>) {
        let paint = robot_paint(kind);
        let (body, marker) = (Material::body(paint.body), Material::of(ColourClass::marker(robot.team)));
        let looks = Looks { robot, paint, body, marker };
        let half = Vec2::new(kind.body.length, kind.body.width) / 2.0;
        let outline = placed(&rectangle(Vec2::ZERO, half), pose);
        self.add_shadow(robot, &outline);
        match paint.marker_radius {
            None => self.add_shirt(&looks, &outline, (pose, half.x, head)),
            Some(radius) => self.add_shaft(&looks, &outline, (pose, radius)),
        }
        for jaw in jaws(kind) {
            let mut outline = placed(&jaw, pose);
            if (outline[1] - outline[0]).perp_dot(outline[2] - outline[0]) < 0.0 {
                outline.reverse();
            }
            self.column(&looks, &outline, HeightBand { bottom: 0.0, top: JAWS });
        }
        if let (Some(kind), Some(hitch)) = (&kind.trailer, trailer) {
            let outline = placed(&kind.outline, hitch);
            self.add_shadow(robot, &outline);
            self.column(&looks, &outline, HeightBand { bottom: 0.0, top: paint.height });
        }
    }

    /// A body with a band around it, and a head in front.
    fn add_shirt(&mut self, looks: &Looks, outline: &[Vec2], (pose, front, turn): (Pose, f32, f32)) {
        let (owner, HeightBand { bottom, top }) = (Some(looks.robot), looks.paint.marker);
        let back = looks.paint.height - NECK;
        self.solids.sides(owner, outline, HeightBand { bottom: 0.0, top: bottom }, looks.body);
        self.solids.sides(owner, outline, looks.paint.marker, looks.marker);
        self.column(looks, outline, HeightBand { bottom: top, top: back });
        let neck = Pose { position: pose.to_field(Vec2::X * (front - HEAD.0)), heading: pose.heading + turn };
        let head = placed(&rectangle(Vec2::ZERO, Vec2::new(HEAD.0, HEAD.1)), neck);
        self.column(looks, &head, HeightBand { bottom: back, top: looks.paint.height });
    }

    /// A body with a shaft on it, that carries a camera and above it a round marker.
    fn add_shaft(&mut self, looks: &Looks, outline: &[Vec2], (pose, radius): (Pose, f32)) {
        let RobotPaint { height, marker, .. } = looks.paint;
        self.column(looks, outline, HeightBand { bottom: 0.0, top: height });
        let square = |half: f32| placed(&rectangle(Vec2::ZERO, Vec2::splat(half)), pose);
        self.solids.sides(
            Some(looks.robot),
            &square(SHAFT.0),
            HeightBand { bottom: height, top: marker.bottom },
            looks.body,
        );
        let round = circle(pose.position, radius);
        self.solids.sides(Some(looks.robot), &round, marker, looks.marker);
        self.solids.top(Some(looks.robot), &round, marker.top, looks.marker);
        let camera = (height + marker.bottom) / 2.0;
        let box_of_camera = HeightBand { bottom: camera - SHAFT.1, top: camera + SHAFT.1 };
        self.column(looks, &square(SHAFT.1), box_of_camera);
    }

    fn column(&mut self, looks: &Looks, outline: &[Vec2], band: HeightBand) {
        self.solids.sides(Some(looks.robot), outline, band, looks.body);
        self.solids.top(Some(looks.robot), outline, band.top, looks.body);
    }

    fn add_shadow(&mut self, robot: RobotId, outline: &[Vec2]) {
        for (beyond, left) in SHADOWS {
            self.shadows.push(Shadow { owner: Some(robot), outline: grown(outline, beyond), left });
        }
    }

    /// Darkens the floor under everything but a robot. The ball has a shadow, if it has a radius.
    pub fn cast(&self, view: &Viewpoint, except: RobotId, ball: Option<(Vec2, f32)>, raster: &mut Raster) {
        let mut darken = |outline: &[Vec2], left| {
            raster.darken(view, &level(view, outline, 0.0, |_| 0.0), left);
        };
        for shadow in self.shadows.iter().filter(|shadow| shadow.owner != Some(except)) {
            darken(&shadow.outline, shadow.left);
        }
        if let Some((at, radius)) = ball {
            SHADOWS
                .iter()
                .for_each(|(beyond, left)| darken(&circle(at, radius * (0.9 + 5.0 * beyond)), *left));
        }
    }
}

/// How robots of a kind are painted.
pub fn robot_paint(kind: &RobotKind) -> RobotPaint {
    match kind.drive {
        Drive::Walker(_) => RobotPaint::WALKER,
        Drive::Differential(_) => RobotPaint::WHEELED,
    }
}

fn placed(outline: &[Vec2], pose: Pose) -> Outline {
    let (sin, cos) = ops::sin_cos(pose.heading);
    outline.iter().map(|corner| pose.position + Vec2::new(cos, sin).rotate(*corner)).collect()
}

/// An outline whose corners are farther out.
fn grown(outline: &[Vec2], by: f32) -> Outline {
    let middle = outline.iter().sum::<Vec2>() / outline.len() as f32;
    outline.iter().map(|corner| *corner + (*corner - middle).normalize_or_zero() * by).collect()
}
