//! Whole pictures, against the geometry of the optics and against each other.

use std::f32::consts::PI;

use bevy::math::{Vec2, Vec3};

use super::*;
use crate::data::Source;
use crate::geometry::{Pose, angle};
use crate::ids::{RobotId, Team};
use crate::pitch::{BallKind, Pitch};
use crate::rng::{Dice, Seed};
use crate::robot::RobotKind;
use crate::testing::{BALL, cye, pitch};
use crate::vision::{CameraFlaws, CameraSettings, ColourClass, Gaze, Image, Optics, Resolution};
use crate::world::sense::sway::Sway;

const ME: RobotId = RobotId::new(Team::Home, 1);
const OTHER: RobotId = RobotId::new(Team::Away, 2);
const SMALL_BALL: BallKind = BallKind { radius: 0.045, ..BALL };
const NOSE: Optics =
    Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 10.0, nod: 40.0 };

fn four_legged() -> Pitch {
    let text = include_str!("../../../../assets/pitches/four_legged_2005.ron");
    Source::new("pitch.ron", text).parse().unwrap()
}

fn aibo() -> RobotKind {
    let text = include_str!("../../../../assets/robots/aibo_ers7.ron");
    Source::new("aibo.ron", text).parse().unwrap()
}

fn shot(from: Pose, tilt: f32) -> Shot {
    Shot {
        robot: ME,
        from,
        gaze: Gaze { pan: 0.0, tilt },
        sway: Sway::default(),
        optics: NOSE,
        flaws: CameraFlaws::default(),
        settings: CameraSettings::default(),
        turn_rate: 0.0,
        hides_ball: false,
    }
}

/// A hall, what is in it, and where pictures of it are drawn.
struct Studio {
    hall: Hall,
    moment: Moment,
    light: Light,
    canvas: Canvas,
}

impl Studio {
    fn new() -> Studio {
        let light = Light::new(Lighting { unevenness: 0.0, ..Lighting::default() });
        let hall = Hall::of(&four_legged(), &SMALL_BALL);
        Studio { hall, moment: Moment::default(), light, canvas: Canvas::default() }
    }

    fn with_ball(at: Vec2) -> Studio {
        let mut studio = Studio::new();
        studio.moment.ball = Some(at);
        studio
    }

    fn take(&mut self, shot: &Shot) -> &Image {
        let mut dice = Dice::new(Seed(5), "pictures", None);
        self.canvas.draw(&self.hall, &self.moment, shot, &self.light, &mut dice);
        self.canvas.image()
    }

    /// Pixels of a class, by their middles.
    fn pixels(&mut self, shot: &Shot, class: ColourClass) -> Vec<Vec2> {
        self.take(shot);
        let width = shot.size().0;
        let place = |index: usize| Vec2::new((index % width) as f32 + 0.5, (index / width) as f32 + 0.5);
        let shown = self.canvas.truth().enumerate().filter(|(_, shown)| *shown == Some(class));
        shown.map(|(index, _)| place(index)).collect()
    }

    fn centroid(&mut self, shot: &Shot, class: ColourClass) -> Vec2 {
        let pixels = self.pixels(shot, class);
        assert!(!pixels.is_empty(), "no {class}");
        pixels.iter().sum::<Vec2>() / pixels.len() as f32
    }
}

/// Where the optics say that a point of the pitch is.
fn projected(shot: &Shot, at: Vec2, height: f32) -> Vec2 {
    let way: Vec3 = shot.from.to_local(at).extend(height - shot.optics.mount);
    shot.optics.project(shot.size(), shot.gaze, way).unwrap()
}

#[test]
fn the_ball_is_where_the_optics_project_it_and_as_large() {
    for (from, pan, tilt, ball) in [
        (Pose::new(-1.0, 0.3, 0.4), 0.0, 0.2, Vec2::new(-0.2, 0.7)),
        (Pose::new(1.0, -0.5, 2.0), -0.5, 0.1, Vec2::new(0.9, 0.8)),
        (Pose::new(0.0, 0.0, -2.0), 0.3, 0.5, Vec2::new(-0.1, -0.5)),
    ] {
        for resolution in [Resolution::Full, Resolution::Half] {
            let mut shot = shot(from, tilt);
            shot.gaze.pan = pan;
            shot.settings.resolution = resolution;
            let mut studio = Studio::with_ball(ball);
            let (seen, meant) = (studio.centroid(&shot, ColourClass::Orange), projected(&shot, ball, 0.045));
            assert!(seen.distance(meant) < 1.0, "{resolution:?} {seen} {meant}");
            let area = studio.pixels(&shot, ColourClass::Orange).len() as f32;
            let range = ball.distance(from.position).hypot_with(0.145);
            let radius = shot.optics.focal_length(shot.size().0) * 0.045 / range;
            assert!((area / (PI * radius * radius) - 1.0).abs() < 0.25, "{area} {radius}");
        }
    }
}

#[test]
fn a_camera_that_sways_shows_the_ball_where_it_looks_in_truth() {
    let (from, ball) = (Pose::new(-1.0, 0.3, 0.4), Vec2::new(0.1, 0.6));
    let straight = shot(from, 0.2);
    let sway = Sway { pan: 0.03, tilt: -0.02, ..Sway::default() };
    let mut studio = Studio::with_ball(ball);
    let seen = studio.centroid(&Shot { sway, ..straight }, ColourClass::Orange);
    let held = Shot { gaze: Gaze { pan: 0.03, tilt: 0.18 }, ..straight };
    assert!(seen.distance(projected(&held, ball, 0.045)) < 1.0, "{seen}");
    assert!(seen.distance(projected(&straight, ball, 0.045)) > 5.0, "{seen}");
}

#[test]
fn a_camera_that_rolls_clockwise_shows_what_is_on_the_left_lower() {
    let from = Pose::default();
    let roll = 0.08;
    for (ball, side) in [(Vec2::new(1.0, 0.4), 1.0), (Vec2::new(1.0, -0.4), -1.0)] {
        let straight = shot(from, 0.2);
        let mut studio = Studio::with_ball(ball);
        let level = studio.centroid(&straight, ColourClass::Orange);
        let rolled = studio
            .centroid(&Shot { sway: Sway { roll, ..Sway::default() }, ..straight }, ColourClass::Orange);
        let fall = (rolled.y - level.y) * side;
        let meant = roll * (level.x - 104.0).abs();
        assert!((fall - meant).abs() < 1.0, "{ball} {fall}, not {meant}");
    }
}

#[test]
fn a_lens_with_distortion_draws_the_edges_as_brown_says() {
    let flaws = CameraFlaws { distortion: (-0.147, 0.385), ..CameraFlaws::default() };
    for bearing in [0.42_f32, 0.3, -0.25] {
        let ball = crate::geometry::unit(bearing);
        let shot = Shot { flaws, ..shot(Pose::default(), 0.145) };
        let seen = Studio::with_ball(ball).centroid(&shot, ColourClass::Orange) - Vec2::new(104.0, 80.0);
        let straight = projected(&shot, ball, 0.045) - Vec2::new(104.0, 80.0);
        let square = (straight / NOSE.focal_length(208)).length_squared();
        let meant = straight * (1.0 - 0.147 * square + 0.385 * square * square);
        assert!(seen.distance(meant) < 0.6, "{bearing}: {seen}, not {meant}");
    }
}

#[test]
fn a_turn_leans_what_stands_upright_if_rows_are_read_one_after_the_other() {
    let mut studio = Studio::new();
    let beacon = Vec2::new(1.35, 2.1);
    let from = Pose::new(0.2, 0.8, angle(beacon - Vec2::new(0.2, 0.8)));
    let flaws = CameraFlaws { read_out: 0.03, ..CameraFlaws::default() };
    let mut lean = |turn_rate: f32| {
        let shot = Shot { flaws, turn_rate, ..shot(from, -0.05) };
        let (upper, lower) =
            (studio.centroid(&shot, ColourClass::Pink), studio.centroid(&shot, ColourClass::SkyBlue));
        (lower.x - upper.x, lower.y - upper.y)
    };
    // A camera that turns to the left reads the lower band later, when it is farther to the right.
    let (still, turning) = (lean(0.0), lean(2.0));
    let meant = 2.0 * 0.03 * NOSE.focal_length(208) * still.1 / 160.0;
    assert!(still.0.abs() < 0.3 && (turning.0 - meant).abs() < 0.4, "{still:?} {turning:?}, not {meant}");
}

trait HypotWith {
    fn hypot_with(self, other: f32) -> f32;
}

impl HypotWith for f32 {
    fn hypot_with(self, other: f32) -> f32 {
        (self * self + other * other).sqrt()
    }
}

#[test]
fn a_beacon_shows_its_two_colours_one_above_the_other_where_it_stands() {
    let beacon = Vec2::new(1.35, 2.1);
    let from = Pose::new(0.2, 0.8, angle(beacon - Vec2::new(0.2, 0.8)));
    let (mut studio, shot) = (Studio::new(), shot(from, -0.05));
    for (class, height) in [(ColourClass::Pink, 0.35), (ColourClass::SkyBlue, 0.25)] {
        let (seen, meant) = (studio.centroid(&shot, class), projected(&shot, beacon, height));
        assert!(seen.distance(meant) < 1.0, "{class} {seen} {meant}");
    }
}

#[test]
fn a_line_of_the_floor_is_on_the_row_that_the_optics_say() {
    let mut studio = Studio::new();
    for range in [0.3, 0.6, 1.0] {
        let shot = shot(Pose::new(-range, 1.0, 0.0), 0.35);
        let column: Vec<f32> = (studio.pixels(&shot, ColourClass::White).into_iter())
            .filter(|at| at.x == 104.5)
            .map(|at| at.y)
            .collect();
        let row = column.iter().sum::<f32>() / column.len() as f32;
        let seen = NOSE.on_plane((208, 160), shot.gaze, Vec2::new(104.5, row), 0.0).unwrap();
        let pixel = projected(&shot, Vec2::new(0.0, 1.0), 0.0).y;
        assert!((row - pixel).abs() <= 1.0, "{range}: row {row}, not {pixel}; {seen:?}");
    }
}

#[test]
fn each_goal_has_its_colour_inside_and_none_from_behind() {
    let mut studio = Studio::new();
    let west = shot(Pose::new(-1.5, 0.0, PI), 0.05);
    let east = shot(Pose::new(1.5, 0.0, 0.0), 0.05);
    let behind = shot(Pose::new(3.5, 0.0, PI), 0.05);
    let count = |studio: &mut Studio, shot: &Shot, class| studio.pixels(shot, class).len();
    assert!(count(&mut studio, &west, ColourClass::Yellow) > 1000);
    assert_eq!(count(&mut studio, &west, ColourClass::SkyBlue), 0);
    assert!(count(&mut studio, &east, ColourClass::SkyBlue) > 1000);
    assert_eq!(count(&mut studio, &east, ColourClass::Yellow), 0);
    assert_eq!(count(&mut studio, &behind, ColourClass::SkyBlue), 0);
}

#[test]
fn a_robot_hides_the_ball_behind_it_and_is_hidden_by_none_of_its_own_pictures() {
    let shot = shot(Pose::default(), 0.2);
    let mut studio = Studio::with_ball(Vec2::new(1.2, 0.0));
    let free = studio.pixels(&shot, ColourClass::Orange).len();
    assert!(free > 20);
    studio.moment.add(ME, &aibo(), shot.from, 0.0, None);
    assert_eq!(studio.pixels(&shot, ColourClass::Orange).len(), free, "its own body");
    assert!(studio.pixels(&shot, ColourClass::Red).is_empty());
    studio.moment.add(OTHER, &aibo(), Pose::new(0.7, 0.0, 1.0), 0.0, None);
    assert!(studio.pixels(&shot, ColourClass::Orange).is_empty(), "behind the other");
    let (marker, meant) =
        (studio.centroid(&shot, ColourClass::DarkBlue), projected(&shot, Vec2::new(0.6, 0.0), 0.14));
    assert!(marker.distance(meant) < 12.0, "{marker} {meant}");
    studio.moment.ball = Some(Vec2::new(0.35, 0.0));
    assert!(studio.pixels(&shot, ColourClass::Orange).len() > free, "before the other");
    assert!(studio.pixels(&Shot { hides_ball: true, ..shot }, ColourClass::Orange).is_empty(), "held");
}

#[test]
fn the_marker_of_a_robot_on_wheels_is_on_its_shaft() {
    let mut studio = Studio::new();
    studio.hall = Hall::of(&pitch(), &BALL);
    let mut shot = shot(Pose::new(-1.0, 0.0, 0.0), 0.0);
    shot.optics.mount = 0.65;
    studio.moment.add(OTHER, &cye(), Pose::new(1.0, 0.3, 2.0), 0.0, Some(Pose::new(1.0, 0.3, 1.0)));
    let seen = studio.centroid(&shot, ColourClass::DarkBlue);
    let meant = projected(&shot, Vec2::new(1.0, 0.3), 0.525);
    assert!(seen.distance(meant) < 1.0, "{seen} {meant}");
}

#[test]
fn equal_inputs_give_equal_bytes_and_other_dice_other_noise() {
    let shot = shot(Pose::new(-0.8, 0.2, 0.1), 0.2);
    let mut studio = Studio::with_ball(Vec2::new(-0.2, 0.2));
    studio.light = Light::new(Lighting::default());
    studio.moment.add(OTHER, &aibo(), Pose::new(0.3, 0.4, 2.0), 0.5, None);
    let image = studio.take(&shot).clone();
    studio.take(&Shot { turn_rate: 4.0, from: Pose::new(1.0, 1.0, 1.0), ..shot });
    assert_eq!(studio.take(&shot), &image, "whatever was drawn before");
    let mut dice = Dice::new(Seed(6), "pictures", None);
    studio.canvas.draw(&studio.hall, &studio.moment, &shot, &studio.light, &mut dice);
    assert_ne!(studio.canvas.image(), &image);
}

fn spread(image: &Image, rows: std::ops::Range<usize>) -> f32 {
    let values: Vec<f32> = rows
        .flat_map(|row| (100..108).map(move |column| (column, row)))
        .filter_map(|(column, row)| image.at(column, row))
        .map(|pixel| f32::from(pixel.y))
        .collect();
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f32>() / values.len() as f32).sqrt()
}

#[test]
fn gain_amplifies_noise_and_exposure_does_so_less() {
    let mut studio = Studio::new();
    let plain = shot(Pose::new(1.0, 1.0, 2.0), 0.6);
    let mut of = |gain: f32, exposure: f32| {
        let settings = CameraSettings { gain, exposure, ..plain.settings };
        spread(studio.take(&Shot { settings, ..plain }), 120..150)
    };
    let (usual, loud, long) = (of(1.0, 1.0), of(2.0, 1.0), of(1.0, 2.0));
    assert!(usual > 1.0 && loud > 1.7 * usual && long < 1.5 * usual, "{usual} {loud} {long}");
}

#[test]
fn a_fast_turn_smears_what_stands_upright_but_no_level_edge() {
    let mut studio = Studio::new();
    let still = shot(Pose::new(0.2, 0.0, 0.0), 0.1);
    // Pixels that are neither the sky-blue goal nor what is beside it.
    let between = |image: &Image| {
        let row = 65;
        (0..208)
            .filter_map(|column| image.at(column, row))
            .filter(|pixel| (138..155).contains(&pixel.u))
            .count()
    };
    let sharp = between(studio.take(&still));
    let smeared = between(studio.take(&Shot { turn_rate: 8.0, ..still }));
    assert!(smeared >= sharp + 8, "{sharp} {smeared}");
}

#[test]
fn a_corner_of_a_picture_is_darker_and_bluer_than_its_middle() {
    let mut studio = Studio::new();
    let shot = shot(Pose::new(1.0, 1.0, 2.3), 1.0);
    let image = studio.take(&shot);
    let mean = |x: usize, y: usize, channel: fn(crate::vision::Yuv) -> u8| {
        let block = (0..64).filter_map(|index| image.at(x + index % 8, y + index / 8));
        block.map(|pixel| f32::from(channel(pixel))).sum::<f32>() / 64.0
    };
    assert!(mean(0, 150, |pixel| pixel.y) < 0.85 * mean(100, 76, |pixel| pixel.y));
    assert!(mean(0, 150, |pixel| pixel.u) > mean(100, 76, |pixel| pixel.u) + 5.0);
}

#[test]
fn bodies_throw_shadows_on_the_carpet() {
    let shot = shot(Pose::default(), 0.5);
    let mut studio = Studio::new();
    let under = projected(&shot, Vec2::new(0.44, 0.0), 0.0);
    let bright = |image: &Image| {
        let block = (0..16)
            .filter_map(|index| image.at(under.x as usize - 4 + index % 8, under.y as usize + index / 8));
        block.map(|pixel| u32::from(pixel.y)).sum::<u32>()
    };
    let before = bright(studio.take(&shot));
    studio.moment.ball = Some(Vec2::new(0.47, 0.0));
    let after = bright(studio.take(&shot));
    assert!(f64::from(after) < 0.8 * f64::from(before), "{before} {after}");
}

#[test]
fn every_place_and_direction_can_be_drawn() {
    let mut studio = Studio::with_ball(Vec2::new(0.1, 0.0));
    studio.moment.add(OTHER, &aibo(), Pose::new(0.2, 0.1, 2.0), 0.5, None);
    for place in
        [Vec2::ZERO, Vec2::new(0.1, 0.0), Vec2::new(2.8, 0.2), Vec2::new(-3.6, -2.9), Vec2::new(90.0, 90.0)]
    {
        for step in 0..12 {
            let tilt = -1.5 + 0.27 * step as f32;
            for width in [16, 208] {
                let mut shot = shot(Pose { position: place, heading: step as f32 }, tilt);
                shot.optics = Optics { width, field_of_view: 150.0, ..NOSE };
                shot.turn_rate = 1000.0;
                shot.settings.exposure = 10.0;
                assert_eq!(studio.take(&shot).pixels.len(), width * 160);
            }
        }
    }
}
