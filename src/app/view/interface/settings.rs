//! What the window remembers between runs: which panels and overlays were open and how large the panels were, in a small file in
//! the platform's folder for settings.

use std::path::{Path, PathBuf};

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::app::view::state::{OpenPanels, PanelSizes, RememberedPanels};
use crate::data::{Bound, DataError, Field, Source};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(PreStartup, load.run_if(resource_exists::<SettingsFile>))
        .add_systems(Last, save.run_if(resource_exists::<SettingsFile>));
}

/// Where the settings are kept; nothing is remembered without it.
#[derive(Resource, Clone, Debug, PartialEq, Eq)]
pub struct SettingsFile(pub PathBuf);

impl SettingsFile {
    /// In the platform's folder for settings, if it has one.
    pub fn of_this_person() -> Option<SettingsFile> {
        let folders = directories::ProjectDirs::from("", "", "touchline")?;
        Some(SettingsFile(folders.config_dir().join("settings.ron")))
    }
}

/// What is in the file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WindowSettings {
    watching: OpenPanels,
    playing: OpenPanels,
    sizes: PanelSizes,
}

impl WindowSettings {
    fn of(remembered: &RememberedPanels, mut sizes: PanelSizes) -> WindowSettings {
        // Whole points, so that a panel that settles is no change.
        for (_, size) in sizes.each() {
            *size = size.round();
        }
        WindowSettings { watching: remembered.watching, playing: remembered.playing, sizes }
    }

    /// None if there is no file yet.
    fn read(path: &Path) -> Result<Option<WindowSettings>, DataError> {
        if !path.exists() {
            return Ok(None);
        }
        let source = Source::read(path)?;
        let mut settings: WindowSettings = source.parse()?;
        let sizes = Field::default().key("sizes");
        for (name, size) in settings.sizes.each() {
            source.within(&sizes.key(name), *size, Bound::POINTS)?;
        }
        Ok(Some(settings))
    }
}

/// Keeps something for the next run: puts a new file into the place of the old one, so that there is always a whole one.
///
/// # Errors
/// If it cannot be written.
pub fn keep(path: &Path, what: &impl Serialize) -> std::io::Result<()> {
    let text =
        ron::ser::to_string_pretty(what, ron::ser::PrettyConfig::default()).map_err(std::io::Error::other)?;
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let fresh = path.with_extension("ron.new");
    std::fs::write(&fresh, text + "\n")?;
    std::fs::rename(fresh, path)
}

/// What the file says now, as far as is known.
#[derive(Resource, Clone, Copy, Debug)]
struct Saved(WindowSettings);

fn load(
    mut commands: Commands,
    file: Res<SettingsFile>,
    (mut remembered, mut sizes): (ResMut<RememberedPanels>, ResMut<PanelSizes>),
) {
    match WindowSettings::read(&file.0) {
        Ok(Some(settings)) => {
            *remembered = RememberedPanels::new(settings.watching, settings.playing);
            *sizes = settings.sizes;
        }
        Ok(None) => {}
        Err(error) => error!("{error}; panels and overlays are as at first"),
    }
    commands.insert_resource(Saved(WindowSettings::of(&remembered, *sizes)));
}

fn save(
    file: Res<SettingsFile>,
    (remembered, sizes): (Res<RememberedPanels>, Res<PanelSizes>),
    buttons: Res<ButtonInput<MouseButton>>,
    mut saved: ResMut<Saved>,
) {
    let settings = WindowSettings::of(&remembered, *sizes);
    // While an edge is dragged every frame would be a change.
    if settings == saved.0 || buttons.pressed(MouseButton::Left) {
        return;
    }
    saved.0 = settings;
    if let Err(error) = keep(&file.0, &settings) {
        error!("{}: what is open cannot be remembered: {error}", file.0.display());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::view::state::{Overlay, Overlays};

    fn window(file: &Path) -> App {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, plugin))
            .init_resource::<RememberedPanels>()
            .init_resource::<PanelSizes>();
        app.init_resource::<ButtonInput<MouseButton>>();
        app.insert_resource(SettingsFile(file.to_owned()));
        app
    }

    fn open_radio(app: &mut App) -> (RememberedPanels, PanelSizes) {
        let opened = OpenPanels { overlays: Overlays::only([Overlay::Radio]), inspector: false };
        let remembered = RememberedPanels::new(opened, opened);
        let sizes = PanelSizes { inspector: 500.0, ..PanelSizes::default() };
        app.insert_resource(remembered).insert_resource(sizes);
        (remembered, sizes)
    }

    #[test]
    fn what_was_open_is_open_in_the_next_run() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("not/yet/there/settings.ron");
        let mut app = window(&file);
        app.update();
        assert!(!file.exists(), "nothing has been changed yet");
        let (remembered, sizes) = open_radio(&mut app);
        app.update();
        let mut next = window(&file);
        next.update();
        assert_eq!(*next.world().resource::<RememberedPanels>(), remembered);
        assert_eq!(*next.world().resource::<PanelSizes>(), sizes);
    }

    #[test]
    fn nothing_is_written_while_an_edge_is_dragged() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("settings.ron");
        let mut app = window(&file);
        app.update();
        open_radio(&mut app);
        app.world_mut().resource_mut::<ButtonInput<MouseButton>>().press(MouseButton::Left);
        app.update();
        assert!(!file.exists());
        app.world_mut().resource_mut::<ButtonInput<MouseButton>>().release(MouseButton::Left);
        app.update();
        assert!(file.exists());
    }

    #[test]
    fn a_damaged_file_is_one_line_and_leaves_everything_as_at_first() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("settings.ron");
        let opened = "(overlays: [Labels], inspector: true)";
        let with = |radio: &str| {
            format!(
                "(watching: {opened}, playing: {opened}, sizes: (inspector: 400, radio: {radio}, communication: 246))"
            )
        };
        for damaged in ["", "(watching: ", "\u{fffd}\0", "(watching: (overlays: [Vektors]))", &with("NaN")] {
            std::fs::write(&file, damaged).expect("a file");
            let told = WindowSettings::read(&file).expect_err("it is damaged").to_string();
            assert!(told.contains("settings.ron") && !told.contains('\n'), "{told}");
            let mut app = window(&file);
            app.update();
            assert_eq!(*app.world().resource::<RememberedPanels>(), RememberedPanels::default());
            assert_eq!(*app.world().resource::<PanelSizes>(), PanelSizes::default());
        }
        std::fs::write(&file, with("300")).expect("a file");
        assert_eq!(
            WindowSettings::read(&file).map(|read| read.map(|read| read.sizes.radio)),
            Ok(Some(300.0))
        );
    }
}
