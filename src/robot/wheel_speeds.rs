//! The speeds of two driven wheels, and what limits them.

use bevy::prelude::*;

use super::DifferentialDrive;

/// Ground speeds of the two driven wheels, m/s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Reflect)]
pub struct WheelSpeeds {
    /// m/s.
    pub left: f32,
    /// m/s.
    pub right: f32,
}

impl WheelSpeeds {
    /// Speed ahead in m/s and turn rate in rad/s, scaled down together where a wheel would exceed its top speed.
    pub fn from_motion(ahead: f32, turn_rate: f32, drive: &DifferentialDrive) -> WheelSpeeds {
        let offset = turn_rate * drive.track / 2.0;
        let (left, right) = (ahead - offset, ahead + offset);
        let excess = (left.abs().max(right.abs()) / drive.max_speed).max(1.0);
        WheelSpeeds { left: left / excess, right: right / excess }
    }

    /// These speeds, moved towards `wanted` by no more than `step` m/s each.
    pub fn towards(self, wanted: WheelSpeeds, step: f32) -> WheelSpeeds {
        WheelSpeeds {
            left: self.left + (wanted.left - self.left).clamp(-step, step),
            right: self.right + (wanted.right - self.right).clamp(-step, step),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acceleration_is_limited_for_each_wheel() {
        let next = WheelSpeeds { left: 0.0, right: 0.4 }.towards(WheelSpeeds { left: 0.9, right: 0.39 }, 0.1);
        assert_eq!(next, WheelSpeeds { left: 0.1, right: 0.39 });
    }
}
