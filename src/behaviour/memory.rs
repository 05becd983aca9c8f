//! What the stateful operators of a strategy remember, one cell each, numbered when the strategy was loaded.

use bevy::prelude::*;

use crate::motor::{DockLatch, Hold, Hysteresis, Noise, Remembered, Watchdog};

/// The memories of one robot's operators.
#[derive(Component, Clone, Debug, Default)]
pub struct Memory {
    cells: Vec<Cell>,
}

/// One operator's memory; empty until the operator was first asked.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Cell {
    #[default]
    Empty,
    Remembered(Remembered),
    Hold(Hold),
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
    pub fn new(slots: usize) -> Memory {
        Memory { cells: vec![Cell::Empty; slots] }
    }
}

macro_rules! cells {
    ($($method:ident: $kind:ident),*) => {
        impl Memory {
            $(
                pub fn $method(&mut self, slot: usize) -> &mut $kind {
                    let cell = &mut self.cells[slot];
                    if !matches!(cell, Cell::$kind(_)) {
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
    remembered: Remembered,
    hold: Hold,
    lasting: Lasting,
    watchdog: Watchdog,
    hysteresis: Hysteresis,
    dock_latch: DockLatch,
    noise: Noise
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
        assert!(memory.hold(1).update(true, 0.0, 1.0));
        assert!(memory.hold(1).update(false, 0.5, 1.0));
        assert!(!memory.hold(0).update(false, 0.5, 1.0));
    }
}
