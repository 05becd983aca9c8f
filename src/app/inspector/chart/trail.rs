//! How a robot came to its state: which lines of the chart it went, how long ago, and how strongly each is shown. Pure.

use super::graph::ChartGraph;
use crate::app::view::format;
use crate::clock::Clock;
use crate::strategy::{Activity, TransitionTaken};

/// Transitions that are shown on the chart.
const SHOWN: usize = 4;
/// How much weaker each is than the one after it.
const FADING: f32 = 0.62;
/// How long a line flashes that has just been taken, s of the match.
const FLASH: f32 = 1.2;

/// A transition that a robot has taken, on its machine's chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrailStep {
    /// The line of the chart.
    pub line: usize,
    /// 1 for the last one, less for those before it.
    pub strength: f32,
    /// 1 when it has just been taken, falling to 0; 0 for all but the last one.
    pub flash: f32,
}

/// The last transitions on this chart, the newest first, up to the one with which the robot came to this machine.
pub fn trail(activity: &Activity, graph: &ChartGraph, clock: &Clock) -> Vec<TrailStep> {
    let line = |taken: &TransitionTaken| graph.line_of(taken.transition?);
    let lines = activity.history.iter().rev().take(SHOWN).map_while(|taken| Some((taken, line(taken)?)));
    let steps = lines.scan(1.0, |strength, (taken, line)| {
        let shown = *strength;
        *strength *= FADING;
        let age = age(taken, clock);
        let flash = if shown == 1.0 { (1.0 - age / FLASH).max(0.0) } else { 0.0 };
        Some(TrailStep { line, strength: shown, flash })
    });
    steps.collect()
}

/// How long ago a transition was taken, s of the match.
pub fn age(taken: &TransitionTaken, clock: &Clock) -> f32 {
    format::span(taken.tick, clock.tick.saturating_sub(1), clock.dt)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strategy::{StateRef, Strategy, TransitionId};
    use crate::testing::strategy;

    fn flip_flop() -> Strategy {
        let pieces = r#"schemas: {}, assemblages: {}, machines: {"m": (start: "a", states: {
                "a": (on: [(when: Always, go: "b")]),
                "b": (on: [(when: Always, go: "a")]),
            })},
            roles: {"r": Plays(tag: "R", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)])},"#;
        strategy("r", pieces)
    }

    /// A robot that has gone to and fro at these ticks, but that changed its sub-role in tick 30.
    fn went(strategy: &Strategy, ticks: &[u64]) -> Activity {
        let mut activity = Activity::new(strategy, 0, 0);
        for (number, tick) in ticks.iter().enumerate() {
            let [from, to] = [number % 2, (number + 1) % 2].map(|state| ["a", "b"][state].to_owned());
            let id = TransitionId { machine: 0, of: StateRef::Plain(number % 2), number: 0 };
            let transition = (*tick != 30).then_some(id);
            activity.note(TransitionTaken { tick: *tick, from, to, because: "always".into(), transition });
        }
        activity
    }

    #[test]
    fn the_way_fades_backwards_and_only_the_last_step_flashes_by_the_time_of_the_match() {
        let strategy = flip_flop();
        let graph = ChartGraph::of(&strategy.machines[0], 0);
        let activity = went(&strategy, &[0, 6, 12, 18, 24]);
        let shown = |tick| trail(&activity, &graph, &Clock { tick, ..Clock::new(60.0) });
        let now = shown(25);
        assert_eq!(now.iter().map(|step| step.line).collect::<Vec<_>>(), [0, 1, 0, 1]);
        assert!(now.windows(2).all(|pair| pair[0].strength > pair[1].strength));
        assert_eq!(now.iter().map(|step| step.flash).collect::<Vec<_>>(), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(shown(25), now, "it stands still with the match");
        assert!(shown(61)[0].flash > 0.0 && shown(61)[0].flash < 0.6);
        assert_eq!(shown(25 + 72)[0].flash, 0.0);
    }

    #[test]
    fn the_way_begins_where_the_robot_changed_its_sub_role() {
        let strategy = flip_flop();
        let graph = ChartGraph::of(&strategy.machines[0], 0);
        let activity = went(&strategy, &[12, 24, 30, 36]);
        assert_eq!(trail(&activity, &graph, &Clock { tick: 40, ..Clock::new(60.0) }).len(), 1);
    }
}
