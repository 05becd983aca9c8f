//! Frames on their way from the shutter to the robot, and what its wheels report.

use crate::ids::Team;
use crate::robot::Camera;
use crate::robot::Eyes;
use crate::robot::Frame;
use crate::robot::MemorySpans;
use crate::robot::Odometry;
use crate::robot::Percepts;
use crate::robot::Sensing;
use bevy::ecs::system::RunSystemOnce;
use std::sync::Arc;

use super::*;
use crate::data::Source;
use crate::geometry::Twist;
use crate::ids::Team::{Away, Home};
use crate::rng::Seed;
use crate::robot::{DriveCommand, OdometryNoise, OdometrySource, PlaceError, RobotKind, WheelSpeeds};
use crate::testing::{BALL, LANDMARKS, cye, pitch};
use crate::world::referee::RuleBook;

/// SeenBodies and eyes, moved by hand.
struct Bench(World);

/// Eyes that miss nothing in view and make no errors.
fn sharp(latency: f32) -> Sensing {
    let text = include_str!("../../../assets/sensing/cye_2001.ron");
    let mut sensing: Sensing = Source::new("eyes.ron", text).parse().expect("the shipped eyes are sound");
    if let Eyes::Real { camera, localisation, .. } = &mut sensing.eyes {
        *camera = Camera { latency, detection: 1.0, range_noise: 0.0, range_floor: 0.0, ..*camera };
        *camera = Camera { bearing_noise: 0.0, false_positive: 0.0, wrong_team: 0.0, ..*camera };
        (localisation.position, localisation.heading) = (0.0, 0.0);
        localisation.landmarks = None;
    }
    sensing
}

fn perfect() -> Sensing {
    let memory = MemorySpans { ball: 3.0, robots: 2.0, ..MemorySpans::default() };
    Sensing { name: "perfect".into(), eyes: Eyes::Perfect, memory }
}

fn noisy() -> Sensing {
    let text = include_str!("../../../assets/sensing/cye_2001.ron");
    Source::new("eyes.ron", text).parse().expect("the shipped eyes are sound")
}

impl Bench {
    fn new(ball: Vec2) -> Bench {
        let mut world = World::new();
        world.insert_resource(Clock::new(60.0));
        world.insert_resource(MatchState::new(Home, &RuleBook::default()));
        world.insert_resource(pitch());
        world.insert_resource(BALL);
        world.spawn((Ball, Pose { position: ball, heading: 0.0 }));
        Bench(world)
    }

    fn robot(&mut self, sensing: &Sensing, team: Team, number: u8, pose: Pose) -> Entity {
        self.robot_of(cye(), sensing, team, number, pose)
    }

    fn robot_of(&mut self, kind: RobotKind, sensing: &Sensing, team: Team, number: u8, pose: Pose) -> Entity {
        let id = RobotId::new(team, number);
        let robot = Robot::new(Arc::new(kind), Arc::new(sensing.clone()), self.0.resource());
        let eyesight = Eyesight::new(sensing, Seed(1), id);
        let drive = (Twist::default(), DriveCommand::idle(&robot.kind), Odometry::new(Seed(1), id));
        let senses = (Head::default(), Handling::new(Seed(1), id), eyesight, Percepts::default());
        self.0.spawn((id, robot, pose, senses, drive)).id()
    }

    /// Runs the stage at this tick; returns what the robot has seen.
    fn sense(&mut self, tick: u64, robot: Entity) -> Option<Frame> {
        self.0.resource_mut::<Clock>().tick = tick;
        self.0.run_system_once(take_frames).expect("the system runs");
        self.0.run_system_once(deliver_frames).expect("the system runs");
        self.0.run_system_once(read_odometry).expect("the system runs");
        self.0.get::<Percepts>(robot).expect("the robot has eyes").frame.clone()
    }

    /// When which frame arrived: tick of arrival and tick of the shutter.
    fn arrivals(&mut self, ticks: u64, robot: Entity) -> Vec<(u64, u64)> {
        let mut newest = None;
        let mut arrivals = Vec::new();
        for tick in 0..ticks {
            let taken = self.sense(tick, robot).map(|frame| frame.taken);
            if taken != newest {
                arrivals.extend(taken.map(|taken| (tick, taken)));
                newest = taken;
            }
        }
        arrivals
    }

    fn odometry(&mut self, tick: u64, robot: Entity) -> Odometry {
        self.sense(tick, robot);
        self.0.get::<Odometry>(robot).expect("the robot has wheels").clone()
    }
}

fn team_and_range(frame: &Frame) -> Vec<(Team, f32)> {
    frame.robots.iter().map(|(team, sighting)| (*team, (sighting.range * 100.0).round() / 100.0)).collect()
}

#[test]
fn frames_are_taken_at_the_cameras_rate_and_arrive_after_their_latency_in_order() {
    for (latency, first) in [(0.0, 0), (0.05, 3), (0.15, 9), (0.35, 21)] {
        let mut bench = Bench::new(Vec2::X);
        let robot = bench.robot(&sharp(latency), Home, 0, Pose::default());
        let want = [(first, 0), (first + 6, 6), (first + 12, 12)];
        assert_eq!(bench.arrivals(first + 18, robot), want, "latency {latency} s");
    }
}

#[test]
fn a_frame_shows_what_was_before_the_lens_when_it_was_taken() {
    let mut bench = Bench::new(Vec2::new(1.0, 0.0));
    let robot = bench.robot(&sharp(0.15), Home, 0, Pose::default());
    bench.sense(0, robot);
    let mut poses = bench.0.query_filtered::<&mut Pose, With<Ball>>();
    poses.single_mut(&mut bench.0).expect("one ball").position.x = 2.0;
    let ranges: Vec<_> = [(6, 9), (12, 15)]
        .map(|(taken, arrives)| {
            bench.sense(taken, robot);
            let frame = bench.sense(arrives, robot).expect("a frame has arrived");
            frame.ball.map(|ball| ball.range)
        })
        .into();
    assert_eq!(ranges, [Some(1.0), Some(2.0)]);
}

#[test]
fn frames_under_way_are_lost_when_the_robot_is_carried() {
    let mut bench = Bench::new(Vec2::X);
    let robot = bench.robot(&sharp(0.15), Home, 0, Pose::default());
    bench.sense(0, robot);
    bench.0.get_mut::<Eyesight>(robot).expect("the robot has eyes").blink();
    assert_eq!(bench.sense(9, robot), None);
}

#[test]
fn perfect_eyes_see_everything_at_once_behind_themselves_and_through_others_too() {
    let mut bench = Bench::new(Vec2::new(-4.0, 0.0));
    let robot = bench.robot(&perfect(), Home, 0, Pose::default());
    bench.robot(&perfect(), Away, 0, Pose::new(-2.0, 0.0, 0.0));
    bench.robot(&perfect(), Home, 1, Pose::new(-3.0, 0.0, 0.0));
    bench.robot(&perfect(), Away, 1, Pose::new(9.0, 0.0, 0.0));
    let frame = bench.sense(3, robot).expect("at once");
    assert_eq!((frame.taken, frame.ball), (3, Some(Sighting { range: 4.0, bearing: std::f32::consts::PI })));
    assert_eq!(team_and_range(&frame), [(Home, 3.0), (Away, 2.0), (Away, 9.0)]);
    assert_eq!(bench.sense(4, robot).map(|frame| frame.taken), Some(3), "no new frame between decisions");
}

#[test]
fn real_eyes_see_neither_what_is_behind_nor_what_is_hidden() {
    let mut bench = Bench::new(Vec2::new(2.0, 0.0));
    let robot = bench.robot(&sharp(0.0), Home, 0, Pose::default());
    bench.robot(&sharp(0.0), Away, 0, Pose::new(1.0, 0.0, 0.0));
    bench.robot(&sharp(0.0), Away, 1, Pose::new(-1.0, 0.0, 0.0));
    bench.robot(&sharp(0.0), Home, 1, Pose::new(2.0, 1.0, 0.0));
    let frame = bench.sense(0, robot).expect("at once");
    assert_eq!(frame.ball, None, "it is behind the robot ahead");
    assert_eq!(team_and_range(&frame), [(Home, 2.24), (Away, 1.0)]);
}

#[test]
fn a_removed_robot_is_not_seen_hides_nothing_and_sees_nothing() {
    for sensing in [sharp(0.0), perfect()] {
        let mut bench = Bench::new(Vec2::new(2.0, 0.0));
        let robot = bench.robot(&sensing, Home, 0, Pose::default());
        let other = bench.robot(&sensing, Away, 0, Pose::new(1.0, 0.0, 0.0));
        assert_eq!(team_and_range(&bench.sense(0, robot).expect("at once")), [(Away, 1.0)]);
        bench.0.entity_mut(other).insert(OffPitch);
        let frame = bench.sense(6, robot).expect("at once");
        assert_eq!((frame.taken, frame.robots.len(), frame.ball.map(|ball| ball.range)), (6, 0, Some(2.0)));
        assert_eq!(bench.sense(12, other).map(|frame| frame.taken), Some(0), "{}", sensing.name);
    }
}

#[test]
fn a_robot_knows_its_place_in_its_team_frame() {
    for sensing in [sharp(0.0), perfect()] {
        let mut bench = Bench::new(Vec2::X);
        let robot = bench.robot(&sensing, Away, 0, Pose::new(1.0, 2.0, 0.0));
        let fix = bench.sense(0, robot).expect("at once").fix.expect("a fix with every frame").pose;
        assert_eq!(fix.position, Vec2::new(-1.0, -2.0));
        assert!((fix.heading.abs() - std::f32::consts::PI).abs() < 1e-6, "{fix:?}");
    }
}

#[test]
fn what_a_robot_sees_does_not_depend_on_the_order_in_which_the_others_came() {
    let others = [(Home, 1, 1.0), (Away, 0, 1.5), (Away, 2, 2.0), (Home, 3, 2.5)];
    let seen = |order: [usize; 4]| {
        let mut bench = Bench::new(Vec2::new(1.0, -0.5));
        let robot = bench.robot(&noisy(), Home, 0, Pose::default());
        for (team, number, x) in order.map(|index| others[index]) {
            bench.robot(&noisy(), team, number, Pose::new(x, x - 1.75, 0.0));
        }
        (0..60).map(|tick| bench.sense(tick, robot)).collect::<Vec<_>>()
    };
    let frames = seen([0, 1, 2, 3]);
    assert!(frames.iter().flatten().any(|frame| frame.robots.len() == 4));
    assert_eq!(frames, seen([3, 1, 0, 2]));
}

#[test]
fn a_cye_that_drives_against_something_reports_a_bump_and_one_without_bump_sensing_does_not() {
    for kind in [cye(), RobotKind { bump: None, ..cye() }] {
        let mut bench = Bench::new(Vec2::X);
        let robot = bench.robot_of(kind.clone(), &noisy(), Home, 0, Pose::default());
        let mut reports = |ticks: std::ops::Range<u64>, told: f32, speed: f32| {
            let wheels = DriveCommand::Wheels(WheelSpeeds { left: told, right: told });
            let twist = Twist { linear: Vec2::new(speed, 0.0), angular: 0.0 };
            bench.0.entity_mut(robot).insert((wheels, twist));
            let felt = ticks.map(|tick| bench.odometry(tick, robot));
            felt.filter(|odometry| odometry.bump.reports && odometry.told == told).count()
        };
        assert_eq!(reports(0..60, 0.5, 0.45), 0, "it drives");
        let bumps = reports(60..240, 0.5, 0.0);
        assert_eq!(bumps > 100, kind.bump.is_some(), "{bumps} of 180");
        assert_eq!(reports(240..300, 0.5, 0.45), 0, "it is free");
        assert_eq!(reports(300..360, 0.0, 0.0), 0, "it rests");
    }
}

#[test]
fn the_wheels_report_way_and_turn_at_every_tick_and_sliding_sideways_is_none() {
    let mut bench = Bench::new(Vec2::X);
    let robot = bench.robot(&perfect(), Home, 0, Pose::new(2.0, 1.0, std::f32::consts::FRAC_PI_2));
    bench.0.entity_mut(robot).insert(Twist { linear: Vec2::new(0.6, -0.3), angular: 0.0 });
    (1..=60).for_each(|tick| drop(bench.sense(tick, robot)));
    let odometry = bench.odometry(61, robot);
    assert!((odometry.speed + 0.3).abs() < 1e-6, "{}", odometry.speed);
    let driven = odometry.pose.position;
    assert!(driven.distance(Vec2::new(-0.3 * 61.0 / 60.0, 0.0)) < 1e-4, "{driven}");
    bench.0.entity_mut(robot).insert(Twist { linear: Vec2::ZERO, angular: 1.2 });
    let odometry = bench.odometry(62, robot);
    assert!((odometry.pose.heading - 0.02).abs() < 1e-6 && odometry.turn_rate == 1.2, "{odometry:?}");
}

/// The shipped eyes among landmarks, without errors of localisation and with an odometry of motors.
fn among_landmarks() -> Sensing {
    let mut sensing = noisy();
    if let Eyes::Real { camera, localisation, odometry } = &mut sensing.eyes {
        camera.latency = 0.0;
        (localisation.position, localisation.heading) = (0.0, 0.0);
        localisation.landmarks = Some(LANDMARKS);
        *odometry = OdometryNoise { distance: 0.0, heading: 0.0, from: OdometrySource::Motors };
    }
    sensing
}

#[test]
fn a_frame_brings_a_fix_only_with_landmarks_in_view() {
    let looking = |heading: f32| {
        let mut bench = Bench::new(Vec2::X);
        let robot = bench.robot(&among_landmarks(), Home, 0, Pose::new(1.5, -0.2, heading));
        bench.sense(0, robot).expect("at once").fix
    };
    let at_the_goal = looking(0.0).expect("it sees a goal");
    assert_eq!((at_the_goal.share, at_the_goal.pose.position), (1.0, Vec2::new(1.5, -0.2)));
    assert_eq!(looking(std::f32::consts::FRAC_PI_2), None, "the side wall is too far");
}

#[test]
fn the_odometry_of_motors_feels_no_push_and_that_of_motion_does() {
    let pushed = |sensing: &Sensing| {
        let mut bench = Bench::new(Vec2::X);
        let robot = bench.robot(sensing, Home, 0, Pose::default());
        bench.0.entity_mut(robot).insert(Twist { linear: Vec2::X, angular: 2.0 });
        bench.odometry(61, robot).pose
    };
    assert_eq!(pushed(&among_landmarks()), Pose::default());
    assert!(pushed(&perfect()).position.x > 0.01);
}

#[test]
fn people_tell_a_robot_its_place_as_well_as_its_eyes_say() {
    let truth = Pose::new(1.0, -0.5, 2.0);
    let mut handled = noisy();
    if let Eyes::Real { localisation, .. } = &mut handled.eyes {
        localisation.put_down = PlaceError { position: 0.1, heading: 5.0 };
    }
    let error = |sensing: &Sensing| {
        let mut bench = Bench::new(Vec2::X);
        let robot = bench.robot(sensing, Home, 0, Pose::default());
        let errors = (0..400).map(|_| told_place(&mut bench.0, robot, truth).position.x - truth.position.x);
        let (square, n) = errors.fold((0.0, 0.0), |(sum, n), error: f32| (sum + error * error, n + 1.0));
        (square / n).sqrt()
    };
    assert_eq!(error(&perfect()), 0.0);
    assert!((error(&handled) - 0.1).abs() < 0.015, "{}", error(&handled));
}

#[test]
fn the_team_of_a_robot_is_mistaken_as_often_as_the_eyes_say() {
    let mut sensing = sharp(0.0);
    if let Eyes::Real { camera, .. } = &mut sensing.eyes {
        camera.wrong_team = 0.2;
    }
    let mut bench = Bench::new(Vec2::X);
    let robot = bench.robot(&sensing, Home, 0, Pose::default());
    bench.robot(&sensing, Away, 0, Pose::new(1.5, 0.5, 0.0));
    let frames = (0..2000).map(|frame| bench.sense(6 * frame, robot).expect("at once"));
    let wrong = frames.filter(|frame| frame.robots[0].0 == Home).count();
    assert!((350..450).contains(&wrong), "{wrong} of 2000");
}
