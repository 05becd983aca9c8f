//! Errors of self-localisation and of odometry. Pure but for the dice.

use bevy::prelude::*;

use crate::geometry::{Pose, wrap_angle};
use crate::rng::Dice;
use crate::robot::{Localisation, OdometryNoise, PlaceError};

/// A slowly drifting error: a first-order autoregressive process around zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseError {
    offset: Vec2,
    heading: f32,
}

impl PoseError {
    /// An error of this much, m and rad.
    pub fn of(offset: Vec2, heading: f32) -> PoseError {
        PoseError { offset, heading }
    }

    /// A fresh error, as after a kidnap.
    pub fn drawn(localisation: &Localisation, dice: &mut Dice) -> PoseError {
        let Localisation { position, heading, .. } = *localisation;
        PoseError::of_hands(PlaceError { position, heading }, dice)
    }

    /// What a robot errs by that people have put down.
    pub fn of_hands(error: PlaceError, dice: &mut Dice) -> PoseError {
        PoseError {
            offset: Vec2::new(dice.normal(error.position), dice.normal(error.position)),
            heading: dice.normal(error.heading.to_radians()),
        }
    }

    /// The error after another `dt` seconds.
    pub fn drift(self, localisation: &Localisation, dt: f32, dice: &mut Dice) -> PoseError {
        let fresh = PoseError::drawn(localisation, dice);
        if dice.chance(dt / localisation.jump_time) {
            return fresh;
        }
        let kept = crate::ops::exp(-dt / localisation.drift_time);
        let added = (1.0 - kept * kept).sqrt();
        PoseError {
            offset: kept * self.offset + added * fresh.offset,
            heading: kept * self.heading + added * fresh.heading,
        }
    }

    /// Where a robot with this error takes itself to be.
    pub fn applied(self, truth: Pose) -> Pose {
        Pose { position: truth.position + self.offset, heading: wrap_angle(truth.heading + self.heading) }
    }
}

/// The error of the wheels' report over a way of `distance` metres: ahead in metres, turn in radians.
pub fn odometry_error(noise: &OdometryNoise, distance: f32, dice: &mut Dice) -> (f32, f32) {
    let ahead = dice.normal(noise.distance) * distance.sqrt();
    let turn = dice.normal(noise.heading.to_radians()) * (distance / 0.5).sqrt();
    (ahead, turn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;
    use crate::robot::reckon;

    const DRIFT: Localisation = Localisation {
        position: 0.2,
        heading: 5.0,
        drift_time: 10.0,
        jump_time: 1e9,
        landmarks: None,
        put_down: PlaceError { position: 0.0, heading: 0.0 },
    };

    fn errors(n: usize, dt: f32) -> Vec<PoseError> {
        let mut dice = Dice::new(Seed(5), "test", None);
        let mut error = PoseError::drawn(&DRIFT, &mut dice);
        (0..n)
            .map(|_| {
                error = error.drift(&DRIFT, dt, &mut dice);
                error
            })
            .collect()
    }

    #[test]
    fn the_error_has_the_asked_spread_whatever_the_step() {
        for dt in [0.1, 5.0] {
            let errors = errors(200_000, dt);
            let variance = errors.iter().map(|e| e.offset.x * e.offset.x).sum::<f32>() / errors.len() as f32;
            assert!((variance.sqrt() - 0.2).abs() < 0.02, "{dt}: {}", variance.sqrt());
        }
    }

    #[test]
    fn the_error_drifts_slowly() {
        let errors = errors(1000, 0.1);
        let largest = errors.windows(2).map(|w| (w[1].offset - w[0].offset).length()).fold(0.0, f32::max);
        assert!(largest < 0.15, "{largest}");
    }

    #[test]
    fn dead_reckoning_of_a_quarter_circle_ends_beside_its_centre() {
        let (steps, radius) = (1000, 1.0);
        let quarter = std::f32::consts::FRAC_PI_2;
        let end = (0..steps).fold(Pose::default(), |pose, _| {
            reckon(pose, Vec2::X * (radius * quarter / steps as f32), quarter / steps as f32)
        });
        assert!((end.position - Vec2::new(1.0, 1.0)).length() < 1e-3, "{end:?}");
    }
}
