//! A part of the matches of an experiment, for a machine of its own.

use std::str::FromStr;

use crate::lab::experiment::ExperimentPlan;

/// The matches of every so many seeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shard {
    /// From 0.
    number: u64,
    of: u64,
}

impl Shard {
    /// Whether a match is in this part. Those with one seed stay together.
    pub fn has(self, plan: &ExperimentPlan, row: u64) -> bool {
        row / plan.in_block() % self.of == self.number
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| {
            let (number, of): (u64, u64) = (number.parse().ok()?, of.parse().ok()?);
            (1..=of).contains(&number).then(|| Shard { number: number - 1, of })
        });
        numbers.ok_or_else(|| "must be a part and the number of parts, such as 2/8".into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_counted_from_one() {
        assert_eq!("2/8".parse(), Ok(Shard { number: 1, of: 8 }));
        assert_eq!("1/1".parse(), Ok(Shard { number: 0, of: 1 }));
        for text in ["0/8", "9/8", "1", "1/0", "-1/2", "a/b", "1/2/3"] {
            assert!(text.parse::<Shard>().unwrap_err().contains("2/8"), "{text}");
        }
    }
}
