//! Under the lexicographic and the hardened rules one robot goes, soon and for good, as long as the ball lies still and nothing
//! happens to anybody.

use super::checks::Findings;
use super::team::{ALWAYS, HARDENED, LEXICOGRAPHIC, Radio, Team, radio};

/// Delay, renewal and losses in a row.
pub const RADIOS: [Radio; 12] = [
    radio(0, 1, 0),
    radio(1, 1, 0),
    radio(2, 1, 0),
    radio(0, 2, 0),
    radio(1, 2, 0),
    radio(2, 2, 0),
    radio(0, 1, 1),
    radio(1, 1, 1),
    radio(0, 2, 1),
    radio(1, 2, 1),
    radio(0, 1, 2),
    radio(1, 1, 2),
];

#[test]
fn one_robot_goes_after_the_first_announcements_and_nobody_goes_never() {
    for (rules, states) in [(LEXICOGRAPHIC, 783), (HARDENED, 1017)] {
        let findings = Findings::of(Team::new(rules, radio(1, 1, 0)).timing_out_after(3), states);
        assert_eq!(findings.settles_after(), Some(1));
        assert_eq!(findings.nobody_goes_for(), Some(0));
        assert!(!findings.lets_go());
    }
}

#[test]
fn robots_in_phase_at_equal_distance_settle_within_the_tick() {
    for rules in [LEXICOGRAPHIC, HARDENED] {
        for (robots, states) in [(2, 11), (3, 81)] {
            let team = Team::new(rules, radio(0, 1, 0)).timing_out_after(3).equally_far(robots).in_phase();
            assert_eq!(Findings::of(team, states).settles_after(), Some(0));
        }
    }
}

#[test]
fn several_go_until_a_booking_is_heard_and_no_longer() {
    for rules in [ALWAYS, LEXICOGRAPHIC, HARDENED] {
        for radio in RADIOS {
            let findings = Findings::explored(Team::new(rules, radio));
            assert_eq!(findings.several_go_for(), Some(radio.latency()), "{radio:?}");
            if rules != ALWAYS {
                assert_eq!(findings.settles_after(), Some(radio.latency()));
                assert!(!findings.lets_go());
            }
        }
    }
}

#[test]
fn three_robots_settle_as_well_where_the_radio_is_quick() {
    for (rules, states, settled) in [(LEXICOGRAPHIC, 5142, 0), (HARDENED, 7875, 1)] {
        let team = Team::new(rules, radio(0, 1, 0)).timing_out_after(3).of_three();
        let findings = Findings::of(team, states);
        assert_eq!(findings.several_go_for(), Some(0));
        assert_eq!(findings.settles_after(), Some(settled));
        assert!(!findings.lets_go());
    }
}

#[test]
#[ignore = "deep"]
fn three_robots_settle_as_well() {
    for (rules, states, several, settled) in [(LEXICOGRAPHIC, 473865, 1, 1), (HARDENED, 1044165, 2, 3)] {
        let team = Team::new(rules, radio(1, 1, 0)).timing_out_after(3).of_three();
        let findings = Findings::of(team, states);
        assert_eq!(findings.several_go_for(), Some(several));
        assert_eq!(findings.settles_after(), Some(settled));
        assert!(!findings.lets_go());
    }
}

#[test]
fn a_nearer_robot_takes_the_ball_as_soon_as_it_is_heard() {
    for rules in [LEXICOGRAPHIC, HARDENED] {
        for radio in RADIOS {
            let findings = Findings::explored(Team::new(rules, radio));
            assert_eq!(findings.the_wrong_one_goes_for(1), Some(radio.latency()), "{radio:?}");
        }
    }
}

#[test]
fn the_checker_and_the_graph_find_the_same_states() {
    for rules in [ALWAYS, LEXICOGRAPHIC, HARDENED] {
        let team = || Team::new(rules, radio(1, 1, 1));
        assert_eq!(team().unique_states(), Findings::explored(team()).graph.states.len());
    }
}
