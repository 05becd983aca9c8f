//! Poses, angles and the two frames of the field.
//!
//! The *pitch frame* is the truth's: x east, y north, the centre spot is the origin. The *team frame* is a robot's: x towards
//! the opponents' goal, y to the left. Beliefs and strategies are in the team frame, so one strategy plays both ends.
//! Egocentric readings are [`Sighting`]s, a type of their own, so they cannot be mixed up with points of the field.

use std::f32::consts::{PI, TAU};

pub use bevy::math::Vec2;
use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::ops;

/// A position in metres and a heading in radians, counter-clockwise from +x.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Reflect)]
#[reflect(Component)]
pub struct Pose {
    /// m.
    pub position: Vec2,
    /// rad, counter-clockwise from the x axis.
    pub heading: f32,
}

impl Pose {
    /// A pose from metres and radians.
    pub const fn new(x: f32, y: f32, heading: f32) -> Pose {
        Pose { position: Vec2::new(x, y), heading }
    }

    /// The unit vector in which this pose looks.
    pub fn forward(self) -> Vec2 {
        unit(self.heading)
    }

    /// A point of the field as this pose has it: x ahead, y to the left.
    pub fn to_local(self, point: Vec2) -> Vec2 {
        self.forward().conjugate_rotate(point - self.position)
    }

    /// A point given ahead and to the left of this pose, as a point of the field.
    pub fn to_field(self, local: Vec2) -> Vec2 {
        self.position + self.forward().rotate(local)
    }

    /// Whether all numbers are finite.
    pub fn is_finite(self) -> bool {
        self.position.is_finite() && self.heading.is_finite()
    }
}

/// Rotation by a unit vector taken as a complex number, and its inverse.
trait UnitRotation {
    fn conjugate_rotate(self, v: Vec2) -> Vec2;
}

impl UnitRotation for Vec2 {
    fn conjugate_rotate(self, v: Vec2) -> Vec2 {
        Vec2::new(self.x * v.x + self.y * v.y, self.x * v.y - self.y * v.x)
    }
}

/// Linear velocity in m/s and angular velocity in rad/s.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Component)]
pub struct Twist {
    /// m/s.
    pub linear: Vec2,
    /// rad/s, counter-clockwise.
    pub angular: f32,
}

impl Twist {
    /// Whether all numbers are finite.
    pub fn is_finite(self) -> bool {
        self.linear.is_finite() && self.angular.is_finite()
    }
}

/// What a camera measures of one thing: the distance in metres and the angle in radians, counter-clockwise from the
/// robot's own heading.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Reflect)]
pub struct Sighting {
    /// m.
    pub range: f32,
    /// rad, counter-clockwise from straight ahead.
    pub bearing: f32,
}

impl Sighting {
    /// The noise-free sighting of a point from a pose.
    pub fn of(point: Vec2, from: Pose) -> Sighting {
        let offset = point - from.position;
        Sighting { range: offset.length(), bearing: wrap_angle(angle(offset) - from.heading) }
    }

    /// Where the sighted thing is, if the robot is at this pose.
    pub fn placed(self, from: Pose) -> Vec2 {
        from.position + unit(from.heading + self.bearing) * self.range
    }
}

/// The unit vector at an angle in radians.
pub fn unit(angle: f32) -> Vec2 {
    let (sin, cos) = ops::sin_cos(angle);
    Vec2::new(cos, sin)
}

/// The angle of a vector in radians, in (-π, π]; 0 for the zero vector.
pub fn angle(v: Vec2) -> f32 {
    ops::atan2(v.y, v.x)
}

/// The same angle in [-π, π].
pub fn wrap_angle(angle: f32) -> f32 {
    if angle.abs() <= PI {
        return angle;
    }
    let turned = angle + PI;
    // What the remainder is within a turn to either side, to the bit; it costs as much as a sine.
    let within = match turned {
        _ if (TAU..2.0 * TAU).contains(&turned) => turned - TAU,
        _ if (-TAU..0.0).contains(&turned) => turned + TAU,
        _ => turned.rem_euclid(TAU),
    };
    let wrapped = within - PI;
    if wrapped.is_finite() { wrapped } else { 0.0 }
}

/// Which way a team attacks: the turn between the pitch frame and its team frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, Reflect)]
pub enum Attacking {
    /// Towards positive x, as home does at the start.
    #[default]
    East,
    /// Towards negative x.
    West,
}

impl Attacking {
    /// The other end.
    pub fn reversed(self) -> Attacking {
        match self {
            Attacking::East => Attacking::West,
            Attacking::West => Attacking::East,
        }
    }

    /// A vector or point of the pitch in the team's frame, or back: the turn is its own inverse.
    pub fn turn(self, v: Vec2) -> Vec2 {
        match self {
            Attacking::East => v,
            Attacking::West => -v,
        }
    }

    /// A pose of the pitch in the team's frame, or back.
    pub fn turn_pose(self, pose: Pose) -> Pose {
        match self {
            Attacking::East => pose,
            Attacking::West => Pose { position: -pose.position, heading: wrap_angle(pose.heading + PI) },
        }
    }
}

/// An axis-parallel rectangle in metres; corners may lie outside the pitch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Reflect)]
#[serde(deny_unknown_fields)]
pub struct Zone {
    /// The corner with the least x and y, m.
    pub min: Vec2,
    /// The corner with the greatest x and y, m.
    pub max: Vec2,
}

impl Zone {
    /// Whether a point lies in it, the border included.
    pub fn contains(self, point: Vec2) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }

    /// This zone, wider by so much on every side.
    pub fn grown(self, by: f32) -> Zone {
        Zone { min: self.min - by, max: self.max + by }
    }

    /// The point of the zone that is nearest to `point`.
    pub fn clamp(self, point: Vec2) -> Vec2 {
        point.clamp(self.min, self.max)
    }

    /// This zone on a pitch that is stretched by a factor along each axis.
    pub fn scaled(self, scale: Vec2) -> Zone {
        Zone { min: self.min * scale, max: self.max * scale }
    }

    /// Whether all numbers are finite.
    pub fn is_finite(self) -> bool {
        self.min.is_finite() && self.max.is_finite() && self.min.cmple(self.max).all()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_local_point_comes_back_to_the_field() {
        let pose = Pose::new(1.0, -2.0, 0.7);
        let point = Vec2::new(-0.3, 2.2);
        assert!((pose.to_field(pose.to_local(point)) - point).length() < 1e-6);
        assert!((Sighting::of(point, pose).placed(pose) - point).length() < 1e-5);
    }

    #[test]
    fn ahead_is_positive_x_and_left_is_positive_y() {
        let north = Pose::new(0.0, 0.0, PI / 2.0);
        let local = north.to_local(Vec2::new(-1.0, 2.0));
        assert!((local - Vec2::new(2.0, 1.0)).length() < 1e-6, "{local}");
    }

    #[test]
    fn angles_wrap_to_half_a_turn() {
        assert!((wrap_angle(3.0 * PI) - -PI).abs() < 1e-5);
        assert!((wrap_angle(-3.5 * PI) - 0.5 * PI).abs() < 1e-5);
        assert_eq!(wrap_angle(1.0), 1.0);
    }

    proptest! {
        #[test]
        fn a_wrapped_angle_is_the_remainder_to_the_bit(turns in -3.0_f32..3.0, ulps in -4_i32..=4) {
            let near = |angle: f32| f32::from_bits(angle.to_bits().wrapping_add_signed(ulps));
            for angle in [turns * TAU, near(turns.round() * PI), near(turns.round() * TAU)] {
                let remainder = (angle + PI).rem_euclid(TAU) - PI;
                let expected = if angle.abs() <= PI { angle } else if remainder.is_finite() { remainder } else { 0.0 };
                prop_assert_eq!(wrap_angle(angle).to_bits(), expected.to_bits(), "{}", angle);
            }
        }
    }

    #[test]
    fn turning_ends_twice_changes_nothing() {
        let pose = Pose::new(1.0, -2.0, 0.7);
        let back = Attacking::West.turn_pose(Attacking::West.turn_pose(pose));
        assert!(
            (back.position - pose.position).length() < 1e-6 && (back.heading - pose.heading).abs() < 1e-5
        );
    }
}
