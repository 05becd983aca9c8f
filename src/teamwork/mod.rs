//! The Teamwork stage's components: what robots arrange among themselves.
//!
//! So far a role is fixed at kick-off. Messages, claims, supports and role swaps belong here.

use bevy::prelude::*;

/// A robot's role: an index into its strategy's roles.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Hash, Reflect)]
pub struct Role(pub usize);
