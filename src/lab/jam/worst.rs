//! The worst radio as something that plays again.

use std::ops::Range;

use crate::comms::radio::FaultRule;
use crate::game::MatchPlan;
use crate::game::requests::{RadioChange, Request};
use crate::lab::replay::ReplayHeader;
use crate::lab::scenario::{Expectation, ScenarioFile, Seeds};

/// What a match was read from.
pub(super) enum JamOrigin {
    /// As it is written, its variant laid over it.
    Scenario(Box<ScenarioFile>),
    Replay(Box<ReplayHeader>),
}

/// The worst radio as something that plays again.
pub enum WorstCase {
    /// The text of a scenario that fails.
    Scenario(String),
    /// A match to be recorded: what it is of, its plan, and how many ticks it is played.
    Replay(Box<(ReplayHeader, MatchPlan)>, u64),
}

impl WorstCase {
    /// The scenario with these rules, a seed, and what must not be.
    pub(super) fn of_scenario(
        file: &ScenarioFile,
        rules: Vec<FaultRule>,
        (seed, forbidden): (u64, Expectation),
    ) -> Option<WorstCase> {
        let mut worst = ScenarioFile {
            seeds: Some(Seeds::List(vec![seed])),
            may_fail: None,
            depends_on: None,
            expect: vec![forbidden],
            ..file.clone()
        };
        worst.faults.extend(rules);
        worst.text().ok().map(WorstCase::Scenario)
    }

    /// The match with these rules from the first of these ticks on, to the last.
    pub(super) fn of_replay(
        header: &ReplayHeader,
        plan: &MatchPlan,
        ticks: &Range<u64>,
        rules: Vec<FaultRule>,
    ) -> WorstCase {
        let (mut header, mut plan) = (header.clone(), plan.clone());
        header.branched = Some(ticks.start);
        // Requests are carried out in the order of their ticks.
        let later = plan.script.partition_point(|(tick, _)| *tick < ticks.start);
        let faults = rules.into_iter().map(|rule| Request::Radio(RadioChange::Fault(rule)));
        plan.script.splice(later..later, faults.map(|fault| (ticks.start, fault)));
        WorstCase::Replay(Box::new((header, plan)), ticks.end)
    }
}
