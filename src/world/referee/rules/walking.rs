//! Kick-offs to which robots walk, by the rules of the four-legged league.
//!
//! All stand in their own halves: the goalkeeper in its penalty area, the others out of it and in the rear half of their
//! own half. One robot of the team that kicks off may stand farther in front, outside of the centre circle. What counts
//! is a robot's centre.

use bevy::prelude::Vec2;

use crate::ids::RobotId;
use crate::world::referee::decision::Decision;
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{KickOffStyle, RuleBook};
use crate::world::referee::rules::observation::{Laws, Observation, is_in_own_area, is_over};
use crate::world::referee::state::MatchState;

/// Seconds for which all have to stand before the referee believes it. ASSUMPTION.
const SETTLED: f32 = 1.0;

/// Ends the time to walk when all robots stand legally and still.
pub(super) fn walking(
    laws: &Laws,
    observation: &Observation,
    dt: f64,
    state: &mut MatchState,
    _: &mut Vec<Decision>,
) {
    if laws.book.kick_off != KickOffStyle::Walked || state.phase != Phase::Ready {
        return;
    }
    let stands = |(robot, _)| observation.still.contains(&robot);
    let settled = observation.on_field(state).all(stands) && misplaced(laws, observation, state).is_empty();
    state.settled = settled.then(|| state.settled.map_or(0.0, |seconds| seconds + dt));
    if let Some(seconds) = state.settled.filter(|seconds| is_over(*seconds, SETTLED)) {
        // `phases` adds this sample's seconds.
        let over = f64::from(laws.book.ready_seconds) + (seconds - f64::from(SETTLED)).max(0.0);
        state.waited = state.waited.max(over - dt);
    }
}

/// The robots that stand wrongly for the kick-off, by id.
pub(super) fn misplaced(laws: &Laws, observation: &Observation, state: &MatchState) -> Vec<RobotId> {
    let in_front =
        observation.on_field(state).filter(|(robot, at)| is_kickers_place(laws, state, *robot, *at));
    let kicker = in_front.min_by(|(_, a), (_, b)| a.length().total_cmp(&b.length())).map(|(robot, _)| robot);
    let is_misplaced = |(robot, at): &(RobotId, Vec2)| {
        let at_home = is_in_own_area(laws, state, *robot, *at);
        let ahead = state.attacking(robot.team).turn(*at);
        let legal = if robot.number == RuleBook::KEEPER {
            at_home
        } else {
            let behind = laws.pitch.holds(ahead, 0.0) && ahead.x <= -laws.pitch.length / 4.0 && !at_home;
            behind || kicker == Some(*robot)
        };
        !legal
    };
    observation.on_field(state).filter(is_misplaced).map(|(robot, _)| robot).collect()
}

/// Whether a robot is where only the robot that kicks off may be.
pub(super) fn is_kickers_place(laws: &Laws, state: &MatchState, robot: RobotId, at: Vec2) -> bool {
    let ahead = state.attacking(robot.team).turn(at);
    state.kicks_off(robot.team)
        && robot.number != RuleBook::KEEPER
        && laws.pitch.holds(ahead, 0.0)
        && ahead.x > -laws.pitch.length / 4.0
        && ahead.x < 0.0
        && ahead.length() >= laws.pitch.centre_circle_radius
}

#[cfg(test)]
mod tests {
    use crate::ids::Team;
    use crate::world::referee::rules::table::Table;
    use crate::world::referee::rules::table::four_legged_line_up;

    use super::*;

    const HOME_2: RobotId = RobotId::new(Team::Home, 2);
    const HOME_3: RobotId = RobotId::new(Team::Home, 3);
    const AWAY_3: RobotId = RobotId::new(Team::Away, 3);

    #[test]
    fn robots_walk_for_thirty_seconds_at_most() {
        for hertz in [20, 60, 240] {
            let sample = 1.0 / f64::from(hertz);
            let mut table = Table::walked(hertz);
            table.run(28.0 - sample);
            assert_eq!(table.state.phase, Phase::Ready);
            table.run(2.0 * sample);
            assert_eq!((table.state.phase, table.placed_by_hand()), (Phase::Set, vec![]));
        }
    }

    #[test]
    fn play_goes_on_when_all_have_stood_for_a_second() {
        for hertz in [20, 60, 240] {
            let sample = 1.0 / f64::from(hertz);
            let mut table = Table::walked(hertz);
            table.all_stand_still();
            table.run(1.0);
            assert_eq!(table.state.phase, Phase::Ready);
            table.run(sample);
            assert_eq!(table.state.phase, Phase::Set);
            table.run(1.0 - sample);
            assert_eq!(table.state.phase, Phase::Set);
            table.run(2.0 * sample);
            assert_eq!((table.state.phase, table.placed_by_hand()), (Phase::Playing, vec![]));
        }
    }

    #[test]
    fn one_that_moves_or_stands_wrongly_keeps_them_waiting() {
        let mut table = Table::walked(60);
        table.all_stand_still();
        table.still.pop();
        table.run(5.0);
        assert_eq!(table.state.phase, Phase::Ready);
        table.all_stand_still();
        table.put(AWAY_3, Vec2::new(1.0, 0.0));
        table.run(5.0);
        assert_eq!(table.state.phase, Phase::Ready, "only the team that kicks off may be in front");
        table.put(AWAY_3, Vec2::new(1.4, 0.0));
        table.run(1.1);
        assert_eq!(table.state.phase, Phase::Set);
    }

    #[test]
    fn one_robot_of_the_team_that_kicks_off_may_stand_in_front_and_the_nearest_does() {
        let mut table = Table::walked(60);
        table.put(HOME_3, Vec2::new(-0.2, 0.0));
        table.put(HOME_2, Vec2::new(-1.0, -0.5));
        table.run(28.1);
        assert_eq!(table.placed_by_hand(), [HOME_2]);
        assert_eq!(table.place(HOME_3), Vec2::new(-0.2, 0.0));
    }

    #[test]
    fn every_kick_off_waits_for_its_own_second() {
        let mut table = Table::walked(60);
        table.all_stand_still();
        table.run(2.1);
        table.shoot_west();
        table.run(1.0);
        assert_eq!(table.state.phase, Phase::Ready);
        table.run(0.1);
        assert_eq!(table.state.phase, Phase::Set);
    }

    #[test]
    fn after_a_goal_robots_walk_from_where_they_are() {
        let mut table = Table::four_legged_playing(60);
        table.shoot_west();
        table.run(0.1);
        assert_eq!(table.robots, four_legged_line_up());
        assert!(table.decisions().ends_with(&[Decision::PhaseChanged(Phase::Ready)]));
    }
}
