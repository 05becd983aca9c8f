//! What robots of a team say to each other: the table of messages, and the inbox in which they wait for a robot's decision.

mod inbox;
mod message;

use bevy::prelude::*;

pub use inbox::{Inbox, Received};
pub use message::{
    BallReport, GoalSide, GoalieBehaviour, GoalieNews, HaveBall, Position, TeamMessage, Values,
};

use crate::comms::tcm::RegisterData;
use crate::robot::RobotStart;
use crate::state::RegisterState;

pub(super) fn plugin(app: &mut App) {
    app.match_component::<Inbox>().starts(|_: &RobotStart, _| Inbox::default());
    app.register_data::<TeamMessage>().add_observer(inbox::put_into_inbox);
}
