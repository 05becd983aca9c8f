//! The digest of a match: a hash of all that happens.

use std::hash::BuildHasher;

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

type Digested<'a> = (
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
    bodies: Query<Digested>,
) {
    let mut sorted: SmallVec<[(u32, [u8; 24]); 24]> = SmallVec::new();
    for (pose, robot, trailer, role, activity, swapping) in &bodies {
        let key = |id: &RobotId| (id.team.index() as u32) << 8 | u32::from(id.number);
        let order = match (robot, trailer) {
            (Some(id), _) => key(id),
            (None, Some(trailer)) => 1 << 16 | key(&trailer.of),
            (None, None) => 1 << 17,
        };
        let role = role.map_or(0, |role| role.0 as u32);
        let activity = activity.map_or(0, |activity| (activity.acting_as << 16 | activity.state) as u32);
        let swap = swapping.map_or(0, |swapping| Xxh3DefaultBuilder.hash_one(&swapping.machine) as u32);
        let place = [pose.position.x, pose.position.y, pose.heading].map(f32::to_bits);
        let mut bytes = [0; 24];
        for (at, word) in [place[0], place[1], place[2], role, activity, swap].into_iter().enumerate() {
            bytes[4 * at..4 * at + 4].copy_from_slice(&word.to_le_bytes());
        }
        sorted.push((order, bytes));
    }
    sorted.sort_unstable_by_key(|(order, _)| *order);
    let mut bytes: SmallVec<[u8; 512]> = SmallVec::new();
    for (_, of_body) in &sorted {
        bytes.extend_from_slice(of_body);
    }
    bytes.extend_from_slice(&state.score[0].to_le_bytes());
    bytes.extend_from_slice(&state.score[1].to_le_bytes());
    bytes.push(state.phase as u8);
    bytes.extend_from_slice(&radio.transmitted().to_le_bytes());
    record.digest = xxh3_64_with_seed(&bytes, record.digest);
}
