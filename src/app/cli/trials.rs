//! Commands that do the same many times: with a bar on the way, until Ctrl-C, and a report of what was done.

use std::fmt::Display;
use std::io::Write;

use serde::Serialize;

use super::ending::{CommandError, print_json};
use super::interrupt::Interrupt;
use super::progress::progress_bar;

/// Runs so many steps, called so on the bar, and prints the report. What runs them tells after each how many are done, and ends when
/// it is told not to go on.
pub(super) fn run_trials<R: Display + Serialize>(
    (steps, called): (u32, &str),
    json: bool,
    out: &mut impl Write,
    run: impl FnOnce(&mut dyn FnMut(u32) -> bool) -> R,
) -> Result<R, CommandError> {
    let interrupt = Interrupt::listen();
    let bar = progress_bar(steps.into(), &format!("{{bar:40}} {{pos}}/{{len}} {called}, {{eta}} left"));
    let report = run(&mut |done| {
        bar.set_position(done.into());
        !interrupt.is_asked()
    });
    bar.finish_and_clear();
    if json {
        print_json(&report, out)?;
    } else {
        writeln!(out, "{report}")?;
    }
    Ok(report)
}
