//! The worst radio that the search finds for a scenario is the one that the model checker knows.

use touchline::comms::radio::Act::{self, Delay, Drop, Duplicate};
use touchline::lab::jam::{Harm, JamChoice, JamEnd, JamPlan, JamReport, JamStart};
use touchline::lab::scenario::ScenarioRef;

use crate::support::assets;

fn choice(start: JamStart, budget: usize, acts: &[Act]) -> JamChoice {
    JamChoice {
        start,
        at: 0.0,
        seconds: None,
        seed: None,
        budget,
        harm: "OneRobotARole".parse::<Harm>().expect("it is an invariant"),
        acts: acts.to_vec(),
        all_kinds: false,
        without_faults: true,
        beam: 500,
    }
}

fn scenario(name: &str) -> JamStart {
    JamStart::Scenario(ScenarioRef::named(&assets(), &format!("counterexample_{name}")))
}

fn report(choice: &JamChoice) -> JamReport {
    JamPlan::read(&assets(), choice).expect("it is sound").run(|_| true)
}

/// What is found if this may be done to so many packets, in a counterexample without its own faults.
fn jam(name: &str, budget: usize, acts: &[Act]) -> JamReport {
    report(&choice(scenario(name), budget, acts))
}

/// So many packets break it and no fewer.
#[track_caller]
fn assert_broken(report: &JamReport, packets: usize) {
    let JamEnd::Harmed { packets: worst, .. } = &report.end else { panic!("{report}") };
    assert_eq!((worst.len(), report.resilience), (packets, Some(packets - 1)), "{report}");
}

#[track_caller]
fn assert_unbroken(report: &JamReport, packets: usize) {
    assert_eq!((&report.end, report.resilience), (&JamEnd::Unharmed, Some(packets)), "{report}");
}

/// The paper's swap is broken by so many packets and by no fewer, and the hardened one by no set of that size.
#[track_caller]
fn assert_breaks(name: &str, packets: usize, acts: &[Act]) {
    assert_broken(&jam(&format!("{name}:paper"), packets, acts), packets);
    assert_unbroken(&jam(&format!("{name}:hardened"), packets, acts), packets);
}

#[test]
fn one_late_message_doubles_a_role_for_as_long_as_it_takes() {
    let doubled = |name: &str, delay: f32| {
        let harm = Harm::DoubledRole(0.35);
        report(&JamChoice {
            harm,
            ..choice(scenario(&format!("01_shared_for_a_moment:{name}")), 1, &[Delay(delay)])
        })
    };
    assert_broken(&doubled("paper", 0.4), 1);
    assert_unbroken(&doubled("paper", 0.2), 1);
    assert_unbroken(&doubled("hardened", 0.4), 1);
}

#[test]
fn one_loss_is_enough_where_robots_unlock_when_they_have_acknowledged() {
    assert_breaks("02_two_generals_unlocked_at_once", 1, &[Drop]);
}

#[test]
fn it_takes_two_where_they_stay_locked_and_where_messages_are_sent_once_more() {
    assert_breaks("03_two_generals_two_losses", 2, &[Drop]);
    assert_breaks("04_resending_once", 2, &[Drop]);
}

#[test]
fn late_messages_are_enough_where_an_initiator_resends_for_ever() {
    let paper = choice(scenario("05_resending_for_ever:paper"), 3, &[Delay(1.5)]);
    // Most pairs are far from harm; it comes after six seconds.
    assert_broken(&report(&JamChoice { beam: 60, seconds: Some(6.5), ..paper }), 3);
    assert_unbroken(&jam("05_resending_for_ever:hardened", 2, &[Delay(1.5)]), 2);
}

#[test]
fn late_messages_are_enough_where_a_lock_runs_out_or_a_roll_back_overtakes() {
    assert_breaks("06_lock_runs_out_early", 1, &[Delay(0.6), Delay(1.2)]);
    assert_breaks("07_roll_back_overtakes_swap", 1, &[Delay(0.7)]);
}

#[test]
fn copies_of_an_old_attempt_are_enough() {
    let twice = |variant: &str| {
        let start = scenario(&format!("08_replay_of_an_old_attempt:{variant}"));
        report(&JamChoice { harm: Harm::DoubledRole(2.0), ..choice(start, 2, &[Duplicate(6.0)]) })
    };
    assert_broken(&twice("paper"), 2);
    assert_unbroken(&twice("hardened"), 2);
}

#[test]
fn it_takes_one_where_the_initiator_goes_off_or_forgets() {
    assert_breaks("09_initiator_crashes_between_its_swaps", 1, &[Drop]);
    assert_breaks("10_initiator_restarts", 1, &[Drop]);
    assert_breaks("11_two_initiators_after_memory_loss", 1, &[Drop]);
}

#[test]
fn a_late_acknowledgement_passes_for_that_of_a_roll_back() {
    assert_breaks("12_acknowledgements_of_the_swap", 2, &[Drop, Delay(0.48)]);
}

#[test]
fn the_hardened_swap_bears_any_two_losses() {
    for name in ["02_two_generals_unlocked_at_once", "09_initiator_crashes_between_its_swaps"] {
        assert_unbroken(&jam(&format!("{name}:hardened"), 2, &[Drop]), 2);
    }
}
