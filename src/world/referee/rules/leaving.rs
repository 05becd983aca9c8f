//! Leaving the field, where no walls keep robots in.

use crate::ids::RobotId;
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rules::observation::{Laws, Observation, send_off};
use crate::world::referee::state::MatchState;

/// Takes robots off whose centre is too far beyond the lines. A robot may follow the ball over a line.
pub(super) fn leaving(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Some(beyond) = laws.book.leaving else { return };
    if state.phase != Phase::Playing {
        return;
    }
    let seen = observation.on_field(state).filter(|(_, at)| at.is_finite());
    let gone: Vec<RobotId> =
        seen.filter(|(_, at)| !laws.pitch.holds(*at, beyond)).map(|(robot, _)| robot).collect();
    for robot in gone {
        send_off(state, decisions, robot, f64::from(laws.book.removal_seconds), RemovalReason::LeftTheField);
    }
}

#[cfg(test)]
mod tests {
    use bevy::prelude::Vec2;

    use crate::ids::Team;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const AWAY_1: RobotId = RobotId::new(Team::Away, 1);

    #[test]
    fn a_robot_may_be_a_little_beyond_every_line_and_leaves_farther_out() {
        let ways = [Vec2::X, Vec2::NEG_X, Vec2::Y, Vec2::NEG_Y];
        for (hertz, way) in [20, 60, 240].into_iter().flat_map(|hertz| ways.map(|way| (hertz, way))) {
            let mut table = Table::four_legged_playing(hertz);
            let line = Vec2::new(2.7, 2.0).dot(way.abs());
            // Beside the goals, where there are end lines.
            let beside = Vec2::new(0.0, 1.5 * way.x.abs());
            table.put(AWAY_1, beside + way * (line + 0.29));
            table.run(2.0);
            assert_eq!(table.removals(RemovalReason::LeftTheField), [], "{way}");
            table.put(AWAY_1, beside + way * (line + 0.31));
            table.run(1.0 / f64::from(hertz));
            assert_eq!(table.removals(RemovalReason::LeftTheField), [AWAY_1], "{way}");
            assert_eq!(table.state.removed[0].seconds_left, 30.0);
        }
    }

    #[test]
    fn nobody_leaves_where_there_are_walls_or_before_the_ball_is_in_play() {
        let mut table = Table::playing(60);
        table.put(AWAY_1, Vec2::new(0.0, 9.0));
        table.run(1.0);
        assert!(table.state.removed.is_empty());
        let mut table = Table::four_legged(60);
        table.run(1.0);
        table.put(AWAY_1, Vec2::new(0.0, 9.0));
        table.run(2.0);
        assert!(table.state.removed.is_empty());
    }
}
