//! What a robot has heard from its team, as its teamwork reads it.

use bevy::prelude::*;

use super::{BallReport, Book, GoalieNews, HaveBall, Message, Position, Text, Values};
use crate::clock::Clock;
use crate::comms::tcm::external_message::Entity as Party;
use crate::comms::tcm::{Arrived, Data, RegisterData, TcmSystems};
use crate::ids::{PlayerNumber, RobotId};
use crate::protocol::role_swap;
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};

pub(super) fn plugin(app: &mut App) {
    hear::<Position>(app);
    hear::<HaveBall>(app);
    hear::<GoalieNews>(app);
    hear::<role_swap::Message>(app);
    hear::<Values>(app);
    hear::<Book>(app);
    hear::<BallReport>(app);
    app.register_data::<Text>();
    let clears = empty_inboxes.in_set(TickSystems::Deliver).before(TcmSystems::Receive);
    app.add_systems(Tick, clears);
}

fn hear<T: Data + Into<Message>>(app: &mut App) {
    app.register_data::<T>().add_observer(put_into_inbox::<T>);
}

/// What a robot has heard from its team since its last decision, in the order of arrival; written by the Deliver stage.
#[derive(Component, Clone, Debug, Default)]
pub struct Inbox(pub Vec<Received>);

/// A message that arrived.
#[derive(Clone, Debug, PartialEq)]
pub struct Received {
    pub from: PlayerNumber,
    pub message: Message,
}

/// The callback of the teamwork's modules: what a team mate says waits in the inbox for the robot's next decision.
fn put_into_inbox<T: Data + Into<Message>>(
    arrived: On<Arrived<T>>,
    mut robots: Query<(&RobotId, &mut Inbox)>,
) {
    let Ok((id, mut inbox)) = robots.get_mut(arrived.entity) else { return };
    if let Party::Robot { team, number } = arrived.from
        && team == id.team as u8
        && number != id.number
    {
        inbox.0.push(Received { from: number, message: arrived.data.clone().into() });
    }
}

/// A robot has read its inbox when it has decided; one that does not hear has nothing in it.
fn empty_inboxes(clock: Res<Clock>, mut robots: Query<(&Robot, &mut Inbox)>) {
    for (robot, mut inbox) in &mut robots {
        let was_read = clock.tick > 0 && robot.is_due(clock.tick - 1);
        if (was_read || !robot.condition.hears()) && !inbox.0.is_empty() {
            inbox.0.clear();
        }
    }
}
