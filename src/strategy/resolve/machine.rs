//! Machines: states on any number of levels become a row of the states that a robot can be in, and a row of those around them.

use std::collections::BTreeMap;

use super::{MOST_PIECES, Resolved, Resolver};
use crate::data::{Bound, Field, no_such};
use crate::strategy::file::{MachineFile, StateFile, TransitionFile, TurnFile};
use crate::strategy::pieces::{CompositeState, Machine, State, Transition, Turn};

/// The states of a machine as a file has them, in rows.
#[derive(Default)]
struct Rows<'f> {
    /// Those that hold no others.
    plain: Vec<NestedState<'f>>,
    /// Those that hold others.
    composite: Vec<NestedState<'f>>,
    /// Where in the rows the state of a name is.
    places: BTreeMap<&'f str, StateRow>,
}

/// A state and where it is.
struct NestedState<'f> {
    name: &'f str,
    file: &'f StateFile,
    at: Field,
    /// Places in the row of composite states, the outermost first.
    within: Vec<usize>,
}

/// A place in one of the rows.
#[derive(Clone, Copy)]
enum StateRow {
    Plain(usize),
    Composite(usize),
}

impl<'f> Rows<'f> {
    /// How many composite states are around the state at a place.
    fn around(&self, place: StateRow) -> usize {
        match place {
            StateRow::Plain(index) => self.plain[index].within.len(),
            StateRow::Composite(index) => self.composite[index].within.len(),
        }
    }

    /// The state that a robot is in once it goes to a place: inside a composite state, its start.
    fn entry(&self, place: StateRow) -> Option<usize> {
        match place {
            StateRow::Plain(index) => Some(index),
            StateRow::Composite(index) => {
                let start = self.composite[index].file.start.as_deref()?;
                self.entry(*self.places.get(start)?)
            }
        }
    }
}

impl Resolver<'_> {
    pub(super) fn machine(&mut self, name: &str, file: &MachineFile, at: &Field) -> Resolved<Machine> {
        let mut rows = Rows::default();
        self.lay_out(&file.states, &[], &at.key("states"), &mut rows)?;
        self.count("states", rows.places.len(), MOST_PIECES, &at.key("states"))?;
        self.check_start(&file.start, &file.states, &at.key("start"))?;
        let start = rows.places.get(file.start.as_str()).and_then(|place| rows.entry(*place));
        let composites = (rows.composite.iter())
            .map(|state| {
                let name = state.name.into();
                Ok(CompositeState { name, transitions: self.transitions(state, &rows)? })
            })
            .collect::<Resolved<_>>()?;
        let states = rows.plain.iter().map(|state| self.state(state, &rows)).collect::<Resolved<_>>()?;
        Ok(Machine { name: name.into(), start: start.unwrap_or_default(), states, composites })
    }

    /// Puts the states of one level, and those in them, into the rows.
    fn lay_out<'f>(
        &mut self,
        states: &'f BTreeMap<String, StateFile>,
        within: &[usize],
        at: &Field,
        rows: &mut Rows<'f>,
    ) -> Resolved<()> {
        for (name, file) in states {
            let state = NestedState { name, file, at: at.key(name), within: within.into() };
            let place = match file.states {
                None => StateRow::Plain(rows.plain.len()),
                Some(_) => StateRow::Composite(rows.composite.len()),
            };
            if rows.places.insert(name, place).is_some() {
                return self.fault(&state.at, "another state of this machine has the same name");
            }
            let Some(inner) = &file.states else {
                if file.start.is_some() {
                    return self
                        .fault(&state.at.key("start"), "a state without `states` of its own has no start");
                }
                rows.plain.push(state);
                continue;
            };
            self.check_composite(file, inner, &state.at)?;
            let at = state.at.key("states");
            let within = [within, &[rows.composite.len()]].concat();
            rows.composite.push(state);
            self.nested(&at, |s| s.lay_out(inner, &within, &at, rows))?;
        }
        Ok(())
    }

    /// A composite state has states, one of which is the first, and leaves what a robot does to them.
    fn check_composite(
        &self,
        file: &StateFile,
        states: &BTreeMap<String, StateFile>,
        at: &Field,
    ) -> Resolved<()> {
        if states.is_empty() {
            return self.fault(&at.key("states"), "needs at least one state");
        }
        let Some(start) = &file.start else {
            return self.fault(at, "`start` must say which of its `states` is the first");
        };
        self.check_start(start, states, &at.key("start"))?;
        let said = [
            ("run", file.run.is_some()),
            ("speed", file.speed != 1.0),
            ("reverse", file.reverse),
            ("hold", file.hold),
            ("kick", !file.kick.is_empty()),
            ("turn", file.turn != TurnFile::Stay),
        ];
        match said.into_iter().find(|(_, said)| *said) {
            Some((field, _)) => self.fault(&at.key(field), "must be said of the states in it"),
            None => Ok(()),
        }
    }

    fn check_start(&self, start: &str, states: &BTreeMap<String, StateFile>, at: &Field) -> Resolved<()> {
        self.index(states, "state", start, at).map(drop)
    }

    fn transitions(&mut self, state: &NestedState, rows: &Rows) -> Resolved<Vec<Transition>> {
        let on = state.file.on.iter().enumerate();
        on.map(|(i, file)| self.transition(file, rows, &state.at.key("on").index(i))).collect()
    }

    fn transition(&mut self, file: &TransitionFile, rows: &Rows, at: &Field) -> Resolved<Transition> {
        let when = self.resolved_feature(&file.when, &at.key("when"))?;
        let to = rows.places.get(file.go.as_str()).copied();
        let Some((place, go)) = to.and_then(|place| Some((place, rows.entry(place)?))) else {
            return self.fault(&at.key("go"), no_such("state", &file.go, rows.places.keys()));
        };
        Ok(Transition { when, go, around: rows.around(place), label: file.when.to_string() })
    }

    fn state(&mut self, placed: &NestedState, rows: &Rows) -> Resolved<State> {
        let (file, at) = (placed.file, &placed.at);
        let assemblage = match &file.run {
            Some(run) => Some(self.index(&self.file.assemblages, "assemblage", run, &at.key("run"))?),
            None => None,
        };
        let turn = match &file.turn {
            TurnFile::Stay => Turn::Stay,
            TurnFile::Face(point) => {
                let mut point = point.clone();
                self.point(&mut point, &at.key("turn"))?;
                Turn::Face(point)
            }
            TurnFile::Spin(rate) => {
                self.within(*rate, Bound::TURN_RATE.signed(), &at.key("turn"))?;
                Turn::Spin(rate.to_radians())
            }
        };
        let transitions = self.transitions(placed, rows)?;
        self.within(file.speed, Bound::SHARE, &at.key("speed"))?;
        self.source.distinct(&at.key("kick"), &file.kick)?;
        let around = placed.within.iter().map(|composite| rows.composite[*composite].file);
        Ok(State {
            name: placed.name.into(),
            assemblage,
            speed: file.speed,
            reverse: file.reverse,
            acquires: file.acquires || around.into_iter().any(|state| state.acquires),
            hold: file.hold,
            kicks: file.kick.clone(),
            turn,
            transitions,
            within: placed.within.clone(),
        })
    }
}
