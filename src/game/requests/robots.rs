//! Requests that change a robot: what ails it, what it decides, what it is made of.

use std::sync::Arc;

use bevy::prelude::*;

use super::queue::Requests;
use super::request::{Calibration, Request, RobotChange};
use crate::clock::Clock;
use crate::comms::tcm::CountFrom;
use crate::data::{Bound, Validate};
use crate::ids::RobotId;
use crate::mind::teamwork::SwapAsked;
use crate::robot::{CameraSet, ColoursSet, Misled, Restart, Robot, RobotKind, SwitchedOff, SwitchedOn};
use crate::state::event;
use crate::strategy::Strategies;
use crate::world::referee::PenaltiesDue;

pub(super) fn change_robots(
    clock: Res<Clock>,
    requests: Res<Requests>,
    strategies: Res<Strategies>,
    mut penalties: ResMut<PenaltiesDue>,
    mut commands: Commands,
    mut robots: Query<(Entity, &RobotId, &mut Robot)>,
) {
    for request in requests.due() {
        let Request::Robot(robot, change) = request else { continue };
        let Some((entity, id, mut robot)) = robots.iter_mut().find(|(_, id, _)| *id == robot) else {
            continue;
        };
        let mut entity = commands.entity(entity);
        let strategy = &strategies.0[id.team.index()];
        let switched_on = |restart| SwitchedOn { restart, strategy: strategy.clone(), tick: clock.tick };
        match change {
            RobotChange::Fail(failure) => {
                robot.health = robot.health.with(*failure);
                if robot.health.crashed {
                    entity.queue(event(SwitchedOff));
                }
            }
            RobotChange::Revive(restart) => {
                let was_off = std::mem::take(&mut robot.health).crashed;
                if was_off {
                    entity.queue(event(switched_on(*restart)));
                }
            }
            RobotChange::Penalise => penalties.0.push(*id),
            RobotChange::Recalibrate(calibration) => recalibrate(&mut robot, calibration),
            RobotChange::SetCamera(settings) => {
                entity.queue(event(CameraSet(*settings)));
            }
            RobotChange::SetColours(colours) => {
                entity.queue(event(ColoursSet(colours.clone())));
            }
            RobotChange::Swap(reassignment) => {
                entity.queue(event(SwapAsked(reassignment.clone())));
            }
            RobotChange::Mislead { by, turn } if turn.is_finite() => {
                let by = Bound::PLACE.clamp_vector(*by);
                entity.queue(event(Misled { by, turn: *turn }));
            }
            RobotChange::Mislead { .. } => {}
            RobotChange::PlayHere { counter } => {
                robot.remote = false;
                // Before the first tick it has said nothing and has nothing to forget.
                if clock.tick == 0 {
                    continue;
                }
                entity.queue(event(CountFrom(*counter)));
                if !robot.health.crashed {
                    entity.queue(event(switched_on(Restart::Lost)));
                }
            }
        }
    }
}

/// Values that make no sense change nothing.
fn recalibrate(robot: &mut Robot, Calibration { kind, sensing }: &Calibration) {
    if kind.validate().and(sensing.validate()).is_err() {
        return;
    }
    let RobotKind { body, control_hz, .. } = *robot.kind;
    robot.kind = Arc::new(RobotKind { body, control_hz, ..RobotKind::clone(kind) });
    robot.sensing = sensing.clone();
}
