//! Each policy that decides when to swap roles, in matches.

use std::sync::Arc;

use touchline::comms::radio::RadioRecord;
use touchline::comms::tcm::DataType;
use touchline::data::{AssetKind, ron_options};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::lab::experiment::{MatchFigures, Metric};
use touchline::lab::scenario::{ScenarioPlan, ScenarioRef};
use touchline::mind::teamwork::{LockRequests, Swapping};
use touchline::protocol::policy::Policy;
use touchline::strategy::Role;

use crate::support::assets;

/// Those that always find something to decide. The case-based rule waits for a halfback that loses the ball near the opponents'
/// goal, which does not happen in every match.
const BUSY: [&str; 4] = ["CsFreiburg()", "Art()", "Rmit()", "Optimal()"];

fn plan(policy: &str, seed: u64) -> MatchPlan {
    let choice =
        Choice { home: Some("hammerheads_swap".into()), half_minutes: Some(5.0), seed, ..Choice::default() };
    let mut plan = MatchPlan::read(&assets(), &choice).expect("the shipped files are sound");
    choose(&mut plan, policy);
    plan
}

fn choose(plan: &mut MatchPlan, policy: &str) {
    let policy: Policy = ron_options().from_str(policy).expect("the policy is spelt right");
    let strategy = Arc::make_mut(&mut plan.teams[0].strategy);
    strategy.teamwork.role_swap.as_mut().expect("the team swaps roles").policy = policy;
}

/// The roles of home's robots.
fn roles(game: &mut Match) -> Vec<usize> {
    let mut robots = game.world_mut().query::<(&RobotId, &Role)>();
    let mut all: Vec<_> = robots.iter(game.world()).map(|(id, role)| (*id, role.0)).collect();
    all.sort_unstable();
    all.into_iter().filter(|(id, _)| id.team == Team::Home).map(|(_, role)| role).collect()
}

/// Swaps begin and succeed, and the roles are a permutation nearly all the time.
#[test]
fn every_policy_swaps_roles_in_a_match_and_leaves_each_to_one_robot() {
    for policy in BUSY {
        let (mut locks, mut changes, mut shared, mut ticks) = (0, 0, 0, 0);
        for seed in 1..=8 {
            if changes > 0 {
                break;
            }
            let mut game = Match::new(&plan(policy, seed));
            let mut before = roles(&mut game);
            before.sort_unstable();
            let all = before.clone();
            let mut last = roles(&mut game);
            while !game.is_over() {
                game.tick();
                let now = roles(&mut game);
                changes += u32::from(now != last);
                let mut sorted = now.clone();
                sorted.sort_unstable();
                shared += u32::from(sorted != all);
                ticks += 1;
                last = now;
            }
            locks += game.world().resource::<RadioRecord>().of_kind(DataType::LOCK, None, None).sent;
        }
        println!("{policy}: {locks} LOCKs, {changes} changes, {shared} of {ticks} ticks with a shared role");
        assert!(locks > 0 && changes > 0, "{policy}: {locks} LOCKs, {changes} changes of roles");
        assert!(f64::from(shared) < 0.02 * f64::from(ticks), "{policy}: {shared} of {ticks} ticks shared");
    }
}

/// The halfback of figure 8 loses the ball while the forward is nearest to it.
#[test]
fn the_case_based_rules_decide_in_the_situation_of_figure_8() {
    let path = assets().file(AssetKind::Scenario, "swap_figure_8");
    let scenario = ScenarioPlan::read(&assets(), &path.into()).expect("the shipped scenario is sound");
    let wanted = [
        ("CaseBased()", ["goalie", "forward", "halfback", "floater"]),
        ("ClosestBecomesForward()", ["goalie", "floater", "halfback", "forward"]),
    ];
    for (policy, expected) in wanted {
        let mut plan = scenario.with_seed(1);
        choose(&mut plan, policy);
        let strategy = plan.teams[0].strategy.clone();
        let mut game = Match::new(&plan);
        let names = |game: &mut Match| -> Vec<String> {
            roles(game).into_iter().map(|role| strategy.roles[role].name.clone()).collect()
        };
        assert_eq!(names(&mut game), ["goalie", "halfback", "floater", "forward"]);
        for _ in 0..10 * 60 {
            game.tick();
        }
        assert_eq!(names(&mut game), expected, "{policy}");
    }
}

/// Home 1 asks three robots for their locks and crashes. Home 2 asks the two others that it hears, and its swap succeeds.
#[test]
fn locks_that_are_asked_for_granted_and_run_out_are_counted() {
    let scenario = ScenarioRef::named(&assets(), "swap_locks_time_out:hardened");
    let scenario = ScenarioPlan::read(&assets(), &scenario).expect("the shipped scenario is sound");
    let mut game = Match::new(&scenario.with_seed(1));
    for _ in 0..9 * 60 {
        game.tick();
    }
    let mut robots = game.world_mut().query::<(&RobotId, &Swapping)>();
    let mut requests: Vec<_> = robots.iter(game.world()).map(|(id, it)| (id.number, it.requests)).collect();
    requests.sort_unstable_by_key(|(number, _)| *number);
    let counts = |received, granted, ran_out| LockRequests { received, granted, ran_out };
    let expected = [(0, counts(2, 2, 1)), (1, counts(0, 0, 0)), (2, counts(1, 1, 1)), (3, counts(2, 2, 1))];
    assert_eq!(requests, expected);
    let shares = [Metric::LocksGranted, Metric::LocksRunOut, Metric::SwapsCompleted]
        .map(|metric| metric.value(MatchFigures::of(&game), Team::Home));
    assert_eq!(shares, [Some(1.0), Some(3.0 / 5.0), Some(1.0 / 2.0)]);
}
