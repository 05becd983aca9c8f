//! A tick with a past: it repeats what was, or adds to it.

use bevy::prelude::*;

use super::branch::{Branch, BranchId};
use super::events::EventWatch;
use super::keyframes::{Keyframe, SPACING};
use super::line::Rewind;
use super::log::{LoggedRequest, is_of_a_seat, meddling};
use crate::clock::Clock;
use crate::game::requests::{Request, Requests};
use crate::ids::RobotId;
use crate::robot::pilot::Pilot;
use crate::schedule::Tick;

impl Rewind {
    /// Plays one tick of the match in the world, then looks at it. A tick that was played before goes the same way, unless
    /// something is asked for: then it is the first of a new branch. There all else that was asked for later in the old branch
    /// is asked for again, but for the driving if a person drives now.
    pub fn play(&mut self, world: &mut World, look: impl FnOnce(&mut World)) {
        let tick = world.resource::<Clock>().tick;
        let asked: Vec<Request> = world.resource::<Requests>().iter().cloned().collect();
        if self.is_known(tick) && !asked.is_empty() {
            self.fork(world, tick, asked);
        }
        let mut watch = std::mem::take(&mut self.watch);
        self.play_in(self.present, &mut watch, world);
        self.watch = watch;
        look(world);
        self.keep(self.present, world);
    }

    /// Copies the match, if it is time, when all have looked at the tick that is just over.
    pub(super) fn keep(&mut self, branch: BranchId, world: &mut World) {
        let tick = world.resource::<Clock>().tick;
        let branch = &mut self.branches[branch.0];
        if tick == branch.end && tick.is_multiple_of(SPACING) && !branch.keyframes.has(tick) {
            branch.keyframes.insert(tick, Keyframe::take(world));
        }
    }

    /// Plays one tick of a branch in a world that is there.
    pub(super) fn play_in(&mut self, branch: BranchId, watch: &mut EventWatch, world: &mut World) {
        let tick = world.resource::<Clock>().tick;
        let is_known = tick < self.branch(branch).end;
        let repeated = if is_known {
            self.branch(self.owner(branch, tick)).requests_of(tick).to_vec()
        } else {
            self.branches[branch.0].take_planned(tick)
        };
        let mut requests = world.resource_mut::<Requests>();
        repeated.iter().for_each(|made| requests.ask(made.request.clone()));
        world.run_schedule(Tick);
        let events = watch.look(world);
        if !is_known {
            let branch = &mut self.branches[branch.0];
            branch.note(world, tick, repeated);
            branch.events.extend(events);
        }
    }

    /// Leaves the present branch before a tick that it knows, since this is asked for.
    fn fork(&mut self, world: &mut World, tick: u64, asked: Vec<Request>) {
        let name = asked.iter().find_map(meddling).unwrap_or_else(|| "from elsewhere".into());
        let mut again = self.requests_from(self.present, tick);
        let drives = asked.iter().any(is_of_a_seat);
        if drives {
            again.retain(|made| !is_of_a_seat(&made.request));
        }
        let later = again.split_off(again.partition_point(|made| made.tick <= tick));
        let mut requests = world.resource_mut::<Requests>();
        requests.clear();
        again.into_iter().for_each(|made| requests.ask(made.request));
        asked.iter().cloned().for_each(|request| requests.ask(request));
        if drives {
            hand_back_others(world, &asked);
        }
        self.branch_off(tick, name, later);
    }

    /// A new branch from a tick of the present one, with what is to be asked for in it later; it is the present one then.
    pub(super) fn branch_off(&mut self, tick: u64, name: String, planned: Vec<LoggedRequest>) {
        let parent = self.owner(self.present, tick);
        let mut branch = Branch::new(Some(parent), name, tick);
        branch.planned = planned.into();
        self.present = BranchId(self.branches.len());
        self.branches.push(branch);
    }
}

/// A person has two hands: the robots that they drove before and do not drive now go back to their strategies.
fn hand_back_others(world: &mut World, asked: &[Request]) {
    let is_taken = |robot: RobotId| {
        asked.iter().any(|request| match request {
            Request::TakeOver(other) | Request::Steer { robot: other, .. } => *other == robot,
            _ => false,
        })
    };
    let mut driven = world.query_filtered::<&RobotId, With<Pilot>>();
    let mut left: Vec<RobotId> = driven.iter(world).copied().filter(|robot| !is_taken(*robot)).collect();
    left.sort_unstable();
    let mut requests = world.resource_mut::<Requests>();
    left.into_iter().for_each(|robot| requests.ask(Request::HandBack(robot)));
}

impl Branch {
    /// Takes note of a tick that was just played for the first time.
    fn note(&mut self, world: &mut World, tick: u64, mut repeated: Vec<LoggedRequest>) {
        for request in world.resource::<Requests>().due() {
            let known = repeated.iter().position(|made| made.request == *request);
            let scripted = known.is_some_and(|place| repeated.swap_remove(place).scripted);
            self.log.push(LoggedRequest { tick, request: request.clone(), scripted });
        }
        self.end = tick + 1;
        self.track.push(world);
    }
}
