//! The head of a robot that has a neck: where it should look, part of the Motor stage, and how it turns there, part of the
//! Drive stage.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::clock::Clock;
use crate::geometry::{angle, wrap_angle};
use crate::mind::world_model::WorldModel;
use crate::robot::pilot::Pilot;
use crate::robot::{OffPitch, Robot};
use crate::schedule::{Tick, TickSystems};

pub(crate) fn plugin(app: &mut App) {
    app.add_systems(Tick, aim_heads.in_set(TickSystems::Motor))
        .add_systems(Tick, turn_heads.in_set(TickSystems::Drive));
}

/// Where a head should look, rad to the left of the body's heading; written by the Motor stage.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeadIntent {
    pub pan: f32,
    /// How fast it should turn there, rad/s.
    pub speed: f32,
}

/// Where a head looks; always straight ahead without a neck. Written by the Drive stage.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Head {
    /// rad to the left of the body's heading
    pub pan: f32,
}

/// A ball that was not seen for so long is looked for again, s, although it is still believed in.
const PATIENCE: f32 = 0.7;

type Looking<'a> = (&'a Robot, &'a WorldModel, &'a Head, &'a mut HeadIntent);

/// Looks at the ball, and from side to side while it is not in sight.
fn aim_heads(clock: Res<Clock>, mut robots: Query<Looking, Without<OffPitch>>) {
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

fn turn_heads(
    clock: Res<Clock>,
    mut robots: Query<(&Robot, &HeadIntent, Option<&Pilot>, &mut Head), Without<OffPitch>>,
) {
    for (robot, intent, pilot, mut head) in &mut robots {
        let Some(neck) = robot.kind.neck.filter(|_| !robot.condition.crashed) else { continue };
        let fastest = neck.speed.to_radians();
        let (wanted, speed) = match pilot.and_then(|pilot| pilot.head) {
            Some(share) => (share * neck.pan.to_radians(), fastest),
            None => (intent.pan, intent.speed.min(fastest)),
        };
        let step = speed * clock.dt;
        head.pan += (wanted - head.pan).clamp(-step, step);
    }
}

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
