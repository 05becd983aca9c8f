//! What fails to hold in a tick.

use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_rapier2d::rapier::dynamics::RigidBodyHandle;
use smallvec::SmallVec;

use super::breach::{Failing, Robots};
use super::invariant::{Invariant, ROBOT_TOLERANCE};
use crate::clock::Clock;
use crate::comms::radio::RadioRecord;
use crate::game::record::figures::Record;
use crate::game::record::overlap::TOLERANCE;
use crate::game::record::play_tick;
use crate::geometry::{Pose, Twist};
use crate::ids::{RobotId, Team};
use crate::mind::teamwork::{Booking, BookingStatus, Swapping, TeamModel, kick_off_roles};
use crate::mind::world_model::WorldModel;
use crate::pitch::Pitch;
use crate::robot::{OffPitch, Orders, Robot, RobotBodies};
use crate::strategy::teamwork::Mechanism;
use crate::strategy::{Role, Strategies, Strategy};
use crate::world::ball::Ball;
use crate::world::physics::Overlaps;
use crate::world::referee::{DefenderRule, MatchState, Phase, RuleBook};

/// All that is looked at, but for what is looked at from tick to tick.
#[derive(SystemParam)]
pub(in crate::game::record) struct LookView<'w, 's> {
    pitch: Res<'w, Pitch>,
    state: Res<'w, MatchState>,
    book: Res<'w, RuleBook>,
    ball: Single<'w, 's, (&'static Pose, &'static Twist), With<Ball>>,
    robots: Query<'w, 's, LookedAt>,
    overlaps: Overlaps<'w, 's>,
}

#[derive(QueryData)]
pub(in crate::game::record) struct LookedAt {
    id: &'static RobotId,
    robot: &'static Robot,
    orders: &'static Orders,
    pose: &'static Pose,
    twist: &'static Twist,
    role: &'static Role,
    model: &'static WorldModel,
    team_model: &'static TeamModel,
    swapping: Option<&'static Swapping>,
    booking: Option<&'static Booking>,
    bodies: Option<&'static RobotBodies>,
    off_pitch: Has<OffPitch>,
}

/// A ball that was seen no longer ago than this is seen, s.
const SEES: f32 = 0.5;

/// What fails of one invariant: everybody that it is about.
type Of = (Invariant, Robots);

impl LookView<'_, '_> {
    /// Everything that fails to hold in the tick.
    pub(super) fn failing(
        &self,
        clock: &Clock,
        strategies: &Strategies,
        seen: (&Record, &RadioRecord),
        off: &mut SmallVec<[(RobotId, u64); 4]>,
    ) -> Vec<Failing> {
        let mut robots: SmallVec<[LookedAtItem; 16]> = self.robots.iter().collect();
        robots.sort_unstable_by_key(|it| *it.id);
        let (ball, motion) = *self.ball;
        let look = InvariantLook { pitch: &self.pitch, state: &self.state, book: &self.book, robots };
        let inside = look.inside(self.overlaps.deeper_than(ROBOT_TOLERANCE));
        look.failing(&inside, (ball, motion), clock, strategies, seen, off)
    }
}

/// One look.
struct InvariantLook<'a, 'w, 's> {
    pitch: &'a Pitch,
    state: &'a MatchState,
    book: &'a RuleBook,
    /// In order.
    robots: SmallVec<[LookedAtItem<'w, 's>; 16]>,
}

impl InvariantLook<'_, '_, '_> {
    fn failing(
        &self,
        inside: &[RobotId],
        (ball, motion): (&Pose, &Twist),
        clock: &Clock,
        strategies: &Strategies,
        (record, radio): (&Record, &RadioRecord),
        off: &mut SmallVec<[(RobotId, u64); 4]>,
    ) -> Vec<Failing> {
        let mut failing = Vec::new();
        let mut note = |team: Option<Team>, (invariant, robots): Of, fails: bool| {
            if fails {
                failing.push(Failing { invariant, team, robots });
            }
        };
        let is_finite = |pose: &Pose, twist: &Twist| pose.is_finite() && twist.is_finite();
        note(None, (Invariant::Finite, Robots::new()), !is_finite(ball, motion));
        note(None, (Invariant::InTheWorld, Robots::new()), !self.holds(ball.position));
        note(None, (Invariant::BallIsSolid, Robots::new()), record.overlap.now > TOLERANCE);
        for team in Team::BOTH {
            let mut note = |what: Of| {
                let fails = !what.1.is_empty();
                note(Some(team), what, fails);
            };
            let strategy = strategies.of(team);
            note((Invariant::Finite, self.of(team, |it| !is_finite(it.pose, it.twist))));
            let is_out = |it: &LookedAtItem| !it.off_pitch && !self.holds(it.pose.position);
            note((Invariant::InTheWorld, self.of(team, is_out)));
            note((Invariant::RobotsAreSolid, self.of(team, |it| inside.contains(it.id))));
            note((Invariant::OffIsDeaf, self.reached(team, radio, off)));
            self.look_at_swaps(team, strategy, clock, &mut note);
            if self.state.phase == Phase::Playing {
                self.look_at_play(team, strategy, clock, record, &mut note);
            }
        }
        failing
    }

    /// The robots of a team of which something is so, in order.
    fn of(&self, team: Team, is_so: impl Fn(&LookedAtItem) -> bool) -> Robots {
        let found = self.robots.iter().filter(|it| it.id.team == team && is_so(it));
        found.map(|it| *it.id).collect()
    }

    fn holds(&self, point: Vec2) -> bool {
        self.pitch.holds(point, self.pitch.margin())
    }

    /// The robots on the pitch that are in other ones or in walls.
    fn inside(&self, pairs: impl Iterator<Item = [Option<RigidBodyHandle>; 2]>) -> Robots {
        let owner = |body: RigidBodyHandle| {
            let owns =
                |it: &&LookedAtItem| it.bodies.is_some_and(|own| own.all().iter().any(|own| own.0 == body));
            self.robots.iter().find(owns).filter(|it| !it.off_pitch).map(|it| *it.id)
        };
        let mut inside = Robots::new();
        for bodies in pairs {
            match bodies.map(|body| body.map(owner)) {
                [Some(Some(one)), Some(Some(other))] if one != other => inside.extend([one, other]),
                [Some(Some(robot)), None] | [None, Some(Some(robot))] => inside.push(robot),
                _ => {}
            }
        }
        inside
    }

    /// Those of a team that are off and were reached by a packet since.
    fn reached(&self, team: Team, radio: &RadioRecord, off: &mut SmallVec<[(RobotId, u64); 4]>) -> Robots {
        let is_off = |robot: RobotId| self.robots.iter().any(|it| *it.id == robot && it.robot.health.crashed);
        off.retain(|(robot, _)| robot.team != team || is_off(*robot));
        for robot in self.of(team, |it| it.robot.health.crashed) {
            if off.iter().all(|(known, _)| *known != robot) {
                off.push((robot, radio.sent_to(robot).delivered));
            }
        }
        let own = off.iter().filter(|(robot, _)| robot.team == team);
        own.filter(|(robot, before)| radio.sent_to(*robot).delivered > *before)
            .map(|(robot, _)| *robot)
            .collect()
    }

    /// What must hold of locks and configurations, also while play is interrupted.
    fn look_at_swaps(&self, team: Team, strategy: &Strategy, clock: &Clock, note: &mut impl FnMut(Of)) {
        if !strategy.teamwork.has(Mechanism::RoleSwap) {
            return;
        }
        let all = kick_off_roles(strategy);
        let thinks = |it: &LookedAtItem| !it.robot.remote && !it.robot.health.crashed;
        let is_late = |it: &LookedAtItem| it.swapping.is_some_and(|swapping| swapping.is_overdue(clock.tick));
        note((Invariant::LockIsGivenBack, self.of(team, |it| thinks(it) && is_late(it))));
        let configuration = |it: &LookedAtItem| it.swapping?.machine.configuration().cloned();
        let has_others =
            |it: &LookedAtItem| configuration(it).is_some_and(|known| !known.assignment.has_roles_of(&all));
        note((Invariant::RolesAreKept, self.of(team, |it| thinks(it) && has_others(it))));
    }

    fn look_at_play(
        &self,
        team: Team,
        strategy: &Strategy,
        clock: &Clock,
        record: &Record,
        note: &mut impl FnMut(Of),
    ) {
        let playing = self.of(team, plays);
        if strategy.teamwork.role_swap.is_some() && strategy.teamwork.has(Mechanism::RoleSwap) {
            let held = |role: usize| self.of(team, |it| plays(it) && it.role.0 == role);
            let wanted = |role: usize| strategy.players.iter().filter(|other| **other == role).count();
            let doubled = self.of(team, |it| plays(it) && held(it.role.0).len() > wanted(it.role.0));
            note((Invariant::OneRobotARole, doubled));
            let is_complete = playing.len() == strategy.players.len();
            let is_vacant = is_complete && strategy.players.iter().any(|role| held(*role).is_empty());
            note((Invariant::NoRoleVacant, if is_vacant { playing.clone() } else { Robots::new() }));
        }
        let driving = self.of(team, |it| plays(it) && record.pursuit[team.index()].drives(it.id.number));
        if strategy.teamwork.ball_booking.is_some() && strategy.teamwork.has(Mechanism::BallBooking) {
            let is_booked = self.robots.iter().any(|it| {
                it.id.team == team && plays(it) && it.booking.is_some_and(|booking| booking.0.goes())
            });
            let several = if is_booked && driving.len() > 1 { driving.clone() } else { Robots::new() };
            note((Invariant::OneAtBookedBall, several));
            let is_absent = |number: u8| !playing.contains(&RobotId::new(team, number));
            note((
                Invariant::BookerPlays,
                self.of(team, |it| {
                    plays(it)
                        && matches!(it.team_model.booking, BookingStatus::Mate(booker) if is_absent(booker))
                }),
            ));
        }
        let sees = |it: &LookedAtItem| {
            let lately = |seen: u64| seen + clock.ticks(SEES) >= clock.tick;
            plays(it) && it.model.is_localised() && it.model.ball.is_some_and(|ball| lately(ball.seen))
        };
        note((Invariant::SomebodyGoes, if driving.is_empty() { self.of(team, sees) } else { Robots::new() }));
        if self.book.defenders == DefenderRule::Second {
            let area = self.pitch.own_penalty_area();
            let is_in = |it: &LookedAtItem| area.contains(self.state.attacking(team).turn(it.pose.position));
            let inside = self.of(team, |it| plays(it) && is_in(it));
            note((Invariant::OneDefender, if inside.len() > 1 { inside } else { Robots::new() }));
        }
    }
}

fn plays(it: &LookedAtItem) -> bool {
    !it.off_pitch && play_tick::plays(it.robot, it.orders)
}
