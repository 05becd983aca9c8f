//! What of a robot can be calibrated while it plays, and within which bounds. Pure.

use std::sync::Arc;

use crate::game::requests::Calibration;
use crate::robot::{Drive, Eyes, RobotKind, Sensing};

/// A robot's own copy of its values.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotValues {
    pub kind: RobotKind,
    pub sensing: Sensing,
}

impl RobotValues {
    pub fn of(kind: &RobotKind, sensing: &Sensing) -> RobotValues {
        RobotValues { kind: kind.clone(), sensing: sensing.clone() }
    }

    /// These values as something to be asked for.
    pub fn calibration(self) -> Calibration {
        Calibration { kind: Arc::new(self.kind), sensing: Arc::new(self.sensing) }
    }
}

/// One value: its name, its unit, the least and the most that a slider offers, and what it means.
#[derive(Clone, Copy, Debug)]
pub struct Knob {
    pub group: &'static str,
    pub name: &'static str,
    pub unit: &'static str,
    pub range: (f32, f32),
    pub decimals: usize,
    pub tip: &'static str,
    /// The value, if this robot has it.
    pub at: fn(&mut RobotValues) -> Option<&mut f32>,
}

macro_rules! knob {
    ($group:literal, $name:literal, $unit:literal, $least:literal..$most:literal, $decimals:literal, $tip:literal, $at:expr) => {
        Knob {
            group: $group,
            name: $name,
            unit: $unit,
            range: ($least, $most),
            decimals: $decimals,
            tip: $tip,
            at: $at,
        }
    };
}

macro_rules! walker {
    ($($field:ident).+) => {
        |values| match &mut values.kind.drive {
            Drive::Walker(walker) => Some(&mut walker.$($field).+),
            Drive::Differential(_) => None,
        }
    };
}

macro_rules! wheels {
    ($field:ident) => {
        |values| match &mut values.kind.drive {
            Drive::Differential(drive) => Some(&mut drive.$field),
            Drive::Walker(_) => None,
        }
    };
}

macro_rules! chin {
    ($field:ident) => {
        |values| values.kind.chin.as_mut().map(|chin| &mut chin.$field)
    };
}

macro_rules! eyes {
    ($part:ident.$field:ident) => {
        |values| match &mut values.sensing.eyes {
            Eyes::Real { $part, .. } => Some(&mut $part.$field),
            Eyes::Perfect => None,
        }
    };
}

/// All values, group by group.
pub const KNOBS: [Knob; 30] = [
    knob!("Legs", "ahead", "m/s", 0.05..0.8, 2, "Fastest walk ahead", walker!(ahead)),
    knob!("Legs", "back", "m/s", 0.05..0.8, 2, "Fastest walk back", walker!(back)),
    knob!("Legs", "aside", "m/s", 0.05..0.8, 2, "Fastest step to either side", walker!(aside)),
    knob!("Legs", "turn", "°/s", 10.0..360.0, 0, "Fastest turn", walker!(turn)),
    knob!("Legs", "acceleration", "m/s²", 0.1..3.0, 2, "How fast the walk may change", walker!(acceleration)),
    knob!(
        "Legs",
        "slip",
        "",
        0.0..0.5,
        2,
        "Error of each step, as a share of its speed",
        walker!(noise.share)
    ),
    knob!("Legs", "drift", "m/s", 0.0..0.15, 3, "Error of each step in any direction", walker!(noise.drift)),
    knob!("Legs", "turn error", "°/s", 0.0..20.0, 1, "Error of each step's turn", walker!(noise.turn)),
    knob!("Wheels", "top speed", "m/s", 0.1..1.5, 2, "Fastest that a wheel goes", wheels!(max_speed)),
    knob!(
        "Wheels",
        "acceleration",
        "m/s²",
        0.2..5.0,
        2,
        "How fast a wheel's speed may change",
        wheels!(acceleration)
    ),
    knob!("Wheels", "turn", "°/s", 20.0..360.0, 0, "Fastest turn on the spot", wheels!(turn_rate)),
    knob!(
        "Wheels",
        "tolerance",
        "°",
        0.0..15.0,
        1,
        "Heading errors below this are left while it stands",
        wheels!(dead_band)
    ),
    knob!(
        "Chin",
        "success",
        "",
        0.0..1.0,
        2,
        "Chance that an attempt to catch the ball succeeds",
        chin!(success)
    ),
    knob!("Chin", "ball speed", "m/s", 0.05..1.0, 2, "Fastest ball that can be caught", chin!(speed)),
    knob!("Chin", "walk", "", 0.0..1.0, 2, "Share of its speed that is left with a ball", chin!(walk)),
    knob!(
        "Chin",
        "force",
        "N",
        0.1..10.0,
        1,
        "Most that the hold pulls before the ball slips out",
        chin!(force)
    ),
    knob!(
        "Camera",
        "range error",
        "1/m",
        0.0..0.2,
        3,
        "Error of a measured range, times the range squared",
        eyes!(camera.range_noise)
    ),
    knob!(
        "Camera",
        "angle error",
        "°",
        0.0..15.0,
        1,
        "Error of a measured angle",
        eyes!(camera.bearing_noise)
    ),
    knob!(
        "Camera",
        "detection",
        "",
        0.0..1.0,
        2,
        "Chance that a frame shows what is in full view and near",
        eyes!(camera.detection)
    ),
    knob!(
        "Camera",
        "phantoms",
        "",
        0.0..0.05,
        4,
        "Chance that a frame takes something else for the ball",
        eyes!(camera.false_positive)
    ),
    knob!("Camera", "latency", "s", 0.0..0.5, 2, "From the shutter to the percept", eyes!(camera.latency)),
    knob!("Camera", "ball range", "m", 0.5..8.0, 1, "Farthest ball that is seen", eyes!(camera.ball_range)),
    knob!(
        "Camera",
        "robot range",
        "m",
        0.5..8.0,
        1,
        "Farthest marker that is seen",
        eyes!(camera.robot_range)
    ),
    knob!(
        "Localisation",
        "place error",
        "m",
        0.0..1.0,
        2,
        "Error of each coordinate of its own place",
        eyes!(localisation.position)
    ),
    knob!(
        "Localisation",
        "heading error",
        "°",
        0.0..45.0,
        1,
        "Error of its own heading",
        eyes!(localisation.heading)
    ),
    knob!(
        "Localisation",
        "drift time",
        "s",
        0.5..60.0,
        1,
        "How long an error lasts",
        eyes!(localisation.drift_time)
    ),
    knob!("Odometry", "way error", "m", 0.0..0.5, 2, "Error after one metre", eyes!(odometry.distance)),
    knob!("Odometry", "turn error", "°", 0.0..20.0, 1, "Error after half a metre", eyes!(odometry.heading)),
    knob!("Memory", "ball", "s", 0.0..10.0, 1, "How long a ball is believed in that is not seen", |values| {
        Some(&mut values.sensing.memory.ball)
    }),
    knob!(
        "Memory",
        "robots",
        "s",
        0.0..10.0,
        1,
        "How long robots are believed in that are not seen",
        |values| Some(&mut values.sensing.memory.robots)
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AssetFolder;
    use crate::game::{Choice, MatchPlan};
    use crate::ids::Team;

    fn values(file: &str) -> RobotValues {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let choice = Choice { file: Some(file.into()), ..Choice::default() };
        let plan = MatchPlan::read(&assets, &choice).expect("the match is sound");
        let team = plan.team(Team::Home);
        RobotValues::of(&team.kind, &team.sensing)
    }

    #[test]
    fn every_value_is_within_its_slider_and_every_slider_stays_sound() {
        for file in ["friendly", "four_legged_2005"] {
            let own = values(file);
            for knob in KNOBS {
                let mut changed = own.clone();
                let Some(value) = (knob.at)(&mut changed) else { continue };
                assert!(
                    (knob.range.0..=knob.range.1).contains(value),
                    "{} {} is {value}",
                    knob.group,
                    knob.name
                );
                for end in [knob.range.0, knob.range.1] {
                    if let Some(value) = (knob.at)(&mut changed) {
                        *value = end;
                    }
                    let fault = changed.kind.fault().or(changed.sensing.fault());
                    assert_eq!(fault, None, "{} {} at {end}", knob.group, knob.name);
                }
            }
        }
    }

    #[test]
    fn a_robot_has_legs_or_wheels() {
        let groups = |file| {
            let mut own = values(file);
            let mut groups: Vec<_> =
                KNOBS.iter().filter(|knob| (knob.at)(&mut own).is_some()).map(|knob| knob.group).collect();
            groups.dedup();
            groups
        };
        let legs = groups("four_legged_2005");
        assert!(legs.contains(&"Legs") && legs.contains(&"Chin") && !legs.contains(&"Wheels"));
        let wheels = groups("friendly");
        assert!(wheels.contains(&"Wheels") && !wheels.contains(&"Legs") && !wheels.contains(&"Chin"));
    }

    #[test]
    fn no_two_values_share_group_and_name() {
        let mut names: Vec<_> = KNOBS.iter().map(|knob| (knob.group, knob.name)).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), KNOBS.len());
    }
}
