//! A ball that moves, and distances that are measured badly.

use touchline::protocol::b3p::Rules;

use super::checks::Findings;
use super::team::{ALWAYS, CAUTIOUS, HARDENED, LEXICOGRAPHIC, Misfortune, Team, radio};

#[test]
fn when_the_ball_moves_the_hardened_rules_never_let_it_go() {
    for (radio, states, ticks) in
        [(radio(1, 1, 0), 18758, 1), (radio(1, 1, 1), 84866, 3), (radio(1, 2, 1), 42186, 5)]
    {
        let findings = Findings::of(Team::new(HARDENED, radio).with(Misfortune::Kick), states);
        assert!(!findings.lets_go());
        assert_eq!(findings.nobody_goes_for(), Some(0));
        assert_eq!(findings.several_go_for(), Some(ticks), "{radio:?}");
        assert!(findings.wrong_for_ever().is_empty());
    }
}

#[test]
fn when_the_ball_moves_an_old_announcement_stops_a_lexicographic_team_until_the_timeout() {
    for (radio, nobody, several) in [(radio(1, 1, 0), 8, 3), (radio(1, 1, 1), 8, 6), (radio(1, 2, 1), 7, 7)] {
        let team = Team::new(LEXICOGRAPHIC, radio).timing_out_after(6).with(Misfortune::Kick);
        let findings = Findings::explored(team);
        assert!(findings.lets_go());
        assert_eq!(findings.nobody_goes_for(), Some(nobody), "{radio:?}");
        assert_eq!(findings.several_go_for(), Some(several), "{radio:?}");
        assert!(findings.wrong_for_ever().is_empty());
    }
}

#[test]
fn when_the_ball_moves_the_papers_robots_stop_until_the_timeout_or_go_together_for_ever() {
    for (rules, several) in [(ALWAYS, Some(1)), (CAUTIOUS, None)] {
        let team = Team::new(rules, radio(1, 1, 0)).timing_out_after(6).with(Misfortune::Kick);
        let findings = Findings::explored(team);
        assert!(findings.lets_go());
        assert_eq!(findings.nobody_goes_for(), Some(6 + 1 + 1));
        assert_eq!(findings.several_go_for(), several);
    }
}

fn noisy(rules: Rules, noise: u8, threshold: u8) -> Team {
    Team { noise, threshold, ..Team::new(rules, radio(1, 1, 0)) }
}

#[test]
fn robots_take_the_ball_in_turn_unless_the_threshold_exceeds_the_noise() {
    for noise in 0..=2 {
        for threshold in 0..=3 {
            let findings = Findings::explored(noisy(HARDENED, noise, threshold));
            let alternates = !findings.wrong_for_ever().is_empty();
            assert_eq!(alternates, threshold <= noise, "noise {noise}, threshold {threshold}");
            assert!(!findings.lets_go());
        }
    }
}

#[test]
fn noise_confuses_the_other_rules_whatever_the_threshold() {
    for rules in [ALWAYS, CAUTIOUS, LEXICOGRAPHIC] {
        for threshold in 0..=3 {
            let findings = Findings::explored(noisy(rules, 1, threshold));
            assert!(!findings.wrong_for_ever().is_empty());
            assert!(findings.lets_go() || rules == CAUTIOUS);
        }
    }
}

#[test]
fn of_three_robots_none_takes_the_ball_in_turn_if_the_threshold_exceeds_the_noise() {
    for (threshold, states) in [(1, 67407), (2, 49941)] {
        let team = Team { noise: 1, threshold, ..Team::new(HARDENED, radio(0, 1, 0)) };
        let findings = Findings::of(team.of_three(), states);
        assert_eq!(findings.wrong_for_ever().is_empty(), threshold > 1);
    }
}

#[test]
#[ignore = "deep"]
fn nor_do_they_if_they_hear_of_each_other_late() {
    let findings = Findings::of(noisy(HARDENED, 1, 2).equally_far(3), 813959);
    assert!(findings.wrong_for_ever().is_empty());
}
