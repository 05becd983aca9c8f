//! Requests that move bodies.

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;

use super::requests::{Request, Requests, Shove};
use crate::ball::{Ball, Rolling};
use crate::geometry::{Pose, Twist};
use crate::ids::RobotId;
use crate::physics::Bodies;
use crate::robot::RobotBodies;

type Rolled<'a> = (&'a RapierRigidBodyHandle, &'a mut Pose, &'a mut Twist, &'a mut Rolling);

pub(super) fn shove_bodies(
    requests: Res<Requests>,
    mut bodies: Bodies,
    ball: Single<Rolled, (With<Ball>, Without<RobotId>)>,
    mut robots: Query<(&RobotId, &RobotBodies, &mut Pose, &mut Twist)>,
) {
    let (handle, mut pose, mut twist, mut rolling) = ball.into_inner();
    for request in requests.iter() {
        let Request::Body(shove) = request else { continue };
        match *shove {
            Shove::Ball { at, velocity } => {
                *pose = Pose { position: at, heading: 0.0 };
                *twist = Twist { linear: velocity, angular: 0.0 };
                rolling.0 = velocity;
                bodies.place(handle, *pose);
                if let Some(body) = bodies.get_mut(handle) {
                    body.set_linvel(velocity, true);
                }
            }
            Shove::Push { robot, by } => {
                let found = robots.iter_mut().find(|(id, ..)| **id == robot);
                let Some((_, handles, _, mut twist)) = found else { continue };
                twist.linear += by;
                for handle in [Some(handles.unit), handles.trailer].into_iter().flatten() {
                    if let Some(body) = bodies.get_mut(&handle) {
                        let velocity = body.linvel() + by;
                        body.set_linvel(velocity, true);
                    }
                }
            }
            Shove::Kidnap { robot, to } => {
                let found = robots.iter_mut().find(|(id, ..)| **id == robot);
                let Some((_, handles, mut pose, mut twist)) = found else { continue };
                (*pose, *twist) = (to, Twist::default());
                bodies.place(&handles.unit, to);
                if let Some(trailer) = &handles.trailer {
                    bodies.place(trailer, to);
                }
            }
        }
    }
}
