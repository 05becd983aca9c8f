//! Invariants: what must hold in every tick of every match, looked at from outside. Whatever is broken is counted and told with the tick,
//! the robots and the messages that led there; nothing is changed and nothing ends.

mod breach;
mod invariant;
mod look;

use bevy::prelude::*;

pub use breach::{Breach, BreachCount, Invariants};
use invariant::EVERY;
pub use invariant::Invariant;
use look::LookView;

use super::figures::Record;
use crate::clock::Clock;
use crate::comms::radio::RadioRecord;
use crate::strategy::Strategies;

/// Whether this tick is looked at.
pub(super) fn is_due(clock: Res<Clock>) -> bool {
    clock.tick.is_multiple_of(clock.ticks(EVERY).max(1))
}

/// Looks at the tick that is just over.
pub(super) fn watch(
    clock: Res<Clock>,
    strategies: Res<Strategies>,
    (record, radio): (Res<Record>, Res<RadioRecord>),
    mut invariants: ResMut<Invariants>,
    view: LookView,
) {
    let failing = view.failing(&clock, &strategies, (&record, &radio), &mut invariants.off);
    invariants.note(failing, &clock, &strategies, &radio);
}
