//! Where Rapier's bodies are. Its own angles and rotations go by the platform's sines.

use bevy_rapier2d::parry::math::Pose as Isometry;
use bevy_rapier2d::rapier::dynamics::RigidBody as Body;
use bevy_rapier2d::rapier::math::Rotation;

use crate::geometry::{Pose, Vec2, angle, unit};

/// Where a body is.
pub(super) fn pose_of(body: &Body) -> Pose {
    let rotation = body.rotation();
    Pose { position: body.translation(), heading: angle(Vec2::new(rotation.cos(), rotation.sin())) }
}

/// Turns a body to a heading, rad.
pub(super) fn turn(body: &mut Body, heading: f32) {
    body.set_rotation(rotation(heading), true);
}

/// A pose as Parry and Rapier have it.
pub(super) fn isometry(pose: Pose) -> Isometry {
    Isometry::from_parts(pose.position, rotation(pose.heading))
}

fn rotation(heading: f32) -> Rotation {
    let Vec2 { x, y } = unit(heading);
    Rotation::from_cos_sin_unchecked(x, y)
}
