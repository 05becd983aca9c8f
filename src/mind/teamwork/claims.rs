//! Ball claiming (section VI-B): which robot has the ball, as a robot believes from what it hears and does itself.

use smallvec::SmallVec;

use crate::comms::messages::HaveBall;
use crate::ids::PlayerNumber;
use crate::protocol::role_swap::RoleIndex;
use crate::strategy::teamwork::Teamwork;

/// The claims that a robot has heard of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Claims(SmallVec<[Claim; 8]>);

/// What a team mate said last about having the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The claimant's number.
    pub by: PlayerNumber,
    /// The claimant's role.
    pub role: RoleIndex,
    /// Whether it has the ball.
    pub have_ball: bool,
    /// Milliseconds on the sender's clock.
    pub time: u32,
    /// The tick in which it was heard.
    pub heard: u64,
}

impl Claims {
    /// Takes note of a have-ball message; one that is older than what is known is overtaken news.
    pub fn hear(&mut self, by: PlayerNumber, message: &HaveBall, tick: u64) {
        let claim =
            Claim { by, role: message.role, have_ball: message.have_ball, time: message.time, heard: tick };
        match self.0.iter_mut().find(|known| known.by == claim.by) {
            Some(known) if claim.time < known.time => {}
            Some(known) => *known = claim,
            None => self.0.push(claim),
        }
    }

    /// Forgets what was heard longer ago than `memory` ticks.
    pub fn forget(&mut self, tick: u64, memory: u64) {
        self.0.retain(|claim| tick.saturating_sub(claim.heard) <= memory);
    }

    /// The claim that holds among the team mates' and the robot's own: the highest ranked, and of equals that of the lowest
    /// number.
    pub fn holder(
        &self,
        own: Option<(PlayerNumber, RoleIndex)>,
        teamwork: &Teamwork,
    ) -> Option<(PlayerNumber, RoleIndex)> {
        let heard = self.0.iter().filter(|claim| claim.have_ball).map(|claim| (claim.by, claim.role));
        heard.chain(own).reduce(|best, other| {
            let (best_role, other_role) = (usize::from(best.1), usize::from(other.1));
            let other_wins = teamwork.outranks(other_role, best_role)
                || (!teamwork.outranks(best_role, other_role) && other.0 < best.0);
            if other_wins { other } else { best }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranked() -> Teamwork {
        Teamwork { ranks: vec![0, 1, 2, 3], ..Teamwork::default() }
    }

    fn hear(claims: &mut Claims, robot: PlayerNumber, have_ball: bool, time: u32, tick: u64) {
        claims.hear(robot, &HaveBall { time, robot, have_ball, role: robot }, tick);
    }

    #[test]
    fn the_higher_rank_takes_the_claim_over_whoever_came_first() {
        let mut claims = Claims::default();
        hear(&mut claims, 3, true, 100, 10);
        assert_eq!(claims.holder(None, &ranked()), Some((3, 3)));
        hear(&mut claims, 1, true, 200, 20);
        assert_eq!(claims.holder(None, &ranked()), Some((1, 1)));
        assert_eq!(claims.holder(Some((0, 0)), &ranked()), Some((0, 0)));
    }

    #[test]
    fn equals_are_decided_by_number() {
        let mut claims = Claims::default();
        hear(&mut claims, 3, true, 100, 10);
        assert_eq!(claims.holder(Some((2, 2)), &Teamwork::default()), Some((2, 2)));
        assert_eq!(claims.holder(Some((4, 4)), &Teamwork::default()), Some((3, 3)));
    }

    #[test]
    fn a_claim_ends_when_it_is_given_up_or_not_renewed() {
        let mut claims = Claims::default();
        hear(&mut claims, 3, true, 100, 10);
        hear(&mut claims, 3, false, 150, 12);
        assert_eq!(claims.holder(None, &ranked()), None);
        hear(&mut claims, 3, true, 200, 20);
        claims.forget(80, 60);
        assert_eq!(claims.holder(None, &ranked()), Some((3, 3)));
        claims.forget(81, 60);
        assert_eq!(claims.holder(None, &ranked()), None);
    }

    #[test]
    fn overtaken_news_is_no_news() {
        let mut claims = Claims::default();
        hear(&mut claims, 3, false, 200, 20);
        hear(&mut claims, 3, true, 100, 25);
        assert_eq!(claims.holder(None, &ranked()), None);
    }
}
