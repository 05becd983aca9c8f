//! The penalties of a box, each served as the league has it.

use super::super::returns;
use crate::ids::RobotId;
use crate::world::gamecontroller::referee_box::BoxView;
use crate::world::gamecontroller::serving::Serving;
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::MatchState;

pub(super) fn follow(
    view: &BoxView,
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let serving = |robot: RobotId| view.penalty_of(robot.team.index(), robot.number).serving();
    let is_off = |robot: RobotId| matches!(serving(robot), Some(Serving::CarriedOff | Serving::NotPlaying));
    let present: Vec<RobotId> = observation.robots.iter().map(|(robot, _)| *robot).collect();
    for &robot in present.iter().filter(|robot| is_off(**robot)) {
        let reason = RemovalReason::RefereeBox;
        if state.remove(robot, f64::INFINITY, reason) {
            decisions.push(Decision::RobotRemoved { robot, reason });
        }
    }
    let free: Vec<RobotId> =
        state.removed.iter().map(|removal| removal.robot).filter(|robot| !is_off(*robot)).collect();
    returns::bring_back(&free, laws, observation, state, decisions);
    let frozen = present.into_iter().filter(|robot| serving(*robot) == Some(Serving::InPlace));
    state.restraints.frozen = frozen.collect();
}
