//! Live reload: looks at the strategies' files a few times a second, and the match goes on with what has changed. A bad file is
//! shown, and the old strategy plays on.
//!
//! The contents are compared rather than times or events, which is the same on every file system and with every editor;
//! files are taken only when they read the same twice, so that none is caught half-written.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use bevy::prelude::*;
use bevy::time::common_conditions::on_real_timer;

use crate::app::view::state::{Announcement, FileError, Folder, MatchBegun, Screen, Session};
use crate::data::contents;
use crate::game::requests::{Request, Requests};
use crate::ids::Team;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Watched>().add_observer(watch_files).add_systems(
        Update,
        take_over_changes.run_if(in_state(Screen::Match).and_then(on_real_timer(INTERVAL))),
    );
}

/// Time between two looks; a change is taken over at the second one that shows it.
const INTERVAL: Duration = Duration::from_millis(300);

/// The files that the strategies that play rest on.
#[derive(Resource, Clone, Debug, Default)]
struct Watched(Vec<(Team, FileWatch)>);

/// Files, and what they held when they were last taken over.
#[derive(Clone, Debug, PartialEq, Eq)]
struct FileWatch {
    files: Vec<PathBuf>,
    taken: Contents,
    last: Contents,
}

/// What each of the files holds; `None` for one that cannot be read.
type Contents = Vec<Option<Vec<u8>>>;

impl FileWatch {
    fn over(files: Vec<PathBuf>, reading: Contents) -> FileWatch {
        FileWatch { files, taken: reading.clone(), last: reading }
    }

    /// Whether a new reading is to be taken over, which it is once: when it is not that which was taken before, and is the
    /// same for the second time.
    fn look(&mut self, reading: Contents) -> bool {
        let settled = reading == self.last;
        self.last = reading;
        if !settled || self.last == self.taken {
            return false;
        }
        self.taken.clone_from(&self.last);
        true
    }

    /// Watches other files from now on. Of those that were watched before it is known what was taken over; the others are
    /// read now.
    fn turn_to(&mut self, files: Vec<PathBuf>, read: impl Fn(&Path) -> Option<Vec<u8>>) {
        let taken = files.iter().map(|file| match self.files.iter().position(|known| known == file) {
            Some(place) => self.taken[place].clone(),
            None => read(file),
        });
        *self = FileWatch::over(files.clone(), taken.collect());
    }
}

fn read(file: &Path) -> Option<Vec<u8>> {
    contents(file).ok()
}

fn read_all(files: &[PathBuf]) -> Contents {
    files.iter().map(|file| read(file)).collect()
}

fn watch_files(_: On<MatchBegun>, session: Res<Session>, mut watched: ResMut<Watched>) {
    watched.0.clear();
    let Some(plan) = &session.plan else { return };
    for team in Team::BOTH {
        let files = plan.team(team).strategy_files.clone();
        let reading = read_all(&files);
        watched.0.push((team, FileWatch::over(files, reading)));
    }
}

fn take_over_changes(
    mut watched: ResMut<Watched>,
    (mut session, folder): (ResMut<Session>, Res<Folder>),
    mut requests: ResMut<Requests>,
    (mut announcement, mut file_error): (ResMut<Announcement>, ResMut<FileError>),
) {
    for (team, watch) in &mut watched.0 {
        let team = *team;
        if !watch.look(read_all(&watch.files)) {
            continue;
        }
        let Some(plan) = &mut session.plan else { continue };
        let reading = plan.reread(team, &folder.0);
        watch.turn_to(reading.files.clone(), read);
        match reading.strategy {
            Ok(strategy) => {
                announcement.tell(format!("The {team} team plays on with its changed file"));
                file_error.0 = None;
                let strategy = Arc::new(strategy);
                let plan = &mut plan.teams[team.index()];
                plan.strategy = strategy.clone();
                plan.strategy_files = reading.files;
                plan.strategy_texts = reading.texts.clone();
                requests.ask(Request::ChangeStrategy { team, strategy, texts: reading.texts });
            }
            Err(error) => file_error.0 = Some(format!("{error}. The {team} team plays on with what it had")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{AssetFolder, AssetKind};
    use crate::game::{Choice, MatchPlan};

    fn text(text: &str) -> Contents {
        vec![Some(text.into())]
    }

    fn watch() -> FileWatch {
        FileWatch::over(vec!["x.ron".into()], text("old"))
    }

    #[test]
    fn a_change_is_taken_once_when_it_reads_the_same_twice() {
        let mut watch = watch();
        for (reading, taken) in
            [("old", false), ("half", false), ("new", false), ("new", true), ("new", false)]
        {
            assert_eq!(watch.look(text(reading)), taken, "{reading}");
        }
    }

    #[test]
    fn a_change_that_is_taken_back_at_once_is_none() {
        let mut watch = watch();
        assert!(!["new", "old", "old"].into_iter().any(|reading| watch.look(text(reading))));
    }

    #[test]
    fn a_file_that_vanishes_for_a_moment_while_an_editor_writes_it_is_no_error() {
        let mut watch = watch();
        assert!(!watch.look(vec![None]));
        assert!(!watch.look(text("old")));
        assert!(!watch.look(vec![None]));
        assert!(watch.look(vec![None]));
    }

    #[test]
    fn a_change_of_any_file_that_a_strategy_rests_on_is_taken() {
        let both = |own: &str, base: &str| [text(own), text(base)].concat();
        let mut watch = FileWatch::over(vec!["x.ron".into(), "base.ron".into()], both("own", "base"));
        assert!(!watch.look(both("own", "changed")));
        assert!(watch.look(both("own", "changed")));
    }

    #[test]
    fn a_change_made_while_a_strategy_is_read_is_not_missed_when_its_files_are_others() {
        let mut watch = watch();
        watch.look(text("new"));
        assert!(watch.look(text("new")));
        watch.turn_to(vec!["x.ron".into(), "base.ron".into()], |_| Some("base".into()));
        let newer = [text("newer"), text("base")].concat();
        assert!(!watch.look(newer.clone()));
        assert!(watch.look(newer));
    }

    #[test]
    fn the_files_of_both_teams_are_watched_and_those_that_they_are_based_on() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let home = Some("hammerheads_swap".into());
        let plan = MatchPlan::read(&assets, &Choice { home, ..Choice::default() }).unwrap();
        let mut app = App::new();
        app.init_resource::<Watched>().add_observer(watch_files);
        app.insert_resource(Session { plan: Some(plan), ..Session::default() });
        app.world_mut().trigger(MatchBegun);
        let watched = &app.world().resource::<Watched>().0;
        let names = watched.iter().map(|(team, watch)| {
            let names = watch.files.iter().map(|file| file.file_stem().unwrap().to_str().unwrap());
            (*team, names.collect::<Vec<_>>())
        });
        let home = vec!["hammerheads_swap", "hammerheads_2001"];
        assert_eq!(names.collect::<Vec<_>>(), [(Team::Home, home), (Team::Away, vec!["ball_chasers"])]);
        assert!(watched.iter().all(|(_, watch)| watch.taken.iter().all(Option::is_some)));
    }

    #[test]
    fn a_changed_file_is_asked_for_and_is_the_file_of_the_match_from_then_on() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("mine.ron");
        let old =
            std::fs::read_to_string(assets.file(AssetKind::Strategy, "ball_chasers")).expect("a strategy");
        std::fs::write(&file, &old).expect("a file");
        let home = Some(file.to_str().expect("a plain path").to_owned());
        let plan = MatchPlan::read(&assets, &Choice { home, ..Choice::default() }).unwrap();
        let name = plan.team(Team::Home).strategy.name.clone();
        let mut app = App::new();
        app.init_resource::<Watched>().add_observer(watch_files).add_systems(Update, take_over_changes);
        app.init_resource::<Requests>().init_resource::<Announcement>().init_resource::<FileError>();
        app.insert_resource(Session { plan: Some(plan), ..Session::default() })
            .insert_resource(Folder(assets));
        app.world_mut().trigger(MatchBegun);
        std::fs::write(&file, old.replace(&name, "Changed")).expect("a file");
        (0..2).for_each(|_| app.update());
        let session = app.world().resource::<Session>();
        assert_eq!(
            session.plan.as_ref().map(|plan| plan.team(Team::Home).strategy.name.as_str()),
            Some("Changed")
        );
        let requests = app.world().resource::<Requests>();
        assert!(
            requests
                .iter()
                .any(|request| matches!(request, Request::ChangeStrategy { team: Team::Home, .. }))
        );
    }
}
