//! What modules exchange, and the table of the types that are known (TeamChaos, section 3): a module that wants to send or
//! receive a type says how it is serialised and unserialised; the TCM does the rest.

use std::collections::BTreeMap;

use bevy::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::external_message::{Address, DataType, ExternalMessage, Module, Peer};

/// Data that modules exchange: one data type, or several that are one type in the program. `data!`
/// writes the implementation.
pub trait Data: Clone + Send + Sync + 'static {
    /// The data types that it may be.
    const TYPES: &'static [TypeInfo];

    /// Which of them it is, and its bytes.
    fn serialise(&self) -> (&'static TypeInfo, Vec<u8>);

    /// The data in these bytes; nothing, if they are none of this type.
    fn unserialise(data_type: DataType, bytes: &[u8]) -> Option<Self>;
}

/// What is to know of a data type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TypeInfo {
    /// On the wire.
    pub number: DataType,
    /// As people call it.
    pub name: &'static str,
    /// The module that sends it.
    pub module: Module,
    /// Which goes first where not all can go.
    pub priority: Priority,
}

/// Which messages go first where a budget does not bear all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Priority {
    /// News that is sent again and again.
    Routine,
    /// A step of a protocol, for which others wait.
    Urgent,
}

/// Makes a type [`Data`] in the format of Touchline's own types, postcard. Each row is a data type: its number, name,
/// module and priority, the values that it stands for, what is written of them, and what a value must satisfy when it is read.
macro_rules! data {
    ($data:ty {
        $($number:path, $name:literal, $module:expr, $priority:ident; ($($value:tt)+) = $written:tt: $type:ty $(, if $is_sound:expr)?;)+
    }) => {
        impl $crate::comms::tcm::Data for $data {
            const TYPES: &'static [$crate::comms::tcm::TypeInfo] = {
                use $crate::comms::tcm::{Priority, TypeInfo};
                &[$(TypeInfo { number: $number, name: $name, module: $module, priority: Priority::$priority }),+]
            };

            fn serialise(&self) -> (&'static $crate::comms::tcm::TypeInfo, Vec<u8>) {
                use $crate::comms::tcm::{Priority, TypeInfo, to_postcard};
                match self {
                    $($($value)+ => {
                        const KNOWN: TypeInfo = TypeInfo {
                            number: $number,
                            name: $name,
                            module: $module,
                            priority: Priority::$priority,
                        };
                        (&KNOWN, to_postcard(&$written))
                    })+
                }
            }

            fn unserialise(data_type: $crate::comms::tcm::DataType, bytes: &[u8]) -> Option<$data> {
                match data_type {
                    $($number => {
                        let read = $crate::comms::tcm::from_postcard::<$type>(bytes)?;
                        $(let read = Some(read).filter($is_sound)?;)?
                        let $written = read;
                        Some($($value)+)
                    })+
                    _ => None,
                }
            }
        }
    };
}
pub(crate) use data;

impl ExternalMessage {
    /// What the module that sends such data says to the same module of another peer.
    pub fn of<T: Data>(data: &T, from: Peer, to: Peer) -> ExternalMessage {
        let (known, data) = data.serialise();
        let address = |peer| Address { peer, module: known.module };
        ExternalMessage { source: address(from), destination: address(to), data_type: known.number, data }
    }
}

/// Data as [postcard](https://postcard.jamesmunns.com/wire-format), the format of Touchline's own types.
pub fn to_postcard(data: &impl Serialize) -> Vec<u8> {
    // Fails for types of unknown length only, of which there are none here.
    postcard::to_stdvec(data).unwrap_or_default()
}

/// The data in these bytes; nothing, if they are none from beginning to end.
pub fn from_postcard<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let (data, rest) = postcard::take_from_bytes::<T>(bytes).ok()?;
    rest.is_empty().then_some(data)
}

/// Triggered at a robot when data of a registered type have reached it: the paper's callback. Observe it to receive a type.
#[derive(EntityEvent, Clone, Debug)]
pub struct Arrived<T: Data> {
    /// The robot.
    pub entity: Entity,
    /// The entity that sent it.
    pub from: Peer,
    /// What it said.
    pub data: T,
}

/// The data types that somebody has registered; they outlast a match.
#[derive(Resource, Clone, Debug, Default)]
pub struct Registry(BTreeMap<DataType, Registered>);

#[derive(Clone, Copy, Debug)]
struct Registered {
    info: &'static TypeInfo,
    deliver: Deliver,
}

/// Unserialises the bytes and triggers [`Arrived`]; tells whether that was possible.
pub(super) type Deliver = fn(&mut Commands, Entity, Peer, DataType, &[u8]) -> bool;

impl Registry {
    pub(super) fn get(&self, data_type: DataType) -> Option<Deliver> {
        self.0.get(&data_type).map(|known| known.deliver)
    }

    /// In the order of their numbers.
    pub fn types(&self) -> impl Iterator<Item = &'static TypeInfo> {
        self.0.values().map(|known| known.info)
    }
}

/// Registers types of data with an app.
pub trait RegisterData {
    /// From now on data of this type are unserialised when they arrive, and [`Arrived`] is triggered.
    fn register_data<T: Data>(&mut self) -> &mut Self;
}

impl RegisterData for App {
    fn register_data<T: Data>(&mut self) -> &mut App {
        let deliver: Deliver = |commands, entity, from, data_type, bytes| {
            let data = T::unserialise(data_type, bytes);
            data.map(|data| commands.trigger(Arrived { entity, from, data })).is_some()
        };
        let mut registry = self.world_mut().get_resource_or_init::<Registry>();
        registry.0.extend(T::TYPES.iter().map(|info| (info.number, Registered { info, deliver })));
        self
    }
}
