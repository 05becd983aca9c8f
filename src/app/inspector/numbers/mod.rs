//! Every number of a running strategy by its path: changed live, compared with its file, undone, and saved so that nothing else of
//! the file changes.
//!
//! A change is made in the text that the strategy was read from, and the text is read again as the file would be: so nothing can
//! be set here that a file could not say.

mod rows;
mod save;
#[cfg(test)]
mod tests;
mod view;

pub use view::{NumberDesk, RunningTexts, draw};
