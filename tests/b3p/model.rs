//! The model: robots that run the match's own state machine, a radio with a bounded delay, and everything that may happen next.

use stateright::{Model, Property};
use touchline::ids::PlayerNumber;
use touchline::protocol::b3p::{B3p, Book, BookingInput, BookingTerm, Distance, OwnTick};

use super::checks;
use super::team::{Misfortune, Release, Team};

/// What every robot's clock shows at all times: after each tick all are set back, so that equal situations are equal states.
const NOW: OwnTick = 100;
const MOST_ROBOTS: usize = 3;

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct State {
    pub robots: Vec<Robot>,
    /// In order: what is in flight is a multiset.
    pub in_flight: Vec<Envelope>,
    /// By sender and receiver, how many messages were lost since the last that arrived.
    lost: [[u8; MOST_ROBOTS]; MOST_ROBOTS],
    pub happened: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Robot {
    pub machine: B3p,
    pub distance: u8,
    pub up: bool,
    pub sees: bool,
    turned: bool,
    /// For releases that are not the machine's own: the key of the booking that was released.
    released: Option<Distance>,
}

/// A message in flight.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Envelope {
    pub from: PlayerNumber,
    pub to: PlayerNumber,
    /// In so many ticks, at the end, it must have arrived.
    left: u8,
    pub book: Book,
}

/// What may happen next. Messages are named by their places among those in flight.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    Turn {
        robot: PlayerNumber,
        noise: u8,
    },
    Deliver(usize),
    Lose(usize),
    /// The tick ends: all have turned and nothing is overdue.
    Tick,
    Kick(Vec<u8>),
    Crash(PlayerNumber),
    Blind(PlayerNumber),
}

impl Robot {
    /// Whether the robot goes to the ball, and could.
    pub fn goes(&self) -> bool {
        self.up && self.sees && self.machine.goes()
    }
}

impl State {
    pub fn robot(&self, number: PlayerNumber) -> &Robot {
        &self.robots[usize::from(number)]
    }

    /// How many robots go to the ball.
    pub fn going(&self) -> usize {
        self.robots.iter().filter(|robot| robot.goes()).count()
    }

    fn turn(&mut self, team: &Team, number: PlayerNumber, noise: u8) {
        let robot = &mut self.robots[usize::from(number)];
        robot.turned = true;
        let key = robot.machine.booking().map(|known| known.key);
        let distance = robot.sees.then(|| Distance(u32::from(robot.distance + noise)));
        let Some(mut book) = robot.machine.step(NOW, BookingInput::Turn { distance }) else { return };
        if book.distance.is_infinite() && team.release != Release::Repeated {
            let again = robot.released.is_some();
            let key_before = *robot.released.get_or_insert(key.unwrap_or_default());
            if again && team.release != Release::RepeatedAsRenewal {
                return;
            }
            if team.release != Release::Once {
                (book.term, book.key) = (book.term - 1, key_before);
            }
        } else {
            robot.released = None;
        }
        for to in (0..team.robots).filter(|to| *to != number && self.robots[usize::from(*to)].up) {
            self.in_flight.push(Envelope { from: number, to, left: team.radio.delay, book });
        }
        self.in_flight.sort_unstable();
    }

    fn crash(&mut self, number: PlayerNumber) {
        self.in_flight.retain(|envelope| envelope.to != number);
        let robot = &mut self.robots[usize::from(number)];
        robot.machine.restart();
        (robot.up, robot.distance, robot.released) = (false, 0, None);
        self.lost[usize::from(number)] = [0; MOST_ROBOTS];
        for lost in &mut self.lost {
            lost[usize::from(number)] = 0;
        }
    }

    fn tick(&mut self) {
        let known = |robot: &Robot| robot.machine.booking().map_or(0, |known| known.term);
        let least = self.robots.iter().filter(|robot| robot.up).map(known).min().unwrap_or_default();
        let base = least.saturating_sub(1);
        for robot in &mut self.robots {
            robot.machine.rebase(NOW + 1, NOW, base);
            robot.turned = false;
        }
        for Envelope { left, book, .. } in &mut self.in_flight {
            *left -= 1;
            book.term = book.term.saturating_sub(base);
            if book.term < least - base {
                let nothing = Distance::default();
                *book = Book { term: BookingTerm::default(), distance: nothing, key: nothing };
            }
        }
        self.in_flight.sort_unstable();
    }
}

impl Team {
    fn misfortunes(&self, state: &State, actions: &mut Vec<Action>) {
        let up = || (0..self.robots).filter(|number| state.robot(*number).up);
        match self.misfortune {
            _ if state.happened => {}
            Misfortune::None => {}
            Misfortune::Kick => {
                let here: Vec<u8> = state.robots.iter().map(|robot| robot.distance).collect();
                let elsewhere = self.places().into_iter().filter(|place| *place != here);
                actions.extend(elsewhere.map(Action::Kick));
            }
            Misfortune::Crash => actions.extend(up().map(Action::Crash)),
            Misfortune::Blindness => actions.extend(up().map(Action::Blind)),
        }
    }
}

impl Model for Team {
    type State = State;
    type Action = Action;

    fn init_states(&self) -> Vec<State> {
        let robot = |(number, distance)| {
            let machine = self.machine(number);
            Robot { machine, distance, up: true, sees: true, turned: false, released: None }
        };
        let state = |place: Vec<u8>| State {
            robots: (0..).zip(place).map(robot).collect(),
            in_flight: Vec::new(),
            lost: Default::default(),
            happened: false,
        };
        self.places().into_iter().map(state).collect()
    }

    fn actions(&self, state: &State, actions: &mut Vec<Action>) {
        let waiting = |number: &PlayerNumber| state.robot(*number).up && !state.robot(*number).turned;
        for robot in (0..self.robots).filter(waiting) {
            let noises = if state.robot(robot).sees { self.noise } else { 0 };
            actions.extend((0..=noises).map(|noise| Action::Turn { robot, noise }));
        }
        let all_turned = !(0..self.robots).any(|number| waiting(&number));
        if all_turned || !self.in_phase {
            for (place, envelope) in state.in_flight.iter().enumerate() {
                if place == 0 || state.in_flight[place - 1] != *envelope {
                    actions.push(Action::Deliver(place));
                    if state.lost[usize::from(envelope.from)][usize::from(envelope.to)] < self.radio.losses {
                        actions.push(Action::Lose(place));
                    }
                }
            }
        }
        if all_turned && state.in_flight.iter().all(|envelope| envelope.left > 0) {
            actions.push(Action::Tick);
        }
        self.misfortunes(state, actions);
    }

    fn next_state(&self, before: &State, action: Action) -> Option<State> {
        let mut state = before.clone();
        state.happened |= matches!(action, Action::Kick(_) | Action::Crash(_) | Action::Blind(_));
        match action {
            Action::Turn { robot, noise } => state.turn(self, robot, noise),
            Action::Deliver(place) => {
                let Envelope { from, to, book, .. } = state.in_flight.remove(place);
                state.lost[usize::from(from)][usize::from(to)] = 0;
                state.robots[usize::from(to)].machine.step(NOW, BookingInput::Hear { from, book });
            }
            Action::Lose(place) => {
                let Envelope { from, to, .. } = state.in_flight.remove(place);
                state.lost[usize::from(from)][usize::from(to)] += 1;
            }
            Action::Tick => state.tick(),
            Action::Kick(place) => {
                for (robot, distance) in state.robots.iter_mut().zip(place).filter(|(robot, _)| robot.up) {
                    robot.distance = distance;
                }
            }
            Action::Crash(robot) => state.crash(robot),
            Action::Blind(robot) => {
                let blind = &mut state.robots[usize::from(robot)];
                (blind.sees, blind.distance) = (false, 0);
            }
        }
        Some(state)
    }

    fn properties(&self) -> Vec<Property<Team>> {
        checks::properties()
    }
}
