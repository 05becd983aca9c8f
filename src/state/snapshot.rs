//! A copy of a whole match, which can be put back: into the same world, or into another in which the same match was started.
//!
//! The bodies of a match are told by their names. What has no name, as a message in flight, comes and goes.

use std::collections::BTreeMap;
use std::fmt;

use bevy::prelude::*;
use xxhash_rust::xxh3::Xxh3Default;

use super::copies::SavedState;
use super::{StateKind, StateRegister};
use crate::ids::MatchEntity;

/// All registered state of a match between two ticks. Sockets are no part of it.
pub struct Snapshot {
    kinds: Vec<StateKind>,
    /// By the place of their kind; none where the kind is one of components.
    resources: Vec<Option<SavedState>>,
    entities: Vec<SavedEntity>,
}

struct SavedEntity {
    name: Option<Name>,
    /// By the place of their kind.
    components: Vec<Option<SavedState>>,
}

/// The match in the world has other bodies than the one in a snapshot.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the snapshot is of another match: only one of the two has `{0}`")]
pub struct OtherMatch(String);

/// The first thing in which two snapshots differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The name of the entity; none for a resource.
    pub entity: Option<String>,
    /// The component or resource.
    pub kind: &'static str,
    /// The first line of it that differs, in both.
    pub lines: [String; 2],
}

impl Snapshot {
    /// Copies the match in a world.
    pub fn take(world: &mut World) -> Snapshot {
        let kinds = world.resource::<StateRegister>().kinds.clone();
        let mut entities = world.query_filtered::<(Entity, Option<&Name>), With<MatchEntity>>();
        let world = &*world;
        let components = |entity| kinds.iter().map(|kind| kind.saved(world, Some(entity))).collect();
        let saved = |(entity, name): (Entity, Option<&Name>)| SavedEntity {
            name: name.cloned(),
            components: components(entity),
        };
        Snapshot {
            entities: entities.iter(world).map(saved).collect(),
            resources: kinds.iter().map(|kind| kind.saved(world, None)).collect(),
            kinds,
        }
    }

    /// Puts the match back: it goes on as it went on after it was copied.
    ///
    /// # Errors
    /// If another match is in the world. Then nothing changes.
    pub fn restore(&self, world: &mut World) -> Result<(), OtherMatch> {
        let mut entities = world.query_filtered::<(Entity, Option<&Name>), With<MatchEntity>>();
        let (named, passing): (Vec<_>, Vec<_>) = entities
            .iter(world)
            .map(|(entity, name)| (name.cloned(), entity))
            .partition(|(name, _)| name.is_some());
        let named: BTreeMap<Option<Name>, Entity> = named.into_iter().collect();
        self.check_names(&named)?;
        passing.into_iter().for_each(|(_, entity)| {
            world.despawn(entity);
        });
        for saved in &self.entities {
            let known = named.get(&saved.name).copied();
            let entity = known.unwrap_or_else(|| world.spawn(MatchEntity).id());
            for (kind, component) in self.kinds.iter().zip(&saved.components) {
                kind.put_back(world, Some(entity), component.as_ref());
            }
        }
        for (kind, resource) in self.kinds.iter().zip(&self.resources) {
            kind.put_back(world, None, resource.as_ref());
        }
        world.flush();
        Ok(())
    }

    fn check_names(&self, there: &BTreeMap<Option<Name>, Entity>) -> Result<(), OtherMatch> {
        let here = || self.entities.iter().map(|entity| &entity.name).filter(|name| name.is_some());
        let missing = here().find(|name| !there.contains_key(*name));
        let extra = || there.keys().find(|name| here().all(|known| known != *name));
        let other = missing.or_else(extra).cloned().flatten();
        other.map_or(Ok(()), |name| Err(OtherMatch(name.to_string())))
    }

    /// Equal for equal states of equal matches.
    pub fn digest(&self) -> u64 {
        let mut hasher = Xxh3Default::new();
        for StateText { entity, kind, text } in self.parts() {
            for word in [entity.as_deref().unwrap_or_default(), kind, &text] {
                hasher.update(word.as_bytes());
                hasher.update(&[0]);
            }
        }
        hasher.digest()
    }

    /// Tells everything: of which entity, if it is not a resource, and of which kind, and as which text. In an order that is
    /// the same for equal matches.
    pub fn tell(&self, mut to: impl FnMut(Option<&str>, &'static str, &str)) {
        self.parts().iter().for_each(|part| to(part.entity.as_deref(), part.kind, &part.text));
    }

    /// The first thing that differs.
    pub fn difference(&self, other: &Snapshot) -> Option<Difference> {
        let (here, there) = (self.parts(), other.parts());
        let length = here.len().max(there.len());
        (0..length).find_map(|i| difference(here.get(i), there.get(i)))
    }

    /// Everything as text: resources first, then entities by name, then what has none, whatever its order.
    fn parts(&self) -> Vec<StateText> {
        let resources = self.texts(None, &self.resources);
        let mut entities: Vec<Vec<StateText>> = (self.entities.iter())
            .map(|saved| {
                let name = saved.name.as_ref().map_or("without a name", Name::as_str);
                self.texts(Some(name), &saved.components).collect()
            })
            .collect();
        entities.sort();
        resources.chain(entities.into_iter().flatten()).collect()
    }

    fn texts(&self, entity: Option<&str>, saved: &[Option<SavedState>]) -> impl Iterator<Item = StateText> {
        let texts = self.kinds.iter().zip(saved).filter_map(|(kind, saved)| Some((kind, saved.as_ref()?)));
        texts.map(move |(kind, saved)| StateText {
            entity: entity.map(str::to_owned),
            kind: kind.name,
            text: kind.copies.text(saved),
        })
    }
}

impl StateKind {
    /// What an entity has of this kind, or the world if it is a resource, for people to read.
    pub fn tell(&self, world: &World, entity: Option<Entity>) -> Option<String> {
        self.saved(world, entity).map(|saved| self.copies.text(&saved))
    }

    /// Whether an entity, or the world if it is a resource, has something of this kind.
    pub fn is_there(&self, world: &World, entity: Option<Entity>) -> bool {
        let id = self.copies.id(world);
        let owner = self.owner(world, entity).and_then(|owner| world.get_entity(owner).ok());
        owner.zip(id).is_some_and(|(owner, id)| owner.contains_id(id))
    }

    /// What an entity has of this kind, or the world if it is a resource.
    fn saved(&self, world: &World, entity: Option<Entity>) -> Option<SavedState> {
        let owner = self.owner(world, entity)?;
        self.copies.save(world.get_entity(owner).ok()?)
    }

    fn put_back(&self, world: &mut World, entity: Option<Entity>, saved: Option<&SavedState>) {
        let owner = self.owner(world, entity);
        match (owner, saved) {
            (Some(owner), Some(saved)) => self.copies.load(&mut world.entity_mut(owner), saved),
            (Some(owner), None) => self.copies.remove(&mut world.entity_mut(owner)),
            (None, Some(saved)) => self.copies.load(&mut world.spawn_empty(), saved),
            (None, None) => {}
        }
    }

    /// Bevy keeps a resource as a component of an entity of its own.
    fn owner(&self, world: &World, entity: Option<Entity>) -> Option<Entity> {
        match entity {
            None if self.is_resource => world.resource_entities().get(self.copies.id(world)?),
            None => None,
            Some(_) => entity.filter(|_| !self.is_resource),
        }
    }
}

/// A component or a resource as text.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct StateText {
    entity: Option<String>,
    kind: &'static str,
    text: String,
}

fn difference(here: Option<&StateText>, there: Option<&StateText>) -> Option<Difference> {
    if here == there {
        return None;
    }
    let part = here.or(there)?;
    let same_place = |other: &&StateText| (&other.entity, other.kind) == (&part.entity, part.kind);
    let text = |other: Option<&StateText>| {
        other.filter(same_place).map_or("it is not there", |part| &part.text).to_owned()
    };
    let (here, there) = (text(here), text(there));
    let pair = here.lines().zip(there.lines()).find(|(a, b)| a != b);
    let (a, b) = pair.unwrap_or((&here, &there));
    let lines = [a, b].map(|line| line.trim().to_owned());
    Some(Difference { entity: part.entity.clone(), kind: part.kind, lines })
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [here, there] = &self.lines;
        let owner = self.entity.as_ref().map_or("the resource ".into(), |entity| format!("{entity}'s "));
        write!(f, "{owner}{}: `{here}` and then `{there}`", self.kind)
    }
}
