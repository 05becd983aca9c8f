//! Roles that a strategy mentions.

use serde::{Deserialize, Serialize};

use crate::protocol::role_swap::RoleIndex;

/// A role by its name, and its place among the strategy's roles once the strategy is loaded.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub struct RoleRef {
    pub name: String,
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
