//! A booker that loses sight of the ball.

use touchline::protocol::b3p::Rules;

use super::checks::Findings;
use super::team::{
    ALWAYS, CAUTIOUS, HARDENED, LEXICOGRAPHIC, Misfortune, RELEASING, Radio, Release, Team, radio,
};

/// With a timeout that a release need not wait for.
const SETTINGS: [(Radio, u8, usize); 6] = [
    (radio(0, 1, 0), 6, 2),
    (radio(1, 1, 0), 6, 3),
    (radio(0, 1, 1), 6, 3),
    (radio(1, 1, 1), 8, 5),
    (radio(1, 2, 1), 8, 7),
    (radio(1, 1, 2), 8, 6),
];

fn blind(rules: Rules, radio: Radio, timeout: u8) -> Team {
    Team::new(rules, radio).timing_out_after(timeout).with(Misfortune::Blindness)
}

#[test]
fn a_booker_that_lost_sight_is_replaced_after_the_timeout_and_the_delay_and_a_tick() {
    for rules in [ALWAYS, CAUTIOUS, LEXICOGRAPHIC, HARDENED] {
        for (radio, timeout, _) in SETTINGS {
            let findings = Findings::explored(blind(rules, radio, timeout));
            assert_eq!(findings.nobody_goes_for(), Some(usize::from(timeout + 1 + radio.delay)), "{radio:?}");
            let quarrel = !findings.wrong_for_ever().is_empty();
            assert_eq!(quarrel, matches!(rules, Rules::Paper(_)), "as they may without any loss of sight");
        }
    }
}

#[test]
fn a_release_hands_the_ball_over_without_waiting_for_the_timeout() {
    for (radio, timeout, ticks) in SETTINGS {
        let findings = Findings::explored(blind(RELEASING, radio, timeout));
        assert_eq!(findings.nobody_goes_for(), Some(ticks), "{radio:?}");
        assert!(findings.wrong_for_ever().is_empty());
    }
}

#[test]
fn of_three_robots_one_follows_on_a_release() {
    let team = Team { robots: 3, ..blind(RELEASING, radio(0, 1, 0), 6) };
    let findings = Findings::of(team, 37709);
    assert_eq!(findings.nobody_goes_for(), Some(2));
    assert!(findings.wrong_for_ever().is_empty());
}

#[test]
fn a_release_in_the_old_term_is_overtaken_by_a_renewal() {
    let nobody_goes_for = |release| {
        let team = Team { release, ..blind(RELEASING, radio(1, 1, 0), 6) };
        Findings::explored(team).nobody_goes_for()
    };
    assert_eq!(nobody_goes_for(Release::Repeated), Some(3));
    assert_eq!(nobody_goes_for(Release::Once), Some(3));
    assert_eq!(nobody_goes_for(Release::RepeatedAsRenewal), Some(4));
    assert_eq!(nobody_goes_for(Release::OnceAsRenewal), Some(6 + 1 + 1));
}
