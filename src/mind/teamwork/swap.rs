//! Role swaps in a match: runs the protocol's state machine, its timers and the policy that decides when to swap.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use smallvec::SmallVec;

use super::attempts::{LockRequests, SwapAttempts};
use super::team_model::{TeamModel, kick_off_roles};
use crate::clock::Clock;
use crate::comms::messages::{Inbox, TeamMessage};
use crate::comms::tcm::TcmClient;
use crate::geometry::angle;
use crate::ids::{PlayerNumber, RobotId};
use crate::mind::world_model::WorldModel;
use crate::pitch::BallKind;
use crate::pitch::Pitch;
use crate::protocol::policy::{ColumnValues, Knowledge, Player, PolicyState, Valued};
use crate::protocol::role_swap::{
    Assignment, AttemptPhase, Effect, Hardened, Input, Message, Outcome, Paper, Reassignment, RoleIndex,
    RoleSwap, Timer,
};
use crate::rng::{Dice, Seed};
use crate::robot::{OffPitch, Restart, Robot};
use crate::strategy::teamwork::{Mechanism, Protocol, RoleSwapSpec, Timers};
use crate::strategy::{Role, Strategies, Strategy};

/// A robot's part in role swaps.
#[derive(Component, Clone, Debug)]
pub struct Swapping {
    /// The protocol's state machine.
    pub machine: RoleSwap,
    /// What became of the swaps that the robot has begun.
    pub attempts: SwapAttempts,
    /// What became of the locks that others have asked it for.
    pub requests: LockRequests,
    /// When the timers run out, in ticks.
    deadlines: [Option<u64>; 3],
    /// It starts no attempt before this tick.
    earliest: u64,
    /// Whether the robot has been reassigned since it gave its lock.
    reassigned: bool,
    policy: PolicyState,
    /// What it should broadcast of its values, and the column that it wishes for.
    pub values: Option<(ColumnValues, Option<u8>)>,
    /// What the team will look like if its attempt succeeds.
    planned: Option<Assignment>,
    /// A swap that a script wants, whatever the policy says.
    pub(super) asked: Option<Reassignment>,
    pub(super) dice: Dice,
}

/// A person or a script wants a robot to decide that roles are swapped.
#[derive(Clone, Debug)]
pub struct SwapAsked(pub Reassignment);

impl Swapping {
    /// The part of a robot whose team has just kicked off; `None` if its strategy swaps no roles.
    pub fn new(strategy: &Strategy, id: RobotId, seed: Seed) -> Option<Swapping> {
        let spec = strategy.teamwork.role_swap.as_ref()?;
        let all = kick_off_roles(strategy);
        let machine = match spec.protocol {
            Protocol::Paper(rules) => RoleSwap::Paper(Paper::new(id.number, all, rules)),
            Protocol::Hardened => RoleSwap::Hardened(Hardened::new(id.number, all)),
            Protocol::HardenedWithout(left_out) => {
                RoleSwap::Hardened(Hardened::without(id.number, all, left_out))
            }
        };
        Some(Swapping {
            machine,
            attempts: SwapAttempts::default(),
            requests: LockRequests::default(),
            deadlines: [None; 3],
            earliest: 0,
            reassigned: false,
            policy: PolicyState::default(),
            values: None,
            planned: None,
            asked: None,
            dice: Dice::new(seed, "back-off", Some(id)),
        })
    }

    /// Whether the robot is locked although its timer has run out, or does not run.
    pub fn is_overdue(&self, tick: u64) -> bool {
        let deadline = self.deadlines[Timer::Lock as usize];
        self.machine.lock().is_some() && deadline.is_none_or(|deadline| tick > deadline)
    }

    /// After an attempt that failed, everybody who took part waits a short time before another one, in case two attempts ran
    /// into each other (section VII-A.1).
    fn back_off(&mut self, timers: &Timers, clock: &Clock) {
        let (least, most) = timers.back_off;
        let wait = least + (most - least) * self.dice.uniform();
        self.earliest = self.earliest.max(clock.tick + clock.ticks(wait));
    }

    /// The robot was switched off and on again.
    pub(super) fn restart(&mut self, restart: Restart) {
        self.machine.restart(restart == Restart::Kept);
        self.attempts.give_up();
        self.deadlines = [None; 3];
        self.policy = PolicyState::default();
        (self.values, self.planned, self.asked) = (None, None, None);
    }
}

/// A robot that swaps roles with its team mates.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Swapper {
    id: &'static RobotId,
    robot: &'static Robot,
    inbox: &'static Inbox,
    model: &'static WorldModel,
    swapping: &'static mut Swapping,
    team_model: &'static mut TeamModel,
    role: &'static mut Role,
    client: &'static mut TcmClient,
    off_pitch: Has<OffPitch>,
}

pub(super) fn swap_roles(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    ball: Res<BallKind>,
    mut robots: Query<Swapper>,
) {
    for mut robot in &mut robots {
        let strategy = strategies.of(robot.id.team);
        let Some(spec) = &strategy.teamwork.role_swap else { continue };
        if !robot.robot.decides(&clock) || !strategy.teamwork.has(Mechanism::RoleSwap) {
            continue;
        }
        robot.receive(&spec.timers, &clock);
        robot.time_out(&spec.timers, &clock);
        if !robot.off_pitch && robot.model.is_localised() {
            robot.decide(spec, strategy, &pitch, ball.radius, &clock);
        }
        robot.take_role();
    }
}

impl SwapperItem<'_, '_> {
    fn receive(&mut self, timers: &Timers, clock: &Clock) {
        for received in &self.inbox.0 {
            let input = match &received.message {
                TeamMessage::RoleSwap(message) => {
                    Input::Receive { from: received.from, message: message.clone() }
                }
                TeamMessage::Position(position) => match &position.configuration {
                    Some(configuration) => Input::Heard(configuration.clone()),
                    None => continue,
                },
                _ => continue,
            };
            self.step(input, timers, clock);
        }
    }

    fn time_out(&mut self, timers: &Timers, clock: &Clock) {
        for timer in [Timer::Lock, Timer::Locks, Timer::Acks] {
            let deadline = &mut self.swapping.deadlines[timer as usize];
            if deadline.take_if(|deadline| clock.tick >= *deadline).is_some() {
                let was_locked = self.swapping.machine.lock().is_some();
                self.step(Input::TimeOut(timer), timers, clock);
                // It took part in an attempt that came to nothing.
                if timer == Timer::Lock && was_locked && !self.swapping.reassigned {
                    self.swapping.requests.ran_out += 1;
                    self.swapping.back_off(timers, clock);
                }
            }
        }
    }

    /// Asks the policy, and starts an attempt if it or a script says so.
    fn decide(
        &mut self,
        spec: &RoleSwapSpec,
        strategy: &Strategy,
        pitch: &Pitch,
        ball_radius: f32,
        clock: &Clock,
    ) {
        let players = self.players(clock);
        let knowledge = Knowledge {
            me: self.id.number,
            players: &players,
            ball: self.model.ball.map(|ball| ball.position),
            tight_control: has_tight_control(self.model, self.robot, ball_radius),
            half_length: pitch.half_size().x,
            goal: pitch.goal_centre(),
            now: clock.now() as f32,
        };
        let swapping = &mut *self.swapping;
        swapping.values = spec.policy.values(&spec.cast, &knowledge);
        let decision = spec.policy.decide(&spec.cast, &knowledge, &mut swapping.policy);
        let Some(reassignment) = swapping.asked.take().or(decision) else { return };
        let is_free = swapping.machine.phase() == AttemptPhase::Idle && swapping.machine.lock().is_none();
        if !is_free || clock.tick < swapping.earliest {
            return;
        }
        swapping.planned = Some(reassignment.apply(&self.team_model.roles, &kick_off_roles(strategy)));
        let participants = self.participants(spec.protocol, strategy.players.len());
        if participants.is_empty() {
            return;
        }
        self.swapping.attempts.begin(clock.tick);
        self.step(Input::Initiate { reassignment, participants }, &spec.timers, clock);
    }

    /// The robots whose locks an attempt needs: all in the paper; in the hardened version those heard lately, since a robot that
    /// is off would block all swaps for good, and the configurations mend whatever it missed.
    fn participants(&self, protocol: Protocol, players: usize) -> SmallVec<[PlayerNumber; 8]> {
        match protocol {
            Protocol::Paper(_) => {
                (0..players as PlayerNumber).filter(|number| *number != self.id.number).collect()
            }
            Protocol::Hardened | Protocol::HardenedWithout(_) => {
                self.model.mates.iter().map(|mate| mate.number).collect()
            }
        }
    }

    /// The players in play that the robot knows of, itself included.
    fn players(&self, clock: &Clock) -> SmallVec<[Player; 8]> {
        let own = Player {
            number: self.id.number,
            role: self.role.0 as RoleIndex,
            position: self.model.pose.position,
            heading: self.model.pose.heading,
            values: self.swapping.values.clone().map(|(values, wish)| Valued { values, wish, age: 0.0 }),
        };
        let mates = self.model.mates.iter().filter_map(|mate| {
            Some(Player {
                number: mate.number,
                role: self.team_model.roles.of(mate.number)?,
                position: mate.position,
                heading: angle(mate.heading),
                values: self.team_model.values_of(mate.number, clock),
            })
        });
        let mut players: SmallVec<[Player; 8]> = mates.chain([own]).collect();
        players.sort_by_key(|player| player.number);
        players
    }

    fn step(&mut self, input: Input, timers: &Timers, clock: &Clock) {
        let swapping = &mut *self.swapping;
        if matches!(input, Input::Receive { message: Message::Lock { .. }, .. }) {
            swapping.requests.received += 1;
        }
        for effect in swapping.machine.step(input) {
            match effect {
                Effect::Send { to, message } => {
                    match message {
                        Message::AckLock { .. } => {
                            swapping.reassigned = false;
                            swapping.requests.granted += 1;
                        }
                        Message::AckSwap { .. } => swapping.reassigned = true,
                        Message::Lock { .. } | Message::Swap { .. } => {}
                    }
                    self.client.send(to, &TeamMessage::RoleSwap(message));
                }
                Effect::Start(timer) => {
                    let seconds = match timer {
                        Timer::Lock => timers.lock,
                        Timer::Locks => timers.locks,
                        Timer::Acks => timers.acks,
                    };
                    swapping.deadlines[timer as usize] = Some(clock.tick + clock.ticks(seconds));
                }
                Effect::Stop(timer) => swapping.deadlines[timer as usize] = None,
                Effect::Announce => self.team_model.announce = true,
                Effect::Finished(outcome) => {
                    swapping.attempts.finish(outcome, clock.tick);
                    if outcome != Outcome::Completed {
                        swapping.back_off(timers, clock);
                    } else if let Some(planned) = swapping.planned.take() {
                        self.team_model.roles = planned;
                    }
                }
            }
        }
    }

    fn take_role(&mut self) {
        let role = self.swapping.machine.role();
        if self.role.0 != usize::from(role) {
            self.role.0 = usize::from(role);
        }
        match self.swapping.machine.configuration() {
            Some(configuration) if configuration.assignment != self.team_model.roles => {
                self.team_model.roles = configuration.assignment.clone();
            }
            Some(_) => {}
            None => self.team_model.note_role(self.id.number, role),
        }
    }
}

/// Whether a robot believes that it has the ball in its scoop.
pub(super) fn has_tight_control(model: &WorldModel, robot: &Robot, ball_radius: f32) -> bool {
    model.ball.is_some_and(|ball| {
        let local = model.pose.to_local(ball.position);
        let gap = local.x - robot.kind.body.length / 2.0 - ball_radius;
        local.x > 0.0 && gap <= CONTROL.0 && local.y.abs() <= CONTROL.1
    })
}

/// A ball this near to the body, and this far off its middle at most, is under tight control, m.
const CONTROL: (f32, f32) = (0.12, 0.14);
