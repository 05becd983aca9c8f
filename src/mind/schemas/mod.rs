//! Motor schemas and perceptual operators as pure functions over vectors: the mathematics behind a strategy's words, after
//! Arkin's motor schemas and Balch's Clay.
//!
//! Vectors are translated to the robot but not rotated. A schema's angle is where to go, its length how fast.

pub mod attraction;
pub mod avoidance;
pub mod combine;
pub mod docking;
pub mod dribbling;
pub mod memory;
pub mod noise;
pub mod operators;
pub mod swirl;
pub mod walls;
