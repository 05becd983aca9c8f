//! To another tick, or to another branch.

use bevy::prelude::*;

use super::branch::BranchId;
use super::events::EventWatch;
use super::line::Rewind;
use super::log::{LoggedRequest, is_of_a_seat, meddling};
use crate::clock::Clock;
use crate::game::net;
use crate::game::requests::{Request, RequestLog, Requests};
use crate::state::OtherMatch;

/// A match cannot go back.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CannotRewind {
    /// It hears others over sockets.
    #[error("a match that is tied to others by sockets cannot go back: they play on")]
    Sockets,
    /// It is not the match that was copied.
    #[error(transparent)]
    Other(#[from] OtherMatch),
}

impl Rewind {
    /// Goes to where so many ticks of the present branch are over; to its last moment, if it has not been played that far.
    /// `look` sees each tick that is played on the way. What waited to be asked for is forgotten.
    ///
    /// # Errors
    /// If it cannot. Then nothing changes.
    pub fn seek(
        &mut self,
        world: &mut World,
        tick: u64,
        look: &mut dyn FnMut(&mut World),
    ) -> Result<(), CannotRewind> {
        self.go_to(world, tick, false, look)
    }

    /// Goes to a tick of another branch, as [`Rewind::seek`] does, and plays on there.
    ///
    /// # Errors
    /// If it cannot. Then nothing changes.
    pub fn switch(
        &mut self,
        world: &mut World,
        branch: BranchId,
        tick: u64,
        look: &mut dyn FnMut(&mut World),
    ) -> Result<(), CannotRewind> {
        let before = std::mem::replace(&mut self.present, branch);
        let result = self.go_to(world, tick, true, look);
        if result.is_err() {
            self.present = before;
        }
        result
    }

    fn go_to(
        &mut self,
        world: &mut World,
        tick: u64,
        is_elsewhere: bool,
        look: &mut dyn FnMut(&mut World),
    ) -> Result<(), CannotRewind> {
        if net::is_open(world) {
            return Err(CannotRewind::Sockets);
        }
        let (now, target) = (world.resource::<Clock>().tick, tick.clamp(self.start(), self.end()));
        let known = self.lineage(self.present).find_map(|(id, until)| {
            let (tick, keyframe) = self.branch(id).keyframes().before(target.min(until))?;
            Some((tick, keyframe))
        });
        if let Some((copied, keyframe)) = known
            && (is_elsewhere || target < now || now < copied)
        {
            keyframe.restore(world)?;
            self.restore_log(world, copied);
            self.watch = EventWatch::of(world);
        }
        world.resource_mut::<Requests>().clear();
        while world.resource::<Clock>().tick < target {
            self.play(world, &mut *look);
        }
        Ok(())
    }

    /// All that was asked for in the present branch and is planned in it.
    pub fn requests(&self) -> Vec<(u64, Request)> {
        let made = self.requests_from(self.present, self.start());
        made.into_iter().map(|made| (made.tick, made.request)).collect()
    }

    /// Goes to a tick of the present branch, and from there on into a new one in which these requests are made and no others.
    ///
    /// # Errors
    /// If it cannot. Then nothing changes.
    pub fn branch_with(
        &mut self,
        world: &mut World,
        (tick, name): (u64, String),
        requests: Vec<(u64, Request)>,
        look: &mut dyn FnMut(&mut World),
    ) -> Result<(), CannotRewind> {
        let mut known: Vec<LoggedRequest> = self.requests_from(self.present, tick);
        self.seek(world, tick, look)?;
        let planned = requests.into_iter().filter(|(of, _)| *of >= tick).map(|(tick, request)| {
            let place = known.iter().position(|made| made.tick == tick && made.request == request);
            let scripted = place.is_some_and(|place| known.swap_remove(place).scripted);
            LoggedRequest { tick, request, scripted }
        });
        let mut planned: Vec<LoggedRequest> = planned.collect();
        planned.sort_by_key(|made| made.tick);
        self.branch_off(tick, name, planned);
        Ok(())
    }

    /// The log of requests, if one is kept in the world, is that of the present branch up to a tick.
    fn restore_log(&self, world: &mut World, tick: u64) {
        if let Some(mut log) = world.get_resource_mut::<RequestLog>() {
            let made = self.requests_from(self.present, self.start());
            let made = made.into_iter().take_while(|made| made.tick < tick);
            log.0 = made.map(|made| (made.tick, made.request)).collect();
        }
    }

    /// Takes back what a person did last before now: what waits to be asked for, or else the last requests that belong together,
    /// by going back to the tick before them on a new branch, in which all others are asked for again. Tells what it was.
    ///
    /// # Errors
    /// If it cannot go back. Then nothing changes.
    pub fn undo(
        &mut self,
        world: &mut World,
        look: &mut dyn FnMut(&mut World),
    ) -> Result<Option<String>, CannotRewind> {
        let waiting = world.resource::<Requests>().iter().find_map(meddling);
        if let Some(waiting) = waiting {
            world.resource_mut::<Requests>().clear();
            return Ok(Some(waiting));
        }
        let Clock { tick: now, .. } = *world.resource::<Clock>();
        let gap = world.resource::<Clock>().ticks(STEP);
        let made = self.requests_from(self.present, self.start());
        let Some((what, step)) = last_step(&made, now, gap) else { return Ok(None) };
        let tick = made[step[0]].tick;
        let kept = |place: usize, made: &LoggedRequest| made.tick >= tick && !step.contains(&place);
        let later = made.iter().enumerate().filter(|(place, made)| kept(*place, made));
        let later = later.map(|(_, made)| made.clone()).collect();
        self.seek(world, tick, look)?;
        self.branch_off(tick, format!("without {what}"), later);
        Ok(Some(what))
    }
}

/// Requests of one kind that are no farther apart than this are one step, as those of a slider that is dragged, s.
const STEP: f32 = 1.0;

/// The last things of one kind that a person did before a tick, by their places, and what they were. A whole drive is one step.
fn last_step(made: &[LoggedRequest], now: u64, gap: u64) -> Option<(String, Vec<usize>)> {
    let by_person = |made: &LoggedRequest| {
        let words = if made.scripted || made.tick >= now { None } else { meddling(&made.request) };
        words.map(|words| (made.tick, words))
    };
    let mut step = Vec::new();
    let mut what: Option<(u64, String, bool)> = None;
    for (place, request) in made.iter().enumerate().rev() {
        let Some((tick, words)) = by_person(request) else { continue };
        let drives = is_of_a_seat(&request.request);
        match &mut what {
            None => what = Some((tick, words, drives)),
            Some((last, known, drove)) => {
                let belongs = if *drove { drives } else { *known == words && tick + gap >= *last };
                if !belongs {
                    break;
                }
                *last = tick;
            }
        }
        step.push(place);
        if matches!(request.request, Request::TakeOver(_)) {
            break;
        }
    }
    step.reverse();
    what.map(|(_, words, _)| (words, step))
}
