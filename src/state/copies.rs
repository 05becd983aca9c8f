//! How types of state are copied and put back.

use std::any::Any;
use std::fmt::Debug;
use std::marker::PhantomData;

use bevy::ecs::component::{ComponentId, Mutable};
use bevy::prelude::*;

/// A copy of one component or resource.
pub(super) type SavedState = Box<dyn Any + Send + Sync>;

/// How a type of state is copied, put back and told.
pub(super) trait Copies: Send + Sync {
    /// Bevy's number of the type, which each world gives for itself.
    fn id(&self, world: &World) -> Option<ComponentId>;
    fn save(&self, owner: EntityRef) -> Option<SavedState>;
    fn load(&self, owner: &mut EntityWorldMut, saved: &SavedState);
    fn remove(&self, owner: &mut EntityWorldMut);
    fn text(&self, saved: &SavedState) -> String;
}

/// A component that is copied whole.
pub(super) struct Whole<T>(pub PhantomData<T>);

impl<T: Component + Clone + Debug> Copies for Whole<T> {
    fn id(&self, world: &World) -> Option<ComponentId> {
        world.component_id::<T>()
    }

    fn save(&self, owner: EntityRef) -> Option<SavedState> {
        owner.get::<T>().map(|value| Box::new(value.clone()) as SavedState)
    }

    fn load(&self, owner: &mut EntityWorldMut, saved: &SavedState) {
        if let Some(value) = saved.downcast_ref::<T>() {
            owner.insert(value.clone());
        }
    }

    fn remove(&self, owner: &mut EntityWorldMut) {
        owner.remove::<T>();
    }

    fn text(&self, saved: &SavedState) -> String {
        saved.downcast_ref::<T>().map_or_else(String::new, |value| format!("{value:#?}"))
    }
}

/// A component of which parts are copied.
pub(super) struct InParts<T, C> {
    pub save: fn(&T) -> C,
    pub load: fn(&C, &mut T),
    pub text: fn(&C) -> String,
}

impl<T: Component<Mutability = Mutable>, C: Any + Send + Sync> Copies for InParts<T, C> {
    fn id(&self, world: &World) -> Option<ComponentId> {
        world.component_id::<T>()
    }

    fn save(&self, owner: EntityRef) -> Option<SavedState> {
        owner.get::<T>().map(|value| Box::new((self.save)(value)) as SavedState)
    }

    fn load(&self, owner: &mut EntityWorldMut, saved: &SavedState) {
        if let (Some(copy), Some(mut value)) = (saved.downcast_ref::<C>(), owner.get_mut::<T>()) {
            (self.load)(copy, &mut value);
        }
    }

    fn remove(&self, owner: &mut EntityWorldMut) {
        owner.remove::<T>();
    }

    fn text(&self, saved: &SavedState) -> String {
        saved.downcast_ref::<C>().map_or_else(String::new, |copy| (self.text)(copy))
    }
}
