//! From a schema of a strategy, with its percepts, to the pure function that works it out.

use bevy::prelude::*;

use crate::perception::{Memory, Perception};
use crate::rng::Dice;
use crate::schemas::docking::{Docking, dock_behind};
use crate::schemas::dribbling::dribble;
use crate::schemas::operators::shifted;
use crate::schemas::{attraction, avoidance, swirl};
use crate::strategy::language::{Points, Schema};

/// The vector of a schema: its angle is where to go, its length how fast, 0 to 1 and more where it is urgent. `None` while
/// something that it needs is unknown.
pub fn evaluate(schema: &Schema, senses: &Perception, memory: &mut Memory, dice: &mut Dice) -> Option<Vec2> {
    let own = senses.model.pose.position;
    let relative = |points: &Points, memory: &mut Memory| shifted(senses.points(points, memory), -own);
    Some(match schema {
        Schema::GoTo { target, controlled_zone, dead_zone } => {
            attraction::linear_attraction(senses.relative(target, memory)?, *controlled_zone, *dead_zone)
        }
        Schema::GoToAll { targets, controlled_zone, dead_zone } => {
            attraction::linear_attraction_all(relative(targets, memory), *controlled_zone, *dead_zone)
        }
        Schema::AttractNear { to, sphere, safety } => {
            attraction::attract_near(relative(to, memory), *sphere, *safety)
        }
        Schema::Avoid { of, sphere, safety } => avoidance::avoid_all(relative(of, memory), *sphere, *safety),
        Schema::Swirl { around, toward, sphere, safety } => {
            let toward = senses.relative(toward, memory)?;
            swirl::swirl_all(relative(around, memory), toward, *sphere, *safety)
        }
        Schema::SwirlLeft { around, sphere, safety } => {
            swirl::swirl_left(relative(around, memory), *sphere, *safety)
        }
        Schema::GeoField { around, toward, sphere, safety } => {
            let toward = senses.relative(toward, memory)?;
            swirl::geo_field(relative(around, memory), toward, *sphere, *safety)
        }
        Schema::Noise { period, slot } => memory.noise(*slot).sample(senses.now, *period, dice),
        Schema::DockBehind { ball, toward, standoff, enter_cone, leave_cone, slot } => {
            let docking = Docking {
                enter_cone: enter_cone.to_radians(),
                leave_cone: leave_cone.to_radians(),
                standoff: *standoff,
                ..Docking::default()
            };
            let ball = senses.relative(ball, memory)?;
            let goal = senses.relative(toward, memory)?;
            dock_behind(ball, goal, &docking, memory.dock_latch(*slot))
        }
        Schema::Dribble { ball, toward, tight } => {
            let ball = senses.relative(ball, memory)?;
            let goal = senses.relative(toward, memory)?;
            dribble(ball, goal, senses.model.pose.heading, tight.to_radians())
        }
        Schema::Constant(vector) => *vector,
    })
}
