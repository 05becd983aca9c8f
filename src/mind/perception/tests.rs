//! Every word of the strategy language that stands for a point, a set or a statement, with its boundaries.

use super::*;
use crate::ids::Team::{Away, Home};
use crate::mind::perception::fixture::Situation;
use crate::strategy::language::Feature::{
    self, After, All, Always, Any, BallInScoop, BallSeenWithin, BehindBall, Bumped, Facing, HoldFor, In,
    Known, Lasting, Near, NearLatch, NearerThan, Not, Stalled, Watchdog,
};
use crate::strategy::language::Point::{
    self, At, Average, Ball, BallIn, Closest, Homebase, Intercept, Into, Midpoint, Moved, OurGoal, Own,
    SweetSpot, TheirGoal, Toward,
};
use crate::strategy::language::Points::{
    self, FartherThan, Opponents, Remember, Shifted, Teammates, These, Union, Walls, Within, WithinOrClosest,
};
use crate::strategy::language::ZoneName;

fn v(x: f32, y: f32) -> Vec2 {
    Vec2::new(x, y)
}

fn at(x: f32, y: f32) -> Point {
    At(v(x, y))
}

fn place(situation: &Situation, point: Point) -> Option<Vec2> {
    situation.senses().point(&point, &mut Memory::new(1))
}

fn places(situation: &Situation, points: Points) -> Vec<Vec2> {
    situation.senses().points(&points, &mut Memory::new(1)).to_vec()
}

fn holds(situation: &Situation, feature: Feature) -> bool {
    situation.senses().holds(&feature, &mut Memory::new(1))
}

#[track_caller]
fn assert_near(got: Option<Vec2>, want: Vec2) {
    assert!(got.is_some_and(|got| got.distance(want) < 1e-5), "got {got:?}, want {want}");
}

/// Somewhere, looking nowhere in particular, with the ball and two robots of each team.
fn busy() -> Situation {
    let here = Situation::at(-1.0, 0.5, 30.0).ball(1.0, 0.5);
    here.robot(Home, 0.0, 0.5).robot(Away, 2.0, 2.0).robot(Home, -3.0, 0.5).robot(Away, 2.0, -1.0)
}

#[test]
fn fixed_points_are_where_the_pitch_and_the_robot_have_them() {
    let here = busy();
    assert_near(place(&here, OurGoal), v(-4.5, 0.0));
    assert_near(place(&here, TheirGoal), v(4.5, 0.0));
    assert_near(place(&here, Homebase), Situation::HOMEBASE);
    assert_near(place(&here, Own), v(-1.0, 0.5));
    assert_near(place(&here, at(7.0, -8.0)), v(7.0, -8.0));
}

#[test]
fn the_ball_is_where_it_is_believed_and_nowhere_while_unknown() {
    assert_near(place(&busy(), Ball), v(1.0, 0.5));
    let blind = Situation::at(0.0, 0.0, 0.0);
    for point in [Ball, BallIn(0.0), Intercept { max_speed: 1.0 }] {
        assert_eq!(place(&blind, point), None);
    }
}

#[test]
fn a_rolling_ball_is_foretold_until_it_lies_still() {
    let rolling = Situation::at(0.0, 0.0, 0.0).rolling_ball(1.0, 1.0, v(0.0, -0.6));
    assert_near(place(&rolling, BallIn(0.0)), v(1.0, 1.0));
    assert_near(place(&rolling, BallIn(1.0)), v(1.0, 1.0 - 0.45));
    assert_near(place(&rolling, BallIn(60.0)), v(1.0, 1.0 - 0.6));
}

#[test]
fn what_a_robot_sees_as_a_vector_is_relative_to_it_on_the_team_frames_axes() {
    let offset = busy().senses().relative(&at(1.0, 2.0), &mut Memory::new(0));
    assert_eq!(offset, Some(v(2.0, 1.5)));
}

#[test]
fn the_closest_of_a_set_is_closest_to_the_robot_and_not_to_the_origin() {
    let set = || These(vec![at(0.0, 0.0), at(-1.2, 1.0), at(5.0, 0.0)]);
    assert_near(place(&busy(), Closest(Box::new(set()))), v(-1.2, 1.0));
    assert_eq!(place(&busy(), Closest(Box::new(These(vec![])))), None);
}

#[test]
fn averages_and_midpoints_need_something_to_average() {
    let blind = Situation::at(0.0, 0.0, 0.0);
    let set = These(vec![at(1.0, 1.0), Ball, at(3.0, -3.0)]);
    assert_near(place(&blind, Average(Box::new(set))), v(2.0, -1.0));
    assert_eq!(place(&blind, Average(Box::new(Opponents))), None);
    assert_near(place(&blind, Midpoint(Box::new(at(1.0, 1.0)), Box::new(at(3.0, -3.0)))), v(2.0, -1.0));
    assert_eq!(place(&blind, Midpoint(Box::new(Own), Box::new(Ball))), None);
    assert_eq!(place(&blind, Midpoint(Box::new(Ball), Box::new(Own))), None);
}

#[test]
fn a_moved_point_goes_the_way_from_one_point_to_the_other() {
    let moved = |of, from, to| Moved { of: Box::new(of), from: Box::new(from), to: Box::new(to) };
    assert_near(place(&busy(), moved(at(1.0, 1.0), Own, Ball)), v(3.0, 1.0));
    let blind = Situation::at(0.0, 0.0, 0.0);
    for unknown in [moved(Ball, Own, Own), moved(Own, Ball, Own), moved(Own, Own, Ball)] {
        assert_eq!(place(&blind, unknown), None);
    }
}

#[test]
fn toward_goes_so_many_metres_on_the_way_or_away_from_it() {
    let toward = |to, distance| Toward { from: Box::new(at(1.0, 1.0)), to: Box::new(to), distance };
    let here = busy();
    assert_near(place(&here, toward(at(4.0, 5.0), 2.5)), v(2.5, 3.0));
    assert_near(place(&here, toward(at(4.0, 5.0), -5.0)), v(-2.0, -3.0));
    assert_near(place(&here, toward(at(4.0, 5.0), 10.0)), v(7.0, 9.0));
    assert_near(place(&here, toward(at(1.0, 1.0), 2.0)), v(1.0, 1.0));
    assert_eq!(place(&Situation::at(0.0, 0.0, 0.0), toward(Ball, 1.0)), None);
}

#[test]
fn the_sweet_spot_is_behind_the_ball_as_seen_from_where_it_shall_go() {
    let spot = |of, toward| SweetSpot { of: Box::new(of), toward: Box::new(toward), offset: 0.5 };
    assert_near(place(&busy(), spot(at(1.5, 4.0), at(4.5, 0.0))), v(1.2, 4.4));
    assert_near(place(&busy(), spot(Ball, Ball)), v(1.0, 0.5));
    assert_eq!(place(&Situation::at(0.0, 0.0, 0.0), spot(Ball, TheirGoal)), None);
}

#[test]
fn a_robot_meets_a_rolling_ball_where_both_are_at_the_same_time() {
    let crossing = Situation::at(-1.0, 2.0, 0.0).rolling_ball(3.0, 2.0, v(0.0, -0.6));
    let meeting = place(&crossing, Intercept { max_speed: 1.0 }).expect("the ball is slower");
    let seconds = meeting.distance(v(-1.0, 2.0));
    assert!(meeting.distance(v(3.0, 2.0 - 0.6 * seconds)) < 1e-4, "{meeting}");
    assert_near(place(&crossing, Intercept { max_speed: 0.0 }), v(3.0, 2.0));
}

#[test]
fn a_point_is_brought_into_a_zone_by_the_shortest_way() {
    let into = |zone, x, y| place(&busy(), Into { zone, point: Box::new(at(x, y)) });
    assert_near(into(ZoneName::DangerZone, 3.0, 0.2), v(0.5, 0.2));
    assert_near(into(ZoneName::DangerZone, -9.0, 9.0), v(-2.0, 1.0));
    assert_near(into(ZoneName::DangerZone, 0.1, 0.2), v(0.1, 0.2));
    assert_near(into(ZoneName::PenaltyArea, 0.0, 0.0), v(-3.5, 0.0));
    assert_near(into(ZoneName::Exactly(Zone { min: v(1.0, 1.0), max: v(2.0, 2.0) }), 0.0, 1.5), v(1.0, 1.5));
    assert_eq!(
        place(&Situation::at(0.0, 0.0, 0.0), Into { zone: ZoneName::PenaltyArea, point: Box::new(Ball) }),
        None
    );
}

#[test]
fn teammates_and_opponents_depend_on_the_robots_own_team() {
    let here = busy();
    assert_eq!(places(&here, Teammates), [v(0.0, 0.5), v(-3.0, 0.5)]);
    assert_eq!(places(&here, Opponents), [v(2.0, 2.0), v(2.0, -1.0)]);
    let other = Perception { team: Away, ..here.senses() };
    assert_eq!(other.points(&Teammates, &mut Memory::new(0)).to_vec(), [v(2.0, 2.0), v(2.0, -1.0)]);
}

#[test]
fn the_walls_are_four_points_abreast_of_the_robot() {
    let walls = places(&Situation::at(-1.0, 2.0, 0.0), Walls);
    assert_eq!(walls, [v(4.5, 2.0), v(-4.5, 2.0), v(-1.0, 2.5), v(-1.0, -2.5)]);
}

#[test]
fn a_robot_that_believes_itself_beyond_a_wall_still_has_it_on_the_outer_side() {
    for (x, y) in [(4.7, 0.0), (-4.7, 0.0), (0.0, 2.8), (0.0, -2.8), (4.5, 2.5)] {
        let walls = places(&Situation::at(x, y, 0.0), Walls);
        assert!(walls[0].x > x && walls[1].x < x && walls[2].y > y && walls[3].y < y, "{walls:?}");
    }
}

#[test]
fn a_union_has_the_known_members_of_all_its_sets_in_order() {
    let set = || Union(vec![These(vec![at(9.0, 9.0), Ball]), Teammates, These(vec![])]);
    assert_eq!(places(&busy(), set()), [v(9.0, 9.0), v(1.0, 0.5), v(0.0, 0.5), v(-3.0, 0.5)]);
    assert_eq!(places(&Situation::at(0.0, 0.0, 0.0), set()), [v(9.0, 9.0)]);
}

#[test]
fn within_counts_from_the_robot_and_includes_the_edge() {
    let of = || Box::new(These(vec![at(0.0, 0.5), at(-1.0, -1.0), at(-3.0, 0.5)]));
    let here = busy();
    assert_eq!(places(&here, Within { of: of(), radius: 1.0 }), [v(0.0, 0.5)]);
    assert_eq!(places(&here, Within { of: of(), radius: 0.99 }), []);
    assert_eq!(places(&here, WithinOrClosest { of: of(), radius: 0.99 }), [v(0.0, 0.5)]);
    assert_eq!(places(&here, WithinOrClosest { of: of(), radius: 1.5 }), [v(0.0, 0.5), v(-1.0, -1.0)]);
    assert_eq!(places(&here, WithinOrClosest { of: Box::new(These(vec![])), radius: 1.0 }), []);
}

#[test]
fn farther_than_leaves_out_the_edge_and_keeps_all_while_its_centre_is_unknown() {
    let set = |from| FartherThan { of: Box::new(These(vec![at(2.0, 0.5), at(2.1, 0.5)])), from, radius: 1.0 };
    assert_eq!(places(&busy(), set(Box::new(Ball))), [v(2.1, 0.5)]);
    let blind = Situation::at(0.0, 0.0, 0.0);
    assert_eq!(places(&blind, set(Box::new(Ball))), [v(2.0, 0.5), v(2.1, 0.5)]);
}

#[test]
fn a_shifted_set_is_moved_along_the_team_frames_axes() {
    assert_eq!(
        places(&busy(), Shifted { of: Box::new(Opponents), by: v(-1.0, 0.5) }),
        [v(1.0, 2.5), v(1.0, -0.5)]
    );
}

#[test]
fn a_remembered_place_stays_on_the_field_while_the_robot_moves_and_fades_with_time() {
    let set = Remember { of: Box::new(Opponents), seconds: 2.0, merge: 0.3, blend: 0.5, slot: 0 };
    let mut memory = Memory::new(1);
    let mut seen = |x: f32, now: f32, opponent: Option<Vec2>| {
        let mut here = Situation::at(x, 0.0, 0.0);
        here.now = now;
        let here = opponent
            .map(|p| here.robot(Away, p.x, p.y))
            .unwrap_or_else(|| Situation { now, ..Situation::at(x, 0.0, 0.0) });
        here.senses().points(&set, &mut memory).to_vec()
    };
    assert_eq!(seen(0.0, 1.0, Some(v(2.0, 1.0))), [v(2.0, 1.0)]);
    assert_eq!(seen(3.0, 2.0, None), [v(2.0, 1.0)]);
    assert_eq!(seen(3.0, 2.5, Some(v(2.0, 1.25))), [v(2.0, 1.125)]);
    assert_eq!(seen(3.0, 3.0, Some(v(-2.0, 1.0))), [v(2.0, 1.125), v(-2.0, 1.0)]);
    assert_eq!(seen(3.0, 4.5, None), [v(2.0, 1.125), v(-2.0, 1.0)]);
    assert_eq!(seen(3.0, 4.6, None), [v(-2.0, 1.0)]);
    assert_eq!(seen(3.0, 5.1, None), []);
}

mod features;
mod teammates;
