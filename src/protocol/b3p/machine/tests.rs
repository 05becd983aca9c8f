//! The rows of figure 5, and what the other rules make of them.

use super::*;

const RULES: [Rules; 5] = [
    Rules::Paper(Update::Always),
    Rules::Paper(Update::Cautious),
    Rules::Lexicographic,
    Rules::Hardened { release: false },
    Rules::Hardened { release: true },
];
const ALWAYS: Rules = RULES[0];
const CAUTIOUS: Rules = RULES[1];
const LEXICOGRAPHIC: Rules = RULES[2];
const HARDENED: Rules = RULES[3];
const RELEASING: Rules = RULES[4];

fn settings(rules: Rules) -> BookingSettings {
    BookingSettings { rules, threshold: Distance(100), timeout: 10, renewal: 3 }
}

/// Robot 1, which knows nothing.
fn robot(rules: Rules) -> B3p {
    B3p::new(1, settings(rules))
}

/// Robot 1, which has heard at tick 0 that robot 2 booked the ball at 500.
fn told(rules: Rules) -> B3p {
    let mut robot = robot(rules);
    hear(&mut robot, 0, 2, book(1, 500, 500));
    assert_eq!(robot.booking().map(|known| known.robot_booker), Some(2));
    robot
}

/// Robot 1, which booked the ball at tick 0 and at 500.
fn booker(rules: Rules) -> B3p {
    let mut robot = robot(rules);
    assert!(see(&mut robot, 0, 500).is_some());
    robot
}

fn book(term: BookingTerm, key: u32, distance: u32) -> Book {
    Book { distance: Distance(distance), term, key: Distance(key) }
}

fn see(robot: &mut B3p, now: OwnTick, distance: u32) -> Option<Book> {
    robot.step(now, BookingInput::Turn { distance: Some(Distance(distance)) })
}

fn see_nothing(robot: &mut B3p, now: OwnTick) -> Option<Book> {
    robot.step(now, BookingInput::Turn { distance: None })
}

/// Whether the robot believes it.
fn hear(robot: &mut B3p, now: OwnTick, from: PlayerNumber, book: Book) -> bool {
    assert_eq!(robot.step(now, BookingInput::Hear { from, book }), None, "hearing is not answered");
    robot.booking().is_some_and(|known| (known.robot_booker, known.distance) == (from, book.distance))
}

#[test]
fn a_free_ball_is_booked_and_that_is_announced() {
    for rules in RULES {
        let mut robot = robot(rules);
        assert!(!robot.is_booked(7) && !robot.goes());
        let term = BookingTerm::from(robot.counts_terms());
        assert_eq!(see(&mut robot, 7, 500), Some(book(term, 500, 500)));
        let (distance, key) = (Distance(500), Distance(500));
        assert_eq!(
            robot.booking(),
            Some(&KnownBooking { robot_booker: 1, distance, timestamp: 7, term, key })
        );
        assert!(robot.is_booked(7) && robot.goes());
    }
}

#[test]
fn a_booker_renews_with_every_turn_and_says_so_now_and_then() {
    for rules in RULES {
        let mut robot = booker(rules);
        let said: Vec<_> = (1..=6).map(|now| see(&mut robot, now, 500 + now as u32)).collect();
        let (term, key) = if robot.counts_terms() { (1, [500, 500]) } else { (0, [503, 506]) };
        let (third, sixth) = (book(term, key[0], 503), book(term, key[1], 506));
        assert_eq!(said, [None, None, Some(third), None, None, Some(sixth)]);
        let known = robot.booking().copied().expect("it is the booker");
        assert_eq!((known.distance, known.timestamp), (Distance(506), 6));
    }
}

#[test]
fn a_ball_that_a_mate_has_booked_is_left_alone() {
    for rules in RULES {
        let mut robot = told(rules);
        assert_eq!(see(&mut robot, 10, 500), None);
        assert_eq!(see(&mut robot, 10, 401), None, "nearer, but not by the threshold");
        assert!(robot.is_booked(10) && !robot.goes());
    }
}

#[test]
fn a_robot_nearer_by_the_threshold_takes_the_ball() {
    for rules in RULES {
        let mut robot = told(rules);
        let term = if robot.counts_terms() { 2 } else { 0 };
        assert_eq!(see(&mut robot, 10, 400), Some(book(term, 400, 400)));
        assert!(robot.goes());
    }
}

#[test]
fn a_booking_that_is_not_renewed_expires_after_the_timeout() {
    for rules in RULES {
        let mut robot = told(rules);
        assert_eq!(see(&mut robot, 10, 900), None);
        assert!(robot.is_booked(10) && !robot.is_booked(11));
        assert!(see(&mut robot, 11, 900).is_some());
        assert!(robot.goes());
    }
}

#[test]
fn a_renewal_is_believed_and_holds_the_ball_for_a_timeout_more() {
    for rules in RULES {
        let mut robot = told(rules);
        assert!(hear(&mut robot, 9, 2, book(1, 500, 700)));
        assert_eq!(see(&mut robot, 19, 601), None);
        assert_eq!(see(&mut robot, 19, 600).map(|book| book.distance), Some(Distance(600)));
    }
}

#[test]
fn without_the_ball_in_sight_nobody_books_or_goes() {
    for rules in RULES {
        let mut robot = robot(rules);
        assert_eq!(see_nothing(&mut robot, 0), None);
        assert_eq!(robot.step(0, BookingInput::Turn { distance: Some(Distance::INFINITE) }), None);
        assert!(!robot.goes() && !robot.is_booked(0));
        let mut robot = booker(rules);
        see_nothing(&mut robot, 1);
        assert!(!robot.goes());
    }
}

#[test]
fn who_always_updates_believes_everybody() {
    assert!(hear(&mut told(ALWAYS), 5, 3, book(0, 0, 9000)));
    assert!(hear(&mut booker(ALWAYS), 5, 3, book(0, 0, 500)));
}

#[test]
fn who_updates_cautiously_believes_only_whom_it_would_have_let_book() {
    assert!(!hear(&mut told(CAUTIOUS), 10, 3, book(0, 0, 401)));
    assert!(hear(&mut told(CAUTIOUS), 10, 3, book(0, 0, 400)));
    assert!(hear(&mut told(CAUTIOUS), 11, 3, book(0, 0, 9000)), "the booking it knew has expired");
    assert!(!hear(&mut booker(CAUTIOUS), 5, 3, book(0, 0, 500)), "so both go");
}

#[test]
fn lexicographic_robots_believe_the_smaller_distance_then_the_smaller_number() {
    let mut robot = told(LEXICOGRAPHIC);
    assert!(!hear(&mut robot, 5, 3, book(0, 0, 501)));
    assert!(!hear(&mut robot, 5, 3, book(0, 0, 500)));
    assert!(hear(&mut robot, 5, 0, book(0, 0, 500)));
    assert!(hear(&mut robot, 5, 3, book(0, 0, 499)));
    assert!(hear(&mut told(LEXICOGRAPHIC), 11, 3, book(0, 0, 9000)), "the booking it knew has expired");
}

#[test]
fn hardened_robots_believe_the_greater_term_then_the_smaller_key_then_the_smaller_number() {
    for rules in [HARDENED, RELEASING] {
        let mut robot = told(rules);
        assert!(hear(&mut robot, 5, 2, book(5, 500, 600)));
        assert!(!hear(&mut robot, 5, 0, book(4, 0, 0)), "an older term");
        assert!(!hear(&mut robot, 50, 0, book(4, 0, 0)), "not even after the timeout");
        assert!(!hear(&mut robot, 5, 3, book(5, 500, 0)));
        assert!(hear(&mut robot, 5, 0, book(5, 500, 9000)));
        assert!(hear(&mut robot, 5, 3, book(5, 499, 9001)));
        assert!(hear(&mut robot, 5, 2, book(6, 9000, 9000)));
        assert_eq!(see(&mut robot, 5, 0).map(|book| book.term), Some(7));
    }
}

#[test]
fn a_hardened_booker_that_hears_of_an_equal_claim_yields_to_the_smaller_number() {
    let mut robot = booker(HARDENED);
    assert!(!hear(&mut robot, 1, 2, book(1, 500, 500)) && robot.goes());
    assert!(hear(&mut robot, 1, 0, book(1, 500, 500)) && !robot.goes());
}

#[test]
fn a_booker_that_loses_sight_is_silent() {
    for rules in [ALWAYS, CAUTIOUS, LEXICOGRAPHIC, HARDENED] {
        let mut robot = booker(rules);
        assert!((1..=30).all(|now| see_nothing(&mut robot, now).is_none()));
        assert!(robot.is_booked(10) && !robot.is_booked(11));
        assert!(see(&mut robot, 31, 500).is_some(), "it books anew");
    }
}

#[test]
fn a_booker_that_releases_books_the_ball_at_infinity_and_repeats_that_until_the_timeout() {
    let mut robot = booker(RELEASING);
    let said: Vec<_> = (1..=20).filter_map(|now| Some((now, see_nothing(&mut robot, now)?))).collect();
    let release = Book { distance: Distance::INFINITE, term: 2, key: Distance::INFINITE };
    assert_eq!(said, [(1, release), (4, release), (7, release), (10, release)]);
    assert!(!robot.is_booked(1));
    assert_eq!(see(&mut robot, 21, 600), Some(book(3, 600, 600)));
}

#[test]
fn whoever_sees_a_released_ball_books_it() {
    let mut robot = told(RELEASING);
    let release = Book { distance: Distance::INFINITE, term: 2, key: Distance::INFINITE };
    assert!(hear(&mut robot, 1, 2, release) && !robot.is_booked(1));
    assert!(!hear(&mut robot, 1, 2, book(1, 500, 500)), "an old renewal does not take it back");
    assert_eq!(see(&mut robot, 1, 9000), Some(book(3, 9000, 9000)));
}

#[test]
fn a_robot_that_withdraws_frees_its_booking_and_no_other() {
    for rules in RULES {
        let mut robot = booker(rules);
        let said = robot.step(1, BookingInput::Withdraw);
        assert_eq!(said.is_some(), rules == RELEASING);
        assert!(!robot.goes() && !robot.is_booked(1));
        let term = if robot.counts_terms() { 2 + BookingTerm::from(rules == RELEASING) } else { 0 };
        assert_eq!(see(&mut robot, 2, 500), Some(book(term, 500, 500)));
        let mut robot = told(rules);
        assert_eq!(robot.step(1, BookingInput::Withdraw), None);
        assert!(robot.is_booked(1));
    }
}

#[test]
fn a_robot_that_restarts_knows_nothing() {
    for rules in RULES {
        for mut robot in [booker(rules), told(rules)] {
            robot.restart();
            assert_eq!(robot, B3p::new(1, settings(rules)));
        }
    }
}

#[test]
fn a_robot_does_not_hear_itself() {
    for rules in RULES {
        let mut robot = booker(rules);
        let before = robot.clone();
        hear(&mut robot, 1, 1, book(9, 0, 0));
        assert_eq!(robot, before);
    }
}

#[test]
fn in_the_last_term_the_key_decides_and_an_expired_booking_gives_way() {
    let mut robot = told(HARDENED);
    assert!(hear(&mut robot, 0, 2, book(BookingTerm::MAX, 300, 800)));
    assert_eq!(see(&mut robot, 1, 301), None, "nearer, but its key would not prevail");
    assert!(!hear(&mut robot, 10, 3, book(BookingTerm::MAX, 400, 400)));
    assert!(hear(&mut robot, 11, 3, book(BookingTerm::MAX, 400, 900)));
    assert_eq!(see(&mut robot, 12, 399), Some(book(BookingTerm::MAX, 399, 399)));
    assert!(!hear(&mut robot, 12, 3, book(BookingTerm::MAX, 400, 900)) && robot.goes());
}

#[test]
fn rules_are_written_as_a_strategy_has_them() {
    let written = [
        "Paper(Always)",
        "Paper(Cautious)",
        "Lexicographic",
        "Hardened(release: false)",
        "Hardened(release: true)",
    ];
    for (rules, written) in RULES.into_iter().zip(written) {
        assert_eq!(ron::from_str::<Rules>(written), Ok(rules));
    }
}

#[test]
fn times_and_thresholds_at_their_limits_do_no_harm() {
    for rules in RULES {
        let limits =
            BookingSettings { rules, threshold: Distance::INFINITE, timeout: OwnTick::MAX, renewal: 0 };
        let mut robot = B3p::new(PlayerNumber::MAX, limits);
        assert!(see(&mut robot, OwnTick::MAX, u32::MAX - 1).is_some());
        assert!(see(&mut robot, 0, 0).is_some(), "a clock that goes back");
        hear(&mut robot, 0, 0, book(BookingTerm::MAX, u32::MAX, u32::MAX));
        see(&mut robot, OwnTick::MAX, 0);
        assert!(robot.booking().is_some());
    }
}

#[test]
fn a_robot_set_back_in_time_goes_on_as_it_would_have() {
    let mut robot = told(HARDENED);
    let mut set_back = robot.clone();
    set_back.rebase(4, 104, 1);
    assert_eq!(set_back.booking().map(|known| (known.timestamp, known.term)), Some((100, 0)));
    assert_eq!(see(&mut set_back, 110, 900), None);
    assert_eq!(see(&mut set_back, 111, 900), Some(book(1, 900, 900)));
    assert_eq!(see(&mut robot, 11, 900), Some(book(2, 900, 900)));
    robot.rebase(11, 111, 1);
    assert_eq!(robot, set_back);
}
