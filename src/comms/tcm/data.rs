//! What modules exchange, and the table of the types that are known (TeamChaos, section 3): a module that sends or
//! receives a type says how it is serialised and unserialised; the TCM does the rest.

use std::collections::BTreeMap;

use bevy::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::external_message::{self, DataType, Module};
use super::kind::MessageKind;
use crate::protocol::role_swap::Sequence;

/// A type of data that modules exchange.
pub trait Data: Clone + Send + Sync + 'static {
    const TYPE: DataType;
    /// The module that sends it.
    const MODULE: Module;
    /// As people call it.
    const NAME: &'static str;

    fn serialise(&self) -> Vec<u8>;

    /// The data in these bytes; nothing, if they are none.
    fn unserialise(bytes: &[u8]) -> Option<Self>;

    /// What fault rules and filters of the radio take it for.
    fn kind(&self) -> MessageKind {
        MessageKind::Other
    }

    /// The attempt of a role swap that it belongs to.
    fn sequence(&self) -> Option<Sequence> {
        None
    }
}

/// Data as [postcard](https://postcard.jamesmunns.com/wire-format), the format of Touchline's own types.
pub fn to_postcard(data: &impl Serialize) -> Vec<u8> {
    // Fails for types of unknown length only, of which there are none here.
    postcard::to_stdvec(data).unwrap_or_default()
}

/// The data in these bytes; nothing, if they are none from beginning to end, or none that is sound.
pub fn from_postcard<T: DeserializeOwned>(bytes: &[u8], is_sound: impl Fn(&T) -> bool) -> Option<T> {
    let (data, rest) = postcard::take_from_bytes::<T>(bytes).ok()?;
    (rest.is_empty() && is_sound(&data)).then_some(data)
}

/// Triggered at a robot when data of a registered type have reached it: the paper's callback. Observe it to receive a type.
#[derive(EntityEvent, Clone, Debug)]
pub struct Arrived<T: Data> {
    /// The robot.
    pub entity: Entity,
    pub from: external_message::Entity,
    pub data: T,
}

/// The types of data that somebody has registered; they outlast a match.
#[derive(Resource, Clone, Debug, Default)]
pub struct Registry(BTreeMap<DataType, Registered>);

/// A registered type.
#[derive(Clone, Copy, Debug)]
pub struct Registered {
    pub name: &'static str,
    /// The module that sends it.
    pub module: Module,
    pub(super) deliver: Deliver,
}

/// Unserialises the bytes and hands them to their observers; tells whether that was possible.
type Deliver = fn(&mut Commands, Entity, external_message::Entity, &[u8]) -> bool;

impl Registry {
    pub(super) fn get(&self, data_type: DataType) -> Option<&Registered> {
        self.0.get(&data_type)
    }

    /// In the order of their numbers.
    pub fn types(&self) -> impl Iterator<Item = (DataType, &Registered)> {
        self.0.iter().map(|(data_type, registered)| (*data_type, registered))
    }
}

/// Registers types of data with an app.
pub trait RegisterData {
    /// From now on data of this type are unserialised when they arrive, and [`Arrived`] is triggered.
    fn register_data<T: Data>(&mut self) -> &mut Self;
}

impl RegisterData for App {
    fn register_data<T: Data>(&mut self) -> &mut App {
        let deliver: Deliver = |commands, entity, from, bytes| {
            let data = T::unserialise(bytes);
            data.map(|data| commands.trigger(Arrived { entity, from, data })).is_some()
        };
        let registered = Registered { name: T::NAME, module: T::MODULE, deliver };
        self.world_mut().get_resource_or_init::<Registry>().0.insert(T::TYPE, registered);
        self
    }
}
