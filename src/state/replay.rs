//! Plays a tick twice from one snapshot, to find what does not repeat itself: state that nobody registered, dice without a
//! seed, an order that depends on memory.

use bevy::prelude::*;

use super::snapshot::{Difference, OtherMatch, Snapshot};

/// Plays one tick, puts everything back, plays it once more, and tells what came out differently. The world is then one tick
/// further on. Many times slower than the tick itself: for tests.
///
/// # Errors
/// If a body was added to the match or taken from it meanwhile.
pub fn replay(world: &mut World, tick: impl Fn(&mut World)) -> Result<Option<Difference>, OtherMatch> {
    let before = Snapshot::take(world);
    tick(world);
    let first = Snapshot::take(world);
    before.restore(world)?;
    tick(world);
    Ok(first.difference(&Snapshot::take(world)))
}
