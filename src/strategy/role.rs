//! The roles of a strategy: those that robots have, and those that it mentions.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::protocol::role_swap::RoleIndex;

/// A robot's role: an index into its strategy's roles.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Hash, Reflect)]
#[reflect(Component)]
pub struct Role(pub usize);

/// A role by its name, and its place among the strategy's roles once the strategy is loaded.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub struct RoleRef {
    /// The role's name.
    pub name: String,
    /// The role's index, once the strategy is loaded.
    pub index: RoleIndex,
}

impl From<String> for RoleRef {
    fn from(name: String) -> RoleRef {
        RoleRef { name, index: 0 }
    }
}

impl From<RoleRef> for String {
    fn from(role: RoleRef) -> String {
        role.name
    }
}
