//! What a match and a robot that is a process of its own say to each other, as data of the TCM: first each
//! [introduces](Introduction) itself, then sensors go one way and commands the other.

use std::time::SystemTime;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::introduction::Introduction;
use crate::comms::tcm::fragments::{USUAL_DATAGRAM, cut};
use crate::comms::tcm::{Data, DataType, ExternalMessage, Module, Peer, RegisterData, data};
use crate::geometry::Pose;
use crate::robot::{Frame, HeadIntent, KickIntent, Orders, SteeringIntent};

pub(super) fn plugin(app: &mut App) {
    app.register_data::<Introduction>().register_data::<Sensors>().register_data::<Command>();
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
    /// s
    pub stalled_for: f32,
    /// rad
    pub pan: f32,
    /// Whether the ball is under its chin.
    pub holds_ball: bool,
    /// What the referee orders.
    pub orders: Orders,
}

/// What a robot wants its motors to do, and how it sees things; its answer to [`Sensors`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Command {
    /// That of the sensors that it answers.
    pub session: u32,
    /// The tick of the sensors that it answers.
    pub tick: u64,
    /// Where to steer.
    pub steering: SteeringIntent,
    /// What to kick.
    pub kick: KickIntent,
    /// Where to look.
    pub head: HeadIntent,
    /// Index into the strategy's roles.
    pub role: u8,
    /// The role that it acts in, as an index.
    pub acting_as: u8,
    /// Index into the states of that role's machine.
    pub state: u16,
    /// Where it believes itself to be, in the team frame.
    pub pose: Pose,
    /// Where it believes the ball to be, m in the team frame.
    pub ball: Option<Vec2>,
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

/// A number that the last process at this place has not used, for counting on from: milliseconds on the wall's clock.
pub(super) fn unused_number() -> u32 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    since.map_or(0, |since| since.as_millis() as u32)
}

impl Command {
    fn is_finite(&self) -> bool {
        let steering = match self.steering {
            SteeringIntent::Stop => true,
            SteeringIntent::Steer { heading, facing, speed } => {
                heading.is_finite() && facing.is_finite() && speed.is_finite()
            }
            SteeringIntent::Spin(rate) => rate.is_finite(),
        };
        steering
            && self.head.pan.is_finite()
            && self.head.speed.is_finite()
            && self.pose.is_finite()
            && self.ball.is_none_or(Vec2::is_finite)
    }
}

impl Sensors {
    fn is_finite(&self) -> bool {
        let numbers = [self.speed, self.turn_rate, self.stalled_for, self.pan];
        self.odometry.is_finite() && numbers.into_iter().all(f32::is_finite)
    }
}

const SENSORS: DataType = DataType(19);
const COMMAND: DataType = DataType(20);

data!(Sensors { SENSORS, "sensors", Module::REMOTE_ROBOTS, Routine; (it) = it: Sensors, if Sensors::is_finite; });
data!(Command { COMMAND, "command", Module::REMOTE_ROBOTS, Routine; (it) = it: Command, if Command::is_finite; });

#[cfg(test)]
mod tests {
    use super::*;

    fn command(speed: f32) -> Command {
        Command {
            session: 5,
            tick: 9,
            steering: SteeringIntent::Steer { heading: 0.5, facing: 0.4, speed },
            kick: KickIntent::Hold,
            head: HeadIntent::default(),
            role: 1,
            acting_as: 2,
            state: 3,
            pose: Pose::new(1.0, 2.0, 0.1),
            ball: Some(Vec2::X),
            datagrams: (7, 8),
            said: 5,
        }
    }

    #[test]
    fn a_command_comes_back_as_it_was() {
        let (_, bytes) = command(1.0).serialise();
        assert_eq!(Command::unserialise(COMMAND, &bytes), Some(command(1.0)));
        assert_eq!(Command::unserialise(COMMAND, &bytes[1..]), None);
        assert_eq!(Command::unserialise(SENSORS, &bytes), None);
    }

    #[test]
    fn what_is_not_a_number_is_no_command() {
        assert_eq!(Command::unserialise(COMMAND, &command(f32::NAN).serialise().1), None);
    }
}
