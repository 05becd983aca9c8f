//! Who serves a penalty of a box keeps nothing that its team mates could need.

use super::*;

#[test]
fn a_penalised_robot_is_off_lets_its_booking_go_and_comes_back_when_the_box_says_so() {
    let mut refereed = Refereed::playing(plan("four_legged_2005", ["chaos_b3p", "chaos_plain"], 10.0));
    let booker = refereed.until_the_ball_is_booked();
    let robot = RobotId::new(Team::Home, booker);
    assert_eq!(refereed.orders(robot), (RobotState::Playing, false));
    let pushed = Penalised { player: booker, penalty: Penalty::Pushing, seconds_left: 30 };
    refereed.say(|says| says.penalties[0] = vec![pushed]);
    assert_eq!(refereed.orders(robot), (RobotState::Penalised, true));
    // Two decisions and the time of a message, while a booking that nobody withdraws expires after 48 ticks.
    refereed.ticks(6);
    for _ in 0..600 {
        assert!(refereed.bookings().iter().all(|(_, of)| *of != booker));
        assert_eq!(refereed.orders(robot), (RobotState::Penalised, true));
        refereed.ticks(1);
    }
    refereed.say(|says| says.penalties[0].clear());
    assert_eq!(refereed.orders(robot), (RobotState::Playing, false));
    assert!(refereed.game.state().removed.is_empty());
    let (pose, _) = crate::support::robot(&mut refereed.game, Team::Home, booker);
    assert!(refereed.game.world().resource::<Pitch>().holds(pose.position, 0.0), "{pose:?}");
}

#[test]
fn a_robot_that_serves_its_penalty_where_it_stands_lets_its_booking_go() {
    let mut refereed = Refereed::playing(plan("four_legged_2005", ["chaos_b3p", "chaos_plain"], 10.0));
    let booker = refereed.until_the_ball_is_booked();
    let robot = RobotId::new(Team::Home, booker);
    let moved = Penalised { player: booker, penalty: Penalty::MotionInSet, seconds_left: 15 };
    refereed.say(|says| says.penalties[0] = vec![moved]);
    assert_eq!(refereed.orders(robot), (RobotState::Penalised, false));
    // Two decisions and the time of a message.
    refereed.ticks(6);
    for _ in 0..600 {
        assert!(refereed.bookings().iter().all(|(_, of)| *of != booker));
        refereed.ticks(1);
    }
}

#[test]
fn a_robot_that_serves_its_penalty_where_it_stands_lets_its_claim_go() {
    let mut refereed = Refereed::playing(talkative(10.0));
    let claimant = loop {
        refereed.ticks(1);
        if let Some(claimant) = refereed.claimants().first() {
            break *claimant;
        }
        assert!(refereed.game.clock().now() < 60.0, "nobody claims the ball");
    };
    let RobotId { team, number: player } = claimant;
    let moved = Penalised { player, penalty: Penalty::MotionInSet, seconds_left: 15 };
    refereed.say(|says| says.penalties[team.index()] = vec![moved]);
    // Until its next decision.
    refereed.ticks(6);
    for _ in 0..300 {
        assert!(!refereed.claimants().contains(&claimant));
        refereed.ticks(1);
    }
}
