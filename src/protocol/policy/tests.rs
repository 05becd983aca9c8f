//! Scenes in which a policy should, or should not, swap roles.

mod properties;
mod utilities;
mod words;

use crate::geometry::Vec2;
use crate::ids::PlayerNumber;
use crate::protocol::role_swap::RoleIndex;
use smallvec::smallvec;

use super::*;
use crate::protocol::role_swap::Assignment;

const GOALIE: RoleIndex = 3;
const CAST: SwapRoles = SwapRoles { halfback: 0, floater: 1, forward: 2 };
/// The goalie is robot 3, the others are numbered as in figure 8.
const KICK_OFF: [RoleIndex; 4] = [CAST.halfback, CAST.floater, CAST.forward, GOALIE];
const HALF_LENGTH: f32 = 4.5;

fn assignment(roles: [RoleIndex; 4]) -> Assignment {
    Assignment::new(roles)
}

fn player(number: PlayerNumber, role: RoleIndex, x: f32, y: f32) -> Player {
    Player { number, role, position: Vec2::new(x, y), heading: 0.0, values: None }
}

/// Robots that know each other and the ball, and who of them has it.
#[derive(Clone, Debug)]
struct Scene {
    players: Vec<Player>,
    ball: Option<Vec2>,
    in_control: Option<PlayerNumber>,
    now: f32,
}

impl Scene {
    /// Figure 8 (e): the halfback loses the ball to their goalie, the forward supports it and the floater has dropped back.
    fn figure_8() -> Scene {
        Scene {
            players: vec![
                player(0, CAST.halfback, 3.0, 0.3),
                player(1, CAST.floater, -2.0, 0.5),
                player(2, CAST.forward, 2.2, -0.8),
                player(3, GOALIE, -4.2, 0.0),
            ],
            ball: Some(Vec2::new(3.9, 0.0)),
            in_control: None,
            now: 60.0,
        }
    }

    fn knowledge(&self, me: PlayerNumber) -> Knowledge<'_> {
        Knowledge {
            me,
            players: &self.players,
            ball: self.ball,
            tight_control: self.in_control == Some(me),
            half_length: HALF_LENGTH,
            goal: Vec2::new(HALF_LENGTH, 0.0),
            now: self.now,
        }
    }

    /// Everybody's values cross the radio.
    fn exchange_values(&mut self, policy: &Policy) {
        for place in 0..self.players.len() {
            let values = policy.values(&CAST, &self.knowledge(self.players[place].number));
            let valued = |(values, wish)| Valued { values, wish, age: 0.0 };
            self.players[place].values = values.map(valued);
        }
    }

    fn decide(&self, policy: &Policy, me: PlayerNumber) -> Option<Reassignment> {
        policy.decide(&CAST, &self.knowledge(me), &mut PolicyState::default())
    }

    /// What a robot decides that had the ball a moment ago.
    fn decide_after_control(&self, policy: &Policy, me: PlayerNumber) -> Option<Reassignment> {
        let mut state = PolicyState { had_control: true, ..PolicyState::default() };
        policy.decide(&CAST, &self.knowledge(me), &mut state)
    }

    /// The robots that propose a swap, with the roles that would follow.
    fn proposals(&self, policy: &Policy) -> Vec<(PlayerNumber, [RoleIndex; 4])> {
        let roles = |proposal: Reassignment| {
            let after = proposal.apply(&assignment(KICK_OFF), &assignment(KICK_OFF));
            after.roles().try_into().unwrap()
        };
        (0..4).filter_map(|me| Some((me, roles(self.decide(policy, me)?)))).collect()
    }
}

/// What the paper says of figure 8.
const AFTER_FIGURE_8: [RoleIndex; 4] = [CAST.forward, CAST.halfback, CAST.floater, GOALIE];

fn case_based() -> Policy {
    Policy::CaseBased(CaseBased::default())
}

fn closest() -> Policy {
    Policy::ClosestBecomesForward(ClosestBecomesForward::default())
}

#[test]
fn in_figure_8_the_halfback_becomes_the_forward_the_forward_the_floater_and_the_floater_the_halfback() {
    let proposal = Scene::figure_8().decide_after_control(&case_based(), 0).unwrap();
    let all = assignment(KICK_OFF);
    assert_eq!(proposal.apply(&all, &all), assignment(AFTER_FIGURE_8));
}

#[test]
fn the_halfback_proposes_once_at_the_moment_it_loses_the_ball() {
    let (policy, mut state) = (case_based(), PolicyState::default());
    let mut scene = Scene::figure_8();
    let mut decide = |in_control| {
        scene.in_control = in_control;
        policy.decide(&CAST, &scene.knowledge(0), &mut state).is_some()
    };
    assert_eq!([None, Some(0), Some(0), None, None].map(&mut decide), [false, false, false, true, false]);
}

#[test]
fn only_the_halfback_starts_the_rotation() {
    for me in [1, 2, 3] {
        assert_eq!(Scene::figure_8().decide_after_control(&case_based(), me), None);
        assert_eq!(Scene::figure_8().decide_after_control(&closest(), me), None);
    }
}

#[test]
fn a_ball_lost_in_the_lower_half_of_the_offensive_zone_changes_nothing() {
    let mut scene = Scene::figure_8();
    scene.players[0].position.x = 2.25;
    assert_eq!(scene.decide_after_control(&case_based(), 0), None);
    assert_eq!(scene.decide_after_control(&closest(), 0), None);
    scene.players[0].position.x = 2.26;
    assert!(scene.decide_after_control(&case_based(), 0).is_some());
}

#[test]
fn the_team_mate_closest_to_the_halfback_becomes_the_forward_and_the_rearmost_the_halfback() {
    let mut scene = Scene::figure_8();
    scene.players[1].position = Vec2::new(2.5, 0.5);
    scene.players[2].position = Vec2::new(0.0, 1.0);
    let proposal = scene.decide_after_control(&closest(), 0);
    let expected = smallvec![(1, CAST.forward), (0, CAST.floater), (2, CAST.halfback)];
    assert_eq!(proposal, Some(Reassignment::Robots(expected)));
}

#[test]
fn of_two_team_mates_just_as_close_the_one_with_the_lower_number_becomes_the_forward() {
    let mut scene = Scene::figure_8();
    scene.players[1].position = Vec2::new(3.0, 1.3);
    scene.players[2].position = Vec2::new(3.0, -0.7);
    let Some(Reassignment::Robots(changes)) = scene.decide_after_control(&closest(), 0) else { panic!() };
    assert!(changes.contains(&(1, CAST.forward)), "{changes:?}");
}

#[test]
fn the_refined_rule_needs_to_hear_of_the_whole_cast_and_the_plain_one_does_not() {
    let mut scene = Scene::figure_8();
    scene.players.remove(1);
    assert_eq!(scene.decide_after_control(&closest(), 0), None);
    assert!(scene.decide_after_control(&case_based(), 0).is_some());
}

#[test]
fn the_refined_rule_leaves_a_forward_that_is_closest_and_a_rearmost_halfback_alone() {
    let mut scene = Scene::figure_8();
    scene.players[1].position = Vec2::new(4.0, -1.5);
    scene.players[2].position = Vec2::new(3.2, 0.0);
    assert_eq!(scene.decide_after_control(&closest(), 0), None);
}

#[test]
fn the_cheapest_distribution_of_figure_8_is_the_papers_and_the_lowest_number_proposes_it() {
    let policy = Policy::Optimal(Optimal::default());
    assert_eq!(Scene::figure_8().proposals(&policy), [(0, AFTER_FIGURE_8)]);
    let mut scene = Scene::figure_8();
    scene.players[0] = player(0, GOALIE, -4.2, 0.0);
    scene.players[3] = player(3, CAST.halfback, 3.0, 0.3);
    assert_eq!(scene.decide(&policy, 0), None, "a goalie is not in the cast");
    assert!(scene.decide(&policy, 1).is_some());
}

#[test]
fn a_swap_has_to_save_enough_travel() {
    let mut scene = Scene::figure_8();
    // The forward's place is (3.5, 0), the floater's (2.5, 0).
    let places = Places { standoff: 0.4, behind: 1.4, aside: 0.0, ..Places::default() };
    scene.players = vec![player(1, CAST.floater, 3.5, 0.0), player(2, CAST.forward, 2.5, 0.0)];
    let decide = |min_gain| scene.decide(&Policy::Optimal(Optimal { places, min_gain, rest: 0.0 }), 1);
    assert!(decide(1.9).is_some());
    assert_eq!(decide(2.1), None);
}

#[test]
fn rmit_swaps_all_three_roles_of_figure_8_at_once_and_only_the_new_forward_proposes_it() {
    assert_eq!(Scene::figure_8().proposals(&Policy::Rmit(Rmit::default())), [(0, AFTER_FIGURE_8)]);
}

#[test]
fn rmit_leaves_a_role_with_its_holder_within_the_bonus() {
    let mut scene = Scene::figure_8();
    scene.players = vec![player(1, CAST.floater, 3.0, 0.0), player(2, CAST.forward, 2.6, 0.0)];
    let decide = |bonus| scene.decide(&Policy::Rmit(Rmit { bonus, ..Rmit::default() }), 1);
    assert_eq!(decide(0.5), None);
    assert!(decide(0.3).is_some());
}

#[test]
fn rmit_prefers_a_robot_behind_the_ball_to_one_that_has_overrun_it() {
    let mut scene = Scene::figure_8();
    scene.ball = Some(Vec2::ZERO);
    scene.players = vec![player(1, CAST.floater, -1.8, 0.0), player(2, CAST.forward, 1.2, 0.0)];
    let decide = |wrong_side| scene.decide(&Policy::Rmit(Rmit { wrong_side, ..Rmit::default() }), 1);
    assert!(decide(1.0).is_some());
    assert_eq!(decide(0.0), None);
}

#[test]
fn doubled_roles_are_put_right_by_policies_that_hand_out_all_roles_anew() {
    let mut scene = Scene::figure_8();
    scene.players[1].role = CAST.forward;
    let broken = assignment([CAST.halfback, CAST.forward, CAST.forward, GOALIE]);
    for policy in
        [Policy::Rmit(Rmit::default()), Policy::Optimal(Optimal { min_gain: 100.0, ..Optimal::default() })]
    {
        scene.exchange_values(&policy);
        let proposal = (0..4).find_map(|me| scene.decide(&policy, me)).expect("a proposal");
        let mended = proposal.apply(&broken, &assignment(KICK_OFF));
        assert_eq!(mended, assignment(AFTER_FIGURE_8), "{policy:?}");
    }
}

#[test]
fn without_a_ball_nobody_swaps_unless_it_was_just_lost() {
    let mut scene = Scene::figure_8();
    scene.ball = None;
    for policy in properties::policies() {
        scene.exchange_values(&policy);
        assert_eq!(scene.proposals(&policy), []);
    }
    assert!(scene.decide_after_control(&case_based(), 0).is_some());
}

#[test]
fn a_team_rests_after_a_change_of_roles_whoever_proposed_it() {
    let policy = Policy::Optimal(Optimal { rest: 2.0, ..Optimal::default() });
    let mut state = PolicyState::default();
    let mut decide = |now, roles: [RoleIndex; 4]| {
        let mut scene = Scene { now, ..Scene::figure_8() };
        for (player, role) in scene.players.iter_mut().zip(roles) {
            player.role = role;
        }
        policy.decide(&CAST, &scene.knowledge(0), &mut state).is_some()
    };
    assert!(decide(10.0, KICK_OFF));
    assert!(!decide(11.9, KICK_OFF), "just proposed");
    assert!(decide(12.0, KICK_OFF), "the proposal came to nothing");
    assert!(!decide(15.0, AFTER_FIGURE_8));
    assert!(!decide(16.0, KICK_OFF), "somebody swapped them back");
    assert!(decide(18.0, KICK_OFF));
}
