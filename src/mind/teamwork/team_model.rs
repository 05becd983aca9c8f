//! What a robot knows of its team: roles, the robot with the ball, where the goalie is.

use bevy::prelude::*;
use smallvec::SmallVec;

use super::claims::Claims;
use super::global_map::GlobalMap;
use super::goalie::{BorderWatch, GoalieWhereabouts};
use crate::clock::Clock;
use crate::comms::messages::Values;
use crate::ids::PlayerNumber;
use crate::protocol::arbitration::{Bid, PlayerAction};
use crate::protocol::policy::Valued;
use crate::protocol::role_swap::{Assignment, RoleIndex};
use crate::robot::{Restart, SwitchedOn};
use crate::strategy::Strategy;
use crate::strategy::teamwork::Teamwork;

/// What a robot believes of its team; written by the Teamwork stage.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct TeamModel {
    /// The believed roles.
    pub roles: Assignment,
    /// Claims of the ball.
    pub claims: Claims,
    /// Whether the robot has claimed the ball and nobody above it has.
    pub has_ball: bool,
    /// The team mate that has the ball: whose claim of it holds, or that is seen at it.
    pub carrier: Option<Carrier>,
    /// Where the goalie is.
    pub goalie: GoalieWhereabouts,
    /// What the team mates said last that roles or actions are worth to them, and the ticks in which that was heard.
    pub values: SmallVec<[(PlayerNumber, Values, u64); 4]>,
    /// Where the ball is by all that was heard of it.
    pub map: GlobalMap,
    /// The robot that has booked the ball, as this robot believes.
    pub booking: BookingStatus,
    /// The action that the robot may execute.
    pub action: Option<PlayerAction>,
    /// If the robot is the goalie.
    pub border: BorderWatch,
    /// When the robot itself said what.
    pub last_sent: LastSent,
    /// A position message is due at once, for it carries a new configuration.
    pub announce: bool,
}

/// The team mate that has the ball, as a robot believes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// It is known by its number and its role: it has claimed the ball, or stands at it where it says that it is.
    Known(PlayerNumber, RoleIndex),
    /// It is seen at the ball, and not known by name.
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    Seen { at: Vec2, is_goalie: bool },
}

impl Carrier {
    /// Its number, if it is known.
    pub fn number(self) -> Option<PlayerNumber> {
        match self {
            Carrier::Known(number, _) => Some(number),
            Carrier::Seen { .. } => None,
        }
    }

    /// Whether it has one of these roles; any, if none is named. One that is only seen is told by where it is.
    pub fn has_one_of(self, roles: impl IntoIterator<Item = RoleIndex>, teamwork: &Teamwork) -> bool {
        let mut roles = roles.into_iter().peekable();
        roles.peek().is_none()
            || match self {
                Carrier::Known(_, own) => roles.any(|role| role == own),
                Carrier::Seen { is_goalie, .. } => {
                    roles.any(|role| (teamwork.goalie == Some(role)) == is_goalie)
                }
            }
    }

    /// Whether it ranks above a role. One that is only seen does, since it may.
    pub fn outranks(self, role: usize, teamwork: &Teamwork) -> bool {
        match self {
            Carrier::Known(_, own) => teamwork.outranks(usize::from(own), role),
            Carrier::Seen { .. } => true,
        }
    }
}

/// The booking of the ball, as a robot believes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BookingStatus {
    /// Nobody has booked it.
    #[default]
    Free,
    /// The robot has booked it itself.
    Own,
    /// A team mate has booked it.
    Mate(PlayerNumber),
}

/// When a robot sent which news last, in ticks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LastSent {
    /// The tick of its last position message.
    pub position: Option<u64>,
    /// The tick of its last have-ball message.
    pub have_ball: Option<u64>,
    /// The tick of its last ball report.
    pub ball: Option<u64>,
    /// The tick in which it said last what actions are worth to it.
    pub values: Option<u64>,
}

impl TeamModel {
    /// A robot that has heard nothing yet: roles are as at kick-off.
    pub fn new(strategy: &Strategy) -> TeamModel {
        TeamModel::of(kick_off_roles(strategy))
    }

    /// A robot that knows the roles and nothing else.
    pub fn of(roles: Assignment) -> TeamModel {
        TeamModel {
            roles,
            claims: Claims::default(),
            has_ball: false,
            carrier: None,
            goalie: GoalieWhereabouts::default(),
            values: SmallVec::new(),
            map: GlobalMap::default(),
            booking: BookingStatus::default(),
            action: None,
            border: BorderWatch::default(),
            last_sent: LastSent::default(),
            announce: false,
        }
    }

    /// Of what the robot knew only the roles are left, if it recalls them.
    pub(super) fn restart(&mut self, on: &SwitchedOn, _: EntityRef) {
        *self = match on.restart {
            Restart::Kept => TeamModel::of(self.roles.clone()),
            Restart::Lost => TeamModel::new(&on.strategy),
        };
    }

    pub(super) fn values_of(&self, number: PlayerNumber, clock: &Clock) -> Option<Valued> {
        let (_, said, heard) = self.values.iter().find(|(from, ..)| *from == number)?;
        let age = clock.seconds_since(*heard);
        Some(Valued { values: said.values.iter().copied().collect(), wish: said.wish, age })
    }

    /// What the team mates said last that actions are worth to them.
    pub(super) fn bids<'a>(&'a self, clock: &'a Clock) -> impl Iterator<Item = Bid> + 'a {
        self.values.iter().map(|(number, said, heard)| Bid {
            number: *number,
            values: said.values.iter().copied().collect(),
            age: clock.seconds_since(*heard),
        })
    }

    /// The team mate that is believed to play a role.
    pub fn holder_of(&self, role: RoleIndex) -> Option<PlayerNumber> {
        self.roles.roles().iter().position(|held| *held == role).map(|number| number as PlayerNumber)
    }

    /// Takes note that a robot plays a role. Its former holder is then believed to play the robot's former role.
    pub fn note_role(&mut self, robot: PlayerNumber, role: RoleIndex) {
        let Some(before) = self.roles.of(robot) else { return };
        if let Some(other) = self.holder_of(role).filter(|other| *other != robot) {
            self.roles.set(other, before);
        }
        self.roles.set(robot, role);
    }
}

/// Everybody's role at kick-off, by number.
pub fn kick_off_roles(strategy: &Strategy) -> Assignment {
    // A strategy that was loaded has 256 roles at most.
    Assignment::new(strategy.players.iter().map(|role| *role as RoleIndex))
}
