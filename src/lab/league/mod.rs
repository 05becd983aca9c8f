//! Leagues: every strategy of a list against every other, and ratings from all their matches.
//!
//! A league is an experiment whose treatments are the pairs, so that it is played, kept and gone on with as any other; a
//! [`LeagueTable`] is what its rows come to.

mod design;
mod rating;
mod table;

pub use design::{LeagueChoice, PAIRS};
pub use rating::{PairCounts, Ratings};
pub use table::{LeagueTable, TableRow};
