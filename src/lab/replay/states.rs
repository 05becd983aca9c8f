//! A short hash of all state of a match, by entity and by kind: it finds what the digest does not hold.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3Default;

use crate::state::Snapshot;

/// A short hash of each entity's state and of each kind of state.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct StateHashes {
    /// The resources, then each entity by its name; those without a name together.
    entities: Vec<u16>,
    /// In the order of registration, which is that of the stages of a tick.
    kinds: Vec<u16>,
}

/// Differs between a match that is played and one that is replayed.
const OF_THE_DOOR: [&str; 3] = ["Script", "Requests", "RequestLog"];

/// The names to the hashes.
#[derive(Clone, Debug, Default)]
pub(super) struct StateNames {
    entities: Vec<String>,
    kinds: Vec<&'static str>,
}

/// The hashes of the match in a world.
pub(super) fn hashes(world: &mut World) -> (StateHashes, StateNames) {
    let (mut hashes, mut names) = (StateHashes::default(), StateNames::default());
    let (mut entities, mut kinds): (Vec<Xxh3Default>, Vec<Xxh3Default>) = (Vec::new(), Vec::new());
    Snapshot::take(world).tell(|entity, kind, text| {
        if OF_THE_DOOR.contains(&kind) {
            return;
        }
        let entity = entity.unwrap_or("the match");
        let row = place(&mut names.entities, |name| name == entity, || entity.to_owned());
        let column = place(&mut names.kinds, |name| *name == kind, || kind);
        for (list, at) in [(&mut entities, row), (&mut kinds, column)] {
            list.resize_with(list.len().max(at + 1), Xxh3Default::new);
            list[at].update(text.as_bytes());
        }
    });
    let short = |list: Vec<Xxh3Default>| list.iter().map(|hasher| hasher.digest() as u16).collect();
    (hashes.entities, hashes.kinds) = (short(entities), short(kinds));
    (hashes, names)
}

fn place<T>(list: &mut Vec<T>, is: impl Fn(&T) -> bool, new: impl FnOnce() -> T) -> usize {
    list.iter().position(is).unwrap_or_else(|| {
        list.push(new());
        list.len() - 1
    })
}

impl StateHashes {
    /// The first entity and the first kind of state in which both differ.
    pub fn difference(&self, other: &StateHashes, names: &StateNames) -> Option<(String, String)> {
        if self == other {
            return None;
        }
        let first = |one: &[u16], other: &[u16]| {
            let differ = one.iter().zip(other).position(|(one, other)| one != other);
            differ.unwrap_or(one.len().min(other.len()))
        };
        let entity = names.entities.get(first(&self.entities, &other.entities));
        let kind = names.kinds.get(first(&self.kinds, &other.kinds));
        let unknown = "something that is there in only one of them";
        Some((entity.map_or(unknown, String::as_str).into(), kind.map_or(unknown, |kind| *kind).into()))
    }
}
