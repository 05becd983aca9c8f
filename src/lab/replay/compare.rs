//! Another play of a recorded match, compared with the recording tick by tick.

use std::fmt;

use bevy::prelude::*;

use super::block::Block;
use super::reader::Replay;
use super::states::hashes;
use crate::clock::Clock;
use crate::game::record::{Record, TickTrace, TraceDifference};

/// Another play of a recorded match, compared with the recording tick by tick.
pub struct Comparison<'a> {
    traces: Box<dyn Iterator<Item = (TickTrace, &'a Block, bool)> + 'a>,
}

/// Where a play parts from the recording.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Parting {
    /// What happens in a tick is something else.
    Play { tick: u64, first: Option<TraceDifference> },
    /// Nothing else has happened, but in a state that the digest does not hold both differ after this tick.
    State { tick: u64, entity: String, kind: String },
}

impl<'a> Comparison<'a> {
    /// With a recording, from its first tick on.
    pub fn with(replay: &'a Replay) -> Comparison<'a> {
        Comparison { traces: Box::new(replay.traces()) }
    }

    /// Compares the tick that was just played; every tick is to be compared, one after the other.
    ///
    /// # Errors
    /// Where they part.
    pub fn check(&mut self, world: &mut World) -> Result<(), Parting> {
        let tick = world.resource::<Clock>().tick.saturating_sub(1);
        let Some((recorded, block, is_end)) = self.traces.next() else { return Ok(()) };
        let played = TickTrace::take(world);
        if recorded != played {
            return Err(Parting::Play { tick, first: recorded.difference(&played, world) });
        }
        if !is_end {
            return Ok(());
        }
        if let Some(recorded) = &block.states {
            let (played, names) = hashes(world);
            if let Some((entity, kind)) = recorded.difference(&played, &names) {
                return Err(Parting::State { tick, entity, kind });
            }
        }
        if block.digest != world.resource::<Record>().digest {
            return Err(Parting::Play { tick, first: None });
        }
        Ok(())
    }
}

impl fmt::Display for Parting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Parting::Play { tick, first } => {
                write!(f, "the match parts from its recording at tick {tick}")?;
                let Some(TraceDifference { body, part }) = first else { return Ok(()) };
                match body {
                    Some(Some(robot)) => write!(f, ", first in robot {robot}")?,
                    Some(None) => f.write_str(", first in the ball")?,
                    None => {}
                }
                part.map_or(Ok(()), |part| write!(f, ": {part}"))
            }
            Parting::State { tick, entity, kind } => write!(
                f,
                "the match parts from its recording before tick {}, in what cannot be seen yet: {entity}: {kind}",
                tick + 1
            ),
        }
    }
}
