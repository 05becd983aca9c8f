//! A robot that walks among landmarks and is shown them with noise.

use std::f32::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;

use super::*;
use crate::geometry::unit;
use crate::ops;
use crate::rng::{Dice, Seed};

const ERRORS: FilterErrors = FilterErrors {
    bearing: 0.044,
    lasting: 0.1,
    way: 0.1,
    turn: 0.087,
    unfelt: PoseDeviation { place: 0.05, heading: 0.05 },
};
/// Posts of two goals and four beacons of a pitch 4.5 m by 3 m.
const PLACES: [Vec2; 8] = [
    Vec2::new(2.25, 0.4),
    Vec2::new(2.25, -0.4),
    Vec2::new(-2.25, 0.4),
    Vec2::new(-2.25, -0.4),
    Vec2::new(1.2, 1.65),
    Vec2::new(1.2, -1.65),
    Vec2::new(-1.2, 1.65),
    Vec2::new(-1.2, -1.65),
];
const GOAL: [Vec2; 2] = [PLACES[0], PLACES[1]];
/// How wrong a range is that is measured, m.
fn deep(range: f32) -> f32 {
    0.02 + 0.03 * range * range
}

/// A landmark that is seen exactly where it is.
fn exact(place: Vec2, from: Pose) -> SeenLandmark {
    let sighting = Sighting::of(place, from);
    SeenLandmark { place, sighting, range_deviation: deep(sighting.range) }
}

/// Ticks a second, with a frame in every second one.
const DT: f32 = 1.0 / 60.0;
const EXACT: PoseDeviation = PoseDeviation { place: 0.05, heading: 0.05 };
const VAGUE: PoseDeviation = PoseDeviation { place: 1.0, heading: 0.7 };

/// A robot, where it is and where it believes to be.
struct Walk {
    truth: Pose,
    odometry: Pose,
    filter: PoseFilter,
    tick: u64,
    dice: Dice,
    errors: FilterErrors,
}

impl Walk {
    fn new(truth: Pose, filter: PoseFilter, seed: u64) -> Walk {
        let mut walk = Walk {
            truth,
            odometry: Pose::new(7.0, -3.0, 2.0),
            filter,
            tick: 0,
            dice: Dice::new(Seed(seed), "test", None),
            errors: ERRORS,
        };
        walk.filter.odometry(0, walk.odometry);
        walk
    }

    /// Two ticks, with errors of the odometry.
    fn step(&mut self, ahead: f32, turn: f32) {
        self.tick += 2;
        let moved = |pose: Pose, ahead: f32, turn: f32| Pose {
            position: pose.to_field(Vec2::X * ahead),
            heading: wrap_angle(pose.heading + turn),
        };
        self.truth = moved(self.truth, ahead, turn);
        let root = ahead.abs().sqrt();
        let (slip, drift) = (self.dice.normal(ERRORS.way) * root, self.dice.normal(ERRORS.turn) * root);
        self.odometry = moved(self.odometry, ahead + slip, turn + drift);
        self.filter.odometry(self.tick, self.odometry);
    }

    fn seen(&mut self, place: Vec2) -> SeenLandmark {
        let Sighting { range, bearing } = Sighting::of(place, self.truth);
        let range = (range + self.dice.normal(deep(range))).max(0.1);
        let bearing = wrap_angle(bearing + self.dice.normal(ERRORS.bearing));
        SeenLandmark { place, sighting: Sighting { range, bearing }, range_deviation: deep(range) }
    }

    /// A frame of these landmarks, taken now.
    fn see(&mut self, places: &[Vec2]) {
        let seen: Vec<_> = places.iter().map(|place| self.seen(*place)).collect();
        self.filter.see(self.tick, &seen, &ERRORS, DT);
    }

    /// The landmarks that a camera sees that looks in this direction, rad to the left of straight ahead.
    fn in_view(&self, pan: f32) -> Vec<Vec2> {
        let is_seen = |place: &&Vec2| {
            let Sighting { range, bearing } = Sighting::of(**place, self.truth);
            range < 5.0 && wrap_angle(bearing - pan).abs() < 0.5
        };
        PLACES.iter().filter(is_seen).copied().collect()
    }

    /// How wrong the robot is, m and rad.
    fn error(&self) -> (f32, f32) {
        self.filter.pose().map_or((f32::INFINITY, PI), |pose| {
            let turn = wrap_angle(pose.heading - self.truth.heading).abs();
            (pose.position.distance(self.truth.position), turn)
        })
    }

    fn is_right(&self) -> bool {
        let (place, heading) = self.error();
        place < 0.35 && heading < 0.25
    }
}

fn beside(pose: Pose, way: Vec2, turn: f32) -> Pose {
    Pose { position: pose.position + way, heading: wrap_angle(pose.heading + turn) }
}

#[test]
fn two_posts_correct_a_robot_that_errs_by_a_metre_and_forty_degrees() {
    let truth = Pose::new(0.3, 0.2, 0.1);
    for seed in 0..40 {
        let way = unit(seed as f32 * 0.7);
        let told = beside(truth, way, if seed % 2 == 0 { 0.7 } else { -0.7 });
        let mut walk = Walk::new(truth, PoseFilter::told(told, VAGUE), seed);
        assert!(walk.error().0 > 0.99 && walk.filter.share() < 0.3);
        for _ in 0..40 {
            walk.step(0.0, 0.0);
            walk.see(&GOAL);
        }
        assert!(walk.is_right(), "seed {seed}: {:?}", walk.error());
        assert!(walk.filter.share() > 0.9, "seed {seed}: {}", walk.filter.share());
    }
}

fn facing_the_goal(position: Vec2) -> Pose {
    Pose { position, heading: crate::geometry::angle(Vec2::X * 2.25 - position) }
}

/// A goal in the distance tells little of how far to its side a robot is.
#[test]
fn a_goal_in_view_sets_most_robots_right_within_two_seconds_and_the_others_know_it() {
    let (mut right, mut mistaken) = (0, 0);
    for seed in 0..400 {
        let mut dice = Dice::new(Seed(seed), "start", None);
        let mut within = |least: f32, most: f32| least + (most - least) * dice.uniform();
        let truth = facing_the_goal(Vec2::new(within(-2.0, 1.0), within(-1.2, 1.2)));
        let told = beside(truth, unit(within(-PI, PI)) * within(0.0, 1.0), within(-0.7, 0.7));
        let mut walk = Walk::new(truth, PoseFilter::told(told, VAGUE), seed);
        for _ in 0..60 {
            walk.step(0.005, 0.0);
            walk.see(&GOAL);
        }
        let ((place, heading), deviation) = (walk.error(), walk.filter.deviation().unwrap());
        right += usize::from(walk.is_right());
        mistaken += usize::from(place > 4.0 * deviation.place || heading > 4.0 * deviation.heading);
    }
    assert!(right > 340 && mistaken < 8, "{right} right, {mistaken} more wrong than they believe, of 400");
}

#[test]
fn a_lost_robot_waits_for_a_second_landmark_and_odometry_joins_the_two() {
    let mut walk = Walk::new(Pose::new(-0.5, 0.3, 2.5), PoseFilter::lost(), 1);
    for _ in 0..30 {
        walk.step(0.01, 0.0);
        walk.see(&PLACES[2..3]);
    }
    assert_eq!((walk.filter.pose(), walk.filter.share()), (None, 0.0));
    for _ in 0..15 {
        walk.step(0.01, 0.02);
        walk.see(&PLACES[6..7]);
    }
    assert!(walk.is_right(), "{:?}", walk.error());
}

#[test]
fn a_robot_that_was_carried_believes_the_landmarks_after_some_time_and_not_the_first_ones() {
    for seed in 0..40 {
        let truth = Pose::new(0.3, 0.2, 0.1);
        let before = beside(truth, Vec2::new(-1.5, 0.8).rotate(unit(seed as f32)), 1.0 + 0.1 * seed as f32);
        let mut walk = Walk::new(truth, PoseFilter::told(before, EXACT), seed);
        walk.step(0.0, 0.0);
        walk.see(&GOAL);
        assert!(!walk.is_right(), "seed {seed}: one frame is no proof");
        for _ in 0..75 {
            walk.step(0.0, 0.0);
            walk.see(&GOAL);
        }
        assert!(walk.is_right(), "seed {seed}: {:?}", walk.error());
    }
}

/// A robot turns its head and walks in a circle; how often it was right, of this many frames, after those before.
fn right_while_walking(walk: &mut Walk, frames: usize, mistaken: impl Fn(Vec2) -> Vec2) -> usize {
    (0..frames)
        .filter(|frame| {
            walk.step(0.008, 0.012);
            let pan = 1.4 * ops::sin(*frame as f32 * 0.06);
            let seen: Vec<_> = (walk.in_view(pan).into_iter())
                .map(|place| SeenLandmark { place: mistaken(place), ..walk.seen(place) })
                .collect();
            walk.filter.see(walk.tick, &seen, &walk.errors, DT);
            walk.is_right()
        })
        .count()
}

#[test]
fn a_landmark_of_a_wrong_colour_is_left_out_among_right_ones() {
    let truth = Pose::new(0.2, -0.3, 0.0);
    let mut walk = Walk::new(truth, PoseFilter::told(truth, EXACT), 4);
    let mistaken = |place: Vec2| if place == PLACES[4] { PLACES[7] } else { place };
    let right = right_while_walking(&mut walk, 600, mistaken);
    assert!(right > 580, "{right} of 600");
}

#[test]
fn wrong_colours_everywhere_mislead_a_robot_and_right_ones_set_it_right_again() {
    let truth = Pose::new(0.2, -0.3, 0.0);
    let mut walk = Walk::new(truth, PoseFilter::told(truth, EXACT), 4);
    // Both ends of the pitch look like the other one.
    let right = right_while_walking(&mut walk, 300, |place| -place);
    assert!(right < 200 && !walk.is_right(), "{right} of 300, {:?}", walk.error());
    right_while_walking(&mut walk, 120, |place| place);
    let right = right_while_walking(&mut walk, 300, |place| place);
    assert!(right > 280, "{right} of 300");
}

#[test]
fn without_landmarks_the_robot_grows_unsure_and_its_share_falls() {
    let mut walk = Walk::new(Pose::default(), PoseFilter::told(Pose::default(), EXACT), 2);
    let mut last = (0.0, 1.1);
    for _ in 0..20 {
        for _ in 0..15 {
            walk.step(0.012, 0.0);
            walk.see(&[]);
        }
        let now = (walk.filter.deviation().unwrap().place, walk.filter.share());
        assert!(now.0 > last.0 && now.1 <= last.1, "{last:?} {now:?}");
        last = now;
    }
    assert!(last.0 > 0.3 && last.1 < 0.7, "{last:?}");
}

#[test]
fn the_robot_errs_by_about_what_it_takes_itself_to_err() {
    let (mut off, mut expected) = (0.0, 0.0);
    for seed in 0..60 {
        let truth = Pose::new(0.2, -0.3, 0.0);
        let mut walk = Walk::new(truth, PoseFilter::told(truth, EXACT), seed);
        // Each frame errs anew.
        walk.errors.lasting = 0.0;
        right_while_walking(&mut walk, 150, |place| place);
        let deviation = walk.filter.deviation().unwrap();
        off += walk.error().0.powi(2);
        expected += 2.0 * deviation.place.powi(2);
    }
    let ratio = (off / expected).sqrt();
    assert!((0.6..1.4).contains(&ratio), "{ratio}");
}

#[test]
fn frames_that_follow_each_other_tell_little_more_than_one() {
    let deviation = |frames: usize, errors: FilterErrors| {
        let mut walk = Walk::new(Pose::default(), PoseFilter::told(Pose::default(), VAGUE), 5);
        for _ in 0..frames {
            walk.step(0.0, 0.0);
            let seen = GOAL.map(|place| exact(place, walk.truth));
            walk.filter.see(walk.tick, &seen, &errors, DT);
        }
        walk.filter.deviation().unwrap().place
    };
    let still = FilterErrors { unfelt: PoseDeviation { place: 0.0, heading: 0.0 }, ..ERRORS };
    // A second of frames is one and twenty-nine thirtieths of another, or thirty.
    let one = deviation(1, still);
    let alike = deviation(30, FilterErrors { lasting: 1.0, ..still });
    let anew = deviation(30, FilterErrors { lasting: 0.0, ..still });
    assert!((one / alike - 1.4).abs() < 0.2, "{one} {alike}");
    assert!(one / anew > 4.0, "{one} {anew}");
}

#[test]
fn a_frame_that_comes_late_corrects_the_pose_of_its_own_time() {
    let truth = Pose::new(-1.0, 0.0, 0.0);
    let mut walk = Walk::new(truth, PoseFilter::told(beside(truth, Vec2::new(0.3, 0.3), 0.2), VAGUE), 3);
    let mut under_way = VecDeque::new();
    // Of the pose of a frame's time, and of the pose of now, since which odometry has erred: now more and now less.
    let mut errors = [Vec::new(), Vec::new()];
    for _ in 0..60 {
        walk.step(0.01, 0.03);
        let seen: Vec<_> = (walk.in_view(0.0).into_iter()).map(|place| exact(place, walk.truth)).collect();
        under_way.push_back((walk.tick, walk.truth, seen));
        // Each arrives 12 ticks late: the robot has turned by 10 degrees.
        if under_way.len() > 6 {
            let (taken, then, seen) = under_way.pop_front().unwrap();
            walk.filter.see(taken, &seen, &ERRORS, DT);
            let believed = walk.filter.pose_then().unwrap();
            if walk.tick > 60 {
                let turn = wrap_angle(believed.heading - then.heading).abs();
                errors[0].push((believed.position.distance(then.position), turn));
                errors[1].push(walk.error());
            }
        }
    }
    for (errors, place, heading) in [(&errors[0], 0.1, 0.05), (&errors[1], 0.15, 0.08)] {
        let mean = |of: fn(&(f32, f32)) -> f32| errors.iter().map(of).sum::<f32>() / errors.len() as f32;
        let (off, turn) = (mean(|error| error.0), mean(|error| error.1));
        assert!(off < place && turn < heading, "{off} {turn}");
    }
}

#[test]
fn frames_between_two_readings_of_the_odometry_and_from_before_all_are_no_trouble() {
    let mut filter = PoseFilter::told(Pose::default(), EXACT);
    filter.see(5, &[], &ERRORS, DT);
    filter.odometry(10, Pose::default());
    filter.odometry(20, Pose::new(1.0, 0.0, FRAC_PI_2));
    filter.odometry(20, Pose::new(9.0, 9.0, 0.0));
    filter.see(15, &[], &ERRORS, DT);
    assert_eq!(filter.pose_then(), Some(Pose::new(0.5, 0.0, FRAC_PI_2 / 2.0)));
    filter.see(12, &[], &ERRORS, DT);
    let pose = filter.pose().unwrap();
    assert!(pose.position.distance(Vec2::X) < 1e-6 && (pose.heading - FRAC_PI_2).abs() < 1e-6, "{pose:?}");
}

fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![-5.0..5.0_f32, any::<f32>(), Just(0.0), Just(f32::NAN), Just(f32::INFINITY)]
}

fn any_landmark() -> impl Strategy<Value = SeenLandmark> {
    let place = (any_number(), any_number()).prop_map(|(x, y)| Vec2::new(x, y));
    (place, any_number(), any_number(), any_number()).prop_map(|(place, range, bearing, range_deviation)| {
        SeenLandmark { place, sighting: Sighting { range, bearing }, range_deviation }
    })
}

fn any_frame() -> impl Strategy<Value = (u64, [f32; 3], Vec<SeenLandmark>)> {
    let odometry = [any_number(), any_number(), any_number()];
    (0..40_u64, odometry, prop::collection::vec(any_landmark(), 0..5))
}

proptest! {
    #[test]
    fn whatever_is_seen_all_numbers_stay_numbers(
        start in prop::option::of([any_number(), any_number(), any_number(), any_number(), any_number()]),
        frames in prop::collection::vec(any_frame(), 1..60),
    ) {
        let told = |[x, y, heading, place, turn]: [f32; 5]| {
            PoseFilter::told(Pose::new(x, y, heading), PoseDeviation { place, heading: turn })
        };
        let mut filter = start.map_or_else(PoseFilter::lost, told);
        let mut tick = 0;
        for (later, [x, y, heading], seen) in frames {
            tick += later;
            filter.odometry(tick, Pose::new(x, y, heading));
            filter.see(tick.saturating_sub(3), &seen, &ERRORS, DT);
            prop_assert!(filter.pose().is_none_or(Pose::is_finite), "{filter:?}");
            prop_assert!(filter.pose_then().is_none_or(Pose::is_finite), "{filter:?}");
            let deviation = filter.deviation();
            prop_assert!(deviation.is_none_or(|it| it.place.is_finite() && it.heading.is_finite()), "{filter:?}");
            prop_assert!((0.0..=1.0).contains(&filter.share()), "{filter:?}");
        }
    }

    #[test]
    fn exact_sightings_of_a_goal_give_the_place_from_anywhere(
        x in -1.5..1.0_f32, y in -1.2..1.2_f32, way in 0.0..1.0_f32, direction in -PI..PI, turn in -0.7..0.7_f32,
    ) {
        let truth = facing_the_goal(Vec2::new(x, y));
        let mut walk = Walk::new(truth, PoseFilter::told(beside(truth, unit(direction) * way, turn), VAGUE), 1);
        for _ in 0..60 {
            walk.step(0.0, 0.0);
            let seen = GOAL.map(|place| exact(place, truth));
            walk.filter.see(walk.tick, &seen, &ERRORS, DT);
        }
        let (place, heading) = walk.error();
        prop_assert!(place < 0.5 && heading < 0.2, "{place} m, {heading} rad");
    }
}
