//! The numbers of a match, as data: by default those of the middle-size league as of 2001, where robots are put on their
//! places by hand and walls keep the ball in, and, where a file asks for them, those of the four-legged league.
//!
//! Only the ten seconds of the second defender and the nearest spot for a stuck ball come from a paper (Hammerheads);
//! values that nothing at hand confirms say ASSUMPTION. What the numbers do is in [`super::rules`].

mod four_legged;

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all, check_count};

pub use four_legged::{
    BallHolding, Charging, DefenderRule, GoaliePushing, KickOffStyle, LocalGlobal, Out, Pushing, ReturnPlace,
    Stuck, ThrowIn,
};

/// How long and how far things may go in a match. A field that a file leaves out has its default.
#[derive(Resource, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RuleBook {
    /// Playing time of one half in minutes. ASSUMPTION: ten, from memory of those years.
    pub half_minutes: f32,
    /// How robots come to their places for a kick-off.
    pub kick_off: KickOffStyle,
    /// Seconds from the placing of the robots to the order to stand still, or that they have at most to walk to their
    /// places. ASSUMPTION: people needed far longer. Robots that walk have thirty (after the league's rules of 2008).
    pub ready_seconds: f32,
    /// Seconds of standing still before play begins. ASSUMPTION.
    pub set_seconds: f32,
    /// Whether a team may score with the shot of its kick-off. If not, one of its robots has to touch the ball after the
    /// whole ball has left the centre circle (after the league's rules of 2008).
    pub goal_from_kick_off: bool,
    /// The lead in goals that ends the match, ten in the four-legged league (after its rules of 2008).
    pub mercy: Option<u32>,
    /// What happens at the lines.
    pub out: Out,
    /// What becomes of a ball that is stuck.
    pub stuck: Stuck,
    /// Seconds after which a ball without progress is moved to a spot. ASSUMPTION: ten, from memory.
    pub no_progress_seconds: f32,
    /// Metres between the ball and the place where it was when its clock started that count as progress. ASSUMPTION.
    pub no_progress_distance: f32,
    /// Who may be in the own penalty area.
    pub defenders: DefenderRule,
    /// Seconds that a second robot may stay in its own penalty area (Hammerheads, ten).
    pub second_defender_seconds: f32,
    /// How long a robot may hold the ball.
    pub ball_holding: Option<BallHolding>,
    /// How long a robot may push another one.
    pub pushing: Option<Pushing>,
    /// How long a robot may drive against an opponent that does not drive against it.
    pub charging: Option<Charging>,
    /// Metres that the centre of a robot may be beyond the lines; none where walls keep robots in. ASSUMPTION: 0.3 in the
    /// four-legged league, whose rules of 2008 speak of the carpet, up to 0.4 beyond the lines, and of the whole robot.
    pub leaving: Option<f32>,
    /// Seconds of playing time that a removed robot stays away. ASSUMPTION: thirty, as the four-legged league had it.
    pub removal_seconds: f32,
    /// Whether a removed robot stays away over a kick-off. If not, it may take part (after the four-legged league's rules
    /// of 2008).
    pub removal_outlasts_play: bool,
    /// Where a removed robot returns.
    pub returns: ReturnPlace,
    /// Metres between the centre of a robot and the place at which the ball is put down; also the room kept between a
    /// returning robot and the wall. ASSUMPTION: half a robot of the largest size and a ball's radius.
    pub spot_clearance: f32,
}

impl Default for RuleBook {
    fn default() -> RuleBook {
        RuleBook {
            half_minutes: 10.0,
            kick_off: KickOffStyle::Carried,
            ready_seconds: 3.0,
            set_seconds: 1.0,
            goal_from_kick_off: true,
            mercy: None,
            out: Out::Walls,
            stuck: Stuck::Spots,
            no_progress_seconds: 10.0,
            no_progress_distance: 0.5,
            defenders: DefenderRule::Second,
            second_defender_seconds: 10.0,
            ball_holding: None,
            pushing: None,
            charging: None,
            leaving: None,
            removal_seconds: 30.0,
            removal_outlasts_play: true,
            returns: ReturnPlace::OwnHalf,
            spot_clearance: 0.35,
        }
    }
}

impl RuleBook {
    /// Halves of a match.
    pub const HALVES: u8 = 2;

    /// The number of the robot that keeps the goal, where rules name one.
    pub const KEEPER: u8 = 0;

    /// Playing time of one half in seconds.
    pub fn half_seconds(&self) -> f64 {
        f64::from(self.half_minutes) * 60.0
    }

    /// Whether a rule asks who touches what.
    pub fn watches_contacts(&self) -> bool {
        self.kick_off == KickOffStyle::Walked
            || self.out != Out::Walls
            || self.stuck != Stuck::Spots
            || self.defenders != DefenderRule::Second
            || self.ball_holding.is_some()
            || self.pushing.is_some()
            || self.charging.is_some()
            || !self.goal_from_kick_off
    }
}

impl Validate for RuleBook {
    fn validate(&self) -> Result<(), Fault> {
        let (seconds, metres) = (Bound::SECONDS, Bound::LENGTH);
        let mut numbers = vec![
            ("half_minutes", self.half_minutes, Bound::MINUTES.positive()),
            ("ready_seconds", self.ready_seconds, seconds),
            ("set_seconds", self.set_seconds, seconds),
            ("no_progress_seconds", self.no_progress_seconds, seconds.positive()),
            ("no_progress_distance", self.no_progress_distance, metres.positive()),
            ("second_defender_seconds", self.second_defender_seconds, seconds.positive()),
            ("removal_seconds", self.removal_seconds, seconds),
            ("spot_clearance", self.spot_clearance, metres.positive()),
        ];
        if let Some(holding) = &self.ball_holding {
            numbers.extend([
                ("ball_holding.field_seconds", holding.field_seconds, seconds.positive()),
                ("ball_holding.field_distance", holding.field_distance, metres.positive()),
                ("ball_holding.keeper_seconds", holding.keeper_seconds, seconds.positive()),
            ]);
        }
        if let Some(pushing) = &self.pushing {
            numbers.extend([
                ("pushing.seconds", pushing.seconds, seconds.positive()),
                ("pushing.exempt_radius", pushing.exempt_radius, metres),
            ]);
            let of_goalie =
                |goalie: GoaliePushing| ("pushing.goalie.seconds", goalie.seconds, seconds.positive());
            numbers.extend(pushing.goalie.map(of_goalie));
        }
        if let Out::ThrowIn(throw_in) = &self.out {
            numbers.extend([
                ("out.back", throw_in.back, metres),
                ("out.inside", throw_in.inside, metres),
                ("out.from_end", throw_in.from_end, metres),
            ]);
        }
        if let Stuck::LocalGlobal(stuck) = &self.stuck {
            numbers.extend([
                ("stuck.local_seconds", stuck.local_seconds, seconds.positive()),
                ("stuck.global_seconds", stuck.global_seconds, seconds.positive()),
            ]);
        }
        let of_charging = |charging: Charging| ("charging.seconds", charging.seconds, seconds.positive());
        numbers.extend(self.charging.map(of_charging));
        numbers.extend(self.leaving.map(|beyond| ("leaving", beyond, metres)));
        check_all(numbers)?;
        let check = |lead| check_count("mercy", "the lead", lead as usize, 1..=MOST_GOALS);
        self.mercy.map_or(Ok(()), check)
    }
}

/// Goals of a lead.
const MOST_GOALS: usize = 1_000_000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_book_is_sound_and_a_half_has_six_hundred_seconds() {
        assert_eq!(RuleBook::default().validate(), Ok(()));
        assert_eq!(RuleBook::default().half_seconds(), 600.0);
    }

    #[test]
    fn a_bad_number_is_named_with_its_field() {
        let endless = RuleBook { half_minutes: f32::INFINITY, ..RuleBook::default() };
        assert_eq!(endless.validate().unwrap_err().field.to_string(), "half_minutes");
        let a_week = RuleBook { half_minutes: 10_080.0, ..RuleBook::default() };
        assert_eq!(a_week.validate().unwrap_err().message, "must be at most 1440 min, not 10080");
        let still = RuleBook { no_progress_distance: 0.0, ..RuleBook::default() };
        let fault = Fault::new("no_progress_distance", "must be at least 0.001 m, not 0");
        assert_eq!(still.validate(), Err(fault));
        let backwards = RuleBook { set_seconds: -1.0, ..RuleBook::default() };
        assert_eq!(backwards.validate().unwrap_err().field.to_string(), "set_seconds");
    }

    #[test]
    fn waits_may_be_zero() {
        let hasty =
            RuleBook { ready_seconds: 0.0, set_seconds: 0.0, removal_seconds: 0.0, ..RuleBook::default() };
        assert_eq!(hasty.validate(), Ok(()));
    }
}
