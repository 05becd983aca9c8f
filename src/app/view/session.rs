//! Which match or scenario the window plays, and how one begins: a [`Wish`] is read and started before the next frame.

use std::path::PathBuf;

use bevy::prelude::*;

use super::calls::Trouble;
use super::expectations::Expectations;
use super::state::{Pace, Piloted, Screen, Selected};
use crate::clock::Clock;
use crate::data::{AssetFolder, DataError};
use crate::game::net;
use crate::game::{Choice, MatchPlan, start_match};
use crate::ids::Team;
use crate::lab::scenario::ScenarioPlan;
use crate::rng::DEFAULT_SEED;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Wish>()
        .init_resource::<Session>()
        .init_resource::<Expectations>()
        .add_systems(PreUpdate, begin_wished_match.run_if(|wish: Res<Wish>| wish.0.is_some()));
}

/// Where the files are.
#[derive(Resource, Clone, Debug)]
pub struct Folder(pub AssetFolder);

/// What a person wants to see.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    Match(Choice),
    /// A scenario with one of its seeds or with any other.
    Scenario {
        path: PathBuf,
        /// Its first one, if not given.
        seed: Option<u64>,
    },
}

impl Default for Wanted {
    fn default() -> Wanted {
        Wanted::Match(Choice::default())
    }
}

/// What is wanted next.
#[derive(Resource, Clone, Debug, Default)]
pub struct Wish(pub Option<Wanted>);

/// The match that is played.
#[derive(Resource, Clone, Debug, Default)]
pub struct Session {
    /// What it was made of.
    pub wanted: Wanted,
    /// What that came to; none before the first match.
    pub plan: Option<MatchPlan>,
    /// The scenario that it belongs to.
    pub scenario: Option<ScenarioPlan>,
}

impl Session {
    /// Whether a team takes part.
    pub fn has(&self, team: Team) -> bool {
        self.scenario.as_ref().is_none_or(|plan| plan.scenario.sides[team.index()].is_some())
    }
}

/// What a wish comes to.
type Plans = (MatchPlan, Option<ScenarioPlan>);

/// A match has been put into the world, from its beginning.
#[derive(Event, Clone, Copy, Debug)]
pub struct MatchBegun;

fn begin_wished_match(world: &mut World) {
    let Some(wanted) = world.resource_mut::<Wish>().0.take() else { return };
    match plans_for(world, &wanted) {
        Ok(plans) => begin(world, wanted, plans),
        Err(error) => world.resource_mut::<Trouble>().0 = Some(error.to_string()),
    }
}

/// The plans for a wish, from the files as they are now; while they are bad, what was played before can be played again
/// from what was read then.
fn plans_for(world: &mut World, wanted: &Wanted) -> Result<Plans, DataError> {
    let read = wanted.plans(&world.resource::<Folder>().0);
    let session = world.resource::<Session>();
    let known = session.plan.clone().filter(|_| session.wanted == *wanted);
    let known = known.map(|plan| (plan, session.scenario.clone()));
    match (read, known) {
        (Err(error), Some(plans)) => {
            world.resource_mut::<Trouble>().0 = Some(error.to_string());
            Ok(plans)
        }
        (read, _) => {
            world.resource_mut::<Trouble>().0 = None;
            read
        }
    }
}

impl Wanted {
    fn plans(&self, assets: &AssetFolder) -> Result<Plans, DataError> {
        match self {
            Wanted::Match(choice) => MatchPlan::read(assets, choice).map(|plan| (plan, None)),
            Wanted::Scenario { path, seed } => {
                let scenario = ScenarioPlan::read(assets, path)?;
                let seed = seed.or_else(|| scenario.scenario.seeds.first().copied()).unwrap_or(DEFAULT_SEED);
                Ok((scenario.with_seed(seed), Some(scenario)))
            }
        }
    }
}

fn begin(world: &mut World, wanted: Wanted, (plan, scenario): Plans) {
    start_match(world, &plan);
    if let Err(error) = net::open(world, &plan) {
        net::close(world);
        world.resource_mut::<Trouble>().0 = Some(error.to_string());
    }
    let dt = world.resource::<Clock>().dt;
    world.insert_resource(Expectations::of(scenario.as_ref().map(|plan| &plan.scenario), dt));
    world.insert_resource(Piloted(plan.pilot));
    world.insert_resource(Selected(plan.pilot));
    let speed = world.resource::<Pace>().speed;
    world.insert_resource(Pace { speed, ..Pace::default() });
    world.insert_resource(Session { wanted, plan: Some(plan), scenario });
    world.resource_mut::<NextState<Screen>>().set(Screen::Match);
    super::shown::clear(world);
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
            let (plan, scenario) = Wanted::Scenario { path: path.clone(), seed }.plans(&assets).unwrap();
            assert!(scenario.is_some() && plan.situation.is_some());
            plan.seed
        };
        assert_eq!((seed_of(None), seed_of(Some(77))), (1, 77));
    }
}
