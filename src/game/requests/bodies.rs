//! Requests that move bodies.

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;

use super::queue::Requests;
use super::request::{BodyChange, Request};
use crate::data::Bound;
use crate::geometry::{Pose, Twist};
use crate::ids::RobotId;
use crate::robot::RobotBodies;
use crate::world::ball::{Ball, Rolling};
use crate::world::physics::Room;

type Rolled<'a> = (&'a RapierRigidBodyHandle, &'a mut Pose, &'a mut Twist, &'a mut Rolling);

pub(super) fn move_bodies(
    requests: Res<Requests>,
    mut room: Room,
    ball: Single<Rolled, (With<Ball>, Without<RobotId>)>,
    mut robots: Query<(&RobotId, &RobotBodies, &mut Pose, &mut Twist)>,
) {
    let (handle, mut pose, mut twist, mut rolling) = ball.into_inner();
    for request in requests.due() {
        let Request::Body(change) = request else { continue };
        match *change {
            BodyChange::Ball { at, velocity } => {
                let velocity = Bound::VELOCITY.clamp_vector(velocity);
                let wanted = Pose { position: Bound::PLACE.clamp_vector(at), heading: 0.0 };
                *pose = room.put_down(&[*handle], wanted, &[]);
                *twist = Twist { linear: velocity, angular: 0.0 };
                rolling.0 = velocity;
                if let Some(body) = room.bodies.get_mut(handle) {
                    body.set_linvel(velocity, true);
                }
            }
            BodyChange::Push { robot, by } => {
                let found = robots.iter_mut().find(|(id, ..)| **id == robot);
                let Some((_, handles, _, mut twist)) = found else { continue };
                let by = Bound::VELOCITY.clamp_vector(by);
                twist.linear += by;
                for handle in handles.all() {
                    if let Some(body) = room.bodies.get_mut(&handle) {
                        let velocity = body.linvel() + by;
                        body.set_linvel(velocity, true);
                    }
                }
            }
            BodyChange::Kidnap { robot, to } if to.is_finite() => {
                let found = robots.iter_mut().find(|(id, ..)| **id == robot);
                let Some((_, handles, mut pose, mut twist)) = found else { continue };
                let place = Bound::PLACE.clamp_vector(to.position);
                let wanted = Pose { position: place, ..to };
                (*pose, *twist) = (room.put_down(&handles.all(), wanted, &[]), Twist::default());
            }
            BodyChange::Kidnap { .. } => {}
        }
    }
}
