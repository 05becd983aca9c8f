//! How a match flows: kick-off, ready, set, playing, half time, the end.
//!
//! A rule that owes a kick-off sets [`Phase::Initial`]; [`kick_off`] takes it within the same sample.

use bevy::prelude::Vec2;

use super::{by_hand, returns};
use crate::world::referee::decision::{Decision, PlacementReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{KickOffStyle, RuleBook};
use crate::world::referee::rules::observation::{Laws, Observation, ROUNDING, is_over};
use crate::world::referee::state::{KickOffShot, MatchState};

/// Leads from ready over set to play, and tells how many seconds of the sample were played.
pub(super) fn phases(
    laws: &Laws,
    _: &Observation,
    dt: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    state.played = 0.0;
    match state.phase {
        Phase::Initial | Phase::Ready | Phase::Set => state.waited += dt,
        Phase::Playing => state.played = dt,
        Phase::Finished => {}
    }
    let waits = [
        (Phase::Ready, laws.book.ready_seconds, Phase::Set),
        (Phase::Set, laws.book.set_seconds, Phase::Playing),
    ];
    for (phase, seconds, next) in waits {
        if state.phase == phase && is_over(state.waited, seconds) {
            state.phase = next;
            state.waited = (state.waited - f64::from(seconds)).max(0.0);
            decisions.push(Decision::PhaseChanged(next));
            if next == Phase::Playing {
                state.played = std::mem::take(&mut state.waited);
            }
        }
    }
}

/// Counts the playing time down and ends the half. Then the teams change ends and the one that did not open the match
/// kicks off, or the match is over.
pub(super) fn clock(
    laws: &Laws,
    _: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    if state.played == 0.0 {
        return;
    }
    let left = state.time_left - state.played;
    if left > ROUNDING {
        state.time_left = left;
        return;
    }
    decisions.push(Decision::HalfEnded { half: state.half });
    if state.half < RuleBook::HALVES {
        state.half += 1;
        state.time_left = laws.book.half_seconds();
        state.home_attacks = state.home_attacks.reversed();
        state.kick_off = state.opened.opponent();
        state.waited = (state.waited - left).max(0.0);
        state.phase = Phase::Initial;
    } else {
        state.time_left = 0.0;
        finish(state, decisions);
    }
}

/// Ends a match that one team leads by too much. The playing time that is left stays on the clock.
pub(super) fn mercy(
    laws: &Laws,
    _: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let [home, away] = state.score;
    let decided = laws.book.mercy.is_some_and(|lead| home.abs_diff(away) >= lead);
    if decided && state.phase != Phase::Finished {
        finish(state, decisions);
    }
}

fn finish(state: &mut MatchState, decisions: &mut Vec<Decision>) {
    state.waited = 0.0;
    state.phase = Phase::Finished;
    decisions.push(Decision::PhaseChanged(Phase::Finished));
    decisions.push(Decision::MatchFinished { score: state.score });
}

/// Takes a kick-off that is owed: ball and robots are put in their places and all earlier clocks of the play are void.
/// Robots that walk to their places are carried only where a half begins.
pub(super) fn kick_off(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    if state.phase != Phase::Initial {
        return;
    }
    state.phase = Phase::Ready;
    state.anchor = None;
    state.defenders.clear();
    state.settled = None;
    state.shot = if laws.book.goal_from_kick_off { KickOffShot::Over } else { KickOffShot::InCircle };
    state.untouched = 0.0;
    state.last_touch = None;
    state.hold = None;
    state.pushes.clear();
    decisions.push(Decision::BallPlaced { at: Vec2::ZERO, reason: PlacementReason::KickOff });
    if !laws.book.removal_outlasts_play {
        returns::all(laws, observation, state, decisions);
    }
    match laws.book.kick_off {
        KickOffStyle::Carried => decisions.push(Decision::RobotsPlaced { kick_off: Some(state.kick_off) }),
        KickOffStyle::Walked if state.time_left == laws.book.half_seconds() => {
            by_hand::line_up(laws, observation, state, decisions);
        }
        KickOffStyle::Walked => {}
    }
    decisions.push(Decision::PhaseChanged(Phase::Ready));
}

#[cfg(test)]
mod tests {
    use crate::geometry::Attacking;
    use crate::ids::Team;
    use crate::world::referee::rules::table::{KICK_OFF_SECONDS, Table};

    use super::*;

    #[test]
    fn the_first_look_places_ball_and_robots_for_the_kick_off() {
        let mut table = Table::new(60);
        table.run(1.0 / 60.0);
        let first = [
            Decision::BallPlaced { at: Vec2::ZERO, reason: PlacementReason::KickOff },
            Decision::RobotsPlaced { kick_off: Some(Team::Home) },
            Decision::PhaseChanged(Phase::Ready),
        ];
        assert_eq!(table.decisions(), first);
    }

    #[test]
    fn ready_lasts_three_seconds_and_set_one() {
        let mut table = Table::new(60);
        table.run(5.0);
        let times = table.times(|d| matches!(d, Decision::PhaseChanged(_)));
        let expected = [1.0 / 60.0, 3.0, 4.0];
        assert!(times.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{times:?}");
    }

    #[test]
    fn the_clock_stands_still_until_play_begins() {
        let mut table = Table::new(60);
        table.run(3.9);
        assert_eq!(table.state.time_left, 600.0);
        table.run(1.1);
        assert!((table.state.time_left - 599.0).abs() < 1e-6);
    }

    #[test]
    fn one_long_sample_still_passes_through_ready_set_and_play() {
        let mut table = Table::new(60);
        table.look(0.0);
        table.look(7.0);
        assert_eq!(table.state.phase, Phase::Playing);
        assert!((table.state.time_left - 597.0).abs() < 1e-9);
    }

    #[test]
    fn at_half_time_ends_change_and_the_other_team_kicks_off() {
        let mut table = Table::new(60);
        table.book.half_minutes = 0.1;
        table.restart(Team::Home);
        table.run(KICK_OFF_SECONDS + 6.0);
        let state = &table.state;
        assert_eq!((state.half, state.phase, state.kick_off), (2, Phase::Ready, Team::Away));
        assert_eq!((state.time_left, state.home_attacks), (table.book.half_seconds(), Attacking::West));
        assert!(table.decisions().contains(&Decision::HalfEnded { half: 1 }));
    }

    #[test]
    fn the_team_that_opened_does_not_open_the_second_half_whoever_conceded_last() {
        let mut table = Table::new(60);
        table.book.half_minutes = 0.2;
        table.restart(Team::Away);
        table.run(KICK_OFF_SECONDS + 1.0);
        table.shoot_east();
        assert_eq!(table.state.kick_off, Team::Away);
        table.run(KICK_OFF_SECONDS + 12.0);
        assert_eq!((table.state.half, table.state.kick_off), (2, Team::Home));
    }

    #[test]
    fn after_the_second_half_nothing_is_decided_any_more() {
        let mut table = Table::new(60);
        table.book.half_minutes = 0.05;
        table.restart(Team::Home);
        table.run(2.0 * (KICK_OFF_SECONDS + 3.0) + 0.1);
        assert_eq!((table.state.phase, table.state.time_left), (Phase::Finished, 0.0));
        let end = [
            Decision::HalfEnded { half: 2 },
            Decision::PhaseChanged(Phase::Finished),
            Decision::MatchFinished { score: [0, 0] },
        ];
        assert!(table.decisions().ends_with(&end));
        let (count, state) = (table.log.len(), table.state.clone());
        table.shoot_east();
        table.run(100.0);
        assert_eq!(table.log.len(), count);
        assert_eq!(MatchState { seen_ball: None, ..table.state }, MatchState { seen_ball: None, ..state });
    }

    #[test]
    fn a_lead_of_ten_goals_ends_the_match_and_its_clock_stops() {
        let mut table = Table::four_legged_playing(60);
        (table.book.goal_from_kick_off, table.book.kick_off) = (true, KickOffStyle::Carried);
        table.restart_in_play();
        table.state.score = [9, 0];
        table.shoot_west();
        assert_eq!((table.state.score, table.state.phase), ([9, 1], Phase::Ready));
        for goals in [10, 11] {
            assert_eq!(table.state.score[0], goals - 1);
            table.run(table.kick_off_seconds() + 1.0);
            table.shoot_east();
        }
        assert_eq!((table.state.score, table.state.phase), ([11, 1], Phase::Finished));
        let end = [
            Decision::Goal { by: Team::Home, score: [11, 1] },
            Decision::PhaseChanged(Phase::Finished),
            Decision::MatchFinished { score: [11, 1] },
        ];
        assert!(table.decisions().ends_with(&end));
        let (left, count) = (table.state.time_left, table.log.len());
        table.run(60.0);
        assert_eq!((table.state.time_left, table.log.len()), (left, count));
        assert!(left > 500.0);
    }

    #[test]
    fn without_mercy_a_match_goes_on() {
        let mut table = Table::playing(60);
        table.state.score = [40, 0];
        table.shoot_east();
        assert_eq!((table.state.score, table.state.phase), ([41, 0], Phase::Ready));
    }
}
