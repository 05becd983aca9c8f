//! One robot's beliefs, fed with odometry and frames by hand: decisions in every third tick, frames whenever a test says so.

use crate::geometry::Pose;
use crate::geometry::Sighting;
use crate::geometry::unit;
use crate::geometry::wrap_angle;
use crate::ids::Team;
use crate::robot::{Eyes, Fix, Frame};
use crate::testing::perfect_sensing;
use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use bevy::ecs::system::RunSystemOnce;

use super::*;
use crate::data::Source;
use crate::ids::Team::{Away, Home};
use crate::rng::Seed;
use crate::robot::{MemorySpans, Sensing, reckon};
use crate::testing::{LANDMARKS, cye, idle, pitch};

struct Bench {
    world: World,
    robot: Entity,
    /// Where the robot believes it starts.
    start: Pose,
}

/// The shipped eyes: a ball is seen up to 3.2 m, 40° to either side. Every frame brings a fix that is believed at once if it
/// is far off.
fn real() -> Sensing {
    let text = include_str!("../../../assets/sensing/cye_2001.ron");
    let mut sensing: Sensing = Source::new("eyes.ron", text).parse().expect("the shipped eyes are sound");
    if let Eyes::Real { localisation, .. } = &mut sensing.eyes {
        localisation.landmarks = None;
    }
    sensing.memory = MemorySpans { ball: 3.0, robots: 2.0, ..MemorySpans::default() };
    sensing
}

/// The same, but fixes come with landmarks, and beliefs follow them.
fn among_landmarks() -> Sensing {
    let mut sensing = real();
    if let Eyes::Real { localisation, .. } = &mut sensing.eyes {
        localisation.landmarks = Some(LANDMARKS);
    }
    sensing
}

/// A fix as good as any.
fn full(pose: Pose) -> Option<Fix> {
    Some(Fix { pose, share: 1.0 })
}

impl Bench {
    fn new(sensing: Sensing, start: Pose) -> Bench {
        let (mut world, id) = (World::new(), RobotId::new(Home, 0));
        let clock = Clock::new(60.0);
        world.insert_resource(clock);
        world.insert_resource(pitch());
        let strategy = Arc::new(idle());
        world.insert_resource(Strategies([strategy.clone(), strategy]));
        let robot = Robot::new(Arc::new(cye()), Arc::new(sensing), &clock);
        let body = (Odometry::new(Seed(1), id), Handling::new(Seed(1), id));
        let senses = (Percepts::default(), body);
        let robot = world.spawn((id, robot, senses, Inbox::default(), WorldModel::told(start))).id();
        let mut bench = Bench { world, robot, start };
        bench.decide(0);
        bench
    }

    fn still() -> Bench {
        Bench::new(real(), Pose::default())
    }

    /// Decides at this tick; returns the beliefs.
    fn decide(&mut self, tick: u64) -> &WorldModel {
        assert_eq!(tick % 3, 0, "the robot does not decide in tick {tick}");
        self.world.resource_mut::<Clock>().tick = tick;
        self.world.run_system_once(update_world_models).expect("the system runs");
        self.world.get(self.robot).expect("the robot has beliefs")
    }

    /// The wheels report a way since the last decision, m ahead and rad.
    fn drive(&mut self, ahead: f32, turn: f32) {
        let mut odometry = self.world.get_mut::<Odometry>(self.robot).expect("the robot has wheels");
        odometry.pose = reckon(odometry.pose, Vec2::X * ahead, turn);
    }

    /// A frame arrives.
    fn show(&mut self, frame: Frame) {
        self.world.get_mut::<Percepts>(self.robot).expect("the robot has eyes").frame = Some(frame);
    }

    /// A frame without noise, taken where the robot started.
    fn frame(&self, taken: u64, ball: Option<Vec2>, robots: &[(Team, Vec2)]) -> Frame {
        let robots = robots.iter().map(|(team, at)| (*team, Sighting::of(*at, self.start))).collect();
        Frame {
            taken,
            ball: ball.map(|at| Sighting::of(at, self.start)),
            robots,
            fix: full(self.start),
            pan: 0.0,
            chin_down: false,
        }
    }

    /// A robot that stands still is shown this and decides at once.
    fn sees(&mut self, tick: u64, ball: Option<Vec2>, robots: &[(Team, Vec2)]) -> &WorldModel {
        self.show(self.frame(tick, ball, robots));
        self.decide(tick)
    }
}

fn v(x: f32, y: f32) -> Vec2 {
    Vec2::new(x, y)
}

#[track_caller]
fn assert_at(got: Vec2, want: Vec2, within: f32) {
    assert!(got.distance(want) <= within, "got {got}, want {want}");
}

#[track_caller]
fn assert_pose(got: Pose, want: Pose) {
    let turn = wrap_angle(got.heading - want.heading).abs();
    assert!(got.position.distance(want.position) < 1e-4 && turn < 1e-4, "got {got:?}, want {want:?}");
}

#[test]
fn between_frames_the_robot_follows_its_wheels_from_where_it_was_told_to_be() {
    let mut bench = Bench::new(real(), Pose::new(1.0, 1.0, FRAC_PI_2));
    bench.drive(0.5, 0.0);
    assert_pose(bench.decide(3).pose, Pose::new(1.0, 1.5, FRAC_PI_2));
    bench.drive(0.0, PI);
    assert_pose(bench.decide(6).pose, Pose::new(1.0, 1.5, -FRAC_PI_2));
    bench.drive(-0.25, 0.0);
    assert_pose(bench.decide(9).pose, Pose::new(1.0, 1.75, -FRAC_PI_2));
    assert_pose(bench.decide(12).pose, Pose::new(1.0, 1.75, -FRAC_PI_2));
}

#[test]
fn a_late_frame_places_the_ball_from_where_the_robot_looked_when_it_was_taken() {
    let mut bench = Bench::still();
    for tick in [3, 6] {
        bench.drive(0.0, FRAC_PI_2 / 3.0);
        bench.decide(tick);
    }
    bench.drive(0.0, FRAC_PI_2 / 3.0);
    bench.show(bench.frame(0, Some(v(2.0, 0.0)), &[(Away, v(1.0, 0.5))]));
    let model = bench.decide(9);
    assert_pose(model.pose, Pose::new(0.0, 0.0, FRAC_PI_2));
    assert_at(model.ball.expect("it was seen").position, v(2.0, 0.0), 1e-4);
    assert_at(model.robots[0].position, v(1.0, 0.5), 1e-4);
}

#[test]
fn a_frame_taken_between_two_decisions_is_placed_from_between_their_poses() {
    let mut bench = Bench::new(real(), Pose::new(0.0, 0.0, 3.0));
    bench.drive(0.0, 0.3);
    bench.decide(3);
    let taken_from = Pose::new(0.0, 0.0, 3.2);
    let ball = Some(Sighting { range: 2.0, bearing: 0.0 });
    bench.show(Frame { taken: 2, ball, robots: vec![], fix: full(taken_from), pan: 0.0, chin_down: false });
    let model = bench.decide(6);
    assert_at(model.ball.expect("it was seen").position, 2.0 * unit(3.2), 1e-4);
    assert_pose(model.pose, Pose::new(0.0, 0.0, 3.3));
}

#[test]
fn a_rolling_ball_is_believed_where_it_is_now_and_not_where_the_frame_showed_it() {
    let mut bench = Bench::new(real(), Pose::new(-4.0, 0.0, 0.0));
    let truth = |tick: u64| roll_on(v(-3.0, -0.5), v(1.2, 0.6), EXPECTED_ROLLING, tick as f32 / 60.0);
    for tick in (3..=90).step_by(3) {
        let taken = (tick - 9.min(tick)) / 6 * 6;
        bench.show(bench.frame(taken, Some(truth(taken).0), &[]));
        bench.decide(tick);
    }
    let ball = bench.decide(93).ball.expect("it was seen");
    let (position, velocity) = truth(93);
    // In the 0.15 s and more since the last frame it has rolled 0.15 m.
    assert_at(ball.position, position, 0.03);
    assert_at(ball.velocity, velocity, 0.1);
}

#[test]
fn between_frames_a_rolling_ball_rolls_on_and_slows_down() {
    let mut bench = Bench::new(perfect_sensing(), Pose::default());
    for tick in (0..=30).step_by(3) {
        bench.sees(tick, Some(v(1.0 + 0.6 * tick as f32 / 60.0, 0.0)), &[]);
    }
    let before = bench.decide(33).ball.expect("it was seen");
    let later = bench.decide(93).ball.expect("it is remembered");
    let (position, velocity) = roll_on(before.position, before.velocity, EXPECTED_ROLLING, 1.0);
    assert_at(later.position, position, 1e-4);
    assert_at(later.velocity, velocity, 1e-4);
    assert!(later.position.x > before.position.x + 0.2, "it rolled from {before:?} to {later:?}");
    assert_eq!(later.seen, 30);
}

#[test]
fn a_ball_that_rolls_away_is_not_believed_far_outside_the_pitch() {
    let mut bench = Bench::new(perfect_sensing(), Pose::new(3.0, 2.0, 0.0));
    for tick in (0..=30).step_by(3) {
        bench.sees(tick, Some(v(2.0 + 2.0 * tick as f32 / 60.0, 2.0)), &[]);
    }
    let ball = bench.decide(150).ball.expect("it is remembered");
    assert_at(ball.position, v(4.9, 2.0), 0.05);
}

#[test]
fn things_are_as_old_as_the_frame_that_showed_them() {
    let mut bench = Bench::still();
    bench.show(bench.frame(6, Some(v(1.0, 0.0)), &[(Home, v(2.0, 0.0))]));
    let model = bench.decide(15);
    assert_eq!((model.ball.expect("it was seen").seen, model.robots[0].seen), (6, 6));
}

#[test]
fn a_frame_is_taken_in_once_and_an_older_one_never() {
    let mut bench = Bench::still();
    bench.show(Frame { fix: full(Pose::new(0.5, 0.0, 0.0)), ..bench.frame(6, None, &[]) });
    let once = bench.decide(6).pose;
    assert_pose(once, Pose::new(0.1, 0.0, 0.0));
    assert_pose(bench.decide(9).pose, once);
    bench.show(Frame { fix: full(Pose::new(0.5, 0.0, 0.0)), ..bench.frame(3, Some(v(1.0, 0.0)), &[]) });
    let model = bench.decide(12);
    assert_pose(model.pose, once);
    assert_eq!(model.ball, None);
}

#[test]
fn a_fix_is_believed_in_part_a_jump_of_it_at_once_and_a_perfect_one_always() {
    let believed = |sensing, fix| {
        let mut bench = Bench::new(sensing, Pose::default());
        bench.show(Frame { fix: full(fix), ..bench.frame(3, None, &[]) });
        bench.decide(3).pose
    };
    assert_pose(believed(real(), Pose::new(0.9, 0.0, 0.5)), Pose::new(0.18, 0.0, 0.1));
    assert_pose(believed(real(), Pose::new(0.0, -1.1, 0.5)), Pose::new(0.0, -1.1, 0.5));
    assert_pose(believed(real(), Pose::new(0.1, 0.0, -0.8)), Pose::new(0.1, 0.0, -0.8));
    assert_pose(believed(perfect_sensing(), Pose::new(0.1, 0.0, 0.1)), Pose::new(0.1, 0.0, 0.1));
}

#[test]
fn a_late_jump_takes_the_way_that_was_driven_since_along() {
    let mut bench = Bench::still();
    for tick in [3, 6, 9] {
        bench.drive(0.1, 0.0);
        bench.decide(tick);
    }
    bench.show(Frame { fix: full(Pose::new(2.0, 1.0, FRAC_PI_2)), ..bench.frame(3, Some(v(1.0, 0.0)), &[]) });
    let model = bench.decide(12);
    assert_pose(model.pose, Pose::new(2.0, 1.2, FRAC_PI_2));
    // The ball was a metre ahead of where the robot then was.
    assert_at(model.ball.expect("it was seen").position, v(2.0, 2.0), 1e-4);
}

#[test]
fn a_ball_that_is_out_of_sight_is_forgotten_after_the_memorys_span_and_not_before() {
    // 90° to the left, where the camera never looks.
    let mut bench = Bench::still();
    bench.sees(6, Some(v(0.0, 1.0)), &[]);
    for tick in (9..=183).step_by(3) {
        let ball = bench.sees(tick, None, &[]).ball;
        assert!(ball.is_some(), "forgotten after {} s", (tick - 6) as f32 / 60.0);
    }
    assert_eq!(bench.sees(189, None, &[]).ball, None);
    assert_eq!(bench.sees(192, Some(v(0.0, 1.0)), &[]).ball.map(|ball| ball.seen), Some(192));
}

#[test]
fn a_ball_is_forgotten_after_six_frames_that_should_have_shown_it() {
    let mut bench = Bench::still();
    bench.sees(6, Some(v(1.0, 0.0)), &[]);
    (2..=6).for_each(|frame| assert!(bench.sees(6 * frame, None, &[]).ball.is_some(), "frame {frame}"));
    bench.sees(42, Some(v(1.0, 0.0)), &[]);
    (8..=12).for_each(|frame| assert!(bench.sees(6 * frame, None, &[]).ball.is_some(), "frame {frame}"));
    assert_eq!(bench.sees(78, None, &[]).ball, None);
}

#[test]
fn decisions_without_a_new_frame_are_no_missed_frames() {
    let mut bench = Bench::still();
    bench.sees(6, Some(v(1.0, 0.0)), &[]);
    bench.sees(12, None, &[]);
    for tick in (15..=120).step_by(3) {
        assert!(bench.decide(tick).ball.is_some(), "tick {tick}");
    }
}

#[test]
fn a_ball_at_the_edge_of_view_or_range_may_be_missed_for_the_memorys_span() {
    let sensing = real();
    let range = sensing.eyes.camera().map_or(0.0, |camera| camera.ball_range);
    for place in [2.0 * unit(0.65), v(0.75 * range, 0.0)] {
        let mut bench = Bench::still();
        bench.sees(6, Some(place), &[]);
        let kept = (2..=20).all(|frame| bench.sees(6 * frame, None, &[]).ball.is_some());
        assert!(kept, "a ball at {place} was forgotten");
    }
}

mod getting_on;
mod robots;
mod scrum;

#[test]
fn a_robot_knows_where_it_is_from_its_first_frame_on_or_when_it_was_told() {
    let place = Pose::new(0.5, 0.2, 0.1);
    let mut bench = Bench::new(real(), place);
    assert!(bench.decide(3).is_localised(), "people told it");
    bench.world.entity_mut(bench.robot).insert(WorldModel::default());
    assert!(!bench.decide(6).is_localised());
    let model = bench.sees(9, None, &[]);
    assert!(model.is_localised());
    assert!(
        model.pose.position.distance(place.position) < 1e-4,
        "the first frame is believed whole: {:?}",
        model.pose
    );
}

/// Frames with fixes of one share at a far place, from the first one on; where the robot believes it is after each.
fn kidnapped(share: f32, frames: u64) -> Vec<Pose> {
    let mut bench = Bench::new(among_landmarks(), Pose::default());
    let place = Pose::new(3.0, -2.0, 2.0);
    let frame =
        |bench: &Bench, tick| Frame { fix: Some(Fix { pose: place, share }), ..bench.frame(tick, None, &[]) };
    (1..=frames)
        .map(|number| {
            bench.show(frame(&bench, 6 * number));
            bench.decide(6 * number).pose
        })
        .collect()
}

#[test]
fn a_kidnap_is_not_cured_by_one_frame_but_by_some_seconds_of_fixes() {
    let place = Vec2::new(3.0, -2.0);
    let error = |pose: &Pose| pose.position.distance(place) / place.length();
    let beliefs = kidnapped(1.0, 100);
    assert!(error(&beliefs[0]) > 0.9, "{:?}", beliefs[0]);
    // The settle time is a second and a half, which are fifteen frames.
    assert!((error(&beliefs[14]) - 1.0 / std::f32::consts::E).abs() < 0.02, "{:?}", beliefs[14]);
    assert!(error(&beliefs[99]) < 0.01 && wrap_angle(beliefs[99].heading - 2.0).abs() < 0.02);
}

#[test]
fn a_weak_fix_moves_a_belief_less_and_a_frame_without_one_not_at_all() {
    let moved = |share| kidnapped(share, 1)[0].position.length();
    assert!(moved(0.5) < 0.6 * moved(1.0) && moved(0.5) > 0.4 * moved(1.0));
    let mut bench = Bench::new(among_landmarks(), Pose::default());
    bench.show(Frame { fix: None, ..bench.frame(3, Some(v(1.0, 0.0)), &[]) });
    let model = bench.decide(3);
    assert_pose(model.pose, Pose::default());
    assert!(model.ball.is_some());
}

#[test]
fn a_robot_that_knows_nothing_waits_for_a_full_fix_and_believes_it_at_once() {
    let mut bench = Bench::new(among_landmarks(), Pose::default());
    bench.world.entity_mut(bench.robot).insert(WorldModel::default());
    let pose = Pose::new(2.0, 1.0, 0.5);
    bench.show(Frame { fix: Some(Fix { pose, share: 0.9 }), ..bench.frame(3, None, &[]) });
    assert!(!bench.decide(3).is_localised());
    bench.show(Frame { fix: full(pose), ..bench.frame(6, None, &[]) });
    let model = bench.decide(6);
    assert!(model.is_localised());
    assert_pose(model.pose, pose);
}
