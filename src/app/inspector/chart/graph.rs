//! A state machine as a graph for people: a box for each state, a line for all transitions from one state to another. Pure.

use crate::app::inspector::breakpoints::StopAt;
use crate::strategy::{Machine, StateRef, TransitionId};

/// The chart of a machine, before it is laid out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartGraph {
    /// The machine's name.
    pub name: String,
    /// Composite states first, in the order of [`Machine::all_states`].
    pub boxes: Vec<ChartBox>,
    /// In the order in which the states have them.
    pub lines: Vec<ChartLine>,
    /// The box of the state in which a robot begins, or that of the outermost composite state around it.
    pub start: usize,
}

/// A state.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartBox {
    /// Which.
    pub state: StateRef,
    /// Its name.
    pub name: String,
    /// The composite state around it, by its index in the machine.
    pub within: Option<usize>,
}

/// Something on a chart, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pointed {
    Box(usize),
    Line(usize),
}

/// All transitions from one state to another.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartLine {
    /// The box of the state that has them.
    pub from: usize,
    /// The box of the state that they name.
    pub to: usize,
    /// The transitions; none where a composite state leads to its first state.
    pub ways: Vec<ChartWay>,
}

/// A transition.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartWay {
    /// Which.
    pub id: TransitionId,
    /// Its condition, for people.
    pub when: String,
}

/// Conditions that stand at a line, and how long each may be, in characters.
const CONDITIONS: usize = 3;
const LONGEST: usize = 30;

impl ChartLine {
    /// What stands at the line: its conditions, each after its place among those of its state.
    pub fn label(&self) -> Vec<String> {
        let shown = if self.ways.len() > CONDITIONS { CONDITIONS - 1 } else { CONDITIONS };
        let mut rows: Vec<String> = self
            .ways
            .iter()
            .take(shown)
            .map(|way| format!("{} {}", way.place(), shortened(&way.when)))
            .collect();
        if self.ways.len() > shown {
            rows.push(format!("and {} more", self.ways.len() - shown));
        }
        rows
    }
}

impl ChartWay {
    /// Its place among the transitions of its state, from 1 on: the first whose condition holds is taken.
    pub fn place(&self) -> usize {
        self.id.number + 1
    }
}

/// The beginning of a long text.
fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let start: String = text.chars().take(LONGEST - 1).collect();
    format!("{}…", start.trim_end())
}

impl ChartGraph {
    /// The graph of a machine, which is at this place among those of its strategy.
    pub fn of(machine: &Machine, index: usize) -> ChartGraph {
        let around = surroundings(machine);
        let boxes: Vec<ChartBox> = (machine.all_states())
            .map(|state| ChartBox {
                state,
                name: machine.name_of(state).to_owned(),
                within: match state {
                    StateRef::Plain(plain) => machine.states[plain].within.last().copied(),
                    StateRef::Composite(composite) => around[composite],
                },
            })
            .collect();
        let start = &machine.states[machine.start];
        let start =
            start.within.first().map_or(StateRef::Plain(machine.start), |outer| StateRef::Composite(*outer));
        let mut graph = ChartGraph {
            name: machine.name.clone(),
            start: box_of(machine, start),
            boxes,
            lines: Vec::new(),
        };
        let inner = (0..machine.composites.len()).filter_map(|composite| first_inside(machine, composite));
        for (from, to) in inner.collect::<Vec<_>>() {
            graph.line(from, to);
        }
        for of in machine.all_states() {
            for (number, transition) in machine.transitions_of(of).iter().enumerate() {
                let (from, to) = (box_of(machine, of), box_of(machine, machine.target(transition)));
                let id = TransitionId { machine: index, of, number };
                graph.line(from, to).ways.push(ChartWay { id, when: transition.label.clone() });
            }
        }
        graph
    }

    /// The line between two boxes.
    fn line(&mut self, from: usize, to: usize) -> &mut ChartLine {
        let known = self.lines.iter().position(|line| (line.from, line.to) == (from, to));
        let place = known.unwrap_or_else(|| {
            self.lines.push(ChartLine { from, to, ways: Vec::new() });
            self.lines.len() - 1
        });
        &mut self.lines[place]
    }

    /// The box of a state, if the machine has it.
    pub fn find(&self, state: StateRef) -> Option<usize> {
        self.boxes.iter().position(|known| known.state == state)
    }

    /// Whether it has a box or a line.
    pub fn has(&self, what: Pointed) -> bool {
        match what {
            Pointed::Box(at) => at < self.boxes.len(),
            Pointed::Line(line) => self.lines.get(line).is_some_and(|line| !line.ways.is_empty()),
        }
    }

    /// What a match stops at that stops at a box or a line.
    pub fn stop(&self, at: Pointed) -> StopAt {
        let (machine, name) = (self.name.clone(), |at: usize| self.boxes[at].name.clone());
        match at {
            Pointed::Box(at) => StopAt::State { machine, state: name(at) },
            Pointed::Line(line) => {
                let ChartLine { from, to, .. } = self.lines[line];
                StopAt::Transition { machine, from: name(from), go: name(to), when: None }
            }
        }
    }

    /// The line of a transition, if the machine has it.
    pub fn line_of(&self, transition: TransitionId) -> Option<usize> {
        self.lines.iter().position(|line| line.ways.iter().any(|way| way.id == transition))
    }

    /// The transitions of a state, in the order in which they are asked, each with the box that it leads to.
    pub fn ways_out(&self, of: usize) -> Vec<(&ChartWay, usize)> {
        let lines = self.lines.iter().filter(|line| line.from == of);
        let mut ways: Vec<_> = lines.flat_map(|line| line.ways.iter().map(|way| (way, line.to))).collect();
        ways.sort_unstable_by_key(|(way, _)| way.id);
        ways
    }

    /// A box and those of the composite states around it, the innermost first.
    pub fn with_surroundings(&self, at: usize) -> impl Iterator<Item = usize> {
        // Composite states come first, in the order of the machine.
        std::iter::successors(Some(at), |at| self.boxes.get(*at)?.within)
    }
}

/// Where the box of a state is.
fn box_of(machine: &Machine, state: StateRef) -> usize {
    match state {
        StateRef::Composite(index) => index,
        StateRef::Plain(index) => machine.composites.len() + index,
    }
}

/// The composite state around each composite state.
fn surroundings(machine: &Machine) -> Vec<Option<usize>> {
    let mut around = vec![None; machine.composites.len()];
    for state in &machine.states {
        for pair in state.within.windows(2) {
            around[pair[1]] = Some(pair[0]);
        }
    }
    around
}

/// The boxes of a composite state and of the state in it that comes first, as far as the machine ever goes there by its name.
fn first_inside(machine: &Machine, composite: usize) -> Option<(usize, usize)> {
    let all = machine.all_states().flat_map(|state| machine.transitions_of(state));
    let entries = all.filter(|transition| machine.target(transition) == StateRef::Composite(composite));
    let first = entries.map(|transition| transition.go).chain([machine.start]);
    let within = |state: &usize| &machine.states[*state].within;
    let entry = first.into_iter().find(|state| within(state).contains(&composite))?;
    let depth = within(&entry).iter().position(|around| *around == composite)?;
    let next =
        within(&entry).get(depth + 1).map_or(StateRef::Plain(entry), |inner| StateRef::Composite(*inner));
    Some((composite, box_of(machine, next)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::strategy;

    /// A machine in which a robot rests, or plays in one of two states.
    fn machine() -> Machine {
        let pieces = r#"schemas: {}, assemblages: {}, machines: {"m": (start: "rest", states: {
                "rest": (on: [(when: Known(Ball), go: "play"), (when: After(9.0), go: "rest")]),
                "play": (start: "near", on: [(when: Not(Known(Ball)), go: "rest"), (when: After(0.5), go: "rest")], states: {
                    "near": (on: [(when: Always, go: "far"), (when: HasBall, go: "rest"), (when: HoldsBall, go: "far")]),
                    "far": (),
                }),
            })},
            roles: {"r": Plays(tag: "R", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)])},"#;
        strategy("r", pieces).machines.remove(0)
    }

    /// The lines as `from > to: conditions`.
    fn told(graph: &ChartGraph) -> Vec<String> {
        let name = |at: usize| &graph.boxes[at].name;
        let lines = graph.lines.iter().map(|line| {
            let ways: Vec<&str> = line.ways.iter().map(|way| way.when.as_str()).collect();
            format!("{} > {}: {}", name(line.from), name(line.to), ways.join(", "))
        });
        lines.collect()
    }

    #[test]
    fn each_pair_of_states_has_one_line_with_all_its_conditions_and_a_composite_state_leads_to_its_start() {
        let graph = ChartGraph::of(&machine(), 0);
        assert_eq!(
            told(&graph),
            [
                "play > near: ",
                "play > rest: not Known(Ball), after 0.5 s",
                "near > far: always, holds the ball",
                "near > rest: has the ball",
                "rest > play: Known(Ball)",
                "rest > rest: after 9 s",
            ]
        );
        assert_eq!(graph.boxes[graph.start].name, "rest");
    }

    #[test]
    fn a_line_is_labelled_with_its_first_conditions_in_short() {
        let way = |number, when: &str| ChartWay {
            id: TransitionId { machine: 0, of: StateRef::Plain(0), number },
            when: when.to_owned(),
        };
        let line = |ways| ChartLine { from: 0, to: 1, ways };
        let long = "ball_lost and mate_knows_ball and far_from_home";
        assert_eq!(line(vec![way(2, long)]).label(), ["3 ball_lost and mate_knows_ball…"]);
        let many = (0..4).map(|number| way(number, "stuck")).collect();
        assert_eq!(line(many).label(), ["1 stuck", "2 stuck", "and 2 more"]);
        assert!(line(Vec::new()).label().is_empty());
    }

    #[test]
    fn ways_out_are_told_in_the_order_in_which_they_are_asked() {
        let graph = ChartGraph::of(&machine(), 0);
        let near = graph.boxes.iter().position(|known| known.name == "near").expect("the state exists");
        let ways: Vec<&str> = graph.ways_out(near).into_iter().map(|(way, _)| way.when.as_str()).collect();
        assert_eq!(ways, ["always", "has the ball", "holds the ball"]);
        let around: Vec<&str> =
            graph.with_surroundings(near).map(|at| graph.boxes[at].name.as_str()).collect();
        assert_eq!(around, ["near", "play"]);
    }
}
