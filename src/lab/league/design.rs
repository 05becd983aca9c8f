//! A league as the design of an experiment.

use crate::lab::experiment::{
    DesignChange, ExperimentFile, Factor, FactorLevels, Metric, NamedLevel, SeedBlocks,
};

/// The name of the only factor of a league.
pub const PAIRS: &str = "pair";

/// What a person chooses of a league.
#[derive(Clone, Debug, PartialEq)]
pub struct LeagueChoice {
    /// The strategies, as they are named.
    pub strategies: Vec<String>,
    /// The match file; that of an ordinary match if not given.
    pub file: Option<String>,
    /// Minutes of a half; those of the match if not given.
    pub half_minutes: Option<f32>,
    /// The first seed.
    pub first_seed: u64,
    /// How many seeds each pair plays, each on both sides.
    pub seeds: u32,
}

impl LeagueChoice {
    /// The pairs by the places of their strategies, in the order of the treatments.
    pub fn pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        let number = self.strategies.len();
        (0..number).flat_map(move |first| (first + 1..number).map(move |second| [first, second]))
    }

    /// The experiment that plays it.
    pub fn design(&self) -> ExperimentFile {
        let level = |[first, second]: [usize; 2]| {
            let [first, second] = [first, second].map(|place| self.strategies[place].clone());
            NamedLevel {
                name: format!("{first} against {second}"),
                changes: vec![DesignChange::Home(first), DesignChange::Away(second)],
            }
        };
        let common = self.file.clone().map(DesignChange::Match).into_iter();
        ExperimentFile {
            name: "League".into(),
            description: "Every strategy against every other.".into(),
            common: common.chain(self.half_minutes.map(DesignChange::HalfMinutes)).collect(),
            factors: vec![Factor {
                name: PAIRS.into(),
                levels: FactorLevels::Named(self.pairs().map(level).collect()),
            }],
            blocks: SeedBlocks { first: self.first_seed, number: self.seeds },
            swap_sides: true,
            until: None,
            metrics: vec![Metric::Points, Metric::GoalDifference],
            claims: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everybody_plays_everybody_once_on_either_side() {
        let choice = LeagueChoice {
            strategies: ["a", "b", "c"].map(str::to_owned).into(),
            file: None,
            half_minutes: Some(2.0),
            first_seed: 7,
            seeds: 5,
        };
        assert!(choice.pairs().eq([[0, 1], [0, 2], [1, 2]]));
        let design = choice.design();
        assert_eq!(design.treatments(), 3);
        assert_eq!(design.factors[0].levels.names(), ["a against b", "a against c", "b against c"]);
        assert!(design.swap_sides);
        assert_eq!(design.common, [DesignChange::HalfMinutes(2.0)]);
    }
}
