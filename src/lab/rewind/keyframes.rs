//! Copies of a match to go back to.

use std::collections::BTreeMap;

use bevy::prelude::*;

use super::onlookers::{self, Kept};
use crate::game::requests::RequestLog;
use crate::state::{OtherMatch, Snapshot};

/// A match between two ticks, with what those keep of it who look on.
pub struct Keyframe {
    snapshot: Snapshot,
    kept: Vec<Option<Kept>>,
}

impl Keyframe {
    /// Copies the match in a world.
    pub fn take(world: &mut World) -> Keyframe {
        // The log grows and grows; the branches have all that is in it.
        let log = world.get_resource_mut::<RequestLog>().map(|mut log| std::mem::take(&mut *log));
        let keyframe = Keyframe { snapshot: Snapshot::take(world), kept: onlookers::save(world) };
        if let Some(log) = log {
            world.insert_resource(log);
        }
        keyframe
    }

    /// Puts it back, without the log of requests before it.
    ///
    /// # Errors
    /// If another match is in the world. Then nothing changes.
    pub fn restore(&self, world: &mut World) -> Result<(), OtherMatch> {
        self.snapshot.restore(world)?;
        onlookers::load(world, &self.kept);
        Ok(())
    }
}

/// The keyframes of a branch by tick: close together in the near past, where people step back and forth, and farther apart
/// before it.
#[derive(Default)]
pub struct Keyframes(BTreeMap<u64, Keyframe>);

/// Ticks between two keyframes of the near past.
pub(super) const SPACING: u64 = 120;
/// Ticks of the near past: two minutes.
const NEAR: u64 = 60 * SPACING;
/// Of those before it every fifth is kept, one in ten seconds.
const SPARSE: u64 = 5;

impl Keyframes {
    /// Keeps one more, and lets go of those that have become old and lie too close together.
    pub fn insert(&mut self, tick: u64, keyframe: Keyframe) {
        self.0.insert(tick, keyframe);
        let near = tick.saturating_sub(NEAR);
        self.0.retain(|tick, _| *tick >= near || tick.is_multiple_of(SPARSE * SPACING));
    }

    /// Whether there is one of a tick.
    pub fn has(&self, tick: u64) -> bool {
        self.0.contains_key(&tick)
    }

    /// The last one at or before a tick.
    pub fn before(&self, tick: u64) -> Option<(u64, &Keyframe)> {
        self.0.range(..=tick).next_back().map(|(tick, keyframe)| (*tick, keyframe))
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
