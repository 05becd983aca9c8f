//! Which robot has which role, and how that changes.

use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use crate::ids::PlayerNumber;

/// A role, as an index into the strategy's roles.
pub type RoleIndex = u8;

/// Identifies an initiator's attempt: a sequence number in the paper, an epoch in the hardened version.
pub type Sequence = u32;

/// The role of every robot of a team, by number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Assignment(SmallVec<[RoleIndex; 8]>);

impl Assignment {
    /// The roles of the players, by number.
    pub fn new(roles: impl IntoIterator<Item = RoleIndex>) -> Assignment {
        Assignment(roles.into_iter().collect())
    }

    /// The role of a robot; `None` for a number that the team does not have.
    pub fn of(&self, robot: PlayerNumber) -> Option<RoleIndex> {
        self.0.get(usize::from(robot)).copied()
    }

    /// The roles by number.
    pub fn roles(&self) -> &[RoleIndex] {
        &self.0
    }

    /// Gives a robot a role; a number that the team does not have changes nothing.
    pub fn set(&mut self, robot: PlayerNumber, role: RoleIndex) {
        if let Some(place) = self.0.get_mut(usize::from(robot)) {
            *place = role;
        }
    }

    /// Whether both give out the same roles, perhaps to other robots.
    pub fn has_roles_of(&self, other: &Assignment) -> bool {
        let sorted = |assignment: &Assignment| {
            let mut roles = assignment.0.clone();
            roles.sort_unstable();
            roles
        };
        sorted(self) == sorted(other)
    }
}

/// An assignment that was committed, with its initiator and epoch. The derived order, by epoch, initiator and assignment, says
/// which of two configurations holds.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Configuration {
    /// Greater epochs replace smaller ones.
    pub epoch: Sequence,
    /// The robot that made it; the smaller number wins in one epoch.
    pub initiator: PlayerNumber,
    /// The role of each player.
    pub assignment: Assignment,
}

/// What an initiator wants to change, in the words of its rule.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Reassignment {
    /// The holder of a pair's first role takes the second, as in "the forward becomes the floater".
    Roles(SmallVec<[(RoleIndex, RoleIndex); 4]>),
    /// These robots take these roles. The others keep theirs where they are still free, and share out the rest in order of
    /// their numbers.
    Robots(SmallVec<[(PlayerNumber, RoleIndex); 4]>),
}

impl Reassignment {
    /// The assignment that follows from one. `all` names the roles that a team has, for `Robots`: it comes out as a permutation
    /// of them whatever `current` was, if the robots named are distinct and their roles are.
    pub fn apply(&self, current: &Assignment, all: &Assignment) -> Assignment {
        match self {
            Reassignment::Roles(pairs) => Assignment::new(
                current
                    .roles()
                    .iter()
                    .map(|role| pairs.iter().find(|(from, _)| from == role).map_or(*role, |(_, to)| *to)),
            ),
            Reassignment::Robots(wanted) => share_out(wanted, current, all),
        }
    }
}

fn share_out(wanted: &[(PlayerNumber, RoleIndex)], current: &Assignment, all: &Assignment) -> Assignment {
    let mut free: SmallVec<[RoleIndex; 8]> = all.roles().into();
    let mut take = |role: RoleIndex| {
        let place = free.iter().position(|candidate| *candidate == role)?;
        Some(free.remove(place))
    };
    let mut given: SmallVec<[Option<RoleIndex>; 8]> = SmallVec::from_elem(None, current.roles().len());
    for (robot, role) in wanted {
        if let Some(place) = given.get_mut(usize::from(*robot)).filter(|place| place.is_none()) {
            *place = take(*role);
        }
    }
    for (place, role) in given.iter_mut().zip(current.roles()) {
        *place = place.or_else(|| take(*role));
    }
    let mut rest = free.into_iter();
    let filled = given.into_iter().zip(current.roles());
    Assignment::new(filled.map(|(given, role)| given.or_else(|| rest.next()).unwrap_or(*role)))
}

#[cfg(test)]
mod tests {
    use smallvec::smallvec;

    use super::*;

    fn of(roles: &[RoleIndex]) -> Assignment {
        Assignment::new(roles.iter().copied())
    }

    #[test]
    fn a_rotation_of_roles_applies_to_whoever_holds_them() {
        let rotation = Reassignment::Roles(smallvec![(1, 3), (3, 2), (2, 1)]);
        let all = of(&[0, 1, 2, 3]);
        assert_eq!(rotation.apply(&all, &all), of(&[0, 3, 1, 2]));
        assert_eq!(rotation.apply(&of(&[0, 3, 1, 2]), &all), of(&[0, 2, 3, 1]));
    }

    #[test]
    fn robots_take_what_they_are_told_and_the_others_share_the_rest() {
        let all = of(&[0, 1, 2, 3]);
        let promote = Reassignment::Robots(smallvec![(1, 3)]);
        assert_eq!(promote.apply(&all, &all), of(&[0, 3, 2, 1]));
    }

    #[test]
    fn doubled_roles_are_mended_when_robots_are_named() {
        let all = of(&[0, 1, 2, 3]);
        let nobody = Reassignment::Robots(smallvec![]);
        let mended = nobody.apply(&of(&[0, 1, 1, 3]), &all);
        assert_eq!(mended, of(&[0, 1, 2, 3]));
        assert!(mended.has_roles_of(&all));
        assert!(!of(&[0, 1, 1, 3]).has_roles_of(&all));
    }

    #[test]
    fn numbers_that_the_team_does_not_have_change_nothing() {
        let all = of(&[0, 1]);
        assert_eq!(Reassignment::Robots(smallvec![(7, 1)]).apply(&all, &all), all);
        assert_eq!(all.of(7), None);
    }

    #[test]
    fn configurations_are_ordered_by_epoch_then_initiator_then_assignment() {
        let made =
            |epoch, initiator, roles: &[RoleIndex]| Configuration { epoch, initiator, assignment: of(roles) };
        assert!(made(1, 3, &[1, 0]) < made(2, 0, &[0, 1]));
        assert!(made(2, 0, &[1, 0]) < made(2, 1, &[0, 1]));
        assert!(made(2, 1, &[0, 1]) < made(2, 1, &[1, 0]));
    }
}
