//! What of a robot can be calibrated while it plays, and within which bounds. Pure.

use std::sync::Arc;

use crate::game::requests::Calibration;
use crate::robot::{
    Camera, Chin, DifferentialDrive, Drive, Eyes, Landmarks, Localisation, MemorySpans, OdometryNoise,
    RobotKind, Sensing, Walker,
};

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

macro_rules! knobs {
    ($($group:literal $part:ident {
        $($name:literal $least:literal..$most:literal $decimals:literal $unit:literal $($field:ident).+, $tip:literal;)*
    })*) => {
        /// All values, group by group.
        pub const KNOBS: &[Knob] = &[$($(Knob {
            group: $group,
            name: $name,
            unit: $unit,
            range: ($least, $most),
            decimals: $decimals,
            tip: $tip,
            at: |values| $part(values).map(|part| &mut part.$($field).+),
        },)*)*];
    };
}

knobs! {
    "Legs" walker {
        "ahead"         0.05..0.8  2 "m/s"  ahead,          "Fastest walk ahead";
        "back"          0.05..0.8  2 "m/s"  back,           "Fastest walk back";
        "aside"         0.05..0.8  2 "m/s"  aside,          "Fastest step to either side";
        "turn"          10.0..360.0 0 "°/s" turn,           "Fastest turn";
        "acceleration"  0.1..3.0   2 "m/s²" acceleration,   "How fast the walk may change";
        "slip"          0.0..0.5   2 ""     noise.share,    "Error of each step, as a share of its speed";
        "drift"         0.0..0.15  3 "m/s"  noise.drift,    "Error of each step in any direction";
        "turn error"    0.0..20.0  1 "°/s"  noise.turn,     "Error of each step's turn";
    }
    "Wheels" wheels {
        "top speed"     0.1..1.5   2 "m/s"  max_speed,      "Fastest that a wheel goes";
        "acceleration"  0.2..5.0   2 "m/s²" acceleration,   "How fast a wheel's speed may change";
        "turn"          20.0..360.0 0 "°/s" turn_rate,      "Fastest turn on the spot";
        "tolerance"     0.0..15.0  1 "°"    dead_band,      "Heading errors below this are left while it stands";
    }
    "Chin" chin {
        "success"       0.0..1.0   2 ""     success,        "Chance that an attempt to catch the ball succeeds";
        "ball speed"    0.05..1.0  2 "m/s"  speed,          "Fastest ball that can be caught";
        "walk"          0.0..1.0   2 ""     walk,           "Share of its speed that is left with a ball";
        "force"         0.1..10.0  1 "N"    force,          "Most that the hold pulls before the ball slips out";
    }
    "Camera" camera {
        "range error"   0.0..0.2   3 "1/m"  range_noise,    "Error of a measured range, times the range squared";
        "angle error"   0.0..15.0  1 "°"    bearing_noise,  "Error of a measured angle";
        "detection"     0.0..1.0   2 ""     detection,      "Chance that a frame shows what is in full view and near";
        "phantoms"      0.0..0.05  4 ""     false_positive, "Chance that a frame takes something else for the ball";
        "wrong team"    0.0..1.0   3 ""     wrong_team,     "Chance to take a robot for one of the other team";
        "latency"       0.0..0.5   2 "s"    latency,        "From the shutter to the percept";
        "ball range"    0.5..12.0  1 "m"    ball_range,     "Farthest ball that is seen";
        "robot range"   0.5..12.0  1 "m"    robot_range,    "Farthest marker that is seen";
    }
    "Localisation" localisation {
        "place error"   0.0..1.0   2 "m"    position,       "Error of each coordinate of its own place";
        "heading error" 0.0..45.0  1 "°"    heading,        "Error of its own heading";
        "drift time"    0.5..60.0  1 "s"    drift_time,     "How long an error lasts";
    }
    "Landmarks" landmarks {
        "posts"         0.0..15.0  1 "m"    posts,          "Farthest goal post that is recognised";
        "beacons"       0.0..15.0  1 "m"    beacons,        "Farthest beacon that is recognised";
        "lines"         0.0..5.0   1 "m"    lines,          "Farthest line or wall that is recognised";
        "looks down"    0.0..1.0   2 "m"    looks_down,     "A ball nearer than this turns the camera down";
        "settle time"   0.1..20.0  1 "s"    settle,         "How long beliefs take to follow the fixes";
    }
    "Odometry" odometry {
        "way error"     0.0..0.5   2 "m"    distance,       "Error after one metre";
        "turn error"    0.0..20.0  1 "°"    heading,        "Error after half a metre";
    }
    "Memory" memory {
        "ball"          0.0..10.0  1 "s"    ball,           "How long a ball is believed in that is not seen";
        "robots"        0.0..10.0  1 "s"    robots,         "How long robots are believed in that are not seen";
    }
}

fn walker(values: &mut RobotValues) -> Option<&mut Walker> {
    match &mut values.kind.drive {
        Drive::Walker(walker) => Some(walker),
        Drive::Differential(_) => None,
    }
}

fn wheels(values: &mut RobotValues) -> Option<&mut DifferentialDrive> {
    match &mut values.kind.drive {
        Drive::Differential(drive) => Some(drive),
        Drive::Walker(_) => None,
    }
}

fn chin(values: &mut RobotValues) -> Option<&mut Chin> {
    values.kind.chin.as_mut()
}

fn camera(values: &mut RobotValues) -> Option<&mut Camera> {
    match &mut values.sensing.eyes {
        Eyes::Perfect => None,
        Eyes::Real { camera, .. } | Eyes::Images { camera, .. } => Some(camera),
    }
}

fn localisation(values: &mut RobotValues) -> Option<&mut Localisation> {
    match &mut values.sensing.eyes {
        Eyes::Real { localisation, .. } => Some(localisation),
        Eyes::Perfect | Eyes::Images { .. } => None,
    }
}

fn landmarks(values: &mut RobotValues) -> Option<&mut Landmarks> {
    localisation(values).and_then(|localisation| localisation.landmarks.as_mut())
}

fn odometry(values: &mut RobotValues) -> Option<&mut OdometryNoise> {
    match &mut values.sensing.eyes {
        Eyes::Perfect => None,
        Eyes::Real { odometry, .. } | Eyes::Images { odometry, .. } => Some(odometry),
    }
}

fn memory(values: &mut RobotValues) -> Option<&mut MemorySpans> {
    Some(&mut values.sensing.memory)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{AssetFolder, Validate};
    use crate::game::{Choice, MatchPlan};
    use crate::ids::Team;

    fn values(file: &str) -> RobotValues {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let choice = Choice { file: Some(file.into()), ..Choice::default() };
        let plan = MatchPlan::read(&assets, &choice).expect("the match is sound");
        let team = plan.team(Team::Home);
        RobotValues::of(&team.kind, &team.senses.sensing)
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
                    let checked = changed.kind.validate().and(changed.sensing.validate());
                    assert_eq!(checked, Ok(()), "{} {} at {end}", knob.group, knob.name);
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
