//! How a camera is truly held, against what its robot takes it to be. Pure but for the dice.

use std::f32::consts::TAU;

use crate::ops;
use crate::rng::Dice;
use crate::vision::{CameraFlaws, GaitSway, MountPlay};

/// By how much a camera is held otherwise than its robot knows, at a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sway {
    /// rad to the left.
    pub pan: f32,
    /// rad downwards.
    pub tilt: f32,
    /// rad clockwise, as the camera looks.
    pub roll: f32,
    /// m upwards.
    pub rise: f32,
    /// How fast it sways to the left, rad/s.
    pub pan_rate: f32,
    /// How fast it sways downwards, rad/s.
    pub tilt_rate: f32,
}

/// A body that moves.
#[derive(Clone, Copy, Debug)]
pub struct Stride {
    /// The part of a stride that is over, from 0 to 1.
    pub phase: f32,
    /// How fast it moves, as a share of its full speed.
    pub effort: f32,
}

impl Stride {
    /// After some seconds of strides at this rate.
    pub fn after(seconds: f64, rate: f32, effort: f32) -> Stride {
        Stride { phase: (seconds * f64::from(rate)).fract() as f32, effort: effort.min(1.0) }
    }
}

impl Sway {
    /// That of a camera which is turned to the left of its robot's heading by `pan`, rad.
    pub fn of(flaws: &CameraFlaws, stride: Stride, play: MountError, pan: f32) -> Sway {
        let sway = Sway::of_gait(&flaws.sway, stride, pan);
        Sway { pan: sway.pan + play.pan, tilt: sway.tilt + play.tilt, roll: sway.roll + play.roll, ..sway }
    }

    fn of_gait(gait: &GaitSway, Stride { phase, effort }: Stride, pan: f32) -> Sway {
        let speed = TAU * gait.rate;
        let (sin, cos) = ops::sin_cos(TAU * phase);
        // Of twice the phase.
        let (double_sin, double_cos) = (2.0 * sin * cos, cos * cos - sin * sin);
        let angle = |degrees: f32| degrees.to_radians() * effort;
        let (roll, roll_rate) = (angle(gait.roll) * sin, angle(gait.roll) * speed * cos);
        let (pitch, pitch_rate) =
            (angle(gait.pitch) * double_sin, 2.0 * angle(gait.pitch) * speed * double_cos);
        let (aside, ahead) = ops::sin_cos(pan);
        Sway {
            pan: angle(gait.yaw) * cos,
            tilt: pitch * ahead - roll * aside,
            roll: roll * ahead + pitch * aside,
            rise: gait.rise * effort * double_cos,
            pan_rate: -angle(gait.yaw) * speed * sin,
            tilt_rate: pitch_rate * ahead - roll_rate * aside,
        }
    }
}

/// What joints and mount are off, rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MountError {
    pan: f32,
    tilt: f32,
    roll: f32,
}

impl MountError {
    /// An error of which nothing was known before.
    pub fn drawn(play: &MountPlay, dice: &mut Dice) -> MountError {
        MountError::default().mixed(0.0, 1.0, play, dice)
    }

    /// The error some seconds later.
    pub fn drifted(self, play: &MountPlay, dt: f32, dice: &mut Dice) -> MountError {
        let kept = ops::exp(-dt / play.time);
        self.mixed(kept, (1.0 - kept * kept).max(0.0).sqrt(), play, dice)
    }

    fn mixed(self, kept: f32, fresh: f32, play: &MountPlay, dice: &mut Dice) -> MountError {
        let deviation = fresh * play.deviation.to_radians();
        let mut mix = |error: f32| kept * error + dice.normal(deviation);
        MountError { pan: mix(self.pan), tilt: mix(self.tilt), roll: mix(self.roll) }
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;
    use crate::rng::Seed;

    const GAIT: GaitSway = GaitSway { rate: 2.5, roll: 2.0, pitch: 1.5, yaw: 1.0, rise: 0.005 };

    fn sway(phase: f32, effort: f32, pan: f32) -> Sway {
        Sway::of_gait(&GAIT, Stride { phase, effort }, pan)
    }

    #[test]
    fn a_body_rolls_once_and_pitches_twice_with_each_stride() {
        let near = |value: f32, degrees: f32| (value.to_degrees() - degrees).abs() < 1e-4;
        let quarter = sway(0.25, 1.0, 0.0);
        assert!(near(quarter.roll, 2.0) && near(quarter.tilt, 0.0) && near(quarter.pan, 0.0), "{quarter:?}");
        let eighth = sway(0.125, 1.0, 0.0);
        assert!(near(eighth.tilt, 1.5) && near(sway(0.625, 1.0, 0.0).tilt, 1.5), "{eighth:?}");
        assert_eq!(sway(0.3, 0.0, 0.4), Sway::default());
    }

    #[test]
    fn a_head_that_looks_aside_nods_as_the_body_rolls() {
        let (ahead, left) = (sway(0.25, 0.5, 0.0), sway(0.25, 0.5, FRAC_PI_2));
        assert!((left.tilt + ahead.roll).abs() < 1e-6 && left.roll.abs() < 1e-6, "{left:?}");
    }

    #[test]
    fn rates_are_the_derivatives_of_the_angles() {
        let step = 1e-3;
        for (phase, pan) in [(0.1, 0.0), (0.4, 0.8), (0.9, -1.2)] {
            let (before, after) = (sway(phase - step, 1.0, pan), sway(phase + step, 1.0, pan));
            let seconds = 2.0 * step / GAIT.rate;
            let now = sway(phase, 1.0, pan);
            assert!((now.pan_rate - (after.pan - before.pan) / seconds).abs() < 0.01, "{now:?}");
            assert!((now.tilt_rate - (after.tilt - before.tilt) / seconds).abs() < 0.01, "{now:?}");
        }
    }

    #[test]
    fn the_error_of_a_mount_has_its_deviation_and_lasts_for_its_time() {
        let play = MountPlay { deviation: 0.6, time: 0.5 };
        let mut dice = Dice::new(Seed(2), "test", None);
        let mut error = MountError::drawn(&play, &mut dice);
        let (mut squares, mut products, steps) = (0.0, 0.0, 40_000);
        for _ in 0..steps {
            let next = error.drifted(&play, 0.5, &mut dice);
            squares += error.tilt * error.tilt;
            products += error.tilt * next.tilt;
            error = next;
        }
        let deviation = (squares / steps as f32).sqrt().to_degrees();
        assert!((deviation - 0.6).abs() < 0.02, "{deviation}");
        assert!((products / squares - 0.3679).abs() < 0.03, "{}", products / squares);
    }
}
