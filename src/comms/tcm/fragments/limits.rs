//! What assembling messages may cost.

use serde::{Deserialize, Serialize};

use crate::data::{Fault, Validate, ensure};

/// What an assembly may cost, and how long it waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Unfinished messages at a time. So many that are over are remembered too, so that their late fragments do no harm.
    pub messages: usize,
    /// Memory for unfinished messages, bytes: the pieces that have arrived, and for each piece and each message what the
    /// table itself needs.
    pub bytes: usize,
    /// The longest data of a message, bytes.
    pub message_bytes: usize,
    /// An unfinished message is given up this many ticks after its first fragment.
    pub timeout: u64,
}

/// What an entry of either table is counted as besides its pieces, bytes; and a piece besides its bytes. Both are more
/// than B-trees at their emptiest and an allocator need.
pub(super) const ENTRY_COST: usize = 512;
pub(super) const PIECE_COST: usize = 96;

impl Limits {
    /// The most memory that an assembly with these limits is counted as, bytes. Not counted are up to 4 KiB that tables
    /// with a single entry take, and the data of a message that is handed over.
    pub fn memory(&self) -> usize {
        self.bytes.saturating_add(self.messages.saturating_mul(ENTRY_COST))
    }
}

impl Validate for Limits {
    fn validate(&self) -> Result<(), Fault> {
        ensure(self.messages > 0, "messages", || "must be at least 1, not 0".into())?;
        ensure(self.timeout > 0, "timeout", || "must be at least 1, not 0".into())?;
        let least = self.message_bytes.saturating_add(ENTRY_COST + 2 * PIECE_COST);
        ensure(self.bytes >= least, "bytes", || {
            format!("must be at least {least}, for one message of message_bytes, not {}", self.bytes)
        })
    }
}

/// Room for a few pictures at a time, and two seconds of 60 ticks.
impl Default for Limits {
    fn default() -> Limits {
        Limits { messages: 64, bytes: 4 << 20, message_bytes: 1 << 20, timeout: 120 }
    }
}
