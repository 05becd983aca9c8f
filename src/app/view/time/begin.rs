//! Which match or scenario the window plays, and how one begins: a [`PendingMatch`] is read and started before the next frame.

use bevy::prelude::*;

use super::expectations::Expectations;
use crate::app::view::picture::visuals::clear;
use crate::app::view::state::{
    FileError, Folder, MatchBegun, MatchRequest, PendingMatch, Piloted, Playback, Screen, Selected, Session,
};
use crate::clock::Clock;
use crate::data::{AssetFolder, DataError};
use crate::game::{MatchPlan, net, start_match};
use crate::lab::scenario::ScenarioPlan;
use crate::rng::DEFAULT_SEED;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Expectations>()
        .add_systems(PreUpdate, begin_pending_match.run_if(|pending: Res<PendingMatch>| pending.0.is_some()));
}

/// What a wish comes to.
type Plans = (MatchPlan, Option<ScenarioPlan>);

fn begin_pending_match(world: &mut World) {
    let Some(wanted) = world.resource_mut::<PendingMatch>().0.take() else { return };
    match plans_for(world, &wanted) {
        Ok(plans) => begin(world, wanted, plans),
        Err(error) => world.resource_mut::<FileError>().0 = Some(error.to_string()),
    }
}

/// The plans for a wish, from the files as they are now; while they are bad, what was played before can be played again
/// from what was read then.
fn plans_for(world: &mut World, wanted: &MatchRequest) -> Result<Plans, DataError> {
    let read = wanted.plans(&world.resource::<Folder>().0);
    let session = world.resource::<Session>();
    let known = session.plan.clone().filter(|_| session.wanted == *wanted);
    let known = known.map(|plan| (plan, session.scenario.clone()));
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

impl MatchRequest {
    fn plans(&self, assets: &AssetFolder) -> Result<Plans, DataError> {
        match self {
            MatchRequest::Match(choice) => MatchPlan::read(assets, choice).map(|plan| (plan, None)),
            MatchRequest::Scenario { path, seed } => {
                let scenario = ScenarioPlan::read(assets, path)?;
                let seed = seed.or_else(|| scenario.scenario.seeds.first().copied()).unwrap_or(DEFAULT_SEED);
                Ok((scenario.with_seed(seed), Some(scenario)))
            }
        }
    }
}

fn begin(world: &mut World, wanted: MatchRequest, (plan, scenario): Plans) {
    start_match(world, &plan);
    if let Err(error) = net::open(world, &plan) {
        net::close(world);
        world.resource_mut::<FileError>().0 = Some(error.to_string());
    }
    let dt = world.resource::<Clock>().dt;
    world.insert_resource(Expectations::of(scenario.as_ref().map(|plan| &plan.scenario), dt));
    world.insert_resource(Piloted(plan.pilot));
    world.insert_resource(Selected(plan.pilot));
    let speed = world.resource::<Playback>().speed;
    world.insert_resource(Playback { speed, ..Playback::default() });
    world.insert_resource(Session { wanted, plan: Some(plan), scenario });
    world.resource_mut::<NextState<Screen>>().set(Screen::Match);
    clear(world);
    world.trigger(MatchBegun);
    world.flush();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AssetKind;

    #[test]
    fn a_scenario_is_played_with_its_first_seed_or_with_the_one_asked_for() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let path = assets.file(AssetKind::Scenario, "swap_figure_8");
        let seed_of = |seed| {
            let (plan, scenario) =
                MatchRequest::Scenario { path: path.clone(), seed }.plans(&assets).unwrap();
            assert!(scenario.is_some() && plan.situation.is_some());
            plan.seed
        };
        assert_eq!((seed_of(None), seed_of(Some(77))), (1, 77));
    }
}
