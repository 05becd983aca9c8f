//! How long a booking must count: long enough that lost renewals do not end it, for as long nobody replaces a booker that is gone.

use super::checks::Findings;
use super::settling::RADIOS;
use super::team::{HARDENED, LEXICOGRAPHIC, Misfortune, Team, radio};

#[test]
fn a_timeout_that_outlasts_all_lost_renewals_is_enough_and_one_tick_less_is_not() {
    for rules in [LEXICOGRAPHIC, HARDENED] {
        for radio in RADIOS {
            let after = |timeout| {
                Findings::explored(Team::new(rules, radio).timing_out_after(timeout)).wrong_for_ever()
            };
            assert!(after(radio.timeout()).is_empty(), "{radio:?}");
            assert_eq!(after(radio.timeout() - 1).len(), 9, "wherever the ball lies, {radio:?}");
        }
    }
}

#[test]
fn a_booker_that_crashed_is_replaced_after_the_timeout_and_the_delay_and_a_tick() {
    for rules in [LEXICOGRAPHIC, HARDENED] {
        for (radio, ticks) in
            [(radio(0, 1, 0), 2), (radio(1, 1, 0), 4), (radio(1, 1, 1), 5), (radio(1, 2, 1), 7)]
        {
            let team = Team::new(rules, radio).with(Misfortune::Crash);
            assert_eq!(usize::from(team.timeout + 1 + radio.delay), ticks);
            let findings = Findings::explored(team);
            assert_eq!(findings.nobody_goes_for(), Some(ticks), "{radio:?}");
            assert_eq!(findings.several_go_for(), Some(radio.latency()));
            assert!(findings.wrong_for_ever().is_empty());
        }
    }
}

#[test]
fn of_three_robots_one_replaces_a_booker_that_crashed() {
    for (rules, states) in [(LEXICOGRAPHIC, 27402), (HARDENED, 27481)] {
        let team = Team::new(rules, radio(1, 1, 0)).equally_far(3).with(Misfortune::Crash);
        let findings = Findings::of(team, states);
        assert_eq!(findings.nobody_goes_for(), Some(2 + 1 + 1));
        assert!(findings.wrong_for_ever().is_empty());
    }
}
