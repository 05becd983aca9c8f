//! Live reload: looks at the strategies' files a few times a second, and the match goes on with what has changed. A bad file is
//! shown, and the old strategy plays on.
//!
//! The contents are compared rather than times or events, which is the same on every file system and with every editor;
//! a file is taken only when it reads the same twice, so that none is caught half-written.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use bevy::prelude::*;
use bevy::time::common_conditions::on_real_timer;

use super::calls::{Call, Trouble};
use super::session::{Folder, MatchBegun, Session};
use super::state::Screen;
use crate::data::{DataError, Field, Source};
use crate::ids::Team;
use crate::script::{Request, Requests};
use crate::strategy::Strategy;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Watched>().add_observer(watch_files).add_systems(
        Update,
        take_over_changes.run_if(in_state(Screen::Match).and_then(on_real_timer(INTERVAL))),
    );
}

/// Time between two looks; a change is taken over at the second one that shows it.
const INTERVAL: Duration = Duration::from_millis(300);

/// The files of the strategies that play.
#[derive(Resource, Clone, Debug, Default)]
struct Watched(Vec<WatchedFile>);

#[derive(Clone, Debug)]
struct WatchedFile {
    team: Team,
    path: PathBuf,
    changes: Changes,
}

/// What a file reads like, or why it does not.
type Reading = Result<Source, DataError>;

/// Tells a change that is over from one that is being made.
#[derive(Clone, Debug)]
struct Changes {
    taken: Reading,
    last: Reading,
}

impl Changes {
    fn since(reading: Reading) -> Changes {
        Changes { taken: reading.clone(), last: reading }
    }

    /// The new reading, once: when it is not that which was taken before, and is the same for the second time.
    fn look(&mut self, reading: Reading) -> Option<Reading> {
        let settled = reading == self.last;
        self.last = reading;
        if !settled || self.last == self.taken {
            return None;
        }
        self.taken = self.last.clone();
        Some(self.last.clone())
    }
}

fn watch_files(_: On<MatchBegun>, session: Res<Session>, folder: Res<Folder>, mut watched: ResMut<Watched>) {
    watched.0.clear();
    let Some(plan) = &session.plan else { return };
    for team in Team::BOTH {
        let path = folder.0.file("strategies", &plan.team(team).strategy_file);
        let changes = Changes::since(Source::read(&path));
        watched.0.push(WatchedFile { team, path, changes });
    }
}

fn take_over_changes(
    mut watched: ResMut<Watched>,
    mut session: ResMut<Session>,
    mut requests: ResMut<Requests>,
    (mut call, mut trouble): (ResMut<Call>, ResMut<Trouble>),
) {
    for file in &mut watched.0 {
        let Some(reading) = file.changes.look(Source::read(&file.path)) else { continue };
        match reading.and_then(|source| follower(&source, &session, file.team)) {
            Ok(strategy) => {
                call.tell(format!("The {} team plays on with its changed file", file.team));
                trouble.0 = None;
                let strategy = Arc::new(strategy);
                if let Some(plan) = &mut session.plan {
                    plan.teams[file.team.index()].strategy = strategy.clone();
                }
                requests.ask(Request::ChangeStrategy { team: file.team, strategy });
            }
            Err(error) => {
                trouble.0 = Some(format!("{error}. The {} team plays on with what it had", file.team))
            }
        }
    }
}

/// The strategy of a changed file, if the team can play on with it.
fn follower(source: &Source, session: &Session, team: Team) -> Result<Strategy, DataError> {
    let strategy = Strategy::parse(source)?;
    let before = session.plan.as_ref().map(|plan| &plan.team(team).strategy);
    match before.map_or(Ok(()), |before| strategy.can_follow(before)) {
        Ok(()) => Ok(strategy),
        Err(reason) => Err(source.error_at(&Field::root().key("players"), reason)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> Reading {
        Ok(Source::new("x.ron", text))
    }

    #[test]
    fn a_change_is_taken_once_when_it_reads_the_same_twice() {
        let mut changes = Changes::since(text("old"));
        assert_eq!(changes.look(text("old")), None);
        assert_eq!(changes.look(text("half")), None);
        assert_eq!(changes.look(text("new")), None);
        assert_eq!(changes.look(text("new")), Some(text("new")));
        assert_eq!(changes.look(text("new")), None);
    }

    #[test]
    fn a_change_that_is_taken_back_at_once_is_none() {
        let mut changes = Changes::since(text("old"));
        assert_eq!(changes.look(text("new")), None);
        assert_eq!(changes.look(text("old")), None);
        assert_eq!(changes.look(text("old")), None);
    }

    #[test]
    fn a_file_that_vanishes_for_a_moment_while_an_editor_writes_it_is_no_error() {
        let gone = || Err(DataError::new("x.ron", "no such file"));
        let mut changes = Changes::since(text("old"));
        assert_eq!(changes.look(gone()), None);
        assert_eq!(changes.look(text("old")), None);
        assert_eq!(changes.look(gone()), None);
        assert_eq!(changes.look(gone()), Some(gone()));
    }
}
