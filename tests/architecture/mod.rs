//! The architecture as rules: which room of `src/` may import from which, what only some rooms may name, that no files import
//! each other in a circle, and that a type name has one meaning.

mod imports;

use std::collections::{BTreeMap, BTreeSet};

use imports::{House, read_house};
use pathfinding::prelude::strongly_connected_components;

/// Each room with the rooms that it may import from. All may import from the ground: `schedule state clock ids ops rng geometry`.
const MAY_IMPORT: &[(&str, &[&str])] = &[
    ("data", &[]),
    ("pitch", &["data"]),
    ("vision", &["data", "pitch"]),
    ("protocol", &["data"]),
    ("strategy", &["data", "pitch", "protocol"]),
    ("robot", &["data", "strategy", "vision"]),
    ("comms", &["data", "protocol", "robot"]),
    ("world", &["data", "pitch", "robot", "vision"]),
    ("mind", &["comms", "pitch", "protocol", "robot", "strategy"]),
    ("game", &["comms", "data", "mind", "pitch", "protocol", "robot", "strategy", "vision", "world"]),
    ("lab", &["comms", "data", "game", "mind", "pitch", "protocol", "robot", "strategy", "vision", "world"]),
    (
        "app",
        &[
            "comms", "data", "game", "lab", "mind", "pitch", "protocol", "robot", "strategy", "vision",
            "world",
        ],
    ),
];

/// The files that every room may import from, and that import from no room.
const GROUND: &[&str] = &["clock", "geometry", "ids", "ops", "rng", "schedule", "state"];

/// A crate, the only rooms that may name it, and why.
const ONLY_IN: &[(&str, &[&str], &str)] = &[
    ("bevy_egui", &["app"], "a match needs no window"),
    ("bevy_inspector_egui", &["app"], "a match needs no window"),
    ("bevy_rapier2d", &["app", "game", "robot", "world"], "minds and radios know no bodies"),
    ("libm", &["ops"], "the functions that every machine computes alike are one list"),
];

/// Modules of this crate and others that a room may not name, and why.
const NEVER: &[(&str, &str, &str)] = &[
    ("protocol", "bevy", "a protocol is a pure machine that a model checker can explore"),
    ("protocol", "rand", "a protocol is decided by its inputs alone"),
    ("protocol", "crate::rng", "a protocol is decided by its inputs alone"),
    ("mind", "crate::world", "a robot knows only what it sensed and heard"),
];

#[test]
fn every_room_imports_only_from_the_rooms_that_the_table_allows() {
    let house = read_house();
    let allowed: BTreeMap<&str, &[&str]> = MAY_IMPORT.iter().copied().collect();
    let mut wrong = BTreeSet::new();
    for (from, to, name) in house.arrows() {
        let (here, there) = (House::room(from), House::room(to));
        if here == there || GROUND.contains(&there) || here.is_empty() {
            continue;
        }
        if !allowed.get(here).is_some_and(|rooms| rooms.contains(&there)) {
            wrong.insert(format!("{from} imports {name} from {to}: `{here}` may not import from `{there}`"));
        }
    }
    assert!(wrong.is_empty(), "{}", lines(&wrong));
}

#[test]
fn every_arrow_of_the_table_is_used() {
    let house = read_house();
    let used: BTreeSet<(&str, &str)> =
        house.arrows().map(|(from, to, _)| (House::room(from), House::room(to))).collect();
    let idle = MAY_IMPORT.iter().flat_map(|(room, rooms)| rooms.iter().map(move |other| (*room, *other)));
    let idle: BTreeSet<String> = idle
        .filter(|arrow| !used.contains(arrow))
        .map(|(room, other)| format!("`{room}` does not import from `{other}`: take it out of the table"))
        .collect();
    assert!(idle.is_empty(), "{}", lines(&idle));
}

#[test]
fn crates_and_rooms_are_named_only_where_they_may_be() {
    let house = read_house();
    let mut wrong = BTreeSet::new();
    for (file, path) in house.paths() {
        let room = House::room(file);
        let is_at = |what: &str| path == what || path.starts_with(&format!("{what}::"));
        for (name, rooms, reason) in ONLY_IN {
            if is_at(name) && !rooms.contains(&room) && !room.is_empty() {
                wrong.insert(format!("{file} names {path}, but only {rooms:?} may name {name}: {reason}"));
            }
        }
        for (banned_in, name, reason) in NEVER {
            if room == *banned_in && is_at(name) {
                wrong.insert(format!("{file} names {path}, but `{room}` may not name {name}: {reason}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", lines(&wrong));
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let house = read_house();
    let mut imported: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (from, to, _) in house.arrows() {
        imported.entry(from).or_default().insert(to);
    }
    let files: Vec<&str> = imported.keys().copied().collect();
    let all = strongly_connected_components(&files, |file| imported.get(file).cloned().unwrap_or_default());
    let circles: BTreeSet<String> = (all.into_iter())
        .filter(|files| files.len() > 1)
        .map(|files| {
            let ties = house.arrows().filter(|(from, to, _)| files.contains(from) && files.contains(to));
            let ties: BTreeSet<String> =
                ties.map(|(from, to, name)| format!("    {from} imports {name} from {to}")).collect();
            format!("{} files import each other in a circle:\n{}", files.len(), lines(&ties))
        })
        .collect();
    assert!(circles.is_empty(), "{}", lines(&circles));
}

#[test]
fn a_type_name_is_defined_once() {
    let house = read_house();
    let mut places: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (file, name) in house.types() {
        places.entry(name).or_default().insert(file);
    }
    let twice: BTreeSet<String> = (places.into_iter())
        .filter(|(_, files)| files.len() > 1)
        .map(|(name, files)| format!("{name} is defined in {files:?}"))
        .collect();
    assert!(twice.is_empty(), "{}", lines(&twice));
}

fn lines(all: &BTreeSet<String>) -> String {
    all.iter().cloned().collect::<Vec<_>>().join("\n")
}
