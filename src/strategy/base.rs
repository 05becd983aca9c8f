//! A strategy that is another one with changes: the file names its base and holds what is different.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::file::StrategyFile;
use super::pieces::KickOff;
use super::resolve::resolve;
use crate::data::{AssetFolder, AssetKind, AssetTexts, DataError, Field, Source, is_path};

/// The most strategies that may each be based on the next.
const MAX_BASES: usize = 8;

/// A strategy file and those that it is based on, the nearest first.
pub(super) struct Lineage<'a> {
    assets: &'a AssetFolder,
    row: Vec<PathBuf>,
    /// Whether the strategy itself is no file here.
    is_sent: bool,
    /// Every file that was looked for, whether or not it is there.
    pub(super) files: Vec<PathBuf>,
    /// What was in the bases.
    pub(super) texts: AssetTexts,
}

impl Lineage<'_> {
    pub(super) fn of<'a>(path: &Path, assets: &'a AssetFolder) -> Lineage<'a> {
        Lineage {
            assets,
            row: vec![path.to_owned()],
            is_sent: false,
            files: vec![path.to_owned()],
            texts: AssetTexts::new(),
        }
    }

    /// That of a text from elsewhere, which reaches the files of this machine by the names of assets only.
    pub(super) fn of_sent<'a>(path: &Path, assets: &'a AssetFolder) -> Lineage<'a> {
        Lineage { is_sent: true, ..Lineage::of(path, assets) }
    }

    /// Fills what a file leaves out from the strategy that it is based on.
    pub(super) fn complete(
        &mut self,
        file: StrategyFile,
        source: &Source,
    ) -> Result<StrategyFile, DataError> {
        let Some(name) = &file.based_on else { return Ok(file) };
        let fault = |message| Err(source.error_at(&Field::root().key("based_on"), message));
        let is_sent = self.is_sent && self.row.len() == 1;
        if is_sent && is_path(name) {
            return fault("a strategy that is sent may be based on an asset only, not on a path".into());
        }
        let Some(path) = self.find(name, &source.path, is_sent) else {
            let known = self.assets.names(AssetKind::Strategy).join(", ");
            return fault(format!(
                "there is no strategy `{name}` beside this file or among the assets: {known}"
            ));
        };
        if self.row.iter().any(|other| is_same_file(other, &path)) {
            return fault(format!("`{name}` is based on itself, by way of this file"));
        }
        if self.row.len() > MAX_BASES {
            return fault(format!("more than {MAX_BASES} strategies are based on one another"));
        }
        self.row.push(path.clone());
        let base_source = self.assets.read(&path)?;
        self.texts.insert(path, base_source.text.clone());
        let base = self.complete(base_source.parse()?, &base_source)?;
        // Its own faults are told with their places in it.
        resolve(&base, &base_source, None)?;
        Ok(file.over(base))
    }

    /// The file of a base: that of a path, seen from the folder of the file that names it; else the file of that name in
    /// the same folder, unless it is the naming file itself; else the one among the assets. Beside what was sent is nothing.
    fn find(&mut self, name: &str, from: &Path, is_sent: bool) -> Option<PathBuf> {
        let is_whole = Path::new(name).extension().is_some_and(|it| it.eq_ignore_ascii_case("ron"));
        let beside = from.with_file_name(if is_whole { name.to_owned() } else { format!("{name}.ron") });
        let mut places = if is_sent { Vec::new() } else { vec![beside] };
        if !is_path(name) {
            places.retain(|beside| !is_same_file(beside, from));
            places.push(self.assets.file(AssetKind::Strategy, name));
        }
        for place in places {
            if !self.files.contains(&place) {
                self.files.push(place.clone());
            }
            if self.assets.has_file(&place) {
                return Some(place);
            }
        }
        None
    }
}

fn is_same_file(one: &Path, other: &Path) -> bool {
    one == other || one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

impl StrategyFile {
    fn over(self, base: StrategyFile) -> StrategyFile {
        let kick_off_is_given = self.kick_off != KickOff::default();
        StrategyFile {
            name: self.name,
            description: if self.description.is_empty() { base.description } else { self.description },
            based_on: self.based_on,
            pitch: self.pitch.or(base.pitch),
            robot_kinds: given(self.robot_kinds, base.robot_kinds),
            players: given(self.players, base.players),
            kick_off: if kick_off_is_given { self.kick_off } else { base.kick_off },
            line_ups: merged(self.line_ups, base.line_ups),
            zones: merged(self.zones, base.zones),
            percepts: merged(self.percepts, base.percepts),
            point_sets: merged(self.point_sets, base.point_sets),
            features: merged(self.features, base.features),
            schemas: merged(self.schemas, base.schemas),
            assemblages: merged(self.assemblages, base.assemblages),
            machines: merged(self.machines, base.machines),
            roles: merged(self.roles, base.roles),
            teamwork: self.teamwork.over(base.teamwork),
        }
    }
}

fn given<T>(own: Vec<T>, base: Vec<T>) -> Vec<T> {
    if own.is_empty() { base } else { own }
}

/// The pieces of both; of two with the same name, the file's own.
fn merged<T>(own: BTreeMap<String, T>, mut base: BTreeMap<String, T>) -> BTreeMap<String, T> {
    base.extend(own);
    base
}
