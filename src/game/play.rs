//! A match without a window.

use bevy::prelude::*;

use super::plan::MatchPlan;
use super::record::Record;
use super::start::start_match;
use crate::clock::Clock;
use crate::schedule::Tick;
use crate::state::{Difference, OtherMatch, replay};
use crate::world::referee::{MatchState, Phase};

/// A match without a window, run as fast as it can.
pub struct Match {
    app: App,
}

impl Match {
    /// Starts a match in an app of its own.
    pub fn new(plan: &MatchPlan) -> Match {
        let mut app = App::new();
        app.add_plugins(super::simulation);
        app.finish();
        app.cleanup();
        start_match(app.world_mut(), plan);
        Match { app }
    }

    /// The world of the match alone, in which [`Tick`] runs.
    pub fn into_world(mut self) -> World {
        std::mem::take(self.app.world_mut())
    }

    /// Plays one tick.
    pub fn tick(&mut self) {
        tick(self.app.world_mut());
    }

    /// Plays one tick, once more from where it began, and tells what came out differently; the match is then one tick further
    /// on. Many times slower than [`tick`](Match::tick).
    ///
    /// # Errors
    /// If a body was added to the match or taken from it meanwhile.
    pub fn tick_twice(&mut self) -> Result<Option<Difference>, OtherMatch> {
        replay(self.app.world_mut(), tick)
    }

    /// Whether the last half is over.
    pub fn is_over(&self) -> bool {
        self.app.world().resource::<MatchState>().phase == Phase::Finished
    }

    /// The world of the match.
    pub fn world(&self) -> &World {
        self.app.world()
    }

    /// The world of the match, to be changed.
    pub fn world_mut(&mut self) -> &mut World {
        self.app.world_mut()
    }

    /// Where the match stands.
    pub fn state(&self) -> &MatchState {
        self.app.world().resource::<MatchState>()
    }

    /// What was recorded so far.
    pub fn record(&self) -> &Record {
        self.app.world().resource::<Record>()
    }

    /// The match's clock.
    pub fn clock(&self) -> Clock {
        *self.app.world().resource::<Clock>()
    }
}

fn tick(world: &mut World) {
    world.run_schedule(Tick);
    // Otherwise the world remembers every message that has ever been delivered.
    world.clear_trackers();
}
