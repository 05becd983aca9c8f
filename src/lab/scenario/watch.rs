//! Watching a condition from tick to tick: whether it holds, and the values that make it so.

use super::condition::{Condition, Packets};
use super::finding::find;
use super::scene::Scene;
use super::words::list;

/// A condition and what has to be remembered of earlier ticks.
#[derive(Clone, Debug)]
pub(super) struct Watch {
    condition: Condition,
    /// The conditions inside it.
    parts: Vec<Watch>,
    /// Length of a tick, s.
    dt: f32,
    /// Whether it held at the last tick observed.
    holds: bool,
    /// The tick since which the part of a `For` holds.
    since: Option<u64>,
    /// The messages up to the time from which they count.
    before: u64,
}

/// The number of ticks that is nearest to a time in seconds.
pub(super) fn ticks(seconds: f32, dt: f32) -> u64 {
    (f64::from(seconds) / f64::from(dt)).round() as u64
}

impl Watch {
    pub(super) fn new(condition: &Condition, dt: f32) -> Watch {
        let parts = match condition {
            Condition::All(parts) | Condition::Any(parts) => parts.iter().collect(),
            Condition::Not(part) | Condition::For { what: part, .. } => vec![&**part],
            _ => Vec::new(),
        };
        Watch {
            condition: condition.clone(),
            parts: parts.into_iter().map(|part| Watch::new(part, dt)).collect(),
            dt,
            holds: false,
            since: None,
            before: 0,
        }
    }

    /// Looks at the next tick and says whether the condition holds. Every part is looked at, since some remember.
    pub(super) fn observe(&mut self, scene: &Scene) -> bool {
        for part in &mut self.parts {
            part.observe(scene);
        }
        self.holds = match &self.condition {
            Condition::All(_) => self.parts.iter().all(|part| part.holds),
            Condition::Any(_) => self.parts.iter().any(|part| part.holds),
            Condition::Not(_) => !self.parts[0].holds,
            Condition::For { seconds, .. } => {
                self.since = if self.parts[0].holds { self.since.or(Some(scene.tick)) } else { None };
                self.since.is_some_and(|since| scene.tick - since >= ticks(*seconds, self.dt))
            }
            Condition::Sent(packets) | Condition::Delivered(packets) => {
                let count = self.count(packets, scene);
                if scene.tick <= ticks(packets.since, self.dt) {
                    self.before = count;
                }
                count - self.before >= packets.at_least
            }
            atom => find(atom, scene).holds,
        };
        self.holds
    }

    /// Why the condition held, or did not, at the tick observed last.
    pub(super) fn why(&self, scene: &Scene) -> String {
        match &self.condition {
            Condition::All(_) | Condition::Any(_) => {
                let telling = self.parts.iter().filter(|part| part.holds == self.holds);
                list(telling.map(|part| part.why(scene)), " and ")
            }
            Condition::Not(_) => self.parts[0].why(scene),
            Condition::For { .. } => {
                let why = self.parts[0].why(scene);
                match self.since {
                    Some(since) => {
                        let seconds = (scene.tick - since) as f32 * self.dt;
                        format!("{why} for {seconds:.2} s so far")
                    }
                    None => why,
                }
            }
            Condition::Sent(packets) | Condition::Delivered(packets) => {
                let count = self.count(packets, scene) - self.before;
                let verb = if matches!(self.condition, Condition::Sent(_)) { "sent" } else { "delivered" };
                let were = if count == 1 { "was" } else { "were" };
                format!("{count} {were} {verb}")
            }
            atom => (find(atom, scene).words)(),
        }
    }

    fn count(&self, packets: &Packets, scene: &Scene) -> u64 {
        let counted = scene.radio.of_kind(packets.kind, packets.from, packets.to);
        if matches!(self.condition, Condition::Sent(_)) { counted.on_air() } else { counted.delivered }
    }
}
