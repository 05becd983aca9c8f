//! What a robot is made of, as data: body, drive, trailer and scoop. Read from `assets/robots/*.ron`.
//!
//! Lengths are metres, masses kilograms, forces newtons, angles degrees. A body's origin is its drive unit's centre.

use std::collections::BTreeMap;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::bump::BumpSensing;
use super::footing::ContactCost;
use super::legs::{Chin, Kick, Neck, Strike, Walker};
use crate::data::{Bound, Fault, Field, Validate, check_all, check_count, ensure};

/// One kind of robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotKind {
    /// Its name for people.
    pub name: String,
    /// How often the robot's control system decides, per second.
    pub control_hz: f32,
    /// The drive unit, or the whole robot on legs.
    pub body: Body,
    /// How it moves.
    pub drive: Drive,
    /// What touching other robots costs it; nothing, if not given.
    #[serde(default)]
    pub contact: Option<ContactCost>,
    /// How its drive notices that it is blocked; not at all, if not given. Legs have no wheels whose turns could be measured.
    #[serde(default)]
    pub bump: Option<BumpSensing>,
    /// What it pulls.
    #[serde(default)]
    pub trailer: Option<TrailerKind>,
    /// The jaws in front.
    #[serde(default)]
    pub scoop: Option<Scoop>,
    /// How far and fast the head turns.
    #[serde(default)]
    pub neck: Option<Neck>,
    /// How the ball is held under the head.
    #[serde(default)]
    pub chin: Option<Chin>,
    /// Where kicks meet the ball. If not given, a kick has all its force wherever the ball lies before the body.
    #[serde(default)]
    pub strike: Option<Strike>,
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
    /// Across, m.
    pub width: f32,
    /// kg.
    pub mass: f32,
    /// The coefficient of friction.
    pub friction: f32,
    /// The coefficient of restitution.
    pub restitution: f32,
}

/// How a robot moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Drive {
    /// On two wheels.
    Differential(DifferentialDrive),
    /// On legs.
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
    /// kg.
    pub mass: f32,
    /// From the hitch back to the axle.
    pub axle: f32,
    /// The coefficient of friction of its wheels on the carpet.
    pub grip: f32,
    /// Rolling resistance as a share of the weight.
    pub rolling: f32,
    /// The coefficient of friction.
    pub friction: f32,
    /// The coefficient of restitution.
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

impl Validate for RobotKind {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("control_hz", self.control_hz, Bound::RATE.positive()),
            ("body.length", self.body.length, Bound::SIZE.positive()),
            ("body.width", self.body.width, Bound::SIZE.positive()),
            ("body.mass", self.body.mass, Bound::MASS.positive()),
            ("body.friction", self.body.friction, Bound::COEFFICIENT),
            ("body.restitution", self.body.restitution, Bound::SHARE),
        ])?;
        match &self.drive {
            Drive::Differential(drive) => drive.validate_as("drive")?,
            Drive::Walker(walker) => walker.validate_as("drive")?,
        }
        self.contact.validate_as("contact")?;
        let has_wheels = matches!(self.drive, Drive::Differential(_));
        ensure(has_wheels || self.bump.is_none(), "bump", || "legs have no wheels to measure".into())?;
        self.bump.validate_as("bump")?;
        self.trailer.validate_as("trailer")?;
        self.scoop.validate_as("scoop")?;
        self.neck.validate_as("neck")?;
        self.chin.validate_as("chin")?;
        self.strike.validate_as("strike")?;
        let kicks = || self.kicks.iter().try_for_each(|(name, kick)| kick.validate_as(name));
        kicks().map_err(|fault| fault.inside(&Field::root().key("kicks")))
    }
}

impl RobotKind {
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

impl Validate for DifferentialDrive {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("track", self.track, Bound::SIZE.positive()),
            ("max_speed", self.max_speed, Bound::SPEED.positive()),
            ("acceleration", self.acceleration, Bound::ACCELERATION.positive()),
            ("wheel_force", self.wheel_force, Bound::FORCE.positive()),
            ("grip", self.grip, Bound::COEFFICIENT.positive()),
            ("turn_gain", self.turn_gain, Bound::GAIN.positive()),
            ("turn_rate", self.turn_rate, Bound::TURN_RATE.positive()),
            ("dead_band", self.dead_band, Bound::ANGLE),
        ])
    }
}

impl TrailerKind {
    /// The middle of its outline as seen from the hitch, and the radius around that middle that holds it, m.
    pub fn round(&self) -> (Vec2, f32) {
        let middle = self.outline.iter().sum::<Vec2>() / self.outline.len() as f32;
        (middle, self.outline.iter().map(|corner| corner.distance(middle)).fold(0.0, f32::max))
    }
}

impl Validate for TrailerKind {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("mass", self.mass, Bound::MASS.positive()),
            ("axle", self.axle, Bound::SIZE.positive()),
            ("grip", self.grip, Bound::COEFFICIENT),
            ("rolling", self.rolling, Bound::COEFFICIENT),
            ("friction", self.friction, Bound::COEFFICIENT),
            ("restitution", self.restitution, Bound::SHARE),
        ])?;
        check_count("outline", "the number of corners", self.outline.len(), 3..=MOST_CORNERS)?;
        Bound::CORNER.check_points("outline", &self.outline)?;
        let spread = |from: Vec2| {
            let ways = self.outline.iter().map(|corner| *corner - from);
            ways.map(|way| way.perp_dot(self.outline[1] - from).abs()).fold(0.0, f32::max)
        };
        let is_flat = spread(self.outline[0]) < LEAST_AREA;
        ensure(!is_flat, "outline", || "its corners lie on one line, or nearly so".into())
    }
}

/// Corners of a trailer.
const MOST_CORNERS: usize = 64;
/// What a trailer covers, m².
const LEAST_AREA: f32 = 1e-4;

impl Validate for Scoop {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("depth", self.depth, Bound::SIZE.positive()),
            ("half_gap", self.half_gap, Bound::SIZE.positive()),
            ("jaw", self.jaw, Bound::SIZE.positive()),
            ("hold_force", self.hold_force, Bound::FORCE),
            ("hold_stiffness", self.hold_stiffness, Bound::STIFFNESS),
            ("hold_damping", self.hold_damping, Bound::DAMPING),
            ("hold_reach", self.hold_reach, Bound::SIZE),
            ("hold_half_width", self.hold_half_width, Bound::SIZE),
        ])
    }
}
