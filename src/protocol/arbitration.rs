//! Arbitration over single actions, after the Italian Golem team of 2000 as the Hammerheads paper (section II) describes it: each
//! robot works out a Q-value for each action, all values are broadcast, and the robot with the highest value may execute its
//! action. The robot with the ball has priority in the actions that handle it, so that robots do not interfere over the ball.
//!
//! Nothing is locked and nothing remembered: who may do what follows from the latest values alone, and robots that know the same
//! values agree. Robots that do not hear each other may both go. Golem's functions were learnt; these here are ours. Positions
//! are metres in the team frame.

#[cfg(test)]
mod tests;

use std::fmt;

use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::policy::{Duty, Places, nearness};
use crate::data::{Bound, Fault, Validate, check_all, ensure};
use crate::geometry::{Vec2, angle, wrap_angle};
use crate::ids::PlayerNumber;

/// What a robot may do with or for the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum PlayerAction {
    /// Push the ball that is in its scoop to the opponents' goal.
    Push,
    /// Get to the ball.
    Acquire,
    /// Be behind the robot that handles the ball.
    Support,
    /// Be between the ball and the team's own goal.
    Defend,
}

/// What an action takes up: no two robots can have the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Object {
    Ball,
    PlaceBehindBall,
    PlaceBeforeGoal,
}

impl PlayerAction {
    /// Every action, in the order of the values that are broadcast.
    pub const ALL: [PlayerAction; 4] =
        [PlayerAction::Push, PlayerAction::Acquire, PlayerAction::Support, PlayerAction::Defend];

    fn object(self) -> Object {
        match self {
            PlayerAction::Push | PlayerAction::Acquire => Object::Ball,
            PlayerAction::Support => Object::PlaceBehindBall,
            PlayerAction::Defend => Object::PlaceBeforeGoal,
        }
    }
}

impl fmt::Display for PlayerAction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            PlayerAction::Push => "push",
            PlayerAction::Acquire => "acquire",
            PlayerAction::Support => "support",
            PlayerAction::Defend => "defend",
        })
    }
}

/// A value for each action, in the order of [`PlayerAction::ALL`]; 0 for one that is not possible.
pub type QValues = [f32; 4];

/// What a robot knows of itself and the ball when it works out its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// m
    pub position: Vec2,
    /// rad
    pub heading: f32,
    /// m
    pub ball: Vec2,
    /// Whether the ball is in its scoop.
    pub tight_control: bool,
    /// The middle of the opponents' goal line, m; ours is its mirror image.
    pub goal: Vec2,
    /// What it may do at present.
    pub doing: Option<PlayerAction>,
}

/// What a robot said last.
#[derive(Clone, Debug, PartialEq)]
pub struct Bid {
    /// Its number in the team.
    pub number: PlayerNumber,
    /// One for each action.
    pub values: SmallVec<[f32; 4]>,
    /// Seconds since they were heard.
    pub age: f32,
}

/// The Q-functions and what counts of them. All constants are ours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ActionArbitration {
    /// Where the actions are best done.
    pub places: Places,
    /// Distance at which a value is a half of its greatest, m.
    pub half: f32,
    /// The greatest value of an action at a ball that is free; that of the other actions is 1.
    pub ball: f32,
    /// Added to the values of actions at the ball by the robot that has it in its scoop.
    pub possession: f32,
    /// A robot can push while it faces the opponents' goal within this angle, degrees.
    pub facing: f32,
    /// Added to the values of actions with what the robot has already, so that equals do not take turns.
    pub lead: f32,
    /// Between two broadcasts, s.
    pub every: f32,
    /// Age from which values no longer count, s.
    pub max_age: f32,
}

impl Default for ActionArbitration {
    fn default() -> ActionArbitration {
        ActionArbitration {
            places: Places::default(),
            half: 1.5,
            ball: 2.0,
            possession: 1.0,
            facing: 70.0,
            lead: 0.2,
            every: 0.2,
            max_age: 1.0,
        }
    }
}

impl ActionArbitration {
    /// What each action is worth in a robot's hands.
    pub fn values(&self, robot: &Standing) -> QValues {
        let near =
            |duty| nearness(self.places.distance(robot.position, duty, robot.ball, robot.goal), self.half);
        let off = wrap_angle(angle(robot.goal - robot.position) - robot.heading).abs();
        let can_push = robot.tight_control && off <= self.facing.to_radians();
        PlayerAction::ALL.map(|action| {
            let worth = match action {
                PlayerAction::Push if can_push => self.ball,
                PlayerAction::Push => return 0.0,
                PlayerAction::Acquire if robot.tight_control => self.ball,
                PlayerAction::Acquire => self.ball * near(Duty::Forward),
                PlayerAction::Support => near(Duty::Floater),
                PlayerAction::Defend => near(Duty::Halfback),
            };
            let at_ball = action.object() == Object::Ball;
            let possession = if robot.tight_control && at_ball { self.possession } else { 0.0 };
            let has = robot.doing.is_some_and(|doing| doing.object() == action.object());
            worth + possession + if has { self.lead } else { 0.0 }
        })
    }

    /// The action that a robot may execute. The highest value of all is granted first, then the highest of those that are still
    /// possible, and so on; of equal values that of the lower number, and pushing before acquiring.
    pub fn allowed(&self, me: PlayerNumber, bids: &[Bid]) -> Option<PlayerAction> {
        let counts = |bid: &&Bid| {
            (bid.number == me || bid.age <= self.max_age) && bid.values.len() == PlayerAction::ALL.len()
        };
        let bids = bids.iter().filter(counts);
        let mut wanted: SmallVec<[(f32, PlayerNumber, PlayerAction); 16]> = bids
            .flat_map(|bid| {
                PlayerAction::ALL
                    .into_iter()
                    .zip(&bid.values)
                    .map(|(action, value)| (*value, bid.number, action))
            })
            .filter(|(value, ..)| value.is_finite() && *value > 0.0)
            .collect();
        wanted.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut granted: SmallVec<[(PlayerNumber, PlayerAction); 4]> = SmallVec::new();
        for (_, number, action) in wanted {
            let is_free = |(other, had): &(PlayerNumber, PlayerAction)| {
                *other != number && had.object() != action.object()
            };
            if granted.iter().all(is_free) {
                granted.push((number, action));
            }
        }
        granted.into_iter().find(|(number, _)| *number == me).map(|(_, action)| action)
    }
}

impl Validate for ActionArbitration {
    fn validate(&self) -> Result<(), Fault> {
        self.places.validate_as("places")?;
        check_all([
            ("half", self.half, Bound::LENGTH.positive()),
            ("ball", self.ball, Bound::FACTOR),
            ("possession", self.possession, Bound::FACTOR.positive()),
            ("facing", self.facing, Bound::ANGLE),
            ("lead", self.lead, Bound::FACTOR),
            ("every", self.every, Bound::SECONDS.positive()),
            ("max_age", self.max_age, Bound::SECONDS.positive()),
        ])?;
        let (lead, possession) = (self.lead, self.possession);
        ensure(lead < possession, "lead", || {
            format!("must be less than possession, {possession}, or the robot with the ball has no priority")
        })
    }
}
