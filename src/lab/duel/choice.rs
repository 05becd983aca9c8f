//! What a person chooses of a duel.

use std::str::FromStr;

use crate::strategy::MAX_PLAYERS;

/// How many robots each side has, as people write it: `2v1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DuelTeams(pub [u8; 2]);

impl FromStr for DuelTeams {
    type Err = String;

    fn from_str(text: &str) -> Result<DuelTeams, String> {
        let number = |text: &str| {
            text.parse::<u8>().ok().filter(|robots| (1..=MAX_PLAYERS).contains(&usize::from(*robots)))
        };
        let numbers =
            text.split_once('v').and_then(|(first, second)| Some([number(first)?, number(second)?]));
        numbers
            .map(DuelTeams)
            .ok_or_else(|| format!("must be two numbers of robots, 1 to {MAX_PLAYERS}, such as 2v1"))
    }
}

/// What a person chooses of a duel.
#[derive(Clone, Debug, PartialEq)]
pub struct DuelChoice {
    /// The match whose pitch, ball, robots and radio the duel has.
    pub file: Option<String>,
    /// The first strategy; that of the match's home team if not given.
    pub home: Option<String>,
    /// The second strategy; that of the match's away team if not given.
    pub away: Option<String>,
    /// How many robots each side has.
    pub teams: DuelTeams,
    /// Trials; even, since each start is played on both sides.
    pub trials: u32,
    /// The seed of the first trial.
    pub seed: u64,
    /// How long a trial goes on, s.
    pub seconds: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_robots_are_read_as_people_write_them() {
        assert_eq!("2v1".parse(), Ok(DuelTeams([2, 1])));
        for text in ["2", "2v", "v1", "0v1", "1v12", "2 v 1", "-1v1", "1v1v1"] {
            assert!(text.parse::<DuelTeams>().unwrap_err().contains("2v1"), "{text}");
        }
    }
}
