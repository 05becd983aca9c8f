//! Plays the matches of an experiment on all cores.

use super::plan::ExperimentPlan;
use super::row::ExperimentRow;
use crate::lab::all_cores::on_all_cores;

impl ExperimentPlan {
    /// Plays these matches, the first ones first, and hands over each that is over; until it is told to stop. Those that are being
    /// played then come to their end.
    ///
    /// # Errors
    /// The first one of what takes the rows.
    pub fn run<E>(
        &self,
        rows: impl Iterator<Item = u64> + Send,
        take: impl FnMut(ExperimentRow) -> Result<bool, E>,
    ) -> Result<(), E> {
        on_all_cores(rows, || (), |(), row| self.play(row), take)
    }
}
