//! Airtime: each frame takes a while on the one channel that all robots of both teams share, and frames that overlap are lost.
//!
//! Stations take turns as 802.11's distributed coordination function has it for frames that nobody acknowledges: a station listens
//! first; if the channel is busy it waits until that has been idle for a while, and then for a number of slots that it draws. Two that
//! draw the same collide. All robots hear each other, equally loud.

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, VecDeque};

use serde::{Deserialize, Serialize};

use crate::clock::Clock;
use crate::comms::tcm::Datagram;
use crate::data::{Bound, Fault, Validate, check_all, ensure};
use crate::ids::RobotId;
use crate::rng::{Dice, DiceStirred, Seed};

/// How long frames take and how robots take turns; the defaults are those of 802.11b at 1 Mbit/s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Airtime {
    /// bit/s
    pub bits_per_second: f32,
    /// What every frame takes before its first byte, s.
    pub preamble: f32,
    /// Bytes of a frame around a datagram.
    pub overhead: f32,
    /// The channel must have been idle for so long, s.
    pub idle: f32,
    /// The length of a slot, s.
    pub slot: f32,
    /// The most slots that a robot waits.
    pub window: u16,
    /// Frames that a robot has waiting at most; more are not sent.
    pub queue: usize,
}

/// Slots must tell robots apart, s.
const SHORTEST_SLOT: f32 = 1e-6;

impl Default for Airtime {
    fn default() -> Airtime {
        Airtime {
            bits_per_second: 1e6,
            preamble: 192e-6,
            overhead: 64.0,
            idle: 50e-6,
            slot: 20e-6,
            window: 31,
            queue: 50,
        }
    }
}

impl Validate for Airtime {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("bits_per_second", self.bits_per_second, Bound::BYTES.positive()),
            ("preamble", self.preamble, Bound::DELAY),
            ("overhead", self.overhead, Bound::BYTES),
            ("idle", self.idle, Bound::DELAY),
            ("slot", self.slot, Bound::DELAY),
        ])?;
        ensure(self.slot >= SHORTEST_SLOT, "slot", || {
            format!("must be at least {SHORTEST_SLOT} s, not {}", self.slot)
        })?;
        ensure(self.queue > 0, "queue", || "must be at least 1".into())?;
        let longest = self.frame(1500);
        ensure(longest < 10.0, "bits_per_second", || {
            format!("a datagram of 1500 bytes would take {longest} s")
        })
    }
}

impl Airtime {
    /// How long a frame with a datagram of so many bytes takes, s.
    pub fn frame(&self, bytes: usize) -> f64 {
        let bits = 8.0 * (bytes as f64 + f64::from(self.overhead));
        f64::from(self.preamble) + bits / f64::from(self.bits_per_second)
    }
}

/// The channel that all robots share: who waits for it, and how long it is busy.
#[derive(Clone, Debug, PartialEq)]
pub struct Air {
    stations: BTreeMap<RobotId, Station>,
    /// The channel is idle from this time on, s.
    free: f64,
    dice: Dice,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Station {
    waiting: VecDeque<AirFrame>,
    /// Slots to wait once the channel is idle; none if a frame may go at once on a channel that is. Who has waited them without a frame
    /// draws again if the next one finds the channel busy.
    backoff: Option<u32>,
}

/// Datagrams that go on air as one: a broadcast has one for each receiver.
#[derive(Clone, Debug, PartialEq)]
struct AirFrame {
    datagrams: Vec<Datagram>,
    /// When it was given to the station, s.
    ready: f64,
}

/// What became of a datagram on the air.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OffAir {
    /// Every robot could hear it.
    Clear(Datagram),
    /// Another frame was on air at the same time, or too many of the robot's were waiting.
    Lost(Datagram),
}

impl Air {
    /// A channel on which nothing is said yet.
    pub fn new(seed: Seed) -> Air {
        Air { stations: BTreeMap::new(), free: 0.0, dice: Dice::new(seed, "air", None) }
    }

    /// Another chance from here on.
    pub fn stir(&mut self, stirred: DiceStirred) {
        self.dice.stir(stirred);
    }

    /// What comes off the air by the end of the tick, with what robots say in it, each at some moment of the tick.
    pub fn tick(&mut self, airtime: &Airtime, said: Vec<Datagram>, clock: &Clock) -> Vec<OffAir> {
        let (begins, ends) = (clock.now(), clock.now() + f64::from(clock.dt));
        let mut off = self.queue(airtime, said, (begins, f64::from(clock.dt)));
        while let Some(start) = self.next_start(airtime).filter(|start| *start < ends) {
            self.transmit(airtime, start, &mut off);
        }
        off
    }

    fn queue(&mut self, airtime: &Airtime, said: Vec<Datagram>, (begins, dt): (f64, f64)) -> Vec<OffAir> {
        let (mut off, mut moments) = (Vec::new(), BTreeMap::new());
        for datagram in said {
            let station = self.stations.entry(datagram.from).or_default();
            // Robots count their ticks each by itself.
            let ready =
                begins + dt * *moments.entry(datagram.from).or_insert_with(|| f64::from(self.dice.uniform()));
            let is_full = station.waiting.len() >= airtime.queue;
            match station.waiting.back_mut().filter(|frame| frame.ready == ready && frame.holds(&datagram)) {
                Some(frame) => frame.datagrams.push(datagram),
                None if is_full => off.push(OffAir::Lost(datagram)),
                None => station.waiting.push_back(AirFrame { datagrams: vec![datagram], ready }),
            }
        }
        off
    }

    /// When the next station begins to send, s. Who finds the channel busy draws how long it waits.
    fn next_start(&mut self, airtime: &Airtime) -> Option<f64> {
        let idle = self.free + f64::from(airtime.idle);
        for station in self.stations.values_mut() {
            if station.backoff.is_none() && station.waiting.front().is_some_and(|frame| frame.ready < idle) {
                station.backoff = Some(self.dice.below(usize::from(airtime.window) + 1) as u32);
            }
        }
        self.stations.values().filter_map(|station| station.start(airtime, idle)).min_by(f64::total_cmp)
    }

    /// Everybody sends who begins in the same slot.
    fn transmit(&mut self, airtime: &Airtime, start: f64, off: &mut Vec<OffAir>) {
        let (idle, slot) = (self.free + f64::from(airtime.idle), f64::from(airtime.slot));
        let mut frames = Vec::new();
        for station in self.stations.values_mut() {
            // Half a slot, since times that should be equal are sums of others.
            if station.start(airtime, idle).is_some_and(|other| other < start + 0.5 * slot) {
                frames.extend(station.waiting.pop_front());
                station.backoff = Some(self.dice.below(usize::from(airtime.window) + 1) as u32);
            } else if let Some(slots) = station.backoff {
                let over = ((start - idle) / slot + 0.5).max(0.0) as u32;
                station.backoff = slots.checked_sub(over).filter(|left| *left > 0);
            }
        }
        let longest = frames.iter().map(|frame| airtime.frame(frame.bytes()));
        self.free = start + longest.fold(0.0, f64::max);
        let fate = if frames.len() == 1 { OffAir::Clear } else { OffAir::Lost };
        off.extend(frames.into_iter().flat_map(|frame| frame.datagrams).map(fate));
    }
}

impl AirFrame {
    fn bytes(&self) -> usize {
        self.datagrams.first().map_or(0, |datagram| datagram.bytes.len())
    }

    /// Whether it says the same as a datagram.
    fn holds(&self, datagram: &Datagram) -> bool {
        self.datagrams.first().is_some_and(|first| first.bytes == datagram.bytes)
    }
}

impl Station {
    /// When it begins to send if nobody else does before, s; the channel has been idle for long enough from `idle` on.
    fn start(&self, airtime: &Airtime, idle: f64) -> Option<f64> {
        let ready = self.waiting.front()?.ready;
        let waits =
            self.backoff.map_or(f64::NEG_INFINITY, |slots| idle + f64::from(slots) * f64::from(airtime.slot));
        Some(ready.max(waits))
    }
}
