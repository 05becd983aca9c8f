//! What a robot in another process wants becomes what its body in the match does, and what people see of its mind.

use bevy::prelude::*;

use super::protocol::Command;
use crate::ids::RobotId;
use crate::mind::world_model::{BallBelief, WorldModel};
use crate::robot::{HeadIntent, KickIntent, SteeringIntent};
use crate::strategy::{Activity, Part, Role, Strategies, Strategy};

/// Does what a robot wants.
pub(super) fn obey(world: &mut World, robot: RobotId, command: &Command) {
    let Some(entity) = entity_of(world, robot) else { return };
    let strategies = world.resource::<Strategies>().clone();
    let known = activity(command, strategies.of(robot.team));
    let mut entity = world.entity_mut(entity);
    entity.insert((command.steering, command.kick, command.head));
    if let Some(mut model) = entity.get_mut::<WorldModel>() {
        model.pose = command.pose;
        let seen = command.tick;
        model.ball = command.ball.map(|position| BallBelief { position, velocity: Vec2::ZERO, seen });
    }
    if let Some((role, acting_as, state)) = known {
        entity.insert(Role(role));
        if let Some(mut activity) = entity.get_mut::<Activity>()
            && (activity.acting_as, activity.state) != (acting_as, state)
        {
            *activity = Activity { acting_as, state, since: command.tick, ..activity.clone() };
        }
    }
}

/// Makes a robot stand still that nobody hears of.
pub(super) fn stand(world: &mut World, robot: RobotId) {
    if let Some(entity) = entity_of(world, robot) {
        world.entity_mut(entity).insert((SteeringIntent::Stop, KickIntent::Nothing, HeadIntent::default()));
    }
}

pub(super) fn entity_of(world: &mut World, robot: RobotId) -> Option<Entity> {
    let mut robots = world.query::<(Entity, &RobotId)>();
    robots.iter(world).find(|(_, id)| **id == robot).map(|(entity, _)| entity)
}

/// Role, acting role and state of a command, if the strategy has them.
fn activity(command: &Command, strategy: &Strategy) -> Option<(usize, usize, usize)> {
    let (role, acting_as) = (usize::from(command.role), usize::from(command.acting_as));
    strategy.roles.get(role)?;
    let Part::Plays(play) = &strategy.roles.get(acting_as)?.part else { return None };
    let state = usize::from(command.state);
    strategy.machines.get(play.machine)?.states.get(state)?;
    Some((role, acting_as, state))
}
