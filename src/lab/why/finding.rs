//! What came otherwise.

use std::fmt;

use serde::Serialize;

use super::candidates::{Candidate, Meddling};
use super::standing::{MatchStanding, StandingDifference};

/// A change that makes a difference.
#[derive(Clone, Debug, PartialEq)]
pub struct WhyFinding {
    /// What was changed.
    pub candidate: Candidate,
    /// What then comes otherwise.
    pub difference: StandingDifference,
    /// With how many of the stirred dice it comes otherwise in the same way.
    pub agree: u32,
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct WhyReport {
    /// What the match has come to.
    pub outcome: MatchStanding,
    /// Seconds in a tick.
    pub dt: f32,
    /// How many changes were tried.
    pub tried: usize,
    /// How many were left out, farthest from the moment in question.
    pub left_out: usize,
    /// With how many other dice each was played, besides the match's own.
    pub seeds: u32,
    /// Whether a person ended it before all were tried.
    pub interrupted: bool,
    /// Those that make a difference, the weightiest first.
    pub findings: Vec<WhyFinding>,
}

/// A finding for machines.
#[derive(Serialize)]
struct FindingRow<'a> {
    tick: u64,
    seconds: f32,
    change: &'a Meddling,
    then: String,
    difference: &'a StandingDifference,
    agree: u32,
    of: u32,
}

impl WhyReport {
    fn row<'a>(&self, finding: &'a WhyFinding) -> FindingRow<'a> {
        FindingRow {
            tick: finding.candidate.tick,
            seconds: finding.candidate.tick as f32 * self.dt,
            change: &finding.candidate.meddling,
            then: finding.difference.to_string(),
            difference: &finding.difference,
            agree: finding.agree,
            of: self.seeds,
        }
    }

    pub(super) fn rank(&mut self) {
        let weight =
            |finding: &WhyFinding| (finding.difference.weight(), finding.agree, finding.candidate.tick);
        self.findings.sort_by_key(|finding| std::cmp::Reverse(weight(finding)));
    }
}

impl Serialize for WhyReport {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Report<'a> {
            tick: u64,
            score: [u32; 2],
            tried: usize,
            left_out: usize,
            interrupted: bool,
            findings: Vec<FindingRow<'a>>,
        }
        let findings = self.findings.iter().map(|finding| self.row(finding)).collect();
        let MatchStanding { tick, score, .. } = self.outcome;
        let (tried, left_out, interrupted) = (self.tried, self.left_out, self.interrupted);
        Report { tick, score, tried, left_out, interrupted, findings }.serialize(serializer)
    }
}

impl fmt::Display for WhyReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MatchStanding { tick, score: [home, away], .. } = self.outcome;
        let seconds = tick as f32 * self.dt;
        writeln!(f, "After tick {tick} ({seconds:.1} s) it is {home} : {away}.")?;
        let stopped = if self.interrupted { ", until it was interrupted" } else { "" };
        write!(f, "{} changes tried{stopped}, {} make a difference", self.tried, self.findings.len())?;
        if self.left_out > 0 {
            write!(f, "; {} that lie farther back were left out", self.left_out)?;
        }
        writeln!(f, ".")?;
        for (place, WhyFinding { candidate, difference, agree }) in self.findings.iter().enumerate() {
            let at = candidate.tick as f32 * self.dt;
            write!(f, "{:>4}  {at:>7.2} s  {}: {difference}", place + 1, candidate.meddling)?;
            if self.seeds > 0 {
                write!(f, " ({agree} of {} other dice agree)", self.seeds)?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
