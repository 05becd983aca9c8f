//! Plays what is missing of an experiment, and leaves the tables in its folder.

use std::collections::BTreeSet;

use super::ResultsFolder;
use crate::app::cli::ending::CommandError;
use crate::app::cli::interrupt::Interrupt;
use crate::app::cli::progress::progress_bar;
use crate::lab::experiment::{ExperimentPlan, ExperimentRow};

/// Plays the rows that are wanted and not in the folder, until none is wanted any more or a person wants an end; what is wanted
/// may depend on what is there. All rows, in order.
///
/// # Errors
/// If the folder holds something else, or cannot be written.
pub(in crate::app::cli) fn play_wanted(
    (plan, folder): (&ExperimentPlan, &ResultsFolder),
    wanted: impl Fn(&[ExperimentRow]) -> Vec<u64>,
    interrupt: &Interrupt,
) -> Result<Vec<ExperimentRow>, CommandError> {
    let mut rows = folder.begin(plan)?;
    let bar = progress_bar(0, "{msg}: {bar:40} {pos} of {len} matches, {eta} left");
    bar.set_message(plan.file.name.clone());
    let mut table = folder.table(plan)?;
    let missing = |rows: &[ExperimentRow]| {
        let known: BTreeSet<u64> = rows.iter().map(|row| row.key.row).collect();
        wanted(rows).into_iter().filter(|row| !known.contains(row)).collect::<Vec<u64>>()
    };
    let mut open = missing(&rows);
    while !open.is_empty() && !interrupt.is_asked() {
        bar.inc_length(open.len() as u64);
        quietly(|| {
            plan.run(open.iter().copied(), |row| {
                table.add(&row).map_err(CommandError::file(&folder.csv()))?;
                rows.push(row);
                bar.inc(1);
                Ok::<_, CommandError>(!interrupt.is_asked())
            })
        })?;
        open = missing(&rows);
    }
    bar.finish_and_clear();
    drop(table);
    rows.sort_by_key(|row| row.key.row);
    folder.finish(plan, &rows)?;
    Ok(rows)
}

/// A match that breaks off is a row that says so, and not a report of the program's fault on the way.
pub(in crate::app::cli) fn quietly<T>(run: impl FnOnce() -> T) -> T {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let done = run();
    std::panic::set_hook(usual);
    done
}
