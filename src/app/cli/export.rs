//! `touchline export`: a recorded match as a page, a log or pictures.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use super::ending::{CommandError, Ending, print_json};
use super::interrupt::Interrupt;
use super::progress::progress_bar;
use crate::app::whole_file::{check_writable, write_whole};
use crate::clock::Clock;
use crate::data::{AssetFolder, DataError};
use crate::lab::export::{
    ExportCounts, ExportError, ExportWishes, Exported, MOST_FORKS, PageForks, PageWish, export,
};
use crate::lab::replay::Replay;

#[derive(Args, Debug)]
pub(super) struct ExportCommand {
    /// The recorded match: a file that `--record` wrote.
    #[arg(value_name = "FILE")]
    replay: PathBuf,
    /// Write a page that plays the match in a browser, all in one file.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Other futures on the page, at most: messages that arrived before a goal are lost.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = most_forks, requires = "html")]
    forks: usize,
    /// Write a log in the format MCAP, for Foxglove and other tools.
    #[arg(long, value_name = "FILE")]
    mcap: Option<PathBuf>,
    /// Draw one moment.
    #[arg(long, value_name = "FILE", requires = "at")]
    svg: Option<PathBuf>,
    /// The moment to draw: a tick, or seconds such as 83.5s.
    #[arg(long, value_name = "TICK", value_parser = tick, requires = "svg")]
    at: Option<u64>,
    /// Draw a stretch as a film that plays for ever.
    #[arg(long, value_name = "FILE", requires_all = ["from", "to"])]
    gif: Option<PathBuf>,
    /// The first moment of the film.
    #[arg(long, value_name = "TICK", value_parser = tick, requires = "gif")]
    from: Option<u64>,
    /// The last moment of the film, two minutes later at most.
    #[arg(long, value_name = "TICK", value_parser = tick, requires = "gif")]
    to: Option<u64>,
    /// Print what was written as JSON.
    #[arg(long)]
    json: bool,
}

/// The longest film, ticks.
const LONGEST_FILM: u64 = 7200;

/// Reads the number of a tick, or seconds of the match.
fn tick(text: &str) -> Result<u64, String> {
    let tick = match text.strip_suffix('s') {
        None => text.parse().ok(),
        Some(seconds) => {
            let seconds = seconds.trim().parse::<f64>().ok().filter(|seconds| (0.0..=1e6).contains(seconds));
            seconds.map(|seconds| (seconds / f64::from(Clock::default().dt)).round() as u64)
        }
    };
    tick.ok_or_else(|| "must be the number of a tick, such as 5010, or seconds, such as 83.5s".into())
}

fn most_forks(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|number| *number <= MOST_FORKS);
    number.ok_or_else(|| format!("must be a number from 0 to {MOST_FORKS}"))
}

impl ExportCommand {
    pub(super) fn run(&self, _: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let wishes = self.wishes()?;
        for path in [&self.html, &self.mcap, &self.svg, &self.gif].into_iter().flatten() {
            check_writable(path).map_err(CommandError::file(path))?;
        }
        let replay = Replay::read(&self.replay)?;
        let Some(exported) = export_replay(&replay, wishes, &Interrupt::listen())? else {
            return Ok(Ending::Interrupted);
        };
        let written = self.write(&exported)?;
        if self.json {
            print_json(&exported.counts, out)?;
        } else {
            tell(&exported.counts, &written, out)?;
        }
        Ok(Ending::Done)
    }

    fn wishes(&self) -> Result<ExportWishes, DataError> {
        if [&self.html, &self.mcap, &self.svg, &self.gif].into_iter().all(Option::is_none) {
            return Err(DataError::new(
                "export",
                "says nothing to write: add --html, --mcap, --svg or --gif",
            ));
        }
        let film = self.from.zip(self.to);
        if let Some((from, to)) = film.filter(|(from, to)| to < from || to - from > LONGEST_FILM) {
            let message = format!("must be from 0 to {LONGEST_FILM} ticks after --from {from}, not {to}");
            return Err(DataError::new("--to", message));
        }
        Ok(ExportWishes {
            page: self.html.as_ref().map(|_| PageWish { forks: PageForks::BeforeGoals(self.forks) }),
            log: self.mcap.is_some(),
            picture: self.at,
            film,
        })
    }

    /// Writes all files, and tells their paths and sizes.
    fn write(&self, exported: &Exported) -> Result<Vec<(&Path, usize)>, CommandError> {
        let contents = [
            (&self.html, exported.page.as_ref().map(String::as_bytes)),
            (&self.mcap, exported.log.as_deref()),
            (&self.svg, exported.picture.as_ref().map(String::as_bytes)),
            (&self.gif, exported.film.as_deref()),
        ];
        let mut written = Vec::new();
        for (path, content) in contents {
            let (Some(path), Some(content)) = (path, content) else { continue };
            write_whole(path, content).map_err(CommandError::file(path))?;
            written.push((path.as_path(), content.len()));
        }
        Ok(written)
    }
}

/// Plays a recorded match and writes what is wanted of it; nothing if Ctrl-C ends it.
///
/// # Errors
/// If it cannot be played, or plays otherwise than it was recorded: what is written would be worth nothing.
pub(super) fn export_replay(
    replay: &Replay,
    wishes: ExportWishes,
    interrupt: &Interrupt,
) -> Result<Option<Exported>, DataError> {
    let (plan, _) = replay.plans()?;
    let bar = progress_bar(replay.ticks(), "{bar:40} {pos}/{len} ticks, {eta} left");
    let exported = export(&plan, Some(replay.ticks()), wishes, &mut |tick| {
        bar.set_position(tick);
        !interrupt.is_asked()
    });
    bar.finish_and_clear();
    let exported = match exported {
        Err(ExportError::Interrupted) => return Ok(None),
        Err(error) => return Err(DataError::new(&replay.path, error.to_string())),
        Ok(exported) => exported,
    };
    let recorded = replay.digest().map(|digest| format!("{digest:016x}"));
    if recorded.is_some_and(|recorded| recorded != exported.counts.digest) {
        let message = "plays otherwise than it was recorded; `touchline replay` says from which tick on";
        return Err(DataError::new(&replay.path, message));
    }
    Ok(Some(exported))
}

fn tell(counts: &ExportCounts, written: &[(&Path, usize)], out: &mut impl Write) -> io::Result<()> {
    for (path, bytes) in written {
        writeln!(out, "{:8.2} MB  {}", *bytes as f64 / 1e6, path.display())?;
    }
    if let Some(page) = &counts.page {
        writeln!(
            out,
            "page        {:6} messages, {} events, {} other futures",
            page.messages, page.events, page.forks
        )?;
    }
    for (topic, messages) in counts.log.iter().flatten() {
        writeln!(out, "{topic:15} {messages:6} messages")?;
    }
    if let Some(frames) = counts.frames {
        writeln!(out, "film        {frames:6} frames")?;
    }
    let [home, away] = counts.score;
    writeln!(out, "{} ticks, {home}:{away}, digest {}", counts.ticks, counts.digest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_is_a_tick_or_seconds() {
        assert_eq!([tick("5010"), tick("83.5s"), tick("0s")], [Ok(5010), Ok(5010), Ok(0)]);
        for wrong in ["-1", "1.5", "s", "NaNs", "infs", "1e9s", "2 minutes"] {
            assert!(tick(wrong).is_err(), "{wrong}");
        }
    }
}
