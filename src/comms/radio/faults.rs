//! Faults put into the radio on purpose, as data: "drop the second ACKSWAP from home 2".
//!
//! A rule counts packets, and a packet is one delivery to one receiver: a message to three team mates is three packets,
//! counted in the order of their sending. Times are seconds of the match.

use std::ops::Range;

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::packet::Packet;
use crate::comms::tcm::DataType;
use crate::data::{Bound, Fault, Validate, ensure};
use crate::ids::RobotId;

/// What happens to which packets. A condition that is left out holds for all.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FaultRule {
    /// The kind of message.
    #[serde(default)]
    pub kind: Option<DataType>,
    /// The sender.
    #[serde(default)]
    pub from: Option<RobotId>,
    /// The receiver.
    #[serde(default)]
    pub to: Option<RobotId>,
    /// From the first time until just before the second, which may be `inf`. Packets at other times are not counted.
    #[serde(default)]
    pub between: Option<(f32, f32)>,
    /// Which of the packets that satisfy all the above.
    #[serde(default)]
    pub which: Which,
    /// What happens to the packets.
    pub act: Act,
}

/// A choice among the packets that a rule counts, from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Which {
    /// Each of them.
    #[default]
    All,
    /// The first.
    First,
    /// Only this one.
    Nth(u32),
    /// This one and all after it.
    From(u32),
}

/// What a rule does to a packet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Act {
    /// It is lost.
    Drop,
    /// It arrives this much later, s.
    Delay(f32),
    /// It arrives once more, this much later than the first time, s.
    Duplicate(f32),
}

/// The acts on one packet, in the order of their rules.
pub type Acts = SmallVec<[Act; 2]>;

/// The rules in force, each with the number of packets that satisfied its conditions so far.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct FaultRules {
    rules: Vec<(FaultRule, u32)>,
}

impl Which {
    fn takes(self, count: u32) -> bool {
        match self {
            Which::All => true,
            Which::First => count == 1,
            Which::Nth(n) => count == n,
            Which::From(n) => count >= n,
        }
    }
}

impl FaultRule {
    /// Whatever a robot sends of a kind in some ticks is heard by nobody.
    pub fn silencing(kind: DataType, from: RobotId, ticks: Range<u64>, dt: f32) -> FaultRule {
        FaultRule {
            kind: Some(kind),
            from: Some(from),
            to: None,
            between: Some((just_before(ticks.start, dt), just_before(ticks.end, dt))),
            which: Which::All,
            act: Act::Drop,
        }
    }

    /// Whether the rule counts this packet.
    pub fn matches(&self, packet: &Packet, now: f64) -> bool {
        let in_time = |(from, until): (f32, f32)| (f64::from(from)..f64::from(until)).contains(&now);
        self.kind.is_none_or(|kind| kind == packet.kind)
            && self.from.is_none_or(|from| from == packet.from)
            && self.to.is_none_or(|to| to == packet.to)
            && self.between.is_none_or(in_time)
    }
}

impl Validate for FaultRule {
    fn validate(&self) -> Result<(), Fault> {
        if let Which::Nth(0) | Which::From(0) = self.which {
            return Err(Fault::new("which", "packets are counted from 1"));
        }
        if let Some((from, until)) = self.between {
            Bound::SECONDS.check("between.0", from)?;
            if until != f32::INFINITY {
                Bound::SECONDS.check("between.1", until)?;
            }
            let message = || format!("must end after its start, not go from {from} to {until}");
            ensure(from < until, "between", message)?;
        }
        match self.act {
            Act::Delay(seconds) | Act::Duplicate(seconds) => Bound::SECONDS.check("act", seconds),
            Act::Drop => Ok(()),
        }
    }
}

/// A time between a tick and the one before it, s, where rounding does not matter.
pub fn just_before(tick: u64, dt: f32) -> f32 {
    ((tick as f64 - 0.5) * f64::from(dt)).max(0.0) as f32
}

impl FaultRules {
    /// Rules that have counted nothing yet.
    pub fn new(rules: impl IntoIterator<Item = FaultRule>) -> FaultRules {
        FaultRules { rules: rules.into_iter().map(|rule| (rule, 0)).collect() }
    }

    /// Adds a rule, which counts from now on.
    pub fn add(&mut self, rule: FaultRule) {
        self.rules.push((rule, 0));
    }

    /// Counts a packet that is sent at `now`, s, and tells what happens to it. No rule hides a packet from another.
    pub fn apply(&mut self, packet: &Packet, now: f64) -> Acts {
        let mut acts = Acts::new();
        for (rule, counted) in &mut self.rules {
            if rule.matches(packet, now) {
                *counted += 1;
                if rule.which.takes(*counted) {
                    acts.push(rule.act);
                }
            }
        }
        acts
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::data::ron_options;
    use crate::ids::Team;

    fn home(number: u8) -> RobotId {
        RobotId::new(Team::Home, number)
    }

    fn packet(kind: DataType, from: u8, to: u8) -> Packet {
        Packet { kind, from: home(from), to: home(to), bytes: Arc::new([0; 10]) }
    }

    fn rule(text: &str) -> FaultRule {
        ron_options().from_str(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
    }

    fn rules(texts: &[&str]) -> FaultRules {
        FaultRules::new(texts.iter().map(|text| rule(text)))
    }

    #[test]
    fn the_second_ackswap_of_one_robot_is_dropped_and_nothing_else() {
        let mut rules = rules(&[r#"(kind: AckSwap, from: "home 2", which: Nth(2), act: Drop)"#]);
        let mut acts = |kind, from| rules.apply(&packet(kind, from, 0), 0.0).to_vec();
        assert_eq!(acts(DataType::ACK_SWAP, 2), []);
        assert_eq!(acts(DataType::ACK_LOCK, 2), []);
        assert_eq!(acts(DataType::ACK_SWAP, 1), []);
        assert_eq!(acts(DataType::ACK_SWAP, 2), [Act::Drop]);
        assert_eq!(acts(DataType::ACK_SWAP, 2), []);
    }

    #[test]
    fn the_first_lock_is_delayed() {
        let mut rules = rules(&["(kind: Lock, which: First, act: Delay(1.5))"]);
        assert_eq!(rules.apply(&packet(DataType::LOCK, 0, 1), 0.0).to_vec(), [Act::Delay(1.5)]);
        assert!(rules.apply(&packet(DataType::LOCK, 0, 1), 0.0).is_empty());
    }

    #[test]
    fn a_message_to_three_robots_counts_three_times() {
        let mut rules = rules(&["(kind: Lock, which: Nth(2), act: Drop)"]);
        let hit = [1, 2, 3].map(|to| !rules.apply(&packet(DataType::LOCK, 0, to), 0.0).is_empty());
        assert_eq!(hit, [false, true, false]);
    }

    #[test]
    fn a_receiver_and_all_from_a_number_on_can_be_meant() {
        let mut rules = rules(&[r#"(to: "home 3", which: From(2), act: Duplicate(0.2))"#]);
        let mut hit = |to| !rules.apply(&packet(DataType::POSITION, 0, to), 0.0).is_empty();
        assert_eq!([hit(3), hit(1), hit(3), hit(3)], [false, false, true, true]);
    }

    #[test]
    fn packets_outside_the_time_of_a_rule_are_not_counted() {
        let mut rules = rules(&["(between: (10.0, 12.0), which: First, act: Drop)"]);
        let times = [9.9, 12.0, 10.0, 11.0];
        let hit = times.map(|now| !rules.apply(&packet(DataType::SWAP, 0, 1), now).is_empty());
        assert_eq!(hit, [false, false, true, false]);
    }

    #[test]
    fn every_rule_counts_for_itself() {
        let mut rules =
            rules(&["(act: Drop, which: First)", "(act: Delay(1.0), which: Nth(2))", "(act: Delay(2.0))"]);
        let mut acts = || rules.apply(&packet(DataType::VALUES, 0, 1), 0.0).to_vec();
        assert_eq!(acts(), [Act::Drop, Act::Delay(2.0)]);
        assert_eq!(acts(), [Act::Delay(1.0), Act::Delay(2.0)]);
    }

    #[test]
    fn a_rule_that_is_added_counts_from_then_on() {
        let mut rules = rules(&["(act: Drop)"]);
        rules.apply(&packet(DataType::GOALIE_NEWS, 0, 1), 0.0);
        rules.add(rule("(which: First, act: Delay(1.0))"));
        assert_eq!(
            rules.apply(&packet(DataType::GOALIE_NEWS, 0, 1), 0.0).to_vec(),
            [Act::Drop, Act::Delay(1.0)]
        );
    }

    #[test]
    fn a_rule_reads_back_as_it_was_written_with_its_robots_as_text() {
        let written = FaultRule {
            kind: Some(DataType::HAVE_BALL),
            from: Some(home(2)),
            to: None,
            between: Some((1.0, 2.0)),
            which: Which::From(3),
            act: Act::Delay(0.5),
        };
        let text = ron_options().to_string(&written).unwrap();
        assert!(text.contains("\"home 2\""), "{text}");
        assert_eq!(rule(&text), written);
    }

    #[test]
    fn a_robot_that_is_none_is_refused_with_a_hint() {
        let error = ron_options().from_str::<FaultRule>(r#"(from: "guest 1", act: Drop)"#).unwrap_err();
        assert!(error.to_string().contains("is no robot"), "{error}");
    }

    #[test]
    fn a_senseless_rule_is_named_with_its_field() {
        let field = |text| rule(text).validate().err().map(|fault| fault.field.to_string());
        assert_eq!(field("(which: Nth(1), between: (0.0, 1.0), act: Delay(0.0))"), None);
        assert_eq!(field("(which: Nth(0), act: Drop)").as_deref(), Some("which"));
        assert_eq!(field("(which: From(0), act: Drop)").as_deref(), Some("which"));
        assert_eq!(field("(between: (2.0, 2.0), act: Drop)").as_deref(), Some("between"));
        assert_eq!(field("(between: (NaN, 2.0), act: Drop)").as_deref(), Some("between[0]"));
        assert_eq!(field("(between: (1.0, inf), act: Drop)"), None);
        assert_eq!(field("(between: (1.0, 1e30), act: Drop)").as_deref(), Some("between[1]"));
        assert_eq!(field("(act: Delay(1e30))").as_deref(), Some("act"));
        assert_eq!(field("(act: Delay(-1.0))").as_deref(), Some("act"));
        assert_eq!(field("(act: Duplicate(inf))").as_deref(), Some("act"));
    }
}
