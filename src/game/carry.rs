//! The hands around the pitch: put ball and robots where the referee's decisions want them, right after the decisions.

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;

use crate::clock::Clock;
use crate::comms::tcm::MessageBudgets;
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::pitch::Pitch;
use crate::robot::{OffPitch, Orders, PutDown, RobotBodies};
use crate::schedule::{Tick, TickSystems};
use crate::state::apply_event;
use crate::strategy::{Role, Strategies, Strategy};
use crate::world::ball::{Ball, BallPut};
use crate::world::physics::Put;
use crate::world::referee::{Calls, Decision, MatchState, Phase, RuleBook, judge, orders_of};
use crate::world::sense::told_place;

pub(super) fn plugin(app: &mut App) {
    let are_called = |calls: Res<Calls>| !calls.0.is_empty();
    let carry = (place_ball, place_robots).chain().run_if(are_called);
    app.add_systems(Tick, (carry, tell_robots).chain().after(judge).in_set(TickSystems::Referee));
}

fn place_ball(
    (state, calls): (Res<MatchState>, Res<Calls>),
    mut commands: Commands,
    ball: Single<Entity, With<Ball>>,
    robots: Query<(&RobotId, &RobotBodies)>,
) {
    for call in &calls.0 {
        if let Decision::BallPlaced { at, .. } = call {
            let is_lifted = |id: RobotId| calls.0.iter().any(|call| moves(call, id, &state));
            let lifted = robots.iter().filter(|(id, _)| is_lifted(**id)).flat_map(|(_, bodies)| bodies.all());
            let at = Pose { position: *at, heading: 0.0 };
            let rests =
                |world: &mut World, ball, _| apply_event(world, ball, &BallPut { velocity: Vec2::ZERO });
            let put = Put { at, lifted: lifted.collect(), ..Put::default() };
            commands.entity(*ball).queue(put.then(rests));
        }
    }
}

/// Whether people carry a robot somewhere by a decision.
fn moves(call: &Decision, id: RobotId, state: &MatchState) -> bool {
    match call {
        Decision::RobotsPlaced { .. } => !state.is_removed(id),
        Decision::RobotReturned { robot, .. }
        | Decision::RobotPlaced { robot, .. }
        | Decision::RobotRemoved { robot, .. } => *robot == id,
        _ => false,
    }
}

fn place_robots(
    clock: Res<Clock>,
    (pitch, state, strategies, calls): (Res<Pitch>, Res<MatchState>, Res<Strategies>, Res<Calls>),
    mut commands: Commands,
    robots: Query<(Entity, &RobotId, &RobotBodies, &Role)>,
) {
    let is_lifted = |id: RobotId| calls.0.iter().any(|call| moves(call, id, &state));
    let mut lifted: Vec<(RobotId, RapierRigidBodyHandle)> = Vec::new();
    for (_, id, handles, _) in robots.iter().filter(|(_, id, ..)| is_lifted(**id)) {
        lifted.extend(handles.all().into_iter().map(|handle| (*id, handle)));
    }
    for call in &calls.0 {
        let kick_off = match *call {
            Decision::RobotsPlaced { kick_off } => Some(Team::BOTH.map(|team| {
                let in_team = robots.iter().filter(|(_, id, ..)| id.team == team);
                let mut roles: Vec<(u8, usize)> =
                    in_team.map(|(_, id, _, role)| (id.number, role.0)).collect();
                roles.sort_unstable();
                kick_off_poses(strategies.of(team), &roles, kick_off == Some(team))
            })),
            _ => None,
        };
        // In order, since Rapier remembers the order in which bodies are touched.
        for (robot, &id, ..) in robots.iter().sort::<&RobotId>() {
            let ends = state.attacking(id.team);
            if !moves(call, id, &state) {
                continue;
            }
            let at = match *call {
                Decision::RobotsPlaced { .. } => {
                    let poses = kick_off.as_ref().map(|both| &both[id.team.index()]);
                    let own = poses.and_then(|poses| poses.iter().find(|(number, _)| *number == id.number));
                    ends.turn_pose(own.map_or_else(Pose::default, |(_, pose)| *pose))
                }
                Decision::RobotReturned { at, .. } | Decision::RobotPlaced { at, .. } => at,
                _ => beside_the_pitch(&pitch, id),
            };
            let mut robot = commands.entity(robot);
            match call {
                Decision::RobotReturned { .. } => {
                    robot.remove::<OffPitch>();
                }
                Decision::RobotRemoved { .. } => {
                    robot.insert(OffPitch);
                }
                _ => {}
            }
            lifted.retain(|(other, _)| *other != id);
            let in_the_air = lifted.iter().map(|(_, handle)| *handle).collect();
            let (strategy, tick) = (strategies.0[id.team.index()].clone(), clock.tick);
            let put = Put { at, lifted: in_the_air, ..Put::default() };
            robot.queue(put.then(move |world, robot, at| {
                let told = told_place(world, robot, ends.turn_pose(at));
                apply_event(world, robot, &PutDown { told, strategy, tick });
            }));
        }
    }
}

/// Tells each robot what the referee wants of it. Places for a kick-off are given out when robots get ready for it.
fn tell_robots(
    (book, state, strategies, calls): (Res<RuleBook>, Res<MatchState>, Res<Strategies>, Res<Calls>),
    budgets: Option<Res<MessageBudgets>>,
    mut robots: Query<(&RobotId, &Role, &mut Orders)>,
) {
    let begins = calls.0.contains(&Decision::PhaseChanged(Phase::Ready));
    let places = begins.then(|| {
        Team::BOTH.map(|team| {
            let in_team = robots.iter().filter(|(id, ..)| id.team == team);
            let mut roles: Vec<(u8, usize)> = in_team.map(|(id, role, _)| (id.number, role.0)).collect();
            roles.sort_unstable();
            kick_off_poses(strategies.of(team), &roles, state.kicks_off(team))
        })
    });
    for (id, _, mut orders) in &mut robots {
        let place = match &places {
            Some(both) => {
                both[id.team.index()].iter().find(|(number, _)| *number == id.number).map(|(_, place)| *place)
            }
            None => orders.place,
        };
        let messages_left = budgets.as_ref().map(|budgets| budgets.share_left(id.team));
        let next = Orders { messages_left, ..orders_of(*id, &state, &book, place) };
        if *orders != next {
            *orders = next;
        }
    }
}

/// The robots' places at a kick-off, in their team frame, looking at the opponents' goal, by number: each takes the place of its
/// role. Where robots share one, those that find theirs taken share out what is left.
fn kick_off_poses(strategy: &Strategy, roles: &[(u8, usize)], ours: bool) -> Vec<(u8, Pose)> {
    let places = if ours { &strategy.kick_off.ours } else { &strategy.kick_off.theirs };
    let mut free: Vec<usize> = (0..places.len()).collect();
    let mut take = |fits: &dyn Fn(usize) -> bool| {
        let found = free.iter().position(|place| fits(*place))?;
        Some(free.remove(found))
    };
    let own: Vec<Option<usize>> =
        roles.iter().map(|(_, role)| take(&|place| strategy.players.get(place) == Some(role))).collect();
    let taken = own.into_iter().map(|own| own.or_else(|| take(&|_| true)));
    let poses = taken.map(|place| place.and_then(|place| places.get(place)).copied().unwrap_or_default());
    roles.iter().zip(poses).map(|((number, _), at)| (*number, Pose { position: at, heading: 0.0 })).collect()
}

/// Where a robot waits before the match, and after it was taken off.
pub(super) fn beside_the_pitch(pitch: &Pitch, id: RobotId) -> Pose {
    let side = if id.team == Team::Home { -1.0 } else { 1.0 };
    let y = pitch.half_size().y + pitch.margin() + pitch.walls.thickness + 0.6;
    Pose::new(side * (1.0 + f32::from(id.number)), y, -std::f32::consts::FRAC_PI_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strategy::KickOff;

    #[test]
    fn robots_take_the_places_of_their_roles_and_share_out_what_nobody_takes() {
        let places = [-1.0, -2.0, -3.0].map(|x| Vec2::new(x, 0.0));
        let kick_off = KickOff { ours: places.to_vec(), theirs: places.to_vec() };
        let strategy = Strategy { players: vec![5, 6, 7], kick_off, ..crate::testing::idle() };
        let x = |roles: &[(u8, usize)]| -> Vec<f32> {
            kick_off_poses(&strategy, roles, true).iter().map(|(_, pose)| pose.position.x).collect()
        };
        assert_eq!(x(&[(0, 5), (1, 6), (2, 7)]), [-1.0, -2.0, -3.0]);
        assert_eq!(x(&[(0, 7), (1, 6), (2, 5)]), [-3.0, -2.0, -1.0]);
        assert_eq!(x(&[(0, 7), (1, 7), (2, 5)]), [-3.0, -2.0, -1.0], "two with one role");
    }
}
