//! Beliefs about the other robots.

use super::*;
use crate::geometry::Pose;
use crate::ids::Team;
use crate::mind::world_model::beliefs::MOST_OF_A_TEAM;

fn places(model: &WorldModel, team: Team) -> Vec<Vec2> {
    model.of_team(team).collect()
}

#[test]
fn a_robot_that_moves_a_little_is_the_same_robot_and_one_of_the_other_team_another() {
    let mut bench = Bench::still();
    bench.sees(6, None, &[(Home, v(2.0, 0.0))]);
    let model = bench.sees(12, None, &[(Home, v(2.5, 0.0)), (Away, v(2.0, 0.0))]);
    assert_eq!(model.robots.len(), 2);
    assert_at(places(model, Home)[0], v(2.3, 0.0), 1e-4);
    assert_at(places(model, Away)[0], v(2.0, 0.0), 1e-4);
    assert!(model.robots.iter().all(|robot| robot.seen == 12));
}

#[test]
fn perfect_eyes_place_robots_where_they_are() {
    let mut bench = Bench::new(perfect_sensing(), Pose::default());
    bench.sees(3, None, &[(Away, v(2.0, 0.0))]);
    assert_at(places(bench.sees(6, None, &[(Away, v(2.5, 0.4))]), Away)[0], v(2.5, 0.4), 1e-4);
}

#[test]
fn two_sightings_in_one_frame_are_two_robots_however_near() {
    let mut bench = Bench::still();
    let pair = [(Away, v(2.0, 0.15)), (Away, v(2.0, -0.15))];
    for frame in 1..=5 {
        let model = bench.sees(6 * frame, None, &pair);
        assert_eq!(model.robots.len(), 2, "frame {frame}");
    }
    assert!(bench.decide(33).robots.iter().all(|robot| robot.seen == 30));
}

#[test]
fn of_two_known_robots_the_nearer_one_is_renewed() {
    let mut bench = Bench::still();
    bench.sees(6, None, &[(Away, v(2.0, 0.5)), (Away, v(2.0, -0.5))]);
    let model = bench.sees(12, None, &[(Away, v(2.0, -0.1))]);
    let seen: Vec<_> = model.robots.iter().map(|robot| (robot.position.y > 0.0, robot.seen)).collect();
    assert_eq!(seen, [(true, 6), (false, 12)]);
}

#[test]
fn a_robot_is_forgotten_after_the_memorys_span_and_not_before() {
    let mut bench = Bench::still();
    bench.sees(6, None, &[(Away, v(2.0, 0.5)), (Home, v(2.0, -0.5))]);
    bench.sees(60, None, &[(Home, v(2.0, -0.5))]);
    assert_eq!(bench.decide(123).robots.len(), 2);
    let model = bench.decide(129);
    assert_eq!((places(model, Home).len(), places(model, Away).len()), (1, 0));
}

#[test]
fn a_far_robot_may_be_farther_off_than_a_near_one_and_still_be_the_same() {
    let beliefs = |first: f32, second: f32| {
        let mut bench = Bench::still();
        bench.sees(6, None, &[(Away, v(first, 0.0))]);
        bench.sees(12, None, &[(Away, v(second, 0.0))]).robots.len()
    };
    assert_eq!(beliefs(1.0, 1.8), 2);
    assert_eq!(beliefs(3.2, 4.0), 1);
}

#[test]
fn two_beliefs_of_one_robot_become_one_where_they_meet() {
    let mut bench = Bench::still();
    let beliefs: Vec<usize> = [1.5, 2.5, 2.25, 1.9, 2.1, 2.0]
        .iter()
        .zip(1..)
        .map(|(x, frame)| bench.sees(6 * frame, None, &[(Away, v(*x, 0.0))]).robots.len())
        .collect();
    assert_eq!(beliefs, [1, 2, 2, 2, 2, 1]);
    assert_eq!(bench.decide(39).robots[0].seen, 36, "the newer one is kept");
}

#[test]
fn the_robots_believed_in_are_bounded_and_the_longest_unseen_give_way() {
    let memory = MemorySpans { ball: 3.0, robots: 1e6, ..MemorySpans::default() };
    let mut bench = Bench::new(Sensing { memory, ..perfect_sensing() }, Pose::default());
    let place = |frame: u64| v(1.0 + (frame % 5) as f32, -4.0 + 0.8 * (frame / 5) as f32);
    bench.sees(6, None, &[(Home, v(-3.0, 0.0))]);
    for frame in 2..40 {
        bench.sees(6 * frame, None, &[(Away, place(frame))]);
    }
    let model = bench.decide(240);
    assert_eq!(places(model, Home).len(), 1, "each team has a bound of its own");
    assert_eq!(places(model, Away).len(), MOST_OF_A_TEAM);
    let oldest = model.robots.iter().filter(|robot| robot.team == Away).map(|robot| robot.seen).min();
    assert_eq!(oldest, Some(6 * (40 - MOST_OF_A_TEAM as u64)));
}
