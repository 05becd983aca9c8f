//! Ctrl-C: asks a command to come to its end, with the result so far.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::ending::Ending;
use crate::lab::scenario::RunWatcher;

/// Whether a person wants the command to end.
#[derive(Clone, Debug, Default)]
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens to Ctrl-C from now on. A second one ends the program at once.
    pub fn listen() -> Interrupt {
        let interrupt = Interrupt::default();
        let asked = interrupt.0.clone();
        // Another handler of Ctrl-C stays, and so does a shield that the starter of the program put up.
        let _ = ctrlc::try_set_handler(move || {
            if asked.swap(true, Ordering::Relaxed) {
                std::process::exit(Ending::Interrupted as i32);
            }
        });
        interrupt
    }

    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl RunWatcher for Interrupt {
    fn stops(&self) -> bool {
        self.is_asked()
    }
}
