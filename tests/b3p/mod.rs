//! The ball booking under a model checker: all that may happen to two or three robots that run the match's own state machine
//! over a radio that delays, reorders and loses messages, within bounds on delay, losses in a row and misfortunes.

mod ball;
mod checks;
mod model;
mod paper;
mod settling;
mod sight;
mod story;
mod team;
mod timeout;
