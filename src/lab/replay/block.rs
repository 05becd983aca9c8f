//! One second of a recorded match.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::states::StateHashes;
use crate::data::DataError;
use crate::game::MatchPlan;
use crate::game::record::{DigestPart, TickTrace};
use crate::game::requests::Request;
use crate::ids::Team;
use crate::strategy::StrategyTexts;

/// One second of a recorded match, or what there was of the last one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Block {
    /// By tick, as they were carried out.
    pub requests: Vec<(u64, KeptRequest)>,
    pub traces: Traces,
    /// The digest at its end.
    pub digest: u64,
    /// At its end, now and then.
    pub states: Option<StateHashes>,
    pub bookmarks: Vec<Bookmark>,
    /// Whether the recording ended here as it should.
    pub is_last: bool,
}

/// A note that a person made about a tick.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bookmark {
    /// The tick.
    pub tick: u64,
    /// What they noted.
    pub note: String,
}

/// A request as it is kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum KeptRequest {
    Plain(Request),
    ChangeStrategy { team: Team, texts: Arc<StrategyTexts> },
}

impl KeptRequest {
    pub fn of(request: &Request) -> KeptRequest {
        match request {
            Request::ChangeStrategy { team, texts, .. } => {
                KeptRequest::ChangeStrategy { team: *team, texts: texts.clone() }
            }
            request => KeptRequest::Plain(request.clone()),
        }
    }

    /// The request, with strategies read from their texts.
    ///
    /// # Errors
    /// The first fault of a strategy.
    pub fn request(&self, plan: &MatchPlan) -> Result<Request, DataError> {
        match self {
            KeptRequest::Plain(request) => Ok(request.clone()),
            KeptRequest::ChangeStrategy { team, texts } => {
                let strategy = Arc::new(plan.read_kept(*team, texts).strategy?);
                Ok(Request::ChangeStrategy { team: *team, strategy, texts: texts.clone() })
            }
        }
    }
}

/// The traces of some ticks, one column after the other, since most columns stand still.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Traces {
    ticks: u8,
    /// Four bits each, two to a byte: bodies, then parts.
    columns: Vec<Vec<u8>>,
    digests: Vec<u8>,
}

const PARTS: usize = DigestPart::TRACED.len();

impl Traces {
    pub fn len(&self) -> u64 {
        self.ticks.into()
    }

    pub fn push(&mut self, trace: &TickTrace) {
        let row = trace.bodies.iter().chain(&trace.parts);
        self.columns.resize(trace.bodies.len() + PARTS, Vec::new());
        for (column, bits) in self.columns.iter_mut().zip(row) {
            match column.last_mut().filter(|_| self.ticks % 2 == 1) {
                Some(half) => *half |= bits << 4,
                None => column.push(*bits),
            }
        }
        self.digests.push(trace.digest);
        self.ticks += 1;
    }

    /// The trace of a tick, counted from the first one here.
    pub fn get(&self, tick: usize) -> Option<TickTrace> {
        let digest = *self.digests.get(tick)?;
        let bits = |column: &Vec<u8>| column.get(tick / 2).map_or(0, |two| two >> (4 * (tick % 2)) & 0xF);
        let row: SmallVec<[u8; 24]> = self.columns.iter().map(bits).collect();
        let (bodies, parts) = row.split_at_checked(row.len().checked_sub(PARTS)?)?;
        Some(TickTrace { digest, bodies: bodies.into(), parts: parts.try_into().ok()? })
    }

    /// Forgets the ticks from here on.
    pub fn truncate(&mut self, ticks: usize) {
        let kept: Vec<TickTrace> = (0..ticks).map_while(|tick| self.get(tick)).collect();
        *self = Traces::default();
        kept.iter().for_each(|trace| self.push(trace));
    }
}
