//! What a robot finds of its own getting on.

use super::*;

/// Told to move, and shown to stand where it is by every frame, while wheels or legs report this speed; how long it takes itself
/// to be stalled after 3 s.
fn stalled(reported: f32, shown: bool) -> f32 {
    let mut bench = Bench::new(among_landmarks(), Pose::default());
    for decision in 1..=60 {
        let mut odometry = bench.world.get_mut::<Odometry>(bench.robot).expect("the robot has wheels");
        odometry.told = 0.3;
        bench.drive(0.05 * reported, 0.0);
        if shown {
            bench.sees(3 * decision, None, &[]);
        } else {
            bench.decide(3 * decision);
        }
    }
    let clock = *bench.world.resource::<Clock>();
    bench.world.get::<WorldModel>(bench.robot).expect("the robot has beliefs").stalled_for(&clock)
}

#[test]
fn a_robot_is_stalled_if_its_wheels_stand_or_landmarks_show_that_its_legs_step_in_vain() {
    assert!((stalled(0.0, false) - 2.95).abs() < 0.01, "wheels");
    assert!(stalled(0.3, true) > 2.5, "legs");
    assert_eq!(stalled(0.3, false), 0.0, "nothing shows that it is held");
}
