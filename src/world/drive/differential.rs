//! From a wanted heading and speed to the speeds of two wheels: the heading law of TeamBots' Cye, with a dead band, a
//! proportional turn on the spot and a reverse gear that steers.

use std::f32::consts::FRAC_PI_2;

use crate::robot::{DifferentialDrive, WheelSpeeds};

/// Wheel speeds that bring a robot with this heading error (rad, positive to the left) onto its course at `speed` m/s.
///
/// Below 90° of error the inner wheel slows down by (1 - 2|e|/π)²; beyond, the robot turns on the spot, as it does for a
/// speed of 0. A negative speed drives backwards, with the rear pointing to the course.
pub fn steer(error: f32, speed: f32, drive: &DifferentialDrive) -> WheelSpeeds {
    let speed = speed.clamp(-drive.max_speed, drive.max_speed);
    if speed == 0.0 || error.abs() >= FRAC_PI_2 {
        return turn_on_the_spot(error, drive);
    }
    let inner = speed * (1.0 - error.abs() / FRAC_PI_2).powi(2);
    if (error >= 0.0) == (speed > 0.0) {
        WheelSpeeds { left: inner, right: speed }
    } else {
        WheelSpeeds { left: speed, right: inner }
    }
}

fn turn_on_the_spot(error: f32, drive: &DifferentialDrive) -> WheelSpeeds {
    if error.abs() < drive.dead_band.to_radians() {
        return WheelSpeeds::default();
    }
    let limit = drive.turn_rate.to_radians();
    WheelSpeeds::from_motion(0.0, (drive.turn_gain * error).clamp(-limit, limit), drive)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CYE: DifferentialDrive = DifferentialDrive {
        track: 0.4127,
        max_speed: 0.9144,
        acceleration: 2.0,
        wheel_force: 20.0,
        grip: 0.8,
        dead_band: 3.0,
        turn_gain: 4.0,
        turn_rate: 150.0,
    };

    #[test]
    fn on_course_both_wheels_run_at_the_asked_speed() {
        assert_eq!(steer(0.0, 0.5, &CYE), WheelSpeeds { left: 0.5, right: 0.5 });
        assert_eq!(steer(0.0, 5.0, &CYE), WheelSpeeds { left: 0.9144, right: 0.9144 });
    }

    #[test]
    fn half_way_to_a_right_angle_the_inner_wheel_runs_at_a_quarter() {
        let left_turn = steer(FRAC_PI_2 / 2.0, 0.8, &CYE);
        assert!((left_turn.left - 0.2).abs() < 1e-6 && left_turn.right == 0.8);
        let right_turn = steer(-FRAC_PI_2 / 2.0, 0.8, &CYE);
        assert_eq!((right_turn.left, right_turn.right), (left_turn.right, left_turn.left));
    }

    #[test]
    fn beyond_a_right_angle_the_robot_turns_on_the_spot() {
        let turn = steer(2.0, 0.8, &CYE);
        assert!(turn.right > 0.0 && turn.left == -turn.right);
        assert!(turn.right <= 150f32.to_radians() * CYE.track / 2.0 + 1e-6);
    }

    #[test]
    fn standing_robots_leave_small_errors_alone() {
        assert_eq!(steer(2f32.to_radians(), 0.0, &CYE), WheelSpeeds::default());
        assert_ne!(steer(4f32.to_radians(), 0.0, &CYE), WheelSpeeds::default());
    }

    #[test]
    fn in_reverse_a_positive_error_still_turns_left() {
        let wheels = steer(0.5, -0.5, &CYE);
        assert!(wheels.right - wheels.left > 0.0 && wheels.left < 0.0);
    }
}
