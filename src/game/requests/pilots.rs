//! Requests of who drives a robot.

use bevy::prelude::*;

use super::queue::Requests;
use super::request::Request;
use crate::ids::RobotId;
use crate::robot::pilot::Pilot;

pub(super) fn seat_pilots(
    requests: Res<Requests>,
    mut commands: Commands,
    robots: Query<(Entity, &RobotId, Has<Pilot>)>,
) {
    let mut seats: Vec<RobotId> = robots.iter().filter(|seat| seat.2).map(|(_, id, _)| *id).collect();
    for request in requests.due() {
        let (robot, pilot) = match request {
            Request::TakeOver(robot) => (robot, Some(Pilot::default())),
            Request::HandBack(robot) => (robot, None),
            Request::Steer { robot, pilot } if seats.contains(robot) => (robot, Some(pilot.limited())),
            _ => continue,
        };
        let Some((entity, ..)) = robots.iter().find(|(_, id, _)| *id == robot) else { continue };
        seats.retain(|seat| seat != robot);
        match pilot {
            Some(pilot) => {
                seats.push(*robot);
                commands.entity(entity).insert(pilot);
            }
            None => {
                commands.entity(entity).remove::<Pilot>();
            }
        }
    }
}
