//! Following a referee box: it decides about states, score, clock and penalties, and our own referee stands back. What is
//! left to us is what the helpers around a pitch do: they carry robots and put a ball that is out back.

use bevy::prelude::Vec2;

use super::{Laws, Observation, by_hand, out, placed_ball, returns, touches};
use crate::gamecontroller::control::State;
use crate::gamecontroller::referee_box::View;
use crate::ids::{RobotId, Team};
use crate::referee::decision::{Decision, PlacementReason, RemovalReason};
use crate::referee::rulebook::KickOffStyle;
use crate::referee::state::{MatchState, Phase};

/// Does what a referee box says, `dt` seconds after the last look.
pub fn follow(
    view: &View,
    laws: &Laws,
    observation: &Observation,
    dt: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    if !view.first_half && state.half == 1 {
        decisions.push(Decision::HalfEnded { half: 1 });
        state.half = 2;
        state.home_attacks = state.home_attacks.reversed();
    }
    count_goals(view, state, decisions);
    if let Some(side) = view.kicking {
        state.kick_off = Team::BOTH[side.min(1)];
    }
    state.time_left = f64::from(view.seconds_left.max(0));
    change_phase(view, laws, observation, state, decisions);
    state.played = if state.phase == Phase::Playing { dt } else { 0.0 };
    touches::touches(laws, observation, dt, state, decisions);
    out::out(laws, observation, dt, state, decisions);
    change_penalties(view, laws, observation, state, decisions);
    state.seen_ball = Some(placed_ball(decisions).unwrap_or(observation.ball));
}

/// A score may also be taken back; then nobody is told.
fn count_goals(view: &View, state: &mut MatchState, decisions: &mut Vec<Decision>) {
    let before = state.score;
    state.score = view.score;
    let scored = Team::BOTH.into_iter().filter(|team| view.score[team.index()] > before[team.index()]);
    decisions.extend(scored.map(|by| Decision::Goal { by, score: view.score }));
}

/// The phase that a box's state is for us; none for states that we do not know.
fn phase_of(view: &View) -> Option<Phase> {
    match view.state {
        State::Initial | State::Standby => Some(Phase::Initial),
        State::Ready => Some(Phase::Ready),
        State::Set => Some(Phase::Set),
        State::Playing => Some(Phase::Playing),
        // A half is finished, too.
        State::Finished if view.first_half => Some(Phase::Initial),
        State::Finished => Some(Phase::Finished),
        State::Other(_) => None,
    }
}

fn change_phase(
    view: &View,
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Some(next) = phase_of(view).filter(|next| *next != state.phase) else { return };
    let before = std::mem::replace(&mut state.phase, next);
    decisions.push(Decision::PhaseChanged(next));
    let walked = laws.book.kick_off == KickOffStyle::Walked;
    match next {
        Phase::Ready => {
            let half_begins = before == Phase::Initial;
            decisions.push(Decision::BallPlaced { at: Vec2::ZERO, reason: PlacementReason::KickOff });
            if !walked {
                decisions.push(Decision::RobotsPlaced { kick_off: state.kick_off });
            } else if half_begins {
                by_hand::line_up(laws, observation, state, decisions);
            }
        }
        Phase::Set => by_hand::places_by_hand(laws, observation, 0.0, state, decisions),
        Phase::Finished => decisions.push(Decision::MatchFinished { score: state.score }),
        Phase::Initial | Phase::Playing => {}
    }
}

fn change_penalties(
    view: &View,
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let penalised = |robot: RobotId| {
        view.penalties[robot.team.index()].iter().any(|penalised| penalised.player == robot.number)
    };
    let present: Vec<RobotId> = observation.robots.iter().map(|(robot, _)| *robot).collect();
    for robot in present.into_iter().filter(|robot| penalised(*robot)) {
        let reason = RemovalReason::RefereeBox;
        if state.remove(robot, f64::INFINITY, reason) {
            decisions.push(Decision::RobotRemoved { robot, reason });
        }
    }
    let free: Vec<RobotId> =
        state.removed.iter().map(|removal| removal.robot).filter(|robot| !penalised(*robot)).collect();
    returns::bring_back(&free, laws, observation, state, decisions);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gamecontroller::control::{GamePhase, Penalty, SetPlay};
    use crate::gamecontroller::referee_box::Penalised;
    use crate::referee::rules::table::Table;

    const HOME_2: RobotId = RobotId::new(Team::Home, 2);

    fn view(state: State) -> View {
        View {
            state,
            game_phase: GamePhase::Normal,
            set_play: SetPlay::None,
            stopped: false,
            first_half: true,
            kicking: Some(1),
            score: [0, 0],
            seconds_left: 600,
            secondary_time: 0,
            penalties: [vec![], vec![]],
        }
    }

    /// What is decided at one look at the table.
    fn hear(table: &mut Table, view: &View) -> Vec<Decision> {
        let laws = Laws { pitch: &table.pitch, book: &table.book, ball_radius: 0.11 };
        let mut decisions = Vec::new();
        let observation = Observation::of(table.ball, &table.robots);
        follow(view, &laws, &observation, 0.02, &mut table.state, &mut decisions);
        for decision in &decisions {
            match decision {
                Decision::RobotRemoved { robot, .. } => table.take_off(*robot),
                Decision::RobotReturned { robot, at } => table.put(*robot, at.position),
                _ => {}
            }
        }
        decisions
    }

    #[test]
    fn the_box_leads_through_the_states_and_chooses_who_kicks_off() {
        let mut table = Table::new(60);
        assert_eq!(hear(&mut table, &view(State::Initial)), []);
        let ready = hear(&mut table, &view(State::Ready));
        assert!(ready.contains(&Decision::RobotsPlaced { kick_off: Team::Away }), "{ready:?}");
        assert_eq!(hear(&mut table, &view(State::Set)), [Decision::PhaseChanged(Phase::Set)]);
        assert_eq!(hear(&mut table, &view(State::Playing)), [Decision::PhaseChanged(Phase::Playing)]);
        assert_eq!(hear(&mut table, &view(State::Playing)), []);
    }

    #[test]
    fn a_ball_in_the_goal_is_a_goal_when_the_box_says_so_and_not_before() {
        let mut table = Table::new(60);
        for state in [State::Ready, State::Set, State::Playing] {
            hear(&mut table, &view(state));
        }
        table.ball = Vec2::new(4.7, 0.0);
        assert_eq!(hear(&mut table, &view(State::Playing)), []);
        let scored = View { score: [1, 0], ..view(State::Ready) };
        let decisions = hear(&mut table, &scored);
        assert_eq!(decisions[0], Decision::Goal { by: Team::Home, score: [1, 0] });
        assert_eq!(table.state.score, [1, 0]);
    }

    #[test]
    fn a_penalised_robot_is_off_until_the_box_lets_it_back() {
        let mut table = Table::new(60);
        hear(&mut table, &view(State::Playing));
        let mut penalty = view(State::Playing);
        penalty.penalties[0] = vec![Penalised { player: 2, penalty: Penalty::Pushing, seconds_left: 0 }];
        let removed = Decision::RobotRemoved { robot: HOME_2, reason: RemovalReason::RefereeBox };
        assert_eq!(hear(&mut table, &penalty), [removed]);
        assert_eq!(hear(&mut table, &penalty), [], "once");
        assert!(table.state.is_removed(HOME_2));
        let back = hear(&mut table, &view(State::Playing));
        assert!(matches!(back[..], [Decision::RobotReturned { robot: HOME_2, .. }]), "{back:?}");
        assert!(!table.state.is_removed(HOME_2));
    }

    #[test]
    fn ends_change_with_the_half_and_the_match_is_over_after_the_second() {
        let mut table = Table::new(60);
        hear(&mut table, &view(State::Playing));
        hear(&mut table, &view(State::Finished));
        assert_eq!(table.state.phase, Phase::Initial, "a half is over, not the match");
        let before = table.state.home_attacks;
        hear(&mut table, &View { first_half: false, ..view(State::Ready) });
        assert_eq!((table.state.half, table.state.home_attacks), (2, before.reversed()));
        let end = hear(&mut table, &View { first_half: false, ..view(State::Finished) });
        assert!(end.contains(&Decision::MatchFinished { score: [0, 0] }), "{end:?}");
    }
}
