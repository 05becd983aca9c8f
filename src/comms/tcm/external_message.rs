//! The unit that entities exchange (TeamChaos, section 3): who sends it, from which module, to whom, and data of any type.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// What a module of one entity says to a module of another. Its length is that of its data.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct ExternalMessage {
    /// Never a group: see [`Entity::is_one`].
    pub source: Address,
    pub destination: Address,
    pub data_type: DataType,
    /// As the module that sends it has serialised it.
    pub data: Vec<u8>,
}

/// A module of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Address {
    pub entity: Entity,
    pub module: Module,
}

/// Who speaks or is spoken to. A team and everybody can only be spoken to.
///
/// In files it is written as people write it: `"home 2"`, `"away"`, `"computer 0"` or `"everybody"`; teams besides home, 0,
/// and away, 1, are `"team 2"` with the robots `"team 2 0"` and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Entity {
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

/// A part of an entity's program that sends and receives messages. Touchline's own have names below; the numbers from
/// [`Module::FIRST_FREE`] on belong to users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Module(pub u8);

/// What the data of a message are. Touchline's own types have names below; the numbers from [`DataType::FIRST_FREE`] on
/// belong to users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct DataType(pub u16);

/// A text that names no entity.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is nobody; write `home 2`, `away`, `computer 0` or `everybody`")]
pub struct NotAnEntity(pub String);

impl Entity {
    /// Whether this is a robot or a computer, who can speak, and not a group of them.
    pub fn is_one(self) -> bool {
        matches!(self, Entity::Robot { .. } | Entity::Computer(_))
    }

    /// Whether a message to `self` is meant for `one`.
    pub fn includes(self, one: Entity) -> bool {
        match self {
            Entity::Everybody => one.is_one(),
            Entity::Team(mine) => matches!(one, Entity::Robot { team, .. } if team == mine),
            Entity::Robot { .. } | Entity::Computer(_) => self == one,
        }
    }
}

impl Module {
    pub const WORLD_MODEL: Module = Module(0);
    pub const CLAIMS: Module = Module(1);
    pub const GOALIE: Module = Module(2);
    pub const ROLE_SWAP: Module = Module(3);
    pub const POLICY: Module = Module(4);
    pub const BALL_BOOKING: Module = Module(5);
    pub const CHAOS_MANAGER: Module = Module(6);
    pub const REMOTE_ROBOTS: Module = Module(7);
    pub const FIRST_FREE: Module = Module(128);
}

impl DataType {
    pub const POSITION: DataType = DataType(1);
    pub const HAVE_BALL: DataType = DataType(2);
    pub const GOALIE_NEWS: DataType = DataType(3);
    pub const ROLE_SWAP: DataType = DataType(4);
    pub const VALUES: DataType = DataType(5);
    pub const BOOK: DataType = DataType(6);
    pub const BALL_REPORT: DataType = DataType(7);
    pub const TEXT: DataType = DataType(8);
    pub const FIRST_FREE: DataType = DataType(1024);
}

impl fmt::Display for Entity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Entity::Robot { team: 0, number } => write!(f, "home {number}"),
            Entity::Robot { team: 1, number } => write!(f, "away {number}"),
            Entity::Robot { team, number } => write!(f, "team {team} {number}"),
            Entity::Computer(number) => write!(f, "computer {number}"),
            Entity::Team(0) => f.write_str("home"),
            Entity::Team(1) => f.write_str("away"),
            Entity::Team(team) => write!(f, "team {team}"),
            Entity::Everybody => f.write_str("everybody"),
        }
    }
}

/// Reads what [`Display`](fmt::Display) writes, and also `home:2`, `home-2` or `Home2`.
impl FromStr for Entity {
    type Err = NotAnEntity;

    fn from_str(text: &str) -> Result<Entity, NotAnEntity> {
        let lower = text.trim().to_ascii_lowercase();
        let (word, rest) =
            lower.split_at(lower.find(|c: char| !c.is_ascii_lowercase()).unwrap_or(lower.len()));
        let separators = [' ', ':', '-'];
        let numbers: Option<Vec<u8>> =
            rest.split(separators).filter(|part| !part.is_empty()).map(number).collect();
        match (word, numbers.as_deref()) {
            ("home", Some(&[])) => Ok(Entity::Team(0)),
            ("home", Some(&[number])) => Ok(Entity::Robot { team: 0, number }),
            ("away", Some(&[])) => Ok(Entity::Team(1)),
            ("away", Some(&[number])) => Ok(Entity::Robot { team: 1, number }),
            ("team", Some(&[team])) => Ok(Entity::Team(team)),
            ("team", Some(&[team, number])) => Ok(Entity::Robot { team, number }),
            ("computer", Some(&[number])) => Ok(Entity::Computer(number)),
            ("everybody", Some(&[])) => Ok(Entity::Everybody),
            _ => Err(NotAnEntity(text.to_owned())),
        }
    }
}

/// A number in decimal digits only: `parse` alone would take a plus sign.
fn number(text: &str) -> Option<u8> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok()).flatten()
}

impl TryFrom<String> for Entity {
    type Error = NotAnEntity;

    fn try_from(text: String) -> Result<Entity, NotAnEntity> {
        text.parse()
    }
}

impl From<Entity> for String {
    fn from(entity: Entity) -> String {
        entity.to_string()
    }
}

impl fmt::Display for Module {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match *self {
            Module::WORLD_MODEL => "world model",
            Module::CLAIMS => "claims",
            Module::GOALIE => "goalie",
            Module::ROLE_SWAP => "role swap",
            Module::POLICY => "policy",
            Module::BALL_BOOKING => "ball booking",
            Module::CHAOS_MANAGER => "ChaosManager",
            Module::REMOTE_ROBOTS => "remote robots",
            Module(other) => return write!(f, "module {other}"),
        })
    }
}

impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match *self {
            DataType::POSITION => "position",
            DataType::HAVE_BALL => "have-ball",
            DataType::GOALIE_NEWS => "goalie",
            DataType::ROLE_SWAP => "role swap",
            DataType::VALUES => "values",
            DataType::BOOK => "book",
            DataType::BALL_REPORT => "ball report",
            DataType::TEXT => "text",
            DataType(other) => return write!(f, "type {other}"),
        })
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", self.entity, self.module)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn entity() -> impl Strategy<Value = Entity> {
        prop_oneof![
            any::<(u8, u8)>().prop_map(|(team, number)| Entity::Robot { team, number }),
            any::<u8>().prop_map(Entity::Computer),
            any::<u8>().prop_map(Entity::Team),
            Just(Entity::Everybody),
        ]
    }

    #[test]
    fn entities_are_written_and_read_as_people_write_them() {
        let names = [
            (Entity::Robot { team: 0, number: 2 }, "home 2"),
            (Entity::Robot { team: 1, number: 1 }, "away 1"),
            (Entity::Robot { team: 2, number: 5 }, "team 2 5"),
            (Entity::Computer(0), "computer 0"),
            (Entity::Team(0), "home"),
            (Entity::Team(7), "team 7"),
            (Entity::Everybody, "everybody"),
        ];
        for (entity, name) in names {
            assert_eq!(entity.to_string(), name);
            assert_eq!(name.parse(), Ok(entity));
        }
        for text in ["away:3", "away-3", "Away3", " away 3 "] {
            assert_eq!(text.parse(), Ok(Entity::Robot { team: 1, number: 3 }), "{text}");
        }
    }

    #[test]
    fn what_is_nobody_is_refused_with_its_text() {
        for text in
            ["", "guest 1", "home 256", "home +1", "home 1 2", "computer", "everybody 1", "team", "höme 1"]
        {
            assert_eq!(text.parse::<Entity>(), Err(NotAnEntity(text.to_owned())));
        }
    }

    #[test]
    fn a_message_to_a_group_is_meant_for_its_members_only() {
        let (home, away) = (Entity::Robot { team: 0, number: 3 }, Entity::Robot { team: 1, number: 3 });
        let computer = Entity::Computer(3);
        let meant = |group: Entity| [home, away, computer].map(|one| group.includes(one));
        assert_eq!(meant(Entity::Team(1)), [false, true, false]);
        assert_eq!(meant(Entity::Everybody), [true, true, true]);
        assert_eq!(meant(home), [true, false, false]);
        assert!(!Entity::Everybody.includes(Entity::Team(0)));
    }

    #[test]
    fn modules_and_types_without_a_name_are_shown_by_number() {
        let address = Address { entity: Entity::Computer(1), module: Module::CHAOS_MANAGER };
        assert_eq!(address.to_string(), "computer 1, ChaosManager");
        assert_eq!(
            (Module(200).to_string(), DataType(1024).to_string()),
            ("module 200".into(), "type 1024".into())
        );
    }

    proptest! {
        #[test]
        fn every_entity_reads_back_also_from_a_file(entity in entity()) {
            prop_assert_eq!(entity.to_string().parse(), Ok(entity));
            let written = ron::to_string(&entity).unwrap();
            prop_assert_eq!(ron::from_str::<Entity>(&written).unwrap(), entity);
        }
    }
}
