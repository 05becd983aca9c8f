//! What a tick leaves behind by which another play of the same match can be compared with it, tick by tick: a few bits of a hash
//! for each robot, for the ball, and for each part of what the digest holds.

use std::fmt;
use std::hash::BuildHasher;

use bevy::prelude::*;
use smallvec::SmallVec;
use xxhash_rust::xxh3::Xxh3DefaultBuilder;

use super::digest::{BodyKey, BodyWords, DigestedBody, sorted};
use super::figures::Record;
use crate::comms::radio::RadioRecord;
use crate::ids::RobotId;
use crate::world::referee::MatchState;

/// The trace of one tick. All but the digest's are four bits each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TickTrace {
    /// The last bits of the digest, which grows from tick to tick: what has once parted stays apart.
    pub digest: u8,
    /// Robots in order, each with its trailer, and the ball.
    pub bodies: SmallVec<[u8; 17]>,
    /// In the order of [`DigestPart::TRACED`].
    pub parts: [u8; 5],
}

/// A part of what the digest holds, by the name of the component or resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "each is the component or resource of that name")]
pub enum DigestPart {
    Role,
    Activity,
    Swapping,
    MatchState,
    RadioRecord,
    Pose,
}

impl DigestPart {
    /// Those that have a trace of their own. Poses differ where a body does and nothing else of it.
    pub const TRACED: [DigestPart; 5] = [
        DigestPart::Role,
        DigestPart::Activity,
        DigestPart::Swapping,
        DigestPart::MatchState,
        DigestPart::RadioRecord,
    ];

    fn is_of_bodies(self) -> bool {
        !matches!(self, DigestPart::MatchState | DigestPart::RadioRecord)
    }
}

impl fmt::Display for DigestPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

/// The robot, or the ball if it is none.
type Owner = Option<RobotId>;

/// Where two traces of a tick differ first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceDifference {
    /// Whose body differs; none if no body does.
    pub body: Option<Owner>,
    /// What differs, if the traces tell.
    pub part: Option<DigestPart>,
}

impl TickTrace {
    /// The trace of the tick that was just played.
    pub fn take(world: &mut World) -> TickTrace {
        let mut bodies = world.query::<DigestedBody>();
        let bodies = sorted(bodies.iter(world));
        let state = world.resource::<MatchState>();
        let column = |word: usize| four_bits(bodies.iter().map(|(_, words)| words[word]));
        let score = four_bits([state.score[0], state.score[1], state.phase as u32]);
        let radio = four_bits([world.resource::<RadioRecord>().transmitted()]);
        let rows = owners(bodies.iter().map(|(key, _)| *key));
        let row =
            |owner: &Owner| four_bits(bodies.iter().filter(|(key, _)| owner_of(*key) == *owner).map(words));
        TickTrace {
            digest: world.resource::<Record>().digest as u8,
            bodies: rows.iter().map(row).collect(),
            parts: [column(3), column(4), column(5), score, radio],
        }
    }

    /// Where another play of the same tick differs first; none if it does not.
    pub fn difference(&self, played: &TickTrace, world: &mut World) -> Option<TraceDifference> {
        if self == played {
            return None;
        }
        let mut bodies = world.query::<DigestedBody>();
        let owners = owners(sorted(bodies.iter(world)).into_iter().map(|(key, _)| key));
        let differ = self.bodies.iter().zip(&played.bodies).position(|(one, other)| one != other);
        let body = differ.and_then(|place| owners.get(place).copied());
        let mut parts = DigestPart::TRACED.iter().zip(self.parts.iter().zip(&played.parts));
        let part = parts.find(|(_, (one, other))| one != other).map(|(part, _)| *part);
        let pose = body.map(|_| DigestPart::Pose);
        let part = part.filter(|part| body.is_some() == part.is_of_bodies()).or(pose).or(part);
        Some(TraceDifference { body, part })
    }
}

fn words((_, words): &(BodyKey, BodyWords)) -> BodyWords {
    *words
}

fn four_bits(words: impl IntoIterator<Item = impl std::hash::Hash>) -> u8 {
    let words: SmallVec<[_; 24]> = words.into_iter().collect();
    (Xxh3DefaultBuilder.hash_one(words.as_slice()) & 0xF) as u8
}

fn owner_of(key: BodyKey) -> Owner {
    match key {
        BodyKey::Robot(robot) | BodyKey::Trailer(robot) => Some(robot),
        BodyKey::Ball => None,
    }
}

/// Robots in order, then the ball.
fn owners(keys: impl Iterator<Item = BodyKey>) -> SmallVec<[Owner; 17]> {
    keys.filter(|key| !matches!(key, BodyKey::Trailer(_))).map(owner_of).collect()
}
