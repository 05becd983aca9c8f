//! What a policy decides upon: the roles that may be swapped, and what a robot knows of the players and the ball.

use smallvec::SmallVec;

use crate::geometry::Vec2;
use crate::ids::PlayerNumber;
use crate::protocol::role_swap::RoleIndex;

/// The three roles that may be swapped, all different. In the words of CS Freiburg: defender, helping attacker and main
/// attacker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SwapRoles {
    /// The role of the halfback.
    pub halfback: RoleIndex,
    /// The role of the floater.
    pub floater: RoleIndex,
    /// The role of the forward.
    pub forward: RoleIndex,
}

/// What a role of the cast is for. Also the columns of broadcast values, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::protocol) enum Duty {
    Forward,
    Floater,
    Halfback,
}

impl Duty {
    pub(super) const ALL: [Duty; 3] = [Duty::Forward, Duty::Floater, Duty::Halfback];

    pub(super) fn column(self) -> usize {
        self as usize
    }
}

impl SwapRoles {
    pub(super) fn role(&self, duty: Duty) -> RoleIndex {
        match duty {
            Duty::Forward => self.forward,
            Duty::Floater => self.floater,
            Duty::Halfback => self.halfback,
        }
    }

    pub(super) fn duty(&self, role: RoleIndex) -> Option<Duty> {
        Duty::ALL.into_iter().find(|duty| self.role(*duty) == role)
    }
}

/// What a robot knows when it decides.
#[derive(Clone, Debug, PartialEq)]
pub struct Knowledge<'a> {
    /// The robot's own number.
    pub me: PlayerNumber,
    /// The players that were heard of lately, this one included, in order of their numbers.
    pub players: &'a [Player],
    /// m in the team frame.
    pub ball: Option<Vec2>,
    /// Whether the ball is in this robot's scoop.
    pub tight_control: bool,
    /// Half the length of the pitch, m.
    pub half_length: f32,
    /// The middle of the opponents' goal line, m in the team frame; ours is its mirror image.
    pub goal: Vec2,
    /// Seconds on this robot's clock.
    pub now: f32,
}

/// A player as this robot knows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Player {
    /// Its number in the team.
    pub number: PlayerNumber,
    /// The role it is believed to have.
    pub role: RoleIndex,
    /// m in the team frame.
    pub position: Vec2,
    /// rad in the team frame.
    pub heading: f32,
    /// The values that it broadcast last.
    pub values: Option<Valued>,
}

/// Values as they were broadcast.
#[derive(Clone, Debug, PartialEq)]
pub struct Valued {
    /// One for each column of the policy.
    pub values: ColumnValues,
    /// The column that the sender would rather have than its own.
    pub wish: Option<u8>,
    /// Seconds since they were sent.
    pub age: f32,
}

/// What each role would be worth in one robot's hands.
pub type ColumnValues = SmallVec<[f32; 4]>;

/// What a robot remembers from one decision to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolicyState {
    /// Whether it had tight control of the ball at the last decision.
    pub(super) had_control: bool,
    /// The role that each robot was last believed to have.
    pub(super) roles: SmallVec<[(PlayerNumber, RoleIndex); 4]>,
    /// When this robot last proposed a swap or saw a role change, s.
    pub(super) unrest: Option<f32>,
}

impl PolicyState {
    pub(super) fn observe(&mut self, knowledge: &Knowledge) {
        self.had_control = knowledge.tight_control;
        for player in knowledge.players {
            match self.roles.iter_mut().find(|(number, _)| *number == player.number) {
                Some((_, role)) if *role == player.role => {}
                Some((_, role)) => {
                    *role = player.role;
                    self.unrest = Some(knowledge.now);
                }
                None => self.roles.push((player.number, player.role)),
            }
        }
    }

    pub(super) fn has_rested(&self, now: f32, seconds: f32) -> bool {
        self.unrest.is_none_or(|unrest| now - unrest >= seconds)
    }
}
