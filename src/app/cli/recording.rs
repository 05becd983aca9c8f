//! Recording what a command plays.

use std::path::{Path, PathBuf};

use bevy::math::Vec2;
use clap::Args;

use super::ending::CommandError;
use super::interrupt::Interrupt;
use crate::data::AssetFolder;
use crate::game::Match;
use crate::lab::replay::{Recorded, Recorder, ReplayHeader};
use crate::lab::scenario::{Dependency, RunWatcher, ScenarioPlan};

#[derive(Args, Clone, Debug, Default)]
pub(super) struct RecordOption {
    /// Record the match in a file, from which `replay` plays it again.
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
}

impl RecordOption {
    /// Begins to record, if that is wanted.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn begin(&self, header: ReplayHeader) -> Result<Option<Recorder>, CommandError> {
        let begin = |path: &PathBuf| Recorder::create(path, header).map_err(CommandError::file(path));
        self.record.as_ref().map(begin).transpose()
    }
}

/// Records the tick that was just played.
///
/// # Errors
/// If the file cannot be written.
pub(super) fn note(recorder: &mut Recorder, game: &mut Match) -> Result<(), CommandError> {
    let noted = recorder.note(game.world_mut());
    noted.map_err(|error| CommandError::file(recorder.path())(error))
}

/// Ends a recording.
///
/// # Errors
/// If the file cannot be written.
pub(super) fn finish(recorder: Recorder) -> Result<(), CommandError> {
    let path = recorder.path().to_owned();
    recorder.finish().map_err(CommandError::file(&path))
}

/// Records each run of a scenario in a file of its own, if a folder for them is given, until Ctrl-C.
pub(super) struct RunRecorder<'a> {
    pub folder: Option<&'a Path>,
    pub assets: &'a AssetFolder,
    pub plan: &'a ScenarioPlan,
    pub without: Option<Dependency>,
    pub interrupt: &'a Interrupt,
    /// The run that is played.
    pub recorder: Option<Recorder>,
    pub failed: Option<CommandError>,
}

impl RunRecorder<'_> {
    /// Ends the last recording.
    ///
    /// # Errors
    /// If a file could not be written.
    pub fn conclude(mut self) -> Result<(), CommandError> {
        self.recorder.take().map_or(Ok(()), finish)?;
        self.failed.map_or(Ok(()), Err)
    }

    fn open(&self, folder: &Path, (place, seed): (Vec2, u64)) -> Result<Recorder, CommandError> {
        let (scenario, without) = (self.plan.origin.clone(), self.without);
        let (header, _) =
            ReplayHeader::of(Recorded::Scenario { scenario, place, seed, without }, self.assets)?;
        std::fs::create_dir_all(folder).map_err(CommandError::file(folder))?;
        let path = folder.join(self.name(place, seed));
        Recorder::create(&path, header).map_err(CommandError::file(&path))
    }

    /// That of the scenario and all that tells its runs apart.
    fn name(&self, place: Vec2, seed: u64) -> String {
        let stem = self.plan.origin.path.file_stem().unwrap_or_default().to_string_lossy();
        let variant = self.plan.origin.variant.iter().map(String::to_string);
        let without = self.without.iter().map(|dependency| format!("without_{dependency}"));
        let places = &self.plan.scenario.places;
        let place = places.iter().position(|known| *known == place).filter(|_| places.len() > 1);
        let place = place.iter().map(|place| format!("place_{place}"));
        let parts = [stem.into_owned()].into_iter().chain(variant).chain(without).chain(place);
        parts.chain([format!("seed_{seed}.replay")]).collect::<Vec<_>>().join(".")
    }

    fn keep(&mut self, result: Result<(), CommandError>) {
        if let Err(error) = result {
            self.failed.get_or_insert(error);
            self.recorder = None;
        }
    }
}

impl RunWatcher for RunRecorder<'_> {
    fn begin(&mut self, run: (Vec2, u64), _: &mut Match) {
        let Some(folder) = self.folder else { return };
        let finished = self.recorder.take().map_or(Ok(()), finish);
        self.keep(finished);
        let opened = self.open(folder, run).map(|recorder| self.recorder = Some(recorder));
        self.keep(opened);
    }

    fn after_tick(&mut self, game: &mut Match) {
        let noted = self.recorder.as_mut().map_or(Ok(()), |recorder| note(recorder, game));
        self.keep(noted);
    }

    fn stops(&self) -> bool {
        self.interrupt.is_asked() || self.failed.is_some()
    }
}
