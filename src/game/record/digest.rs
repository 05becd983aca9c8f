//! The digest of a match: a hash of all that happens.

use std::hash::BuildHasher;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use smallvec::SmallVec;
use xxhash_rust::xxh3::{Xxh3DefaultBuilder, xxh3_64_with_seed};

use super::figures::Record;
use crate::comms::radio::RadioRecord;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::mind::teamwork::Swapping;
use crate::robot::Trailer;
use crate::strategy::{Activity, Role};
use crate::world::referee::MatchState;

pub(super) type DigestedBody<'a> = (
    &'a Pose,
    Option<&'a RobotId>,
    Option<&'a Trailer>,
    Option<&'a Role>,
    Option<&'a Activity>,
    Option<&'a Swapping>,
);

/// Folds the state of the world into the digest, in the order of robots, trailers and ball.
pub(super) fn digest(
    mut record: ResMut<Record>,
    state: Res<MatchState>,
    radio: Res<RadioRecord>,
    bodies: Query<DigestedBody>,
) {
    let mut bytes: SmallVec<[u8; 512]> = SmallVec::new();
    for (_, words) in sorted(bodies.iter()) {
        bytes.extend_from_slice(words.map(u32::to_le_bytes).as_flattened());
    }
    bytes.extend_from_slice(&state.score[0].to_le_bytes());
    bytes.extend_from_slice(&state.score[1].to_le_bytes());
    bytes.push(state.phase as u8);
    bytes.extend_from_slice(&radio.transmitted().to_le_bytes());
    record.digest = xxh3_64_with_seed(&bytes, record.digest);
}

/// Whose body it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum BodyKey {
    Robot(RobotId),
    Trailer(RobotId),
    Ball,
}

/// Place, heading, role, state of behaviour and state of the swap.
pub(super) type BodyWords = [u32; 6];

/// What the digest holds of each body, in the order of robots, trailers and ball.
pub(super) fn sorted<'a>(
    bodies: impl Iterator<Item = <DigestedBody<'static> as QueryData>::Item<'a, 'a>>,
) -> SmallVec<[(BodyKey, BodyWords); 24]> {
    // The world has trailers and robots each in order, but not which of them comes first: to sort all of them at once moves most.
    let mut sorted = SmallVec::new();
    let mut others: SmallVec<[(BodyKey, BodyWords); 24]> = SmallVec::new();
    for (pose, robot, trailer, role, activity, swapping) in bodies {
        let [x, y, heading] = [pose.position.x, pose.position.y, pose.heading].map(f32::to_bits);
        let Some(id) = robot else {
            let key = trailer.map_or(BodyKey::Ball, |trailer| BodyKey::Trailer(trailer.of));
            others.push((key, [x, y, heading, 0, 0, 0]));
            continue;
        };
        let role = role.map_or(0, |role| role.0 as u32);
        let activity = activity.map_or(0, |activity| (activity.acting_as << 16 | activity.state) as u32);
        let swap = swapping.map_or(0, |swapping| Xxh3DefaultBuilder.hash_one(&swapping.machine) as u32);
        sorted.push((BodyKey::Robot(*id), [x, y, heading, role, activity, swap]));
    }
    for part in [&mut sorted, &mut others] {
        part.sort_unstable_by_key(|(key, _)| *key);
    }
    sorted.extend(others);
    sorted
}
