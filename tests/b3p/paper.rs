//! The paper's rules (figure 5), in both readings of what a robot does with another's booking.

use touchline::protocol::b3p::Rules;

use super::checks::Findings;
use super::story::Story;
use super::team::{ALWAYS, CAUTIOUS, Misfortune, Team, radio};

/// Nothing is lost, and a message may come a tick late.
fn team(rules: Rules) -> Team {
    Team::new(rules, radio(1, 1, 0)).timing_out_after(3)
}

/// Everything is heard before the tick ends.
fn in_phase(rules: Rules, robots: u8) -> Team {
    Team::new(rules, radio(0, 1, 0)).timing_out_after(3).equally_far(robots).in_phase()
}

/// Whether no robot is nearer than two others are.
fn nearest_are_equal(distances: &[u8]) -> bool {
    let nearest = distances.iter().min();
    distances.iter().filter(|distance| Some(*distance) == nearest).count() > 1
}

#[test]
fn robots_in_phase_at_equal_distance_book_and_stand_still_for_ever() {
    for (robots, states) in [(2, 22), (3, 350)] {
        let findings = Findings::of(in_phase(ALWAYS, robots), states);
        assert!(findings.is_never_right());
        assert_eq!(findings.nobody_goes_for(), Some(4));
        assert_eq!(findings.several_go_for(), Some(0));
    }
}

#[test]
fn crossed_bookings_stop_both_robots_until_the_timeout() {
    let findings = Findings::of(team(ALWAYS), 1647);
    assert_eq!(findings.nobody_goes_for(), Some(3 + 1 + 1));
    assert_eq!(findings.several_go_for(), Some(1));
    assert!(findings.lets_go());
    let crossed = findings.graph.marked(|state| {
        state.going() == 0 && state.robots.iter().all(|robot| robot.machine.booking().is_some())
    });
    let path = findings.graph.path_to(crossed.iter().position(|crossed| *crossed).expect("bookings cross"));
    let story = Story::told(&path);
    assert_eq!(story.len(), 4);
    assert!(story.tells("a booking of R1 reaches R0, which believes it: it stops"));
    assert!(story.tells("a booking of R0 reaches R1, which believes it: it stops"));
}

#[test]
fn bookings_cross_again_and_again_where_both_robots_are_equally_far() {
    for rules in [ALWAYS, CAUTIOUS] {
        let wrong = Findings::explored(team(rules)).wrong_for_ever();
        assert_eq!(wrong.len(), 3);
        assert!(wrong.iter().all(|distances| nearest_are_equal(distances)));
    }
}

#[test]
fn a_cautious_robot_and_another_go_to_the_ball_for_ever() {
    let findings = Findings::of(team(CAUTIOUS), 729);
    assert_eq!(findings.several_go_for(), None);
    assert_eq!(findings.nobody_goes_for(), Some(0));
    let can_be_mended = findings.graph.reaching(&findings.one);
    assert!(can_be_mended.contains(&false), "once both have booked, both go whatever happens");
    for (robots, states) in [(2, 10), (3, 78)] {
        let findings = Findings::of(in_phase(CAUTIOUS, robots), states);
        assert!(findings.is_never_right());
        assert_eq!(findings.several_go_for(), None);
    }
}

#[test]
fn of_three_robots_the_two_nearest_decide_whether_all_goes_well() {
    let mut wrong = Findings::of(team(CAUTIOUS).of_three(), 499677).wrong_for_ever();
    assert!(wrong.iter().all(|distances| nearest_are_equal(distances)));
    wrong.sort_unstable();
    wrong.dedup();
    assert_eq!(wrong.len(), 12);
}

#[test]
#[ignore = "deep"]
fn of_three_robots_the_two_nearest_cross_their_bookings_again_and_again() {
    let mut wrong = Findings::of(team(ALWAYS).of_three(), 3673410).wrong_for_ever();
    assert!(wrong.iter().all(|distances| nearest_are_equal(distances)));
    wrong.sort_unstable();
    wrong.dedup();
    assert_eq!(wrong.len(), 12);
}

#[test]
fn a_nearer_robot_takes_the_ball_in_the_end() {
    for rules in [ALWAYS, CAUTIOUS] {
        assert_eq!(Findings::explored(team(rules)).the_wrong_one_goes_for(1), Some(1));
    }
}

#[test]
fn a_booker_that_crashed_is_replaced_but_its_heirs_may_quarrel() {
    for (rules, several) in [(ALWAYS, Some(1)), (CAUTIOUS, None)] {
        let findings = Findings::explored(team(rules).with(Misfortune::Crash));
        assert_eq!(findings.nobody_goes_for(), Some(3 + 1 + 1));
        assert_eq!(findings.several_go_for(), several);
        assert!(!findings.wrong_for_ever().is_empty());
    }
}
