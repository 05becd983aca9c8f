//! What the referee has decided, as plain data, and the sentence that a spectator reads about it.
//!
//! A decision changes nothing by itself: whoever owns the bodies puts ball and robots where it says. Sentences call the
//! west left and the north upper, as on a screen with east to the right.

use std::fmt;

use bevy::prelude::Vec2;

use super::state::Phase;
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};

/// Why the referee puts the ball somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlacementReason {
    KickOff,
    NoProgress,
}

/// Why the referee takes a robot off the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RemovalReason {
    /// It stayed too long in its own penalty area together with a teammate.
    SecondDefender,
}

/// One decision, in the order in which the referee makes them. Places are in the pitch frame, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decision {
    /// A goal and the score that it makes, by [`Team::index`].
    Goal {
        by: Team,
        score: [u32; 2],
    },
    /// The ball lies still at this point.
    BallPlaced {
        at: Vec2,
        reason: PlacementReason,
    },
    /// All robots on the field are put on their kick-off positions by hand, as people did in 2001.
    RobotsPlaced {
        kick_off: Team,
    },
    /// The robot is off the field until it returns.
    RobotRemoved {
        robot: RobotId,
        reason: RemovalReason,
    },
    /// The robot is back on the field, at rest.
    RobotReturned {
        robot: RobotId,
        at: Pose,
    },
    PhaseChanged(Phase),
    HalfEnded {
        half: u8,
    },
    /// The last half is over, with this score by [`Team::index`].
    MatchFinished {
        score: [u32; 2],
    },
}

impl fmt::Display for Decision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Decision::Goal { by, score: [home, away] } => write!(f, "Goal for {by}, {home}:{away}"),
            Decision::BallPlaced { at, reason: PlacementReason::KickOff } => {
                write!(f, "Kick-off: ball to {}", Spot(*at))
            }
            Decision::BallPlaced { at, reason: PlacementReason::NoProgress } => {
                write!(f, "No progress: ball to {}", Spot(*at))
            }
            Decision::RobotsPlaced { kick_off } => {
                write!(f, "Kick-off for {kick_off}: robots to their places")
            }
            Decision::RobotRemoved { robot, reason: RemovalReason::SecondDefender } => {
                write!(f, "{} must leave: second defender", Shirt(*robot))
            }
            Decision::RobotReturned { robot, .. } => write!(f, "{} returns", Shirt(*robot)),
            Decision::PhaseChanged(phase) => f.write_str(match phase {
                Phase::Initial => "A kick-off is due",
                Phase::Ready => "Ready: robots take their places",
                Phase::Set => "Set: robots stand still",
                Phase::Playing => "Play",
                Phase::Finished => "The match is over",
            }),
            Decision::HalfEnded { half: 1 } => f.write_str("Half time"),
            Decision::HalfEnded { .. } => f.write_str("Full time"),
            Decision::MatchFinished { score: [home, away] } => {
                write!(f, "Final score: home {home}, away {away}")
            }
        }
    }
}

/// A robot at the beginning of a sentence.
struct Shirt(RobotId);

impl fmt::Display for Shirt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let team = match self.0.team {
            Team::Home => "Home",
            Team::Away => "Away",
        };
        write!(f, "{team} {}", self.0.number)
    }
}

/// A point of the field, named by its half and row.
struct Spot(Vec2);

/// Metres from an axis of the pitch within which a spot counts as on it.
const ON_AXIS: f32 = 0.2;

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let row = match self.0.y {
            y if y > ON_AXIS => "upper",
            y if y < -ON_AXIS => "lower",
            _ => "middle",
        };
        match self.0.x {
            x if x > ON_AXIS => write!(f, "the {row} spot in the right half"),
            x if x < -ON_AXIS => write!(f, "the {row} spot in the left half"),
            _ if row == "middle" => f.write_str("the centre spot"),
            _ => write!(f, "the {row} spot on the half-way line"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectator_can_read_every_decision() {
        let robot = RobotId::new(Team::Away, 2);
        let stuck = |x, y| Decision::BallPlaced { at: Vec2::new(x, y), reason: PlacementReason::NoProgress };
        let said = [
            (Decision::Goal { by: Team::Home, score: [2, 1] }, "Goal for home, 2:1"),
            (stuck(-2.5, 1.25), "No progress: ball to the upper spot in the left half"),
            (stuck(2.5, 0.0), "No progress: ball to the middle spot in the right half"),
            (stuck(0.0, -1.25), "No progress: ball to the lower spot on the half-way line"),
            (
                Decision::BallPlaced { at: Vec2::ZERO, reason: PlacementReason::KickOff },
                "Kick-off: ball to the centre spot",
            ),
            (Decision::RobotsPlaced { kick_off: Team::Away }, "Kick-off for away: robots to their places"),
            (
                Decision::RobotRemoved { robot, reason: RemovalReason::SecondDefender },
                "Away 2 must leave: second defender",
            ),
            (Decision::RobotReturned { robot, at: Pose::default() }, "Away 2 returns"),
            (Decision::PhaseChanged(Phase::Set), "Set: robots stand still"),
            (Decision::HalfEnded { half: 1 }, "Half time"),
            (Decision::HalfEnded { half: 2 }, "Full time"),
            (Decision::MatchFinished { score: [0, 3] }, "Final score: home 0, away 3"),
        ];
        for (decision, sentence) in said {
            assert_eq!(decision.to_string(), sentence);
        }
    }
}
