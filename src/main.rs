//! The command line; see [`touchline::app::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    touchline::app::cli::main()
}
