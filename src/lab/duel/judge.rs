//! When a trial is over, and who won it. Pure: it is told where the ball is.

use bevy::prelude::Vec2;

use crate::ids::Team;

/// How a trial ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrialOutcome {
    /// A team brought the ball out its way.
    Won(Team),
    /// Nobody did in time.
    Undecided,
}

/// One trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrialResult {
    /// The team that the first side was.
    pub first: Team,
    /// How it ended.
    pub outcome: TrialOutcome,
}

/// Watches the ball of one trial.
#[derive(Clone, Copy, Debug)]
pub struct DuelJudge {
    seconds: f64,
    played: f64,
}

/// The ball is out when it is this far from its start towards a goal, m.
pub const OUT: f32 = 1.0;

impl DuelJudge {
    /// A judge that waits for so long, s.
    pub fn new(seconds: f64) -> DuelJudge {
        DuelJudge { seconds, played: 0.0 }
    }

    /// The ball after the next `dt` seconds, in the pitch frame; it began in the centre, and home attacks east.
    pub fn observe(&mut self, ball: Vec2, dt: f64) -> Option<TrialOutcome> {
        self.played += dt;
        if ball.x >= OUT {
            Some(TrialOutcome::Won(Team::Home))
        } else if ball.x <= -OUT {
            Some(TrialOutcome::Won(Team::Away))
        } else if self.played >= self.seconds {
            Some(TrialOutcome::Undecided)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ball_is_won_by_the_team_whose_way_it_goes_and_aside_by_nobody() {
        let after = |x: f32, y: f32| DuelJudge::new(10.0).observe(Vec2::new(x, y), 0.1);
        assert_eq!(after(1.0, -0.5), Some(TrialOutcome::Won(Team::Home)));
        assert_eq!(after(-1.2, 0.0), Some(TrialOutcome::Won(Team::Away)));
        assert_eq!(after(0.9, 1.7), None);
    }

    #[test]
    fn a_trial_ends_undecided() {
        let mut judge = DuelJudge::new(2.0);
        assert_eq!(judge.observe(Vec2::ZERO, 1.9), None);
        assert_eq!(judge.observe(Vec2::ZERO, 0.1), Some(TrialOutcome::Undecided));
    }
}
