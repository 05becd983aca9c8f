//! The branch that is shown beside the one that is played: it is played on in a world of its own as far as the other has come.

use std::time::{Duration, Instant};

use bevy::prelude::*;

use crate::app::view::state::{Beside, MatchBegun, Session};
use crate::clock::Clock;
use crate::lab::rewind::{BranchId, GhostMatch, Rewind};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<PlayedBeside>().add_observer(|_: On<MatchBegun>, mut commands: Commands| {
        commands.insert_resource(Beside::default());
        commands.insert_resource(PlayedBeside::default());
    });
}

/// The world in which a branch is played beside another, if one is.
#[derive(Resource, Default)]
pub(super) struct PlayedBeside(Option<GhostMatch>);

/// The time in one frame after which the other branch is left behind for this frame.
const BUDGET: Duration = Duration::from_millis(12);

/// The branch that the match has just left is shown beside it.
pub(super) fn show_what_was_left(
    rewind: Option<Res<Rewind>>,
    mut beside: ResMut<Beside>,
    mut last: Local<Option<BranchId>>,
) {
    let present = rewind.filter(|rewind| rewind.branches().len() > 1).map(|rewind| rewind.present());
    let before = std::mem::replace(&mut *last, present);
    if let Some(present) = present
        && Some(present) != before
    {
        beside.0 = Some(before.unwrap_or_default());
    }
}

pub(super) fn play_beside(
    (rewind, beside): (Option<ResMut<Rewind>>, Res<Beside>),
    (clock, session): (Res<Clock>, Res<Session>),
    mut played: ResMut<PlayedBeside>,
) {
    let (Some(mut rewind), Some(branch), Some(plan)) = (rewind, beside.0, &session.plan) else { return };
    if rewind.branch(branch).end >= clock.tick {
        return;
    }
    if played.0.as_ref().is_none_or(|ghost| ghost.branch() != branch) {
        played.0 = GhostMatch::new(&mut rewind, plan, branch).ok();
    }
    let Some(ghost) = &mut played.0 else { return };
    let began = Instant::now();
    while rewind.branch(branch).end < clock.tick && began.elapsed() < BUDGET {
        let next = rewind.branch(branch).end + 1;
        ghost.play_to(&mut rewind, next);
    }
}
