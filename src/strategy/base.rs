//! A strategy that is another one with changes: the file names its base and holds what is different.

use std::collections::BTreeMap;

use super::file::{KickOff, StrategyFile};
use super::resolve::resolve;
use crate::data::{DataError, Field, Source};

/// Fills what a file leaves out from the strategy that it is based on, a file beside it.
pub(super) fn complete(file: StrategyFile, source: &Source) -> Result<StrategyFile, DataError> {
    let Some(name) = &file.based_on else { return Ok(file) };
    let at = Field::root().key("based_on");
    let path = source.path.with_file_name(format!("{name}.ron"));
    if !path.is_file() {
        return Err(source.error_at(&at, format!("there is no {}", path.display())));
    }
    let base_source = Source::read(&path)?;
    let base: StrategyFile = base_source.parse()?;
    if base.based_on.is_some() {
        return Err(source.error_at(&at, format!("{name} is based on another strategy itself")));
    }
    // Its own faults are told with their places in it.
    resolve(&base, &base_source, None)?;
    Ok(file.over(base))
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
            zones: merged(self.zones, base.zones),
            percepts: merged(self.percepts, base.percepts),
            point_sets: merged(self.point_sets, base.point_sets),
            features: merged(self.features, base.features),
            schemas: merged(self.schemas, base.schemas),
            assemblages: merged(self.assemblages, base.assemblages),
            machines: merged(self.machines, base.machines),
            roles: merged(self.roles, base.roles),
            teamwork: self.teamwork.or(base.teamwork),
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
