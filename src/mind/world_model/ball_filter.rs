//! A robot's estimate of the ball: a constant-velocity Kalman filter whose two axes share one gain. Pure.

use bevy::prelude::*;

/// Position and velocity of the ball in the team frame, with the variances that say how far to trust them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallFilter {
    /// m
    pub position: Vec2,
    /// m/s
    pub velocity: Vec2,
    /// Variances of position and velocity and their covariance, the same on both axes.
    position_variance: f32,
    covariance: f32,
    velocity_variance: f32,
}

/// Standard deviation of the unknown accelerations of a ball among robots, m/s².
const ACCELERATION: f32 = 1.5;
/// What is believed of the speed of a ball that was just seen for the first time, m/s.
const FIRST_SPEED: f32 = 0.5;
/// A reading this many standard deviations off restarts the filter.
const GATE: f32 = 5.0;

impl BallFilter {
    /// A ball seen for the first time, at rest as far as is known.
    pub fn new(position: Vec2, deviation: f32) -> BallFilter {
        BallFilter {
            position,
            velocity: Vec2::ZERO,
            position_variance: deviation * deviation,
            covariance: 0.0,
            velocity_variance: FIRST_SPEED * FIRST_SPEED,
        }
    }

    /// The estimate `dt` seconds later, for a ball that loses `rolling` m/s each second.
    pub fn predict(self, dt: f32, rolling: f32) -> BallFilter {
        let (position, velocity) = roll_on(self.position, self.velocity, rolling, dt);
        let q = ACCELERATION * ACCELERATION;
        let dt2 = dt * dt;
        BallFilter {
            position,
            velocity,
            position_variance: self.position_variance
                + 2.0 * dt * self.covariance
                + dt2 * self.velocity_variance
                + q * dt2 * dt2 / 4.0,
            covariance: self.covariance + dt * self.velocity_variance + q * dt2 * dt / 2.0,
            velocity_variance: self.velocity_variance + q * dt2,
        }
    }

    /// Whether a reading with this standard deviation is too far off to be one of the ball that is believed in.
    pub fn is_far(self, reading: Vec2, deviation: f32) -> bool {
        let total = self.position_variance + deviation * deviation;
        (reading - self.position).length_squared() > GATE * GATE * total
    }

    /// The estimate of a ball that others touch: nobody knows how it moves.
    pub fn touched(self) -> BallFilter {
        let velocity_variance = FIRST_SPEED * FIRST_SPEED;
        BallFilter { velocity: Vec2::ZERO, covariance: 0.0, velocity_variance, ..self }
    }

    /// The estimate after a reading with this standard deviation in metres.
    pub fn update(self, reading: Vec2, deviation: f32) -> BallFilter {
        if self.is_far(reading, deviation) {
            return BallFilter::new(reading, deviation);
        }
        let surprise = reading - self.position;
        let total = self.position_variance + deviation * deviation;
        let (position_gain, velocity_gain) = (self.position_variance / total, self.covariance / total);
        BallFilter {
            position: self.position + position_gain * surprise,
            velocity: self.velocity + velocity_gain * surprise,
            position_variance: (1.0 - position_gain) * self.position_variance,
            covariance: (1.0 - position_gain) * self.covariance,
            velocity_variance: self.velocity_variance - velocity_gain * self.covariance,
        }
    }
}

/// Where a rolling ball is after `dt` seconds, and how fast: constant deceleration until it lies still.
pub fn roll_on(position: Vec2, velocity: Vec2, rolling: f32, dt: f32) -> (Vec2, Vec2) {
    let speed = velocity.length();
    if speed <= f32::EPSILON {
        return (position, Vec2::ZERO);
    }
    let moving = dt.min(speed / rolling);
    let direction = velocity / speed;
    let way = speed * moving - 0.5 * rolling * moving * moving;
    (position + direction * way, direction * (speed - rolling * moving))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Dice, Seed};

    #[test]
    fn the_filter_finds_position_and_velocity_better_than_a_single_reading() {
        let mut dice = Dice::new(Seed(3), "test", None);
        let (mut position_error, mut velocity_error, runs) = (0.0, 0.0, 200);
        for _ in 0..runs {
            let (start, velocity) = (Vec2::new(1.0, -0.5), Vec2::new(0.4, 0.3));
            let mut filter = BallFilter::new(start + Vec2::new(dice.normal(0.1), dice.normal(0.1)), 0.1);
            let (mut truth, mut speed) = (start, velocity);
            for _ in 0..15 {
                (truth, speed) = roll_on(truth, speed, 0.3, 0.1);
                let reading = truth + Vec2::new(dice.normal(0.1), dice.normal(0.1));
                filter = filter.predict(0.1, 0.3).update(reading, 0.1);
            }
            position_error += (filter.position - truth).length_squared();
            velocity_error += (filter.velocity - speed).length_squared();
        }
        let rms = |sum: f32| (sum / runs as f32).sqrt();
        assert!(rms(position_error) < 0.12, "{}", rms(position_error));
        assert!(rms(velocity_error) < 0.35, "{}", rms(velocity_error));
    }

    #[test]
    fn a_ball_far_from_where_it_was_expected_is_believed_at_once() {
        let filter = BallFilter::new(Vec2::ZERO, 0.05).update(Vec2::new(3.0, 0.0), 0.05);
        assert_eq!(filter, BallFilter::new(Vec2::new(3.0, 0.0), 0.05));
    }

    #[test]
    fn a_rolling_ball_stops_where_its_deceleration_says() {
        let (at, speed) = roll_on(Vec2::ZERO, Vec2::new(0.6, 0.0), 0.3, 100.0);
        assert!((at.x - 0.6).abs() < 1e-5 && speed.length() < 1e-6, "{at} {speed}");
    }
}
