//! What the runs check: properties of states, and facts about single steps, which a state remembers once they are watched.

use stateright::{Checker, Model, Property};
use touchline::protocol::role_swap::{AttemptPhase, Message, Order, RoleIndex, RoleSwap};

use super::model::{Action, Robot, State};
use super::network::Envelope;
use super::team::Team;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// Live robots have different roles at every moment.
    AllDiffer,
    /// So do those that are neither locked nor initiating.
    FreeDiffer,
    /// So do all, once nothing is in flight and nobody is locked or initiating.
    QuietDiffer,
    /// No two robots are in the swap phase at once.
    OneSwapPhase,
    /// Each robot's configuration has all the team's roles.
    Permutations,
    /// Once nothing can change any more, live robots have one configuration, different roles and no locks.
    SettledAgree,
    Never(Fact),
    /// At some time the roles have changed and all is quiet: the checks above are not about nothing.
    SometimesSwapped,
}

/// What a single step may bring about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// A LOCK of an attempt that is over locks a robot.
    LateLockLocks,
    /// A SWAP of an attempt that is over gives a robot its role.
    LateSwapObeyed,
    /// An ACKLOCK counts although its sender is not locked any more.
    LockCountedInVain,
    /// The acknowledgement of the first SWAP counts as that of the roll-back.
    WrongAckCounted,
    /// A robot that had changed its role ignores the roll-back.
    RollBackIgnored,
    /// A role changes but by the robot's own commit or by a configuration committed before.
    RoleChangedOtherwise,
    /// A robot falls back to a smaller configuration.
    WentBack,
    /// A configuration is committed after a greater one.
    CommittedOutOfOrder,
    /// A configuration is committed by a robot that did not know the greatest: that one's change is lost.
    UpdateLost,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Facts(u16);

impl Facts {
    fn note(&mut self, fact: Fact) {
        self.0 |= 1 << fact as u16;
    }

    fn has(self, fact: Fact) -> bool {
        self.0 >> fact as u16 & 1 == 1
    }

    pub fn extend(&mut self, other: Facts) {
        self.0 |= other.0;
    }
}

impl Check {
    pub fn name(self) -> &'static str {
        self.property().name
    }

    fn property(self) -> Property<Team> {
        match self {
            Check::AllDiffer => always("all roles differ", |_, s| differ(s.live())),
            Check::FreeDiffer => {
                always("roles of free robots differ", |_, s| differ(s.live().filter(|robot| robot.is_free())))
            }
            Check::QuietDiffer => {
                always("roles differ when quiet", |team, s| !team.is_quiet(s) || differ(s.live()))
            }
            Check::OneSwapPhase => always("one swap phase at a time", |_, s| {
                let swaps =
                    |robot: &&Robot| matches!(robot.machine.phase(), AttemptPhase::WaitingForAcks { .. });
                s.live().filter(swaps).count() <= 1
            }),
            Check::Permutations => always("configurations are permutations", |team, s| {
                let all = team.roles_at_start();
                s.robots
                    .iter()
                    .filter_map(|r| r.machine.configuration())
                    .all(|c| c.assignment.has_roles_of(&all))
            }),
            Check::SettledAgree => always("the settled agree", |team, s| !team.is_settled(s) || agree(s)),
            Check::SometimesSwapped => Property::sometimes("roles are swapped", |team: &Team, s: &State| {
                team.is_quiet(s)
                    && differ(s.live())
                    && s.robots.iter().zip(0..).take(3).all(|(r, n)| r.machine.role() != n)
            }),
            Check::Never(fact) => fact.never(),
        }
    }
}

impl Fact {
    fn never(self) -> Property<Team> {
        match self {
            Fact::LateLockLocks => always("no late LOCK locks", |_, s| !s.facts.has(Fact::LateLockLocks)),
            Fact::LateSwapObeyed => {
                always("no late SWAP is obeyed", |_, s| !s.facts.has(Fact::LateSwapObeyed))
            }
            Fact::LockCountedInVain => {
                always("counted locks are held", |_, s| !s.facts.has(Fact::LockCountedInVain))
            }
            Fact::WrongAckCounted => {
                always("only fitting ACKSWAPs count", |_, s| !s.facts.has(Fact::WrongAckCounted))
            }
            Fact::RollBackIgnored => {
                always("roll-backs are obeyed", |_, s| !s.facts.has(Fact::RollBackIgnored))
            }
            Fact::RoleChangedOtherwise => {
                always("roles change by configuration", |_, s| !s.facts.has(Fact::RoleChangedOtherwise))
            }
            Fact::WentBack => always("configurations grow", |_, s| !s.facts.has(Fact::WentBack)),
            Fact::CommittedOutOfOrder => {
                always("commits are ordered", |_, s| !s.facts.has(Fact::CommittedOutOfOrder))
            }
            Fact::UpdateLost => always("no update is lost", |_, s| !s.facts.has(Fact::UpdateLost)),
        }
    }
}

fn always(name: &'static str, condition: fn(&Team, &State) -> bool) -> Property<Team> {
    Property::always(name, condition)
}

/// The team's checks, and one that always holds: without it the checker stops at the last discovery.
pub fn properties(team: &Team) -> Vec<Property<Team>> {
    let whole = always("the whole state space is explored", |_, _| true);
    team.checks.iter().map(|check| check.property()).chain([whole]).collect()
}

pub fn differ<'a>(robots: impl Iterator<Item = &'a Robot>) -> bool {
    let mut roles: Vec<RoleIndex> = robots.map(|robot| robot.machine.role()).collect();
    let count = roles.len();
    roles.sort_unstable();
    roles.dedup();
    roles.len() == count
}

/// Whether live robots have one configuration, different roles and no locks.
pub fn agree(state: &State) -> bool {
    let mut held = state.live().map(|robot| robot.machine.configuration());
    let first = held.next();
    held.all(|other| Some(other) == first) && differ(state.live()) && state.live().all(Robot::is_free)
}

/// What a step brought about of that which the team's checks watch for.
pub fn happened(team: &Team, before: &State, action: &Action, after: &State) -> Facts {
    let mut facts = Facts::default();
    for check in &team.checks {
        if let Check::Never(fact) = check
            && fact.in_step(before, action, after)
        {
            facts.note(*fact);
        }
    }
    facts
}

impl Team {
    /// Only for that check a model must tell the acknowledgements of a SWAP and of its roll-back apart.
    pub fn tells_acks_apart(&self) -> bool {
        self.checks.contains(&Check::Never(Fact::WrongAckCounted))
    }

    /// Explores all states. The checks must hold; `unique` is how many states there are.
    pub fn holds(self, checks: &[Check], unique: usize) {
        let start = std::time::Instant::now();
        let checker = Team { checks: checks.to_vec(), ..self }.checker().spawn_bfs().join();
        let (states, steps) = (checker.unique_state_count(), checker.state_count());
        println!("{states} states, {steps} steps, {:.1} s", start.elapsed().as_secs_f32());
        checker.assert_properties();
        assert_eq!(states, unique, "the number of states");
    }
}

impl Fact {
    fn in_step(self, before: &State, action: &Action, after: &State) -> bool {
        let delivered = match action {
            Action::Deliver(place) | Action::DeliverAndKeep(place) => {
                Some(&before.network.in_flight()[*place])
            }
            _ => None,
        };
        match (self, delivered) {
            (Fact::RoleChangedOtherwise, _) => role_changed_otherwise(before, action, delivered, after),
            (Fact::WentBack, _) => {
                let held = |state: &State| -> Vec<_> {
                    state.robots.iter().map(|robot| robot.machine.configuration().cloned()).collect()
                };
                let restarted = matches!(action, Action::Crash { .. });
                !restarted && held(before).iter().zip(held(after)).any(|(before, after)| after < *before)
            }
            (Fact::CommittedOutOfOrder | Fact::UpdateLost, _) => committed_wrongly(self, before, after),
            (_, Some(envelope)) => self.in_delivery(before, envelope, after),
            _ => false,
        }
    }

    fn in_delivery(self, before: &State, envelope: &Envelope, after: &State) -> bool {
        let Envelope { from, to, ref message, roll_back } = *envelope;
        let (was, is) = (&before.robot(to).machine, &after.robot(to).machine);
        let over = !before.attempt_goes_on(from, message.sequence());
        match (self, message) {
            (Fact::LateLockLocks, Message::Lock { .. }) => {
                over && was.lock().is_none() && is.lock().is_some()
            }
            (Fact::LateSwapObeyed, Message::Swap { .. }) => over && !roll_back && was.role() != is.role(),
            (Fact::LockCountedInVain, Message::AckLock { sequence, .. }) => {
                let held = before.robot(from).machine.lock();
                let holds = held.is_some_and(|lock| (lock.by, lock.sequence) == (to, *sequence));
                !holds && counted(was, is)
            }
            (Fact::WrongAckCounted, Message::AckSwap { .. }) => {
                matches!(was, RoleSwap::Paper(machine) if machine.rolls_back())
                    && !roll_back
                    && counted(was, is)
            }
            (Fact::RollBackIgnored, Message::Swap { order, .. }) => {
                let switched = *order != Order::Role(was.role());
                before.robot(to).up && roll_back && switched && was.role() == is.role()
            }
            _ => false,
        }
    }
}

/// Whether an initiator waits for one robot less than before.
fn counted(was: &RoleSwap, is: &RoleSwap) -> bool {
    was.phase() != is.phase() || was.awaited().len() != is.awaited().len()
}

fn role_changed_otherwise(
    before: &State,
    action: &Action,
    delivered: Option<&Envelope>,
    after: &State,
) -> bool {
    let mut changed =
        before.robots.iter().zip(&after.robots).filter(|(a, b)| a.machine.role() != b.machine.role());
    let commits = matches!(action, Action::Initiate { .. })
        || delivered.is_some_and(|envelope| matches!(envelope.message, Message::AckSwap { .. }));
    let adopts = matches!(action, Action::Hear(..))
        || delivered.is_some_and(|envelope| matches!(envelope.message, Message::AckLock { .. }));
    let committed =
        |robot: &Robot| robot.machine.configuration().is_some_and(|held| before.news.contains(held));
    let restarted = matches!(action, Action::Crash { .. });
    !restarted && changed.any(|(_, now)| !(commits || adopts && committed(now)))
}

fn committed_wrongly(fact: Fact, before: &State, after: &State) -> bool {
    let Some(committed) = after.news.iter().find(|news| !before.news.contains(*news)) else { return false };
    let Some(greatest) = before.news.last() else { return false };
    if fact == Fact::CommittedOutOfOrder {
        return greatest > committed;
    }
    let initiator = before.robot(committed.initiator);
    initiator.machine.configuration() != Some(greatest)
}

/// Whether a robot is locked or initiating.
pub fn somebody_is_busy(state: &State) -> bool {
    !state.live().all(|robot| robot.is_free())
}
