//! The ball as data.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all};

/// A ball as data; part of a match file.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BallKind {
    /// m
    pub radius: f32,
    /// kg
    pub mass: f32,
    /// Deceleration of a rolling ball, m/s².
    pub rolling: f32,
    /// Deceleration of a sliding ball, m/s².
    pub sliding: f32,
    /// Moment of inertia over mass and squared radius: 2/3 for a hollow ball, 2/5 for a solid one.
    pub inertia: f32,
    /// The coefficient of friction with bodies.
    pub friction: f32,
    /// Share of the normal speed kept at a bounce; the higher of the two bodies' values counts.
    pub restitution: f32,
    /// Standard deviation of the heading after one metre of rolling, degrees.
    pub wander: f32,
}

impl Validate for BallKind {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("radius", self.radius, Bound::SIZE.positive()),
            ("mass", self.mass, Bound::MASS.positive()),
            ("rolling", self.rolling, Bound::ACCELERATION.positive()),
            ("sliding", self.sliding, Bound::ACCELERATION.positive()),
            ("inertia", self.inertia, Bound::COEFFICIENT.positive()),
            ("friction", self.friction, Bound::COEFFICIENT),
            ("restitution", self.restitution, Bound::SHARE),
            ("wander", self.wander, Bound::ANGLE),
        ])
    }
}
