//! Who looks on at a match and keeps something of it: no part of the match, but it goes back with it.

use std::any::Any;

use bevy::prelude::*;

/// A copy of what an onlooker keeps.
pub(super) type Kept = Box<dyn Any + Send + Sync>;

/// All who look on in a world.
#[derive(Resource, Clone, Default)]
pub(super) struct Onlookers(Vec<Onlooker>);

#[derive(Clone, Copy)]
struct Onlooker {
    save: fn(&World) -> Option<Kept>,
    load: fn(&mut World, &Kept),
}

/// Registers resources that keep something of a match without being part of it, such as the judge of a scenario.
pub trait GoesBack {
    /// When the match goes back, so does this resource. What looks after each tick keeps it up to date.
    fn goes_back<T: Resource + Clone>(&mut self) -> &mut Self;
}

impl GoesBack for App {
    fn goes_back<T: Resource + Clone>(&mut self) -> &mut App {
        self.world_mut().get_resource_or_init::<Onlookers>().0.push(Onlooker {
            save: |world| world.get_resource::<T>().map(|kept| Box::new(kept.clone()) as Kept),
            load: |world, kept| {
                if let Some(kept) = kept.downcast_ref::<T>() {
                    world.insert_resource(kept.clone());
                }
            },
        });
        self
    }
}

/// What all of them keep now, in the order of registration.
pub(super) fn save(world: &World) -> Vec<Option<Kept>> {
    let onlookers = world.get_resource::<Onlookers>().map(|all| &all.0[..]).unwrap_or_default();
    onlookers.iter().map(|onlooker| (onlooker.save)(world)).collect()
}

/// Gives them back what they kept.
pub(super) fn load(world: &mut World, kept: &[Option<Kept>]) {
    let Some(Onlookers(all)) = world.get_resource::<Onlookers>().cloned() else { return };
    for (onlooker, kept) in all.iter().zip(kept) {
        if let Some(kept) = kept {
            (onlooker.load)(world, kept);
        }
    }
}
