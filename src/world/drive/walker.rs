//! The legs of an omnidirectional walker: from what is wanted to a gait, the error of each step, and the push on the body.

use bevy::prelude::*;

use crate::geometry::{unit, wrap_angle};
use crate::ids::RobotId;
use crate::rng::{Dice, Seed};
use crate::robot::{Gait, GaitNoise, Walker};

/// The gait that walks at `speed`, a share of the top speed, along a course while it turns to face a heading; both in
/// radians to the left of where the robot looks.
pub fn stride(course: f32, facing: f32, speed: f32, walker: &Walker) -> Gait {
    let way = unit(course) * (speed * walker.ahead);
    Gait { ahead: way.x, left: way.y, turn: walker.turn_gain * wrap_angle(facing) }.limited(walker)
}

/// How the present step of a robot's gait goes wrong.
#[derive(Component, Clone, Debug)]
pub struct GaitError {
    /// In shares of the noise's deviations: along the walk, ahead, to the left, and of the turn.
    drawn: [f32; 4],
    until: u64,
    pub(super) dice: Dice,
}

impl GaitError {
    /// The error of a robot that has not stepped.
    pub fn new(seed: Seed, robot: RobotId) -> GaitError {
        GaitError { drawn: [0.0; 4], until: 0, dice: Dice::new(seed, "gait", Some(robot)) }
    }

    /// What becomes of a gait in this tick. `step` is the length of a step in ticks; legs that stand make no error.
    pub fn applied(&mut self, gait: Gait, noise: &GaitNoise, tick: u64, step: u64) -> Gait {
        if tick >= self.until {
            self.drawn = [(); 4].map(|()| self.dice.normal(1.0));
            self.until = tick + step;
        }
        if gait == Gait::default() {
            return gait;
        }
        let [share, ahead, left, turn] = self.drawn;
        let factor = 1.0 + noise.share * share;
        Gait {
            ahead: gait.ahead * factor + noise.drift * ahead,
            left: gait.left * factor + noise.drift * left,
            turn: gait.turn * factor + noise.turn.to_radians() * turn,
        }
    }
}

/// A walking body's velocities, and what it takes to change them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trunk {
    /// Unit vector ahead.
    pub forward: Vec2,
    /// m/s.
    pub linear: Vec2,
    /// rad/s, counter-clockwise.
    pub angular: f32,
    /// kg.
    pub mass: f32,
    /// 1/(kg·m²).
    pub inverse_inertia: f32,
    /// From the centre to where the paws stand, m.
    pub lever: f32,
}

/// Linear and angular velocity after the legs have pushed for `dt` seconds as hard as they must and can.
pub fn push_legs(trunk: &Trunk, gait: Gait, push: f32, dt: f32) -> (Vec2, f32) {
    let wanted = trunk.forward.rotate(Vec2::new(gait.ahead, gait.left));
    let change = (wanted - trunk.linear).clamp_length_max(push * dt / trunk.mass);
    let twist = push * trunk.lever * dt * trunk.inverse_inertia;
    (trunk.linear + change, trunk.angular + (gait.turn - trunk.angular).clamp(-twist, twist))
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;
    use crate::ids::Team;

    const NOISE: GaitNoise = GaitNoise { step: 0.4, share: 0.05, drift: 0.02, turn: 2.0 };
    const AIBO: Walker = Walker {
        ahead: 0.4,
        back: 0.3,
        aside: 0.28,
        turn: 143.0,
        acceleration: 0.8,
        turn_acceleration: 286.0,
        push: 9.0,
        turn_gain: 3.0,
        noise: NOISE,
    };

    #[test]
    fn a_walker_goes_sideways_while_it_looks_ahead() {
        let gait = stride(FRAC_PI_2, 0.0, 1.0, &AIBO);
        assert!(gait.ahead.abs() < 1e-6 && (gait.left - 0.28).abs() < 1e-6 && gait.turn == 0.0, "{gait:?}");
    }

    #[test]
    fn a_heading_that_is_far_off_is_turned_to_before_it_walks() {
        let gait = stride(FRAC_PI_2, FRAC_PI_2, 1.0, &AIBO);
        assert!(gait.turn > 0.0 && gait.left < 1e-6, "{gait:?}");
    }

    #[test]
    fn steps_err_by_the_asked_spread_and_each_for_its_whole_time() {
        let mut error = GaitError::new(Seed(3), RobotId::new(Team::Home, 1));
        let walk = Gait { ahead: 0.4, left: 0.0, turn: 0.0 };
        let gaits: Vec<Gait> = (0..240_000).map(|tick| error.applied(walk, &NOISE, tick, 24)).collect();
        assert!(gaits.chunks(24).all(|step| step.iter().all(|gait| *gait == step[0])));
        let spread = |of: &dyn Fn(&Gait) -> f32| {
            (gaits.iter().map(|gait| of(gait).powi(2)).sum::<f32>() / gaits.len() as f32).sqrt()
        };
        assert!((spread(&|gait| gait.left) - 0.02).abs() < 1e-3);
        assert!((spread(&|gait| gait.turn).to_degrees() - 2.0).abs() < 0.1);
        assert!((spread(&|gait| gait.ahead - 0.4) - Vec2::new(0.02, 0.05 * 0.4).length()).abs() < 1e-3);
        assert_eq!(error.applied(Gait::default(), &NOISE, 0, 24), Gait::default());
    }

    #[test]
    fn legs_push_with_no_more_than_their_force() {
        let trunk = Trunk {
            forward: Vec2::Y,
            linear: Vec2::ZERO,
            angular: 0.0,
            mass: 1.6,
            inverse_inertia: 50.0,
            lever: 0.1,
        };
        let (linear, angular) = push_legs(&trunk, Gait { ahead: 0.4, left: 0.0, turn: 9.0 }, 9.0, 0.01);
        assert!((linear - Vec2::new(0.0, 9.0 * 0.01 / 1.6)).length() < 1e-6, "{linear}");
        assert!((angular - 9.0 * 0.1 * 0.01 * 50.0).abs() < 1e-6);
        let (linear, _) = push_legs(&trunk, Gait { ahead: 0.01, left: 0.0, turn: 0.0 }, 9.0, 0.01);
        assert!((linear - Vec2::new(0.0, 0.01)).length() < 1e-6, "it does not overshoot");
    }
}
