//! What the referee has decided, as plain data, and the sentence that a spectator reads about it.
//!
//! A decision changes nothing by itself: the owner of the bodies puts ball and robots where it says. Sentences call the
//! west left and the north upper, as on a screen with east to the right.

use std::fmt;

use bevy::prelude::Vec2;
use serde::Serialize;

use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::world::referee::phase::Phase;

/// Why the referee puts the ball somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum PlacementReason {
    /// For a kick-off.
    KickOff,
    /// The ball was stuck.
    NoProgress,
    /// For a set play that is not a kick-off.
    SetPlay,
    /// Where it was at a foul.
    Foul,
    /// The ball was out, by the team that touched it last, if that is known.
    ThrowIn { against: Option<Team> },
}

/// Why the referee takes a robot off the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RemovalReason {
    /// It stayed too long in its own penalty area together with a teammate.
    SecondDefender,
    /// It was in its own penalty area without being the goalkeeper.
    IllegalDefender,
    /// It held the ball too long or carried it too far.
    BallHolding,
    /// It pushed another robot too long.
    Pushing,
    /// It was in contact with a goalkeeper in its area too long, or as the second attacker.
    GoaliePushing,
    /// It drove against an opponent, after a warning.
    Charging,
    /// It left the field by itself.
    LeftTheField,
    /// It was nearest to a ball that was stuck among robots, and goes to the half-way line.
    LocalStuck,
    /// A referee's program outside of the simulation took it off.
    RefereeBox,
    /// People or a scenario wanted it so.
    Ordered,
}

/// Why a ball in the goal does not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoGoalReason {
    /// It was shot at the kick-off, and no robot of the team touched it outside the centre circle.
    KickOffShot,
    /// A robot of the team carried it in.
    Held,
    /// A robot of the team pushed the goalkeeper meanwhile.
    GoaliePushed,
}

/// One decision, in the order in which the referee makes them. Places are in the pitch frame, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Decision {
    /// A goal and the score that it makes, by [`Team::index`].
    Goal { by: Team, score: [u32; 2] },
    /// The ball is in the goal that this team attacks, and it does not count.
    NoGoal { by: Team, reason: NoGoalReason },
    /// Nobody has touched the ball for too long, and this team kicks off.
    Untouched { kick_off: Team },
    /// The ball lies still at this point.
    BallPlaced { at: Vec2, reason: PlacementReason },
    /// All robots on the field are put on their kick-off positions by hand, as people did in 2001.
    RobotsPlaced {
        /// Nobody at a dropped ball.
        kick_off: Option<Team>,
    },
    /// One robot is put somewhere by hand, at rest: before it walks to its place, or since it stood wrongly for a kick-off.
    RobotPlaced { robot: RobotId, at: Pose },
    /// The robot has committed a foul, and leaves for another one.
    RobotWarned { robot: RobotId },
    /// The robot is off the field until it returns.
    RobotRemoved { robot: RobotId, reason: RemovalReason },
    /// The robot is back on the field, at rest.
    RobotReturned { robot: RobotId, at: Pose },
    /// Another phase begins.
    PhaseChanged(Phase),
    /// A half is over.
    HalfEnded { half: u8 },
    /// The last half is over, with this score by [`Team::index`].
    MatchFinished { score: [u32; 2] },
}

impl Decision {
    /// Whether it ends a time in which play came to nothing: a ball that was stuck, or that nobody touched.
    pub fn ends_no_progress(&self) -> bool {
        matches!(
            self,
            Decision::Untouched { .. } | Decision::BallPlaced { reason: PlacementReason::NoProgress, .. }
        )
    }
}

impl fmt::Display for Decision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Decision::Goal { by, score: [home, away] } => write!(f, "Goal for {by}, {home}:{away}"),
            Decision::NoGoal { by, reason } => {
                let reason = match reason {
                    NoGoalReason::KickOffShot => "shot at the kick-off",
                    NoGoalReason::Held => "the ball was held",
                    NoGoalReason::GoaliePushed => "the goalkeeper was pushed",
                };
                write!(f, "No goal for {by}: {reason}")
            }
            Decision::Untouched { kick_off } => write!(f, "Nobody touches the ball: kick-off for {kick_off}"),
            Decision::BallPlaced { at, reason: PlacementReason::KickOff } => {
                write!(f, "Kick-off: ball to {}", Spot(*at))
            }
            Decision::BallPlaced { at, reason: PlacementReason::NoProgress } => {
                write!(f, "No progress: ball to {}", Spot(*at))
            }
            Decision::BallPlaced { at, reason: PlacementReason::SetPlay } => {
                write!(f, "Set play: ball to {}", Spot(*at))
            }
            Decision::BallPlaced { reason: PlacementReason::Foul, .. } => {
                f.write_str("Foul: ball back to where it was")
            }
            Decision::BallPlaced { at, reason: PlacementReason::ThrowIn { against: Some(team) } } => {
                write!(f, "Out by {team}: ball to {}", SideName(*at))
            }
            Decision::BallPlaced { at, reason: PlacementReason::ThrowIn { against: None } } => {
                write!(f, "Out: ball to {}", SideName(*at))
            }
            Decision::RobotsPlaced { kick_off: Some(kick_off) } => {
                write!(f, "Kick-off for {kick_off}: robots to their places")
            }
            Decision::RobotsPlaced { kick_off: None } => f.write_str("Dropped ball: robots to their places"),
            Decision::RobotPlaced { robot, .. } => write!(f, "{} is put on its place", Shirt(*robot)),
            Decision::RobotWarned { robot } => write!(f, "{} is warned: charging", Shirt(*robot)),
            Decision::RobotRemoved { robot, reason } => {
                let reason = match reason {
                    RemovalReason::SecondDefender => "second defender",
                    RemovalReason::IllegalDefender => "illegal defender",
                    RemovalReason::BallHolding => "ball holding",
                    RemovalReason::Pushing => "pushing",
                    RemovalReason::GoaliePushing => "goalkeeper pushing",
                    RemovalReason::Charging => "charging",
                    RemovalReason::LeftTheField => "it left the field",
                    RemovalReason::LocalStuck => "the ball is stuck",
                    RemovalReason::RefereeBox => "the referee box took it off",
                    RemovalReason::Ordered => "it was taken off by hand",
                };
                write!(f, "{} must leave: {reason}", Shirt(*robot))
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

/// A point near a side line, named by its half and side.
struct SideName(Vec2);

impl fmt::Display for SideName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = if self.0.y > 0.0 { "upper" } else { "lower" };
        match self.0.x {
            x if x > ON_AXIS => write!(f, "the {side} side in the right half"),
            x if x < -ON_AXIS => write!(f, "the {side} side in the left half"),
            _ => write!(f, "the {side} side on the half-way line"),
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
        let out = |x, y, against| {
            let reason = PlacementReason::ThrowIn { against };
            Decision::BallPlaced { at: Vec2::new(x, y), reason }
        };
        let off = |reason| Decision::RobotRemoved { robot, reason };
        let said = [
            (out(-1.0, 1.6, Some(Team::Away)), "Out by away: ball to the upper side in the left half"),
            (out(1.7, -1.1, None), "Out: ball to the lower side in the right half"),
            (out(0.0, 1.6, Some(Team::Home)), "Out by home: ball to the upper side on the half-way line"),
            (
                Decision::NoGoal { by: Team::Home, reason: NoGoalReason::KickOffShot },
                "No goal for home: shot at the kick-off",
            ),
            (
                Decision::NoGoal { by: Team::Away, reason: NoGoalReason::Held },
                "No goal for away: the ball was held",
            ),
            (Decision::Untouched { kick_off: Team::Home }, "Nobody touches the ball: kick-off for home"),
            (Decision::RobotPlaced { robot, at: Pose::default() }, "Away 2 is put on its place"),
            (off(RemovalReason::IllegalDefender), "Away 2 must leave: illegal defender"),
            (off(RemovalReason::BallHolding), "Away 2 must leave: ball holding"),
            (off(RemovalReason::Pushing), "Away 2 must leave: pushing"),
            (off(RemovalReason::GoaliePushing), "Away 2 must leave: goalkeeper pushing"),
            (off(RemovalReason::Charging), "Away 2 must leave: charging"),
            (Decision::RobotWarned { robot }, "Away 2 is warned: charging"),
            (
                Decision::NoGoal { by: Team::Home, reason: NoGoalReason::GoaliePushed },
                "No goal for home: the goalkeeper was pushed",
            ),
            (
                Decision::BallPlaced { at: Vec2::X, reason: PlacementReason::Foul },
                "Foul: ball back to where it was",
            ),
            (off(RemovalReason::LeftTheField), "Away 2 must leave: it left the field"),
            (off(RemovalReason::LocalStuck), "Away 2 must leave: the ball is stuck"),
            (off(RemovalReason::RefereeBox), "Away 2 must leave: the referee box took it off"),
            (Decision::Goal { by: Team::Home, score: [2, 1] }, "Goal for home, 2:1"),
            (stuck(-2.5, 1.25), "No progress: ball to the upper spot in the left half"),
            (stuck(2.5, 0.0), "No progress: ball to the middle spot in the right half"),
            (stuck(0.0, -1.25), "No progress: ball to the lower spot on the half-way line"),
            (
                Decision::BallPlaced { at: Vec2::ZERO, reason: PlacementReason::KickOff },
                "Kick-off: ball to the centre spot",
            ),
            (
                Decision::RobotsPlaced { kick_off: Some(Team::Away) },
                "Kick-off for away: robots to their places",
            ),
            (Decision::RobotsPlaced { kick_off: None }, "Dropped ball: robots to their places"),
            (off(RemovalReason::SecondDefender), "Away 2 must leave: second defender"),
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
