//! Scenes for the policies that exchange values.

use super::*;
use crate::geometry::Vec2;
use crate::protocol::role_swap::RoleIndex;

fn freiburg() -> Policy {
    Policy::CsFreiburg(CsFreiburg::default())
}

fn art() -> Policy {
    Policy::Art(Art::default())
}

/// Values, wish and age.
type Bid<'a> = Option<(&'a [f32], Option<u8>, f32)>;

/// Three robots of the cast with these broadcast values; the ball is in the middle, and 0 decides from where it stands.
fn bids(roles: [RoleIndex; 3], at: [(f32, f32); 3], bids: [Bid; 3]) -> Scene {
    let mut players = Vec::new();
    for (number, (role, ((x, y), bid))) in (0..).zip(roles.into_iter().zip(at.into_iter().zip(bids))) {
        let values = bid.map(|(values, wish, age)| Valued { values: values.into(), wish, age });
        players.push(Player { values, ..player(number, role, x, y) });
    }
    Scene { players, ball: Some(Vec2::ZERO), in_control: None, now: 1.0 }
}

const HALFBACK_AT_THE_BALL: [(f32, f32); 3] = [(-0.4, 0.0), (-2.0, 1.0), (1.0, 1.0)];

fn forward_bids(values: &[f32], wish: Option<u8>, age: f32) -> Scene {
    let roles = [CAST.halfback, CAST.floater, CAST.forward];
    bids(roles, HALFBACK_AT_THE_BALL, [None, Some((&[0.2, 0.2, 0.2], None, 0.0)), Some((values, wish, age))])
}

#[test]
fn a_robot_takes_a_role_that_it_is_best_at_and_that_the_holder_wishes_to_leave() {
    let proposal = forward_bids(&[0.4, 0.6, 0.1], Some(1), 0.1).decide(&freiburg(), 0);
    let expected = smallvec![(0, CAST.forward), (2, CAST.halfback)];
    assert_eq!(proposal, Some(Reassignment::Robots(expected)));
}

#[test]
fn a_content_holder_keeps_its_role() {
    assert_eq!(forward_bids(&[0.4, 0.6, 0.1], None, 0.1).decide(&freiburg(), 0), None);
    assert_eq!(forward_bids(&[0.4, 0.6, 0.1], Some(0), 0.1).decide(&freiburg(), 0), None);
}

#[test]
fn a_holder_of_whom_nothing_fresh_was_heard_keeps_its_role() {
    assert_eq!(forward_bids(&[0.4, 0.6, 0.1], Some(1), 1.5).decide(&freiburg(), 0), None);
    assert_eq!(forward_bids(&[0.4, 0.6], Some(1), 0.1).decide(&freiburg(), 0), None);
    assert_eq!(forward_bids(&[0.4, f32::NAN, 0.1], Some(1), 0.1).decide(&freiburg(), 0), None);
}

#[test]
fn a_robot_does_not_take_a_role_that_another_is_worth_more_in() {
    let mut scene = forward_bids(&[0.4, 0.6, 0.1], Some(1), 0.1);
    let of_the_floater = Valued { values: smallvec![1.1, 0.0, 0.0], wish: Some(0), age: 0.0 };
    scene.players[1].values = Some(of_the_floater);
    assert_eq!(scene.decide(&freiburg(), 0), None);
}

#[test]
fn a_role_that_nobody_holds_is_free_only_when_the_whole_cast_was_heard_of() {
    let mut scene = forward_bids(&[0.4, 0.6, 0.1], Some(1), 0.1);
    scene.players[2].role = CAST.floater;
    assert!(scene.decide(&freiburg(), 0).is_some());
    scene.players.remove(2);
    assert_eq!(scene.decide(&freiburg(), 0), None);
}

#[test]
fn freiburg_comes_to_the_papers_roles_of_figure_8_in_two_exchanges() {
    let (policy, mut scene) = (freiburg(), Scene::figure_8());
    let (all, mut roles) = (assignment(KICK_OFF), assignment(KICK_OFF));
    let mut proposers = Vec::new();
    for _ in 0..4 {
        scene.exchange_values(&policy);
        let Some((me, proposal)) = (0..4).find_map(|me| Some((me, scene.decide(&policy, me)?))) else {
            break;
        };
        roles = proposal.apply(&roles, &all);
        proposers.push(me);
        for player in &mut scene.players {
            player.role = roles.of(player.number).unwrap();
        }
    }
    assert_eq!(roles, assignment(AFTER_FIGURE_8));
    assert_eq!(proposers.len(), 2, "{proposers:?}");
}

#[test]
fn the_wish_is_the_role_of_highest_utility_if_that_is_worth_the_margin() {
    let scene = Scene::figure_8();
    let (values, wish) = freiburg().values(&CAST, &scene.knowledge(0)).unwrap();
    assert_eq!(values.len(), 3);
    assert_eq!(wish, Some(0), "the halfback would be the forward");
    let unwilling = Policy::CsFreiburg(CsFreiburg { margin: 1.0, ..CsFreiburg::default() });
    assert_eq!(unwilling.values(&CAST, &scene.knowledge(0)).unwrap().1, None);
    assert_eq!(freiburg().values(&CAST, &scene.knowledge(3)), None, "a goalie bids for nothing");
}

/// A halfback 1 m from the ball and looking at it, with these values of the others for reaching it.
fn reach(forward: f32, floater: f32) -> Scene {
    let roles = [CAST.halfback, CAST.floater, CAST.forward];
    bids(
        roles,
        [(-1.0, 0.0); 3],
        [None, Some((&[floater, 0.4], None, 0.0)), Some((&[forward, 0.4], None, 0.0))],
    )
}

#[test]
fn art_takes_the_ball_over_above_one_threshold_from_a_forward_below_the_other() {
    // Its own value is 0.6.
    let expected = smallvec![(0, CAST.forward), (2, CAST.halfback)];
    assert_eq!(reach(0.3, 0.3).decide(&art(), 0), Some(Reassignment::Robots(expected)));
    assert_eq!(reach(0.4, 0.2).decide(&art(), 0), None, "the forward is at its average");
    assert_eq!(reach(0.4, 0.59).decide(&art(), 0), None, "hardly better than the average itself");
    assert_eq!(reach(0.1, 0.7).decide(&art(), 0), None, "another is better");
}

#[test]
fn art_lets_a_forward_defend_only_after_it_has_given_the_ball_up() {
    let decide = |others_reach: f32| {
        let others: &[f32] = &[others_reach, 0.1];
        let roles = [CAST.forward, CAST.floater, CAST.halfback];
        // At our end, away from the ball: 0 is by far the best defender.
        let bid = Some((others, None, 0.0));
        bids(roles, [(-2.7, 0.0), (0.0, 1.0), (0.5, 1.0)], [None, bid, bid]).decide(&art(), 0)
    };
    assert!(decide(0.6).is_some());
    assert_eq!(decide(0.3), None);
}

#[test]
fn turning_to_the_ball_costs_time_in_art() {
    let reach = |heading| {
        let mut scene = Scene::figure_8();
        scene.players[1].heading = heading;
        art().values(&CAST, &scene.knowledge(1)).unwrap().0[0]
    };
    assert!(reach(0.0) > reach(1.5) && reach(1.5) > reach(3.0));
}
