//! Touchline plays robot soccer between teams of behaviour-based robots.
//!
//! One schedule, [`schedule::Tick`], is the simulation. Data flows through its stages in one direction:
//!
//! ```text
//! Script -> Deliver -> Sense -> WorldModel -> Teamwork -> Behaviour -> Motor -> Drive -> Physics -> Referee -> Transmit -> Record
//! ```
//!
//! Each stage is a module, whose `mod.rs` holds its components and systems; its siblings are pure logic. Robots act on beliefs
//! only: truth is read by Sense, Referee, Record and the window. Seed, assets and requests determine a match bit for bit.

#![forbid(unsafe_code)]
// They panic when nobody reads; `cli` prints by writers that can fail.
#![warn(clippy::print_stdout, clippy::print_stderr)]

pub mod app;
pub mod clock;
pub mod comms;
pub mod data;
pub mod game;
pub mod geometry;
pub mod ids;
pub mod lab;
pub mod mind;
pub mod pitch;
pub mod protocol;
pub mod rng;
pub mod robot;
pub mod schedule;
pub mod strategy;
#[cfg(test)]
mod testing;
pub mod world;

use bevy::prelude::*;

/// Everything that a match needs, without a window.
pub fn simulation(app: &mut App) {
    app.add_plugins((schedule::plugin, world::plugin, comms::plugin, mind::plugin, game::plugin));
}

/// What a robot needs that is a process of its own: its mind, without a world around it.
pub fn mind(app: &mut App) {
    app.add_plugins((schedule::plugin, comms::modules, game::net::plugin, mind::plugin));
}
