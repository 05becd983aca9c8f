//! What robots tell a referee box about themselves.

use std::collections::BTreeMap;
use std::net::SocketAddr;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::comms::tcm::udp::UdpConn;
use crate::geometry::unit;
use crate::ids::RobotId;
use crate::mind::world_model::WorldModel;
use crate::robot::Robot;
use crate::world::gamecontroller::status::{PORT, StatusBall, StatusPacket};

/// Remembers for each robot where it saw the ball last, in its team frame, and in which tick: a belief may be forgotten
/// while its age grows.
#[derive(Clone, Debug, Default)]
pub(super) struct Observers(BTreeMap<RobotId, (Vec2, u64)>);

impl Observers {
    /// Notes which robots see the ball.
    pub fn look(&mut self, world: &mut World) {
        let mut robots = world.query::<(&RobotId, &WorldModel)>();
        for (id, model) in robots.iter(world) {
            if let Some(ball) = &model.ball {
                self.0.insert(*id, (ball.position, ball.seen));
            }
        }
    }

    /// Tells the box at this address where each robot believes itself and the ball to be. One that does not know yet where
    /// it is says nothing.
    pub fn tell(&self, world: &mut World, conn: &mut UdpConn, sender: SocketAddr, teams: [u8; 2]) {
        let clock = *world.resource::<Clock>();
        let to = SocketAddr::new(sender.ip(), PORT);
        let mut robots = world.query::<(&RobotId, &Robot, &WorldModel)>();
        let mut packets: Vec<(RobotId, StatusPacket)> = (robots.iter(world))
            .filter(|(_, robot, _)| !robot.health.crashed && !robot.health.mute)
            .filter(|(_, _, model)| model.is_localised())
            .map(|(id, _, model)| (*id, self.status(*id, teams[id.team.index()], model, &clock)))
            .collect();
        packets.sort_unstable_by_key(|(id, _)| *id);
        for (_, packet) in packets {
            // Whether anybody listens there is the box's business.
            let _ = conn.send(to, &packet.write());
        }
    }

    fn status(&self, id: RobotId, team_number: u8, model: &WorldModel, clock: &Clock) -> StatusPacket {
        let ball = self.0.get(&id).map(|(position, seen)| {
            let away = *position - model.pose.position;
            let forward = unit(model.pose.heading);
            let age = clock.tick.saturating_sub(*seen) as f32 * clock.dt;
            StatusBall { age, x: away.dot(forward), y: away.dot(forward.perp()) }
        });
        StatusPacket {
            player_number: id.number + 1,
            team_number,
            fallen: false,
            x: model.pose.position.x,
            y: model.pose.position.y,
            theta: model.pose.heading,
            ball,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;
    use crate::mind::world_model::BallBelief;

    #[test]
    fn a_ball_that_was_forgotten_grows_older_and_only_one_never_seen_has_no_age() {
        let id = RobotId::new(Team::Home, 1);
        let mut world = World::new();
        let robot = world.spawn((id, WorldModel::default())).id();
        let mut observers = Observers::default();
        let age = |observers: &Observers, tick: u64| {
            let clock = Clock { tick, ..Clock::new(60.0) };
            observers.status(id, 6, &WorldModel::default(), &clock).ball.map(|ball| ball.age)
        };
        assert_eq!(age(&observers, 60), None);
        let seen = BallBelief { position: Vec2::X, velocity: Vec2::ZERO, seen: 60 };
        for belief in [Some(seen), None] {
            world.get_mut::<WorldModel>(robot).expect("the robot has beliefs").ball = belief;
            observers.look(&mut world);
            assert_eq!(age(&observers, 90), Some(0.5));
        }
        assert!(age(&observers, 6_060).is_some_and(|age| (age - 100.0).abs() < 0.01));
    }
}
