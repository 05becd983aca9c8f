//! Where log lines go: to the standard error stream, in colours only where a terminal shows them.

use std::io;

use anstream::{AutoStream, ColorChoice};
use bevy::log::tracing_subscriber::fmt;

/// Rapier warns of a setting that is meant.
const LOGGED: &str = "info,bevy_rapier2d=error";

/// Logs what is worth a line, for a program without a window.
pub fn log_to_stderr() {
    let subscriber = fmt().with_env_filter(LOGGED).with_target(false).without_time();
    let subscriber = subscriber.with_ansi(stderr_takes_colours()).log_internal_errors(false);
    // A log that was set before stays.
    let _ = subscriber.with_writer(io::stderr).try_init();
}

/// How the window's log writes its lines.
#[cfg(feature = "window")]
pub fn window_layer(_: &mut bevy::app::App) -> Option<bevy::log::BoxedFmtLayer> {
    // Without a reader there is nobody to be told that a line could not be written.
    let layer = fmt::layer().with_target(false).without_time();
    let layer = layer.with_ansi(stderr_takes_colours()).log_internal_errors(false);
    Some(Box::new(layer.with_writer(io::stderr)))
}

/// Whether a terminal reads the standard error stream that shows colours, and nobody has asked for none (`NO_COLOR`). A console of CI
/// (`CI`) shows them whatever `TERM` says.
pub fn stderr_takes_colours() -> bool {
    AutoStream::choice(&io::stderr()) != ColorChoice::Never
}
