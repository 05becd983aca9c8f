//! A penalty kick, also one of a shoot-out: the ball lies on the penalty spot, the kicker and the opposing goalkeeper take
//! part, and all others stand on the half-way line until it is over. People put everybody in place.

use bevy::prelude::Vec2;

use crate::geometry::{Attacking, Pose, angle};
use crate::ids::{RobotId, Team};
use crate::world::gamecontroller::referee_box::BoxView;
use crate::world::referee::decision::{Decision, PlacementReason};
use crate::world::referee::followed::Duel;
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::RuleBook;
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::MatchState;

impl Duel {
    /// The team's goalkeeper keeps, and of the others the one that is nearest to the ball kicks; a robot that is alone does
    /// either.
    fn of(kicking: Team, ball: Vec2, observation: &Observation, state: &MatchState) -> Duel {
        let nearest = |team: Team, keeps: bool| {
            let asked = |robot: RobotId| robot.team == team && (robot.number == RuleBook::KEEPER) == keeps;
            observation.nearest(state, ball, asked).map(|(robot, _)| robot)
        };
        let first = |team, keeps: bool| nearest(team, keeps).or_else(|| nearest(team, !keeps));
        Duel { kicker: first(kicking, false), keeper: first(kicking.opponent(), true), begun: false }
    }

    fn has(&self, robot: RobotId) -> bool {
        self.kicker == Some(robot) || self.keeper == Some(robot)
    }
}

pub(super) fn follow(
    view: &BoxView,
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let runs = matches!(state.phase, Phase::Ready | Phase::Set | Phase::Playing) && view.is_penalty_kick();
    let Some(kicking) = view.kicking_team().filter(|_| runs) else {
        state.following.penalty_kick = None;
        state.restraints.carried = false;
        return;
    };
    state.restraints.carried = true;
    let changed = |to| decisions.contains(&Decision::PhaseChanged(to));
    let (ready, set) = (changed(Phase::Ready), changed(Phase::Set));
    let mut duel = match state.following.penalty_kick {
        Some(duel) if !(ready || set && duel.begun) => duel,
        _ => {
            let ball = spot(laws, state.attacking(kicking));
            decisions.push(Decision::BallPlaced { at: ball, reason: PlacementReason::SetPlay });
            let duel = Duel::of(kicking, ball, observation, state);
            place(duel, ball, laws, observation, state, decisions);
            duel
        }
    };
    duel.begun |= state.phase == Phase::Playing;
    state.following.penalty_kick = Some(duel);
    let others = observation.on_field(state).map(|(robot, _)| robot).filter(|robot| !duel.has(*robot));
    state.restraints.held_back = others.collect();
}

/// The penalty spot before the goal that is attacked: of the pitch's spots on its long axis the nearest to the goal, or the
/// front of the penalty area where it has none.
fn spot(laws: &Laws, attacks: Attacking) -> Vec2 {
    let ahead = laws.pitch.penalty_spots.iter().map(|spot| attacks.turn(*spot));
    let on_axis = ahead.filter(|spot| spot.y.abs() < ON_AXIS && spot.x > laws.pitch.length / 8.0);
    let nearest = on_axis.max_by(|a, b| a.x.total_cmp(&b.x));
    let front = Vec2::new(-laws.pitch.own_penalty_area().max.x, 0.0);
    attacks.turn(nearest.unwrap_or(front))
}

/// Metres from the long axis within which a spot is on it.
const ON_AXIS: f32 = 0.01;

/// Puts the kicker behind the ball, the goalkeeper on its line, and all others on the half-way line, each team on its side.
fn place(
    duel: Duel,
    ball: Vec2,
    laws: &Laws,
    observation: &Observation,
    state: &MatchState,
    decisions: &mut Vec<Decision>,
) {
    let room = laws.book.spot_clearance;
    let half = laws.pitch.half_size();
    let goal = Vec2::new(half.x.copysign(ball.x), 0.0);
    let mut waiting = [0_u8; 2];
    for (robot, _) in observation.on_field(state) {
        let inwards = (Vec2::ZERO - goal).normalize_or(Vec2::X);
        let at = if duel.kicker == Some(robot) {
            Pose { position: ball + 2.0 * room * inwards, heading: angle(-inwards) }
        } else if duel.keeper == Some(robot) {
            Pose { position: goal + room * inwards, heading: angle(inwards) }
        } else {
            let number = &mut waiting[robot.team.index()];
            let row = f32::from(number.div_ceil(2)) * 2.0 * room;
            let y = if number.is_multiple_of(2) { row } else { -row };
            *number += 1;
            let attacks = state.attacking(robot.team);
            attacks.turn_pose(Pose::new(-room, y.clamp(-half.y + room, half.y - room), 0.0))
        };
        decisions.push(Decision::RobotPlaced { robot, at });
    }
}
