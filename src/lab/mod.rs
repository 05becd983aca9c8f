//! What gives evidence: scenarios that show what a team does, and check it; duels that measure how much a few robots are worth.

pub mod duel;
pub mod scenario;
