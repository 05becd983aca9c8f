//! What gives evidence: scenarios that show what a team does, and check it.

pub mod scenario;
