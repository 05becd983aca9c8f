//! What wheels and legs report of a robot's way.

use bevy::prelude::*;

use super::localisation::odometry_error;
use crate::clock::Clock;
use crate::geometry::{Pose, Twist};
use crate::robot::{
    Drive, DriveCommand, Odometry, OdometrySource, OffPitch, Robot, RobotKind, WheelSpeeds, reckon,
};

/// A velocity in the robot's own frame, m/s ahead and to the left, and its turn, rad/s.
type Motion = (Vec2, f32);

type Reckoned<'a> = (&'a Robot, &'a Pose, &'a Twist, &'a DriveCommand, &'a mut Odometry);

pub(super) fn read_odometry(clock: Res<Clock>, mut robots: Query<Reckoned, Without<OffPitch>>) {
    for (robot, pose, twist, command, mut odometry) in &mut robots {
        let truth = felt(&robot.kind, pose, twist);
        let noise = robot.sensing.eyes.odometry();
        let wheels = Wheels::of(*command, &robot.kind, truth);
        if let Some((wheels, bump)) = wheels.zip(robot.kind.bump) {
            odometry.bump.feel(wheels.compared(), &bump, clock.dt);
        }
        let (velocity, turn_rate) = match noise {
            Some(noise) if noise.from == OdometrySource::Motors => reported(*command, wheels),
            _ => truth,
        };
        odometry.told = command.speed();
        (odometry.speed, odometry.turn_rate) = (velocity.x, turn_rate);
        let (mut way, mut turn) = (velocity * clock.dt, turn_rate * clock.dt);
        odometry.unjudged += way.length();
        if let Some(noise) = noise.filter(|_| robot.senses(&clock)) {
            let distance = std::mem::take(&mut odometry.unjudged);
            let (more, more_turn) = odometry_error(noise, distance, &mut odometry.dice);
            (way.x, turn) = (way.x + more, turn + more_turn);
        }
        odometry.pose = reckon(odometry.pose, way, turn);
    }
}

/// How a robot moves, as far as wheels or legs could feel it. Wheels do not feel that they slide sideways.
fn felt(kind: &RobotKind, pose: &Pose, twist: &Twist) -> Motion {
    let forward = pose.forward();
    let aside = match kind.drive {
        Drive::Differential(_) => 0.0,
        Drive::Walker(_) => twist.linear.dot(forward.perp()),
    };
    (Vec2::new(twist.linear.dot(forward), aside), twist.angular)
}

/// What two wheels are told, and how they turn.
#[derive(Clone, Copy)]
struct Wheels {
    told: WheelSpeeds,
    turned: WheelSpeeds,
    /// Distance between them, m.
    track: f32,
}

impl Wheels {
    /// The wheels of a robot that moves so, if it has any. A wheel that is blocked stalls and its encoder tells so, but its gears
    /// let nobody turn it faster than it is told, or back: then it slips.
    fn of(command: DriveCommand, kind: &RobotKind, (velocity, turn_rate): Motion) -> Option<Wheels> {
        let (DriveCommand::Wheels(told), Drive::Differential(drive)) = (command, &kind.drive) else {
            return None;
        };
        let offset = turn_rate * drive.track / 2.0;
        let turned = |told: f32, ground: f32| ground.clamp(told.min(0.0), told.max(0.0));
        let turned = WheelSpeeds {
            left: turned(told.left, velocity.x - offset),
            right: turned(told.right, velocity.x + offset),
        };
        Some(Wheels { told, turned, track: drive.track })
    }

    fn compared(&self) -> [(f32, f32); 2] {
        [(self.told.left, self.turned.left), (self.told.right, self.turned.right)]
    }
}

/// The motion that motors report: legs step as they are told, whatever comes of it.
fn reported(command: DriveCommand, wheels: Option<Wheels>) -> Motion {
    match (command, wheels) {
        (DriveCommand::Gait(gait), _) => (Vec2::new(gait.ahead, gait.left), gait.turn),
        (DriveCommand::Wheels(_), Some(Wheels { turned, track, .. })) => {
            (Vec2::X * ((turned.left + turned.right) / 2.0), (turned.right - turned.left) / track)
        }
        (DriveCommand::Wheels(_), None) => (Vec2::ZERO, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Gait;
    use crate::testing::cye;

    #[test]
    fn legs_report_the_steps_that_they_were_told_whatever_comes_of_them() {
        let gait = Gait { ahead: 0.3, left: -0.1, turn: 0.5 };
        for truth in [(Vec2::ZERO, 0.0), (Vec2::new(-0.2, 0.4), -1.0)] {
            let command = DriveCommand::Gait(gait);
            let wheels = Wheels::of(command, &cye(), truth);
            assert_eq!(reported(command, wheels), (Vec2::new(0.3, -0.1), 0.5));
        }
    }

    #[test]
    fn wheels_report_that_they_are_blocked_and_feel_no_push() {
        let report = |left: f32, right: f32, ahead: f32, turn: f32| {
            let told = DriveCommand::Wheels(WheelSpeeds { left, right });
            let (velocity, turn) = reported(told, Wheels::of(told, &cye(), (Vec2::new(ahead, 0.0), turn)));
            [velocity.x, turn].map(|number| (number * 1000.0).round() / 1000.0)
        };
        assert_eq!(report(0.3, 0.3, 0.3, 0.0), [0.3, 0.0], "it drives");
        assert_eq!(report(0.3, 0.3, 0.1, 0.0), [0.1, 0.0], "it is held up");
        assert_eq!(report(0.3, 0.3, 0.0, 0.0), [0.0, 0.0], "it is blocked");
        assert_eq!(report(0.3, 0.3, 0.6, 0.0), [0.3, 0.0], "it is pushed on");
        assert_eq!(report(0.3, 0.3, -0.2, 0.0), [0.0, 0.0], "it is pushed back");
        assert_eq!(report(0.0, 0.0, 0.5, 2.0), [0.0, 0.0], "it stands, and is pushed and turned");
        assert_eq!(report(-0.3, -0.3, -0.2, 0.0), [-0.2, 0.0], "it reverses");
    }
}
