//! What a scenario's script does to the robots, the ball and the radio, and the teamwork that a scenario may be about.

use bevy::prelude::Vec2;
use serde::{Deserialize, Serialize};

use crate::ids::{RobotId, Team};
use crate::robot::{KickIntent, Restart};
use crate::strategy::teamwork::Mechanism;

/// Something that happens at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimedEvent {
    /// s since the scenario began.
    pub at: f32,
    /// What happens.
    pub what: Event,
}

/// An intervention. Points and velocities are in the pitch frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Event {
    /// The robot stops dead: it neither moves nor thinks nor talks.
    Crash(RobotId),
    /// The wheels stop; the robot thinks and talks on.
    Freeze(RobotId),
    /// The robot receives nothing.
    Deaf(RobotId),
    /// Nothing that the robot sends leaves it.
    Mute(RobotId),
    /// The referee takes the robot off for the rest of the scenario.
    Penalise(RobotId),
    /// Ends a crash, a freeze, deafness and muteness.
    Revive { robot: RobotId, memory: Restart },
    /// The robot is out of radio range of all others.
    CutOff(RobotId),
    /// Ends [`Event::CutOff`].
    Reconnect(RobotId),
    /// No message crosses between the two groups.
    Partition(Vec<RobotId>, Vec<RobotId>),
    /// Ends all partitions.
    Heal,
    /// Whether the whole band is jammed.
    Jam(bool),
    /// The radio from now on, by its file's name.
    Radio(String),
    /// Puts the ball somewhere, perhaps in motion.
    Ball {
        at: Vec2,
        /// m/s
        #[serde(default)]
        velocity: Vec2,
    },
    /// Adds to the robot's velocity, m/s.
    Push { robot: RobotId, by: Vec2 },
    /// Puts the robot elsewhere without telling it.
    Kidnap {
        robot: RobotId,
        to: Vec2,
        /// Degrees, counter-clockwise from east.
        facing: f32,
    },
    /// The robot takes itself to be elsewhere from now on: its localisation errs by this much more, and it is not told.
    Mislead {
        robot: RobotId,
        /// m
        by: Vec2,
        /// Degrees, counter-clockwise.
        #[serde(default)]
        turn: f32,
    },
    /// Makes the robot start a role swap: who holds the first role of a pair takes the second.
    InitiateSwap { robot: RobotId, roles: Vec<(String, String)> },
    /// A person takes the robot over and lets the levers rest.
    TakeOver(RobotId),
    /// The person at the controls holds the levers so from now on, each a share of what the robot can do, -1 to 1; positive is ahead
    /// or to the left. Nothing, if nobody drives the robot.
    Steer {
        robot: RobotId,
        #[serde(default)]
        throttle: f32,
        #[serde(default)]
        aside: f32,
        #[serde(default)]
        turn: f32,
        #[serde(default)]
        kick: KickIntent,
    },
    /// The robot's strategy takes it back.
    HandBack(RobotId),
    /// The team plays on with another strategy, by its file's name, or with its own as if that had been read again.
    Strategy { team: Team, name: String },
}

impl Event {
    /// The same for the teams on each other's sides: what happens to a robot of home happens to that of away, at the place that
    /// is opposite through the centre.
    #[must_use]
    pub fn with_sides_swapped(&self) -> Event {
        let other = |robot: RobotId| RobotId { team: robot.team.opponent(), ..robot };
        let others = |robots: &[RobotId]| robots.iter().copied().map(other).collect();
        match self {
            Event::Crash(robot) => Event::Crash(other(*robot)),
            Event::Freeze(robot) => Event::Freeze(other(*robot)),
            Event::Deaf(robot) => Event::Deaf(other(*robot)),
            Event::Mute(robot) => Event::Mute(other(*robot)),
            Event::Penalise(robot) => Event::Penalise(other(*robot)),
            Event::Revive { robot, memory } => Event::Revive { robot: other(*robot), memory: *memory },
            Event::CutOff(robot) => Event::CutOff(other(*robot)),
            Event::Reconnect(robot) => Event::Reconnect(other(*robot)),
            Event::Partition(one, two) => Event::Partition(others(one), others(two)),
            Event::Heal | Event::Jam(_) | Event::Radio(_) => self.clone(),
            Event::Ball { at, velocity } => Event::Ball { at: -at, velocity: -velocity },
            Event::Push { robot, by } => Event::Push { robot: other(*robot), by: -by },
            Event::Kidnap { robot, to, facing } => {
                Event::Kidnap { robot: other(*robot), to: -to, facing: facing + HALF_TURN }
            }
            Event::Mislead { robot, by, turn } => {
                Event::Mislead { robot: other(*robot), by: -by, turn: *turn }
            }
            Event::InitiateSwap { robot, roles } => {
                Event::InitiateSwap { robot: other(*robot), roles: roles.clone() }
            }
            Event::TakeOver(robot) => Event::TakeOver(other(*robot)),
            Event::Steer { robot, throttle, aside, turn, kick } => Event::Steer {
                robot: other(*robot),
                throttle: *throttle,
                aside: *aside,
                turn: *turn,
                kick: *kick,
            },
            Event::HandBack(robot) => Event::HandBack(other(*robot)),
            Event::Strategy { team, name } => Event::Strategy { team: team.opponent(), name: name.clone() },
        }
    }
}

/// Degrees.
const HALF_TURN: f32 = 180.0;

/// A piece of teamwork that a scenario may be about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Dependency {
    /// [`Mechanism::Messages`].
    Messages,
    /// [`Mechanism::TeammateAvoidance`].
    TeammateAvoidance,
    /// [`Mechanism::HierarchicalAvoidance`].
    HierarchicalAvoidance,
    /// [`Mechanism::Claims`].
    Claims,
    /// [`Mechanism::HomebaseSelection`].
    HomebaseSelection,
    /// [`Mechanism::GoalieSupport`].
    GoalieSupport,
    /// [`Mechanism::OffensiveSupport`].
    OffensiveSupport,
    /// [`Mechanism::FloaterDropsBack`].
    FloaterDropsBack,
    /// [`Mechanism::RoleSwap`].
    RoleSwap,
    /// [`Mechanism::BallReports`].
    BallReports,
    /// [`Mechanism::BallBooking`].
    BallBooking,
    /// [`Mechanism::ActionArbitration`].
    ActionArbitration,
    /// That roles are swapped by the hardened protocol and not by the paper's.
    HardenedSwap,
}

impl Dependency {
    /// What to switch off in a strategy; `None` for a protocol, which is exchanged instead.
    pub fn mechanism(self) -> Option<Mechanism> {
        Some(match self {
            Dependency::Messages => Mechanism::Messages,
            Dependency::TeammateAvoidance => Mechanism::TeammateAvoidance,
            Dependency::HierarchicalAvoidance => Mechanism::HierarchicalAvoidance,
            Dependency::Claims => Mechanism::Claims,
            Dependency::HomebaseSelection => Mechanism::HomebaseSelection,
            Dependency::GoalieSupport => Mechanism::GoalieSupport,
            Dependency::OffensiveSupport => Mechanism::OffensiveSupport,
            Dependency::FloaterDropsBack => Mechanism::FloaterDropsBack,
            Dependency::RoleSwap => Mechanism::RoleSwap,
            Dependency::BallReports => Mechanism::BallReports,
            Dependency::BallBooking => Mechanism::BallBooking,
            Dependency::ActionArbitration => Mechanism::ActionArbitration,
            Dependency::HardenedSwap => return None,
        })
    }
}
