//! Catching the ball under the chin and carrying it. Pure: time and dice are arguments.

use std::cmp::Ordering;

use bevy::prelude::*;

use crate::robot::Chin;

/// What the chin is doing, in ticks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Grip {
    /// The head is up.
    #[default]
    Open,
    /// The head is going down and reaches the ball in this tick.
    Lowering { until: u64 },
    /// The ball is under the chin.
    Holding { since: u64 },
    /// An attempt failed; the head is up again in this tick.
    Raising { until: u64 },
}

/// A ball, as the robot's own body has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearBall {
    /// Ahead and to the left of the body's centre, m.
    pub at: Vec2,
    /// Relative to the place of the body where the ball is, m/s.
    pub drift: Vec2,
}

impl Chin {
    /// Whether the chin reaches a ball here.
    pub fn reaches(&self, ball: &NearBall) -> bool {
        (self.reach.0..=self.reach.1).contains(&ball.at.x) && ball.at.y.abs() <= self.half_width
    }

    /// Where a ball lies that is held, ahead of the body's centre, m.
    pub fn pocket(&self) -> Vec2 {
        Vec2::X * ((self.reach.0 + self.reach.1) / 2.0)
    }

    /// The force in newtons, in the robot's frame, with which it pulls a ball of this mass back into the pocket within a
    /// few steps; no more than the hold has.
    pub fn pull(&self, ball: &NearBall, mass: f32, dt: f32) -> Vec2 {
        let stiffness = SHARE * mass / (dt * dt);
        let damping = mass / dt;
        (stiffness * (self.pocket() - ball.at) - damping * ball.drift).clamp_length_max(self.force)
    }
}

/// Share of a ball's offset from the pocket that is taken back in one step.
const SHARE: f32 = 0.2;
/// A held ball that is farther than this from the pocket has slipped out, m.
const SLIP: f32 = 0.05;

impl Grip {
    /// The grip in the next tick. `wanted` is whether the robot wants the ball held; `luck`, drawn when the head arrives,
    /// is uniform in [0, 1).
    pub fn next(
        self,
        wanted: bool,
        ball: Option<&NearBall>,
        chin: &Chin,
        (tick, ticks): (u64, u64),
        luck: impl FnOnce() -> f32,
    ) -> Grip {
        match self {
            Grip::Open if wanted && ball.is_some_and(|ball| chin.reaches(ball)) => {
                Grip::Lowering { until: tick + ticks }
            }
            Grip::Lowering { until } if tick >= until => {
                let caught = ball.is_some_and(|ball| chin.reaches(ball) && ball.drift.length() < chin.speed);
                if caught && luck() < chin.success {
                    Grip::Holding { since: tick }
                } else {
                    Grip::Raising { until: tick + ticks }
                }
            }
            Grip::Holding { .. } if !wanted => Grip::Open,
            Grip::Holding { .. } if ball.is_none_or(|ball| ball.at.distance(chin.pocket()) > SLIP) => {
                Grip::Open
            }
            Grip::Raising { until } if tick >= until => Grip::Open,
            grip => grip,
        }
    }

    /// This grip after other robots have pushed the ball with so many newtons: a held ball slips out if that is too much, and
    /// the head has to go up before it can come down again.
    pub fn pushed(self, force: f32, chin: &Chin, (tick, ticks): (u64, u64)) -> Grip {
        let slips = self.holds() && chin.slips_at.is_some_and(|limit| force > limit);
        if slips { Grip::Raising { until: tick + ticks } } else { self }
    }

    /// Whether the ball is under the chin.
    pub fn holds(self) -> bool {
        matches!(self, Grip::Holding { .. })
    }
}

/// What speaks for one of several robots whose chins have reached the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Catch {
    /// The tick in which it got hold of the ball.
    pub since: u64,
    /// From the ball to its pocket, m; differences below a millimetre do not count.
    pub off: f32,
    /// A number drawn for it.
    pub lot: f32,
}

impl Catch {
    /// The better claim is less: who held first, then whose pocket is nearer, then whose lot is less.
    pub fn order(&self, other: &Catch) -> Ordering {
        let millimetres = |off: f32| (1000.0 * off).round();
        let nearer = || millimetres(self.off).total_cmp(&millimetres(other.off));
        let by_place = || nearer().then(self.lot.total_cmp(&other.lot));
        self.since.cmp(&other.since).then_with(by_place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHIN: Chin = Chin {
        reach: (0.15, 0.21),
        half_width: 0.05,
        speed: 0.25,
        success: 0.8,
        time: 0.3,
        force: 3.0,
        slips_at: Some(3.0),
        walk: 0.4,
        turn: 86.0,
    };

    fn ball(x: f32, y: f32, speed: f32) -> NearBall {
        NearBall { at: Vec2::new(x, y), drift: Vec2::new(0.0, speed) }
    }

    fn after(grip: Grip, ball: Option<NearBall>, tick: u64, luck: f32) -> Grip {
        grip.next(true, ball.as_ref(), &CHIN, (tick, 18), || luck)
    }

    #[test]
    fn a_ball_in_reach_is_held_when_the_head_is_down_unless_luck_fails() {
        let down = after(Grip::Open, Some(ball(0.18, 0.0, 0.0)), 10, 0.0);
        assert_eq!(down, Grip::Lowering { until: 28 });
        assert_eq!(after(down, Some(ball(0.18, 0.0, 0.0)), 27, 0.0), down);
        assert_eq!(after(down, Some(ball(0.18, 0.0, 0.0)), 28, 0.79), Grip::Holding { since: 28 });
        assert_eq!(after(down, Some(ball(0.18, 0.0, 0.0)), 28, 0.81), Grip::Raising { until: 46 });
    }

    #[test]
    fn a_ball_that_is_too_far_aside_or_too_fast_is_not_caught() {
        assert_eq!(after(Grip::Open, Some(ball(0.18, 0.06, 0.0)), 0, 0.0), Grip::Open);
        assert_eq!(after(Grip::Open, Some(ball(0.22, 0.0, 0.0)), 0, 0.0), Grip::Open);
        let down = Grip::Lowering { until: 5 };
        assert_eq!(after(down, Some(ball(0.18, 0.0, 0.3)), 5, 0.0), Grip::Raising { until: 23 });
        assert_eq!(after(down, None, 5, 0.0), Grip::Raising { until: 23 });
    }

    #[test]
    fn it_lets_go_when_told_and_when_the_ball_has_slipped_out() {
        let held = Grip::Holding { since: 0 };
        let at_rest = ball(0.18, 0.0, 0.0);
        assert_eq!(held.next(false, Some(&at_rest), &CHIN, (9, 18), || 0.0), Grip::Open);
        assert_eq!(after(held, Some(ball(0.18, 0.04, 0.0)), 9, 0.0), held);
        assert_eq!(after(held, Some(ball(0.24, 0.0, 0.0)), 9, 0.0), Grip::Open);
    }

    #[test]
    fn a_held_ball_slips_out_when_others_push_it_hard() {
        let held = Grip::Holding { since: 0 };
        assert_eq!(held.pushed(2.9, &CHIN, (10, 18)), held);
        assert_eq!(held.pushed(3.1, &CHIN, (10, 18)), Grip::Raising { until: 28 });
        assert_eq!(held.pushed(9.0, &Chin { slips_at: None, ..CHIN }, (10, 18)), held);
        let down = Grip::Lowering { until: 20 };
        assert_eq!(down.pushed(9.0, &CHIN, (10, 18)), down, "nothing is held yet");
    }

    #[test]
    fn of_two_chins_the_first_then_the_nearer_then_the_luckier_keeps_the_ball() {
        let claim = |since, off, lot| Catch { since, off, lot };
        let better = |one: Catch, other: Catch| {
            assert_eq!((one.order(&other), other.order(&one)), (Ordering::Less, Ordering::Greater));
        };
        better(claim(3, 0.04, 0.9), claim(4, 0.01, 0.1));
        better(claim(4, 0.01, 0.9), claim(4, 0.02, 0.1));
        better(claim(4, 0.0101, 0.1), claim(4, 0.01, 0.9));
    }

    #[test]
    fn the_pull_has_a_limit_and_brings_a_ball_home() {
        let (mut at, mut speed, mass, dt) = (0.2, 0.0, 0.09, 1.0 / 60.0);
        for _ in 0..60 {
            let held = NearBall { at: Vec2::new(at, 0.0), drift: Vec2::new(speed, 0.0) };
            let pull = CHIN.pull(&held, mass, dt);
            assert!(pull.length() <= 3.0 + 1e-6);
            speed += pull.x / mass * dt;
            at += speed * dt;
        }
        assert!((at - 0.18).abs() < 1e-3 && speed.abs() < 1e-3, "{at} {speed}");
    }
}
