//! The words of a scenario's expectations: what must hold, and when.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::comms::tcm::DataType;
use crate::game::record::Invariant;
use crate::geometry::Zone;
use crate::ids::{RobotId, Team};
use crate::lab::statistics::ProbabilityTest;

/// What a scenario must show. Times are seconds since it began; a tick on a limit counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Expectation {
    /// Holds at some tick, at most `within` seconds after `after`.
    Eventually {
        what: Condition,
        within: f32,
        #[serde(default)]
        after: f32,
        /// Why, for people.
        #[serde(default)]
        because: String,
    },
    /// Holds at every tick.
    Always {
        what: Condition,
        #[serde(default)]
        from: f32,
        /// The end of the scenario if not given.
        #[serde(default)]
        until: Option<f32>,
        #[serde(default)]
        because: String,
    },
    /// Holds at no tick.
    Never {
        what: Condition,
        #[serde(default)]
        from: f32,
        /// The end of the scenario if not given.
        #[serde(default)]
        until: Option<f32>,
        #[serde(default)]
        because: String,
    },
    /// Holds at the last tick.
    Finally {
        what: Condition,
        #[serde(default)]
        because: String,
    },
    /// Is met with a seed with this probability at least. Seeds are played until that is shown or refuted, with an error of at most 1 -
    /// `confidence`.
    Probability { of: Box<Expectation>, at_least: f64, confidence: f64 },
}

impl Expectation {
    /// The condition that it is about.
    pub fn what(&self) -> &Condition {
        match self {
            Expectation::Probability { of, .. } => of.what(),
            Expectation::Eventually { what, .. }
            | Expectation::Always { what, .. }
            | Expectation::Never { what, .. }
            | Expectation::Finally { what, .. } => what,
        }
    }

    /// Why it must hold, for people; empty if not given.
    pub fn because(&self) -> &str {
        match self {
            Expectation::Probability { of, .. } => of.because(),
            Expectation::Eventually { because, .. }
            | Expectation::Always { because, .. }
            | Expectation::Never { because, .. }
            | Expectation::Finally { because, .. } => because,
        }
    }

    /// What is looked at while one seed is played.
    pub fn with_one_seed(&self) -> &Expectation {
        match self {
            Expectation::Probability { of, .. } => of.with_one_seed(),
            _ => self,
        }
    }

    /// With what probability it must be met; `None` if it must be met with each seed.
    pub fn probability(&self) -> Option<ProbabilityTest> {
        match *self {
            Expectation::Probability { at_least, confidence, .. } => {
                Some(ProbabilityTest { at_least, confidence })
            }
            _ => None,
        }
    }
}

/// A statement about one tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Condition {
    /// The robot has this role.
    RoleOf(RobotId, String),
    /// The sub-role of a robot whose role acts as others by turns; the role itself for all others.
    ActingAs(RobotId, String),
    /// The robot's state, or one around it, is one of these.
    ActivityOf(RobotId, Vec<String>),
    /// The robot itself claims the ball.
    Claims(RobotId),
    /// Every team mate that is switched on, or only the one named, believes that the robot holds the ball.
    Holder {
        robot: RobotId,
        #[serde(default)]
        seen_by: Option<RobotId>,
    },
    /// The robot has given its lock for a role swap, to anybody or to the one named.
    Locked {
        robot: RobotId,
        #[serde(default)]
        by: Option<RobotId>,
    },
    /// No robot of the team has given its lock.
    Unlocked(Team),
    /// The robot has booked the ball and goes for it.
    Goes(RobotId),
    /// How many robots of the team go for the ball that they have booked.
    Going {
        team: Team,
        #[serde(default)]
        at_least: Option<u32>,
        #[serde(default)]
        at_most: Option<u32>,
    },
    /// The robot drives at the ball, whatever it believes or has booked.
    Drives(RobotId),
    /// How many robots of the team drive at the ball.
    Driving {
        team: Team,
        #[serde(default)]
        at_least: Option<u32>,
        #[serde(default)]
        at_most: Option<u32>,
    },
    /// Every team mate that is switched on, or only the one named, believes that the robot has booked the ball.
    Booker {
        robot: RobotId,
        #[serde(default)]
        seen_by: Option<RobotId>,
    },
    /// Metres between the centres of two things.
    Distance {
        from: Thing,
        to: Thing,
        #[serde(default)]
        below: Option<f32>,
        #[serde(default)]
        above: Option<f32>,
    },
    /// A thing is between `near` and `far` metres behind another on its way to a third, and between `aside.0` and `aside.1`
    /// metres to one side of that way, whichever.
    Behind { what: Thing, of: Thing, toward: Thing, near: f32, far: f32, aside: (f32, f32) },
    /// m/s of the ball or a robot.
    Speed {
        of: Thing,
        #[serde(default)]
        below: Option<f32>,
        #[serde(default)]
        above: Option<f32>,
    },
    /// A thing is in a part of the pitch.
    InZone { what: Thing, zone: Area },
    /// Packets were sent.
    Sent(Packets),
    /// Packets have arrived.
    Delivered(Packets),
    /// The goals of a team.
    Goals {
        team: Team,
        #[serde(default)]
        at_least: Option<u32>,
        #[serde(default)]
        at_most: Option<u32>,
    },
    /// Two robots touch each other, with body or trailer.
    Touching(RobotId, RobotId),
    /// How often robots of the team have touched each other so far; touches of a pair less than a quarter of a second apart are
    /// one.
    MateContacts {
        team: Team,
        #[serde(default)]
        at_least: Option<u32>,
        #[serde(default)]
        at_most: Option<u32>,
    },
    /// For how many seconds robots of the team have touched each other so far, all pairs together.
    MateContactTime {
        team: Team,
        #[serde(default)]
        below: Option<f32>,
        #[serde(default)]
        above: Option<f32>,
    },
    /// No two robots of the team that are switched on have the same role.
    RolesDistinct(Team),
    /// The roles of the robots named by their numbers.
    RolesAre(Team, BTreeMap<u8, String>),
    /// All robots of the team that are switched on know the same configuration.
    ConfigurationsAgree(Team),
    /// All of these hold.
    All(Vec<Condition>),
    /// One of these holds at least.
    Any(Vec<Condition>),
    /// An [invariant](Invariant) is broken: it has not held for longer than its bound; by a team, or by anybody.
    Broken {
        invariant: Invariant,
        #[serde(default)]
        team: Option<Team>,
    },
    /// This does not hold.
    Not(Box<Condition>),
    /// Has held for this time without a break, s.
    For { seconds: f32, what: Box<Condition> },
}

/// Packets of one kind: a message to three team mates is three packets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Packets {
    /// The kind of message.
    pub kind: DataType,
    /// The sender, any if not given.
    #[serde(default)]
    pub from: Option<RobotId>,
    /// The receiver, any if not given.
    #[serde(default)]
    pub to: Option<RobotId>,
    /// How many packets there must be.
    #[serde(default = "one")]
    pub at_least: u64,
    /// Counts only what came later than this, s.
    #[serde(default)]
    pub since: f32,
}

fn one() -> u64 {
    1
}

/// Something that is somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Thing {
    /// The ball.
    Ball,
    /// The place where the ball was at the start.
    BallAtStart,
    /// A robot.
    Robot(RobotId),
    /// A point in the pitch frame, m.
    At(f32, f32),
    /// The centre of the goal mouth that the team defends when it attacks as at the start.
    Goal(Team),
}

/// A part of the pitch. Home's is in the west, where it defends at the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Area {
    /// The penalty area in front of a team's goal.
    PenaltyArea(Team),
    /// A team's half.
    Half(Team),
    /// Behind the goal line.
    Goal(Team),
    /// In the pitch frame.
    Rectangle(Zone),
}
