//! Bump sensing: the microcontroller of a drive compares how its wheels turn with what it tells them, and reports a blocked one
//! in one bit, late and sometimes wrongly. Pure but for the dice.
//!
//! The Hammerheads' paper (section III) has such a microcontroller and says no more of it; the bit is that of TeamBots' Cye.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all};
use crate::ids::RobotId;
use crate::rng::{Dice, Seed};

/// When a drive's microcontroller reports that it is blocked, and how it errs, as data.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BumpSensing {
    /// Wheels that are told to turn slower than this are not judged, m/s.
    pub told: f32,
    /// A wheel that turns at less than this share of what it is told is blocked. The drive is if all wheels are that are judged: while
    /// one still turns, the robot gets away.
    pub turned: f32,
    /// How long the drive must be blocked until it is reported, s.
    pub late: f32,
    /// Chance that a block goes unnoticed for this time, and for each such time again.
    pub missed: f32,
    /// Mean time between two reports of nothing, s.
    pub false_every: f32,
    /// Mean time that such a report lasts, s.
    pub false_lasts: f32,
}

/// The bump sensing of one robot; one without it never reports anything.
#[derive(Clone, Debug)]
pub struct BumpSensor {
    /// Whether it reports a blocked drive now.
    pub reports: bool,
    /// How long the drive has been blocked since the last chance to notice it, s.
    blocked_for: f32,
    /// Whether the present block has been noticed.
    is_noticed: bool,
    /// How much longer it reports a block that is none, s.
    mistaken_for: f32,
    pub(super) dice: Dice,
}

impl BumpSensor {
    /// A robot that has touched nothing.
    pub fn new(seed: Seed, robot: RobotId) -> BumpSensor {
        let dice = Dice::new(seed, "bump", Some(robot));
        BumpSensor { reports: false, blocked_for: 0.0, is_noticed: false, mistaken_for: 0.0, dice }
    }

    /// What the wheels were told and how they turned in the last `dt` seconds, each m/s.
    pub fn feel(&mut self, wheels: [(f32, f32); 2], sensing: &BumpSensing, dt: f32) {
        if sensing.is_blocked(wheels) {
            self.blocked_for += dt;
        } else {
            (self.blocked_for, self.is_noticed) = (0.0, false);
        }
        if !self.is_noticed && self.blocked_for > sensing.late {
            self.blocked_for -= sensing.late;
            self.is_noticed = !self.dice.chance(sensing.missed);
        }
        self.mistaken_for = (self.mistaken_for - dt).max(0.0);
        if self.dice.chance(dt / sensing.false_every) {
            self.mistaken_for = self.dice.exponential(sensing.false_lasts);
        }
        self.reports = self.is_noticed || self.mistaken_for > 0.0;
    }
}

impl BumpSensing {
    fn is_blocked(&self, wheels: [(f32, f32); 2]) -> bool {
        let judged = || wheels.into_iter().filter(|(told, _)| told.abs() > self.told);
        let stands = |(told, turned): (f32, f32)| turned * told.signum() < self.turned * told.abs();
        judged().count() > 0 && judged().all(stands)
    }
}

impl Validate for BumpSensing {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("told", self.told, Bound::SPEED),
            ("turned", self.turned, Bound::SHARE),
            ("late", self.late, Bound::DELAY),
            ("missed", self.missed, Bound::SHARE),
            ("false_every", self.false_every, Bound::SECONDS.positive()),
            ("false_lasts", self.false_lasts, Bound::DELAY),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    const EXACT: BumpSensing = BumpSensing {
        told: 0.1,
        turned: 0.25,
        late: 0.5,
        missed: 0.0,
        false_every: 86_400.0,
        false_lasts: 0.0,
    };
    /// Exact in binary.
    const DT: f32 = 1.0 / 64.0;
    const BLOCKED: [(f32, f32); 2] = [(0.4, 0.0), (0.4, 0.05)];
    const FREE: [(f32, f32); 2] = [(0.4, 0.0), (0.4, 0.35)];

    fn sensor(seed: u64) -> BumpSensor {
        BumpSensor::new(Seed(seed), RobotId::new(Team::Home, 0))
    }

    /// Ticks until the first report of a drive that is blocked from the beginning.
    fn ticks_until_noticed(sensing: &BumpSensing, seed: u64) -> Option<usize> {
        let mut sensor = sensor(seed);
        (1..10_000).find(|_| {
            sensor.feel(BLOCKED, sensing, DT);
            sensor.reports
        })
    }

    #[test]
    fn wheels_that_hardly_turn_are_reported_after_the_delay_and_until_one_turns() {
        let mut sensor = sensor(1);
        let mut reports = |wheels, ticks: usize| {
            (0..ticks).for_each(|_| sensor.feel(wheels, &EXACT, DT));
            sensor.reports
        };
        assert!(!reports(BLOCKED, 32), "half a second");
        assert!(reports(BLOCKED, 1) && reports(BLOCKED, 100));
        assert!(!reports(FREE, 1));
        assert!(!reports(BLOCKED, 32), "the delay begins again");
        assert!(reports(BLOCKED, 1));
    }

    #[test]
    fn a_wheel_is_judged_by_the_share_of_what_it_is_told_in_its_own_direction() {
        for (told, turned, is_blocked) in [
            (0.09, 0.0, false),
            (0.4, 0.09, true),
            (0.4, 0.11, false),
            (-0.4, -0.09, true),
            (-0.4, -0.11, false),
            (0.4, -0.3, true),
            (0.0, 0.0, false),
        ] {
            let wheels = [(told, turned), (0.05, 0.0)];
            assert_eq!(EXACT.is_blocked(wheels), is_blocked, "told {told}, turned {turned}");
        }
    }

    #[test]
    fn a_missed_block_is_noticed_in_a_later_delay() {
        let sensing = BumpSensing { missed: 0.25, ..EXACT };
        let n = 2000;
        let delays: Vec<usize> = (0..n).filter_map(|seed| ticks_until_noticed(&sensing, seed)).collect();
        assert_eq!(delays.len(), n as usize, "none is missed for ever");
        let late = delays.iter().filter(|ticks| **ticks > 33).count() as f32 / n as f32;
        // Four standard deviations of a share of 2000.
        assert!((late - 0.25).abs() < 0.039, "{late}");
        assert_eq!(ticks_until_noticed(&BumpSensing { missed: 1.0, ..EXACT }, 1), None);
    }

    #[test]
    fn false_reports_come_as_often_and_last_as_long_as_the_kind_says() {
        let sensing = BumpSensing { false_every: 10.0, false_lasts: 0.5, ..EXACT };
        let mut sensor = sensor(3);
        let (mut begun, mut ticks, mut before) = (0.0, 0.0, false);
        for _ in 0..640_000 {
            sensor.feel(FREE, &sensing, DT);
            begun += f32::from(u8::from(sensor.reports && !before));
            ticks += f32::from(u8::from(sensor.reports));
            before = sensor.reports;
        }
        // 1000 are expected in 10,000 s, a few of them within another one; four standard deviations and that.
        assert!((begun - 960.0_f32).abs() < 140.0, "{begun} reports");
        assert!((ticks * DT / begun - 0.5).abs() < 0.09, "{} s each", ticks * DT / begun);
    }
}
