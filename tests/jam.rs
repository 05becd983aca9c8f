//! The worst radio that the search finds for a scenario is the one that the model checker knows.

use touchline::lab::jam::{Harm, JamChoice, JamEnd, JamPlan, JamReport};
use touchline::lab::scenario::ScenarioRef;

use crate::support::assets;

/// What is found with so many packets lost, or late by so much, in a counterexample without its own faults.
fn jam(name: &str, budget: usize, delay: Option<f32>) -> JamReport {
    let assets = assets();
    let choice = JamChoice {
        scenario: ScenarioRef::named(&assets, &format!("counterexample_{name}")),
        seed: None,
        budget,
        harm: "OneRobotARole".parse::<Harm>().expect("it is an invariant"),
        delay,
        all_kinds: false,
        without_faults: true,
        beam: 500,
    };
    JamPlan::read(&assets, &choice).expect("it is sound").run(|_| true)
}

#[track_caller]
fn assert_bears(name: &str, losses: usize) {
    let report = jam(name, losses + 1, None);
    let JamEnd::Harmed { packets, .. } = &report.end else { panic!("{report}") };
    assert_eq!((packets.len(), report.resilience), (losses + 1, Some(losses)), "{report}");
}

#[test]
fn one_loss_is_enough_where_robots_unlock_when_they_have_acknowledged() {
    assert_bears("02_two_generals_unlocked_at_once:paper", 0);
}

#[test]
fn it_takes_two_where_they_stay_locked_and_where_messages_are_sent_once_more() {
    assert_bears("03_two_generals_two_losses:paper", 1);
    assert_bears("04_resending_once:paper", 1);
}

#[test]
fn it_takes_one_where_the_initiator_goes_off_or_forgets() {
    for name in [
        "09_initiator_crashes_between_its_swaps:paper",
        "10_initiator_restarts:paper",
        "11_two_initiators_after_memory_loss:paper",
    ] {
        assert_bears(name, 0);
    }
}

#[test]
fn one_late_message_is_enough_where_a_roll_back_may_overtake_it() {
    let report = jam("07_roll_back_overtakes_swap:paper", 1, Some(0.7));
    assert!(matches!(&report.end, JamEnd::Harmed { packets, .. } if packets.len() == 1), "{report}");
}

#[test]
fn the_hardened_swap_bears_any_two() {
    for name in [
        "02_two_generals_unlocked_at_once:hardened",
        "03_two_generals_two_losses:hardened",
        "04_resending_once:hardened",
        "09_initiator_crashes_between_its_swaps:hardened",
    ] {
        let report = jam(name, 2, None);
        assert_eq!((&report.end, report.resilience), (&JamEnd::Unharmed, Some(2)), "{report}");
    }
}
