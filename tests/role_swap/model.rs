//! The model: robots that run the match's own state machine, a radio, and everything that may happen next.

use std::collections::BTreeSet;

use stateright::{Model, Property};
use touchline::ids::PlayerNumber;
use touchline::protocol::role_swap::{
    AttemptPhase, Configuration, Effect, Effects, Input, Lock, Message, OnMissingAck, Reassignment, RoleSwap,
    Sequence, Timer,
};

use super::checks::{self, Facts};
use super::network::{Envelope, Loss, Network};
use super::team::{Afterwards, Team, Timing, Version, subset};

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct State {
    pub robots: Vec<Robot>,
    pub network: Network,
    /// The configurations ever committed. Position messages may bring any of them to anybody at any time.
    pub news: BTreeSet<Configuration>,
    pub attempts: u8,
    pub losses: u8,
    pub duplicates: u8,
    pub crashes: u8,
    /// What has happened of that which a check looks for.
    pub facts: Facts,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Robot {
    pub machine: RoleSwap,
    pub up: bool,
    running: [bool; 3],
}

/// What may happen next. Messages are named by their places among those in flight.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    Initiate { robot: PlayerNumber, reassignment: Reassignment, asked: Vec<PlayerNumber> },
    Deliver(usize),
    DeliverAndKeep(usize),
    Lose(usize),
    TimeOut(PlayerNumber, Timer),
    Hear(PlayerNumber, Configuration),
    Crash { robot: PlayerNumber, unsent: Vec<usize> },
    Restart(PlayerNumber),
}

impl Robot {
    pub fn is_free(&self) -> bool {
        self.machine.lock().is_none() && self.machine.phase() == AttemptPhase::Idle
    }

    /// The timers that run.
    pub fn timers(&self) -> impl Iterator<Item = Timer> {
        let all = [Timer::Lock, Timer::Locks, Timer::Acks];
        all.into_iter().filter(|timer| self.up && self.running[*timer as usize])
    }
}

impl State {
    pub fn robot(&self, number: PlayerNumber) -> &Robot {
        &self.robots[usize::from(number)]
    }

    pub fn live(&self) -> impl Iterator<Item = &Robot> + Clone {
        self.robots.iter().filter(|robot| robot.up)
    }

    /// Whether a robot is engaged in its attempt of this number.
    pub fn attempt_goes_on(&self, initiator: PlayerNumber, attempt: Sequence) -> bool {
        let robot = self.robot(initiator);
        let (AttemptPhase::WaitingForLocks { sequence } | AttemptPhase::WaitingForAcks { sequence }) =
            robot.machine.phase()
        else {
            return false;
        };
        robot.up && sequence == attempt
    }
}

impl Team {
    /// Whether nothing is in flight, nobody is locked or initiating, and nobody is about to come back.
    pub fn is_quiet(&self, state: &State) -> bool {
        let here = |robot: &Robot| robot.up || self.crashes.afterwards == Afterwards::StaysDown;
        state.network.in_flight().is_empty()
            && state.robots.iter().all(here)
            && state.live().all(Robot::is_free)
    }

    fn timer_may_run_out(&self, state: &State, robot: PlayerNumber, timer: Timer) -> bool {
        let timing = if timer == Timer::Lock { self.lock_timers } else { self.initiators_timers };
        timing == Timing::Any || self.waits_in_vain(state, robot, timer)
    }

    /// Whether nothing of what a timer guards can come any more.
    fn waits_in_vain(&self, state: &State, robot: PlayerNumber, timer: Timer) -> bool {
        let machine = &state.robot(robot).machine;
        let network = &state.network;
        match (timer, machine.phase(), machine.lock()) {
            (Timer::Locks, AttemptPhase::WaitingForLocks { sequence: q }, _) => {
                machine.awaited().iter().all(|j| {
                    !network.any(robot, *j, |m| matches!(m, Message::Lock { sequence } if *sequence == q))
                        && !network.any(
                            *j,
                            robot,
                            |m| matches!(m, Message::AckLock { sequence, .. } if *sequence == q),
                        )
                })
            }
            (Timer::Acks, AttemptPhase::WaitingForAcks { sequence: q }, _) => {
                machine.awaited().iter().all(|j| {
                    !network.any(robot, *j, |m| matches!(m, Message::Swap { sequence, .. } if *sequence == q))
                        && !network.any(
                            *j,
                            robot,
                            |m| matches!(m, Message::AckSwap { sequence } if *sequence == q),
                        )
                })
            }
            (Timer::Lock, _, Some(Lock { by, sequence: q })) => {
                let swap = |m: &Message| matches!(m, Message::Swap { sequence, .. } if *sequence == q);
                let swap_may_come = state.attempt_goes_on(by, q) || network.any(by, robot, swap);
                let newer = |held: &Configuration| (held.epoch, held.initiator) >= (q, by);
                let news_may_come = self.news && self.held_by_the_living(state).any(newer);
                !swap_may_come && !news_may_come
            }
            _ => true,
        }
    }

    fn held_by_the_living<'a>(&self, state: &'a State) -> impl Iterator<Item = &'a Configuration> {
        state.live().filter_map(|robot| robot.machine.configuration())
    }

    /// Whether nothing can change any more but by new attempts, crashes and restarts: no message, no timer, and no position
    /// message of a live robot.
    pub fn is_settled(&self, state: &State) -> bool {
        let learns = |robot: &Robot, heard: &Configuration| {
            let mut machine = robot.machine.clone();
            machine.configuration() != Some(heard) && {
                machine.step(Input::Heard(heard.clone()));
                machine != robot.machine
            }
        };
        let timers = |robot: PlayerNumber| {
            state.robot(robot).timers().any(|timer| self.timer_may_run_out(state, robot, timer))
        };
        state.network.in_flight().is_empty()
            && !(0..self.robots).any(timers)
            && !(self.news
                && state.live().any(|robot| self.held_by_the_living(state).any(|heard| learns(robot, heard))))
    }

    fn run(&self, state: &mut State, robot: PlayerNumber, input: Input, answers_roll_back: bool) {
        let rolls_back = input == Input::TimeOut(Timer::Acks)
            && matches!(self.version, Version::Paper(rules)
                if !matches!(rules.on_missing_ack, OnMissingAck::Resend { .. }));
        let effects = state.robots[usize::from(robot)].machine.step(input);
        self.carry_out(state, robot, effects, rolls_back, answers_roll_back);
        if let Some(held) = state.robot(robot).machine.configuration().filter(|held| held.epoch > 0) {
            let held = held.clone();
            state.news.insert(held);
        }
    }

    fn carry_out(
        &self,
        state: &mut State,
        robot: PlayerNumber,
        effects: Effects,
        rolls_back: bool,
        answers: bool,
    ) {
        for effect in effects {
            let running = &mut state.robots[usize::from(robot)].running;
            match effect {
                Effect::Send { to, message } => {
                    let roll_back = match message {
                        Message::Swap { .. } => rolls_back,
                        Message::AckSwap { .. } => answers && self.tells_acks_apart(),
                        _ => false,
                    };
                    state.network.send(self.radio, Envelope { from: robot, to, message, roll_back });
                }
                Effect::Start(timer) => running[timer as usize] = true,
                Effect::Stop(timer) => running[timer as usize] = false,
                Effect::Announce | Effect::Finished(_) => {}
            }
        }
    }

    fn deliver(&self, state: &mut State, envelope: Envelope) {
        if state.robot(envelope.to).up {
            let input = Input::Receive { from: envelope.from, message: envelope.message };
            self.run(state, envelope.to, input, envelope.roll_back);
        }
    }

    fn initiations(&self, state: &State, actions: &mut Vec<Action>) {
        let Some(initiators) = self.attempts.get(usize::from(state.attempts)) else { return };
        for &robot in initiators.iter().filter(|robot| {
            let robot = state.robot(**robot);
            robot.up && robot.is_free()
        }) {
            for reassignment in self.reassignments(robot) {
                let groups = self.groups(robot).into_iter();
                actions.extend(groups.map(|asked| Action::Initiate {
                    robot,
                    reassignment: reassignment.clone(),
                    asked,
                }));
            }
        }
    }

    fn crashes(&self, state: &State, actions: &mut Vec<Action>) {
        for &robot in &self.crashes.of {
            if state.robot(robot).up && state.crashes < self.crashes.at_most {
                let sent = |place: &usize| state.network.in_flight()[*place].from == robot;
                let mut sent: Vec<usize> = (0..state.network.in_flight().len()).filter(sent).collect();
                if self.radio.loss == Loss::Any {
                    sent.clear();
                }
                let choices = 0_u32..1 << sent.len();
                actions.extend(choices.map(|chosen| Action::Crash { robot, unsent: subset(&sent, chosen) }));
            }
        }
    }
}

impl Model for Team {
    type State = State;
    type Action = Action;

    fn init_states(&self) -> Vec<State> {
        let new = |number| Robot { machine: self.machine(number), up: true, running: [false; 3] };
        vec![State {
            robots: (0..self.robots).map(new).collect(),
            network: Network::default(),
            news: BTreeSet::new(),
            attempts: 0,
            losses: 0,
            duplicates: 0,
            crashes: 0,
            facts: Facts::default(),
        }]
    }

    fn actions(&self, state: &State, actions: &mut Vec<Action>) {
        self.initiations(state, actions);
        let deliverable = || state.network.deliverable(self.radio);
        actions.extend(deliverable().map(Action::Deliver));
        if state.duplicates < self.radio.duplicates {
            actions.extend(deliverable().map(Action::DeliverAndKeep));
        }
        actions.extend(state.network.losable(self.radio, state.losses).map(Action::Lose));
        for robot in 0..self.robots {
            let timers = state.robot(robot).timers();
            let over = timers.filter(|timer| self.timer_may_run_out(state, robot, *timer));
            actions.extend(over.map(|timer| Action::TimeOut(robot, timer)));
            let here = state.robot(robot);
            if self.news && here.up {
                let heard = state.news.iter().filter(|news| here.machine.configuration() < Some(*news));
                actions.extend(heard.map(|news| Action::Hear(robot, news.clone())));
            }
            if !here.up && matches!(self.crashes.afterwards, Afterwards::Restarts { .. }) {
                actions.push(Action::Restart(robot));
            }
        }
        self.crashes(state, actions);
    }

    fn next_state(&self, before: &State, action: Action) -> Option<State> {
        let mut state = before.clone();
        match action.clone() {
            Action::Initiate { robot, reassignment, asked } => {
                state.attempts += 1;
                let participants = asked.into_iter().collect();
                self.run(&mut state, robot, Input::Initiate { reassignment, participants }, false);
            }
            Action::Deliver(place) => {
                let envelope = state.network.remove(place);
                self.deliver(&mut state, envelope);
            }
            Action::DeliverAndKeep(place) => {
                state.duplicates += 1;
                let envelope = state.network.in_flight()[place].clone();
                self.deliver(&mut state, envelope);
            }
            Action::Lose(place) => {
                state.network.remove(place);
                state.losses += u8::from(self.radio.loss != Loss::Any);
            }
            Action::TimeOut(robot, timer) => {
                state.robots[usize::from(robot)].running[timer as usize] = false;
                self.run(&mut state, robot, Input::TimeOut(timer), false);
            }
            Action::Hear(robot, news) => {
                self.run(&mut state, robot, Input::Heard(news), false);
                if state == *before {
                    return None;
                }
            }
            Action::Crash { robot, unsent } => {
                state.crashes += 1;
                state.network.drop_all(&unsent);
                let crashed = &mut state.robots[usize::from(robot)];
                let memory_kept = self.crashes.afterwards != Afterwards::Restarts { memory_kept: false };
                crashed.machine.restart(memory_kept);
                (crashed.up, crashed.running) = (false, [false; 3]);
            }
            Action::Restart(robot) => state.robots[usize::from(robot)].up = true,
        }
        state.facts.extend(checks::happened(self, before, &action, &state));
        Some(state)
    }

    fn properties(&self) -> Vec<Property<Team>> {
        checks::properties(self)
    }
}
