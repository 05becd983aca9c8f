//! Requests that change what a team plays.

use std::sync::Arc;

use bevy::prelude::*;

use super::queue::Requests;
use super::request::Request;
use crate::clock::Clock;
use crate::data::Bound;
use crate::ids::{RobotId, Team};
use crate::mind::perception::Memory;
use crate::strategy::{Activity, Role, Strategies, Strategy};

type Playing<'a> = (&'a RobotId, &'a mut Role, &'a mut Activity, &'a mut Memory);

pub(super) fn change_strategies(
    clock: Res<Clock>,
    requests: Res<Requests>,
    mut strategies: ResMut<Strategies>,
    mut robots: Query<Playing>,
) {
    for request in requests.due() {
        match request {
            Request::ChangeStrategy { team, strategy } => {
                change_strategy(*team, strategy, &clock, &mut strategies, &mut robots);
            }
            Request::SetWeight { team, assemblage, term, weight } if weight.is_finite() => {
                let strategy = Arc::make_mut(&mut strategies.0[team.index()]);
                let assemblage = strategy.assemblages.get_mut(*assemblage);
                if let Some(term) = assemblage.and_then(|found| found.terms.get_mut(*term)) {
                    term.weight = Bound::WEIGHT.clamp(*weight);
                }
            }
            _ => {}
        }
    }
}

fn change_strategy(
    team: Team,
    new: &Arc<Strategy>,
    clock: &Clock,
    strategies: &mut Strategies,
    robots: &mut Query<Playing>,
) {
    if new.can_follow(strategies.of(team)).is_err() {
        return;
    }
    let old = std::mem::replace(&mut strategies.0[team.index()], new.clone());
    for (id, mut role, mut activity, mut memory) in robots.iter_mut().filter(|(id, ..)| id.team == team) {
        let at_kick_off = new.players.get(usize::from(id.number)).copied().unwrap_or(new.players[0]);
        let name = &old.roles[role.0].name;
        role.0 = new.roles.iter().position(|spec| spec.name == *name).unwrap_or(at_kick_off);
        *activity = activity.carried_over(&old, new, role.0, clock.tick);
        *memory = Memory::new(new.slots);
    }
}
