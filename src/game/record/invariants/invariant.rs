//! What must hold of every match, and for how long it may fail to.

use std::fmt::{self, Display, Formatter};

use serde::{Deserialize, Serialize};

use crate::strategy::teamwork::Teamwork;

/// Something that must hold of every match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Invariant {
    /// Positions and velocities are numbers.
    Finite,
    /// Ball and robots are on the pitch, in a goal or on the margin.
    InTheWorld,
    /// The ball is not inside a robot or a wall.
    BallIsSolid,
    /// A robot is not inside another one or a wall.
    RobotsAreSolid,
    /// A robot that is off receives nothing.
    OffIsDeaf,
    /// A lock is given back when its timer has run out (Hammerheads, section VII-A).
    LockIsGivenBack,
    /// The roles that a robot knows of are those of the kick-off, each once.
    RolesAreKept,
    /// No role is played by more robots than at the kick-off (Hammerheads, section VII).
    OneRobotARole,
    /// No role of the kick-off is played by nobody while the team is complete.
    NoRoleVacant,
    /// Nobody takes the ball for booked by a robot that is off or serves a penalty (TeamChaos, section 4, requirement 2).
    BookerPlays,
    /// One robot drives at a booked ball (TeamChaos, section 4, requirement 4).
    OneAtBookedBall,
    /// Somebody drives at a ball that somebody sees.
    SomebodyGoes,
    /// Only one robot stays in its own penalty area (Hammerheads, section III).
    OneDefender,
}

/// How often a match is looked at, s: whatever breaks an invariant lasts longer, or is counted.
pub(super) const EVERY: f32 = 0.1;

/// A ball that is seen is driven at so soon, and two robots stay in their own area no longer than this, s.
const PATIENCE: f32 = 10.0;
/// What is beyond a timer: a turn of the robot's loop, and messages under way, s.
const LATENESS: f32 = 1.0;
/// Springs of the physics may be pressed in for so long, s.
const SQUEEZE: f32 = 0.5;
/// Robots that press each other reach no deeper than this into each other or into walls, m.
pub(super) const ROBOT_TOLERANCE: f32 = 0.01;

impl Invariant {
    /// All of them.
    pub const ALL: [Invariant; 13] = [
        Invariant::Finite,
        Invariant::InTheWorld,
        Invariant::BallIsSolid,
        Invariant::RobotsAreSolid,
        Invariant::OffIsDeaf,
        Invariant::LockIsGivenBack,
        Invariant::RolesAreKept,
        Invariant::OneRobotARole,
        Invariant::NoRoleVacant,
        Invariant::BookerPlays,
        Invariant::OneAtBookedBall,
        Invariant::SomebodyGoes,
        Invariant::OneDefender,
    ];

    /// Whether it holds whatever the radio does and the robots suffer. The others need messages that arrive now and then and robots
    /// that can drive, so that a bad radio breaks them.
    pub fn is_safety(self) -> bool {
        matches!(
            self,
            Invariant::Finite
                | Invariant::InTheWorld
                | Invariant::OffIsDeaf
                | Invariant::LockIsGivenBack
                | Invariant::RolesAreKept
        )
    }

    /// How many robots it must be about from the first moment on to be one failing and not one after another.
    pub(super) fn same_robots(self) -> usize {
        match self {
            Invariant::OneRobotARole | Invariant::OneAtBookedBall | Invariant::OneDefender => 2,
            Invariant::LockIsGivenBack | Invariant::BookerPlays | Invariant::RobotsAreSolid => 1,
            _ => 0,
        }
    }

    /// For how long it may fail to hold before it counts as broken, s.
    pub fn bound(self, teamwork: &Teamwork) -> f32 {
        let timers = teamwork.role_swap.as_ref().map(|spec| spec.timers);
        let swap = timers.map_or(0.0, |timers| timers.lock + timers.locks + timers.acks + timers.back_off.1);
        let booking = teamwork.ball_booking.as_ref().map_or(0.0, |spec| spec.timeout + spec.renewal);
        match self {
            Invariant::Finite | Invariant::InTheWorld | Invariant::OffIsDeaf | Invariant::RolesAreKept => 0.0,
            Invariant::BallIsSolid | Invariant::RobotsAreSolid => SQUEEZE,
            Invariant::LockIsGivenBack => LATENESS,
            Invariant::OneRobotARole | Invariant::NoRoleVacant => swap + LATENESS,
            Invariant::BookerPlays | Invariant::OneAtBookedBall => booking + LATENESS,
            Invariant::SomebodyGoes | Invariant::OneDefender => PATIENCE,
        }
    }
}

impl Display for Invariant {
    /// What is wrong if it is broken.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Invariant::Finite => "something is not a number",
            Invariant::InTheWorld => "something is outside the world",
            Invariant::BallIsSolid => "the ball is inside something",
            Invariant::RobotsAreSolid => "a robot is inside something",
            Invariant::OffIsDeaf => "a robot that is off received a message",
            Invariant::LockIsGivenBack => "a lock is held beyond its timer",
            Invariant::RolesAreKept => "a robot knows of other roles than those of the kick-off",
            Invariant::OneRobotARole => "a role is doubled",
            Invariant::NoRoleVacant => "a role is vacant",
            Invariant::BookerPlays => "the ball is booked by a robot that does not play",
            Invariant::OneAtBookedBall => "several robots drive at a booked ball",
            Invariant::SomebodyGoes => "nobody drives at a ball that is seen",
            Invariant::OneDefender => "several robots stay in their own penalty area",
        })
    }
}
