//! What became of the role swaps that a robot has begun, and of the locks that it was asked for.

use std::ops::AddAssign;

use crate::protocol::role_swap::Outcome;

/// The attempts at a role swap that a robot has initiated since the match began, whatever it forgot meanwhile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SwapAttempts {
    /// All of them.
    pub begun: u32,
    /// Those in which all acknowledged their new roles, as far as the initiator knows.
    pub completed: u32,
    /// Those that ended since not everybody's lock came in time.
    pub without_locks: u32,
    /// Those that ended since not every acknowledgement of a new role came in time.
    pub without_acks: u32,
    /// How long those that were completed took in all, from the first LOCK to the last ACKSWAP, in ticks.
    pub ticks: u64,
    /// When the attempt that goes on began, in ticks.
    since: Option<u64>,
}

impl SwapAttempts {
    pub(super) fn begin(&mut self, tick: u64) {
        self.begun += 1;
        self.since = Some(tick);
    }

    pub(super) fn finish(&mut self, outcome: Outcome, tick: u64) {
        let Some(since) = self.since.take() else { return };
        match outcome {
            Outcome::Completed => {
                self.completed += 1;
                self.ticks += tick - since;
            }
            Outcome::LocksMissing => self.without_locks += 1,
            Outcome::AcksMissing => self.without_acks += 1,
            Outcome::Overtaken => {}
        }
    }

    /// The robot is switched off: nobody finishes its attempt.
    pub(super) fn give_up(&mut self) {
        self.since = None;
    }
}

/// Those of several robots; what still goes on is not told.
impl AddAssign for SwapAttempts {
    fn add_assign(&mut self, other: SwapAttempts) {
        let SwapAttempts { begun, completed, without_locks, without_acks, ticks, since: _ } = other;
        self.begun += begun;
        self.completed += completed;
        self.without_locks += without_locks;
        self.without_acks += without_acks;
        self.ticks += ticks;
    }
}

/// The locks that others have asked a robot for since the match began.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LockRequests {
    /// Every LOCK that arrived.
    pub received: u32,
    /// Those that it answered with an ACKLOCK; it refuses by silence (section VII-A.1).
    pub granted: u32,
    /// Locks whose timer ran out before a new role came.
    pub ran_out: u32,
}

impl AddAssign for LockRequests {
    fn add_assign(&mut self, LockRequests { received, granted, ran_out }: LockRequests) {
        self.received += received;
        self.granted += granted;
        self.ran_out += ran_out;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_completed_attempts_have_a_length() {
        let mut attempts = SwapAttempts::default();
        for (tick, outcome) in
            [(10, Outcome::Completed), (50, Outcome::LocksMissing), (70, Outcome::AcksMissing)]
        {
            attempts.begin(tick);
            attempts.finish(outcome, tick + 7);
        }
        attempts.begin(100);
        attempts.give_up();
        attempts.finish(Outcome::Completed, 500);
        let SwapAttempts { begun, completed, without_locks, without_acks, ticks, .. } = attempts;
        assert_eq!((begun, completed, without_locks, without_acks, ticks), (4, 1, 1, 1, 7));
    }
}
