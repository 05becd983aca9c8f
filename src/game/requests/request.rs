//! What may be asked of a running match from outside, as plain data.

use std::net::SocketAddr;
use std::sync::Arc;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::comms::radio::{FaultRule, Partition, Radio};
use crate::comms::tcm::Peer;
use crate::comms::tcm::fragments::Header;
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::protocol::role_swap::Reassignment;
use crate::robot::pilot::Pilot;
use crate::robot::{HeadIntent, KickIntent, Restart, RobotFailure, RobotKind, Sensing, SteeringIntent};
use crate::strategy::{Strategy, StrategyTexts};
use crate::vision::{CameraSettings, ColourTable};
use crate::world::sense::Lighting;

/// Something that is to happen at the next tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Request {
    /// A person takes the robot over.
    TakeOver(RobotId),
    /// The robot's strategy takes it back.
    HandBack(RobotId),
    /// What the person at the controls does to the robot; see [`Pilot`]. Nothing, if nobody drives it.
    Steer { robot: RobotId, pilot: Pilot },
    /// The weight of a term of an assemblage, both by index.
    SetWeight { team: Team, assemblage: usize, term: usize, weight: f32 },
    /// Something happens to a robot.
    Robot(RobotId, RobotChange),
    /// Something happens to the radio.
    Radio(RadioChange),
    /// Something happens to a body.
    Body(BodyChange),
    /// The light of the hall changes.
    Light(Lighting),
    /// A packet that has reached the address at which a referee box is followed.
    RefereeBox { from: SocketAddr, bytes: Arc<[u8]> },
    /// News of a robot that decides in another process.
    Remote(RobotId, RemoteNews),
    /// A datagram that has reached a robot of this process over a real network.
    Datagram(NetworkDatagram),
    /// All dice go on with other streams, which this number decides: another chance from here on.
    StirDice(u64),
    /// The team plays on with another strategy, or with a changed one, if it [can](Strategy::can_follow). It cannot be written
    /// to a file, since names and places have been looked up in it; what it was read from can. It stays the last one, so that
    /// those before it have the same numbers when they are written and when they are read.
    #[serde(skip)]
    ChangeStrategy { team: Team, strategy: Arc<Strategy>, texts: Arc<StrategyTexts> },
}

/// What happens to a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum RobotChange {
    /// It fails in this way.
    Fail(RobotFailure),
    /// All its failures end; a robot that had crashed is switched on again.
    Revive(Restart),
    /// The referee takes it off until the end of the match.
    Penalise,
    /// It decides that roles should be swapped.
    Swap(Reassignment),
    /// Its body and its senses have other values from now on; its size and the rate of its decisions stay.
    Recalibrate(Calibration),
    /// It takes itself to be elsewhere from now on: by so many metres in the pitch frame, and turned by so many radians.
    Mislead { by: Vec2, turn: f32 },
    /// Its running camera is set otherwise. Only robots that see by pictures have one to be set.
    SetCamera(CameraSettings),
    /// Its pictures are cut by other thresholds.
    SetColours(ColourTable),
    /// It decides in this process from now on, as if it had just been switched on, and counts its messages from here on.
    PlayHere { counter: u32 },
}

/// The values of a robot that can be calibrated while it plays: its noise, its limits and its senses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// What it is built as.
    pub kind: Arc<RobotKind>,
    /// How well it senses.
    pub sensing: Arc<Sensing>,
}

/// What happens to the radio.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RadioChange {
    /// Another radio from now on.
    Change(Radio),
    /// This share of all messages is lost besides.
    ExtraLoss(f32),
    /// s
    ExtraDelay(f32),
    /// Whether the whole band is jammed.
    Jam(bool),
    /// The robot hears nobody and is heard by nobody.
    CutOff(RobotId),
    /// The robot is in radio range again.
    Reconnect(RobotId),
    /// Two groups no longer hear each other.
    Part(Partition),
    /// Ends all partitions.
    Heal,
    /// One more fault rule.
    Fault(FaultRule),
    /// A packet that is under way is lost, by the number of its [transmission](crate::comms::radio::Transmission).
    Drop(u64),
    /// A packet that is under way or was lost arrives now, by the number of its transmission.
    Deliver(u64),
}

/// A hand on the pitch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum BodyChange {
    /// Puts the ball somewhere, rolling, m and m/s in the pitch frame.
    Ball { at: Vec2, velocity: Vec2 },
    /// Adds to a robot's velocity, m/s in the pitch frame.
    Push { robot: RobotId, by: Vec2 },
    /// Carries a robot off without telling it, to a pose in the pitch frame.
    Kidnap { robot: RobotId, to: Pose },
}

/// What a robot that decides in another process has let the match know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RemoteNews {
    /// It wants to do this. It has sent so many team messages since it said so last, each counted once.
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    Wants { wants: RobotWants, said: u64 },
    /// It is not there, or not any more: it stands still.
    Silent,
}

/// What a robot wants its motors to do, and how it sees things.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RobotWants {
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
}

/// A datagram of the TCM that a network has brought.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NetworkDatagram {
    /// The receiver.
    pub to: RobotId,
    /// The tick in which a robot sent it; a computer has no ticks.
    pub sent: Option<u64>,
    /// The datagram.
    pub bytes: Arc<[u8]>,
}

impl NetworkDatagram {
    /// Who sent it, in which message and fragment.
    pub fn key(&self) -> Option<(Peer, u32, u16)> {
        let (header, _) = Header::read(&self.bytes).ok()?;
        Some((header.source.peer, header.counter, header.index))
    }
}

/// Where a request comes from. Those of one tick are carried out in this order, and those of one origin as they were made, so
/// that it does not matter what arrives first within a tick.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Origin {
    File(Team),
    /// A person or a script.
    Person,
    RefereeBox(SocketAddr),
    Remote(RobotId),
    Network {
        to: RobotId,
        sent: Option<u64>,
        key: Option<(Peer, u32, u16)>,
    },
}

impl Request {
    /// Whether it changes what happens in the mind of a robot, also where that is another process.
    pub fn concerns_mind(&self, robot: RobotId) -> bool {
        match self {
            Request::SetWeight { team, .. } => *team == robot.team,
            Request::Robot(other, change) => {
                let is_of_body = matches!(
                    change,
                    RobotChange::Penalise
                        | RobotChange::PlayHere { .. }
                        | RobotChange::SetCamera(_)
                        | RobotChange::SetColours(_)
                );
                *other == robot && !is_of_body
            }
            _ => false,
        }
    }

    pub(super) fn origin(&self) -> Origin {
        match self {
            Request::ChangeStrategy { team, .. } => Origin::File(*team),
            Request::RefereeBox { from, .. } => Origin::RefereeBox(*from),
            Request::Remote(robot, _) => Origin::Remote(*robot),
            Request::Datagram(datagram) => {
                Origin::Network { to: datagram.to, sent: datagram.sent, key: datagram.key() }
            }
            Request::TakeOver(_)
            | Request::HandBack(_)
            | Request::Steer { .. }
            | Request::SetWeight { .. }
            | Request::Robot(..)
            | Request::Radio(_)
            | Request::Light(_)
            | Request::StirDice(_)
            | Request::Body(_) => Origin::Person,
        }
    }
}
