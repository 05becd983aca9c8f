//! The socket on which a referee box is heard, and on which it is told how the robots are.

use std::net::SocketAddr;
use std::time::Instant;

use bevy::log::{info, warn};
use bevy::prelude::*;

use crate::clock::Clock;
use crate::gamecontroller::BoxNews;
use crate::gamecontroller::referee_box::RefereeBox;
use crate::gamecontroller::status::{PORT, SeenBall, StatusPacket};
use crate::geometry::unit;
use crate::ids::RobotId;
use crate::robot::Robot;
use crate::tcm::udp::{UdpConn, UdpError};
use crate::world_model::WorldModel;

/// How often robots say how they are, per second.
const STATUS_HZ: f32 = 2.0;

pub(super) struct BoxSocket {
    conn: UdpConn,
    follower: RefereeBox,
    /// Where the box is.
    sender: Option<SocketAddr>,
    opened: Instant,
}

impl BoxSocket {
    pub fn open(address: SocketAddr, players: u8) -> Result<BoxSocket, UdpError> {
        let conn = UdpConn::bind(address)?;
        Ok(BoxSocket { conn, follower: RefereeBox::new(None, players), sender: None, opened: Instant::now() })
    }

    pub fn exchange(&mut self, world: &mut World) {
        let clock = *world.resource::<Clock>();
        let now = self.opened.elapsed().as_millis() as u64;
        let mut view = None;
        while let Ok(Some((from, bytes))) = self.conn.receive() {
            match self.follower.hear(bytes, now) {
                Ok(news) => {
                    if self.sender.replace(from) != Some(from) {
                        info!("a referee box at {from} referees the match");
                    }
                    view = news.or(view);
                }
                Err(ignored) => {
                    if self.follower.first_time(&ignored) {
                        warn!("a packet from {from} is ignored: {ignored}");
                    }
                }
            }
        }
        let mut news = world.get_resource_or_init::<BoxNews>();
        news.heard = self.follower.heard();
        if let Some(view) = view {
            news.view = Some(view);
            news.last = clock.tick;
        }
        if clock.is_due(STATUS_HZ) {
            self.tell(world, &clock);
        }
    }

    /// Tells the box where each robot believes itself and the ball to be.
    fn tell(&mut self, world: &mut World, clock: &Clock) {
        let (Some(sender), Some(teams)) = (self.sender, self.follower.team_numbers()) else { return };
        let to = SocketAddr::new(sender.ip(), PORT);
        let mut robots = world.query::<(&RobotId, &Robot, &WorldModel)>();
        let mut packets: Vec<(RobotId, StatusPacket)> = (robots.iter(world))
            .filter(|(_, robot, _)| !robot.condition.crashed && !robot.condition.mute)
            .map(|(id, _, model)| (*id, status(*id, teams[id.team.index()], model, clock)))
            .collect();
        packets.sort_unstable_by_key(|(id, _)| *id);
        for (_, packet) in packets {
            // Whether anybody listens there is the box's business.
            let _ = self.conn.send(to, &packet.write());
        }
    }
}

fn status(id: RobotId, team_number: u8, model: &WorldModel, clock: &Clock) -> StatusPacket {
    let ball = model.ball.map(|ball| {
        let away = ball.position - model.pose.position;
        let forward = unit(model.pose.heading);
        let age = clock.tick.saturating_sub(ball.seen) as f32 * clock.dt;
        SeenBall { age, x: away.dot(forward), y: away.dot(forward.perp()) }
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
