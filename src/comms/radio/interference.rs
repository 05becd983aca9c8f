//! Interference: what a scenario or a person does to the radio while a match runs, on top of the preset.

use std::collections::BTreeSet;
use std::fmt;

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};

use crate::ids::RobotId;

/// The present interference. The default is none.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Interference {
    /// Chance that a message is lost that the radio itself would have brought over.
    pub extra_loss: f32,
    /// Added to every message's latency, s.
    pub extra_delay: f32,
    /// Everything is lost.
    pub jammed: bool,
    /// Robots that hear nobody and are heard by nobody.
    pub cut_off: BTreeSet<RobotId>,
    /// Groups that do not hear each other.
    pub partitions: Vec<Partition>,
}

/// Two groups of robots that do not hear each other. Robots in neither hear everybody.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Partition {
    /// What parts them, for people to read.
    pub reason: String,
    /// One group.
    pub one: BTreeSet<RobotId>,
    /// The other group.
    pub other: BTreeSet<RobotId>,
}

/// Why a robot cannot hear another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle<'a> {
    Jammed,
    CutOff(RobotId),
    Parted(&'a Partition),
}

impl Interference {
    /// What keeps `to` from hearing `from`. A robot that is cut off is named before a partition, the sender first.
    pub fn obstacle(&self, from: RobotId, to: RobotId) -> Option<Obstacle<'_>> {
        if self.jammed {
            return Some(Obstacle::Jammed);
        }
        if let Some(id) = [from, to].into_iter().find(|id| self.cut_off.contains(id)) {
            return Some(Obstacle::CutOff(id));
        }
        self.partitions.iter().find(|partition| partition.parts(from, to)).map(Obstacle::Parted)
    }
}

impl Partition {
    /// Whether these two robots do not hear each other.
    pub fn parts(&self, a: RobotId, b: RobotId) -> bool {
        (self.one.contains(&a) && self.other.contains(&b))
            || (self.one.contains(&b) && self.other.contains(&a))
    }
}

impl fmt::Display for Obstacle<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Obstacle::Jammed => f.write_str("the radio is jammed"),
            Obstacle::CutOff(id) => write!(f, "{id} is cut off"),
            Obstacle::Parted(partition) => f.write_str(&partition.reason),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::ids::Team;

    fn home(number: u8) -> RobotId {
        RobotId::new(Team::Home, number)
    }

    fn wall() -> Partition {
        Partition { reason: "a wall".into(), one: [home(0), home(1)].into(), other: [home(2)].into() }
    }

    #[test]
    fn nothing_stands_between_robots_unless_somebody_says_so() {
        assert_eq!(Interference::default().obstacle(home(0), home(1)), None);
    }

    #[test]
    fn a_robot_that_is_cut_off_neither_hears_nor_is_heard() {
        let interference = Interference { cut_off: [home(1)].into(), ..Interference::default() };
        assert_eq!(interference.obstacle(home(0), home(1)), Some(Obstacle::CutOff(home(1))));
        assert_eq!(interference.obstacle(home(1), home(0)), Some(Obstacle::CutOff(home(1))));
        assert_eq!(interference.obstacle(home(0), home(2)), None);
    }

    #[test]
    fn two_groups_do_not_hear_each_other_but_each_itself_and_the_rest() {
        let interference = Interference { partitions: vec![wall()], ..Interference::default() };
        assert_eq!(interference.obstacle(home(0), home(2)), Some(Obstacle::Parted(&wall())));
        assert_eq!(interference.obstacle(home(2), home(1)), Some(Obstacle::Parted(&wall())));
        assert_eq!(interference.obstacle(home(0), home(1)), None);
        assert_eq!(interference.obstacle(home(2), home(3)), None);
    }

    #[test]
    fn an_obstacle_tells_its_reason() {
        let mut interference = Interference { partitions: vec![wall()], ..Interference::default() };
        let reason = |c: &Interference| c.obstacle(home(0), home(2)).unwrap().to_string();
        assert_eq!(reason(&interference), "a wall");
        interference.cut_off.insert(home(2));
        assert_eq!(reason(&interference), "home 2 is cut off");
        interference.jammed = true;
        assert_eq!(reason(&interference), "the radio is jammed");
    }

    proptest! {
        #[test]
        fn who_does_not_hear_is_not_heard(
            cut_off in prop::collection::btree_set(0u8..6, 0..3),
            one in prop::collection::btree_set(0u8..6, 0..4),
            other in prop::collection::btree_set(0u8..6, 0..4),
            (a, b) in (0u8..6, 0u8..6),
        ) {
            let ids = |numbers: BTreeSet<u8>| numbers.into_iter().map(home).collect::<BTreeSet<_>>();
            let partition = Partition { reason: "test".into(), one: ids(one), other: ids(other) };
            let interference =
                Interference { cut_off: ids(cut_off), partitions: vec![partition], ..Interference::default() };
            let there = interference.obstacle(home(a), home(b)).is_some();
            prop_assert_eq!(there, interference.obstacle(home(b), home(a)).is_some());
        }
    }
}
