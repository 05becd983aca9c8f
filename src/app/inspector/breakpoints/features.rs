//! Watches features of robots' strategies: when one becomes true that was not.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;

use crate::clock::Clock;
use crate::ids::RobotId;
use crate::mind::perception::{DecisionInput, Memory, perception};
use crate::pitch::{BallKind, Pitch};
use crate::robot::OffPitch;
use crate::strategy::{Activity, Strategies, Strategy};

/// What is known of the features that are watched, with a memory of its own, so that no robot's decisions are touched.
#[derive(Default)]
pub struct FeatureWatch(BTreeMap<(String, RobotId), WatchedFeature>);

struct WatchedFeature {
    strategy: Arc<Strategy>,
    memory: Memory,
    /// Whether it held at the last decision.
    held: bool,
    /// When that was.
    tick: u64,
}

/// The robots, as far as features are about them.
#[derive(SystemParam)]
pub struct WatchedRobots<'w, 's> {
    pitch: Res<'w, Pitch>,
    ball: Res<'w, BallKind>,
    strategies: Res<'w, Strategies>,
    robots: Query<'w, 's, (DecisionInput, &'static Activity), Without<OffPitch>>,
}

impl FeatureWatch {
    /// The features of these names that have become true of a robot in a tick that is just over. One that has only begun to be
    /// watched has not.
    pub fn look(
        &mut self,
        wanted: &[&str],
        robots: &WatchedRobots,
        played: &Clock,
    ) -> Vec<(RobotId, String)> {
        self.0.retain(|(name, _), _| wanted.contains(&name.as_str()));
        let mut fresh = Vec::new();
        for (input, activity) in robots.robots.iter().filter(|(input, _)| input.robot.decides(played)) {
            let strategy = &robots.strategies.0[input.id.team.index()];
            for name in wanted {
                let Some(feature) = strategy.feature(name) else { continue };
                let senses = perception(&input, activity, strategy, (played, &robots.pitch, &robots.ball));
                let key = ((*name).to_owned(), *input.id);
                let known = self
                    .0
                    .remove(&key)
                    .filter(|known| Arc::ptr_eq(&known.strategy, strategy) && known.tick < played.tick);
                let is_known = known.is_some();
                let mut watched = known.unwrap_or_else(|| WatchedFeature {
                    strategy: strategy.clone(),
                    memory: Memory::new(strategy.most_slots()),
                    held: false,
                    tick: 0,
                });
                watched.memory.begin_decision();
                let held = senses.holds(feature, &mut watched.memory);
                if is_known && held && !watched.held {
                    fresh.push(key.clone());
                }
                (watched.held, watched.tick) = (held, played.tick);
                self.0.insert(key, watched);
            }
        }
        let mut fresh: Vec<_> = fresh.into_iter().map(|(name, robot)| (robot, name)).collect();
        fresh.sort();
        fresh
    }
}
