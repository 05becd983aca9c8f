//! The table: by strategy, machine and state, for people and as a file.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::data::{Bound, DataError, Fault, Source, Validate};

/// How often the robots of some matches were in each state and took each transition, by the names of their strategies' files.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coverage {
    /// By the strategy's file.
    pub strategies: BTreeMap<String, StrategyCoverage>,
}

/// Of one strategy.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrategyCoverage {
    /// How many times a team played it: once in a match, or twice if both did.
    pub played: u64,
    /// By the machine's name.
    pub machines: BTreeMap<String, MachineCoverage>,
}

/// Of one machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MachineCoverage {
    /// By the state's name, those that hold others as well.
    pub states: BTreeMap<String, StateCoverage>,
}

/// Of one state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateCoverage {
    /// How often a robot came to it.
    pub entered: u64,
    /// How long robots were in it, all together, s.
    pub seconds: f64,
    /// The ways out of it, in the order of the strategy's file.
    pub transitions: Vec<TransitionCoverage>,
}

/// Of one transition.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransitionCoverage {
    /// Its condition, for people.
    pub when: String,
    /// The state that it names.
    pub go: String,
    /// How often it was taken.
    pub taken: u64,
}

impl Coverage {
    /// Reads a file that was written before.
    ///
    /// # Errors
    /// If it cannot be read, or is no table of coverage.
    pub fn read(path: &Path) -> Result<Coverage, DataError> {
        Source::read(path)?.parse_sound()
    }

    /// The table as a file: the same counts are the same bytes.
    ///
    /// # Errors
    /// If it cannot be written as RON.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        let form = ron::ser::PrettyConfig::new().depth_limit(9).struct_names(false);
        Ok(ron::ser::to_string_pretty(self, form)? + "\n")
    }

    /// Adds what another one has counted. Where a transition has changed, its condition is that of the last one.
    pub fn add(&mut self, other: &Coverage) {
        for (name, strategy) in &other.strategies {
            let sum = self.strategies.entry(name.clone()).or_default();
            sum.played += strategy.played;
            for (name, machine) in &strategy.machines {
                let sum = sum.machines.entry(name.clone()).or_default();
                machine
                    .states
                    .iter()
                    .for_each(|(name, state)| sum.states.entry(name.clone()).or_default().add(state));
            }
        }
    }

    /// What was counted of a machine.
    pub fn machine(&self, strategy: &str, machine: &str) -> Option<&MachineCoverage> {
        self.strategies.get(strategy)?.machines.get(machine)
    }
}

impl StateCoverage {
    fn add(&mut self, other: &StateCoverage) {
        self.entered += other.entered;
        // Hundredths, so that sums do not depend on their order.
        self.seconds = ((self.seconds + other.seconds) * 100.0).round() / 100.0;
        self.transitions
            .resize(self.transitions.len().max(other.transitions.len()), TransitionCoverage::default());
        for (sum, way) in self.transitions.iter_mut().zip(&other.transitions) {
            let taken = sum.taken + way.taken;
            *sum = TransitionCoverage { taken, ..way.clone() };
        }
    }

    fn ways_taken(&self) -> usize {
        self.transitions.iter().filter(|way| way.taken > 0).count()
    }
}

impl Validate for Coverage {
    fn validate(&self) -> Result<(), Fault> {
        for (strategy, coverage) in &self.strategies {
            let at = format!("strategies.{strategy}");
            Bound::COUNT.check(&format!("{at}.played"), coverage.played as f32)?;
            for (machine, coverage) in &coverage.machines {
                for (state, coverage) in &coverage.states {
                    let at = format!("{at}.machines.{machine}.states.{state}");
                    Bound::COUNT.check(&format!("{at}.entered"), coverage.entered as f32)?;
                    Bound::COUNT.check(&format!("{at}.seconds"), coverage.seconds as f32)?;
                    for (number, way) in coverage.transitions.iter().enumerate() {
                        Bound::COUNT.check(&format!("{at}.transitions.{number}.taken"), way.taken as f32)?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// A table for each strategy, and what was never reached in it; no line break at the end.
impl Display for Coverage {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.strategies.is_empty() {
            return f.write_str("coverage: no scenario was played");
        }
        for (number, (name, strategy)) in self.strategies.iter().enumerate() {
            if number > 0 {
                writeln!(f)?;
            }
            strategy.write(name, f)?;
        }
        Ok(())
    }
}

impl StrategyCoverage {
    /// Every state with the names of its machine and of itself.
    fn states(&self) -> impl Iterator<Item = (&str, &str, &StateCoverage)> {
        self.machines.iter().flat_map(|(machine, coverage)| {
            coverage.states.iter().map(move |(state, coverage)| (machine.as_str(), state.as_str(), coverage))
        })
    }

    fn write(&self, name: &str, f: &mut Formatter<'_>) -> fmt::Result {
        let states = self.states().count();
        let entered = self.states().filter(|(.., state)| state.entered > 0).count();
        let ways: usize = self.states().map(|(.., state)| state.transitions.len()).sum();
        let taken: usize = self.states().map(|(.., state)| state.ways_taken()).sum();
        let played = if self.played == 1 { "once".into() } else { format!("{} times", self.played) };
        write!(f, "{name}, played {played}: ")?;
        write!(f, "{entered} of {states} states entered, {taken} of {ways} transitions taken")?;
        let width = self
            .states()
            .map(|(machine, state, _)| machine.chars().count() + 1 + state.chars().count())
            .max();
        let width = width.unwrap_or(0);
        write!(f, "\n      {:width$}  {:>9}  {:>11}  {:>10}", "state", "entered", "time", "ways taken")?;
        for (machine, state, coverage) in self.states() {
            let StateCoverage { entered, seconds, transitions } = coverage;
            let ways = format!("{} of {}", coverage.ways_taken(), transitions.len());
            let path = format!("{machine}/{state}");
            write!(f, "\n      {path:width$}  {entered:>9}  {seconds:>9.1} s  {ways:>10}")?;
        }
        for (machine, state, coverage) in self.states() {
            if coverage.entered == 0 {
                write!(f, "\n      never entered: {machine}/{state}")?;
                continue;
            }
            for (number, way) in coverage.transitions.iter().enumerate().filter(|(_, way)| way.taken == 0) {
                write!(
                    f,
                    "\n      never taken: {machine}/{state} {}: {} > {}",
                    number + 1,
                    way.when,
                    way.go
                )?;
            }
        }
        Ok(())
    }
}
