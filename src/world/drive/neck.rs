//! Turning the heads of robots that have necks.

use bevy::prelude::*;

use crate::clock::Clock;
use crate::robot::pilot::Pilot;
use crate::robot::{Head, HeadIntent, OffPitch, Robot};

pub(super) fn turn_heads(
    clock: Res<Clock>,
    mut robots: Query<(&Robot, &HeadIntent, Option<&Pilot>, &mut Head), Without<OffPitch>>,
) {
    for (robot, intent, pilot, mut head) in &mut robots {
        let Some(neck) = robot.kind.neck.filter(|_| !robot.health.crashed) else { continue };
        let fastest = neck.speed.to_radians();
        let (wanted, speed) = match pilot.and_then(|pilot| pilot.head) {
            Some(share) => (share * neck.pan.to_radians(), fastest),
            None => (intent.pan, intent.speed.min(fastest)),
        };
        let step = speed * clock.dt;
        head.pan += (wanted - head.pan).clamp(-step, step);
    }
}
