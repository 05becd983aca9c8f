//! From a strategy file to a strategy: looks every name up, checks every number, and numbers the memories of stateful
//! operators. The first fault is reported with its place in the file.

mod assemblage;
mod machine;
mod roles;
mod teamwork;
#[cfg(test)]
mod tests;
mod words;

use std::collections::BTreeMap;

use bevy::prelude::Vec2;

use super::file::StrategyFile;
use super::language::Feature;
use super::pieces::{NamedFeatures, Strategy, stretched};
use crate::data::{Bound, DataError, Field, Source, check_count, no_such};
use crate::geometry::Zone;
pub(super) use teamwork::Roles;

type Resolved<T> = Result<T, DataError>;

/// Positions are stretched from the pitch that the file was written for to the one that is played on, of this size in metres.
pub(super) fn resolve(file: &StrategyFile, source: &Source, pitch: Option<Vec2>) -> Resolved<Strategy> {
    let root = Field::root();
    let scale = pitch.zip(file.pitch).map_or(Vec2::ONE, |(played, drawn)| played / drawn);
    let roles = Roles { names: file.roles.keys().map(String::as_str).collect(), source };
    let mut resolver = Resolver { file, source, roles, scale, slots: 0, open: Vec::new(), depth: 0, work: 0 };
    resolver.check_sizes()?;
    source.distinct(&root.key("robot_kinds"), &file.robot_kinds)?;
    let features = resolver.check_named_pieces()?;
    let assemblages = (file.assemblages.iter())
        .map(|(name, assemblage)| resolver.assemblage(name, assemblage, &root.key("assemblages").key(name)))
        .collect::<Resolved<Vec<_>>>()?;
    let machines = (file.machines.iter())
        .map(|(name, machine)| resolver.machine(name, machine, &root.key("machines").key(name)))
        .collect::<Resolved<Vec<_>>>()?;
    let roles = (file.roles.iter())
        .map(|(name, role)| resolver.role(name, role, &root.key("roles").key(name)))
        .collect::<Resolved<Vec<_>>>()?;
    let players = resolver.players(&root.key("players"))?;
    resolver.kick_off(players.len())?;
    for (name, places) in &file.line_ups {
        resolver.places(places, players.len(), &root.key("line_ups").key(name))?;
    }
    let line_ups = file.line_ups.iter().map(|(name, places)| (name.clone(), stretched(places, scale)));
    Ok(Strategy {
        name: file.name.clone(),
        description: file.description.clone(),
        pitch: file.pitch,
        robot_kinds: file.robot_kinds.clone(),
        roles,
        players,
        kick_off: file.kick_off.scaled(scale),
        line_ups: line_ups.collect(),
        machines,
        assemblages,
        teamwork: resolver.roles.teamwork(&file.teamwork, &root.key("teamwork"))?,
        slots: resolver.slots,
        features,
    })
}

struct Resolver<'a> {
    file: &'a StrategyFile,
    source: &'a Source,
    roles: Roles<'a>,
    /// From positions in the file to those on the pitch that is played on.
    scale: Vec2,
    slots: usize,
    /// Names that are being looked up, to notice one that is defined by itself.
    open: Vec<String>,
    /// How many values are around the one that is being checked, names counted as what they stand for.
    depth: usize,
    /// How many values have been checked.
    work: usize,
}

impl Resolver<'_> {
    fn fault<T>(&self, at: &Field, message: impl Into<String>) -> Resolved<T> {
        Err(self.source.error_at(at, message))
    }

    /// The place of a name among the keys of a map.
    fn index<T>(&self, map: &BTreeMap<String, T>, what: &str, name: &str, at: &Field) -> Resolved<usize> {
        match map.keys().position(|key| key == name) {
            Some(index) => Ok(index),
            None => self.fault(at, unknown(map, what, name)),
        }
    }

    fn within(&self, value: f32, bound: Bound, at: &Field) -> Resolved<()> {
        self.source.within(at, value, bound)
    }

    fn place(&self, place: Vec2, at: &Field) -> Resolved<()> {
        self.source.vector_within(at, place, Bound::PLACE)
    }

    fn sound_zone(&self, zone: Zone, at: &Field) -> Resolved<()> {
        self.place(zone.min, &at.key("min"))?;
        self.place(zone.max, &at.key("max"))?;
        if zone.is_finite() { Ok(()) } else { self.fault(at, "its min must be below its max") }
    }

    fn count(&self, what: &str, count: usize, most: usize, at: &Field) -> Resolved<()> {
        self.source.locate(at, check_count("", &format!("the number of {what}"), count, 0..=most))
    }

    /// Checks one value inside others, and what is inside it.
    fn nested(&mut self, at: &Field, check: impl FnOnce(&mut Self) -> Resolved<()>) -> Resolved<()> {
        self.depth += 1;
        self.work += 1;
        if self.depth > DEEPEST {
            return self
                .fault(at, format!("is nested too deeply: {DEEPEST} values inside each other at most"));
        }
        if self.work > MOST_WORK {
            let message = "with every name replaced by what it stands for, the strategy becomes too large: ";
            return self.fault(at, format!("{message}{MOST_WORK} values at most"));
        }
        check(self)?;
        self.depth -= 1;
        Ok(())
    }

    fn slot(&mut self) -> usize {
        self.slots += 1;
        self.slots - 1
    }

    /// Checks the pitch, and how many pieces there are.
    fn check_sizes(&self) -> Resolved<()> {
        let (file, root) = (self.file, Field::root());
        if let Some(drawn) = file.pitch {
            self.source.vector_within(&root.key("pitch"), drawn, Bound::PITCH)?;
        }
        let sections = [
            ("line_ups", file.line_ups.len(), MOST_PIECES),
            ("zones", file.zones.len(), MOST_PIECES),
            ("percepts", file.percepts.len(), MOST_PIECES),
            ("point_sets", file.point_sets.len(), MOST_PIECES),
            ("features", file.features.len(), MOST_PIECES),
            ("schemas", file.schemas.len(), MOST_PIECES),
            ("assemblages", file.assemblages.len(), MOST_PIECES),
            ("machines", file.machines.len(), MOST_PIECES),
            ("roles", file.roles.len(), MOST_ROLES),
        ];
        for (section, count, most) in sections {
            self.count("its pieces", count, most, &root.key(section))?;
        }
        Ok(())
    }

    /// Checks what is named but perhaps never used; returns the features.
    fn check_named_pieces(&mut self) -> Resolved<NamedFeatures> {
        let (file, root) = (self.file, Field::root());
        for (name, zone) in &file.zones {
            self.sound_zone(*zone, &root.key("zones").key(name))?;
        }
        for (name, point) in &file.percepts {
            self.point(&mut point.clone(), &root.key("percepts").key(name))?;
        }
        for (name, points) in &file.point_sets {
            self.points(&mut points.clone(), &root.key("point_sets").key(name))?;
        }
        let mut features = NamedFeatures::default();
        for (name, feature) in &file.features {
            let resolved = self.resolved_feature(feature, &root.key("features").key(name))?;
            features.by_name.insert(name.clone(), resolved);
        }
        for (name, schema) in &file.schemas {
            self.schema(&mut schema.clone(), &root.key("schemas").key(name))?;
        }
        features.slots = std::mem::take(&mut self.slots);
        Ok(features)
    }

    /// What a name stands for, with the names in it replaced in turn; a name that is defined by itself is a fault.
    fn expand<T: Clone>(
        &mut self,
        map: &BTreeMap<String, T>,
        what: &str,
        name: &str,
        at: &Field,
        resolve: impl FnOnce(&mut Self, &mut T) -> Resolved<()>,
    ) -> Resolved<T> {
        let Some(definition) = map.get(name) else {
            return self.fault(at, unknown(map, what, name));
        };
        let key = format!("{what} {name}");
        if self.open.contains(&key) {
            return self.fault(at, format!("`{name}` is defined by itself"));
        }
        self.open.push(key);
        let mut expanded = definition.clone();
        resolve(self, &mut expanded)?;
        self.open.pop();
        Ok(expanded)
    }

    fn resolved_feature(&mut self, feature: &Feature, at: &Field) -> Resolved<Feature> {
        let mut resolved = feature.clone();
        self.feature(&mut resolved, at)?;
        Ok(resolved)
    }

    fn players(&self, at: &Field) -> Resolved<Vec<usize>> {
        if self.file.players.is_empty() || self.file.players.len() > MAX_PLAYERS {
            return self.fault(
                at,
                format!("a team has 1 to {MAX_PLAYERS} players, not {}", self.file.players.len()),
            );
        }
        (self.file.players.iter().enumerate())
            .map(|(i, role)| self.index(&self.file.roles, "role", role, &at.index(i)))
            .collect()
    }

    fn kick_off(&self, players: usize) -> Resolved<()> {
        for (side, places) in [("ours", &self.file.kick_off.ours), ("theirs", &self.file.kick_off.theirs)] {
            let at = Field::root().key("kick_off").key(side);
            self.places(places, players, &at)?;
            if let Some(i) = places.iter().position(|place| place.x > 0.0) {
                return self.fault(&at.index(i), "must lie in the team's own half: x of 0 at most");
            }
        }
        Ok(())
    }

    /// Places for all players.
    fn places(&self, places: &[Vec2], players: usize, at: &Field) -> Resolved<()> {
        if places.len() != players {
            return self.fault(at, format!("{} places for {players} players", places.len()));
        }
        places.iter().enumerate().try_for_each(|(i, place)| self.place(*place, &at.index(i)))
    }
}

/// Robots that one team can field.
pub const MAX_PLAYERS: usize = 11;
/// Pieces in a section of a strategy, or states of a machine.
const MOST_PIECES: usize = 1000;
/// Roles are spoken of by numbers of one byte.
const MOST_ROLES: usize = 256;
/// Values inside each other, with every name replaced by what it stands for.
const DEEPEST: usize = 64;
/// Values of a whole strategy, with every name replaced by what it stands for, wherever it is used.
const MOST_WORK: usize = 50_000;

fn unknown<T>(map: &BTreeMap<String, T>, what: &str, name: &str) -> String {
    no_such(what, name, map.keys())
}
