//! What comes of the changes of a design: a fault is told at the change that brings it, and a change that changes nothing is refused.

use super::file::{DesignChange, PlacedChange};
use super::treatment::{TreatmentPlan, fields_of, is_values};
use crate::data::{AssetFolder, DataError, Field, Source};

/// Reads everything that the matches of a treatment need.
///
/// # Errors
/// As [`TreatmentPlan::read`]. A fault that is not there without something that the design puts in a file is told at its place in the
/// design.
pub(in crate::lab) fn read_treatment(
    assets: &AssetFolder,
    design: &Source,
    changes: &[PlacedChange],
) -> Result<TreatmentPlan, DataError> {
    let read = |changes: &[PlacedChange]| TreatmentPlan::read(assets, design, changes);
    read(changes).map_err(|fault| {
        if fault.path == design.path {
            return fault;
        }
        let brings = |place: usize| match read(&with(changes, place, None)) {
            Ok(_) => true,
            Err(without) => without != fault && without.path != design.path,
        };
        let mut put = changes.iter().enumerate().rev().filter_map(|(place, (at, change))| {
            let key = match change {
                DesignChange::Number { .. } if is_values(at) => "values",
                DesignChange::Number { .. } | DesignChange::TeamNumber { .. } => "to",
                DesignChange::Instead { .. } => "read",
                _ => return None,
            };
            brings(place).then(|| fields_of(at, change).key(key))
        });
        put.next().map_or_else(|| fault.clone(), |at| design.error_at(&at, fault.to_string()))
    })
}

/// Checks that each number and each file that a design changes makes a difference to a match of some treatment; which are given with
/// their changes.
///
/// # Errors
/// The first one that does not, at its place.
pub(in crate::lab) fn check_effects(
    assets: &AssetFolder,
    design: &Source,
    treatments: &[(Vec<PlacedChange>, &TreatmentPlan)],
) -> Result<(), DataError> {
    let mut effective: Vec<&Field> = Vec::new();
    for (changes, plan) in treatments {
        for (place, (at, change)) in changes.iter().enumerate() {
            let Some((otherwise, _)) = otherwise(change).filter(|_| !effective.contains(&at)) else {
                continue;
            };
            let read = TreatmentPlan::read(assets, design, &with(changes, place, otherwise));
            // What the files do not allow makes a difference, too.
            if read.is_ok_and(|read| read.plays_as(plan)) {
                continue;
            }
            effective.push(at);
        }
    }
    for (at, change) in treatments.iter().flat_map(|(changes, _)| changes) {
        if let Some((_, key)) = otherwise(change).filter(|_| !effective.contains(&at)) {
            let at = fields_of(at, change).key(key);
            return Err(design.error_at(&at, "makes no difference to any match"));
        }
    }
    Ok(())
}

/// What to do in place of a change of a file to see whether it makes a difference, if not nothing at all, and the field that names the
/// file; nothing for other changes.
fn otherwise(change: &DesignChange) -> Option<(Option<DesignChange>, &'static str)> {
    let mut other = change.clone();
    match &mut other {
        DesignChange::Number { to, .. } | DesignChange::TeamNumber { to, .. } => {
            *to = if *to == 0.0 { 1.0 } else { *to / 2.0 };
            Some((Some(other), "file"))
        }
        DesignChange::Instead { .. } => Some((None, "of")),
        _ => None,
    }
}

/// Changes with another one, or none, at a place.
fn with(changes: &[PlacedChange], place: usize, change: Option<DesignChange>) -> Vec<PlacedChange> {
    let here = change.map(|change| (changes[place].0.clone(), change));
    [&changes[..place], here.as_slice(), &changes[place + 1..]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::experiment::file::placed;

    /// The first fault of a list of changes, as one treatment.
    fn fault(list: &str) -> Option<String> {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let design = Source::new("a.ron", list);
        let changes: Vec<DesignChange> = design.parse().unwrap();
        let changes = placed(&Field::root(), &changes);
        let read = read_treatment(&assets, &design, &changes);
        let checked = read.and_then(|plan| check_effects(&assets, &design, &[(changes, &plan)]));
        checked.err().map(|fault| fault.to_string())
    }

    #[test]
    fn what_a_design_puts_in_a_file_is_told_at_its_place_in_the_design() {
        for (list, told) in [
            (
                r#"[Number(file: "radios/good.ron", path: "loss.Independent[0]", to: 7)]"#,
                "a.ron:1:67: [0].Number.to: ",
            ),
            (
                r#"[TeamNumber(team: Home, file: "strategies/hammerheads_2001.ron", path: "schemas.dock.DockBehind.standoff", to: -7)]"#,
                "a.ron:1:112: [0].TeamNumber.to: ",
            ),
            (
                r#"[Instead(of: "pitches/middle_size_2001.ron", read: "radios/good.ron")]"#,
                "a.ron:1:52: [0].Instead.read: ",
            ),
            (
                r#"[Number(file: "radios/awful.ron", path: "latency.fixed", to: -7), Event(at: 1, what: Radio("awful"))]"#,
                "a.ron:1:62: [0].Number.to: ",
            ),
        ] {
            let fault = fault(list).unwrap();
            assert!(fault.starts_with(told) && fault.contains("/assets/"), "{fault}");
        }
    }

    #[test]
    fn a_change_that_makes_no_difference_is_refused_and_one_of_a_file_that_is_read_in_place_of_another_is_not()
     {
        let number = |file: &str| format!(r#"Number(file: "{file}", path: "latency.fixed", to: 0.5)"#);
        let instead =
            |of: &str, read: &str| format!(r#"Instead(of: "radios/{of}.ron", read: "radios/{read}.ron")"#);
        let [good, awful] = ["radios/good.ron", "radios/awful.ron"].map(number);
        let chasers = r#"TeamNumber(team: Home, file: "strategies/ball_chasers.ron", path: "schemas.dock.DockBehind.standoff", to: 0.5)"#;
        for sound in [
            good.clone(),
            format!("{awful}, {}", instead("good", "awful")),
            format!("{}, {good}", instead("good", "awful")),
            chasers.replace("Home", "Away"),
        ] {
            assert_eq!(fault(&format!("[{sound}]")), None, "{sound}");
        }
        for (idle, named) in [
            (awful, "[0].Number.file"),
            (format!("{good}, {}", instead("good", "awful")), "[0].Number.file"),
            (instead("awful", "good"), "[0].Instead.of"),
            (chasers.to_owned(), "[0].TeamNumber.file"),
        ] {
            let fault = fault(&format!("[{idle}]")).unwrap();
            assert!(fault.contains(named) && fault.contains("makes no difference"), "{fault}");
        }
    }
}
