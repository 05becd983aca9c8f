//! The judge of a scenario: looks at every tick and says which expectations were met.

use bevy::prelude::Vec2;

use super::check::Scenario;
use super::condition::Expectation;
use super::scene::Scene;
use super::watch::{Watch, ticks};

/// Follows one run of a scenario.
#[derive(Clone, Debug)]
pub struct Judge {
    /// Length of a tick, s.
    dt: f32,
    cases: Vec<Case>,
    /// m in the pitch frame
    ball_at_start: Vec2,
    /// The tick observed last.
    tick: u64,
}

/// What came of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// In the order of the file.
    pub failures: Vec<Failure>,
}

impl Verdict {
    /// Whether all expectations were met.
    pub fn passed(&self) -> bool {
        self.failures.is_empty()
    }

    /// Whether the expectation with these words was met.
    pub fn met(&self, expectation: &str) -> bool {
        self.failures.iter().all(|failure| failure.expectation != expectation)
    }
}

/// An expectation that was not met.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// In plain words.
    pub expectation: String,
    /// When that was settled.
    pub tick: u64,
    /// When, s since the scenario began.
    pub seconds: f64,
    /// The values seen.
    pub reason: String,
}

/// An expectation under observation.
#[derive(Clone, Debug)]
struct Case {
    words: String,
    kind: Demand,
    /// The ticks that count, both included.
    first: u64,
    last: u64,
    watch: Watch,
    state: CaseState,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Demand {
    Eventually,
    Always,
    Never,
}

#[derive(Clone, Debug)]
enum CaseState {
    Open,
    Met,
    Failed(Failure),
}

impl Judge {
    /// A judge for one run with the ball at one of the scenario's places and ticks of `dt` seconds.
    pub fn new(scenario: &Scenario, ball_at_start: Vec2, dt: f32) -> Judge {
        let end = scenario.ticks(dt);
        let cases = scenario.expect.iter().map(|expectation| Case::new(expectation, dt, end)).collect();
        Judge { dt, cases, ball_at_start, tick: 0 }
    }

    /// Where the ball was at the start of the run, m in the pitch frame.
    pub fn ball_at_start(&self) -> Vec2 {
        self.ball_at_start
    }

    /// Looks at the next tick.
    pub fn observe(&mut self, scene: &Scene) {
        self.tick = scene.tick;
        let seconds = self.seconds();
        for case in self.cases.iter_mut().filter(|case| matches!(case.state, CaseState::Open)) {
            case.observe(scene, seconds);
        }
    }

    /// Whether nothing can change any more; true after the scenario's last tick at the latest.
    pub fn is_decided(&self) -> bool {
        !self.cases.iter().any(|case| matches!(case.state, CaseState::Open))
    }

    /// Each expectation in plain words with how it stands: met, failed or, as `None`, still open.
    pub fn standings(&self) -> impl Iterator<Item = (&str, Option<bool>)> {
        self.cases.iter().map(|case| {
            let met = match case.state {
                CaseState::Open => None,
                CaseState::Met => Some(true),
                CaseState::Failed(_) => Some(false),
            };
            (case.words.as_str(), met)
        })
    }

    /// The verdict as it stands: what is still open has failed.
    pub fn verdict(&self) -> Verdict {
        let failures = self.cases.iter().filter_map(|case| match &case.state {
            CaseState::Met => None,
            CaseState::Failed(failure) => Some(failure.clone()),
            CaseState::Open => Some(Failure {
                expectation: case.words.clone(),
                tick: self.tick,
                seconds: self.seconds(),
                reason: "the run was over before this could be told".to_owned(),
            }),
        });
        Verdict { failures: failures.collect() }
    }

    fn seconds(&self) -> f64 {
        self.tick as f64 * f64::from(self.dt)
    }
}

impl Case {
    /// `end` is the scenario's last tick.
    fn new(expectation: &Expectation, dt: f32, end: u64) -> Case {
        let at = |seconds: f32| ticks(seconds, dt);
        let span = |from: f32, until: Option<f32>| (at(from), until.map_or(end, at).min(end));
        let watched = expectation.with_one_seed();
        let (kind, (first, last)) = match watched {
            Expectation::Eventually { within, after, .. } => {
                (Demand::Eventually, span(*after, Some(after + within)))
            }
            Expectation::Always { from, until, .. } => (Demand::Always, span(*from, *until)),
            Expectation::Never { from, until, .. } => (Demand::Never, span(*from, *until)),
            // Of one seed it is what must be met that is watched, so the last of these does not occur.
            Expectation::Finally { .. } | Expectation::Probability { .. } => (Demand::Always, (end, end)),
        };
        let watch = Watch::new(expectation.what(), dt);
        Case { words: expectation.to_string(), kind, first, last, watch, state: CaseState::Open }
    }

    fn observe(&mut self, scene: &Scene, seconds: f64) {
        let holds = self.watch.observe(scene);
        if scene.tick < self.first {
            return;
        }
        let is_last = scene.tick >= self.last;
        self.state = match (self.kind, holds) {
            (Demand::Eventually, true) => CaseState::Met,
            (Demand::Eventually, false) if !is_last => CaseState::Open,
            (Demand::Always, true) | (Demand::Never, false) => {
                if is_last {
                    CaseState::Met
                } else {
                    CaseState::Open
                }
            }
            _ => CaseState::Failed(Failure {
                expectation: self.words.clone(),
                tick: scene.tick,
                seconds,
                reason: self.watch.why(scene),
            }),
        };
    }
}

#[cfg(test)]
mod tests;
