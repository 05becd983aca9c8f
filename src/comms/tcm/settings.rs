//! How a team communication module is set up, as data: a part of a match file.

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};

use super::fragments::{HEADER, LARGEST_DATAGRAM, Limits, USUAL_DATAGRAM};
use super::queues::{QueueRule, WhenFull};
use crate::clock::Clock;
use crate::data::{Bound, Fault, Validate, check_count};

/// A field that a file leaves out has its default.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TcmSettings {
    /// Largest datagram, bytes; longer messages are cut.
    pub datagram: usize,
    /// The queue of each module.
    pub queue: QueueRule,
    /// Messages that the TCM takes from a robot's queues in one tick.
    pub messages_per_tick: usize,
    /// Unfinished messages that a robot keeps at a time.
    pub max_partial: usize,
    /// The longest message, bytes.
    pub longest: usize,
    /// How long the fragments of a message are kept while some are missing, s.
    pub timeout: f32,
}

impl Default for TcmSettings {
    fn default() -> TcmSettings {
        TcmSettings {
            datagram: USUAL_DATAGRAM,
            queue: QueueRule { capacity: 8, when_full: WhenFull::DropOldest },
            messages_per_tick: 16,
            max_partial: 16,
            longest: 64 * 1024,
            timeout: 1.0,
        }
    }
}

/// Room for what the table of unfinished messages needs itself, bytes.
const OVERHEAD: usize = 16 * 1024;

/// Messages in a queue, taken at a time or in assembly.
const MOST_MESSAGES: usize = 100_000;
/// A message, bytes.
const LONGEST: usize = 16 << 20;

impl Validate for TcmSettings {
    fn validate(&self) -> Result<(), Fault> {
        check_count("datagram", "", self.datagram, HEADER + 1..=LARGEST_DATAGRAM)?;
        check_count("queue.capacity", "", self.queue.capacity, 1..=MOST_MESSAGES)?;
        check_count("messages_per_tick", "", self.messages_per_tick, 1..=MOST_MESSAGES)?;
        check_count("max_partial", "", self.max_partial, 1..=MOST_MESSAGES)?;
        check_count("longest", "", self.longest, 1..=LONGEST)?;
        Bound::SECONDS.positive().check("timeout", self.timeout)
    }
}

impl TcmSettings {
    /// What an assembly may cost.
    pub fn limits(&self, clock: &Clock) -> Limits {
        Limits {
            messages: self.max_partial,
            bytes: 4 * self.longest + OVERHEAD,
            message_bytes: self.longest,
            timeout: clock.ticks(self.timeout),
        }
    }
}
