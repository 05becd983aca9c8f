//! What holds in every scene, with roles doubled, missing or wrong and players not heard of.

use crate::geometry::Vec2;
use crate::ids::PlayerNumber;
use crate::protocol::role_swap::RoleIndex;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use super::*;

/// All policies as they are by default.
pub(super) fn policies() -> Vec<Policy> {
    vec![
        case_based(),
        closest(),
        Policy::CsFreiburg(CsFreiburg::default()),
        Policy::Art(Art::default()),
        Policy::Rmit(Rmit::default()),
        Policy::Optimal(Optimal::default()),
    ]
}

/// The same without rest, and others without any of the constants that calm them.
fn restless() -> Vec<Policy> {
    let (freiburg, art) = (CsFreiburg::default(), Art::default());
    vec![
        case_based(),
        closest(),
        Policy::CsFreiburg(CsFreiburg { rest: 0.0, ..freiburg }),
        Policy::CsFreiburg(CsFreiburg { rest: 0.0, margin: 0.0, ..freiburg }),
        Policy::Art(Art { rest: 0.0, ..art }),
        Policy::Art(Art { rest: 0.0, enter: 1.01, leave: 1.0, ..art }),
        Policy::Rmit(Rmit { rest: 0.0, ..Rmit::default() }),
        Policy::Rmit(Rmit { rest: 0.0, bonus: 0.0, ..Rmit::default() }),
        Policy::Optimal(Optimal { rest: 0.0, ..Optimal::default() }),
        Policy::Optimal(Optimal { rest: 0.0, min_gain: 0.0, ..Optimal::default() }),
    ]
}

/// Anywhere on the pitch, often where another robot is too.
fn point() -> impl Strategy<Value = Vec2> {
    prop_oneof![
        3 => (-4.5_f32..4.5, -2.5_f32..2.5).prop_map(|(x, y)| Vec2::new(x, y)),
        1 => (-4_i8..=4, -2_i8..=2).prop_map(|(x, y)| Vec2::new(f32::from(x), f32::from(y))),
    ]
}

fn valued() -> impl Strategy<Value = Option<Valued>> {
    let value = prop_oneof![8 => -0.5_f32..2.0, 1 => Just(0.5), 1 => Just(f32::NAN)];
    let values = prop::collection::vec(value, 1..5);
    let valued = (values, prop::option::of(0_u8..4), 0.0_f32..1.5);
    prop::option::of(valued.prop_map(|(values, wish, age)| Valued { values: values.into(), wish, age }))
}

fn role() -> impl Strategy<Value = RoleIndex> {
    prop_oneof![8 => 0_u8..3, 1 => 3_u8..5]
}

/// A scene of some players of a team, whose roles are any at all.
fn scene() -> impl Strategy<Value = Scene> {
    let player = (role(), point(), -3.2_f32..3.2, valued());
    let player = player.prop_map(|(role, position, heading, values)| Player {
        number: 0,
        role,
        position,
        heading,
        values,
    });
    let numbered = |team: Vec<Option<Player>>| -> Vec<Player> {
        let named = |(number, player): (PlayerNumber, Option<Player>)| Some(Player { number, ..player? });
        (0..).zip(team).filter_map(named).collect()
    };
    let players = prop::collection::vec(prop::option::weighted(0.9, player), 4).prop_map(numbered);
    let ball = prop::option::weighted(0.9, point());
    (players, ball, prop::option::weighted(0.2, 0_u8..4)).prop_map(|(players, ball, in_control)| Scene {
        players,
        ball,
        in_control,
        now: 1.0,
    })
}

/// The cast's roles and the goalie's, dealt out anyhow.
fn dealt() -> impl Strategy<Value = [RoleIndex; 4]> {
    Just(KICK_OFF).prop_shuffle()
}

impl Scene {
    fn believe(&mut self, roles: &Assignment) {
        for player in &mut self.players {
            player.role = roles.of(player.number).unwrap();
        }
    }
}

/// Lets the robots decide in turn and obey at once, with fresh values, until nobody wants a change; returns all the roles
/// that there were, or `None` if there is no end.
fn settle(policy: &Policy, mut scene: Scene, mut roles: Assignment) -> Option<Vec<Assignment>> {
    let mut had_control = scene.in_control.is_none();
    let mut history = vec![roles.clone()];
    for _ in 0..8 {
        scene.believe(&roles);
        scene.exchange_values(policy);
        let proposal = (0..4).find_map(|me| {
            let mut state = PolicyState { had_control, ..PolicyState::default() };
            policy.decide(&CAST, &scene.knowledge(me), &mut state)
        });
        let Some(proposal) = proposal else { return Some(history) };
        roles = proposal.apply(&roles, &assignment(KICK_OFF));
        history.push(roles.clone());
        had_control = false;
    }
    None
}

#[test]
fn there_are_scenes_in_which_each_policy_swaps() {
    let mut runner = TestRunner::deterministic();
    let scenes: Vec<_> =
        (0..500).map(|_| (scene(), dealt()).new_tree(&mut runner).unwrap().current()).collect();
    for policy in restless() {
        let swaps = |(scene, roles): &(Scene, [RoleIndex; 4])| {
            settle(&policy, scene.clone(), assignment(*roles)).is_some_and(|history| history.len() > 1)
        };
        assert!(scenes.iter().any(swaps), "{policy:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_proposal_leaves_a_permutation_whatever_its_author_believed(scene in scene(), roles in dealt()) {
        let before = assignment(roles);
        for policy in policies() {
            for me in 0..4 {
                let proposals = [scene.decide(&policy, me), scene.decide_after_control(&policy, me)];
                for proposal in proposals.into_iter().flatten() {
                    let after = proposal.apply(&before, &assignment(KICK_OFF));
                    prop_assert!(after.has_roles_of(&before), "{policy:?}: {proposal:?} makes {after:?}");
                }
            }
        }
    }

    #[test]
    fn nobody_swaps_the_goalie_out_of_goal(mut scene in scene(), roles in dealt()) {
        let before = assignment(roles);
        scene.believe(&before);
        let goalie = (0..4).find(|number| before.of(*number) == Some(GOALIE)).unwrap();
        for policy in policies() {
            scene.exchange_values(&policy);
            prop_assert_eq!(scene.decide_after_control(&policy, goalie), None);
            for me in 0..4 {
                if let Some(proposal) = scene.decide_after_control(&policy, me) {
                    let after = proposal.apply(&before, &assignment(KICK_OFF));
                    prop_assert_eq!(after.of(goalie), Some(GOALIE));
                    prop_assert_ne!(after, before.clone(), "a proposal changes something");
                }
            }
        }
    }

    #[test]
    fn a_team_settles_and_no_roles_come_back(scene in scene(), roles in dealt()) {
        for policy in restless() {
            let history = settle(&policy, scene.clone(), assignment(roles));
            let history = history.ok_or_else(|| TestCaseError::fail(format!("{policy:?} never settles")))?;
            let mut distinct = history.clone();
            distinct.sort();
            distinct.dedup();
            prop_assert_eq!(distinct.len(), history.len(), "{:?} went {:?}", policy, history);
        }
    }

    #[test]
    fn a_team_with_doubled_roles_settles_too(scene in scene(), roles in prop::array::uniform4(0_u8..4)) {
        for policy in restless() {
            prop_assert!(settle(&policy, scene.clone(), assignment(roles)).is_some(), "{policy:?} never settles");
        }
    }

    #[test]
    fn policies_that_hand_out_all_roles_anew_are_settled_after_one_swap(scene in scene(), roles in dealt()) {
        for policy in restless() {
            if matches!(policy, Policy::Rmit(_) | Policy::Optimal(_)) {
                let history = settle(&policy, scene.clone(), assignment(roles)).unwrap_or_default();
                prop_assert!((1..=2).contains(&history.len()), "{policy:?} went {history:?}");
            }
        }
    }

    #[test]
    fn robots_that_agree_on_the_scene_do_not_compete_unless_they_bid_for_themselves(
        mut scene in scene(), roles in dealt(),
    ) {
        scene.believe(&assignment(roles));
        for policy in policies() {
            if !matches!(policy, Policy::CsFreiburg(_) | Policy::Art(_)) {
                scene.exchange_values(&policy);
                let authors = (0..4).filter(|me| scene.decide_after_control(&policy, *me).is_some()).count();
                prop_assert!(authors <= 1, "{policy:?} has {authors}");
            }
        }
    }

    #[test]
    fn the_same_scene_gets_the_same_decision(scene in scene()) {
        for policy in policies() {
            for me in 0..4 {
                let (mut one, mut other) = (PolicyState::default(), PolicyState::default());
                let knowledge = scene.knowledge(me);
                let decisions = [&mut one, &mut other].map(|state| policy.decide(&CAST, &knowledge, state));
                prop_assert_eq!(&decisions[0], &decisions[1]);
                prop_assert_eq!(one, other);
            }
        }
    }

    #[test]
    fn values_that_are_broadcast_are_sound(scene in scene()) {
        for policy in policies() {
            for me in 0..4 {
                if let Some((values, wish)) = policy.values(&CAST, &scene.knowledge(me)) {
                    prop_assert!(values.iter().all(|value| (0.0..=2.0).contains(value)), "{values:?}");
                    prop_assert!(wish.is_none_or(|wish| usize::from(wish) < values.len()));
                }
            }
        }
    }
}
