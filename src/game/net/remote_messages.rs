//! What a match and a robot that is a process of its own say to each other, as data of the TCM: first each
//! [introduces](Introduction) itself, then sensors go one way and commands the other.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::introduction::Introduction;
use crate::comms::tcm::fragments::{USUAL_DATAGRAM, cut};
use crate::comms::tcm::{Data, DataType, ExternalMessage, Module, Peer, RegisterData, data};
use crate::game::requests::{Request, RobotWants};
use crate::geometry::Pose;
use crate::robot::{Frame, Orders};

pub(super) fn plugin(app: &mut App) {
    app.register_data::<Introduction>().register_data::<Sensors>().register_data::<RobotReply>();
}

/// What a robot senses, and what it was told by the referee; once a tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensors {
    /// Of the match, as it was introduced.
    pub session: u32,
    /// The tick that the answer is for.
    pub tick: u64,
    /// The newest camera frame.
    pub frame: Option<Frame>,
    /// Where the robot is by its own wheels or steps since the match began.
    pub odometry: Pose,
    /// m/s
    pub speed: f32,
    /// rad/s
    pub turn_rate: f32,
    /// What the motors are told, m/s.
    pub told: f32,
    /// Whether the drive reports that it is blocked.
    pub bumped: bool,
    /// rad
    pub pan: f32,
    /// Whether the ball is under its chin.
    pub holds_ball: bool,
    /// What the referee orders.
    pub orders: Orders,
    /// What is asked of the robot's mind in this tick.
    pub asked: Vec<Request>,
}

/// A robot's answer to [`Sensors`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RobotReply {
    /// That of the sensors that it answers.
    pub session: u32,
    /// What the robot wants of its body, and believes.
    pub wants: RobotWants,
    /// Datagrams to robots that it has sent so far, and those from robots that it has received.
    pub datagrams: (u64, u64),
    /// Team messages that it has sent so far, each once.
    pub said: u64,
}

/// The datagrams that bring data from one end of the link to the other, as the next message of their source.
pub(super) fn datagrams<T: Data>(data: &T, from: Peer, to: Peer, counter: &mut u32) -> Vec<Vec<u8>> {
    *counter = counter.wrapping_add(1);
    cut(&ExternalMessage::of(data, from, to), *counter, USUAL_DATAGRAM).unwrap_or_default()
}

impl RobotWants {
    fn is_finite(&self) -> bool {
        self.steering.is_finite()
            && self.head.is_finite()
            && self.pose.is_finite()
            && self.ball.is_none_or(Vec2::is_finite)
    }
}

impl RobotReply {
    fn is_finite(&self) -> bool {
        self.wants.is_finite()
    }
}

impl Sensors {
    fn is_finite(&self) -> bool {
        let numbers = [self.speed, self.turn_rate, self.told, self.pan];
        self.odometry.is_finite() && numbers.into_iter().all(f32::is_finite)
    }
}

const SENSORS: DataType = DataType(19);
const REPLY: DataType = DataType(20);

data!(Sensors { SENSORS, "sensors", Module::REMOTE_ROBOTS, Routine; (it) = it: Sensors, if Sensors::is_finite; });
data!(RobotReply { REPLY, "reply", Module::REMOTE_ROBOTS, Routine; (it) = it: RobotReply, if RobotReply::is_finite; });

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{HeadIntent, KickIntent, SteeringIntent};

    fn command(speed: f32) -> RobotReply {
        let wants = RobotWants {
            tick: 9,
            steering: SteeringIntent::Steer { heading: 0.5, facing: 0.4, speed },
            kick: KickIntent::Hold,
            head: HeadIntent::default(),
            role: 1,
            acting_as: 2,
            state: 3,
            pose: Pose::new(1.0, 2.0, 0.1),
            ball: Some(Vec2::X),
        };
        RobotReply { session: 5, wants, datagrams: (7, 8), said: 5 }
    }

    #[test]
    fn a_command_comes_back_as_it_was() {
        let (_, bytes) = command(1.0).serialise();
        assert_eq!(RobotReply::unserialise(REPLY, &bytes), Some(command(1.0)));
        assert_eq!(RobotReply::unserialise(REPLY, &bytes[1..]), None);
        assert_eq!(RobotReply::unserialise(SENSORS, &bytes), None);
    }

    #[test]
    fn what_is_not_a_number_is_no_command() {
        assert_eq!(RobotReply::unserialise(REPLY, &command(f32::NAN).serialise().1), None);
    }
}
