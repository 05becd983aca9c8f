//! How often each state and line of a chart was reached, from cold to hot. Pure.

use super::graph::{ChartGraph, ChartWay};
use crate::lab::coverage::{MachineCoverage, StateCoverage, TransitionCoverage};
use crate::ops;

/// The counts of a machine on its chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heat {
    /// By box.
    pub boxes: Vec<StateHeat>,
    /// How often one of its transitions was taken, by line.
    pub lines: Vec<u64>,
    hottest_line: u64,
    hottest_box: u64,
}

/// The counts of a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StateHeat {
    /// How often robots came to it.
    pub entered: u64,
    /// How long they were in it, s.
    pub seconds: f32,
    /// How often each of its ways out was taken.
    pub ways: Vec<u64>,
}

impl Heat {
    /// The counts of a machine. What is not counted, since the strategy was another one, was never reached.
    pub fn of(graph: &ChartGraph, counted: &MachineCoverage) -> Heat {
        let boxes: Vec<StateHeat> = (0..graph.boxes.len())
            .map(|at| {
                counted
                    .states
                    .get(&graph.boxes[at].name)
                    .map_or_else(StateHeat::default, |state| heat_of(graph, at, state))
            })
            .collect();
        let lines: Vec<u64> = (graph.lines.iter())
            .map(|line| {
                let taken = |way: &ChartWay| boxes[line.from].ways.get(way.id.number).copied().unwrap_or(0);
                line.ways.iter().map(taken).sum()
            })
            .collect();
        Heat {
            hottest_line: lines.iter().copied().max().unwrap_or(0),
            hottest_box: boxes.iter().map(|state| state.entered).max().unwrap_or(0),
            boxes,
            lines,
        }
    }

    /// From 0 for once to 1 for most often, as logarithms; none for never.
    pub fn of_line(&self, line: usize) -> Option<f32> {
        share(*self.lines.get(line)?, self.hottest_line)
    }

    /// The same for a state.
    pub fn of_box(&self, at: usize) -> Option<f32> {
        share(self.boxes.get(at)?.entered, self.hottest_box)
    }
}

fn heat_of(graph: &ChartGraph, at: usize, state: &StateCoverage) -> StateHeat {
    let ways = graph.ways_out(at).into_iter().map(|(way, to)| {
        let counted = state.transitions.get(way.id.number);
        // A file may be of another version of the strategy.
        let is_same =
            |counted: &&TransitionCoverage| counted.when == way.when && counted.go == graph.boxes[to].name;
        counted.filter(is_same).map_or(0, |counted| counted.taken)
    });
    StateHeat { entered: state.entered, seconds: state.seconds as f32, ways: ways.collect() }
}

fn share(count: u64, most: u64) -> Option<f32> {
    let scale = |count: u64| ops::ln(count as f32);
    match count {
        0 => None,
        _ if most <= 1 => Some(1.0),
        _ => Some(scale(count) / scale(most)),
    }
}

/// A count in words.
pub fn times(count: u64) -> String {
    match count {
        0 => "never".into(),
        1 => "once".into(),
        _ => format!("{count} times"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strategy::Strategy;
    use crate::testing::strategy;

    fn machine() -> Strategy {
        let pieces = r#"schemas: {}, assemblages: {}, machines: {"m": (start: "a", states: {
                "a": (on: [(when: Always, go: "b"), (when: HasBall, go: "c"), (when: HoldsBall, go: "b")]),
                "b": (on: [(when: Always, go: "a")]),
                "c": (),
            })},
            roles: {"r": Plays(tag: "R", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)])},"#;
        strategy("r", pieces)
    }

    fn way(when: &str, go: &str, taken: u64) -> TransitionCoverage {
        TransitionCoverage { when: when.into(), go: go.into(), taken }
    }

    #[test]
    fn the_line_taken_most_is_hot_the_one_taken_once_cold_and_one_never_taken_dead() {
        let graph = ChartGraph::of(&machine().machines[0], 0);
        let ways = vec![way("always", "b", 60), way("has the ball", "c", 0), way("holds the ball", "b", 40)];
        let state = |entered, transitions| StateCoverage { entered, seconds: 2.0, transitions };
        let states = [("a".into(), state(101, ways)), ("b".into(), state(100, vec![way("always", "a", 1)]))];
        let heat = Heat::of(&graph, &MachineCoverage { states: states.into() });
        let shares: Vec<_> = (0..graph.lines.len()).map(|line| heat.of_line(line)).collect();
        assert_eq!(shares, [Some(1.0), None, Some(0.0)]);
        assert_eq!([0, 1, 2].map(|at| heat.of_box(at).is_some()), [true, true, false]);
    }

    #[test]
    fn counts_of_another_version_of_the_strategy_do_not_count() {
        let graph = ChartGraph::of(&machine().machines[0], 0);
        let ways = vec![way("holds the ball", "b", 60), way("has the ball", "c", 7)];
        let states = [("a".into(), StateCoverage { entered: 9, seconds: 2.0, transitions: ways })];
        let heat = Heat::of(&graph, &MachineCoverage { states: states.into() });
        assert_eq!(heat.boxes[0].ways, [0, 7, 0]);
    }
}
