//! Hands that move bodies between two steps, as commands.

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

use super::Bodies;
use super::room::Room;
use crate::geometry::{Pose, Twist};
use crate::robot::RobotBodies;

/// Where a robot or the ball is to be put.
#[derive(Clone, Debug, Default)]
pub struct Put {
    /// In the pitch frame; as near to it as there is room.
    pub at: Pose,
    /// m/s
    pub velocity: Vec2,
    /// Bodies that are carried as well, and in nobody's way.
    pub lifted: Vec<RapierRigidBodyHandle>,
}

impl Put {
    /// Puts a robot or the ball there, then does something with the pose that it came to.
    pub fn then(self, next: impl FnOnce(&mut World, Entity, Pose) + Send + 'static) -> impl EntityCommand {
        move |mut target: EntityWorldMut| {
            let entity = target.id();
            target.world_scope(|world| {
                if let Ok(pose) = world.run_system_cached_with(put_down, (entity, self)) {
                    next(world, entity, pose);
                }
            });
        }
    }
}

type Movable<'a> = (&'a RapierRigidBodyHandle, Option<&'a RobotBodies>, &'a mut Pose, &'a mut Twist);

fn handles(own: &RapierRigidBodyHandle, robot: Option<&RobotBodies>) -> SmallVec<[RapierRigidBodyHandle; 2]> {
    robot.map_or_else(|| SmallVec::from_iter([*own]), RobotBodies::all)
}

fn put_down(In((entity, put)): In<(Entity, Put)>, mut room: Room, mut movable: Query<Movable>) -> Pose {
    let Ok((own, robot, mut pose, mut twist)) = movable.get_mut(entity) else { return put.at };
    *pose = room.put_down(&handles(own, robot), put.at, &put.lifted);
    *twist = Twist { linear: put.velocity, angular: 0.0 };
    if let Some(body) = room.bodies.get_mut(own).filter(|_| put.velocity != Vec2::ZERO) {
        body.set_linvel(put.velocity, true);
    }
    *pose
}

/// Adds to a robot's velocity, m/s in the pitch frame.
pub fn push(by: Vec2) -> impl EntityCommand {
    move |mut target: EntityWorldMut| {
        let entity = target.id();
        // A robot that is not there cannot be pushed.
        let _ = target.world_scope(|world| world.run_system_cached_with(push_bodies, (entity, by)));
    }
}

fn push_bodies(In((entity, by)): In<(Entity, Vec2)>, mut bodies: Bodies, mut movable: Query<Movable>) {
    let Ok((own, robot, _, mut twist)) = movable.get_mut(entity) else { return };
    twist.linear += by;
    for handle in handles(own, robot) {
        if let Some(body) = bodies.get_mut(&handle) {
            body.set_linvel(body.linvel() + by, true);
        }
    }
}
