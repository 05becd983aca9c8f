//! The numbers of a middle-size match as of 2001, as data.
//!
//! Only the ten seconds of the second defender and the nearest spot for a stuck ball come from a paper (Hammerheads);
//! values that nothing at hand confirms say ASSUMPTION. What the numbers do is in [`super::rules`].

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};

/// How long and how far things may go in a match. A field that a file leaves out has its default.
#[derive(Resource, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RuleBook {
    /// Playing time of one half in minutes. ASSUMPTION: ten, from memory of those years.
    pub half_minutes: f32,
    /// Seconds from the placing of the robots to the order to stand still. ASSUMPTION: people needed far longer.
    pub ready_seconds: f32,
    /// Seconds of standing still before play begins. ASSUMPTION.
    pub set_seconds: f32,
    /// Seconds after which a ball without progress is moved to a spot. ASSUMPTION: ten, from memory.
    pub no_progress_seconds: f32,
    /// Metres between the ball and the place where it was when its clock started that count as progress. ASSUMPTION.
    pub no_progress_distance: f32,
    /// Seconds that a second robot may stay in its own penalty area (Hammerheads, ten).
    pub second_defender_seconds: f32,
    /// Seconds of playing time that a removed robot stays away. ASSUMPTION: thirty, as the four-legged league had it.
    pub removal_seconds: f32,
    /// Metres from a spot to the centre of a robot below which the spot is taken; also the room kept between a
    /// returning robot and the wall. ASSUMPTION: half a robot of the largest size and a ball's radius.
    pub spot_clearance: f32,
}

impl Default for RuleBook {
    fn default() -> RuleBook {
        RuleBook {
            half_minutes: 10.0,
            ready_seconds: 3.0,
            set_seconds: 1.0,
            no_progress_seconds: 10.0,
            no_progress_distance: 0.5,
            second_defender_seconds: 10.0,
            removal_seconds: 30.0,
            spot_clearance: 0.35,
        }
    }
}

impl RuleBook {
    /// Halves of a match.
    pub const HALVES: u8 = 2;

    /// Playing time of one half in seconds.
    pub fn half_seconds(&self) -> f64 {
        f64::from(self.half_minutes) * 60.0
    }

    /// What is wrong with the numbers, as the field's name and a reason; `None` for a sound book.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        let positive = [
            ("half_minutes", self.half_minutes, "minutes"),
            ("no_progress_seconds", self.no_progress_seconds, "seconds"),
            ("no_progress_distance", self.no_progress_distance, "metres"),
            ("second_defender_seconds", self.second_defender_seconds, "seconds"),
            ("spot_clearance", self.spot_clearance, "metres"),
        ];
        for (field, value, unit) in positive {
            if !(value.is_finite() && value > 0.0) {
                return Some((field, format!("must be a positive number of {unit}, not {value}")));
            }
        }
        let waits = [
            ("ready_seconds", self.ready_seconds),
            ("set_seconds", self.set_seconds),
            ("removal_seconds", self.removal_seconds),
        ];
        let bad = waits.into_iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0));
        bad.map(|(field, value)| (field, format!("must be zero or more seconds, not {value}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_book_is_sound_and_a_half_has_six_hundred_seconds() {
        assert_eq!(RuleBook::default().fault(), None);
        assert_eq!(RuleBook::default().half_seconds(), 600.0);
    }

    #[test]
    fn a_bad_number_is_named_with_its_field() {
        let endless = RuleBook { half_minutes: f32::INFINITY, ..RuleBook::default() };
        assert_eq!(endless.fault().unwrap().0, "half_minutes");
        let still = RuleBook { no_progress_distance: 0.0, ..RuleBook::default() };
        let (field, reason) = still.fault().unwrap();
        assert_eq!(field, "no_progress_distance");
        assert!(reason.contains("positive number of metres"), "{reason}");
        let backwards = RuleBook { set_seconds: -1.0, ..RuleBook::default() };
        assert_eq!(backwards.fault().unwrap().0, "set_seconds");
    }

    #[test]
    fn waits_may_be_zero() {
        let hasty =
            RuleBook { ready_seconds: 0.0, set_seconds: 0.0, removal_seconds: 0.0, ..RuleBook::default() };
        assert_eq!(hasty.fault(), None);
    }
}
