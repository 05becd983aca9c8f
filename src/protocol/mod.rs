//! The papers' protocols as values: pure state machines without clock, dice or I/O. A handler never sends: it returns what to
//! do. The match runs them and so does the model checker, the very same code.

pub mod arbitration;
pub mod b3p;
pub mod policy;
pub mod role_swap;
