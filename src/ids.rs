//! The names of things: the two teams and their robots, with a total order that every loop whose order matters uses, and the mark of
//! what belongs to a match.

use std::fmt;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

/// One of the two teams of a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, Reflect)]
pub enum Team {
    /// The team that is named first.
    Home,
    /// The other team.
    Away,
}

impl Team {
    /// Both teams, home first.
    pub const BOTH: [Team; 2] = [Team::Home, Team::Away];

    /// The other team.
    pub fn opponent(self) -> Team {
        match self {
            Team::Home => Team::Away,
            Team::Away => Team::Home,
        }
    }

    /// 0 for home, 1 for away: the place of this team in arrays of two.
    pub fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Team {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Team::Home => "home",
            Team::Away => "away",
        })
    }
}

/// A robot's number within its team.
pub type PlayerNumber = u8;

/// A robot's team and its number on the shirt, counted from 0 as in the Hammerheads' messages (figure 3).
///
/// The derived order, home before away and then by number, is the order of every loop over robots. In files it is written
/// as people write it: `"home 2"`.
#[derive(
    Component, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, Reflect,
)]
/// One robot of a match.
#[component(immutable)]
#[serde(try_from = "String", into = "String")]
pub struct RobotId {
    /// Its team.
    pub team: Team,
    /// Its number in the team, from 0.
    pub number: PlayerNumber,
}

impl RobotId {
    /// The robot of this number.
    pub const fn new(team: Team, number: PlayerNumber) -> RobotId {
        RobotId { team, number }
    }
}

impl fmt::Display for RobotId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.team, self.number)
    }
}

/// Reads `home 2`, `home:2` or `away2`.
impl std::str::FromStr for RobotId {
    type Err = String;

    fn from_str(text: &str) -> Result<RobotId, String> {
        let expected = || format!("`{text}` is no robot; write a team and a number, such as `away:3`");
        let lower = text.to_lowercase();
        let (team, rest) = if let Some(rest) = lower.strip_prefix("home") {
            (Team::Home, rest)
        } else if let Some(rest) = lower.strip_prefix("away") {
            (Team::Away, rest)
        } else {
            return Err(expected());
        };
        let digits = rest.trim_start_matches([' ', ':', '-']);
        // `parse` alone would take a plus sign.
        let number = digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse().ok());
        Ok(RobotId { team, number: number.flatten().ok_or_else(expected)? })
    }
}

impl TryFrom<String> for RobotId {
    type Error = String;

    fn try_from(text: String) -> Result<RobotId, String> {
        text.parse()
    }
}

impl From<RobotId> for String {
    fn from(id: RobotId) -> String {
        id.to_string()
    }
}

/// On every entity that belongs to the match being played and goes with it.
#[derive(Component, Clone, Copy, Debug, Default)]
#[component(immutable)]
pub struct MatchEntity;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_are_ordered_home_first_then_by_number() {
        let mut ids = [RobotId::new(Team::Away, 0), RobotId::new(Team::Home, 3), RobotId::new(Team::Home, 1)];
        ids.sort();
        assert_eq!(ids.iter().map(RobotId::to_string).collect::<Vec<_>>(), ["home 1", "home 3", "away 0"]);
    }

    #[test]
    fn a_robot_is_read_from_what_a_person_types() {
        for text in ["away:3", "away 3", "Away3"] {
            assert_eq!(text.parse(), Ok(RobotId::new(Team::Away, 3)));
        }
        for text in ["guest 1", "home", "home +1", "home 256"] {
            assert!(text.parse::<RobotId>().unwrap_err().contains("away:3"), "{text}");
        }
    }
}
