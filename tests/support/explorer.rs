//! The whole graph of a model, for what a checker's properties cannot say: how long something may last, whether it may come
//! again and again, and what can still be reached.

use std::collections::HashMap;
use std::hash::Hash;
use std::rc::Rc;

use petgraph::Direction::Incoming;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, EdgeIndex, NodeIndex};
use petgraph::visit::{EdgeRef, NodeFiltered};
use stateright::Model;

/// All states of a model in the order in which they are found, the nearest to the start first.
pub struct Explored<M: Model> {
    pub states: Vec<Rc<M::State>>,
    /// A node for each state, with an edge for each step.
    graph: DiGraph<(), M::Action>,
    /// The step by which each state was found: the last of a shortest path.
    found: Vec<Option<EdgeIndex>>,
}

impl<M: Model> Explored<M>
where
    M::State: Clone + Eq + Hash,
    M::Action: Clone,
{
    pub fn of(model: &M) -> Explored<M> {
        let mut explored = Explored { states: Vec::new(), graph: DiGraph::new(), found: Vec::new() };
        let mut known = HashMap::new();
        for state in model.init_states() {
            explored.place(&mut known, state);
        }
        explored.found.resize(explored.states.len(), None);
        let mut next = 0;
        while let Some(state) = explored.states.get(next).cloned() {
            for (action, state) in model.next_steps(&state) {
                let to = explored.place(&mut known, state);
                let step = explored.graph.add_edge(NodeIndex::new(next), to, action);
                if to.index() == explored.found.len() {
                    explored.found.push(Some(step));
                }
            }
            next += 1;
        }
        explored
    }

    fn place(&mut self, known: &mut HashMap<Rc<M::State>, NodeIndex>, state: M::State) -> NodeIndex {
        *known.entry(Rc::new(state)).or_insert_with_key(|state| {
            self.states.push(Rc::clone(state));
            self.graph.add_node(())
        })
    }

    pub fn marked(&self, mark: impl Fn(&M::State) -> bool) -> Vec<bool> {
        self.states.iter().map(|state| mark(state)).collect()
    }

    /// The states from which a marked one can be reached.
    pub fn reaching(&self, marked: &[bool]) -> Vec<bool> {
        let mut reaches = marked.to_vec();
        let mut open: Vec<NodeIndex> =
            self.graph.node_indices().filter(|place| marked[place.index()]).collect();
        while let Some(place) = open.pop() {
            for before in self.graph.neighbors_directed(place, Incoming) {
                if !std::mem::replace(&mut reaches[before.index()], true) {
                    open.push(before);
                }
            }
        }
        reaches
    }

    /// The states from which none that meets the goal can be reached, the nearest to the start first.
    pub fn stuck(&self, goal: impl Fn(&M::State) -> bool) -> Vec<usize> {
        let reaches = self.reaching(&self.marked(goal));
        (0..reaches.len()).filter(|place| !reaches[*place]).collect()
    }

    /// A shortest path to a state, in the checker's form: each state with the step that leaves it.
    pub fn path_to(&self, place: usize) -> Vec<(M::State, Option<M::Action>)> {
        let mut path = vec![(M::State::clone(&self.states[place]), None)];
        let mut place = place;
        while let Some(step) = self.found[place] {
            let (before, _) = self.graph.edge_endpoints(step).expect("the step is in the graph");
            place = before.index();
            path.push((M::State::clone(&self.states[place]), Some(self.graph[step].clone())));
        }
        path.reverse();
        path
    }

    /// How many of the steps that count may be taken in a row within these states; `None` if for ever.
    pub fn lasts(&self, within: &[bool], counts: impl Fn(&M::Action) -> bool) -> Option<usize> {
        let inside = NodeFiltered(&self.graph, |place: NodeIndex| within[place.index()]);
        let mut component = vec![usize::MAX; self.states.len()];
        let mut longest = Vec::new();
        // Steps lead to the same component or to one before.
        for members in kosaraju_scc(&inside) {
            members.iter().for_each(|place| component[place.index()] = longest.len());
            let mut here = 0;
            for step in members.iter().flat_map(|place| self.graph.edges(*place)) {
                let there = component[step.target().index()];
                if there == longest.len() && counts(step.weight()) {
                    return None;
                }
                let after = longest.get(there).map_or(0, |after| after + usize::from(counts(step.weight())));
                here = after.max(here);
            }
            longest.push(here);
        }
        longest.into_iter().max().or(Some(0))
    }

    /// A marked state of every set of states in which one may go round for ever by steps that count, and meet marked ones
    /// again and again.
    pub fn recurring(&self, marked: &[bool], counts: impl Fn(&M::Action) -> bool) -> Vec<usize> {
        let components = kosaraju_scc(&self.graph);
        let mut component = vec![0; self.states.len()];
        for (number, members) in components.iter().enumerate() {
            members.iter().for_each(|place| component[place.index()] = number);
        }
        let goes_round = |members: &[NodeIndex]| {
            members.iter().flat_map(|place| self.graph.edges(*place)).any(|step| {
                counts(step.weight()) && component[step.source().index()] == component[step.target().index()]
            })
        };
        (components.iter().filter(|members| goes_round(members)))
            .filter_map(|members| {
                members.iter().map(|place| place.index()).filter(|place| marked[*place]).min()
            })
            .collect()
    }

    /// Whether a step leads from a state to another so that this holds of the two.
    pub fn leads(&self, holds: impl Fn(usize, usize) -> bool) -> bool {
        self.graph.edge_references().any(|step| holds(step.source().index(), step.target().index()))
    }
}
