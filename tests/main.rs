//! Whole matches and bodies in motion: everything that needs more than one module. One binary, since each links Bevy.

mod architecture;
mod asset_files;
mod b3p;
mod booking;
mod command_line;
mod corpus;
mod docs;
mod duel;
mod fairness;
mod first_messages;
mod network;
mod numbers;
mod paper_relations;
mod play;
mod policies;
mod radio;
mod repeatability;
mod role_swap;
mod rolling_bodies;
mod scenarios;
mod schedule;
mod single_writer;
mod snapshot;
mod squeezed_ball;
mod strategies;
mod support;
