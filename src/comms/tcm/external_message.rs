//! The unit that peers exchange (TeamChaos, section 3): who sends it, from which module, to whom, and data of any type.

use std::fmt;
use std::str::FromStr;

use bevy::prelude::Reflect;
use serde::{Deserialize, Serialize};

use crate::ids::{RobotId, Team};

/// What a module of one peer says to a module of another. Its length is that of its data.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExternalMessage {
    /// Never a group: see [`Peer::is_one`].
    pub source: Address,
    /// The receiver, perhaps a group.
    pub destination: Address,
    /// How the data are to be read.
    pub data_type: DataType,
    /// As the module that sends it has serialised it.
    pub data: Vec<u8>,
}

/// A module of a peer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Address {
    /// Who.
    pub peer: Peer,
    /// The module in it.
    pub module: Module,
}

/// A sender or receiver. A team and everybody can only receive.
///
/// In files it is written as people write it: `"home 2"`, `"away"`, `"computer 0"` or `"everybody"`; teams besides home, 0,
/// and away, 1, are `"team 2"` with the robots `"team 2 0"` and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Peer {
    /// One robot.
    Robot {
        /// 0 for home, 1 for away.
        team: u8,
        /// Counted from 0.
        number: u8,
    },
    /// A tool that watches or directs robots, as the paper's ChaosManager.
    Computer(u8),
    /// Every robot of a team.
    Team(u8),
    /// Every robot and every computer.
    Everybody,
}

/// A part of a peer's program that sends and receives messages. The numbers from [`Module::FIRST_FREE`] on belong to users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Module(pub u8);

/// What the data of a message are: the kind of the message. The numbers from [`DataType::FIRST_FREE`] on belong to users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Reflect)]
pub struct DataType(pub u16);

/// A text that names no peer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is nobody; write `home 2`, `away`, `computer 0` or `everybody`")]
pub struct NotAPeer(pub String);

/// The match itself, which tells robots in other processes what they sense. Messages to a team do not reach it.
pub const HOST: Peer = Peer::Computer(255);

impl Peer {
    /// Whether this is a robot or a computer, who can speak, and not a group of them.
    pub fn is_one(self) -> bool {
        matches!(self, Peer::Robot { .. } | Peer::Computer(_))
    }

    /// Whether a message to `self` is meant for `one`.
    pub fn includes(self, one: Peer) -> bool {
        match self {
            Peer::Everybody => one.is_one(),
            Peer::Team(mine) => matches!(one, Peer::Robot { team, .. } if team == mine),
            Peer::Robot { .. } | Peer::Computer(_) => self == one,
        }
    }

    /// The robot of home or away that this is.
    pub fn robot(self) -> Option<RobotId> {
        match self {
            Peer::Robot { team, number } => {
                Team::BOTH.get(usize::from(team)).map(|team| RobotId::new(*team, number))
            }
            _ => None,
        }
    }
}

impl Module {
    /// The first that is free for users.
    pub const FIRST_FREE: Module = Module(128);
}

impl DataType {
    /// The first that is free for users.
    pub const FIRST_FREE: DataType = DataType(1024);
}

impl From<RobotId> for Peer {
    fn from(robot: RobotId) -> Peer {
        Peer::Robot { team: robot.team as u8, number: robot.number }
    }
}

impl fmt::Display for Peer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Peer::Robot { team, number } => match self.robot() {
                Some(robot) => robot.fmt(f),
                None => write!(f, "team {team} {number}"),
            },
            Peer::Computer(number) => write!(f, "computer {number}"),
            Peer::Team(0) => f.write_str("home"),
            Peer::Team(1) => f.write_str("away"),
            Peer::Team(team) => write!(f, "team {team}"),
            Peer::Everybody => f.write_str("everybody"),
        }
    }
}

/// Reads what [`Display`](fmt::Display) writes, and also `home:2`, `home-2` or `Home2`.
impl FromStr for Peer {
    type Err = NotAPeer;

    fn from_str(text: &str) -> Result<Peer, NotAPeer> {
        if let Ok(robot) = text.trim().parse::<RobotId>() {
            return Ok(robot.into());
        }
        let lower = text.trim().to_ascii_lowercase();
        let (word, rest) =
            lower.split_at(lower.find(|c: char| !c.is_ascii_lowercase()).unwrap_or(lower.len()));
        let separators = [' ', ':', '-'];
        let numbers: Option<Vec<u8>> =
            rest.split(separators).filter(|part| !part.is_empty()).map(number).collect();
        match (word, numbers.as_deref()) {
            ("home", Some(&[])) => Ok(Peer::Team(0)),
            ("away", Some(&[])) => Ok(Peer::Team(1)),
            ("team", Some(&[team])) => Ok(Peer::Team(team)),
            ("team", Some(&[team, number])) => Ok(Peer::Robot { team, number }),
            ("computer", Some(&[number])) => Ok(Peer::Computer(number)),
            ("everybody", Some(&[])) => Ok(Peer::Everybody),
            _ => Err(NotAPeer(text.to_owned())),
        }
    }
}

/// A number in decimal digits only: `parse` alone would take a plus sign.
fn number(text: &str) -> Option<u8> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok()).flatten()
}

impl TryFrom<String> for Peer {
    type Error = NotAPeer;

    fn try_from(text: String) -> Result<Peer, NotAPeer> {
        text.parse()
    }
}

impl From<Peer> for String {
    fn from(peer: Peer) -> String {
        peer.to_string()
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", self.peer, self.module)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn peer() -> impl Strategy<Value = Peer> {
        prop_oneof![
            any::<(u8, u8)>().prop_map(|(team, number)| Peer::Robot { team, number }),
            any::<u8>().prop_map(Peer::Computer),
            any::<u8>().prop_map(Peer::Team),
            Just(Peer::Everybody),
        ]
    }

    #[test]
    fn peers_are_written_and_read_as_people_write_them() {
        let names = [
            (Peer::Robot { team: 0, number: 2 }, "home 2"),
            (Peer::Robot { team: 1, number: 1 }, "away 1"),
            (Peer::Robot { team: 2, number: 5 }, "team 2 5"),
            (Peer::Computer(0), "computer 0"),
            (Peer::Team(0), "home"),
            (Peer::Team(7), "team 7"),
            (Peer::Everybody, "everybody"),
        ];
        for (peer, name) in names {
            assert_eq!(peer.to_string(), name);
            assert_eq!(name.parse(), Ok(peer));
        }
        for text in ["away:3", "away-3", "Away3", " away 3 "] {
            assert_eq!(text.parse(), Ok(Peer::Robot { team: 1, number: 3 }), "{text}");
        }
    }

    #[test]
    fn what_is_nobody_is_refused_with_its_text() {
        for text in
            ["", "guest 1", "home 256", "home +1", "home 1 2", "computer", "everybody 1", "team", "höme 1"]
        {
            assert_eq!(text.parse::<Peer>(), Err(NotAPeer(text.to_owned())));
        }
    }

    #[test]
    fn a_message_to_a_group_is_meant_for_its_members_only() {
        let (home, away) = (Peer::Robot { team: 0, number: 3 }, Peer::Robot { team: 1, number: 3 });
        let computer = Peer::Computer(3);
        let meant = |group: Peer| [home, away, computer].map(|one| group.includes(one));
        assert_eq!(meant(Peer::Team(1)), [false, true, false]);
        assert_eq!(meant(Peer::Everybody), [true, true, true]);
        assert_eq!(meant(home), [true, false, false]);
        assert!(!Peer::Everybody.includes(Peer::Team(0)));
    }

    #[test]
    fn modules_and_types_without_a_name_are_shown_by_number() {
        let address = Address { peer: Peer::Computer(1), module: Module::CHAOS_MANAGER };
        assert_eq!(address.to_string(), "computer 1, ChaosManager");
        assert_eq!(
            (Module(200).to_string(), DataType(1024).to_string()),
            ("module 200".into(), "type 1024".into())
        );
    }

    proptest! {
        #[test]
        fn every_peer_reads_back_also_from_a_file(peer in peer()) {
            prop_assert_eq!(peer.to_string().parse(), Ok(peer));
            let written = ron::to_string(&peer).unwrap();
            prop_assert_eq!(ron::from_str::<Peer>(&written).unwrap(), peer);
        }
    }
}
