//! The whole graph of a model, for what the checker's properties cannot say: how long something may last, whether it may come
//! again and again, and what can still be reached.

use std::collections::HashMap;
use std::rc::Rc;

use stateright::Model;

use super::model::{Action, State};
use super::team::Team;

pub struct Graph {
    team: Team,
    pub states: Vec<Rc<State>>,
    /// Where each state's steps lead, and whether the step ends a tick.
    steps: Vec<Vec<(u32, bool)>>,
    /// From which state each was found first: the last of a shortest path.
    found: Vec<Option<u32>>,
}

/// The graph's states in strongly connected components, in an order in which steps lead to the same component or to one before.
struct Components {
    of: Vec<u32>,
    order: Vec<u32>,
}

const NOWHERE: u32 = u32::MAX;

impl Graph {
    pub fn of(team: Team) -> Graph {
        let mut graph = Graph { team, states: Vec::new(), steps: Vec::new(), found: Vec::new() };
        let mut known = HashMap::new();
        for state in graph.team.init_states() {
            graph.place(&mut known, state, None);
        }
        let mut next = 0;
        let mut actions = Vec::new();
        while let Some(state) = graph.states.get(next).cloned() {
            graph.team.actions(&state, &mut actions);
            let mut steps = Vec::with_capacity(actions.len());
            for action in actions.drain(..) {
                let ends = action == Action::Tick;
                if let Some(state) = graph.team.next_state(&state, action) {
                    steps.push((graph.place(&mut known, state, Some(next as u32)), ends));
                }
            }
            graph.steps.push(steps);
            next += 1;
        }

        graph
    }

    fn place(&mut self, known: &mut HashMap<Rc<State>, u32>, state: State, from: Option<u32>) -> u32 {
        if let Some(place) = known.get(&state) {
            return *place;
        }
        let state = Rc::new(state);
        let place = self.states.len() as u32;
        known.insert(Rc::clone(&state), place);
        self.states.push(state);
        self.found.push(from);
        place
    }

    pub fn marked(&self, mark: impl Fn(&State) -> bool) -> Vec<bool> {
        self.states.iter().map(|state| mark(state)).collect()
    }

    /// How many ticks in a row may end within these states; `None` if for ever.
    pub fn lasts(&self, within: &[bool]) -> Option<usize> {
        let components = self.components(within);
        let mut longest = vec![0; self.states.len()];
        for &place in &components.order {
            for (to, ends) in self.within(place, within) {
                if ends && components.of[to as usize] == components.of[place as usize] {
                    return None;
                }
                longest[place as usize] =
                    longest[place as usize].max(longest[to as usize] + usize::from(ends));
            }
        }
        longest.into_iter().max()
    }

    /// A marked state of every set of states in which the team may go round for ever and meet marked ones again and again.
    pub fn recurring(&self, marked: &[bool]) -> Vec<usize> {
        let components = self.components(&vec![true; self.states.len()]);
        let mut rounds = vec![false; self.states.len()];
        let mut meets = vec![None; self.states.len()];
        for (place, steps) in self.steps.iter().enumerate() {
            let here = components.of[place];
            if marked[place] {
                meets[here as usize].get_or_insert(place);
            }
            rounds[here as usize] |=
                steps.iter().any(|(to, ends)| *ends && components.of[*to as usize] == here);
        }
        meets.into_iter().zip(rounds).filter_map(|(place, rounds)| place.filter(|_| rounds)).collect()
    }

    /// The states from which a marked one can be reached.
    pub fn reaching(&self, marked: &[bool]) -> Vec<bool> {
        let components = self.components(&vec![true; self.states.len()]);
        let mut reaches = vec![false; self.states.len()];
        for &place in &components.order {
            let there = |(to, _): &(u32, bool)| reaches[components.of[*to as usize] as usize];
            let reached = marked[place as usize] || self.steps[place as usize].iter().any(there);
            reaches[components.of[place as usize] as usize] |= reached;
        }
        components.of.iter().map(|component| reaches[*component as usize]).collect()
    }

    /// Whether a step, but for a misfortune, leads from a state of the one kind to one of the other.
    pub fn leads(&self, from: &[bool], to: &[bool]) -> bool {
        (0..self.states.len()).any(|place| {
            let step = |(next, _): &(u32, bool)| {
                let unlucky = self.states[place].happened != self.states[*next as usize].happened;
                to[*next as usize] && !unlucky
            };
            from[place] && self.steps[place].iter().any(step)
        })
    }

    /// A shortest path to the first of these states: each state with the step that leaves it.
    pub fn path_to(&self, marked: &[bool]) -> Option<Vec<(State, Option<Action>)>> {
        let mut place = marked.iter().position(|marked| *marked)?;
        let mut path = vec![(State::clone(&self.states[place]), None)];
        while let Some(before) = self.found[place] {
            let state = &self.states[before as usize];
            let leads = |(_, next): &(Action, State)| *next == path[path.len() - 1].0;
            let step = self.team.next_steps(state).into_iter().find(leads);
            path.push((State::clone(state), step.map(|(action, _)| action)));
            place = before as usize;
        }
        path.reverse();
        Some(path)
    }

    fn within(&self, place: u32, within: &[bool]) -> impl Iterator<Item = (u32, bool)> {
        let from = within[place as usize];
        self.steps[place as usize].iter().copied().filter(move |(to, _)| from && within[*to as usize])
    }

    /// By Tarjan's algorithm, with a stack of its own. Only steps within these states count.
    fn components(&self, within: &[bool]) -> Components {
        let count = self.states.len();
        let (mut index, mut low) = (vec![NOWHERE; count], vec![0; count]);
        let mut components = Components { of: vec![NOWHERE; count], order: Vec::with_capacity(count) };
        let (mut open, mut calls) = (Vec::new(), Vec::new());
        let (mut next, mut component) = (0, 0);
        for root in 0..count as u32 {
            if index[root as usize] == NOWHERE {
                calls.push((root, 0));
            }
            while let Some((place, step)) = calls.pop() {
                let here = place as usize;
                if index[here] == NOWHERE {
                    (index[here], low[here]) = (next, next);
                    next += 1;
                    open.push(place);
                }
                let followed = self.steps[here][step..].iter().zip(step..).find(|((to, _), _)| {
                    let to = *to as usize;
                    if !(within[here] && within[to]) || components.of[to] != NOWHERE {
                        return false;
                    }
                    if index[to] != NOWHERE {
                        low[here] = low[here].min(low[to]);
                    }
                    index[to] == NOWHERE
                });
                if let Some(((to, _), step)) = followed {
                    // Comes back to the same step, to take over what the call found.
                    calls.push((place, step));
                    calls.push((*to, 0));
                    continue;
                }
                if low[here] == index[here] {
                    while let Some(member) = open.pop() {
                        components.of[member as usize] = component;
                        components.order.push(member);
                        if member == place {
                            break;
                        }
                    }
                    component += 1;
                }
            }
        }
        components
    }
}
