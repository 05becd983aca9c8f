//! The Record stage: the digest of all that happens, and figures about a match. Reads everything, changes nothing else; the
//! clock moves on at its end.

mod bookings;
mod overlap;
#[cfg(test)]
mod tests;

use std::hash::BuildHasher;

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use serde::Serialize;
use smallvec::SmallVec;
use xxhash_rust::xxh3::{Xxh3DefaultBuilder, xxh3_64_with_seed};

use bookings::BallSeeker;
pub use bookings::{BookingFigures, PING_PONG, Span};
pub use overlap::{BallOverlap, TOLERANCE};

use crate::clock::Clock;
use crate::comms::radio::RadioRecord;
use crate::geometry::{Pose, Twist};
use crate::ids::{RobotId, Team};
use crate::mind::teamwork::{Booking, Swapping};
use crate::mind::world_model::WorldModel;
use crate::pitch::BallKind;
use crate::protocol::b3p::Distance;
use crate::rng::Seed;
use crate::robot::{OffPitch, Orders, Robot, RobotState, Trailer};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::teamwork::BallBooking;
use crate::strategy::{Activity, Role, Strategies};
use crate::world::ball::Ball;
use crate::world::physics::Overlaps;
use crate::world::referee::{MatchState, Phase};

pub(super) fn plugin(app: &mut App) {
    let systems = (digest, measure, watch_bookings, watch_overlaps, move_clock).chain();
    app.match_resource::<Record>();
    app.add_systems(Tick, systems.in_set(TickSystems::Record));
}

/// Figures about the match so far.
#[derive(Resource, Clone, Debug, PartialEq, Serialize)]
pub struct Record {
    /// Equal digests mean equal matches: all poses, roles, activities, role swaps and the score at all ticks, and how much was
    /// said.
    pub digest: u64,
    /// Seconds of play in which each team was the last one near the ball, home first.
    pub possession: [f64; 2],
    /// Seconds with two or more robots of a team within [`CROWD`] of the ball, home first.
    pub crowding: [f64; 2],
    /// Seconds with two or more robots of a team within [`AGGLOMERATION`] of the ball, home first.
    pub agglomeration: [f64; 2],
    /// How well each team's ball booking has worked, home first.
    pub bookings: [BookingFigures; 2],
    /// How deep the ball has sunk into robots and walls.
    pub overlap: BallOverlap,
    /// Seconds of play.
    pub played: f64,
    /// Metres driven by each robot, by robot in order.
    pub driven: Vec<(RobotId, f64)>,
    #[serde(skip)]
    last_near: Option<Team>,
}

/// A robot nearer to the ball than this has it, m.
const POSSESSION: f32 = 0.5;
/// Two team mates nearer to the ball than this crowd it, m.
pub const CROWD: f32 = 1.0;
/// Two small robots nearer to the ball than this are an agglomeration (TeamChaos, section 5), m.
pub const AGGLOMERATION: f32 = 0.5;

impl Record {
    /// An empty record of a match between these robots, in order.
    pub fn new(seed: Seed, robots: impl IntoIterator<Item = RobotId>) -> Record {
        Record {
            digest: seed.0,
            possession: [0.0; 2],
            crowding: [0.0; 2],
            agglomeration: [0.0; 2],
            bookings: [BookingFigures::default(); 2],
            overlap: BallOverlap::default(),
            played: 0.0,
            driven: robots.into_iter().map(|robot| (robot, 0.0)).collect(),
            last_near: None,
        }
    }

    /// Each team's share of the time in which either had the ball, home first; a half each if nobody ever had it.
    pub fn possession_shares(&self) -> [f64; 2] {
        shares(self.possession)
    }

    /// Metres that a team's robots have driven together.
    pub fn driven_by(&self, team: Team) -> f64 {
        self.driven.iter().filter(|(robot, _)| robot.team == team).map(|(_, way)| way).sum()
    }
}

fn shares([home, away]: [f64; 2]) -> [f64; 2] {
    let total = home + away;
    if total > 0.0 { [home / total, away / total] } else { [0.5, 0.5] }
}

type Digested<'a> = (
    &'a Pose,
    Option<&'a RobotId>,
    Option<&'a Trailer>,
    Option<&'a Role>,
    Option<&'a Activity>,
    Option<&'a Swapping>,
);

/// Folds the state of the world into the digest, in the order of robots, trailers and ball.
fn digest(
    mut record: ResMut<Record>,
    state: Res<MatchState>,
    radio: Res<RadioRecord>,
    bodies: Query<Digested>,
) {
    let mut sorted: SmallVec<[(u32, [u32; 6]); 24]> = bodies
        .iter()
        .map(|(pose, robot, trailer, role, activity, swapping)| {
            let key = |id: &RobotId| (id.team.index() as u32) << 8 | u32::from(id.number);
            let order = match (robot, trailer) {
                (Some(id), _) => key(id),
                (None, Some(trailer)) => 1 << 16 | key(&trailer.of),
                (None, None) => 1 << 17,
            };
            let place = [pose.position.x, pose.position.y, pose.heading].map(f32::to_bits);
            let role = role.map_or(0, |role| role.0 as u32);
            let activity = activity.map_or(0, |activity| (activity.acting_as << 16 | activity.state) as u32);
            let swap = swapping.map_or(0, |swapping| Xxh3DefaultBuilder.hash_one(&swapping.machine) as u32);
            (order, [place[0], place[1], place[2], role, activity, swap])
        })
        .collect();
    sorted.sort_unstable_by_key(|(order, _)| *order);
    let mut bytes: SmallVec<[u8; 512]> = SmallVec::new();
    for (_, words) in &sorted {
        words.iter().for_each(|word| bytes.extend_from_slice(&word.to_le_bytes()));
    }
    bytes.extend_from_slice(&state.score[0].to_le_bytes());
    bytes.extend_from_slice(&state.score[1].to_le_bytes());
    bytes.push(state.phase as u8);
    bytes.extend_from_slice(&radio.transmitted().to_le_bytes());
    record.digest = xxh3_64_with_seed(&bytes, record.digest);
}

fn measure(
    clock: Res<Clock>,
    state: Res<MatchState>,
    mut record: ResMut<Record>,
    ball: Single<&Pose, With<Ball>>,
    robots: Query<(&RobotId, &Pose, &Twist), Without<OffPitch>>,
) {
    if state.phase != Phase::Playing {
        return;
    }
    let dt = f64::from(clock.dt);
    record.played += dt;
    let (mut near, mut at_ball) = ([0; 2], [0; 2]);
    let mut nearest: Option<(f32, RobotId)> = None;
    for (&id, pose, twist) in &robots {
        let distance = pose.position.distance(ball.position);
        near[id.team.index()] += usize::from(distance < CROWD);
        at_ball[id.team.index()] += usize::from(distance < AGGLOMERATION);
        if distance < POSSESSION && nearest.is_none_or(|best| (distance, id) < best) {
            nearest = Some((distance, id));
        }
        if let Ok(index) = record.driven.binary_search_by_key(&id, |(robot, _)| *robot) {
            record.driven[index].1 += f64::from(twist.linear.length()) * dt;
        }
    }
    record.last_near = nearest.map(|(_, id)| id.team).or(record.last_near);
    if let Some(team) = record.last_near {
        record.possession[team.index()] += dt;
    }
    for team in Team::BOTH {
        if near[team.index()] >= 2 {
            record.crowding[team.index()] += dt;
        }
        if at_ball[team.index()] >= 2 {
            record.agglomeration[team.index()] += dt;
        }
    }
}

type Bidding<'a> = (&'a RobotId, &'a Robot, &'a WorldModel, &'a Booking, &'a Orders);

/// Robots that are penalised or off take no part.
fn watch_bookings(
    clock: Res<Clock>,
    strategies: Res<Strategies>,
    mut record: ResMut<Record>,
    robots: Query<Bidding>,
) {
    for team in Team::BOTH {
        let Some(spec) = &strategies.of(team).teamwork.ball_booking else { continue };
        let mut seekers: SmallVec<[BallSeeker; 8]> = (robots.iter())
            .filter(|(id, robot, .., orders)| {
                id.team == team && !robot.health.crashed && orders.state == RobotState::Playing
            })
            .filter_map(|(id, _, model, booking, _)| {
                let goes = booking.0.goes();
                let ball = model.ball.filter(|_| goes || booking.0.sees())?;
                let distance = Distance::from_metres(ball.position.distance(model.pose.position));
                Some(BallSeeker { number: id.number, distance, goes })
            })
            .collect();
        seekers.sort_unstable_by_key(|seeker| seeker.number);
        let BallBooking { threshold, .. } = *spec;
        let threshold = Distance::from_metres(threshold);
        record.bookings[team.index()].update(&seekers, threshold, clock.now(), f64::from(clock.dt));
    }
}

fn watch_overlaps(
    overlaps: Overlaps,
    kind: Res<BallKind>,
    ball: Single<&RapierRigidBodyHandle, With<Ball>>,
    mut record: ResMut<Record>,
) {
    overlaps.of_ball(*ball, kind.radius).for_each(|depth| record.overlap.add(depth));
}

fn move_clock(mut clock: ResMut<Clock>) {
    clock.tick += 1;
}
