//! How a team communication module is set up, as data: a part of a match file.

use serde::{Deserialize, Serialize};

use super::client::{QueueRule, WhenFull};
use super::fragments::{HEADER, LARGEST_DATAGRAM, Limits, USUAL_DATAGRAM};
use crate::clock::Clock;

/// A field that a file leaves out has its default.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TcmSettings {
    /// Largest datagram, bytes; longer messages are cut.
    pub datagram: usize,
    /// The queue of each module.
    pub queue: QueueRule,
    /// Messages that the TCM takes from a robot's queues in one tick.
    pub takes: usize,
    /// Unfinished messages that a robot keeps at a time.
    pub unfinished: usize,
    /// The longest message, bytes.
    pub longest: usize,
    /// How long the fragments of a message are kept while some are missing, s.
    pub patience: f32,
}

impl Default for TcmSettings {
    fn default() -> TcmSettings {
        TcmSettings {
            datagram: USUAL_DATAGRAM,
            queue: QueueRule { capacity: 8, when_full: WhenFull::DropOldest },
            takes: 16,
            unfinished: 16,
            longest: 64 * 1024,
            patience: 1.0,
        }
    }
}

/// Room for what the table of unfinished messages needs itself, bytes.
const OVERHEAD: usize = 16 * 1024;

impl TcmSettings {
    /// What is wrong with the numbers, as the field's path and a reason.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        if !(HEADER + 1..=LARGEST_DATAGRAM).contains(&self.datagram) {
            let message =
                format!("must be between {} and {LARGEST_DATAGRAM}, not {}", HEADER + 1, self.datagram);
            return Some(("datagram", message));
        }
        let counts = [
            ("queue.capacity", self.queue.capacity),
            ("takes", self.takes),
            ("unfinished", self.unfinished),
            ("longest", self.longest),
        ];
        if let Some((field, _)) = counts.into_iter().find(|(_, count)| *count == 0) {
            return Some((field, "must be at least 1".into()));
        }
        (!(self.patience.is_finite() && self.patience > 0.0))
            .then(|| ("patience", format!("must be a positive number of seconds, not {}", self.patience)))
    }

    /// What an assembly may cost.
    pub fn limits(&self, clock: &Clock) -> Limits {
        Limits {
            messages: self.unfinished,
            bytes: 4 * self.longest + OVERHEAD,
            message_bytes: self.longest,
            patience: clock.ticks(self.patience),
        }
    }
}
