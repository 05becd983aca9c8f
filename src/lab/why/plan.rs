//! Asking why.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::path::Path;

use super::candidates::{Candidate, of_crashes, of_packets};
use super::finding::{WhyFinding, WhyReport};
use super::play::{ReplayedStretch, SPACING};
use super::standing::MatchStanding;
use crate::clock::{Clock, TICK_HZ};
use crate::comms::radio::RadioRecord;
use crate::data::DataError;
use crate::game::requests::Request;
use crate::game::{Match, MatchPlan};
use crate::lab::all_cores::on_all_cores;
use crate::lab::export::ForkPlan;
use crate::lab::replay::{Recorder, Replay, ReplayHeader};
use crate::state::Snapshot;

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhyChoice {
    /// After which tick it is to be explained how things stand; after the last one, if not given.
    pub at: Option<u64>,
    /// How many seconds before that things are changed, 60 at most: so long the radio remembers.
    pub horizon: f32,
    /// With how many other dice each difference is tried.
    pub seeds: u32,
    /// How many changes are tried at most, those nearest to the tick in question.
    pub most: usize,
}

/// A recorded match, and what is asked of it.
pub struct WhyPlan {
    choice: WhyChoice,
    header: ReplayHeader,
    plan: MatchPlan,
    at: u64,
}

impl WhyPlan {
    /// Reads the match from its recording.
    ///
    /// # Errors
    /// If the recording cannot be played, or does not go as far as is asked.
    pub fn read(replay: &Replay, choice: WhyChoice) -> Result<WhyPlan, DataError> {
        let (plan, _) = replay.plans()?;
        let last = replay.ticks().saturating_sub(1);
        let at = choice.at.unwrap_or(last);
        if at > last {
            return Err(DataError::new("--at", format!("the recording ends with tick {last}")));
        }
        Ok(WhyPlan { choice, header: replay.header.clone(), plan, at })
    }

    /// Of a match that is played now, with all requests so far.
    ///
    /// # Errors
    /// The first fault of its files; they were sound when it began.
    pub fn of(
        header: &ReplayHeader,
        script: Vec<(u64, Request)>,
        at: u64,
        choice: WhyChoice,
    ) -> Result<WhyPlan, DataError> {
        let (plan, _) = header.recorded.plans(&header.assets())?;
        Ok(WhyPlan { choice, header: header.clone(), plan: MatchPlan { script, ..plan }, at })
    }

    /// Plays the match up to the tick in question, and then the stretch before it with each change on all cores; or until it is
    /// to stop. Says first how many changes there are, then after each how many were tried.
    pub fn run(&self, mut begins: impl FnMut(usize), mut goes_on: impl FnMut(u32) -> bool) -> WhyReport {
        let mut game = Match::new(&self.plan);
        let horizon = (self.choice.horizon / game.clock().dt) as u64;
        let from = self.at.saturating_sub(horizon);
        let snapshots = copies(&mut game, from, self.at);
        let outcome = MatchStanding::of(game.world_mut());
        let dt = game.clock().dt;
        let mut candidates = self.candidates(&game, from);
        let left_out = candidates.len().saturating_sub(self.choice.most);
        candidates.truncate(self.choice.most);
        begins(candidates.len());
        let stretch = ReplayedStretch { plan: &self.plan, at: self.at, snapshots };
        let (mut findings, mut tried) = (Vec::new(), 0);
        let Ok(()) = on_all_cores(
            candidates.iter(),
            || Match::new(&self.plan),
            |game, candidate| self.finding(&stretch, game, &outcome, candidate),
            |found| {
                tried += 1;
                findings.extend(found);
                Ok::<_, Infallible>(goes_on(tried))
            },
        );
        let (tried, seeds) = (tried as usize, self.choice.seeds);
        let interrupted = tried < candidates.len();
        let mut report = WhyReport { outcome, dt, tried, left_out, seeds, interrupted, findings };
        report.rank();
        report
    }

    /// Those nearest to the tick in question first.
    fn candidates(&self, game: &Match, from: u64) -> Vec<Candidate> {
        let radio = game.world().resource::<RadioRecord>();
        let mut candidates = of_packets(radio, from, game.clock().dt);
        candidates.extend(of_crashes(&self.plan.script, from, self.at));
        candidates.retain(|candidate| candidate.tick <= self.at);
        candidates.sort_by_key(|candidate| std::cmp::Reverse(candidate.tick));
        candidates
    }

    fn finding(
        &self,
        stretch: &ReplayedStretch,
        game: &mut Match,
        was: &MatchStanding,
        candidate: &Candidate,
    ) -> Option<WhyFinding> {
        let mut play = |change, stirred| stretch.play(game, candidate.tick, change, stirred);
        let difference = play(Some(candidate), None)?.difference(was)?;
        let agrees = |salt: u64| {
            let was = play(None, Some(salt))?;
            play(Some(candidate), Some(salt))?.difference(&was).filter(|other| other.agrees(&difference))
        };
        let agree = (1..=u64::from(self.choice.seeds)).filter_map(agrees).count() as u32;
        Some(WhyFinding { candidate: candidate.clone(), difference, agree })
    }

    /// The match with the change of a finding, up to some seconds after the tick in question.
    pub fn fork(&self, finding: &WhyFinding) -> ForkPlan {
        let WhyFinding { candidate, difference, agree } = finding;
        let clock = Clock::new(TICK_HZ);
        let agreement = match self.choice.seeds {
            0 => String::new(),
            seeds => format!(" ({agree} of {seeds} other dice agree)"),
        };
        ForkPlan {
            title: format!("If {}", candidate.meddling),
            finding: Some(format!("{difference}{agreement}")),
            from: candidate.tick,
            until: self.at + clock.ticks(AFTER) + 1,
            script: candidate.applied(&self.plan.script, clock.dt),
        }
    }

    /// Records the match with the change of a finding, as far as its [fork](WhyPlan::fork) goes.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn record(&self, finding: &WhyFinding, path: &Path) -> std::io::Result<()> {
        let ForkPlan { from, until, script, .. } = self.fork(finding);
        let mut header = self.header.clone();
        header.branched = Some(from);
        let mut recorder = Recorder::create(path, header)?;
        let mut game = Match::new(&MatchPlan { script, ..self.plan.clone() });
        while game.clock().tick < until && !game.is_over() {
            game.tick();
            recorder.note(game.world_mut())?;
        }
        recorder.finish()
    }
}

/// How long a recorded finding goes on after the tick in question, s.
const AFTER: f32 = 10.0;

/// Plays a match until a tick is over, and copies it now and then from another tick on.
fn copies(game: &mut Match, from: u64, at: u64) -> BTreeMap<u64, Snapshot> {
    let mut snapshots = BTreeMap::new();
    while game.clock().tick <= at {
        let tick = game.clock().tick;
        if tick == from || (tick > from && tick.is_multiple_of(SPACING)) {
            snapshots.insert(tick, Snapshot::take(game.world_mut()));
        }
        game.tick();
    }
    snapshots
}
