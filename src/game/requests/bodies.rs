//! Requests that move bodies.

use bevy::prelude::*;

use super::queue::Requests;
use super::request::{BodyChange, Request};
use crate::data::Bound;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::pitch::Pitch;
use crate::state::apply_event;
use crate::world::ball::{Ball, BallPut};
use crate::world::physics::{Put, push};

pub(super) fn move_bodies(
    (requests, pitch): (Res<Requests>, Res<Pitch>),
    mut commands: Commands,
    ball: Single<Entity, With<Ball>>,
    robots: Query<(Entity, &RobotId)>,
) {
    // Nobody's hand reaches beyond the margin and the goals.
    let in_reach = |at: Vec2| {
        let (at, reach) = (Bound::PLACE.clamp_vector(at), pitch.half_size() + pitch.margin());
        if pitch.holds(at, pitch.margin()) { at } else { at.clamp(-reach, reach) }
    };
    let entity_of = |wanted: RobotId| robots.iter().find(|(_, id)| **id == wanted).map(|(entity, _)| entity);
    for request in requests.due() {
        let Request::Body(change) = request else { continue };
        match *change {
            BodyChange::Ball { at, velocity } => {
                let velocity = Bound::VELOCITY.clamp_vector(velocity);
                let at = Pose { position: in_reach(at), heading: 0.0 };
                let rolls = move |world: &mut World, ball, _| apply_event(world, ball, &BallPut { velocity });
                commands.entity(*ball).queue(Put { at, velocity, ..Put::default() }.then(rolls));
            }
            BodyChange::Push { robot, by } => {
                if let Some(robot) = entity_of(robot) {
                    commands.entity(robot).queue(push(Bound::VELOCITY.clamp_vector(by)));
                }
            }
            // It is not told.
            BodyChange::Kidnap { robot, to } if to.is_finite() => {
                if let Some(robot) = entity_of(robot) {
                    let at = Pose { position: in_reach(to.position), ..to };
                    commands.entity(robot).queue(Put { at, ..Put::default() }.then(|_, _, _| {}));
                }
            }
            BodyChange::Kidnap { .. } => {}
        }
    }
}
