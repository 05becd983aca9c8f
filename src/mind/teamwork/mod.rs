//! The Teamwork stage: what robots tell each other and arrange among themselves.
//!
//! A robot listens to what came in, takes its part in role swaps, claims the ball if it is its to claim, and says what the
//! others should know. What it wants to say waits in its outbox for the Transmit stage.

mod arbitration;
mod attempts;
mod bid;
mod booking;
mod claims;
mod global_map;
mod goalie;
mod listen;
mod sight;
mod swap;
mod talk;
mod team_model;
#[cfg(test)]
mod tests;

use bevy::prelude::*;

pub use attempts::{LockRequests, SwapAttempts};
pub use booking::Booking;
pub use claims::{Claim, Claims};
pub use global_map::{BallEstimate, GlobalMap, Reported, fuse};
pub use goalie::GoalieWhereabouts;
pub use swap::{SwapAsked, Swapping};
pub use team_model::{BookingStatus, Carrier, LastSent, TeamModel, kick_off_roles};

use crate::ids::RobotId;
use crate::rng::DiceStirred;
use crate::robot::{Restart, RobotStart, StrategyChanged, SwitchedOn};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::{Role, Strategy};

/// What this stage remembers of a robot.
pub(crate) fn state(app: &mut App) {
    app.match_component::<Swapping>()
        .may_start(|start: &RobotStart, _| Swapping::new(&start.strategy, start.id, start.seed))
        .on(|swapping, on: &SwitchedOn, _| swapping.restart(on.restart))
        .on(|swapping, SwapAsked(reassignment), _| swapping.asked = Some(reassignment.clone()))
        .on(|swapping, stirred: &DiceStirred, _| swapping.dice.stir(*stirred));
    app.match_component::<Role>()
        .reflected()
        .starts(|start: &RobotStart, _| Role(start.role))
        .on(take_role_again)
        .on(keep_role);
    app.match_component::<TeamModel>()
        .starts(|start: &RobotStart, _| TeamModel::new(&start.strategy))
        .on(TeamModel::restart);
    app.match_component::<Booking>()
        .may_start(|start: &RobotStart, _| Booking::new(&start.strategy, start.id, &start.clock))
        .on(|booking, _: &SwitchedOn, _| booking.0.restart());
}

pub(super) fn plugin(app: &mut App) {
    state(app);
    let in_order = (
        listen::hear_news,
        sight::watch_goalie,
        swap::swap_roles,
        talk::claim_ball,
        booking::book_ball,
        arbitration::arbitrate,
        talk::send_news,
        listen::take_messages,
    );
    app.add_systems(Tick, in_order.chain().in_set(TickSystems::Teamwork));
}

/// A robot that is switched on has the role that its protocol remembers, or that of the kick-off.
fn take_role_again(role: &mut Role, on: &SwitchedOn, owner: EntityRef) {
    if let Some(swapping) = owner.get::<Swapping>() {
        role.0 = usize::from(swapping.machine.role());
    } else if on.restart == Restart::Lost {
        role.0 = kick_off_role(owner, &on.strategy).unwrap_or(role.0);
    }
}

/// The role of the same name, or that of the kick-off.
fn keep_role(role: &mut Role, StrategyChanged { old, new, .. }: &StrategyChanged, owner: EntityRef) {
    let name = &old.roles[role.0].name;
    let same = new.roles.iter().position(|spec| spec.name == *name);
    role.0 = same.or_else(|| kick_off_role(owner, new)).unwrap_or(new.players[0]);
}

fn kick_off_role(robot: EntityRef, strategy: &Strategy) -> Option<usize> {
    strategy.players.get(usize::from(robot.get::<RobotId>()?.number)).copied()
}
