//! The statements.

use super::*;
use crate::protocol::arbitration::PlayerAction;
use crate::strategy::language::Feature::{MayExecute, MessagesLeftBelow};

const BLIND: fn() -> Situation = || Situation::at(0.0, 0.0, 0.0);

#[test]
fn statements_combine_as_in_logic() {
    let (yes, no) = (|| Always, || Not(Box::new(Always)));
    let here = BLIND();
    assert!(holds(&here, yes()) && !holds(&here, no()));
    for (a, b, all, any) in [
        (yes(), yes(), true, true),
        (yes(), no(), false, true),
        (no(), yes(), false, true),
        (no(), no(), false, false),
    ] {
        assert_eq!(holds(&here, All(vec![a.clone(), b.clone()])), all);
        assert_eq!(holds(&here, Any(vec![a, b])), any);
    }
    assert!(holds(&here, All(vec![])) && !holds(&here, Any(vec![])));
}

#[test]
fn every_part_of_a_statement_is_asked_so_that_its_memory_goes_on() {
    let lasting = |slot| Lasting { what: Box::new(Always), seconds: 1.0, slot };
    let settled =
        All(vec![All(vec![Not(Box::new(Always)), lasting(0)]), Not(Box::new(Any(vec![Always, lasting(1)])))]);
    let mut memory = Memory::new(2);
    assert!(!BLIND().senses().holds(&settled, &mut memory));
    let later = Situation { now: 1.0, ..BLIND() };
    for slot in [0, 1] {
        assert!(later.senses().holds(&lasting(slot), &mut memory), "part {slot} was not asked");
    }
}

#[test]
fn a_point_is_known_or_not() {
    assert!(holds(&busy(), Known(Ball)) && !holds(&BLIND(), Known(Ball)));
    assert!(holds(&BLIND(), Known(Own)));
    assert!(!holds(&BLIND(), Known(Closest(Box::new(Opponents)))));
}

#[test]
fn a_ball_counts_as_seen_lately_up_to_the_age_that_is_asked() {
    let aged = |ball_age| Situation { ball_age, ..busy() };
    assert!(holds(&aged(Some(0.5)), BallSeenWithin(0.5)));
    assert!(!holds(&aged(Some(0.51)), BallSeenWithin(0.5)));
    assert!(!holds(&aged(None), BallSeenWithin(1e9)));
}

#[test]
fn near_leaves_out_the_edge_and_what_is_unknown() {
    let near = |b, radius| Near { a: Own, b, radius };
    assert!(holds(&busy(), near(Ball, 2.01)) && !holds(&busy(), near(Ball, 2.0)));
    assert!(!holds(&BLIND(), near(Ball, 1e9)) && !holds(&BLIND(), Near { a: Ball, b: Own, radius: 1e9 }));
}

#[test]
fn a_near_latch_opens_only_beyond_its_outer_edge_or_when_the_point_is_lost() {
    let latch = NearLatch { a: Own, b: Ball, enter: 1.0, leave: 2.0, slot: 0 };
    let mut memory = Memory::new(1);
    let mut at = |x: Option<f32>| {
        let here = x.map_or_else(BLIND, |x| BLIND().ball(x, 0.0));
        here.senses().holds(&latch, &mut memory)
    };
    let steps =
        [(Some(1.5), false), (Some(0.9), true), (Some(2.0), true), (Some(2.1), false), (Some(1.5), false)];
    for (x, want) in steps.into_iter().chain([(Some(0.5), true), (None, false), (Some(1.5), false)]) {
        assert_eq!(at(x), want, "ball at {x:?}");
    }
}

#[test]
fn a_known_point_is_nearer_than_an_unknown_one_and_never_the_other_way_round() {
    let nearer = |a, b| NearerThan { a, b };
    let here = busy();
    assert!(
        holds(&here, nearer(at(0.0, 0.5), at(0.0, 0.6))) && !holds(&here, nearer(at(0.0, 0.6), at(0.0, 0.5)))
    );
    assert!(!holds(&here, nearer(Ball, Ball)), "the same place is not nearer");
    assert!(holds(&BLIND(), nearer(at(1e6, 0.0), Ball)));
    assert!(!holds(&BLIND(), nearer(Ball, Own)) && !holds(&BLIND(), nearer(Ball, Ball)));
}

#[test]
fn a_zone_includes_its_edge_and_no_unknown_point() {
    let inside = |point| In { zone: ZoneName::DangerZone, point };
    assert!(holds(&busy(), inside(at(0.5, 1.0))) && holds(&busy(), inside(at(-2.0, -1.0))));
    assert!(!holds(&busy(), inside(at(0.51, 0.0))) && !holds(&busy(), inside(at(0.0, -1.01))));
    assert!(!holds(&BLIND(), inside(Ball)));
    let penalty = |x, y| holds(&BLIND(), In { zone: ZoneName::PenaltyArea, point: at(x, y) });
    assert!(penalty(-3.5, 1.5) && !penalty(-3.4, 0.0) && !penalty(3.6, 0.0), "only the team's own");
}

#[test]
fn facing_is_the_same_on_both_sides_and_across_half_a_turn() {
    for heading in [0.0, 90.0, 179.0, 180.0, -179.0, -91.0] {
        let facing = |off: f32| {
            let direction = crate::geometry::unit((heading + off).to_radians());
            let here = Situation::at(1.0, -1.0, heading);
            holds(&here, Facing { point: At(v(1.0, -1.0) + direction), within: 10.0 })
        };
        for off in [9.9, -9.9, 0.0] {
            assert!(facing(off), "{off}° off {heading}°");
        }
        for off in [10.1, -10.1, 90.0, 180.0] {
            assert!(!facing(off), "{off}° off {heading}°");
        }
    }
}

#[test]
fn nobody_faces_the_place_he_stands_on_or_an_unknown_one() {
    assert!(!holds(&BLIND(), Facing { point: Own, within: 90.0 }));
    assert!(!holds(&BLIND(), Facing { point: Ball, within: 180.0 }));
}

#[test]
fn behind_the_ball_means_in_line_with_it_and_the_target_on_this_side_of_it() {
    let behind = |x: f32, y: f32, within| {
        holds(&Situation::at(x, y, 123.0).ball(1.0, 0.0), BehindBall { toward: at(3.0, 0.0), within })
    };
    assert!(behind(-1.0, 0.0, 0.1));
    assert!(!behind(2.0, 0.0, 90.0), "between ball and target");
    assert!(behind(0.0, 1.0, 45.1) && behind(0.0, -1.0, 45.1));
    assert!(!behind(0.0, 1.0, 44.9) && !behind(0.0, -1.0, 44.9));
    assert!(!holds(&BLIND(), BehindBall { toward: TheirGoal, within: 180.0 }));
}

#[test]
fn a_ball_is_in_the_scoop_up_to_a_gap_ahead_and_a_distance_aside() {
    // The robot looks along -y; its front is 0.125 m ahead, as is the ball's radius.
    let scoop = |ahead: f32, left: f32| {
        let here = Situation::at(1.0, 1.0, -90.0).ball(1.0 + left, 1.0 - ahead);
        holds(&here, BallInScoop { gap: 0.0625, aside: 0.125 })
    };
    assert!(scoop(0.25, 0.0), "touching");
    assert!(scoop(0.312, 0.0) && !scoop(0.313, 0.0), "the gap ahead");
    assert!(scoop(0.25, 0.1249) && scoop(0.25, -0.1249), "aside");
    assert!(!scoop(0.25, 0.1251) && !scoop(0.25, -0.1251), "too far aside");
    assert!(scoop(0.05, 0.0), "believed to be inside the body");
    assert!(!scoop(-0.05, 0.0) && !scoop(-0.25, 0.0), "behind the middle");
    assert!(!holds(&BLIND(), BallInScoop { gap: 9.0, aside: 9.0 }));
}

#[test]
fn a_robot_may_execute_the_one_action_that_it_was_granted() {
    let mut here = BLIND();
    assert!(!holds(&here, MayExecute(PlayerAction::Push)));
    here.team_model.action = Some(PlayerAction::Push);
    assert!(holds(&here, MayExecute(PlayerAction::Push)));
    assert!(!holds(&here, MayExecute(PlayerAction::Acquire)));
}

#[test]
fn times_count_from_the_moment_that_they_are_reached() {
    let here = Situation { stalled_for: 0.5, time_in_state: 2.0, ..BLIND() };
    assert!(holds(&here, Stalled(0.5)) && !holds(&here, Stalled(0.51)));
    assert!(holds(&here, After(2.0)) && !holds(&here, After(2.01)));
}

#[test]
fn a_robot_has_bumped_into_something_while_its_drive_says_so() {
    assert!(!holds(&BLIND(), Bumped));
    assert!(holds(&Situation { bumped: true, ..BLIND() }, Bumped));
}

#[test]
fn messages_run_short_only_where_somebody_counts_them() {
    let left = |messages_left| Situation { messages_left, ..BLIND() };
    let runs_short = |share| holds(&left(share), MessagesLeftBelow(0.2));
    assert_eq!([None, Some(0.2), Some(0.19)].map(runs_short), [false, false, true]);
}

/// What a statement about `Known(Ball)` says in the course of time: seconds and whether the ball is known.
fn course(feature: &Feature, steps: &[(f32, bool)]) -> Vec<bool> {
    let mut memory = Memory::new(1);
    let asked = steps.iter().map(|(now, known)| {
        let here = if *known { BLIND().ball(1.0, 0.0) } else { BLIND() };
        Situation { now: *now, ..here }.senses().holds(feature, &mut memory)
    });
    asked.collect()
}

fn ball() -> Box<Feature> {
    Box::new(Known(Ball))
}

#[test]
fn hold_for_stays_true_for_a_time_after_its_statement_was() {
    let hold = HoldFor { what: ball(), seconds: 1.0, slot: 0 };
    let steps =
        [(0.0, false), (1.0, true), (2.0, false), (2.1, false), (3.0, true), (3.5, true), (4.5, false)];
    assert_eq!(course(&hold, &steps), [false, true, true, false, true, true, true]);
}

#[test]
fn lasting_becomes_true_after_a_time_without_a_break() {
    let lasting = Lasting { what: ball(), seconds: 1.0, slot: 0 };
    let steps = [(0.0, true), (0.9, true), (1.0, true), (1.1, false), (1.2, true), (2.1, true), (2.2, true)];
    assert_eq!(course(&lasting, &steps), [false, false, true, false, false, false, true]);
}

#[test]
fn a_watchdog_barks_for_a_time_when_it_was_not_fed_and_then_waits_again() {
    let watchdog = Watchdog { what: ball(), patience: 2.0, seconds: 1.0, slot: 0 };
    let steps =
        [(0.0, true), (1.9, false), (2.0, false), (2.5, true), (3.0, false), (4.9, false), (5.0, false)];
    assert_eq!(course(&watchdog, &steps), [false, false, true, true, false, false, true]);
}
