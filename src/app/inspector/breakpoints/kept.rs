//! Breakpoints are kept between runs, in a small file beside the window's settings.

use std::path::{Path, PathBuf};

use bevy::prelude::*;

use super::list::Breakpoints;
use crate::app::view::interface::settings::{SettingsFile, keep};
use crate::data::{DataError, Source};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(PreStartup, load.run_if(resource_exists::<SettingsFile>))
        .add_systems(Last, save.run_if(resource_exists::<KeptBreakpoints>));
}

/// What the file says now, as far as is known.
#[derive(Resource, Clone, Debug)]
struct KeptBreakpoints {
    path: PathBuf,
    saved: Breakpoints,
}

fn read(path: &Path) -> Result<Breakpoints, DataError> {
    if path.exists() { Source::read(path)?.parse() } else { Ok(Breakpoints::default()) }
}

fn load(mut commands: Commands, settings: Res<SettingsFile>, mut breakpoints: ResMut<Breakpoints>) {
    let path = settings.0.with_file_name("breakpoints.ron");
    match read(&path) {
        Ok(known) => *breakpoints = known,
        Err(error) => error!("{error}; there are no breakpoints"),
    }
    commands.insert_resource(KeptBreakpoints { path, saved: breakpoints.clone() });
}

fn save(breakpoints: Res<Breakpoints>, mut kept: ResMut<KeptBreakpoints>) {
    if !breakpoints.is_changed() || *breakpoints == kept.saved {
        return;
    }
    kept.saved = breakpoints.clone();
    if let Err(error) = keep(&kept.path, &kept.saved) {
        error!("{}: breakpoints cannot be remembered: {error}", kept.path.display());
    }
}

#[cfg(test)]
mod tests {
    use super::super::breakpoint::{MessageEvent, WhistleKind};
    use super::super::{Breakpoint, StopAt};
    use super::*;
    use crate::ids::{RobotId, Team};

    fn window(settings: &Path) -> App {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, plugin)).init_resource::<Breakpoints>();
        app.insert_resource(SettingsFile(settings.to_owned()));
        app
    }

    fn all_kinds() -> Breakpoints {
        let text = str::to_owned;
        let kinds = [
            StopAt::State { machine: text("halfback"), state: text("acquire") },
            StopAt::Transition { machine: text("m"), from: text("a"), go: text("b"), when: Some(text("c")) },
            StopAt::Feature(text("stuck")),
            StopAt::Message { kind: text("LOCK"), event: MessageEvent::Arrived },
            StopAt::Whistle(Some(WhistleKind::Goal)),
            StopAt::Whistle(None),
        ];
        let mut breakpoints = Breakpoints::default();
        kinds.into_iter().for_each(|at| breakpoints.set(Some(RobotId::new(Team::Away, 3)), at));
        breakpoints.0[1] = Breakpoint { on: false, who: None, ..breakpoints.0[1].clone() };
        breakpoints
    }

    #[test]
    fn breakpoints_are_there_in_the_next_run() {
        let folder = tempfile::tempdir().expect("a folder");
        let settings = folder.path().join("not/yet/there/settings.ron");
        let mut app = window(&settings);
        app.update();
        assert!(!settings.with_file_name("breakpoints.ron").exists(), "nothing has been set yet");
        app.insert_resource(all_kinds());
        app.update();
        let mut next = window(&settings);
        next.update();
        assert_eq!(*next.world().resource::<Breakpoints>(), all_kinds());
        next.insert_resource(Breakpoints::default());
        next.update();
        let mut last = window(&settings);
        last.update();
        assert_eq!(*last.world().resource::<Breakpoints>(), Breakpoints::default());
    }

    #[test]
    fn a_damaged_file_is_one_line_and_is_left_alone_until_a_breakpoint_is_set() {
        let folder = tempfile::tempdir().expect("a folder");
        let settings = folder.path().join("settings.ron");
        let path = folder.path().join("breakpoints.ron");
        for damaged in ["", "[(at: ", "[(at: Feature(3))]", "[(who: \"guest 9\", at: Whistle(None))]"] {
            std::fs::write(&path, damaged).expect("a file");
            let told = read(&path).expect_err("it is damaged").to_string();
            assert!(told.contains("breakpoints.ron") && !told.contains('\n'), "{told}");
            let mut app = window(&settings);
            app.update();
            assert_eq!(*app.world().resource::<Breakpoints>(), Breakpoints::default());
            assert_eq!(std::fs::read_to_string(&path).expect("it is there"), damaged);
        }
    }
}
