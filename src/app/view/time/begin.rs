//! Which match or scenario the window plays, and how one begins: a [`PendingMatch`] is read and started before the next frame.

use bevy::prelude::*;

use super::expectations::Expectations;
use crate::app::match_request::MatchRequest;
use crate::app::view::picture::visuals::clear;
use crate::app::view::state::{
    FileError, Folder, MatchBegun, PendingMatch, Piloted, Playback, Screen, Selected, Session,
};
use crate::clock::Clock;
use crate::data::DataError;
use crate::game::{net, start_match};
use crate::lab::replay::{Bookmark, Plans, Replay, ReplayHeader};
use crate::lab::rewind::Rewind;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Expectations>()
        .add_systems(PreUpdate, begin_pending_match.run_if(|pending: Res<PendingMatch>| pending.0.is_some()));
}

fn begin_pending_match(world: &mut World) {
    let Some(request) = world.resource_mut::<PendingMatch>().0.take() else { return };
    match plans_for(world, &request) {
        Ok(plans) => begin(world, request, plans),
        Err(error) => world.resource_mut::<FileError>().0 = Some(error.to_string()),
    }
}

/// The plans for a request, from the files as they are now; while they are bad, what was played before can be played again
/// from what was read then.
fn plans_for(world: &mut World, request: &MatchRequest) -> Result<(ReplayHeader, Plans), DataError> {
    let read = request.read(&world.resource::<Folder>().0);
    let session = world.resource::<Session>();
    let known = session.plan.clone().filter(|_| session.request == *request);
    let known = known.map(|plan| (plan, session.scenario.clone()));
    let known = session.header.clone().zip(known);
    match (read, known) {
        (Err(error), Some(plans)) => {
            world.resource_mut::<FileError>().0 = Some(error.to_string());
            Ok(plans)
        }
        (read, _) => {
            world.resource_mut::<FileError>().0 = None;
            read
        }
    }
}

fn begin(world: &mut World, request: MatchRequest, (header, (plan, scenario)): (ReplayHeader, Plans)) {
    start_match(world, &plan);
    let bookmarks = match &request {
        MatchRequest::Replay(path) => Replay::read(path).map(|replay| replay.bookmarks()).unwrap_or_default(),
        _ => Vec::new(),
    };
    let is_live = !matches!(request, MatchRequest::Replay(_));
    if is_live && let Err(error) = net::open(world, &plan) {
        net::close(world);
        world.resource_mut::<FileError>().0 = Some(error.to_string());
    }
    let pilot = plan.pilot.filter(|_| is_live);
    let dt = world.resource::<Clock>().dt;
    world.insert_resource(Expectations::of(scenario.as_ref().map(|plan| &plan.scenario), dt));
    world.insert_resource(Piloted(pilot));
    world.insert_resource(Selected(pilot));
    let speed = world.resource::<Playback>().speed;
    world.insert_resource(Playback { speed, ..Playback::default() });
    world.insert_resource(Session { request, plan: Some(plan), scenario, header: Some(header) });
    world.resource_mut::<NextState<Screen>>().set(Screen::Match);
    clear(world);
    world.trigger(MatchBegun);
    world.flush();
    let mut rewind = Rewind::begin(world);
    for Bookmark { tick, note } in bookmarks {
        rewind.set_bookmark(tick, note);
    }
    world.insert_resource(rewind);
}
