//! From a scenario, or from a moment of a recorded match, to the interference that does harm to it.

use std::ops::Range;
use std::path::PathBuf;

use super::harm::Harm;
use super::report::JamReport;
use super::search::{Interfered, JamEnd, search};
use super::worst::{JamOrigin, WorstCase};
use crate::clock::Clock;
use crate::comms::radio::{Act, FaultRule, Which, just_before};
use crate::data::{AssetFolder, DataError};
use crate::game::{Match, MatchPlan};
use crate::lab::replay::Replay;
use crate::lab::scenario::{ScenarioFile, ScenarioPlan, ScenarioRef};
use crate::state::Snapshot;

/// What is played with other radios.
#[derive(Clone, Debug, PartialEq)]
pub enum JamStart {
    /// A scenario.
    Scenario(ScenarioRef),
    /// A recorded match.
    Replay(PathBuf),
}

/// What is to be done.
#[derive(Clone, Debug, PartialEq)]
pub struct JamChoice {
    /// What is played.
    pub start: JamStart,
    /// Packets sent before this are left alone, s.
    pub at: f64,
    /// It is played for so long from then on, s. If not given, a scenario to its end and a recorded match for 20 s.
    pub seconds: Option<f64>,
    /// The seed of a scenario's dice; its first one if not given.
    pub seed: Option<u64>,
    /// How many packets may be interfered with.
    pub budget: usize,
    /// What is to come of it.
    pub harm: Harm,
    /// What may be done to each packet.
    pub acts: Vec<Act>,
    /// Also positions, claims and other news, and not only steps of a protocol.
    pub all_kinds: bool,
    /// Without the faults that a scenario has itself.
    pub without_faults: bool,
    /// How many sets of packets of each size are led on to the next.
    pub beam: usize,
}

/// A match whose radio can be made worse.
pub struct JamPlan {
    pub(super) choice: JamChoice,
    pub(super) origin: JamOrigin,
    pub(super) plan: MatchPlan,
    /// Those in which packets are interfered with and harm is looked for.
    pub(super) ticks: Range<u64>,
    /// Before the first of them, if that is not where the match begins.
    pub(super) snapshot: Option<Snapshot>,
}

/// More than this is not remembered of what was sent, s.
const LONGEST: f64 = 55.0;
/// A recorded match is played on for so long, s.
const OF_REPLAY: f64 = 20.0;

impl JamPlan {
    /// Reads the scenario or the recording, and plays it up to where the search begins.
    ///
    /// # Errors
    /// If it cannot be read, or takes too long.
    pub fn read(assets: &AssetFolder, choice: &JamChoice) -> Result<JamPlan, DataError> {
        let (origin, mut plan, end) = match &choice.start {
            JamStart::Scenario(scenario) => {
                let (mut file, plan) = read_scenario(assets, scenario, choice.seed)?;
                if choice.without_faults {
                    file.faults.clear();
                }
                let seconds = f64::from(file.seconds.unwrap_or_default());
                (JamOrigin::Scenario(Box::new(file)), plan, seconds)
            }
            JamStart::Replay(path) => {
                let replay = Replay::read(path)?;
                let (plan, _) = replay.plans()?;
                let recorded = replay.ticks() as f64 * f64::from(Clock::default().dt);
                if choice.at > recorded {
                    return Err(DataError::new(path, format!("ends after {recorded:.1} s")));
                }
                (JamOrigin::Replay(Box::new(replay.header)), plan, choice.at + OF_REPLAY)
            }
        };
        if choice.without_faults {
            plan.faults.clear();
        }
        let seconds = choice.seconds.unwrap_or(end - choice.at);
        let faulty = |message: String| Err(DataError::new(choice.start.path(), message));
        if seconds > LONGEST {
            return faulty(format!("takes longer than {LONGEST} s, and jam looks at no more"));
        }
        if seconds <= 0.0 {
            return faulty(format!("ends after {end} s"));
        }
        let mut game = Match::new(&plan);
        let clock = game.clock();
        let in_ticks = |seconds: f64| (seconds / f64::from(clock.dt)).round() as u64;
        let from = in_ticks(choice.at);
        (0..from).for_each(|_| game.tick());
        let snapshot = (from > 0).then(|| Snapshot::take(game.world_mut()));
        let ticks = from..from + in_ticks(seconds);
        Ok(JamPlan { choice: choice.clone(), origin, plan, ticks, snapshot })
    }

    /// Seeks the fewest packets that do harm. `goes_on` is told how many matches were played.
    pub fn run(&self, goes_on: impl FnMut(usize) -> bool) -> JamReport {
        let JamChoice { budget, beam, harm, .. } = self.choice;
        let searched = search(budget, beam, |set| self.play(set), goes_on);
        JamReport::new(self.plan.name.clone(), harm, budget, searched)
    }

    /// What plays the worst radio again; nothing, if there was no harm.
    pub fn worst(&self, report: &JamReport) -> Option<WorstCase> {
        let JamEnd::Harmed { packets, .. } = &report.end else { return None };
        let rules = self.rules(packets);
        match &self.origin {
            JamOrigin::Scenario(file) => {
                let from = just_before(self.ticks.start, Clock::default().dt);
                let because = format!("interfering with {} packets is enough", packets.len());
                let forbidden = self.choice.harm.forbidden(from, because);
                WorstCase::of_scenario(file, rules, (self.plan.seed, forbidden))
            }
            JamOrigin::Replay(header) => Some(WorstCase::of_replay(header, &self.plan, &self.ticks, rules)),
        }
    }

    /// The rules that do this to packets.
    pub(super) fn rules(&self, packets: &[Interfered]) -> Vec<FaultRule> {
        let from = self.ticks.start;
        let counted = (from > 0).then(|| (just_before(from, Clock::default().dt), f32::INFINITY));
        let rule = |packet: &Interfered| FaultRule {
            kind: Some(packet.kind),
            from: Some(packet.from),
            to: Some(packet.to),
            between: counted,
            which: Which::Nth(packet.nth),
            act: packet.act,
        };
        packets.iter().map(rule).collect()
    }
}

impl JamStart {
    fn path(&self) -> &PathBuf {
        match self {
            JamStart::Scenario(scenario) => &scenario.path,
            JamStart::Replay(path) => path,
        }
    }
}

/// A scenario as it is written, its variant laid over it, and its first match.
fn read_scenario(
    assets: &AssetFolder,
    scenario: &ScenarioRef,
    seed: Option<u64>,
) -> Result<(ScenarioFile, MatchPlan), DataError> {
    let read = ScenarioPlan::read(assets, scenario)?;
    let file: ScenarioFile = assets.read(&scenario.path)?.parse()?;
    let variants = file.scenarios().into_iter();
    let mut variants = variants.filter(|(name, _)| *name == read.origin.variant.as_deref());
    let file = variants.next().map_or_else(|| file.clone(), |(_, variant)| variant);
    let seed = seed.or_else(|| read.scenario.seeds.first().copied()).unwrap_or(1);
    Ok((file, read.with_ball_at(read.scenario.first_place(), seed)))
}
