//! The hands of people at kick-offs to which robots walk: where a half begins, and for those that stand wrongly in the end.

use bevy::prelude::Vec2;

use super::returns;
use super::walking::{is_kickers_place, misplaced};
use crate::geometry::{Attacking, Pose};
use crate::ids::RobotId;
use crate::world::referee::decision::{Decision, PlacementReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{KickOffStyle, ReturnPlace, RuleBook};
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::MatchState;

/// Metres by which the ball may be off the centre spot at a kick-off. ASSUMPTION.
const ON_SPOT: f32 = 0.01;

/// When the robots have to stand still, puts those that stand wrongly on the places that the rules have for them, and the
/// ball on its spot if somebody has moved it.
pub(super) fn places_by_hand(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let set = decisions.contains(&Decision::PhaseChanged(Phase::Set));
    if laws.book.kick_off != KickOffStyle::Walked || !set {
        return;
    }
    if observation.ball.distance(Vec2::ZERO) > ON_SPOT || !observation.ball.is_finite() {
        decisions.push(Decision::BallPlaced { at: Vec2::ZERO, reason: PlacementReason::KickOff });
    }
    let misplaced = misplaced(laws, observation, state);
    let rightly = observation.on_field(state).filter(|(robot, _)| !misplaced.contains(robot));
    let mut taken: Vec<Vec2> = rightly.map(|(_, at)| at).collect();
    let kicker_stands = observation
        .on_field(state)
        .any(|(robot, at)| !misplaced.contains(&robot) && is_kickers_place(laws, state, robot, at));
    let mut kicker_is_due = !kicker_stands;
    for robot in misplaced {
        let kicks = kicker_is_due && state.kicks_off(robot.team) && robot.number != RuleBook::KEEPER;
        kicker_is_due &= !kicks;
        let at = place_by_hand(laws, state, robot, kicks, &taken);
        taken.push(at.position);
        decisions.push(Decision::RobotPlaced { robot, at });
    }
}

/// Puts all robots on the side lines of their own halves, from where they walk to their places.
pub(super) fn line_up(
    laws: &Laws,
    observation: &Observation,
    state: &MatchState,
    decisions: &mut Vec<Decision>,
) {
    let returned = |decision: &Decision| match decision {
        Decision::RobotReturned { robot, at } => Some((*robot, at.position)),
        _ => None,
    };
    let returned: Vec<(RobotId, Vec2)> = decisions.iter().filter_map(returned).collect();
    let mut taken: Vec<Vec2> = returned.iter().map(|(_, at)| *at).collect();
    for (robot, _) in observation.on_field(state) {
        let attacks = state.attacking(robot.team);
        let is_placed = returned.iter().any(|(other, _)| *other == robot);
        if is_placed {
            continue;
        }
        let beside = |taken: &[Vec2]| {
            returns::place_at_side_line(laws, ReturnPlace::OwnHalf, Vec2::ZERO, attacks, taken)
        };
        // Where the side lines are full, it is put down next to another.
        let at = beside(&taken).or_else(|| beside(&[])).unwrap_or_else(|| in_own_half(laws, attacks));
        taken.push(at.position);
        decisions.push(Decision::RobotPlaced { robot, at });
    }
}

fn in_own_half(laws: &Laws, attacks: Attacking) -> Pose {
    attacks.turn_pose(Pose::new(-laws.pitch.half_size().x / 2.0, 0.0, 0.0))
}

/// Where people put a robot that stands wrongly, all worse places than it might have walked to: the robot that kicks off
/// half a metre behind the circle, the goalkeeper into its area, one opponent in front of a corner of its area, and
/// others beside it. If all are taken, farther out along the end line.
fn place_by_hand(laws: &Laws, state: &MatchState, robot: RobotId, kicks: bool, taken: &[Vec2]) -> Pose {
    let (half, room) = (laws.pitch.half_size(), laws.book.spot_clearance);
    let area = laws.pitch.own_penalty_area();
    let attacks = state.attacking(robot.team);
    let middle = (area.min.x + area.max.x) / 2.0;
    let kicker = Vec2::new(-(laws.pitch.centre_circle_radius + 0.5), 0.0);
    let keeper = Vec2::new(middle, 0.0);
    let corner = Vec2::new(area.max.x + room, area.max.y);
    let rows = (0..ROWS).map(|row| area.max.y + room * f32::from(2 * row + 1));
    let beside = rows.flat_map(|y| [Vec2::new(middle, y), Vec2::new(middle, -y)]);
    let is_free = |place: &Vec2| {
        let at = attacks.turn(*place);
        place.y.abs() < half.y && taken.iter().all(|other| other.distance(at) >= 2.0 * room)
    };
    let mut places: Vec<Vec2> = match (robot.number == RuleBook::KEEPER, kicks) {
        (true, _) => vec![keeper],
        (false, true) => vec![kicker],
        (false, false) if !state.kicks_off(robot.team) => vec![corner],
        _ => vec![],
    };
    let first = places.first().copied().unwrap_or(corner);
    if robot.number != RuleBook::KEEPER {
        places.extend(beside);
    }
    let place = places.into_iter().find(is_free).unwrap_or(first);
    attacks.turn_pose(Pose { position: place, heading: 0.0 })
}

/// Rows of places on each side of a penalty area.
const ROWS: u8 = 4;

#[cfg(test)]
mod tests {
    use crate::ids::Team;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_2: RobotId = RobotId::new(Team::Home, 2);
    const HOME_3: RobotId = RobotId::new(Team::Home, 3);
    const AWAY_3: RobotId = RobotId::new(Team::Away, 3);

    #[test]
    fn a_half_begins_with_all_robots_at_the_side_lines_of_their_halves() {
        let mut table = Table::four_legged(60);
        table.book.half_minutes = 0.1;
        table.restart(Team::Home);
        for half in 1..=2 {
            table.run(1.0 / 60.0);
            while table.state.half < half {
                table.run(1.0 / 60.0);
            }
            for (robot, at) in &table.robots {
                assert!(
                    table.state.attacking(robot.team).turn(*at).x < 0.0 && at.y.abs() == 1.8,
                    "{robot}: {at}"
                );
                let apart = |(other, there): &(RobotId, Vec2)| other == robot || there.distance(*at) >= 0.399;
                assert!(table.robots.iter().all(apart));
            }
        }
        let all_at_once = table.times(|d| matches!(d, Decision::RobotsPlaced { .. }));
        assert!(all_at_once.is_empty());
    }

    #[test]
    fn a_half_begins_with_all_robots_on_the_pitch_however_much_room_the_book_wants() {
        for room in [1.0, 5.0] {
            let mut table = Table::four_legged(60);
            table.book.spot_clearance = room;
            table.restart(Team::Home);
            table.run(1.0 / 60.0);
            let placed = table.times(|d| matches!(d, Decision::RobotPlaced { .. }));
            assert_eq!(placed.len(), table.robots.len(), "{room} m");
        }
    }

    #[test]
    fn whoever_stands_wrongly_is_put_on_a_place_of_the_rules() {
        for ends in [Attacking::East, Attacking::West] {
            let mut table = Table::walked(60);
            table.state.home_attacks = ends;
            table.robots.iter_mut().for_each(|(_, at)| *at = ends.turn(*at));
            // In the circle, in the own area, away from the goal, and in the other half. A teammate of the last one
            // stands where it would be put otherwise.
            table.put(HOME_3, ends.turn(Vec2::new(-0.1, 0.0)));
            table.put(HOME_2, ends.turn(Vec2::new(-2.3, 0.4)));
            table.put(HOME_0, ends.turn(Vec2::new(-1.6, 0.0)));
            table.put(AWAY_3, ends.turn(Vec2::new(-1.5, 1.0)));
            table.run(28.1);
            assert_eq!(table.placed_by_hand(), [HOME_0, HOME_2, HOME_3, AWAY_3]);
            let at = [HOME_0, HOME_2, HOME_3, AWAY_3].map(|robot| ends.turn(table.place(robot)));
            let places = [(-2.375, 0.0), (-0.68, 0.0), (-2.375, 0.85), (2.375, -0.85)];
            for (at, (x, y)) in at.into_iter().zip(places) {
                assert!(at.distance(Vec2::new(x, y)) < 1e-4, "{at} for {x}, {y}");
            }
        }
    }

    #[test]
    fn all_places_by_hand_are_legal_and_apart() {
        let mut table = Table::walked(60);
        table.robots.iter_mut().for_each(|(_, at)| *at = Vec2::ZERO);
        table.run(28.05);
        assert_eq!(table.placed_by_hand().len(), 8);
        let observation = Observation::of(Vec2::ZERO, &table.robots);
        let laws = Laws { pitch: &table.pitch, book: &table.book, ball_radius: 0.045 };
        assert_eq!(misplaced(&laws, &observation, &table.state), []);
        for (robot, at) in &table.robots {
            let apart = |(other, there): &(RobotId, Vec2)| other == robot || there.distance(*at) >= 0.39;
            assert!(table.robots.iter().all(apart), "{robot}");
        }
    }

    #[test]
    fn a_ball_that_was_moved_comes_back_to_its_spot() {
        let mut table = Table::walked(60);
        table.ball = Vec2::new(2.9, 0.0);
        table.run(30.0);
        assert_eq!((table.ball, table.state.score), (Vec2::ZERO, [0, 0]));
    }
}
