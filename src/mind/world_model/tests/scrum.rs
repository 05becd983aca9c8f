//! Beliefs about a ball among robots.

use super::*;

/// Eyes in a scrum: two readings move a ball, half a second hides one, and robots within 0.4 m touch one.
fn scrum() -> Bench {
    let memory =
        MemorySpans { hidden_ball: Some(0.5), touched_ball: 0.4, jump_readings: 2, ball: 3.0, robots: 2.0 };
    Bench::new(Sensing { memory, ..real() }, Pose::default())
}

/// The first frame, of ten a second, after which the ball is gone that a robot hides.
fn given_up(mut bench: Bench) -> Option<u64> {
    bench.sees(3, Some(v(1.5, 0.0)), &[]);
    bench.sees(6, Some(v(1.5, 0.0)), &[]);
    (2..=25).find(|frame| bench.sees(6 * frame, None, &[(Away, v(0.8, 0.0))]).ball.is_none())
}

#[test]
fn a_hidden_ball_is_missed_after_half_a_second_and_never_without_that_switch() {
    // Five frames are excused, the sixth miss ends the belief.
    let frame = given_up(scrum()).expect("it is given up");
    assert!((11..=13).contains(&frame), "{frame}");
    assert_eq!(given_up(Bench::still()), None, "it is remembered for the memory's span");
}

#[test]
fn a_ball_that_comes_out_again_begins_anew() {
    let mut bench = scrum();
    bench.sees(3, Some(v(1.5, 0.0)), &[]);
    for round in 0..4 {
        let tick = |frame: u64| 6 * (10 * round + frame + 1);
        bench.sees(tick(0), Some(v(1.5, 0.0)), &[]);
        let kept = (1..10).all(|frame| bench.sees(tick(frame), None, &[(Away, v(0.8, 0.0))]).ball.is_some());
        assert!(kept, "round {round}");
    }
}

/// What is believed of the speed of a ball that was seen at 0.6 m/s beside a robot this far from it.
fn speed_beside(mut bench: Bench, gap: f32) -> f32 {
    for frame in 0..=15 {
        let ball = v(1.0 + 0.06 * frame as f32, 0.0);
        bench.sees(6 * (frame + 1), Some(ball), &[(Away, ball + v(0.0, gap))]);
    }
    bench.decide(99).ball.expect("it was seen").velocity.length()
}

#[test]
fn the_velocity_of_a_ball_is_unknown_while_a_robot_touches_it() {
    assert_eq!(speed_beside(scrum(), 0.3), 0.0);
    assert!(speed_beside(scrum(), 0.6) > 0.4);
    assert!(speed_beside(Bench::still(), 0.3) > 0.4, "off by default");
}

#[test]
fn one_phantom_moves_no_ball_and_two_readings_of_one_place_do() {
    let mut bench = scrum();
    for frame in 1..=5 {
        bench.sees(6 * frame, Some(v(1.5, 0.0)), &[]);
    }
    let phantom = bench.sees(36, Some(v(2.0, 1.2)), &[]).ball.expect("it is believed in");
    assert_at(phantom.position, v(1.5, 0.0), 0.05);
    let other = bench.sees(42, Some(v(2.0, -1.2)), &[]).ball.expect("it is believed in");
    assert_at(other.position, v(1.5, 0.0), 0.05);
    let moved = bench.sees(48, Some(v(2.0, -1.3)), &[]).ball.expect("it is believed in");
    assert_at(moved.position, v(2.0, -1.3), 0.05);
    assert_eq!(moved.seen, 48);
}

#[test]
fn one_phantom_makes_no_ball_and_two_readings_of_one_place_do() {
    let mut bench = scrum();
    assert_eq!(bench.sees(6, Some(v(1.5, 0.3)), &[]).ball, None);
    assert_eq!(bench.sees(12, Some(v(2.0, -1.2)), &[]).ball, None);
    bench.sees(18, None, &[]);
    let seen = bench.sees(24, Some(v(2.0, -1.1)), &[]).ball.expect("it was seen twice");
    assert_at(seen.position, v(2.0, -1.1), 1e-4);
    assert!(Bench::still().sees(6, Some(v(1.5, 0.3)), &[]).ball.is_some(), "off by default");
}
