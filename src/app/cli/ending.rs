//! How a command ends: its exit code, and the one line that says what went wrong.

use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;
use thiserror::Error;

use crate::data::DataError;
use crate::game::net::NetworkError;

/// How a command ended, as its exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ending {
    Done = 0,
    /// A replay parts from its recording, a tick from its repetition, a scenario has failed or is undecided, a robot has lost its match, or its picture did not arrive.
    Failed = 1,
    BadInput = 2,
    /// Something that holds whatever the radio does did not.
    Unsafe = 3,
    WindowFailed = 4,
    /// A result could not be written.
    NotWritten = 5,
    /// By Ctrl-C: 128 and the number of SIGINT, as in a shell.
    Interrupted = 130,
    /// The reader of the output closed it: 128 and the number of SIGPIPE, as in a shell.
    OutputClosed = 141,
}

impl Ending {
    /// That of something that was done, or that Ctrl-C ended.
    pub fn of_run(interrupted: bool) -> Ending {
        if interrupted { Ending::Interrupted } else { Ending::Done }
    }
}

/// What the help says about exit codes.
pub(super) const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a scenario failed or is undecided, a replay parts from its recording or a tick from its repetition, a robot has lost its
       match, or what ChaosManager wanted has not arrived
  2    bad input: a file, an option or an address, or an order that was refused
  3    with --strict: an invariant was broken that holds whatever the radio does
  4    the window could not be kept open
  5    a result could not be written
  130  interrupted by Ctrl-C; the result so far is printed
  141  the reader of the output has closed it";

impl From<Ending> for ExitCode {
    fn from(ending: Ending) -> ExitCode {
        ExitCode::from(ending as u8)
    }
}

/// Why a command could not go on.
#[derive(Debug, Error)]
pub(super) enum CommandError {
    #[error(transparent)]
    Input(#[from] DataError),
    #[error("the output cannot be written: {0}")]
    Output(#[from] io::Error),
    #[error("{}: cannot be written: {source}", .path.display())]
    File { path: PathBuf, source: io::Error },
    #[error("tick {tick} does not repeat itself: {difference}")]
    NotRepeated { tick: u64, difference: String },
}

impl From<NetworkError> for CommandError {
    fn from(error: NetworkError) -> CommandError {
        CommandError::Input(error.into())
    }
}

impl CommandError {
    /// An error about a file that was to be written.
    pub fn file(path: &Path) -> impl FnOnce(io::Error) -> CommandError {
        move |source| CommandError::File { path: path.to_owned(), source }
    }

    /// Says what went wrong, unless nobody listens any more.
    pub fn tell(&self) -> Ending {
        let ending = match self {
            CommandError::Output(error) if error.kind() == ErrorKind::BrokenPipe => {
                return Ending::OutputClosed;
            }
            CommandError::Input(_) => Ending::BadInput,
            CommandError::Output(_) | CommandError::File { .. } => Ending::NotWritten,
            CommandError::NotRepeated { .. } => Ending::Failed,
        };
        tell(self);
        ending
    }
}

/// Writes a line to the standard error stream; if nobody reads it, there is nobody to be told.
pub(super) fn tell(line: impl std::fmt::Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Prints a result for machines.
pub(super) fn print_json(result: &impl Serialize, out: &mut impl Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, result)?;
    writeln!(out)
}

/// Prints what is wrong with the arguments of this process, or the help that they ask for.
pub(super) fn tell_usage(usage: &clap::Error) -> Ending {
    let printed = usage.print().and_then(|()| io::stdout().flush());
    match printed {
        _ if usage.use_stderr() => Ending::BadInput,
        Ok(()) => Ending::Done,
        Err(error) => CommandError::Output(error).tell(),
    }
}
