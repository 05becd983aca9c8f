//! Which invariants a match has broken, for people and as JSON.

use std::io::{self, Write};

use serde::Serialize;

use crate::game::Match;
use crate::game::record::{Breach, BreachCount, Invariant, Invariants};
use crate::ids::Team;

/// What a match has broken; nothing, if all held.
#[derive(Debug, Serialize)]
pub(super) struct BrokenReport {
    broken: Vec<BrokenLine>,
    /// The first breaches of each, with what led there.
    breaches: Vec<Breach>,
}

/// How often and for how long one was broken.
#[derive(Debug, Serialize)]
struct BrokenLine {
    invariant: Invariant,
    /// Whether it holds whatever the radio does.
    safety: bool,
    team: Option<Team>,
    times: u32,
    /// Beyond its bound.
    seconds: f64,
}

impl BrokenReport {
    pub fn of(game: &Match) -> BrokenReport {
        let invariants = game.world().resource::<Invariants>();
        let line = |((invariant, team), count): (&(Invariant, Option<Team>), &BreachCount)| {
            let (invariant, safety, team) = (*invariant, invariant.is_safety(), *team);
            let BreachCount { times, seconds } = *count;
            BrokenLine { invariant, safety, team, times, seconds }
        };
        BrokenReport {
            broken: invariants.broken.iter().map(line).collect(),
            breaches: invariants.breaches.clone(),
        }
    }

    pub fn print(&self, out: &mut impl Write) -> io::Result<()> {
        for BrokenLine { invariant, team, times, seconds, .. } in &self.broken {
            let first = self.breaches.iter().find(|it| it.invariant == *invariant && it.team == *team);
            let whose = team.map_or_else(String::new, |team| format!("{team}: "));
            let often = if *times == 1 { "once".into() } else { format!("{times} times") };
            let first = first.map_or_else(String::new, |breach| format!(", first at tick {}", breach.tick));
            writeln!(out, "broken      {whose}{invariant}, {often}, {seconds:.1} s beyond its bound{first}")?;
        }
        Ok(())
    }
}
