//! Requests on their way: those that wait for a tick, those of the tick that runs, those that a script has planned, and
//! those of the whole match, if they are wanted.

use std::collections::VecDeque;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::request::Request;
use crate::clock::Clock;

/// What a scenario or a recording has planned for later, the next one first.
#[derive(Resource, Clone, Debug, Default)]
pub struct Script(VecDeque<(u64, Request)>);

impl Script {
    /// Requests with their ticks, in any order; those for one tick are made in the order given.
    pub fn new(planned: &[(u64, Request)]) -> Script {
        let mut planned: Vec<_> = planned.to_vec();
        planned.sort_by_key(|(tick, _)| *tick);
        Script(planned.into())
    }

    /// All that is still planned, the next one first; the script has none of it any more.
    pub fn take(&mut self) -> Vec<(u64, Request)> {
        std::mem::take(&mut self.0).into()
    }
}

/// Makes the requests that are due.
pub(super) fn follow_script(clock: Res<Clock>, mut script: ResMut<Script>, mut requests: ResMut<Requests>) {
    while let Some((_, request)) = script.0.pop_front_if(|(tick, _)| *tick <= clock.tick) {
        requests.ask(request);
    }
}

/// What is asked of the match.
#[derive(Resource, Clone, Debug, Default)]
pub struct Requests {
    waiting: Vec<Request>,
    due: Vec<Request>,
}

impl Requests {
    /// Asks for something to happen at the next tick.
    pub fn ask(&mut self, request: Request) {
        self.waiting.push(request);
    }

    /// Takes back all that waits for the next tick.
    pub fn clear(&mut self) {
        self.waiting.clear();
    }

    /// Those that wait for the next tick, in the order in which they were made.
    pub fn iter(&self) -> impl Iterator<Item = &Request> + '_ {
        self.waiting.iter()
    }

    /// Those of this tick, in the order in which they are carried out.
    pub fn due(&self) -> impl Iterator<Item = &Request> + '_ {
        self.due.iter()
    }
}

/// All requests of a match by tick, in the order in which they were carried out. Insert it as a resource, and they are kept.
/// With the same plan, [this script](crate::game::MatchPlan::script) and no sockets the match goes the same way.
#[derive(Resource, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RequestLog(pub Vec<(u64, Request)>);

/// What waited is due now.
pub(super) fn open_door(clock: Res<Clock>, mut requests: ResMut<Requests>, log: Option<ResMut<RequestLog>>) {
    if requests.waiting.is_empty() && requests.due.is_empty() {
        return;
    }
    let Requests { waiting, due } = &mut *requests;
    due.clear();
    due.append(waiting);
    due.sort_by_cached_key(Request::origin);
    if let Some(mut log) = log {
        log.0.extend(due.iter().map(|request| (clock.tick, request.clone())));
    }
}

pub(super) fn is_any_due(requests: Res<Requests>) -> bool {
    !requests.due.is_empty()
}
