//! Going back and forth in the match, to other branches of it, and what a person holds in hand then.

use bevy::prelude::*;

use super::asking::AskedWhy;
use super::recording;
use crate::app::view::state::{
    Action, AfterTick, Announcement, FileError, FrameSystems, Piloted, Playback, Rewound,
};
use crate::clock::Clock;
use crate::ids::RobotId;
use crate::lab::rewind::{BranchId, CannotRewind, Rewind};
use crate::lab::why::Candidate;
use crate::robot::pilot::Pilot;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<WantedWay>()
        .add_message::<Action>()
        .add_observer(let_go)
        .add_systems(Update, (want, keep_bookmark).in_set(FrameSystems::Input));
}

/// Where a person wants the match to go.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
struct WantedWay(Option<Way>);

#[derive(Clone, Debug, PartialEq)]
enum Way {
    To(u64),
    /// To the tick of something that happened.
    ToEvent(u64, String),
    ToBranch(BranchId),
    /// Into the branch of a reason that was found, by its place.
    Reason(usize),
    BeforeLast,
}

fn want(
    mut actions: MessageReader<Action>,
    (clock, rewind): (Res<Clock>, Option<Res<Rewind>>),
    mut wanted: ResMut<WantedWay>,
    mut announcement: ResMut<Announcement>,
) {
    for action in actions.read() {
        // Back from where it is about to be.
        let tick = match wanted.0 {
            Some(Way::To(tick) | Way::ToEvent(tick, _)) => tick,
            _ => clock.tick,
        };
        let event = |ahead| rewind.as_ref().and_then(|rewind| rewind.nearest_event(tick, ahead));
        let mut to_event = |found: Option<(u64, String)>, nothing: &str| {
            if found.is_none() {
                announcement.tell(nothing.to_owned());
            }
            found.map(|(tick, what)| Way::ToEvent(tick, what))
        };
        let way = match *action {
            Action::TickBack => Some(Way::To(tick.saturating_sub(1))),
            Action::GoTo(tick) => Some(Way::To(tick)),
            Action::EventBack => to_event(event(false), "Nothing has happened before"),
            Action::EventAhead => to_event(event(true), "Nothing is known of what comes"),
            Action::TakeBranch(branch) => Some(Way::ToBranch(branch)),
            Action::TakeReason(place) => Some(Way::Reason(place)),
            Action::Undo => Some(Way::BeforeLast),
            _ => None,
        };
        if way.is_some() {
            wanted.0 = way;
        }
    }
}

/// A bookmark with the time as its note, or away with the one that is here.
fn keep_bookmark(mut actions: MessageReader<Action>, clock: Res<Clock>, rewind: Option<ResMut<Rewind>>) {
    let Some(mut rewind) = rewind else { return };
    for _ in actions.read().filter(|action| **action == Action::Bookmark) {
        let is_there = rewind.bookmarks(rewind.present()).any(|(tick, _)| tick == clock.tick);
        let note = if is_there { String::new() } else { "A bookmark".into() };
        rewind.set_bookmark(clock.tick, note);
    }
}

/// Goes where a person wants the match to go. Time stands still there.
pub(super) fn go(world: &mut World) {
    let Some(way) = world.resource_mut::<WantedWay>().bypass_change_detection().0.take() else { return };
    let gone = world.resource_scope(|world, mut rewind: Mut<Rewind>| {
        let gone = follow(world, &mut rewind, way);
        recording::follow(world, &rewind);
        gone
    });
    match gone {
        Err(error) => world.resource_mut::<FileError>().0 = Some(error.to_string()),
        Ok(told) => {
            let mut playback = world.resource_mut::<Playback>();
            *playback = Playback { paused: true, speed: playback.speed, ..Playback::default() };
            world.trigger(Rewound);
            world.flush();
            if let Some(told) = told {
                world.resource_mut::<Announcement>().tell(told);
            }
        }
    }
}

/// What there is to tell of it.
fn follow(world: &mut World, rewind: &mut Rewind, way: Way) -> Result<Option<String>, CannotRewind> {
    let look = &mut |world: &mut World| world.run_schedule(AfterTick);
    match way {
        Way::To(tick) => rewind.seek(world, tick, look).map(|()| None),
        Way::ToEvent(tick, what) => rewind.seek(world, tick, look).map(|()| Some(what)),
        Way::ToBranch(branch) => {
            let tick = world.resource::<Clock>().tick.min(rewind.branch(branch).end);
            // What was played beside another branch is recorded now.
            let recorded = recording::take(world, branch);
            rewind.switch(world, branch, tick.min(recorded), look)?;
            while world.resource::<Clock>().tick < tick {
                rewind.play(world, |world| world.run_schedule(AfterTick));
            }
            Ok(Some(format!("The branch with {}", rewind.branch(branch).name)))
        }
        Way::Reason(place) => {
            let Some(Candidate { tick, meddling }) = world.resource::<AskedWhy>().reason(place) else {
                return Ok(None);
            };
            let (name, dt) = (meddling.to_string(), world.resource::<Clock>().dt);
            let changed = Candidate { tick, meddling }.applied(&rewind.requests(), dt);
            rewind.branch_with(world, (tick, name.clone()), changed, look)?;
            Ok(Some(format!("A branch in which {name}")))
        }
        Way::BeforeLast => {
            let undone = rewind.undo(world, look)?;
            let told = undone.map(|what| format!("Undone: {what}"));
            Ok(Some(told.unwrap_or_else(|| "There is nothing to undo".into())))
        }
    }
}

/// Who goes back takes the hands off: the robot is driven as it was.
fn let_go(_: On<Rewound>, mut piloted: ResMut<Piloted>) {
    piloted.set_if_neq(Piloted(None));
}

/// Where nothing more is known of what a person did, the robot that is driven is in hand again.
pub(super) fn take_seat_again(
    (rewind, clock): (Option<Res<Rewind>>, Res<Clock>),
    mut piloted: ResMut<Piloted>,
    pilots: Query<&RobotId, With<Pilot>>,
    mut was_driven: Local<bool>,
) {
    let is_driven = rewind.is_some_and(|rewind| rewind.drives_itself(clock.tick));
    if std::mem::replace(&mut *was_driven, is_driven) && !is_driven {
        piloted.set_if_neq(Piloted(pilots.iter().min().copied()));
    }
}
