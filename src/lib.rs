//! Touchline plays robot soccer between teams of behaviour-based robots over a bad radio.
//!
//! This is the library behind the program. It plays matches and scenarios without a window, and the feature `window` adds one.
//!
//! # A match
//!
//! ```
//! use touchline::data::AssetFolder;
//! use touchline::game::{Choice, Match, MatchPlan};
//!
//! let assets = AssetFolder::find(None)?;
//! let choice = Choice { seed: 3, half_minutes: Some(0.1), ..Choice::default() };
//! let plan = MatchPlan::read(&assets, &choice)?;
//! let mut game = Match::new(&plan);
//! while !game.is_over() {
//!     game.tick();
//! }
//! let [home, away] = game.state().score;
//! println!("{home} : {away} after {:.0} s", game.clock().now());
//!
//! // Equal seeds give equal matches.
//! let mut again = Match::new(&plan);
//! while !again.is_over() {
//!     again.tick();
//! }
//! assert_eq!(game.record().digest, again.record().digest);
//! # Ok::<(), touchline::data::DataError>(())
//! ```
//!
//! # Contents
//!
//! | module | what is in it |
//! |---|---|
//! | [`schedule`], [`clock`], [`ids`], [`ops`], [`rng`], [`geometry`] | the stages of a tick, time, names, transcendental functions, dice, poses |
//! | [`state`] | what belongs to a match: how it starts, changes, is copied and put back |
//! | [`data`] | RON files, with places for their mistakes |
//! | [`pitch`] | the pitch |
//! | [`vision`] | what a robot makes of pictures, and how its camera is calibrated |
//! | [`protocol`] | role swap and ball booking, as values |
//! | [`strategy`] | what a team does, read from a file |
//! | [`robot`] | a robot's kind, and what passes between its body and its mind |
//! | [`comms`] | messages, the team communication module, the radio |
//! | [`world`] | the truth: physics, ball, drive, senses, referee |
//! | [`mind`] | what a robot believes and decides |
//! | [`game`] | a match from plan to digest, requests, sockets |
//! | [`lab`] | scenarios, going back in a match |
//! | [`app`] | the command line and the window |
//!
//! # The way of the data
//!
//! One schedule, [`schedule::Tick`], is the simulation. Data flows through its stages in one direction:
//!
//! ```text
//! Script -> Deliver -> Sense -> WorldModel -> Teamwork -> Behaviour -> Motor -> Drive -> Physics -> Referee -> Transmit -> Record
//! ```
//!
//! Robots act on beliefs only: Sense, Referee, Record and the window read the truth. Seed, assets and requests determine a match
//! bit for bit.

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
pub mod ops;
pub mod pitch;
pub mod protocol;
pub mod rng;
pub mod robot;
pub mod schedule;
pub mod state;
pub mod strategy;
#[cfg(test)]
mod testing;
pub mod vision;
pub mod world;
