//! The Script stage: requests from outside a match. Requests wait in [`Requests`] and take effect at the next tick, in the
//! order in which they were made.

mod air;
mod bodies;
mod request;
mod robots;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::data::Bound;
use crate::ids::{RobotId, Team};
use crate::mind::perception::Memory;
use crate::robot::pilot::Pilot;
use crate::schedule::{Tick, TickSystems};
use crate::strategy::{Activity, Role, Strategies, Strategy};
use crate::world::referee::PenaltiesDue;
pub use request::{Calibration, Request, Requests, Script, Shove, Treatment, Weather};

pub(super) fn plugin(app: &mut App) {
    let in_order = (
        request::follow_script,
        carry_out_requests,
        air::change_weather,
        robots::treat_robots,
        bodies::shove_bodies,
        forget_requests,
    );
    app.init_resource::<PenaltiesDue>()
        .init_resource::<Requests>()
        .init_resource::<Script>()
        .add_systems(Tick, in_order.chain().in_set(TickSystems::Script));
}

type Scripted<'a> = (Entity, &'a RobotId, &'a mut Role, &'a mut Activity, &'a mut Memory, Has<Pilot>);

fn carry_out_requests(
    clock: Res<Clock>,
    requests: Res<Requests>,
    mut strategies: ResMut<Strategies>,
    mut commands: Commands,
    mut robots: Query<Scripted>,
) {
    if requests.is_empty() {
        return;
    }
    let entity_of = |wanted: RobotId, robots: &Query<Scripted>| {
        robots.iter().find(|(_, id, ..)| **id == wanted).map(|(entity, ..)| entity)
    };
    let mut seats: Vec<RobotId> = robots.iter().filter(|seat| seat.5).map(|(_, id, ..)| *id).collect();
    for request in requests.iter().cloned() {
        match request {
            Request::TakeOver(robot) => {
                seats.push(robot);
                if let Some(entity) = entity_of(robot, &robots) {
                    commands.entity(entity).insert(Pilot::default());
                }
            }
            Request::HandBack(robot) => {
                seats.retain(|seat| *seat != robot);
                if let Some(entity) = entity_of(robot, &robots) {
                    commands.entity(entity).remove::<Pilot>();
                }
            }
            Request::Steer { robot, pilot } => {
                if let Some(entity) = entity_of(robot, &robots).filter(|_| seats.contains(&robot)) {
                    commands.entity(entity).insert(pilot.limited());
                }
            }
            Request::SetWeight { team, assemblage, term, weight } => {
                let strategy = Arc::make_mut(&mut strategies.0[team.index()]);
                let term =
                    strategy.assemblages.get_mut(assemblage).and_then(|found| found.terms.get_mut(term));
                if let Some(term) = term.filter(|_| weight.is_finite()) {
                    term.weight = Bound::WEIGHT.clamp(weight);
                }
            }
            Request::ChangeStrategy { team, strategy } => {
                change_strategy(team, strategy, &clock, &mut strategies, &mut robots);
            }
            Request::Robot(..) | Request::Air(_) | Request::Body(_) => {}
        }
    }
}

fn forget_requests(mut requests: ResMut<Requests>) {
    if !requests.is_empty() {
        requests.clear();
    }
}

fn change_strategy(
    team: Team,
    new: Arc<Strategy>,
    clock: &Clock,
    strategies: &mut Strategies,
    robots: &mut Query<Scripted>,
) {
    if new.can_follow(strategies.of(team)).is_err() {
        return;
    }
    let old = std::mem::replace(&mut strategies.0[team.index()], new.clone());
    for (_, id, mut role, mut activity, mut memory, _) in
        robots.iter_mut().filter(|(_, id, ..)| id.team == team)
    {
        let at_kick_off = new.players.get(usize::from(id.number)).copied().unwrap_or(new.players[0]);
        let name = &old.roles[role.0].name;
        role.0 = new.roles.iter().position(|spec| spec.name == *name).unwrap_or(at_kick_off);
        *activity = activity.carried_over(&old, &new, role.0, clock.tick);
        *memory = Memory::new(new.slots);
    }
}
