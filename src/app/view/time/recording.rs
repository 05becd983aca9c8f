//! What is played in the window is recorded, if that was wanted: the first match in the file that was named, each later one and
//! each branch in a file of its own beside it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use bevy::prelude::*;
use bevy::time::common_conditions::on_real_timer;

use crate::app::view::state::{AfterTick, FileError, FrameSystems, MatchBegun, Session};
use crate::lab::replay::{Bookmark, Recorder};
use crate::lab::rewind::{BranchId, Rewind};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Recording>()
        .add_observer(begin)
        .add_systems(AfterTick, note)
        .add_systems(Update, note_bookmarks.in_set(FrameSystems::Picture).run_if(on_real_timer(INTERVAL)))
        .add_systems(Last, finish.run_if(on_message::<AppExit>));
}

/// Time after which new bookmarks are in the file, whether or not the match goes on.
const INTERVAL: Duration = Duration::from_millis(500);

/// Where matches are recorded, and the recording of the one that is played.
#[derive(Resource, Debug, Default)]
pub struct Recording {
    wanted: Option<PathBuf>,
    /// How many files were begun.
    count: usize,
    /// One for each branch of the match.
    recorders: BTreeMap<BranchId, Recorder>,
    present: BranchId,
}

impl Recording {
    /// The first match is recorded in this file.
    pub fn to(wanted: Option<PathBuf>) -> Recording {
        Recording { wanted, ..Recording::default() }
    }

    /// Ends all recordings, each with the bookmarks of its branch.
    fn close(&mut self, rewind: Option<&Rewind>) -> Option<String> {
        self.present = BranchId::default();
        let finish = |(branch, mut recorder): (BranchId, Recorder)| {
            let path = recorder.path().to_owned();
            let marked = rewind.map_or(Ok(()), |rewind| mark(&mut recorder, rewind, branch));
            marked.and_then(|()| recorder.finish()).err().map(|error| cannot_write(&path, &error))
        };
        let recorders = std::mem::take(&mut self.recorders);
        let errors: Vec<String> = recorders.into_iter().filter_map(finish).collect();
        errors.into_iter().next()
    }

    /// The file of a branch begins with what it shares with the one that was recorded before.
    fn branch(&mut self, branch: BranchId, from: u64) -> Option<String> {
        let left = std::mem::replace(&mut self.present, branch);
        let (Some(wanted), Some(recorder)) = (&self.wanted, self.recorders.get(&left)) else { return None };
        if self.recorders.contains_key(&branch) {
            return None;
        }
        self.count += 1;
        let path = numbered(wanted, self.count);
        match recorder.branch(from, &path) {
            Ok(recorder) => {
                self.recorders.insert(branch, recorder);
                None
            }
            Err(error) => Some(cannot_write(&path, &error)),
        }
    }
}

fn begin(
    _: On<MatchBegun>,
    (session, rewind): (Res<Session>, Option<Res<Rewind>>),
    mut recording: ResMut<Recording>,
    mut file_error: ResMut<FileError>,
) {
    let closed = recording.close(rewind.as_deref());
    let (Some(wanted), Some(header)) = (&recording.wanted, &session.header) else { return };
    let path = numbered(wanted, recording.count + 1);
    let created = Recorder::create(&path, header.clone());
    let error = created.map(|recorder| recording.recorders.insert(BranchId::default(), recorder)).err();
    recording.count += 1;
    if let Some(error) = closed.or(error.map(|error| cannot_write(&path, &error))) {
        file_error.0 = Some(error);
    }
}

/// `mine.replay`, then `mine-2.replay`.
fn numbered(path: &Path, number: usize) -> PathBuf {
    if number < 2 {
        return path.to_owned();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().map(|it| format!(".{}", it.to_string_lossy()));
    path.with_file_name(format!("{stem}-{number}{}", extension.unwrap_or_default()))
}

/// Brings the bookmarks of a recording up to those of its branch.
fn mark(recorder: &mut Recorder, rewind: &Rewind, branch: BranchId) -> std::io::Result<()> {
    let known: BTreeMap<u64, String> =
        recorder.bookmarks().into_iter().map(|bookmark| (bookmark.tick, bookmark.note)).collect();
    let now: BTreeMap<u64, &str> = rewind.bookmarks(branch).collect();
    let gone = known.keys().filter(|tick| !now.contains_key(tick)).map(|tick| (*tick, ""));
    let new = now.iter().filter(|(tick, note)| known.get(*tick).map(String::as_str) != Some(**note));
    let changed: Vec<(u64, &str)> = gone.chain(new.map(|(tick, note)| (*tick, *note))).collect();
    changed.into_iter().try_for_each(|(tick, note)| recorder.mark(Bookmark { tick, note: note.to_owned() }))
}

fn note_bookmarks(
    mut recording: ResMut<Recording>,
    rewind: Option<Res<Rewind>>,
    mut file_error: ResMut<FileError>,
) {
    let Some(rewind) = rewind else { return };
    for (branch, recorder) in &mut recording.recorders {
        if let Err(error) = mark(recorder, &rewind, *branch) {
            file_error.0 = Some(cannot_write(recorder.path(), &error));
        }
    }
}

fn note(world: &mut World) {
    world.resource_scope(|world, mut recording: Mut<Recording>| {
        let present = recording.present;
        let Some(recorder) = recording.recorders.get_mut(&present) else { return };
        if let Err(error) = recorder.note(world) {
            let message = cannot_write(recorder.path(), &error);
            world.resource_mut::<FileError>().0 = Some(format!("{message}. It is not recorded any more"));
            recording.recorders.remove(&present);
        }
    });
}

/// From now on a branch is recorded that was recorded before. How many of its ticks are; any number, if there is no recording.
pub(super) fn take(world: &mut World, branch: BranchId) -> u64 {
    let mut recording = world.resource_mut::<Recording>();
    let known = recording.recorders.get(&branch).map(Recorder::ticks);
    if known.is_some() {
        recording.present = branch;
    }
    known.unwrap_or(u64::MAX)
}

/// From now on the present branch is recorded. The tick in which it began has just been played, if any has.
pub(super) fn follow(world: &mut World, rewind: &Rewind) {
    let present = rewind.present();
    let mut recording = world.resource_mut::<Recording>();
    if recording.present == present {
        return;
    }
    if let Some(error) = recording.branch(present, rewind.branch(present).from) {
        world.resource_mut::<FileError>().0 = Some(error);
    }
    note(world);
}

/// The last seconds are recorded when the window closes.
fn finish(mut recording: ResMut<Recording>, rewind: Option<Res<Rewind>>) {
    recording.close(rewind.as_deref());
}

fn cannot_write(path: &Path, error: &std::io::Error) -> String {
    format!("{}: cannot be written: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_matches_are_recorded_beside_the_first() {
        let first = Path::new("there/mine.replay");
        assert_eq!(numbered(first, 1), first);
        assert_eq!(numbered(first, 2), Path::new("there/mine-2.replay"));
        assert_eq!(numbered(Path::new("mine"), 3), Path::new("mine-3"));
    }
}
