//! Going back in a match, and on from there another way.
//!
//! Seed, assets and the requests of each tick are a whole match. [`Rewind`] keeps the requests, and every few seconds a
//! [`Keyframe`]: a copy of the match and of [who looks on](GoesBack). Any tick comes back from the keyframe before it and the
//! ticks between, which are played once more with the requests that they had. A new request in a tick that was played before
//! begins another [`Branch`]: the old one is kept, with all that was asked for, and can be gone back to.
//!
//! Nothing here knows a window. Sockets cannot be asked again for what they brought, so a match goes back only when none is
//! open.

mod branch;
mod events;
mod ghost;
mod keyframes;
mod line;
mod log;
mod onlookers;
mod play;
mod seek;
#[cfg(test)]
mod tests;
mod track;

pub use branch::{Branch, BranchId};
pub use events::{MatchEvent, MatchEventKind};
pub use ghost::GhostMatch;
pub use keyframes::{Keyframe, Keyframes};
pub use line::Rewind;
pub use log::{LoggedRequest, meddling};
pub use onlookers::GoesBack;
pub use seek::CannotRewind;
pub use track::{Ghost, Track};
