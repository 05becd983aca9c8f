//! Requests that make robots fail or recover.

use std::sync::Arc;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::request::{Calibration, Request, Requests, Treatment};
use crate::clock::Clock;
use crate::comms::tcm::TcmClient;
use crate::ids::RobotId;
use crate::mind::perception::Memory;
use crate::mind::teamwork::{Booking, Swapping, TeamModel};
use crate::mind::world_model::WorldModel;
use crate::robot::{Ailment, Condition, Percepts, Recall, Robot, RobotKind, SteeringIntent};
use crate::strategy::{Activity, Role, Strategies, Strategy};
use crate::world::referee::PenaltiesDue;
use crate::world::sense::Eyesight;

/// Everything of a robot that a restart resets.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Patient {
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
    booking: Option<&'static mut Booking>,
}

pub(super) fn treat_robots(
    clock: Res<Clock>,
    requests: Res<Requests>,
    strategies: Res<Strategies>,
    mut penalties: ResMut<PenaltiesDue>,
    mut robots: Query<Patient>,
) {
    for request in requests.iter() {
        let Request::Robot(robot, treatment) = request else { continue };
        let Some(mut robot) = robots.iter_mut().find(|patient| patient.id == robot) else { continue };
        match treatment {
            Treatment::Afflict(ailment) => robot.afflict(*ailment),
            Treatment::Revive(recall) => {
                let was_off = robot.robot.condition.crashed;
                robot.robot.condition = Condition::default();
                if was_off {
                    let strategy = strategies.of(robot.id.team);
                    robot.switch_on(*recall, strategy, clock.tick);
                }
            }
            Treatment::Penalise => penalties.0.push(*robot.id),
            Treatment::Recalibrate(calibration) => robot.recalibrate(calibration),
            Treatment::Swap(reassignment) => {
                if let Some(swapping) = &mut robot.swapping {
                    swapping.asked = Some(reassignment.clone());
                }
            }
        }
    }
}

impl PatientItem<'_, '_> {
    fn afflict(&mut self, ailment: Ailment) {
        self.robot.condition = self.robot.condition.with(ailment);
        if self.robot.condition.crashed {
            *self.intent = SteeringIntent::Stop;
            self.client.clear();
        }
    }

    /// Values that make no sense change nothing.
    fn recalibrate(&mut self, Calibration { kind, sensing }: &Calibration) {
        if kind.fault().or(sensing.fault()).is_some() {
            return;
        }
        let own = &self.robot.kind;
        let body = RobotKind { body: own.body, control_hz: own.control_hz, ..RobotKind::clone(kind) };
        self.robot.kind = Arc::new(body);
        self.robot.sensing = sensing.clone();
    }

    /// What the robot was in the middle of is gone in any case.
    fn switch_on(&mut self, recall: Recall, strategy: &Strategy, tick: u64) {
        let at_kick_off = strategy.players.get(usize::from(self.id.number)).copied();
        match (&mut self.swapping, recall) {
            (Some(swapping), _) => {
                swapping.restart(recall);
                self.role.0 = usize::from(swapping.machine.role());
            }
            (None, Recall::Lost) => self.role.0 = at_kick_off.unwrap_or(self.role.0),
            (None, Recall::Kept) => {}
        }
        let known = std::mem::replace(&mut *self.team_model, TeamModel::new(strategy));
        if recall == Recall::Kept {
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
