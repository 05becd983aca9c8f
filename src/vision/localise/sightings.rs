//! What a pose filter is told: landmarks that were seen, and how wrong things may be.

use std::f32::consts::PI;

use bevy::math::Vec2;

use crate::geometry::Sighting;

/// A landmark that a picture shows: where it stands in the robot's frame of the field, m, and how it was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenLandmark {
    /// m
    pub place: Vec2,
    /// How the robot's body has it.
    pub sighting: Sighting,
    /// Standard deviation of its range, m.
    pub range_deviation: f32,
}

/// Standard deviations of a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseDeviation {
    /// Of each coordinate, m.
    pub place: f32,
    /// rad
    pub heading: f32,
}

/// What the filter takes odometry and sightings to be wrong by: standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterErrors {
    /// Of a bearing, rad.
    pub bearing: f32,
    /// How long the error of one landmark lasts, s: frames that follow each other sooner err alike.
    pub lasting: f32,
    /// Of odometry, after one metre; grows with the root of the way, m.
    pub way: f32,
    /// Of odometry, after one metre; grows with the root of the way, rad.
    pub turn: f32,
    /// What pushes and slips that nobody feels move a robot by in a second; grows with the root of the time.
    pub unfelt: PoseDeviation,
}

/// No landmark is measured better, m.
pub(super) const LEAST_RANGE: f32 = 0.005;

impl SeenLandmark {
    pub(super) fn is_sound(&self) -> bool {
        self.place.is_finite() && self.sighting.bearing.abs() <= PI && self.range_deviation.is_finite()
    }
}
