//! Requests that change what a team plays.

use std::sync::Arc;

use bevy::prelude::*;

use super::queue::Requests;
use super::request::Request;
use crate::clock::Clock;
use crate::data::Bound;
use crate::ids::{RobotId, Team};
use crate::robot::StrategyChanged;
use crate::state::event;
use crate::strategy::{Strategies, Strategy, StrategySources};

pub(super) fn change_strategies(
    clock: Res<Clock>,
    requests: Res<Requests>,
    (mut strategies, mut sources): (ResMut<Strategies>, ResMut<StrategySources>),
    mut commands: Commands,
    robots: Query<(Entity, &RobotId)>,
) {
    for request in requests.due() {
        match request {
            Request::ChangeStrategy { team, strategy, texts }
                if strategy.can_follow(strategies.of(*team)).is_ok() =>
            {
                sources.0[team.index()] = texts.clone();
                change_strategy(*team, strategy, &clock, &mut strategies, (&mut commands, &robots));
            }
            Request::SetWeight { team, assemblage, term, weight } if weight.is_finite() => {
                let strategy = Arc::make_mut(&mut strategies.0[team.index()]);
                let Some(assemblage) = strategy.assemblages.get_mut(*assemblage) else { continue };
                let Some(found) = assemblage.terms.get_mut(*term) else { continue };
                found.weight = Bound::WEIGHT.clamp(*weight);
                let texts = &mut sources.0[team.index()];
                if let Some(changed) = texts.with_weight(&assemblage.name, *term, found.weight) {
                    *texts = Arc::new(changed);
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
    (commands, robots): (&mut Commands, &Query<(Entity, &RobotId)>),
) {
    let old = std::mem::replace(&mut strategies.0[team.index()], new.clone());
    let changed = StrategyChanged { old, new: new.clone(), tick: clock.tick };
    for (robot, _) in robots.iter().filter(|(_, id)| id.team == team) {
        commands.entity(robot).queue(event(changed.clone()));
    }
}
