//! The choices that a rule book has between the middle-size league of 2001, always the default, and the four-legged league.
//!
//! No text of the rules of 2005 is at hand. Numbers are those of the league's rules of 2008, which follow them; what those
//! rules leave open says ASSUMPTION.

use serde::{Deserialize, Serialize};

/// How robots come to their places for a kick-off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum KickOffStyle {
    /// People put them there.
    #[default]
    Carried,
    /// They walk. The referee goes on as soon as all stand legally and still, or when their time is over; then people move
    /// those that stand wrongly. A half begins with all robots at the side lines of their own halves.
    Walked,
}

/// Who may be in the own penalty area.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum DefenderRule {
    /// One robot always, and a second one for [`RuleBook::second_defender_seconds`](super::RuleBook).
    #[default]
    Second,
    /// The goalkeeper, and nobody else for any time.
    KeeperOnly,
}

/// How long a robot may hold the ball. Goalkeepers that hold it too long are only put back to the half-way line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BallHolding {
    /// How long a field player may hold the ball.
    pub field_seconds: f32,
    /// Metres that the ball may be carried.
    pub field_distance: f32,
    /// For a goalkeeper in its own penalty area, which may carry the ball as far as it likes.
    pub keeper_seconds: f32,
}

impl Default for BallHolding {
    fn default() -> BallHolding {
        BallHolding { field_seconds: 3.0, field_distance: 0.5, keeper_seconds: 5.0 }
    }
}

/// How long a robot may push another one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pushing {
    /// How long a robot may push, s.
    pub seconds: f32,
    /// Whether pushing a team mate counts, too: the rules of 2008 speak of any other robot.
    pub team_mates: bool,
    /// What protects a goalkeeper in its own penalty area beyond that.
    pub goalie: Option<GoaliePushing>,
    /// Metres from the ball within which the robot of a team that is nearest to it may push.
    pub exempt_radius: f32,
}

impl Default for Pushing {
    fn default() -> Pushing {
        Pushing { seconds: 3.0, team_mates: true, goalie: Some(GoaliePushing::default()), exempt_radius: 0.5 }
    }
}

/// How long an attacker may be in contact with a goalkeeper that is in its own penalty area, as the four-legged league had it:
/// its text stands beside the rules of 2008 as a comment. A second attacker may not be at all.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GoaliePushing {
    /// Seconds of contact, also through the ball.
    pub seconds: f32,
}

impl Default for GoaliePushing {
    fn default() -> GoaliePushing {
        GoaliePushing { seconds: 1.0 }
    }
}

/// How long a robot may drive against an opponent that does not drive against it, in the middle-size league. The first time it
/// is warned, and then taken off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Charging {
    /// ASSUMPTION: no text of the laws of 2001 is at hand. Charging an opponent was a foul, and cards followed.
    pub seconds: f32,
}

impl Default for Charging {
    fn default() -> Charging {
        Charging { seconds: 2.0 }
    }
}

/// What happens at the lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Out {
    /// Walls keep the ball in.
    #[default]
    Walls,
    /// A ball that is out comes back at once, without a break in play.
    ThrowIn(ThrowIn),
}

/// Where a ball that was out comes back.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ThrowIn {
    /// Metres from where the ball crossed a side line, towards the goal of the team that touched it last.
    pub back: f32,
    /// Metres from the side line to the throw-in line within the field. ASSUMPTION.
    pub inside: f32,
    /// Metres from an end line to the end of the throw-in line.
    pub from_end: f32,
}

impl Default for ThrowIn {
    fn default() -> ThrowIn {
        ThrowIn { back: 1.0, inside: 0.4, from_end: 1.0 }
    }
}

/// What becomes of a ball that is stuck.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Stuck {
    /// It goes to a spot after [`RuleBook::no_progress_seconds`](super::RuleBook).
    #[default]
    Spots,
    /// The robot nearest to it goes to the half-way line, and there is a kick-off if nobody touches it.
    LocalGlobal(LocalGlobal),
}

/// How long a ball may be stuck among robots, and how long nobody may touch it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LocalGlobal {
    /// After this time in a small circle the ball is stuck.
    pub local_seconds: f32,
    /// After this time without a touch the ball is stuck.
    pub global_seconds: f32,
}

impl Default for LocalGlobal {
    fn default() -> LocalGlobal {
        LocalGlobal { local_seconds: 30.0, global_seconds: 30.0 }
    }
}

/// Where a removed robot returns, at a side line and facing the field; on the side farther from the ball if there is room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ReturnPlace {
    /// In its own half, as near to the half-way line as there is room.
    #[default]
    OwnHalf,
    /// On the half-way line, or as near to it as there is room, rather away from the ball.
    HalfWayLine,
}

#[cfg(test)]
mod tests {
    use crate::data::Validate;
    use crate::world::referee::rulebook::RuleBook;
    use crate::world::referee::rules::four_legged_book;

    use super::*;

    #[test]
    fn a_file_gives_the_four_legged_rules_and_its_defaults_are_those_of_2008() {
        let book = four_legged_book();
        assert_eq!(book.validate(), Ok(()));
        assert_eq!(book.kick_off, KickOffStyle::Walked);
        assert_eq!(book.ball_holding, Some(BallHolding::default()));
        assert_eq!(book.out, Out::ThrowIn(ThrowIn { back: 1.0, inside: 0.4, from_end: 1.0 }));
        assert_eq!(book.stuck, Stuck::LocalGlobal(LocalGlobal::default()));
        assert_eq!(book.mercy, Some(10));
    }

    #[test]
    fn an_unknown_field_is_refused_in_every_part() {
        for text in [
            "(pushing: (second: 1.0))",
            "(pushing: (goalie: (second: 1.0)))",
            "(charging: (minutes: 1.0))",
            "(out: ThrowIn(forth: 1.0))",
            "(stuck: LocalGlobal(local: 1.0))",
        ] {
            assert!(crate::world::referee::rules::read_book(text).is_err(), "{text}");
        }
    }

    #[test]
    fn every_bad_number_is_named_with_its_path() {
        type Spoil = fn(&mut RuleBook);
        let bad: [(&str, Spoil); 12] = [
            ("pushing.goalie.seconds", |book| {
                book.pushing.as_mut().unwrap().goalie.as_mut().unwrap().seconds = 0.0
            }),
            ("charging.seconds", |book| book.charging = Some(Charging { seconds: 0.0 })),
            ("ball_holding.field_seconds", |book| book.ball_holding.as_mut().unwrap().field_seconds = 0.0),
            ("ball_holding.field_distance", |book| book.ball_holding.as_mut().unwrap().field_distance = -1.0),
            ("ball_holding.keeper_seconds", |book| {
                book.ball_holding.as_mut().unwrap().keeper_seconds = f32::NAN
            }),
            ("pushing.seconds", |book| book.pushing.as_mut().unwrap().seconds = 0.0),
            ("pushing.exempt_radius", |book| book.pushing.as_mut().unwrap().exempt_radius = -0.1),
            ("leaving", |book| book.leaving = Some(f32::INFINITY)),
            ("mercy", |book| book.mercy = Some(0)),
            ("out.back", |book| book.out = Out::ThrowIn(ThrowIn { back: -1.0, ..ThrowIn::default() })),
            ("stuck.local_seconds", |book| {
                book.stuck = Stuck::LocalGlobal(LocalGlobal { local_seconds: 0.0, ..LocalGlobal::default() });
            }),
            ("stuck.global_seconds", |book| {
                book.stuck =
                    Stuck::LocalGlobal(LocalGlobal { global_seconds: 0.0, ..LocalGlobal::default() });
            }),
        ];
        for (path, spoil) in bad {
            let mut book = four_legged_book();
            spoil(&mut book);
            assert_eq!(book.validate().unwrap_err().field.to_string(), path);
        }
    }
}
