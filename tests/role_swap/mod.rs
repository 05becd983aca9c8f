//! The role swap under a model checker: all that may happen to three or four robots that run the match's own state machine
//! over a bad radio, within bounds on attempts, duplicates and crashes.

mod ablations;
mod checks;
mod hardened;
mod model;
mod network;
mod paper_counterexamples;
mod paper_guarantees;
mod story;
mod team;
