//! What gives evidence: scenarios that show what a team does, and check it; duels that measure how much a few robots are worth;
//! cameras by whose pictures the fast model of eyes is fitted; matches that are kept and played again, or go back and on another
//! way, or are written as pages, logs and pictures for others; counts of what strategies were seen to do; statistics by which it is judged, and reports
//! that people read.

mod all_cores;
pub mod coverage;
pub mod duel;
pub mod experiment;
pub mod export;
pub mod eyes;
mod html;
pub mod jam;
pub mod kinds;
pub mod league;
pub mod replay;
pub mod report;
pub mod rewind;
pub mod scenario;
pub mod soak;
pub mod statistics;
pub mod tune;
mod unbroken;
pub mod why;
