//! Requests that change a robot: what ails it, what it decides, what it is made of.

use std::sync::Arc;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::queue::Requests;
use super::request::{Calibration, Request, RobotChange};
use crate::clock::Clock;
use crate::comms::tcm::{Tcm, TcmClient};
use crate::data::Validate;
use crate::ids::RobotId;
use crate::mind::perception::Memory;
use crate::mind::teamwork::{Booking, Swapping, TeamModel};
use crate::mind::world_model::WorldModel;
use crate::robot::{Health, Percepts, Restart, Robot, RobotFailure, RobotKind, SteeringIntent};
use crate::strategy::{Activity, Role, Strategies, Strategy};
use crate::world::referee::PenaltiesDue;
use crate::world::sense::Eyesight;

/// Everything of a robot that a restart resets.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct RobotQuery {
    id: &'static RobotId,
    robot: &'static mut Robot,
    role: &'static mut Role,
    swapping: Option<&'static mut Swapping>,
    team_model: &'static mut TeamModel,
    activity: &'static mut Activity,
    memory: &'static mut Memory,
    model: &'static mut WorldModel,
    eyesight: &'static mut Eyesight,
    percepts: &'static mut Percepts,
    intent: &'static mut SteeringIntent,
    client: &'static mut TcmClient,
    tcm: &'static mut Tcm,
    booking: Option<&'static mut Booking>,
}

pub(super) fn change_robots(
    clock: Res<Clock>,
    requests: Res<Requests>,
    strategies: Res<Strategies>,
    mut penalties: ResMut<PenaltiesDue>,
    mut robots: Query<RobotQuery>,
) {
    for request in requests.due() {
        let Request::Robot(robot, change) = request else { continue };
        let Some(mut robot) = robots.iter_mut().find(|found| found.id == robot) else { continue };
        match change {
            RobotChange::Fail(failure) => robot.fail(*failure),
            RobotChange::Revive(restart) => {
                let was_off = robot.robot.health.crashed;
                robot.robot.health = Health::default();
                if was_off {
                    let strategy = strategies.of(robot.id.team);
                    robot.switch_on(*restart, strategy, clock.tick);
                }
            }
            RobotChange::Penalise => penalties.0.push(*robot.id),
            RobotChange::Recalibrate(calibration) => robot.recalibrate(calibration),
            RobotChange::Swap(reassignment) => {
                if let Some(swapping) = &mut robot.swapping {
                    swapping.asked = Some(reassignment.clone());
                }
            }
            RobotChange::PlayHere { counter } => {
                robot.robot.remote = false;
                // Before the first tick it has said nothing and has nothing to forget.
                if clock.tick == 0 {
                    continue;
                }
                robot.tcm.count_from(*counter);
                if !robot.robot.health.crashed {
                    robot.switch_on(Restart::Lost, strategies.of(robot.id.team), clock.tick);
                }
            }
        }
    }
}

impl RobotQueryItem<'_, '_> {
    fn fail(&mut self, failure: RobotFailure) {
        self.robot.health = self.robot.health.with(failure);
        if self.robot.health.crashed {
            *self.intent = SteeringIntent::Stop;
            self.client.clear();
        }
    }

    /// Values that make no sense change nothing.
    fn recalibrate(&mut self, Calibration { kind, sensing }: &Calibration) {
        if kind.validate().and(sensing.validate()).is_err() {
            return;
        }
        let own = &self.robot.kind;
        let body = RobotKind { body: own.body, control_hz: own.control_hz, ..RobotKind::clone(kind) };
        self.robot.kind = Arc::new(body);
        self.robot.sensing = sensing.clone();
    }

    /// What the robot was in the middle of is gone in any case.
    fn switch_on(&mut self, restart: Restart, strategy: &Strategy, tick: u64) {
        let at_kick_off = strategy.players.get(usize::from(self.id.number)).copied();
        match (&mut self.swapping, restart) {
            (Some(swapping), _) => {
                swapping.restart(restart);
                self.role.0 = usize::from(swapping.machine.role());
            }
            (None, Restart::Lost) => self.role.0 = at_kick_off.unwrap_or(self.role.0),
            (None, Restart::Kept) => {}
        }
        let known = std::mem::replace(&mut *self.team_model, TeamModel::new(strategy));
        if restart == Restart::Kept {
            self.team_model.roles = known.roles;
        }
        if let Some(booking) = &mut self.booking {
            booking.0.restart();
        }
        *self.activity = Activity::new(strategy, self.role.0, tick);
        *self.memory = Memory::new(strategy.slots);
        *self.model = WorldModel::default();
        *self.percepts = Percepts::default();
        self.eyesight.blink();
    }
}
