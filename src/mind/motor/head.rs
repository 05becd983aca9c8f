//! Where a robot that has a neck looks.

use bevy::prelude::*;

use crate::clock::Clock;
use crate::geometry::{angle, wrap_angle};
use crate::mind::world_model::WorldModel;
use crate::robot::{Head, HeadIntent, OffPitch, Robot};

/// The head looks for a ball again that it has not seen for this long, s, although the robot still believes in it.
const PATIENCE: f32 = 0.7;

type Looking<'a> = (&'a Robot, &'a WorldModel, &'a Head, &'a mut HeadIntent);

/// Looks at the ball, and from side to side while it is not in sight.
pub(super) fn aim_heads(clock: Res<Clock>, mut robots: Query<Looking, Without<OffPitch>>) {
    for (robot, model, head, mut intent) in &mut robots {
        let Some(neck) = &robot.kind.neck else { continue };
        if !robot.decides(&clock) {
            continue;
        }
        let farthest = neck.pan.to_radians();
        let in_sight =
            model.ball.filter(|ball| clock.tick.saturating_sub(ball.seen) <= clock.ticks(PATIENCE));
        *intent = match in_sight {
            Some(ball) => {
                let bearing = wrap_angle(angle(ball.position - model.pose.position) - model.pose.heading);
                HeadIntent { pan: bearing.clamp(-farthest, farthest), speed: neck.speed.to_radians() }
            }
            None => HeadIntent { pan: scan(head.pan, intent.pan, farthest), speed: neck.scan.to_radians() },
        };
    }
}

/// From one side to the other, and back when it has arrived.
fn scan(pan: f32, towards: f32, farthest: f32) -> f32 {
    let end = if towards >= 0.0 { farthest } else { -farthest };
    if (end - pan).abs() < ARRIVED { -end } else { end }
}

/// A head this near to where it should look is there, rad.
const ARRIVED: f32 = 0.02;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scan_goes_from_stop_to_stop() {
        assert_eq!(scan(0.0, 0.0, 1.5), 1.5);
        assert_eq!(scan(1.0, 1.5, 1.5), 1.5);
        assert_eq!(scan(1.5, 1.5, 1.5), -1.5);
        assert_eq!(scan(0.0, -1.5, 1.5), -1.5);
        assert_eq!(scan(-1.5, -1.5, 1.5), 1.5);
    }
}
