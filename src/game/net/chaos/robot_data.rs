//! What a robot of the match believes, is in and wants, as data for ChaosManager.

use bevy::prelude::*;

use super::messages::{BallData, DebugData, ImageData};
use crate::clock::Clock;
use crate::ids::RobotId;
use crate::mind::world_model::WorldModel;
use crate::robot::pilot::Pilot;
use crate::robot::{CalibratedCamera, HeadIntent, KickIntent, SteeringIntent};
use crate::strategy::{Activity, Role, Strategies};
use crate::vision::Quality;
use crate::world::sense::{ImageEyes, ImageMemory, LastLook};

/// What ChaosManager may look at of a robot: what the robot itself knows. Of the truth it hears how well colours are told.
pub(super) type RobotView<'a> = (
    &'a RobotId,
    (&'a WorldModel, &'a Role, &'a Activity),
    (&'a SteeringIntent, &'a KickIntent, &'a HeadIntent),
    Option<&'a CalibratedCamera>,
    Option<EyesView<'a>>,
    Has<Pilot>,
);

/// The last picture of a robot that sees by pictures, and when it was taken.
pub(super) type EyesView<'a> = (&'a ImageEyes, &'a ImageMemory);

type IntentView<'a> = (&'a SteeringIntent, &'a KickIntent, &'a HeadIntent);

/// How well the colours of the last picture are told, if there is one.
fn quality((eyes, memory): EyesView) -> Option<Quality> {
    memory.last()?;
    let truth: Vec<_> = eyes.truth().collect();
    Some(Quality::of(&truth, eyes.segmented().classes))
}

/// The last picture of a robot for a subscriber, if there is one that is due.
pub(super) fn image_data(
    (eyes, memory): EyesView,
    due: impl FnOnce(u64) -> Option<u32>,
) -> Option<ImageData> {
    let LastLook { tick, gaze, .. } = memory.last()?;
    due(*tick).map(|number| ImageData::of(eyes.image(), *gaze, *tick, number))
}

/// The data of a robot in this tick.
pub(super) fn debug_data(
    id: RobotId,
    (model, role, activity): (&WorldModel, &Role, &Activity),
    (steering, kick, head): IntentView,
    eyes: Option<EyesView>,
    is_driven: bool,
    (strategies, clock, number): (&Strategies, &Clock, u32),
) -> DebugData {
    let strategy = strategies.of(id.team);
    let role_name = |role: usize| strategy.roles.get(role).map(|role| role.name.clone()).unwrap_or_default();
    let machine = &strategy.machines[activity.machine(strategy)];
    let states = machine.states.get(activity.state).map(|state| machine.names_of(state));
    DebugData {
        number,
        tick: clock.tick,
        pose: model.pose,
        is_localised: model.is_localised(),
        ball: model.ball.map(|ball| BallData {
            position: ball.position,
            velocity: ball.velocity,
            age: clock.seconds_since(ball.seen),
        }),
        role: role_name(role.0),
        acting_as: role_name(activity.acting_as),
        states: states.map(|names| names.map(str::to_owned).collect()).unwrap_or_default(),
        steering: *steering,
        kick: *kick,
        head: *head,
        is_driven,
        quality: eyes.and_then(quality),
    }
}
