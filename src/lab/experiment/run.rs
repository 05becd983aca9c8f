//! Plays the matches of an experiment on all cores.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

use rayon::prelude::*;

use super::plan::ExperimentPlan;
use super::row::ExperimentRow;

impl ExperimentPlan {
    /// Plays these matches, those with low numbers first, and hands over each that is over; until it is told to stop. Those that
    /// are being played then come to their end.
    ///
    /// # Errors
    /// The first one of what takes the rows.
    pub fn run<E: Send>(
        &self,
        rows: impl Iterator<Item = u64> + Send,
        mut take: impl FnMut(ExperimentRow) -> Result<bool, E>,
    ) -> Result<(), E> {
        let (sender, receiver) = mpsc::channel();
        let stop = AtomicBool::new(false);
        std::thread::scope(|scope| {
            let stop = &stop;
            scope.spawn(move || {
                let rows = rows.take_while(|_| !stop.load(Ordering::Relaxed));
                rows.par_bridge().for_each_with(sender, |sender, row| drop(sender.send(self.play(row))));
            });
            let mut ended = Ok(());
            for row in receiver {
                match take(row) {
                    Ok(true) => continue,
                    Ok(false) => {}
                    Err(error) => ended = ended.and(Err(error)),
                }
                stop.store(true, Ordering::Relaxed);
            }
            ended
        })
    }
}
