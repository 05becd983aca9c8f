//! From a scenario to the losses that do harm to it.

use std::collections::BTreeMap;

use super::harm::Harm;
use super::report::JamReport;
use super::search::{Interfered, JamEnd, Jammed, search};
use crate::comms::radio::{Act, FaultRule, RadioRecord, Transmission, Which};
use crate::comms::tcm::DataType;
use crate::data::{AssetFolder, DataError};
use crate::game::record::Invariants;
use crate::game::{Match, MatchPlan};
use crate::ids::{RobotId, Team};
use crate::lab::scenario::{Condition, Expectation, ScenarioFile, ScenarioPlan, ScenarioRef, Seeds};

/// What is to be done.
#[derive(Clone, Debug, PartialEq)]
pub struct JamChoice {
    /// The scenario.
    pub scenario: ScenarioRef,
    /// The seed of its dice; its first one if not given.
    pub seed: Option<u64>,
    /// How many packets may be interfered with.
    pub budget: usize,
    /// What is to come of it.
    pub harm: Harm,
    /// Packets may also be this late, s.
    pub delay: Option<f32>,
    /// Also positions, claims and other news, and not only steps of a protocol.
    pub all_kinds: bool,
    /// Without the faults that the scenario has itself.
    pub without_faults: bool,
    /// How many sets of packets of each size are led on to the next.
    pub beam: usize,
}

/// A scenario whose radio can be made worse.
#[derive(Clone, Debug)]
pub struct JamPlan {
    /// As it is written, its variant laid over it.
    file: ScenarioFile,
    plan: MatchPlan,
    ticks: u64,
    choice: JamChoice,
}

/// Longer scenarios send more than is remembered, s.
const LONGEST: f64 = 55.0;

impl JamPlan {
    /// Reads the scenario.
    ///
    /// # Errors
    /// If it cannot be read, or is too long.
    pub fn read(assets: &AssetFolder, choice: &JamChoice) -> Result<JamPlan, DataError> {
        let read = ScenarioPlan::read(assets, &choice.scenario)?;
        let file: ScenarioFile = assets.read(&choice.scenario.path)?.parse()?;
        let variants = file.scenarios().into_iter();
        let mut variants = variants.filter(|(name, _)| *name == read.origin.variant.as_deref());
        let mut file = variants.next().map_or_else(|| file.clone(), |(_, variant)| variant);
        let seed = choice.seed.or_else(|| read.scenario.seeds.first().copied()).unwrap_or(1);
        let mut plan = read.with_ball_at(read.scenario.first_place(), seed);
        if choice.without_faults {
            plan.faults.clear();
            file.faults.clear();
        }
        let game = Match::new(&plan);
        let ticks = read.scenario.ticks(game.clock().dt);
        if ticks as f64 * f64::from(game.clock().dt) > LONGEST {
            return Err(DataError::new(
                &choice.scenario.path,
                format!("takes longer than {LONGEST} s, and jam looks at no more"),
            ));
        }
        Ok(JamPlan { file, plan, ticks, choice: choice.clone() })
    }

    /// Seeks the fewest packets that do harm. `goes_on` is told how many matches were played.
    pub fn run(&self, goes_on: impl FnMut(usize) -> bool) -> JamReport {
        let JamChoice { budget, beam, harm, .. } = self.choice;
        let searched = search(budget, beam, |set| self.play(set), goes_on);
        JamReport::new(self.plan.name.clone(), harm, budget, searched)
    }

    /// The scenario with the worst radio, as the text of a file that fails; nothing, if there was no harm.
    pub fn worst(&self, report: &JamReport) -> Option<String> {
        let JamEnd::Harmed { packets, .. } = &report.end else { return None };
        let what = match self.choice.harm {
            Harm::Broken(invariant) => Condition::Broken { invariant, team: Some(Team::Home) },
            Harm::GoalAgainst => Condition::Goals { team: Team::Away, at_least: Some(1), at_most: None },
        };
        let because = format!("{} lost or late packets are enough", packets.len());
        let mut worst = ScenarioFile {
            seeds: Some(Seeds::List(vec![self.plan.seed])),
            may_fail: None,
            depends_on: None,
            expect: vec![Expectation::Never { what, from: 0.0, until: None, because }],
            ..self.file.clone()
        };
        worst.faults.extend(rules(packets));
        worst.text().ok()
    }

    fn play(&self, set: &[Interfered]) -> Jammed {
        let mut plan = self.plan.clone();
        plan.faults.extend(rules(set));
        let mut game = Match::new(&plan);
        let mut jammed = Jammed::default();
        for _ in 0..self.ticks {
            game.tick();
            if self.is_harmed(&game) {
                jammed.harmed = Some(game.clock().tick);
                break;
            }
        }
        let cover = &game.record().role_cover[Team::Home.index()];
        jammed.severity =
            cover.doubled.longest.max(game.record().bookings[Team::Home.index()].several_go.longest);
        jammed.packets = self.packets(game.world().resource::<RadioRecord>(), set.last());
        jammed
    }

    fn is_harmed(&self, game: &Match) -> bool {
        match self.choice.harm {
            Harm::Broken(invariant) => {
                let broken = &game.world().resource::<Invariants>().broken;
                [Some(Team::Home), None].iter().any(|team| broken.contains_key(&(invariant, *team)))
            }
            Harm::GoalAgainst => game.state().score[Team::Away.index()] > 0,
        }
    }

    /// The packets of home that were sent after the last one that was interfered with.
    fn packets(&self, radio: &RadioRecord, last: Option<&Interfered>) -> Vec<Interfered> {
        let mut counts: BTreeMap<(DataType, RobotId, RobotId), u32> = BTreeMap::new();
        let (mut packets, mut is_later) = (Vec::new(), last.is_none());
        for Transmission { packet, sent, .. } in radio.transmissions() {
            let count = counts.entry((packet.kind, packet.from, packet.to)).or_default();
            *count += 1;
            let (kind, from, to, nth, sent) = (packet.kind, packet.from, packet.to, *count, *sent);
            if let Some(last) = last.filter(|_| !is_later) {
                is_later = (kind, from, to, nth) == (last.kind, last.from, last.to, last.nth);
                continue;
            }
            let is_step = packet.message().is_some_and(|message| message.is_step());
            if from.team == Team::Home && (is_step || self.choice.all_kinds) {
                let acts = [Some(Act::Drop), self.choice.delay.map(Act::Delay)];
                let interfered = |act| Interfered { kind, from, to, nth, act, sent };
                packets.extend(acts.into_iter().flatten().map(interfered));
            }
        }
        packets
    }
}

/// The rules that do this to packets.
fn rules(packets: &[Interfered]) -> Vec<FaultRule> {
    let rule = |packet: &Interfered| FaultRule {
        kind: Some(packet.kind),
        from: Some(packet.from),
        to: Some(packet.to),
        between: None,
        which: Which::Nth(packet.nth),
        act: packet.act,
    };
    packets.iter().map(rule).collect()
}
