//! The time of a match, in ticks. Nothing inside a tick knows another clock.

use bevy::prelude::*;

/// Counts the ticks of a match.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Resource)]
pub struct Clock {
    /// Ticks that are over.
    pub tick: u64,
    /// Length of a tick, s.
    pub dt: f32,
}

/// Ticks a second, unless a match says otherwise.
pub const TICK_HZ: f32 = 60.0;

impl Default for Clock {
    fn default() -> Clock {
        Clock::new(TICK_HZ)
    }
}

impl Clock {
    /// A clock at tick 0 with this many ticks a second.
    pub fn new(hz: f32) -> Clock {
        Clock { tick: 0, dt: 1.0 / hz }
    }

    /// Seconds since the match began.
    pub fn now(&self) -> f64 {
        self.tick as f64 * f64::from(self.dt)
    }

    /// Seconds since a tick; zero for one that is still to come.
    pub fn seconds_since(&self, tick: u64) -> f32 {
        self.tick.saturating_sub(tick) as f32 * self.dt
    }

    /// The number of ticks, at least one, that is nearest to a time span in seconds.
    pub fn ticks(&self, seconds: f32) -> u64 {
        ((seconds / self.dt).round() as u64).max(1)
    }

    /// Whether something that happens `hz` times a second is due in this tick.
    pub fn is_due(&self, hz: f32) -> bool {
        self.tick.is_multiple_of(self.ticks(1.0 / hz))
    }
}
