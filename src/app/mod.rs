//! The program that a person uses: its command line and its window.

#[cfg(feature = "window")]
mod chaos_window;
pub mod cli;
#[cfg(feature = "window")]
mod headless_check;
#[cfg(feature = "window")]
pub mod inspector;
pub mod logging;
pub mod match_request;
#[cfg(feature = "window")]
pub mod view;
mod whole_file;
#[cfg(feature = "window")]
mod window;
