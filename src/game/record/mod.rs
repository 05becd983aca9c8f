//! The Record stage: the digest of all that happens, and figures about a match. Reads everything, changes nothing else; the
//! clock moves on at its end.

mod bookings;
mod contacts;
mod crowding;
mod digest;
mod holds;
mod kicks;
mod loose_balls;
mod overlap;
mod play_tick;
mod pursuit;
mod removals;
mod span;
#[cfg(test)]
mod tests;

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

use bookings::BallSeeker;
pub use bookings::BookingFigures;
pub use contacts::{APART, ContactTotal, RobotContacts};
pub use crowding::{AGGLOMERATION, CROWD, Crowding, RADII};
pub use holds::{BACK_WITHIN, HoldFigures};
pub use kicks::{KickFigures, STRUCK};
pub use loose_balls::{LOOSE_AFTER, LooseBalls, WON_AFTER};
pub use overlap::{BallOverlap, TOLERANCE};
use play_tick::{PlayTick, PlayView};
pub use pursuit::{FARTHER, PING_PONG, Pursuit};
pub use removals::Removals;
pub use span::Span;

use crate::clock::Clock;
use crate::ids::{RobotId, Team};
use crate::mind::teamwork::Booking;
use crate::mind::world_model::WorldModel;
use crate::pitch::BallKind;
use crate::protocol::b3p::Distance;
use crate::rng::Seed;
use crate::robot::{Orders, Robot, RobotState};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::Strategies;
use crate::strategy::teamwork::BallBooking;
use crate::world::ball::Ball;
use crate::world::physics::Overlaps;
use crate::world::referee::{Calls, Decision, MatchState, Phase};

pub(super) fn plugin(app: &mut App) {
    let systems = (digest::digest, measure, watch_bookings, watch_overlaps, move_clock).chain();
    app.match_resource::<Record>();
    app.add_systems(Tick, systems.in_set(TickSystems::Record));
}

/// Figures about the match so far. Where there are two, home is first. Only time of play counts.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct Record {
    /// Equal digests mean equal matches: all poses, roles, activities, role swaps and the score at all ticks, and how much was
    /// said.
    pub digest: u64,
    /// Seconds of play in which each team was the last one near the ball.
    pub possession: [f64; 2],
    /// How much the teams crowded the ball.
    pub crowding: Crowding,
    /// Who drove at the ball, told from what robots do.
    pub pursuit: [Pursuit; 2],
    /// How well each team's ball booking has worked, told from what its robots believe.
    pub bookings: [BookingFigures; 2],
    /// Who touched whom.
    pub contacts: RobotContacts,
    /// Balls that nobody touched, and who won them.
    pub loose_balls: LooseBalls,
    /// The kicks of each team.
    pub kicks: [KickFigures; 2],
    /// Whom the referee took off, and why.
    pub removals: Removals,
    /// How long robots kept their roles, by index.
    pub roles: [HoldFigures<usize>; 2],
    /// How long robots kept the states of their machines, by indices of role and state.
    pub states: [HoldFigures<(usize, usize)>; 2],
    /// How deep the ball has sunk into robots and walls.
    pub overlap: BallOverlap,
    /// Seconds of play.
    pub played: f64,
    /// Metres driven by each robot, by robot in order.
    pub driven: Vec<(RobotId, f64)>,
    last_near: Option<Team>,
    /// The velocity of the ball one tick ago, m/s.
    ball_before: Vec2,
}

/// A robot nearer to the ball than this has it, m.
const POSSESSION: f32 = 0.5;

impl Record {
    /// An empty record of a match between these robots, in order.
    pub fn new(seed: Seed, robots: impl IntoIterator<Item = RobotId>) -> Record {
        Record {
            digest: seed.0,
            possession: [0.0; 2],
            crowding: Crowding::default(),
            pursuit: Default::default(),
            bookings: [BookingFigures::default(); 2],
            contacts: RobotContacts::default(),
            loose_balls: LooseBalls::default(),
            kicks: Default::default(),
            removals: Removals::default(),
            roles: Default::default(),
            states: Default::default(),
            overlap: BallOverlap::default(),
            played: 0.0,
            driven: robots.into_iter().map(|robot| (robot, 0.0)).collect(),
            last_near: None,
            ball_before: Vec2::ZERO,
        }
    }

    fn update(&mut self, tick: &PlayTick) {
        self.played += tick.dt;
        self.note_possession(tick);
        self.note_ways(tick);
        self.crowding.update(tick);
        self.contacts.update(&tick.touching, tick.now, tick.dt);
        self.loose_balls.update(tick);
        for team in Team::BOTH {
            let i = team.index();
            self.pursuit[i].update(team, tick);
            self.kicks[i].update(team, tick, self.ball_before);
            let playing = || tick.of(team).filter(|player| player.plays);
            self.roles[i].update(playing().map(|it| (it.id.number, it.role)), tick.now, tick.dt);
            self.states[i].update(playing().map(|it| (it.id.number, it.state)), tick.now, tick.dt);
        }
        self.ball_before = tick.ball_velocity;
    }

    /// Play is interrupted.
    fn interrupt(&mut self) {
        self.contacts.interrupt();
        self.loose_balls.interrupt();
        self.pursuit.iter_mut().for_each(Pursuit::interrupt);
        self.roles.iter_mut().for_each(HoldFigures::interrupt);
        self.states.iter_mut().for_each(HoldFigures::interrupt);
    }

    fn note_possession(&mut self, tick: &PlayTick) {
        let mut nearest: Option<(f32, RobotId)> = None;
        for player in &tick.players {
            let distance = player.position.distance(tick.ball);
            if distance < POSSESSION && nearest.is_none_or(|best| (distance, player.id) < best) {
                nearest = Some((distance, player.id));
            }
        }
        self.last_near = nearest.map(|(_, id)| id.team).or(self.last_near);
        if let Some(team) = self.last_near {
            self.possession[team.index()] += tick.dt;
        }
    }

    fn note_ways(&mut self, tick: &PlayTick) {
        for player in &tick.players {
            if let Ok(index) = self.driven.binary_search_by_key(&player.id, |(robot, _)| *robot) {
                self.driven[index].1 += f64::from(player.velocity.length()) * tick.dt;
            }
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

fn measure(
    (clock, state, calls): (Res<Clock>, Res<MatchState>, Res<Calls>),
    mut record: ResMut<Record>,
    view: PlayView,
) {
    record.removals.update(&calls.0);
    if state.phase != Phase::Playing {
        return record.interrupt();
    }
    let tick = PlayTick {
        tick: clock.tick,
        now: record.played,
        dt: f64::from(clock.dt),
        ball_is_put: calls.0.iter().any(|call| matches!(call, Decision::BallPlaced { .. })),
        ..view.tick()
    };
    record.update(&tick);
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
