//! What is counted of matches: every state and transition, whatever else is looked at, and without a change of play.

use touchline::game::{Match, MatchPlan};
use touchline::lab::coverage::{Coverage, MatchCoverage, StateCoverage};

use crate::support::friendly;

/// Plays a match and counts.
fn counted(plan: &MatchPlan) -> (Coverage, u64) {
    let mut game = Match::new(plan);
    let names = plan.teams.each_ref().map(|team| team.names.strategy.clone());
    let mut coverage = MatchCoverage::new(game.world_mut(), names);
    while !game.is_over() {
        game.tick();
        coverage.observe(game.world());
        // The same tick again, as after a rewind.
        coverage.observe(game.world());
    }
    (coverage.sum(), game.record().digest)
}

fn states(coverage: &Coverage) -> Vec<&StateCoverage> {
    let machines = coverage.strategies.values().flat_map(|strategy| strategy.machines.values());
    machines.flat_map(|machine| machine.states.values()).collect()
}

#[test]
fn counting_changes_nothing_and_every_robot_is_somewhere_all_the_time() {
    let plan = friendly(3, 0.2);
    let (coverage, digest) = counted(&plan);
    let mut game = Match::new(&plan);
    while !game.is_over() {
        game.tick();
    }
    assert_eq!(digest, game.record().digest);
    let names: Vec<&String> = coverage.strategies.keys().collect();
    let mut expected: Vec<&String> = plan.teams.iter().map(|team| &team.names.strategy).collect();
    expected.sort();
    expected.dedup();
    assert_eq!(names, expected);
    let played: u64 = coverage.strategies.values().map(|strategy| strategy.played).sum();
    assert_eq!(played, 2);
    let seconds: f64 = states(&coverage).iter().map(|state| state.seconds).sum();
    let robots = plan.robots().count() as f64;
    let whole = robots * game.clock().now();
    assert!(seconds > 0.7 * whole && seconds <= whole + 0.1, "{seconds} s of {whole} s");
}

#[test]
fn robots_leave_a_state_as_often_as_they_come_to_it_or_are_still_in_it() {
    let (coverage, _) = counted(&friendly(3, 0.2));
    let entered: u64 = states(&coverage).iter().map(|state| state.entered).sum();
    let ways = || states(&coverage).into_iter().flat_map(|state| &state.transitions);
    let taken: u64 = ways().map(|way| way.taken).sum();
    assert!(taken > 20 && taken <= entered, "{taken} transitions, {entered} times a state was entered");
    for state in states(&coverage).iter().filter(|state| state.entered == 0) {
        assert!(state.seconds == 0.0 && state.transitions.iter().all(|way| way.taken == 0), "{state:?}");
    }
}

#[test]
fn counts_add_up_and_are_the_same_in_a_file() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [(mut sum, _), (other, _)] = [3, 4].map(|seed| counted(&friendly(seed, 0.1)));
    let taken = |coverage: &Coverage| -> u64 {
        states(coverage).iter().flat_map(|state| &state.transitions).map(|way| way.taken).sum()
    };
    let both = taken(&sum) + taken(&other);
    let mut turned = other.clone();
    turned.add(&sum);
    sum.add(&other);
    assert_eq!((taken(&sum), &turned), (both, &sum));
    let path = folder.path().join("coverage.ron");
    std::fs::write(&path, sum.to_ron().expect("it can be written")).expect("the folder can be written to");
    assert_eq!(Coverage::read(&path), Ok(sum.clone()));
    let text = std::fs::read_to_string(&path).expect("it was written");
    let bad = text.replacen("taken: ", "taken: 9999999999999999", 1);
    std::fs::write(&path, bad).expect("the folder can be written to");
    let told = Coverage::read(&path).expect_err("nothing happens so often").to_string();
    assert!(told.contains("coverage.ron:") && told.contains(".taken"), "{told}");
    assert!(sum.to_string().contains("transitions taken"), "{sum}");
}
