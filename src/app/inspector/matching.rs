//! Which true robot a believed one stands for. A marker tells the team and not the number, so it is the nearest of its team.
//!
//! Pure, and for people to see only: no robot ever knows this.

use bevy::prelude::*;
use smallvec::SmallVec;

use crate::ids::RobotId;
use crate::mind::world_model::RobotBelief;

/// A robot that is believed in, that is there, or both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeliefPair {
    pub belief: Option<RobotBelief>,
    pub truth: Option<(RobotId, Vec2)>,
}

impl BeliefPair {
    /// The believed and the true place, where there is one, m.
    pub fn places(&self) -> (Option<Vec2>, Option<Vec2>) {
        (self.belief.map(|belief| belief.position), self.truth.map(|(_, at)| at))
    }
}

/// How far a belief is off: the distance between two places where both are known, m.
pub fn error((believed, truth): (Option<Vec2>, Option<Vec2>)) -> Option<f32> {
    Some(believed?.distance(truth?))
}

/// The pairs of a match's robots.
pub type BeliefPairs = SmallVec<[BeliefPair; 16]>;

/// A belief farther than this from every robot of its team stands for none, m.
const GHOST: f32 = 1.5;

/// BeliefPairs beliefs with the truth, nearest first, each at most once, both in one frame. True robots come first and in their
/// given order, then the beliefs that stand for nothing.
pub fn pair(beliefs: &[RobotBelief], truth: &[(RobotId, Vec2)]) -> BeliefPairs {
    let mut pairs: BeliefPairs =
        truth.iter().map(|robot| BeliefPair { belief: None, truth: Some(*robot) }).collect();
    let mut free: SmallVec<[RobotBelief; 16]> = beliefs.iter().copied().collect();
    while let Some((robot, belief)) = nearest(&pairs, &free) {
        pairs[robot].belief = Some(free.remove(belief));
    }
    pairs.extend(free.into_iter().map(|belief| BeliefPair { belief: Some(belief), truth: None }));
    pairs
}

/// Indices of the nearest robot without a belief and belief without a robot.
fn nearest(pairs: &[BeliefPair], free: &[RobotBelief]) -> Option<(usize, usize)> {
    let mut best = None;
    let mut least = GHOST;
    for (index, open) in pairs.iter().enumerate().filter(|(_, pair)| pair.belief.is_none()) {
        let Some((id, at)) = open.truth else { continue };
        for (number, belief) in free.iter().enumerate().filter(|(_, belief)| belief.team == id.team) {
            let distance = belief.position.distance(at);
            if distance < least {
                (best, least) = (Some((index, number)), distance);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    fn belief(team: Team, x: f32) -> RobotBelief {
        RobotBelief { team, position: Vec2::new(x, 0.0), seen: 0 }
    }

    fn robot(team: Team, number: u8, x: f32) -> (RobotId, Vec2) {
        (RobotId::new(team, number), Vec2::new(x, 0.0))
    }

    #[test]
    fn the_nearest_of_the_team_is_meant() {
        let truth = [robot(Team::Home, 1, 0.0), robot(Team::Home, 2, 1.0), robot(Team::Away, 0, 0.3)];
        let pairs = pair(&[belief(Team::Home, 0.4), belief(Team::Home, 0.9)], &truth);
        let errors: Vec<_> =
            pairs.iter().map(|pair| error(pair.places()).map(|e| (100.0 * e).round())).collect();
        assert_eq!(errors, [Some(40.0), Some(10.0), None]);
    }

    #[test]
    fn two_beliefs_do_not_share_a_robot() {
        let pairs = pair(&[belief(Team::Away, 0.2), belief(Team::Away, 0.1)], &[robot(Team::Away, 3, 0.0)]);
        assert_eq!(pairs.len(), 2);
        assert!(error(pairs[0].places()).is_some_and(|error| (error - 0.1).abs() < 1e-6));
        assert!(pairs[1].truth.is_none() && error(pairs[1].places()).is_none());
    }

    #[test]
    fn a_belief_far_from_all_robots_stands_for_none() {
        let pairs = pair(&[belief(Team::Home, 3.0)], &[robot(Team::Home, 0, 0.0)]);
        assert!(pairs[0].belief.is_none() && pairs[1].truth.is_none());
    }

    #[test]
    fn the_order_of_the_robots_is_kept() {
        let truth = [robot(Team::Home, 0, 5.0), robot(Team::Home, 1, 0.0), robot(Team::Away, 2, 1.0)];
        let pairs = pair(&[belief(Team::Away, 1.0), belief(Team::Home, 0.0)], &truth);
        let order: Vec<_> = pairs.iter().filter_map(|pair| pair.truth).collect();
        assert_eq!(order, truth);
    }
}
