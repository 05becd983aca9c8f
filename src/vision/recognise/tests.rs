use bevy::math::Vec2;
use proptest::prelude::*;

use super::*;
use crate::geometry::{Pose, wrap_angle};
use crate::pitch::{BallKind, Goal, Pitch, Walls};
use crate::vision::paint::{BEACON_BANDS, PitchPaint, RobotPaint, beacon_colours, goal_colour};
use crate::vision::scene::{Prop, scene};
use crate::vision::sketch::nominal_table;
use crate::vision::{ColourClass, ColourLookup, Landmark, Segmenter};

/// The AIBO's camera, and the Cye's.
const AIBO: Optics =
    Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 10.0, nod: 40.0 };
const CYE: Optics =
    Optics { width: 160, height: 120, field_of_view: 80.0, mount: 0.35, tilt: 10.0, nod: 10.0 };

type Things = Vec<(Prop, Option<ColourClass>)>;

fn four_legged() -> Pitch {
    Pitch {
        length: 5.4,
        width: 4.0,
        goal: Goal { width: 0.8, depth: 0.3 },
        beacons: [(-1.35, -2.1), (-1.35, 2.1), (1.35, -2.1), (1.35, 2.1)].map(Vec2::from).to_vec(),
        walls: Walls { margin: 1.0, ..crate::testing::pitch().walls },
        ..crate::testing::pitch()
    }
}

fn known(pitch: &Pitch, ball_radius: f32, robot: RobotPaint) -> KnownObjects {
    let ball = BallKind {
        radius: ball_radius,
        mass: 0.1,
        rolling: 0.3,
        sliding: 3.0,
        inertia: 0.667,
        friction: 0.3,
        restitution: 0.2,
        wander: 0.0,
    };
    KnownObjects::new(pitch, &ball, [robot; 2])
}

fn aibo() -> KnownObjects {
    known(&four_legged(), 0.045, RobotPaint::WALKER)
}

fn cye() -> KnownObjects {
    known(&crate::testing::pitch(), 0.11, RobotPaint::WHEELED)
}

/// Looks straight ahead and down by the camera's usual tilt.
fn look(optics: &Optics, known: &KnownObjects, things: &[(Prop, Option<ColourClass>)]) -> Recognised {
    look_at((optics.width, optics.height), optics, known, things)
}

fn look_at(
    size: (usize, usize),
    optics: &Optics,
    known: &KnownObjects,
    things: &[(Prop, Option<ColourClass>)],
) -> Recognised {
    let gaze = Gaze { pan: 0.0, tilt: optics.tilt.to_radians() };
    let image = scene(optics, size, gaze, things);
    let mut segmenter = Segmenter::default();
    recognise(segmenter.segment(&image, &ColourLookup::new(&nominal_table())), optics, gaze, known)
}

fn at(range: f32, bearing: f32) -> Vec2 {
    crate::geometry::unit(bearing) * range
}

fn ball_at(place: Vec2, radius: f32) -> (Prop, Option<ColourClass>) {
    (Prop::Ball(place, radius), Some(ColourClass::Orange))
}

#[test]
fn a_ball_is_where_it_looks_to_be() {
    for (optics, known, ranges) in
        [(AIBO, aibo(), [0.3, 0.6, 1.0, 1.7, 2.5]), (CYE, cye(), [0.5, 0.8, 1.3, 2.0, 3.0])]
    {
        for (range, bearing) in ranges.into_iter().flat_map(|range| [-0.3, 0.0, 0.37].map(|b| (range, b))) {
            let seen = look(&optics, &known, &[ball_at(at(range, bearing), known.ball_radius)]);
            let ball = seen.ball.unwrap_or_else(|| panic!("no ball at {range} {bearing}"));
            assert!((ball.range - range).abs() < 0.03 + 0.05 * range * range, "{range} {bearing}: {ball:?}");
            assert!((ball.bearing - bearing).abs() < 0.01, "{range} {bearing}: {ball:?}");
            assert!(seen.robots.is_empty() && seen.landmarks.is_empty(), "{seen:?}");
        }
    }
}

#[test]
fn a_ball_at_the_pictures_edge_is_completed() {
    let (known, edge) = (aibo(), (56.9_f32 / 2.0).to_radians());
    for bearing in [edge, -edge] {
        let ball = look(&AIBO, &known, &[ball_at(at(0.6, bearing), 0.045)]).ball.unwrap();
        assert!((ball.range - 0.6).abs() < 0.05 && (ball.bearing - bearing).abs() < 0.02, "{ball:?}");
    }
}

#[test]
fn a_ball_in_a_corner_of_the_picture_is_completed() {
    let known = cye();
    for (range, bearing) in [(0.25, 0.72), (0.33, -0.78), (0.4, 0.8)] {
        let ball = look(&CYE, &known, &[ball_at(at(range, bearing), 0.11)]).ball;
        let ball = ball.unwrap_or_else(|| panic!("no ball at {range} {bearing}"));
        let off = wrap_angle(ball.bearing - bearing).abs();
        assert!((ball.range - range).abs() < 0.06 && off < 0.06, "{range} {bearing}: {ball:?}");
    }
}

#[test]
fn half_a_ball_behind_something_grey_is_near_where_it_is() {
    let known = cye();
    let hides = (Prop::Screen(Vec2::new(1.2, 0.01), Vec2::new(1.2, -0.5), 0.25), None);
    let ball = look(&CYE, &known, &[ball_at(at(1.5, 0.0), 0.11), hides]).ball.unwrap();
    assert!((ball.range - 1.5).abs() < 0.15 && ball.bearing.abs() < 0.06, "{ball:?}");
}

#[test]
fn orange_that_is_too_high_too_large_or_a_stripe_is_no_ball() {
    let known = aibo();
    let orange = Some(ColourClass::Orange);
    for prop in [
        Prop::Post(at(1.0, 0.0), 0.045, 0.25, 0.34),
        Prop::Post(at(1.5, 0.1), 0.3, 0.0, 0.4),
        Prop::Ball(at(1.0, 0.0), 0.11),
        Prop::Stripe(at(0.8, 0.4), at(0.8, -0.4), 0.05),
    ] {
        assert_eq!(look(&AIBO, &known, &[(prop, orange)]).ball, None, "{prop:?}");
    }
}

#[test]
fn an_orange_patch_in_a_red_marker_is_no_ball() {
    let marker = (Prop::Post(at(0.9, 0.0), 0.12, 0.0, 0.2), Some(ColourClass::Red));
    let shine = (Prop::Post(at(0.775, 0.0), 0.045, 0.0, 0.09), Some(ColourClass::Orange));
    assert!(look(&AIBO, &aibo(), &[shine]).ball.is_some(), "alone it is taken for one");
    assert_eq!(look(&AIBO, &aibo(), &[marker, shine]).ball, None);
}

#[test]
fn a_ball_before_a_robot_in_red_is_one() {
    let marker = (Prop::Post(at(1.0, 0.0), 0.12, 0.10, 0.18), Some(ColourClass::Red));
    let body = (Prop::Post(at(1.0, 0.0), 0.119, 0.0, 0.28), None);
    let seen = look(&AIBO, &aibo(), &[marker, body, ball_at(at(0.8, 0.0), 0.045)]);
    assert!((seen.ball.unwrap().range - 0.8).abs() < 0.05, "{seen:?}");
    assert_eq!(seen.robots.len(), 1);
}

#[test]
fn markers_tell_team_range_and_bearing() {
    for (optics, known, radius) in [(AIBO, aibo(), 0.12), (CYE, cye(), 0.08)] {
        let band = known.robots[0].marker;
        for (range, bearing) in [(0.9, 0.2), (1.5, 0.0), (2.4, -0.3)] {
            for team in Team::BOTH {
                let colour = Some(ColourClass::marker(team));
                let prop = Prop::Post(at(range, bearing), radius, band.bottom, band.top);
                let seen = look(&optics, &known, &[(prop, colour)]);
                let [(seen_team, sighting)] = seen.robots[..] else { panic!("{range}: {seen:?}") };
                assert_eq!(seen_team, team);
                assert!(
                    (sighting.range - range).abs() < 0.05 + 0.04 * range * range,
                    "{range}: {sighting:?}"
                );
                assert!((sighting.bearing - bearing).abs() < 0.02, "{bearing}: {sighting:?}");
            }
        }
    }
}

#[test]
fn patches_of_one_marker_are_one_robot_and_two_robots_are_two() {
    let known = aibo();
    let marker = |y| (Prop::Post(Vec2::new(1.2, y), 0.12, 0.10, 0.18), Some(ColourClass::DarkBlue));
    let pole = (Prop::Post(Vec2::new(1.0, 0.0), 0.02, 0.0, 0.3), None);
    assert_eq!(look(&AIBO, &known, &[marker(0.0), pole]).robots.len(), 1);
    assert_eq!(look(&AIBO, &known, &[marker(0.3), marker(-0.3)]).robots.len(), 2);
}

#[test]
fn blue_that_is_too_high_is_no_marker() {
    let high = (Prop::Post(at(1.5, 0.0), 0.12, 0.35, 0.43), Some(ColourClass::DarkBlue));
    assert!(look(&AIBO, &aibo(), &[high]).robots.is_empty());
}

/// Everything that stands and is painted on a pitch, from a pose.
fn hall(pitch: &Pitch, from: Pose) -> Things {
    let (half, goal, paint) = (pitch.half_size(), pitch.goal, PitchPaint::of(pitch));
    let screen = |a: Vec2, b: Vec2, top| Prop::Screen(from.to_local(a), from.to_local(b), top);
    let (mut things, white) = (Things::new(), Some(ColourClass::White));
    for (east, side) in [(false, -1.0), (true, 1.0)] {
        let place = |x: f32, y: f32| Vec2::new(side * x, y);
        let (colour, post, back) = (Some(goal_colour(east)), goal.width / 2.0, half.x + goal.depth);
        things.push((screen(place(back, -post), place(back, post), paint.goal_height), colour));
        for end in [-1.0, 1.0] {
            let inside = screen(place(half.x, end * post), place(back, end * post), paint.goal_height);
            let outer = end * (post + 0.005);
            let outside = screen(place(half.x, outer), place(back, outer), paint.goal_height);
            things.extend([(inside, colour), (outside, None)]);
            if let Some(height) = paint.walls {
                things.push((screen(place(half.x, outer), place(half.x, end * half.y), height), white));
            }
        }
    }
    for y in [-half.y, half.y] {
        if let Some(height) = paint.walls {
            things.push((screen(Vec2::new(-half.x, y), Vec2::new(half.x, y), height), white));
        }
    }
    if paint.walls.is_none() {
        things.extend(
            pitch
                .lines()
                .map(|(a, b)| (Prop::Stripe(from.to_local(a), from.to_local(b), paint.line_width), white)),
        );
    }
    for beacon in &pitch.beacons {
        let colours = beacon_colours(beacon.x > 0.0, beacon.y > 0.0);
        let part = |bottom, top| Prop::Post(from.to_local(*beacon), 0.05, bottom, top);
        things.push((part(0.0, BEACON_BANDS[0].bottom), white));
        things.extend(
            BEACON_BANDS
                .iter()
                .zip(colours)
                .map(|(band, colour)| (part(band.bottom, band.top), Some(colour))),
        );
    }
    things
}

/// Landmarks of a place that are in a picture, with the truth's range and bearing.
fn checked(pitch: &Pitch, optics: &Optics, known: &KnownObjects, from: Pose) -> Vec<Landmark> {
    let seen = look(optics, known, &hall(pitch, from));
    let placed = seen.landmarks.iter().filter_map(|seen| Some((seen, seen.landmark.place(pitch)?)));
    placed
        .map(|(seen, place)| {
            let truth = Sighting::of(place, from);
            let (range, bearing) =
                (seen.sighting.range - truth.range, wrap_angle(seen.sighting.bearing - truth.bearing));
            assert!(range.abs() < 3.0 * seen.range_deviation + 0.05, "{from:?} {seen:?}: by {range}");
            assert!(range.abs() < 0.1 + 0.15 * truth.range, "{from:?} {seen:?}: by {range}");
            assert!(bearing.abs() < 0.015, "{from:?} {seen:?}: by {bearing}");
            seen.landmark
        })
        .collect()
}

#[test]
fn posts_of_both_goals_are_told_apart_from_everywhere() {
    for (pitch, optics, known) in [(four_legged(), AIBO, aibo()), (crate::testing::pitch(), CYE, cye())] {
        let half = pitch.half_size();
        for (x, y) in [(0.0, 0.0), (-0.4, 0.5), (0.3, -0.6), (-0.2, 0.7)] {
            for (east, aim) in [(true, half.x), (false, -half.x)] {
                let place = half * Vec2::new(x, y);
                let heading = crate::geometry::angle(Vec2::new(aim, 0.0) - place);
                let posts = checked(&pitch, &optics, &known, Pose::new(place.x, place.y, heading));
                for north in [false, true] {
                    assert!(posts.contains(&Landmark::GoalPost { east, north }), "{place} {east}: {posts:?}");
                }
            }
        }
    }
}

#[test]
fn a_goal_that_the_picture_cuts_shows_one_post() {
    let (pitch, known) = (four_legged(), aibo());
    let seen = checked(&pitch, &AIBO, &known, Pose::new(1.2, 0.0, 0.62));
    assert!(seen.contains(&Landmark::GoalPost { east: true, north: true }), "{seen:?}");
    assert!(!seen.contains(&Landmark::GoalPost { east: true, north: false }), "{seen:?}");
}

#[test]
fn a_post_behind_a_marker_is_not_taken_to_be_at_the_marker() {
    let (pitch, known) = (four_legged(), aibo());
    let mut things = hall(&pitch, Pose::new(0.7, 0.0, 0.0));
    things.push((Prop::Post(Vec2::new(0.8, 0.2), 0.12, 0.10, 0.18), Some(ColourClass::Red)));
    things.push((Prop::Post(Vec2::new(0.8, 0.2), 0.119, 0.0, 0.4), None));
    let posts: Vec<Landmark> =
        look(&AIBO, &known, &things).landmarks.iter().map(|seen| seen.landmark).collect();
    assert!(!posts.contains(&Landmark::GoalPost { east: true, north: true }), "{posts:?}");
}

#[test]
fn each_beacon_is_known_by_its_colours() {
    let (pitch, known) = (four_legged(), aibo());
    for (place, (east, north)) in
        pitch.beacons.iter().zip([(false, false), (false, true), (true, false), (true, true)])
    {
        for from in [Vec2::ZERO, *place * Vec2::new(0.2, 0.5), *place * Vec2::new(1.3, 0.7)] {
            let heading = crate::geometry::angle(*place - from);
            let seen = checked(&pitch, &AIBO, &known, Pose::new(from.x, from.y, heading));
            assert!(seen.contains(&Landmark::Beacon { east, north }), "{from} {place}: {seen:?}");
        }
    }
}

/// How far a point is from the nearest of some lines, m.
fn off_lines(pitch: &Pitch, at: Vec2) -> f32 {
    let off = |(a, b): (Vec2, Vec2)| {
        let along = b - a;
        let share = ((at - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (a + along * share).distance(at)
    };
    pitch.lines().into_iter().map(off).fold(f32::INFINITY, f32::min)
}

#[test]
fn points_of_lines_and_walls_are_on_them() {
    for (pitch, optics, known, expected) in
        [(four_legged(), AIBO, aibo(), Landmark::Line), (crate::testing::pitch(), CYE, cye(), Landmark::Wall)]
    {
        let from = Pose::new(-pitch.length / 2.0 + 1.2, pitch.width / 2.0 - 1.0, 2.0);
        let seen = look(&optics, &known, &hall(&pitch, from)).landmarks;
        let points: Vec<_> = seen.iter().filter(|seen| seen.landmark == expected).collect();
        assert!(points.len() >= 8, "{seen:?}");
        for point in points {
            let off = off_lines(&pitch, point.sighting.placed(from));
            assert!(off < 0.05 + 3.0 * point.range_deviation, "{point:?} is {off} m off");
        }
    }
}

#[test]
fn a_coarser_picture_shows_what_is_near() {
    let known = aibo();
    for (step, range, reach) in [(2, 1.0, 0.09), (4, 0.5, 0.09)] {
        let size = (AIBO.width / step, AIBO.height / step);
        let ball = look_at(size, &AIBO, &known, &[ball_at(at(range, 0.1), 0.045)]).ball.unwrap();
        assert!((ball.range - range).abs() < reach && (ball.bearing - 0.1).abs() < 0.03, "{step}: {ball:?}");
    }
}

#[test]
fn a_turned_head_sees_as_much_aside() {
    let (known, gaze) = (aibo(), Gaze { pan: 1.2, tilt: 0.3 });
    let image = scene(&AIBO, (208, 160), gaze, &[ball_at(at(0.7, 1.25), 0.045)]);
    let mut segmenter = Segmenter::default();
    let cut = segmenter.segment(&image, &ColourLookup::new(&nominal_table()));
    let ball = recognise(cut, &AIBO, gaze, &known).ball.unwrap();
    assert!((ball.range - 0.7).abs() < 0.04 && (ball.bearing - 1.25).abs() < 0.01, "{ball:?}");
}

proptest! {
    #[test]
    fn whatever_the_picture_what_is_seen_is_finite_and_within_reach(
        width in 4_usize..60,
        patches in prop::collection::vec((0_usize..9, 1_usize..40), 1..200),
        pan in -1.5_f32..1.5,
        tilt in -0.4_f32..1.0,
    ) {
        let classes: Vec<_> = patches
            .into_iter()
            .flat_map(|(class, length)| vec![ColourClass::ALL.get(class).copied(); length])
            .collect();
        let pixels = classes.iter().map(|class| crate::vision::sketch::colour_of(*class)).collect::<Vec<_>>();
        let height = pixels.len() / width;
        let image = crate::vision::Image { width, height, pixels: pixels[..width * height].to_vec() };
        let mut segmenter = Segmenter::default();
        let cut = segmenter.segment(&image, &ColourLookup::new(&nominal_table()));
        let known = aibo();
        let seen = recognise(cut, &AIBO, Gaze { pan, tilt }, &known);
        let sightings = (seen.ball.into_iter())
            .chain(seen.robots.iter().map(|(_, sighting)| *sighting))
            .chain(seen.landmarks.iter().map(|seen| seen.sighting));
        for Sighting { range, bearing } in sightings {
            prop_assert!(range.is_finite() && (0.0..=2.0 * known.farthest).contains(&range), "{}", range);
            prop_assert!(bearing.abs() <= std::f32::consts::PI);
        }
    }
}
