//! The command line; see [`touchline::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    touchline::cli::main()
}
