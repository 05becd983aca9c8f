//! What a robot is made of, as data: body, drive, trailer and scoop. Read from `assets/robots/*.ron`.
//!
//! Lengths are metres, masses kilograms, forces newtons, angles degrees. A body's origin is its drive unit's centre.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

/// One kind of robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotKind {
    pub name: String,
    /// How often the robot's control system decides, per second.
    pub control_hz: f32,
    pub body: Body,
    pub drive: Drive,
    pub trailer: Option<TrailerKind>,
    pub scoop: Option<Scoop>,
}

/// The rigid body that carries the camera: a box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Fore and aft.
    pub length: f32,
    pub width: f32,
    pub mass: f32,
    pub friction: f32,
    pub restitution: f32,
}

/// How a robot moves. An omnidirectional walker joins here.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Drive {
    Differential(DifferentialDrive),
}

/// Two driven wheels on one axle under the body's centre.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DifferentialDrive {
    /// Distance between the wheels.
    pub track: f32,
    /// Top speed of a wheel over the ground, m/s.
    pub max_speed: f32,
    /// How fast a wheel's speed may be changed, m/s².
    pub acceleration: f32,
    /// Most that one wheel can push, N.
    pub wheel_force: f32,
    /// Coefficient of friction of the tyres, forward and sideways together.
    pub grip: f32,
    /// Heading errors below this are not corrected while standing, degrees.
    pub dead_band: f32,
    /// Turn rate per heading error while turning on the spot, 1/s.
    pub turn_gain: f32,
    /// Fastest turn on the spot, degrees/s.
    pub turn_rate: f32,
}

/// A passive trailer on a revolute joint at the drive unit's centre. Without a limit, as a slip ring allows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrailerKind {
    /// Corners of its convex outline, seen from the hitch, x ahead.
    pub outline: Vec<Vec2>,
    pub mass: f32,
    /// From the hitch back to the axle.
    pub axle: f32,
    pub grip: f32,
    /// Rolling resistance as a share of the weight.
    pub rolling: f32,
    pub friction: f32,
    pub restitution: f32,
}

/// A shallow scoop on the front: two jaws, and a spring that holds the ball between them, weakly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scoop {
    /// How far the jaws reach ahead of the body.
    pub depth: f32,
    /// Half of the gap between the jaws.
    pub half_gap: f32,
    /// Thickness of a jaw at its root.
    pub jaw: f32,
    /// The most that the hold pulls, N.
    pub hold_force: f32,
    /// N/m.
    pub hold_stiffness: f32,
    /// N·s/m.
    pub hold_damping: f32,
    /// The hold acts up to this gap between body and ball.
    pub hold_reach: f32,
    /// The hold acts on a ball that is no farther than this off the middle.
    pub hold_half_width: f32,
}

impl RobotKind {
    /// What is wrong with the numbers, as the field's path and a reason; `None` for a sound robot.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        let Drive::Differential(drive) = self.drive;
        let mut positive = vec![
            ("control_hz", self.control_hz),
            ("body.length", self.body.length),
            ("body.width", self.body.width),
            ("body.mass", self.body.mass),
            ("drive.track", drive.track),
            ("drive.max_speed", drive.max_speed),
            ("drive.acceleration", drive.acceleration),
            ("drive.wheel_force", drive.wheel_force),
            ("drive.grip", drive.grip),
            ("drive.turn_gain", drive.turn_gain),
            ("drive.turn_rate", drive.turn_rate),
        ];
        let mut not_negative = vec![
            ("body.friction", self.body.friction),
            ("body.restitution", self.body.restitution),
            ("drive.dead_band", drive.dead_band),
        ];
        if let Some(trailer) = &self.trailer {
            positive.extend([("trailer.mass", trailer.mass), ("trailer.axle", trailer.axle)]);
            not_negative.extend([
                ("trailer.grip", trailer.grip),
                ("trailer.rolling", trailer.rolling),
                ("trailer.friction", trailer.friction),
                ("trailer.restitution", trailer.restitution),
            ]);
        }
        if let Some(scoop) = self.scoop {
            positive.extend([
                ("scoop.depth", scoop.depth),
                ("scoop.half_gap", scoop.half_gap),
                ("scoop.jaw", scoop.jaw),
            ]);
            not_negative.extend([
                ("scoop.hold_force", scoop.hold_force),
                ("scoop.hold_stiffness", scoop.hold_stiffness),
                ("scoop.hold_damping", scoop.hold_damping),
                ("scoop.hold_reach", scoop.hold_reach),
                ("scoop.hold_half_width", scoop.hold_half_width),
            ]);
        }
        if let Some((field, value)) = positive.into_iter().find(|(_, v)| !(v.is_finite() && *v > 0.0)) {
            return Some((field, format!("must be a positive number, not {value}")));
        }
        if let Some((field, value)) = not_negative.into_iter().find(|(_, v)| !(v.is_finite() && *v >= 0.0)) {
            return Some((field, format!("must not be negative, but is {value}")));
        }
        let outline = &self.trailer.as_ref()?.outline;
        (outline.len() < 3 || outline.iter().any(|corner| !corner.is_finite()))
            .then(|| ("trailer.outline", "needs at least three corners, all of them finite".into()))
    }

    /// The radius of a circle around the drive unit that holds body and jaws, m.
    pub fn reach(&self) -> f32 {
        let front = self.body.length / 2.0 + self.scoop.map_or(0.0, |scoop| scoop.depth);
        Vec2::new(front, self.body.width / 2.0).length()
    }

    /// The fastest that the robot drives, m/s.
    pub fn max_speed(&self) -> f32 {
        let Drive::Differential(drive) = self.drive;
        drive.max_speed
    }
}
