//! The whole graph of a small model, for what the checker's properties cannot say: from which states others can still be
//! reached.

use std::collections::HashMap;
use std::rc::Rc;

use stateright::Model;

use super::model::{Action, State};
use super::team::Team;

pub struct Graph {
    pub states: Vec<Rc<State>>,
    /// The states from which one step leads to each.
    before: Vec<Vec<usize>>,
    /// By which step each was found first: the last of a shortest path.
    found: Vec<Option<(usize, Action)>>,
}

impl Graph {
    pub fn of(team: &Team) -> Graph {
        let mut graph = Graph { states: Vec::new(), before: Vec::new(), found: Vec::new() };
        let mut known = HashMap::new();
        for state in team.init_states() {
            graph.place(&mut known, state, None);
        }
        let mut next = 0;
        while let Some(state) = graph.states.get(next).cloned() {
            for (action, state) in team.next_steps(&state) {
                let place = graph.place(&mut known, state, Some((next, action)));
                graph.before[place].push(next);
            }
            next += 1;
        }
        graph
    }

    fn place(
        &mut self,
        known: &mut HashMap<Rc<State>, usize>,
        state: State,
        found: Option<(usize, Action)>,
    ) -> usize {
        let state = Rc::new(state);
        *known.entry(state).or_insert_with_key(|state| {
            self.states.push(Rc::clone(state));
            self.before.push(Vec::new());
            self.found.push(found);
            self.states.len() - 1
        })
    }

    /// The states from which no state that meets the goal can be reached, the nearest to the start first.
    pub fn stuck(&self, goal: impl Fn(&State) -> bool) -> Vec<usize> {
        let mut reaches: Vec<bool> = self.states.iter().map(|state| goal(state)).collect();
        let mut open: Vec<usize> = (0..reaches.len()).filter(|place| reaches[*place]).collect();
        while let Some(place) = open.pop() {
            for before in &self.before[place] {
                if !std::mem::replace(&mut reaches[*before], true) {
                    open.push(*before);
                }
            }
        }
        (0..reaches.len()).filter(|place| !reaches[*place]).collect()
    }

    /// A shortest path to a state, in the checker's form: each state with the step that leaves it.
    pub fn path_to(&self, mut place: usize) -> Vec<(State, Option<Action>)> {
        let mut path = vec![(State::clone(&self.states[place]), None)];
        while let Some((before, action)) = self.found[place].clone() {
            path.push((State::clone(&self.states[before]), Some(action)));
            place = before;
        }
        path.reverse();
        path
    }
}

/// Whether a robot is locked or initiating.
pub fn somebody_is_busy(state: &State) -> bool {
    !state.live().all(|robot| robot.is_free())
}
