//! What a robot has heard from its team, as its teamwork reads it.

use bevy::prelude::*;

use super::TeamMessage;
use crate::comms::tcm::{Arrived, Peer};
use crate::ids::{PlayerNumber, RobotId};

/// What a robot has heard from its team since its last decision, in the order of arrival. The Deliver stage puts messages
/// in, and the last system of the Teamwork stage takes them out.
#[derive(Component, Clone, Debug, Default)]
pub struct Inbox(pub Vec<Received>);

/// A message that arrived.
#[derive(Clone, Debug, PartialEq)]
pub struct Received {
    /// The sender's number in the team.
    pub from: PlayerNumber,
    /// What it said.
    pub message: TeamMessage,
}

/// The callback of the teamwork's modules: what a team mate says waits in the inbox for the robot's next decision.
pub(super) fn put_into_inbox(arrived: On<Arrived<TeamMessage>>, mut robots: Query<(&RobotId, &mut Inbox)>) {
    let Ok((id, mut inbox)) = robots.get_mut(arrived.entity) else { return };
    if let Peer::Robot { team, number } = arrived.from
        && team == id.team as u8
        && number != id.number
    {
        inbox.0.push(Received { from: number, message: arrived.data.clone() });
    }
}
