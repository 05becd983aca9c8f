//! Weights of motor schemas under a person's hand: what the file says, what was asked for, and what is in force.
//!
//! A request waits for the next tick, and while time stands still that may take a while; until then the slider shows what was
//! asked for.

use bevy::prelude::*;

use crate::clock::Clock;
use crate::game::requests::{Request, Requests};
use crate::ids::Team;
use crate::strategy::{Strategies, Strategy};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Weights>()
        .add_systems(PreUpdate, follow_strategies.run_if(resource_exists::<Strategies>));
}

/// The place of a weight: its team, and the indices of its assemblage and of its term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub team: Team,
    pub assemblage: usize,
    pub term: usize,
}

impl Place {
    fn in_force(self, strategies: &Strategies) -> Option<f32> {
        weight(strategies.of(self.team), self)
    }
}

fn weight(strategy: &Strategy, place: Place) -> Option<f32> {
    Some(strategy.assemblages.get(place.assemblage)?.terms.get(place.term)?.weight)
}

/// What the inspector remembers of weights.
#[derive(Resource, Debug, Default)]
pub struct Weights {
    /// The strategies as they were read, home first.
    files: Option<Strategies>,
    /// Asked for and not yet in force.
    asked: Vec<(Place, f32)>,
    /// Every weight that was ever asked for and differs from the file.
    tuned: Vec<(Place, f32)>,
    last_tick: u64,
}

/// Weights nearer than this are the same.
const SAME: f32 = 1e-4;

impl Weights {
    /// The weight to show where this one is in force.
    pub fn shown(&self, place: Place, in_force: f32) -> f32 {
        self.asked.iter().find(|(asked, _)| *asked == place).map_or(in_force, |(_, weight)| *weight)
    }

    /// The weight in the file.
    pub fn in_file(&self, place: Place) -> Option<f32> {
        weight(self.files.as_ref()?.of(place.team), place)
    }

    /// Asks for a weight from the next tick on.
    pub fn ask(&mut self, place: Place, weight: f32, requests: &mut Requests) {
        set(&mut self.asked, place, weight);
        set(&mut self.tuned, place, weight);
        let Place { team, assemblage, term } = place;
        requests.ask(Request::SetWeight { team, assemblage, term, weight });
    }

    /// Takes note of the time, and says whether another match has begun since the last look.
    fn restarted(&mut self, tick: u64) -> bool {
        tick < std::mem::replace(&mut self.last_tick, tick)
    }

    /// Takes note of the strategies in force. Those of a new match, and one that differs by more than the weights that were
    /// asked for, are what the file says now.
    fn follow(&mut self, strategies: &Strategies, restarted: bool) {
        let known = self.files.get_or_insert_with(|| strategies.clone());
        for team in Team::BOTH {
            let (file, now) = (&known.0[team.index()], &strategies.0[team.index()]);
            if restarted || !explained(file, now, team, &self.tuned) {
                known.0[team.index()] = now.clone();
                self.tuned.retain(|(place, _)| place.team != team);
                self.asked.retain(|(place, _)| place.team != team);
            }
        }
        self.asked.retain(|(place, weight)| {
            place.in_force(strategies).is_some_and(|now| (now - weight).abs() > SAME)
        });
    }
}

fn set(list: &mut Vec<(Place, f32)>, place: Place, weight: f32) {
    match list.iter_mut().find(|(known, _)| *known == place) {
        Some(entry) => entry.1 = weight,
        None => list.push((place, weight)),
    }
}

/// Whether a strategy is the one of the file but for weights that were asked for.
fn explained(file: &Strategy, now: &Strategy, team: Team, tuned: &[(Place, f32)]) -> bool {
    let same_rest = file.name == now.name
        && file.roles == now.roles
        && file.machines == now.machines
        && file.assemblages.len() == now.assemblages.len();
    same_rest
        && file.assemblages.iter().zip(&now.assemblages).enumerate().all(|(assemblage, (file, now))| {
            file.combination == now.combination
                && file.terms.len() == now.terms.len()
                && file.terms.iter().zip(&now.terms).enumerate().all(|(term, (file, now))| {
                    let place = Place { team, assemblage, term };
                    let asked_for = || tuned.iter().any(|(known, _)| *known == place);
                    file.schema == now.schema && ((file.weight - now.weight).abs() <= SAME || asked_for())
                })
        })
}

fn follow_strategies(clock: Res<Clock>, strategies: Res<Strategies>, mut weights: ResMut<Weights>) {
    let restarted = weights.restarted(clock.tick);
    if restarted || strategies.is_changed() {
        weights.follow(&strategies, restarted);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::data::{AssetFolder, AssetKind};

    const PLACE: Place = Place { team: Team::Away, assemblage: 0, term: 0 };

    fn strategies() -> Strategies {
        let folder = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let path = folder.file(AssetKind::Strategy, "ball_chasers");
        let read = Strategy::read(&folder, &path, None);
        let strategy = Arc::new(read.strategy.expect("the strategy is sound"));
        Strategies([strategy.clone(), strategy])
    }

    fn with_weight(strategies: &Strategies, weight: f32) -> Strategies {
        let mut changed = strategies.clone();
        Arc::make_mut(&mut changed.0[PLACE.team.index()]).assemblages[0].terms[0].weight = weight;
        changed
    }

    #[test]
    fn a_weight_asked_for_is_shown_until_it_is_in_force() {
        let file = strategies();
        let (mut weights, mut requests) = (Weights::default(), Requests::default());
        weights.follow(&file, false);
        weights.ask(PLACE, 2.5, &mut requests);
        assert_eq!(weights.shown(PLACE, 1.0), 2.5);
        weights.follow(&with_weight(&file, 2.5), false);
        assert!(weights.asked.is_empty());
        assert_eq!(weights.in_file(PLACE), PLACE.in_force(&file));
    }

    #[test]
    fn a_changed_file_is_the_file_from_then_on() {
        let file = strategies();
        let mut weights = Weights::default();
        weights.follow(&file, false);
        weights.follow(&with_weight(&file, 2.5), false);
        assert_eq!(weights.in_file(PLACE), Some(2.5));
    }

    #[test]
    fn a_new_match_forgets_what_was_asked_for() {
        let file = strategies();
        let (mut weights, mut requests) = (Weights::default(), Requests::default());
        weights.follow(&file, false);
        assert!(!weights.restarted(10));
        weights.ask(PLACE, 2.5, &mut requests);
        assert!(weights.restarted(0));
        weights.follow(&file, true);
        assert!(weights.asked.is_empty() && weights.tuned.is_empty());
    }
}
