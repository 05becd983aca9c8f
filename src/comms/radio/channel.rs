//! The channel: a packet is lost, or arrives once or more after a while.
//!
//! Each directed link has dice and a state of its own, and each packet takes the same number of dice whatever the
//! settings. So the delivery of a packet depends on its link's past alone, budgets apart, and switching one mechanism on or
//! off does not shift another.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::fmt;

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::air::{Air, OffAir};
use super::faults::{Act, FaultRules};
use super::interference::{Interference, Obstacle};
use super::loss_model::LinkFade;
use super::packet::Packet;
use super::preset::{Budget, Radio, SharedBy};
use super::stalls::Stall;
use crate::clock::Clock;
use crate::comms::tcm::Datagram;
use crate::ids::RobotId;
use crate::rng::{Dice, DiceStirred, Seed};

/// What the channel does with a packet. One that is lost has no arrivals, any other has one or more.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Delivery {
    /// That of the packet itself first, then those of its duplicates; not in the order of their ticks.
    pub arrivals: SmallVec<[Arrival; 2]>,
    /// Why it is lost, if it is.
    pub lost: Option<Loss>,
}

impl Delivery {
    /// It arrives in this tick.
    pub fn on_time(due: u64) -> Delivery {
        let arrival = Arrival { due, late: false, duplicate: false };
        Delivery { arrivals: SmallVec::from_iter([arrival]), lost: None }
    }

    /// It does not arrive, for this reason.
    pub fn lost(reason: Loss) -> Delivery {
        Delivery { arrivals: SmallVec::new(), lost: Some(reason) }
    }
}

/// The arrival of a packet or of a duplicate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arrival {
    /// The tick, later than that of the sending.
    pub due: u64,
    /// Whether it belongs to the late tail or was held up by a stall, by interference or by a fault.
    pub late: bool,
    pub duplicate: bool,
}

/// Why a packet is lost. If there are several reasons, the first of these counts. The channel knows nothing of mute and
/// deaf robots: these are for those who send and deliver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Loss {
    /// The sender cannot speak.
    Mute,
    /// A fault rule.
    Fault,
    /// The bucket was too empty to send it.
    Budget,
    /// The whole band is jammed.
    Jammed,
    /// One of the robots is cut off, or a partition is between them.
    CutOff,
    /// The receiver is too far away.
    Range,
    /// The radio's own loss.
    Chance,
    /// The extra loss of the interference.
    Extra,
    /// It overlapped with another frame on the channel that all share, or too many of its sender's were waiting.
    Air,
    /// The receiver could not hear when it arrived.
    Deaf,
}

/// The radio of a match.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct Channel {
    seed: Seed,
    radio: Radio,
    links: BTreeMap<(RobotId, RobotId), LinkState>,
    buckets: BTreeMap<(Option<RobotId>, Option<RobotId>), Bucket>,
    air: Air,
}

#[derive(Clone, Debug, PartialEq)]
struct LinkState {
    dice: Dice,
    /// Those of its stalls: packets take as many of the others, however often it stalls.
    stall_dice: Dice,
    fade: LinkFade,
    stall: Option<Stall>,
}

/// All the chance that one packet can meet.
struct Rolls {
    change: f32,
    loss: f32,
    extra: f32,
    duplicate: f32,
    delays: [DelayRoll; 2],
}

struct DelayRoll {
    /// Exponential with mean 1.
    jitter: f32,
    late: f32,
    tail: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Bucket {
    bytes: f64,
    /// The time of the last change, s.
    time: f64,
}

impl Loss {
    /// All reasons, in their order.
    pub const ALL: [Loss; 10] = [
        Loss::Mute,
        Loss::Fault,
        Loss::Budget,
        Loss::Jammed,
        Loss::CutOff,
        Loss::Range,
        Loss::Chance,
        Loss::Extra,
        Loss::Air,
        Loss::Deaf,
    ];

    /// The place of this reason in [`Loss::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Loss::Mute => "mute",
            Loss::Fault => "fault rule",
            Loss::Budget => "budget",
            Loss::Jammed => "jammed",
            Loss::CutOff => "cut off",
            Loss::Range => "out of range",
            Loss::Chance => "chance",
            Loss::Extra => "extra loss",
            Loss::Air => "collision",
            Loss::Deaf => "deaf",
        })
    }
}

impl Channel {
    /// The channel of a match with this seed.
    pub fn new(seed: Seed, radio: Radio) -> Channel {
        Channel { seed, radio, links: BTreeMap::new(), buckets: BTreeMap::new(), air: Air::new(seed) }
    }

    /// The preset in force.
    pub fn radio(&self) -> &Radio {
        &self.radio
    }

    /// Puts another preset in force. Links are good again and buckets full; the dice roll on, and what is already under
    /// way arrives as it was sent.
    pub fn set_radio(&mut self, radio: Radio) {
        self.radio = radio;
        self.buckets.clear();
        for link in self.links.values_mut() {
            (link.fade, link.stall) = (LinkFade::default(), None);
        }
    }

    /// Another chance from here on, also on links that nothing has been sent on.
    pub fn stir(&mut self, stirred: DiceStirred) {
        for link in self.links.values_mut() {
            link.dice.stir(stirred);
            link.stall_dice.stir(stirred);
        }
        self.air.stir(stirred);
        self.seed = Seed(self.seed.0 ^ stirred.0);
    }

    /// What comes off the air in the clock's present tick, with what robots say in it. Where frames take no time, that is all of it.
    pub fn off_air(&mut self, said: Vec<Datagram>, clock: &Clock) -> Vec<OffAir> {
        match &self.radio.air {
            Some(airtime) => self.air.tick(airtime, said, clock),
            None => said.into_iter().map(OffAir::Clear).collect(),
        }
    }

    /// Sends a packet over so many metres in the clock's present tick. Every packet that finds its bytes in the bucket is charged, also if
    /// it is then lost.
    pub fn send(
        &mut self,
        packet: &Packet,
        distance: f32,
        interference: &Interference,
        faults: &mut FaultRules,
        clock: &Clock,
    ) -> Delivery {
        let seed = self.seed;
        let link = self.links.entry((packet.from, packet.to)).or_insert_with(|| LinkState {
            dice: Dice::new(seed, &format!("radio to {}", packet.to), Some(packet.from)),
            stall_dice: Dice::new(seed, &format!("stalls to {}", packet.to), Some(packet.from)),
            fade: LinkFade::default(),
            stall: None,
        });
        let rolls = Rolls::new(&mut link.dice);
        let by_chance = self.radio.loss.loses(&mut link.fade, clock.now(), rolls.change, rolls.loss);
        let stalls = self.radio.stalls.as_ref();
        let stalled =
            stalls.map_or(0.0, |stalls| stalls.hold_up(&mut link.stall, clock.now(), &mut link.stall_dice));
        let acts = faults.apply(packet, clock.now());
        let paid = self.pay(packet, clock.now());

        let lost = if acts.contains(&Act::Drop) {
            Some(Loss::Fault)
        } else if !paid {
            Some(Loss::Budget)
        } else if let Some(obstacle) = interference.obstacle(packet.from, packet.to) {
            Some(if obstacle == Obstacle::Jammed { Loss::Jammed } else { Loss::CutOff })
        } else if self.radio.range.is_some_and(|range| distance > range) {
            Some(Loss::Range)
        } else if by_chance {
            Some(Loss::Chance)
        } else if rolls.extra < interference.extra_loss {
            Some(Loss::Extra)
        } else {
            None
        };
        if let Some(reason) = lost {
            return Delivery::lost(reason);
        }

        let hold_ups =
            acts.iter().filter_map(|act| if let Act::Delay(seconds) = act { Some(*seconds) } else { None });
        let held_up = hold_ups.sum::<f32>() + interference.extra_delay + stalled;
        let arrival = |delay: f32, late: bool, duplicate: bool| Arrival {
            due: clock.tick.saturating_add(clock.ticks(delay)),
            late,
            duplicate,
        };
        let [(first, first_late), (second, second_late)] = rolls.delays.map(|roll| {
            let (delay, late) = self.radio.delay(&roll);
            (delay + held_up, late || held_up > 0.0)
        });
        let mut arrivals = SmallVec::from_iter([arrival(first, first_late, false)]);
        if rolls.duplicate < self.radio.duplication {
            arrivals.push(arrival(second, second_late, true));
        }
        for act in acts {
            if let Act::Duplicate(seconds) = act {
                arrivals.push(arrival(first + seconds, first_late || seconds > 0.0, true));
            }
        }
        Delivery { arrivals, lost: None }
    }

    /// Takes a packet's bytes from its bucket; false if they are not there.
    fn pay(&mut self, packet: &Packet, now: f64) -> bool {
        let Some(budget) = self.radio.budget else {
            return true;
        };
        let owner = match budget.shared_by {
            SharedBy::Link => (Some(packet.from), Some(packet.to)),
            SharedBy::Sender => (Some(packet.from), None),
            SharedBy::All => (None, None),
        };
        let full = Bucket { bytes: f64::from(budget.burst), time: now };
        self.buckets.entry(owner).or_insert(full).take(packet.bytes.len(), &budget, now)
    }
}

impl Rolls {
    fn new(dice: &mut Dice) -> Rolls {
        Rolls {
            change: dice.uniform(),
            loss: dice.uniform(),
            extra: dice.uniform(),
            duplicate: dice.uniform(),
            delays: [DelayRoll::new(dice), DelayRoll::new(dice)],
        }
    }
}

impl DelayRoll {
    fn new(dice: &mut Dice) -> DelayRoll {
        DelayRoll { jitter: dice.exponential(1.0), late: dice.uniform(), tail: dice.uniform() }
    }
}

impl Radio {
    /// A latency, s, and whether it is one of the late tail.
    fn delay(&self, roll: &DelayRoll) -> (f32, bool) {
        let usual = self.latency.fixed + self.latency.jitter * roll.jitter;
        match self.late {
            Some(late) if roll.late < late.share => {
                (usual + late.min + (late.max - late.min) * roll.tail, true)
            }
            _ => (usual, false),
        }
    }
}

impl Bucket {
    fn take(&mut self, bytes: usize, budget: &Budget, now: f64) -> bool {
        let inflow = (now - self.time).max(0.0) * f64::from(budget.bytes_per_second);
        self.bytes = (self.bytes + inflow).min(f64::from(budget.burst));
        self.time = now;
        let enough = self.bytes >= bytes as f64;
        if enough {
            self.bytes -= bytes as f64;
        }
        enough
    }
}
