//! Which state of the league's six the referee tells each robot to be in.

use super::rulebook::{KickOffStyle, RuleBook};
use super::state::MatchState;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::robot::{Orders, RobotState};
use crate::world::referee::phase::Phase;

/// The orders of a robot under these circumstances, with the kick-off place that it was given.
pub fn orders_of(robot: RobotId, state: &MatchState, book: &RuleBook, place: Option<Pose>) -> Orders {
    let told = match state.phase {
        Phase::Finished => RobotState::Finished,
        _ if state.is_removed(robot) || state.restraints.is_frozen(robot) => RobotState::Penalised,
        Phase::Initial => RobotState::Initial,
        Phase::Ready | Phase::Playing if state.restraints.holds(robot) => RobotState::Set,
        Phase::Ready => RobotState::Ready,
        Phase::Set => RobotState::Set,
        Phase::Playing => RobotState::Playing,
    };
    let walks = book.kick_off == KickOffStyle::Walked && !state.restraints.carried;
    Orders { state: told, place: place.filter(|_| walks), ..Orders::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;
    use crate::world::referee::{RemovalReason, Restraints};

    #[test]
    fn robots_walk_in_ready_only_where_nobody_carries_them() {
        let robot = RobotId::new(Team::Home, 1);
        let place = Some(Pose::new(-1.0, 0.0, 0.0));
        let carried = RuleBook::default();
        let walked = RuleBook { kick_off: KickOffStyle::Walked, ..RuleBook::default() };
        let mut state = MatchState::new(Team::Home, &carried);
        state.phase = Phase::Ready;
        assert!(!orders_of(robot, &state, &carried, place).may_move());
        assert!(orders_of(robot, &state, &walked, place).may_move());
        state.remove(robot, 30.0, RemovalReason::Pushing);
        let penalised = orders_of(robot, &state, &walked, place);
        assert_eq!((penalised.state, penalised.may_move()), (RobotState::Penalised, false));
    }

    #[test]
    fn robots_that_are_restrained_stand_in_ready_and_in_play() {
        let (robot, other) = (RobotId::new(Team::Home, 1), RobotId::new(Team::Home, 2));
        let book = RuleBook { kick_off: KickOffStyle::Walked, ..RuleBook::default() };
        let told = |restraints: Restraints, phase| {
            let state = MatchState { phase, restraints, ..MatchState::new(Team::Home, &book) };
            [robot, other].map(|robot| orders_of(robot, &state, &book, Some(Pose::default())))
        };
        let (set, plays) = (RobotState::Set, RobotState::Playing);
        let stopped = Restraints { stopped: true, ..Restraints::default() };
        assert_eq!(told(stopped.clone(), Phase::Playing).map(|orders| orders.state), [set; 2]);
        assert_eq!(told(stopped.clone(), Phase::Ready).map(|orders| orders.state), [set; 2]);
        assert_eq!(told(stopped, Phase::Initial)[0].state, RobotState::Initial);
        let back = Restraints { held_back: vec![robot], ..Restraints::default() };
        assert_eq!(told(back, Phase::Playing).map(|orders| orders.state), [set, plays]);
        let frozen = Restraints { frozen: vec![other], ..Restraints::default() };
        assert_eq!(told(frozen, Phase::Playing).map(|orders| orders.state), [plays, RobotState::Penalised]);
        let carried = Restraints { carried: true, ..Restraints::default() };
        assert!(told(carried, Phase::Ready).iter().all(|orders| !orders.may_move()));
    }

    #[test]
    fn robots_play_in_play_and_stand_in_every_other_state() {
        let robot = RobotId::new(Team::Away, 0);
        let book = RuleBook::default();
        for phase in [Phase::Initial, Phase::Ready, Phase::Set, Phase::Playing, Phase::Finished] {
            let state = MatchState { phase, ..MatchState::new(Team::Home, &book) };
            let may_move = orders_of(robot, &state, &book, None).may_move();
            assert_eq!(may_move, phase == Phase::Playing, "{phase}");
        }
    }
}
