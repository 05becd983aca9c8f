//! What a referee box forbids robots beyond the phase of the match.

use crate::ids::RobotId;

/// Who may not do what the phase allows. Nobody is restrained where our own referee decides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Restraints {
    /// Play is stopped: nobody moves.
    pub stopped: bool,
    /// Robots that serve a penalty where they stand, sorted.
    pub frozen: Vec<RobotId>,
    /// Robots that stand until a set play is over, or until the ball is farther away, sorted.
    pub held_back: Vec<RobotId>,
    /// People put the robots in their places and none walks there, as at a penalty kick.
    pub carried: bool,
}

impl Restraints {
    /// Whether a robot serves a penalty where it stands.
    pub fn is_frozen(&self, robot: RobotId) -> bool {
        self.frozen.binary_search(&robot).is_ok()
    }

    /// Whether a robot stands although the phase lets it move.
    pub fn holds(&self, robot: RobotId) -> bool {
        self.stopped || self.held_back.binary_search(&robot).is_ok()
    }
}
