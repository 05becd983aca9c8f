//! Whom a robot avoids, supports and gives way to.

use super::*;
use crate::comms::messages::{BallReport, HaveBall};
use crate::mind::teamwork::{BookingStatus, Carrier};
use crate::strategy::RoleRef;
use crate::strategy::language::CoverTask;
use crate::strategy::teamwork::{Mechanism, TeammatesBy};

fn role(index: u8) -> RoleRef {
    RoleRef { name: "mate".into(), index }
}

/// Robot 2 of four with roles 0 to 3, ranked in this order, that has heard robots 1 and 3 and sees a fourth.
fn ranked() -> Situation {
    let mut here = Situation::at(0.0, 0.0, 0.0)
        .with(Mechanism::TeammateAvoidance)
        .with(Mechanism::HierarchicalAvoidance)
        .mate(1, 1.0, 0.0)
        .mate(3, 0.0, 1.0)
        .robot(Home, -2.0, 0.0);
    here.teamwork.ranks = vec![0, 1, 2, 3];
    here.teamwork.teammates_by = TeammatesBy::Messages;
    here
}

#[test]
fn way_is_given_to_those_above_and_not_to_those_below() {
    let here = ranked();
    assert_eq!(places(&here, Points::Superiors), [v(1.0, 0.0)]);
    assert_eq!(places(&here, Points::Peers), []);
    assert_eq!(places(&here, Points::Teammates), [v(1.0, 0.0), v(0.0, 1.0)]);
}

#[test]
fn without_a_hierarchy_all_are_peers() {
    let mut here = ranked();
    here.teamwork.mechanisms = here.teamwork.mechanisms.without(Mechanism::HierarchicalAvoidance);
    assert_eq!(places(&here, Points::Superiors), []);
    assert_eq!(places(&here, Points::Peers), [v(1.0, 0.0), v(0.0, 1.0)]);
}

#[test]
fn nobody_is_avoided_when_avoidance_is_off() {
    let mut here = ranked();
    here.teamwork.mechanisms = here.teamwork.mechanisms.without(Mechanism::TeammateAvoidance);
    for points in [Points::Teammates, Points::Superiors, Points::Peers] {
        assert_eq!(places(&here, points), []);
    }
}

#[test]
fn a_team_mate_that_is_only_seen_counts_if_sight_does_and_then_among_the_superiors() {
    let mut here = ranked();
    here.teamwork.teammates_by = TeammatesBy::MessagesAndSight;
    assert_eq!(places(&here, Points::Superiors), [v(1.0, 0.0), v(-2.0, 0.0)]);
    here.teamwork.teammates_by = TeammatesBy::Sight;
    assert_eq!(places(&here, Points::Teammates), [v(-2.0, 0.0)]);
    assert_eq!(places(&here, Points::Superiors), [v(-2.0, 0.0)]);
}

#[test]
fn a_robot_seen_where_a_mate_says_it_is_is_that_mate() {
    let here = ranked().robot(Home, 1.3, 0.2);
    assert_eq!(here.model.strangers(Home).collect::<Vec<_>>(), [v(-2.0, 0.0)]);
}

#[test]
fn the_carrier_is_where_the_claimant_says_it_is() {
    let mut here = ranked();
    assert_eq!(places(&here, Points::Claimant), []);
    here.team_model.carrier = Some(Carrier::Known(3, 3));
    assert_eq!(places(&here, Points::Claimant), [v(0.0, 1.0)]);
    assert!(holds(&here, Feature::TeammateHasBall(vec![])));
    assert!(holds(&here, Feature::TeammateHasBall(vec![role(3)])));
    assert!(!holds(&here, Feature::TeammateHasBall(vec![role(1)])));
    assert!(!holds(&here, Feature::SuperiorHasBall), "the forward ranks below");
    here.team_model.carrier = Some(Carrier::Known(1, 1));
    assert!(holds(&here, Feature::SuperiorHasBall));
}

#[test]
fn a_carrier_that_is_only_seen_is_where_it_is_seen() {
    let mut here = ranked();
    here.team_model.carrier = Some(Carrier::Seen { at: v(-2.0, 0.0), is_goalie: false });
    assert_eq!(places(&here, Points::Claimant), [v(-2.0, 0.0)]);
    assert!(holds(&here, Feature::SuperiorHasBall), "it may rank above");
}

#[test]
fn support_is_behind_and_to_the_side_where_the_robot_is() {
    let mut here = Situation::at(0.0, 1.5, 0.0).mate(3, 1.0, 0.0);
    here.team_model.carrier = Some(Carrier::Known(3, 3));
    let spot = Point::SupportSpot { behind: 1.0, aside: 0.5 };
    assert_eq!(place(&here, spot.clone()), Some(v(0.0, 0.5)));
    here.model.pose.position.y = -1.5;
    assert_eq!(place(&here, spot), Some(v(0.0, -0.5)));
}

#[test]
fn support_changes_sides_at_a_wall() {
    let mut here = Situation::at(0.0, 2.3, 0.0).mate(3, 4.4, 2.0);
    here.team_model.carrier = Some(Carrier::Known(3, 3));
    let spot = place(&here, Point::SupportSpot { behind: 0.5, aside: 1.0 }).expect("the carrier is known");
    assert!(spot.y <= 2.1 && spot.x <= 4.1, "{spot}");
}

#[test]
fn a_role_is_where_the_robot_believed_to_have_it_says_it_is() {
    let mut here = ranked();
    assert_eq!(place(&here, Point::Teammate(role(3))), Some(v(0.0, 1.0)));
    here.team_model.claims.hear(1, &HaveBall { time: 1, robot: 1, have_ball: true, role: 3 }, 1);
    here.team_model.note_role(1, 3);
    assert_eq!(place(&here, Point::Teammate(role(3))), Some(v(1.0, 0.0)));
    assert_eq!(place(&here, Point::Teammate(role(1))), Some(v(0.0, 1.0)), "they have changed roles");
}

fn reported(here: &mut Situation, by: u8, place: Vec2) {
    let report = BallReport { time: 0, position: place, age: 0.0 };
    here.team_model.map.hear(by, &report, 0);
}

#[test]
fn without_fusion_the_robots_own_eyes_count_or_else_the_freshest_report() {
    let mut here = Situation::at(0.0, 0.0, 0.0);
    assert_eq!(place(&here, Point::TeamBall), None);
    reported(&mut here, 1, v(2.0, 0.0));
    assert_near(place(&here, Point::TeamBall), v(2.0, 0.0));
    let mut here = here.ball(1.0, 0.0);
    here.ball_age = Some(0.0);
    assert_near(place(&here, Point::TeamBall), v(1.0, 0.0));
}

#[test]
fn with_fusion_near_reporters_count_more_and_one_that_contradicts_does_not_count() {
    let mut here = Situation::at(0.0, 0.0, 0.0).mate(1, 1.9, 0.3).mate(3, -1.0, 0.0);
    here.teamwork.global_map.fused = true;
    reported(&mut here, 1, v(2.0, 0.3));
    reported(&mut here, 3, v(2.2, 0.3));
    let ball = place(&here, Point::TeamBall).expect("two have told");
    assert!(ball.x > 2.0 && ball.x < 2.1, "nearer to what the nearer one says: {ball}");
    reported(&mut here, 3, v(-1.5, -1.0));
    assert_near(place(&here, Point::TeamBall), v(2.0, 0.3));
    // What it sees itself now, close by, outweighs a report from elsewhere.
    let mut here = here.ball(0.4, 0.0);
    here.ball_age = Some(0.0);
    assert_near(place(&here, Point::TeamBall), v(0.4, 0.0));
}

/// Robot 2, whose role is no goalie's, with the goalie 0 and the mates 1 and 3 in the field.
fn covering() -> Situation {
    let mut here = Situation::at(-1.0, 1.0, 0.0).ball(2.0, 1.0);
    here.ball_age = Some(0.0);
    here.teamwork.goalie = Some(0);
    here.mate(0, -4.0, 0.0).mate(1, 1.5, 1.0).mate(3, 1.0, -1.0)
}

fn position(here: &Situation) -> Vec2 {
    let tasks = vec![CoverTask::ScreenGoal, CoverTask::ReceiveRebound, CoverTask::CoverSpace];
    place(here, Point::OptimalPosition(tasks)).expect("the ball is known")
}

#[test]
fn the_robot_screens_the_goal_while_a_mate_plays_and_another_is_farther_up() {
    let mut here = covering();
    // Half-way from the ball at (2, 1) to the goal at (-4.5, 0).
    assert!(position(&here).distance(v(-1.25, 0.5)) < 1e-4, "{}", position(&here));
    here.team_model.booking = BookingStatus::Mate(1);
    assert!(position(&here).distance(v(-1.25, 0.5)) < 1e-4, "{}", position(&here));
    // Without its mate it is the only one left, wherever it is.
    here.model.mates.retain(|mate| mate.number != 3);
    here.model.pose.position = v(3.0, -1.0);
    assert!(position(&here).distance(v(-1.25, 0.5)) < 1e-4, "{}", position(&here));
}

#[test]
fn who_has_booked_the_ball_needs_no_place_although_another_is_nearer() {
    let mut here = covering();
    here.team_model.booking = BookingStatus::Mate(3);
    // Mate 1 is left and nearer to the place for a rebound.
    assert!(position(&here).distance(v(-1.25, 0.5)) < 1e-4, "{}", position(&here));
    here.model.pose.position = v(2.5, -1.0);
    assert!(position(&here).x > 1.0, "{}", position(&here));
}

#[test]
fn a_place_needs_a_ball() {
    let mut here = covering();
    here.model.ball = None;
    assert_eq!(place(&here, Point::OptimalPosition(vec![CoverTask::ScreenGoal])), None);
}
