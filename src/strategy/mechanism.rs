//! The mechanisms of teamwork, each of which can be switched off.

use serde::{Deserialize, Serialize};

/// A mechanism of collaboration or coordination, each of which can be switched off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Mechanism {
    /// Robots tell each other position, claim and goalie news (figure 3). Without it nothing goes on air but role swaps.
    Messages,
    /// Team mates are avoided at all (section V-A).
    TeammateAvoidance,
    /// Only those who rank above are avoided where it matters; without it everyone avoids everyone (section VI-A).
    HierarchicalAvoidance,
    /// A robot that acquires the ball claims it (section VI-B).
    Claims,
    /// Homebases depend on where the team mates are; without it they are the nearest (section V-B).
    HomebaseSelection,
    /// The halfback stands in for a goalie that is out (figure 4).
    GoalieSupport,
    /// A team mate follows the robot with the ball (figure 6).
    OffensiveSupport,
    /// The floater defends while the halfback is away with the ball (section VI-D).
    FloaterDropsBack,
    /// Roles are swapped (section VII).
    RoleSwap,
    /// Robots report the ball that they see (TeamChaos, section 1).
    BallReports,
    /// Only the robot that has booked the ball goes for it (TeamChaos, section 4).
    BallBooking,
    /// Of each action only the robot that values it highest executes it (section II: Italian Golem).
    ActionArbitration,
}

impl Mechanism {
    /// Every mechanism.
    pub const ALL: [Mechanism; 12] = [
        Mechanism::Messages,
        Mechanism::TeammateAvoidance,
        Mechanism::HierarchicalAvoidance,
        Mechanism::Claims,
        Mechanism::HomebaseSelection,
        Mechanism::GoalieSupport,
        Mechanism::OffensiveSupport,
        Mechanism::FloaterDropsBack,
        Mechanism::RoleSwap,
        Mechanism::BallReports,
        Mechanism::BallBooking,
        Mechanism::ActionArbitration,
    ];

    fn bit(self) -> u16 {
        1 << self as u16
    }
}

/// The mechanisms that are on. By default robots avoid the team mates that they see, and that is all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mechanisms(u16);

impl Default for Mechanisms {
    fn default() -> Mechanisms {
        Mechanisms::from_iter([Mechanism::TeammateAvoidance])
    }
}

impl Mechanisms {
    /// Whether one is on.
    pub fn has(self, mechanism: Mechanism) -> bool {
        self.0 & mechanism.bit() != 0
    }

    /// The same with one switched off.
    pub fn without(self, mechanism: Mechanism) -> Mechanisms {
        Mechanisms(self.0 & !mechanism.bit())
    }
}

impl FromIterator<Mechanism> for Mechanisms {
    fn from_iter<I: IntoIterator<Item = Mechanism>>(mechanisms: I) -> Mechanisms {
        Mechanisms(mechanisms.into_iter().fold(0, |all, mechanism| all | mechanism.bit()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mechanisms_are_switched_one_by_one() {
        let all: Mechanisms = Mechanism::ALL.into_iter().collect();
        for off in Mechanism::ALL {
            let rest = all.without(off);
            assert!(Mechanism::ALL.into_iter().all(|mechanism| rest.has(mechanism) == (mechanism != off)));
        }
    }
}
