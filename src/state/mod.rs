//! The state of a match, registered once by the stage that owns it, as bevy_ggrs registers what it rolls back.
//!
//! A plugin registers each of its resources and components, with how they start and what the events of a robot do to them:
//!
//! ```
//! # use bevy::prelude::*;
//! # use touchline::comms::radio::RadioRecord;
//! # use touchline::robot::{Percepts, PutDown, RobotStart};
//! # use touchline::state::RegisterState;
//! # let mut app = App::new();
//! app.match_resource::<RadioRecord>().starts_empty();
//! app.match_component::<Percepts>()
//!     .starts(|_: &RobotStart, _| Percepts::default())
//!     .on(|percepts, _: &PutDown, _| *percepts = Percepts::default());
//! ```
//!
//! From the register a match starts ([`begin`]), robots start and change ([`apply_event`]), a whole match is copied and put back
//! ([`Snapshot`]), ticks are replayed to find what does not repeat ([`replay`]), and the world view has its names.
//!
//! Changes run in the order of registration, which is the order of the stages: a robot that is switched on has its role first,
//! then the activity of that role. Observers would run in no promised order. A change alters the component that it is registered
//! with and nothing else; it may look at the robot's other components.

mod copies;
mod replay;
mod snapshot;
#[cfg(test)]
mod tests;

use std::any::{Any, TypeId, type_name};
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::marker::PhantomData;
use std::sync::Arc;

use bevy::ecs::component::{ComponentId, Mutable};
use bevy::prelude::*;
use bevy::reflect::GetTypeRegistration;
use copies::{Copies, InParts, Whole};

pub use replay::replay;
pub use snapshot::{Difference, OtherMatch, Snapshot};

/// All state that belongs to a match.
#[derive(Resource, Clone, Default)]
pub struct StateRegister {
    kinds: Vec<StateKind>,
    starts: Vec<fn(&mut World)>,
    reactions: BTreeMap<TypeId, Vec<Reaction>>,
}

type Reaction = Arc<dyn Fn(&mut World, Entity, &dyn Any) + Send + Sync>;

/// One type of state: a resource, or a component of the entities of a match.
#[derive(Clone)]
pub struct StateKind {
    /// Bevy's number of the type.
    pub id: ComponentId,
    /// The type, without its path.
    pub name: &'static str,
    /// Whether it is a resource; else a component.
    pub is_resource: bool,
    copies: Arc<dyn Copies>,
}

impl StateRegister {
    /// In the order of registration.
    pub fn kinds(&self) -> &[StateKind] {
        &self.kinds
    }
}

/// Inserts the resources that start empty.
pub fn begin(world: &mut World) {
    let starts = world.resource::<StateRegister>().starts.clone();
    starts.into_iter().for_each(|start| start(world));
}

/// Something happens to an entity: its state starts or changes as it is registered, in the order of registration.
pub fn apply_event<E: Any>(world: &mut World, entity: Entity, event: &E) {
    let reactions = world.resource::<StateRegister>().reactions.get(&TypeId::of::<E>()).cloned();
    for react in reactions.into_iter().flatten() {
        react(world, entity, event);
    }
}

/// [Applies](apply_event) an event as a command.
pub fn event<E: Any + Send + Sync>(event: E) -> impl EntityCommand {
    move |mut target: EntityWorldMut| {
        let entity = target.id();
        target.world_scope(|world| apply_event(world, entity, &event));
    }
}

/// Registers the state of a match.
pub trait RegisterState {
    /// A resource of a match. Without more it comes from the plan, which must insert it.
    fn match_resource<T: Resource + Clone + Debug>(&mut self) -> Registering<'_, T>;
    /// A component of the entities of a match.
    fn match_component<T: Component + Clone + Debug>(&mut self) -> Registering<'_, T>;
    /// A component with parts that cannot be copied or told, such as workspace: what is saved of it, how that is put back into a
    /// component that is there, and as which text it is told.
    fn match_component_by<T: Component<Mutability = Mutable>, C: Any + Send + Sync>(
        &mut self,
        save: fn(&T) -> C,
        load: fn(&C, &mut T),
        text: fn(&C) -> String,
    ) -> Registering<'_, T>;
}

/// Says more of a type that was just registered.
pub struct Registering<'a, T> {
    app: &'a mut App,
    of: PhantomData<T>,
}

impl RegisterState for App {
    fn match_resource<T: Resource + Clone + Debug>(&mut self) -> Registering<'_, T> {
        register(self, true, Whole::<T>(PhantomData))
    }

    fn match_component<T: Component + Clone + Debug>(&mut self) -> Registering<'_, T> {
        register(self, false, Whole::<T>(PhantomData))
    }

    fn match_component_by<T: Component<Mutability = Mutable>, C: Any + Send + Sync>(
        &mut self,
        save: fn(&T) -> C,
        load: fn(&C, &mut T),
        text: fn(&C) -> String,
    ) -> Registering<'_, T> {
        register(self, false, InParts { save, load, text })
    }
}

fn register<T: Component>(
    app: &mut App,
    is_resource: bool,
    copies: impl Copies + 'static,
) -> Registering<'_, T> {
    let id = app.world_mut().register_component::<T>();
    let mut register = app.world_mut().get_resource_or_init::<StateRegister>();
    if register.kinds.iter().all(|known| known.id != id) {
        register.kinds.push(StateKind { id, name: short_name::<T>(), is_resource, copies: Arc::new(copies) });
    }
    Registering { app, of: PhantomData }
}

/// The name of a type without its path.
fn short_name<T>() -> &'static str {
    type_name::<T>().rsplit("::").next().unwrap_or_default()
}

impl<T: Resource + Default> Registering<'_, T> {
    /// The resource is empty when a match begins.
    pub fn starts_empty(mut self) {
        self.app.init_resource::<T>();
        self.register().starts.push(|world| world.insert_resource(T::default()));
    }
}

impl<T: Component> Registering<'_, T> {
    /// How the component starts when something begins to exist.
    pub fn starts<E: Any>(self, start: fn(&E, &World) -> T) -> Self {
        self.react(move |world, entity, event: &E| {
            let value = start(event, world);
            world.entity_mut(entity).insert(value);
        })
    }

    /// How the component starts, if it is there at all.
    pub fn may_start<E: Any>(self, start: fn(&E, &World) -> Option<T>) -> Self {
        self.react(move |world, entity, event: &E| {
            if let Some(value) = start(event, world) {
                world.entity_mut(entity).insert(value);
            }
        })
    }

    fn react<E: Any>(mut self, react: impl Fn(&mut World, Entity, &E) + Send + Sync + 'static) -> Self {
        let reaction: Reaction = Arc::new(move |world, entity, event: &dyn Any| {
            if let Some(event) = event.downcast_ref::<E>() {
                react(world, entity, event);
            }
        });
        self.register().reactions.entry(TypeId::of::<E>()).or_default().push(reaction);
        self
    }

    fn register(&mut self) -> Mut<'_, StateRegister> {
        self.app.world_mut().resource_mut::<StateRegister>()
    }
}

impl<T: Component<Mutability = Mutable> + Clone> Registering<'_, T> {
    /// What an event does to the component. The entity is for looking at the robot's other components.
    pub fn on<E: Any>(self, change: fn(&mut T, &E, EntityRef)) -> Self {
        self.react(move |world, entity, event: &E| {
            let Some(mut value) = world.get::<T>(entity).cloned() else { return };
            change(&mut value, event, world.entity(entity));
            world.entity_mut(entity).insert(value);
        })
    }
}

impl<T: Component + GetTypeRegistration> Registering<'_, T> {
    /// The type can be looked at field by field.
    pub fn reflected(self) -> Self {
        self.app.register_type::<T>();
        self
    }
}
