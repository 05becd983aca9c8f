//! What holds whatever a robot sees and hears.

use proptest::prelude::*;

use super::*;

fn rules() -> impl Strategy<Value = Rules> {
    prop_oneof![
        Just(Rules::Paper(Update::Always)),
        Just(Rules::Paper(Update::Cautious)),
        Just(Rules::Lexicographic),
        any::<bool>().prop_map(|release| Rules::Hardened { release }),
    ]
}

/// Mostly numbers that mean something, sometimes any.
fn number(most: u32) -> impl Strategy<Value = u32> {
    prop_oneof![8 => 0..=most, 1 => any::<u32>(), 1 => Just(u32::MAX), 1 => Just(u32::MAX - 1)]
}

fn settings(rules: impl Strategy<Value = Rules>) -> impl Strategy<Value = BookingSettings> {
    (rules, number(3), number(6), number(4)).prop_map(|(rules, threshold, timeout, renewal)| {
        BookingSettings {
            rules,
            threshold: Distance(threshold),
            timeout: timeout.into(),
            renewal: renewal.into(),
        }
    })
}

fn turn() -> impl Strategy<Value = BookingInput> {
    prop::option::weighted(0.8, number(9))
        .prop_map(|distance| BookingInput::Turn { distance: distance.map(Distance) })
}

fn input() -> impl Strategy<Value = BookingInput> {
    let hear = (0..4_u8, number(9), number(9), number(9)).prop_map(|(from, distance, term, key)| {
        let book = Book { distance: Distance(distance), term, key: Distance(key) };
        BookingInput::Hear { from, book }
    });
    prop_oneof![3 => turn(), 3 => hear, 1 => Just(BookingInput::Withdraw)]
}

/// What may happen to a pair of robots.
#[derive(Clone, Copy, Debug)]
enum Event {
    Happens(usize, BookingInput),
    /// The oldest message that this robot has not heard arrives.
    Arrives(usize),
    Passes,
}

fn event() -> impl Strategy<Value = Event> {
    prop_oneof![
        4 => (0..2_usize, turn()).prop_map(|(robot, turn)| Event::Happens(robot, turn)),
        1 => (0..2_usize).prop_map(|robot| Event::Happens(robot, BookingInput::Withdraw)),
        3 => (0..2_usize).prop_map(Event::Arrives),
        3 => Just(Event::Passes),
    ]
}

/// Two robots of which each hears the other in order.
struct Pair {
    robots: [B3p; 2],
    unheard: [Vec<Book>; 2],
    now: OwnTick,
}

impl Pair {
    fn new(settings: BookingSettings) -> Pair {
        Pair { robots: [0, 1].map(|me| B3p::new(me, settings)), unheard: [vec![], vec![]], now: 0 }
    }

    fn happens(&mut self, robot: usize, input: BookingInput) {
        let said = self.robots[robot].step(self.now, input);
        self.unheard[1 - robot].extend(said);
    }

    fn arrives(&mut self, robot: usize) {
        if !self.unheard[robot].is_empty() {
            let book = self.unheard[robot].remove(0);
            self.happens(robot, BookingInput::Hear { from: 1 - robot as PlayerNumber, book });
        }
    }

    fn hear_all(&mut self) {
        for robot in [0, 1] {
            while !self.unheard[robot].is_empty() {
                self.arrives(robot);
            }
        }
    }

    fn going(&self) -> usize {
        self.robots.iter().filter(|robot| robot.goes()).count()
    }
}

proptest! {
    #[test]
    fn a_robot_survives_anything_and_goes_only_if_it_sees_the_ball_and_has_it_booked(
        settings in settings(rules()), inputs in prop::collection::vec((number(9), input()), 0..60),
    ) {
        let mut robot = B3p::new(1, settings);
        let mut sees = false;
        for (now, input) in inputs {
            let said = robot.step(now.into(), input);
            match input {
                BookingInput::Turn { distance } => sees = distance.is_some_and(|distance| !distance.is_infinite()),
                BookingInput::Withdraw => sees = false,
                BookingInput::Hear { .. } => prop_assert_eq!(said, None),
            }
            let books = robot.booking().is_some_and(|known| known.robot_booker == 1);
            prop_assert_eq!(robot.goes(), sees && books);
            let told = robot.booking().map(|known| (known.distance, known.term, known.key));
            prop_assert!(said.is_none_or(|said| Some((said.distance, said.term, said.key)) == told && books));
        }
    }

    #[test]
    fn terms_never_go_back(
        settings in settings(any::<bool>().prop_map(|release| Rules::Hardened { release })),
        inputs in prop::collection::vec(input(), 0..60),
    ) {
        let mut robot = B3p::new(1, settings);
        let mut newest = 0;
        for (now, input) in (0..).zip(inputs) {
            robot.step(now, input);
            let term = robot.booking().map_or(newest, |known| known.term);
            prop_assert!(term >= newest);
            newest = term;
        }
    }

    #[test]
    fn a_robot_that_sees_the_ball_gets_it_in_the_end_if_all_others_fall_silent(
        settings in settings(rules()), inputs in prop::collection::vec(input(), 0..60),
    ) {
        let mut robot = B3p::new(1, settings);
        for (now, input) in (0..).zip(inputs) {
            robot.step(now, input);
        }
        robot.step(settings.timeout + 61, BookingInput::Turn { distance: Some(Distance(5)) });
        prop_assert!(robot.goes());
    }

    #[test]
    fn of_two_hardened_robots_that_have_heard_all_at_most_one_goes(
        settings in settings(any::<bool>().prop_map(|release| Rules::Hardened { release })),
        events in prop::collection::vec(event(), 0..60),
    ) {
        let mut pair = Pair::new(settings);
        for event in events {
            match event {
                Event::Happens(robot, input) => pair.happens(robot, input),
                Event::Arrives(robot) => pair.arrives(robot),
                Event::Passes => pair.now += 1,
            }
        }
        pair.hear_all();
        prop_assert!(pair.going() <= 1);
    }

    #[test]
    fn two_robots_come_back_from_any_forgery_to_exactly_one_that_goes(
        release in any::<bool>(), distances in [0..9_u32, 0..9_u32],
        forgeries in prop::collection::vec((0..2_usize, input()), 0..20),
    ) {
        let rules = Rules::Hardened { release };
        let mut pair = Pair::new(BookingSettings { rules, threshold: Distance(1), timeout: 3, renewal: 1 });
        for (robot, input) in forgeries {
            pair.happens(robot, input);
            pair.now += 1;
        }
        for _ in 0..12 {
            for robot in [0, 1] {
                pair.happens(robot, BookingInput::Turn { distance: Some(Distance(distances[robot])) });
            }
            pair.hear_all();
            pair.now += 1;
        }
        prop_assert_eq!(pair.going(), 1);
    }
}
