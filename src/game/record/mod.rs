//! The Record stage: the digest of all that happens, and figures about a match. Reads everything, changes nothing else; the
//! clock moves on at its end.

mod bookings;
mod contacts;
mod crowding;
mod digest;
mod figures;
mod holds;
mod invariants;
mod kicks;
mod localisation;
mod loose_balls;
mod overlap;
mod places;
mod play_tick;
mod pursuit;
mod removals;
mod replacement;
mod role_cover;
mod span;
#[cfg(test)]
mod tests;
mod trace;

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

use bookings::BallSeeker;
pub use bookings::BookingFigures;
pub use contacts::{APART, ContactTotal, RobotContacts};
pub use crowding::{AGGLOMERATION, CROWD, Crowding, RADII};
pub use figures::Record;
pub use holds::{BACK_WITHIN, HoldFigures};
pub use invariants::{Breach, BreachCount, Invariant, Invariants};
pub use kicks::{GripFigures, KickFigures};
pub use localisation::LocalisationFigures;
pub use loose_balls::{LOOSE_AFTER, LooseBalls, WON_AFTER};
pub use overlap::{BallOverlap, TOLERANCE};
pub use places::PlaceFigures;
use play_tick::{PlayView, plays};
pub use pursuit::{FARTHER, PING_PONG, Pursuit};
pub use removals::Removals;
pub use replacement::Replacement;
pub use role_cover::RoleCover;
pub use span::Span;
pub use trace::{DigestPart, TickTrace, TraceDifference};

use crate::clock::Clock;
use crate::geometry::Pose;
use crate::ids::{PlayerNumber, RobotId, Team};
use crate::mind::teamwork::Booking;
use crate::mind::world_model::WorldModel;
use crate::pitch::{BallKind, Pitch};
use crate::protocol::b3p::Distance;
use crate::robot::{OffPitch, Orders, Robot, RobotState};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::Strategies;
use crate::strategy::teamwork::BallBooking;
use crate::world::ball::Ball;
use crate::world::physics::Overlaps;
use crate::world::referee::{Calls, Decision, MatchState, Phase};

pub(super) fn plugin(app: &mut App) {
    let is_booked = |strategies: Res<Strategies>| {
        Team::BOTH.iter().any(|team| strategies.of(*team).teamwork.ball_booking.is_some())
    };
    let bookings = watch_bookings.run_if(is_booked);
    let invariants = invariants::watch.run_if(invariants::is_due);
    let beliefs = (bookings, watch_localisation).chain();
    let systems = (digest::digest, measure, beliefs, watch_overlaps, invariants, move_clock).chain();
    app.match_resource::<Record>();
    app.match_resource::<Invariants>().starts_empty();
    app.add_systems(Tick, systems.in_set(TickSystems::Record));
}

fn measure(
    (clock, state, calls, strategies): (Res<Clock>, Res<MatchState>, Res<Calls>, Res<Strategies>),
    pitch: Res<Pitch>,
    mut record: ResMut<Record>,
    view: PlayView,
) {
    record.removals.update(&calls.0);
    record.no_progress += calls.0.iter().filter(|call| call.ends_no_progress()).count() as u32;
    if state.phase != Phase::Playing {
        return record.interrupt();
    }
    let mut tick = view.tick();
    (tick.now, tick.dt) = (record.played, f64::from(clock.dt));
    (tick.home_attacks, tick.own_area) = (state.home_attacks, pitch.own_penalty_area());
    tick.ball_is_put = calls.0.iter().any(|call| matches!(call, Decision::BallPlaced { .. }));
    record.update(&tick, Team::BOTH.map(|team| strategies.of(team).players.as_slice()));
}

type BookingView<'a> = (&'a RobotId, &'a Robot, &'a WorldModel, &'a Booking, &'a Orders);

/// Robots that are penalised or off take no part.
fn watch_bookings(
    clock: Res<Clock>,
    strategies: Res<Strategies>,
    mut record: ResMut<Record>,
    robots: Query<BookingView>,
) {
    for team in Team::BOTH {
        let Some(spec) = &strategies.of(team).teamwork.ball_booking else { continue };
        let own = || robots.iter().filter(|(id, ..)| id.team == team);
        let off: SmallVec<[u8; 8]> =
            own().filter(|(_, robot, ..)| robot.health.crashed).map(|(id, ..)| id.number).collect();
        let mut seekers: SmallVec<[BallSeeker; 8]> = own()
            .filter(|(_, robot, .., orders)| !robot.health.crashed && orders.state == RobotState::Playing)
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
        record.bookings[team.index()].update((&off, &seekers), threshold, clock.now(), f64::from(clock.dt));
    }
}

/// Robots that are off the field, penalised or broken take no part.
fn watch_localisation(
    (clock, state): (Res<Clock>, Res<MatchState>),
    mut record: ResMut<Record>,
    robots: Query<(&RobotId, &Robot, &Pose, &WorldModel, &Orders), Without<OffPitch>>,
) {
    if state.phase != Phase::Playing {
        return;
    }
    for team in Team::BOTH {
        let attacking = state.attacking(team);
        let own = robots.iter().filter(|(id, robot, .., orders)| id.team == team && plays(robot, orders));
        let mut errors: SmallVec<[(PlayerNumber, f32); 8]> = own
            .map(|(id, _, pose, model, _)| {
                (id.number, attacking.turn(pose.position).distance(model.pose.position))
            })
            .collect();
        errors.sort_unstable_by_key(|(number, _)| *number);
        let now = record.played;
        record.localisation[team.index()].update(&errors, now, f64::from(clock.dt));
    }
}

fn watch_overlaps(
    overlaps: Overlaps,
    kind: Res<BallKind>,
    ball: Single<&RapierRigidBodyHandle, With<Ball>>,
    mut record: ResMut<Record>,
) {
    record.overlap.update(overlaps.of_ball(*ball, kind.radius));
}

fn move_clock(mut clock: ResMut<Clock>) {
    clock.tick += 1;
}
