//! What a robot is made of, as data: body, drive, trailer and scoop. Read from `assets/robots/*.ron`.
//!
//! Lengths are metres, masses kilograms, forces newtons, angles degrees. A body's origin is its drive unit's centre.

use std::collections::BTreeMap;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::legs::{Chin, Kick, Neck, Walker};
use crate::data::Bounds;

/// One kind of robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotKind {
    pub name: String,
    /// How often the robot's control system decides, per second.
    pub control_hz: f32,
    pub body: Body,
    pub drive: Drive,
    #[serde(default)]
    pub trailer: Option<TrailerKind>,
    #[serde(default)]
    pub scoop: Option<Scoop>,
    #[serde(default)]
    pub neck: Option<Neck>,
    #[serde(default)]
    pub chin: Option<Chin>,
    /// By name.
    #[serde(default)]
    pub kicks: BTreeMap<String, Kick>,
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

/// How a robot moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Drive {
    Differential(DifferentialDrive),
    Walker(Walker),
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
        let parts = [
            Some(self.body_bounds()),
            Some(match &self.drive {
                Drive::Differential(drive) => drive.bounds(),
                Drive::Walker(walker) => walker.bounds(),
            }),
            self.trailer.as_ref().map(TrailerKind::bounds),
            self.scoop.as_ref().map(Scoop::bounds),
            self.neck.as_ref().map(Neck::bounds),
            self.chin.as_ref().map(Chin::bounds),
        ];
        let kicks = self.kicks.values().map(Kick::bounds);
        let fault = parts.into_iter().flatten().chain(kicks).find_map(Bounds::fault);
        fault.or_else(|| {
            let outline = &self.trailer.as_ref()?.outline;
            (outline.len() < 3 || outline.iter().any(|corner| !corner.is_finite()))
                .then(|| ("trailer.outline", "needs at least three corners, all of them finite".into()))
        })
    }

    fn body_bounds(&self) -> Bounds {
        Bounds {
            positive: vec![
                ("control_hz", self.control_hz),
                ("body.length", self.body.length),
                ("body.width", self.body.width),
                ("body.mass", self.body.mass),
            ],
            at_least_0: vec![
                ("body.friction", self.body.friction),
                ("body.restitution", self.body.restitution),
            ],
            shares: vec![],
        }
    }

    /// The radius of a circle around the drive unit that holds body and jaws, m.
    pub fn reach(&self) -> f32 {
        let front = self.body.length / 2.0 + self.scoop.map_or(0.0, |scoop| scoop.depth);
        Vec2::new(front, self.body.width / 2.0).length()
    }

    /// The fastest that the robot drives, m/s.
    pub fn max_speed(&self) -> f32 {
        match self.drive {
            Drive::Differential(drive) => drive.max_speed,
            Drive::Walker(walker) => walker.ahead,
        }
    }

    /// The fastest that the robot turns, rad/s.
    pub fn max_turn(&self) -> f32 {
        match self.drive {
            Drive::Differential(drive) => drive.turn_rate.to_radians(),
            Drive::Walker(walker) => walker.turn.to_radians(),
        }
    }
}

impl DifferentialDrive {
    fn bounds(&self) -> Bounds {
        Bounds {
            positive: vec![
                ("drive.track", self.track),
                ("drive.max_speed", self.max_speed),
                ("drive.acceleration", self.acceleration),
                ("drive.wheel_force", self.wheel_force),
                ("drive.grip", self.grip),
                ("drive.turn_gain", self.turn_gain),
                ("drive.turn_rate", self.turn_rate),
            ],
            at_least_0: vec![("drive.dead_band", self.dead_band)],
            shares: vec![],
        }
    }
}

impl TrailerKind {
    fn bounds(&self) -> Bounds {
        Bounds {
            positive: vec![("trailer.mass", self.mass), ("trailer.axle", self.axle)],
            at_least_0: vec![
                ("trailer.grip", self.grip),
                ("trailer.rolling", self.rolling),
                ("trailer.friction", self.friction),
                ("trailer.restitution", self.restitution),
            ],
            shares: vec![],
        }
    }
}

impl Scoop {
    fn bounds(&self) -> Bounds {
        Bounds {
            positive: vec![
                ("scoop.depth", self.depth),
                ("scoop.half_gap", self.half_gap),
                ("scoop.jaw", self.jaw),
            ],
            at_least_0: vec![
                ("scoop.hold_force", self.hold_force),
                ("scoop.hold_stiffness", self.hold_stiffness),
                ("scoop.hold_damping", self.hold_damping),
                ("scoop.hold_reach", self.hold_reach),
                ("scoop.hold_half_width", self.hold_half_width),
            ],
            shares: vec![],
        }
    }
}
