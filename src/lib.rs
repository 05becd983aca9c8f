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

pub mod ball;
pub mod behaviour;
pub mod cli;
pub mod clock;
pub mod data;
pub mod drive;
pub mod game;
pub mod gamecontroller;
pub mod geometry;
pub mod handling;
pub mod head;
pub mod ids;
#[cfg(feature = "window")]
pub mod inspector;
pub mod logging;
pub mod messages;
pub mod motor;
pub mod perception;
pub mod physics;
pub mod pilot;
pub mod pitch;
pub mod protocol;
pub mod radio;
pub mod record;
pub mod referee;
pub mod rng;
pub mod robot;
pub mod scenario;
pub mod schedule;
pub mod schemas;
pub mod script;
pub mod sense;
pub mod strategy;
pub mod tcm;
pub mod teamwork;
#[cfg(feature = "window")]
pub mod view;
pub mod wire;
pub mod world_model;

use bevy::prelude::*;

/// Everything that a match needs, without a window.
pub fn simulation(app: &mut App) {
    app.add_plugins((
        schedule::plugin,
        physics::plugin,
        script::plugin,
        (tcm::plugin, messages::plugin, radio::plugin, wire::plugin),
        sense::plugin,
        world_model::plugin,
        teamwork::plugin,
        behaviour::plugin,
        motor::plugin,
        (head::plugin, drive::plugin, handling::plugin),
        ball::plugin,
        referee::plugin,
        game::plugin,
        record::plugin,
    ));
}

/// What a robot needs that is a process of its own: its mind, without a world around it.
pub fn mind(app: &mut App) {
    app.add_plugins((
        schedule::plugin,
        (tcm::plugin, messages::plugin, wire::plugin),
        world_model::plugin,
        teamwork::plugin,
        behaviour::plugin,
        (motor::plugin, head::plugin),
    ));
}
