//! What the stateful operators of a strategy remember, one cell each, numbered when the strategy was loaded.
//!
//! A state asks only its own operators. One that was passed over for a decision or more cannot tell what was true meanwhile:
//! those that watch something without a break start again, those that keep times of their own go on.

use bevy::prelude::*;

use crate::mind::schemas::docking::DockLatch;
use crate::mind::schemas::memory::{HoldFor, Hysteresis, Remembered, Watchdog};
use crate::mind::schemas::noise::Noise;

/// The memories of one robot's operators.
#[derive(Component, Clone, Debug, Default)]
pub struct Memory {
    cells: Vec<OperatorState>,
    /// Counts the decisions.
    decision: u64,
}

/// A cell and the decision in which its operator was last asked.
#[derive(Clone, Debug, Default)]
struct OperatorState {
    asked: u64,
    cell: Cell,
}

/// One operator's memory; empty until the operator was first asked.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Cell {
    #[default]
    Empty,
    Remembered(Remembered),
    HoldFor(HoldFor),
    Lasting(Lasting),
    Watchdog(Watchdog),
    Hysteresis(Hysteresis),
    DockLatch(DockLatch),
    Noise(Noise),
}

/// Since when, in seconds, a statement has been true.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lasting {
    since: Option<f32>,
}

impl Lasting {
    /// Whether the input has been true for `seconds` without a break.
    pub fn update(&mut self, input: bool, now: f32, seconds: f32) -> bool {
        self.since = if input { self.since.or(Some(now)) } else { None };
        self.since.is_some_and(|since| now - since >= seconds)
    }
}

impl Memory {
    /// Memory for this many operators.
    pub fn new(slots: usize) -> Memory {
        Memory { cells: vec![OperatorState::default(); slots], decision: 0 }
    }

    /// To be called once a decision, before any operator is asked.
    pub fn begin_decision(&mut self) {
        self.decision += 1;
    }
}

/// What becomes of an operator's memory when a decision went by without asking it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum AfterGap {
    GoesOn,
    StartsAnew,
}

macro_rules! cells {
    ($($method:ident: $kind:ident $after_gap:ident),*) => {
        impl Memory {
            $(
                /// The memory of the operator in a slot, empty if it is of another kind or stale.
                pub fn $method(&mut self, slot: usize) -> &mut $kind {
                    let OperatorState { asked, cell } = &mut self.cells[slot];
                    let gap = self.decision - std::mem::replace(asked, self.decision) > 1;
                    let stale = gap && AfterGap::$after_gap == AfterGap::StartsAnew;
                    if stale || !matches!(cell, Cell::$kind(_)) {
                        *cell = Cell::$kind(Default::default());
                    }
                    match cell {
                        Cell::$kind(memory) => memory,
                        _ => unreachable!("the cell was just set"),
                    }
                }
            )*
        }
    };
}

cells!(
    remembered: Remembered GoesOn,
    hold_for: HoldFor GoesOn,
    lasting: Lasting StartsAnew,
    watchdog: Watchdog StartsAnew,
    hysteresis: Hysteresis StartsAnew,
    dock_latch: DockLatch StartsAnew,
    noise: Noise GoesOn
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lasting_needs_an_unbroken_time() {
        let mut lasting = Lasting::default();
        assert!(!lasting.update(true, 0.0, 1.0));
        assert!(!lasting.update(true, 0.9, 1.0));
        assert!(lasting.update(true, 1.0, 1.0));
        assert!(!lasting.update(false, 1.1, 1.0));
        assert!(!lasting.update(true, 1.2, 1.0));
    }

    #[test]
    fn cells_keep_what_they_hold() {
        let mut memory = Memory::new(2);
        assert!(memory.hold_for(1).update(true, 0.0, 1.0));
        assert!(memory.hold_for(1).update(false, 0.5, 1.0));
        assert!(!memory.hold_for(0).update(false, 0.5, 1.0));
    }

    #[test]
    fn what_must_last_without_a_break_starts_anew_when_a_decision_did_not_ask_it() {
        let mut memory = Memory::new(3);
        let mut ask = |decisions: u32, now: f32| {
            (0..decisions).for_each(|_| memory.begin_decision());
            let lasting = memory.lasting(0).update(true, now, 1.0);
            let watchdog = memory.watchdog(1).update(false, now, 1.0, 1.0);
            (lasting, watchdog, memory.hysteresis(2).update(0.5 + now, 1.0, 2.0))
        };
        assert_eq!(ask(1, 0.0), (false, false, true));
        assert_eq!(ask(1, 1.0), (true, true, true), "asked at every decision, they go on");
        assert_eq!(ask(2, 1.2), (false, false, false), "passed over once, they start anew");
        assert_eq!(ask(0, 2.2), (true, true, false), "asked twice in a decision, they go on");
    }

    #[test]
    fn what_keeps_times_of_its_own_goes_on_when_a_decision_did_not_ask_it() {
        let mut memory = Memory::new(1);
        assert!(memory.hold_for(0).update(true, 0.0, 1.0));
        (0..5).for_each(|_| memory.begin_decision());
        assert!(memory.hold_for(0).update(false, 0.9, 1.0));
    }
}
