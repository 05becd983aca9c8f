//! One picture to be taken, and how points of the hall come onto it.

use bevy::math::Vec2;

use crate::geometry::{Pose, unit};
use crate::ids::RobotId;
use crate::ops;
use crate::vision::{CameraFlaws, CameraSettings, Gaze, Optics};
use crate::world::sense::sway::Sway;

/// A picture that a robot's camera is about to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Whose camera it is. Its own body is not in its pictures.
    pub robot: RobotId,
    /// Where that robot is, in the pitch frame. The lens is above this place.
    pub from: Pose,
    /// Where the camera looks, as the robot takes it to do.
    pub gaze: Gaze,
    /// How it is held in truth.
    pub sway: Sway,
    /// How the camera is built.
    pub optics: Optics,
    /// What the robot does not allow for.
    pub flaws: CameraFlaws,
    /// How it is set.
    pub settings: CameraSettings,
    /// How fast the camera turns to the left or to the right, body and head together, rad/s. Its sway comes on top.
    pub turn_rate: f32,
    /// Whether the robot holds the ball where its own camera does not see it.
    pub hides_ball: bool,
}

/// How long light falls on the sensor if the exposure is 1, s. ASSUMPTION: the middle one of the ERS-7's three shutter speeds.
const SHUTTER: f32 = 0.01;

impl Shot {
    /// Width and height, pixels.
    pub fn size(&self) -> (usize, usize) {
        self.optics.picture_size(self.settings.resolution)
    }

    /// How long light falls on the sensor, s: never longer than a frame lasts.
    pub fn exposure_time(&self) -> f32 {
        (self.settings.exposure * SHUTTER).min(1.0 / self.settings.frame_hz)
    }

    /// By how much the light of each of red, green and blue is amplified.
    pub fn amplification(&self) -> [f32; 3] {
        let balance = self.settings.white_balance;
        let all = self.settings.gain * self.exposure_time() / SHUTTER;
        [all * balance.red, all, all * balance.blue]
    }

    /// Over how many pixels a turn smears a point in the middle of the picture.
    pub fn smear(&self) -> f32 {
        self.pan_rate().abs() * self.exposure_time() * self.optics.focal_length(self.size().0)
    }

    fn pan_rate(&self) -> f32 {
        self.turn_rate + self.sway.pan_rate
    }

    /// Pixels that are drawn beyond each edge of the picture: a lens or a roll moves them into it.
    pub fn margin(&self) -> usize {
        (self.size().0 / 40).max(1)
    }

    /// How rows that are read one after the other show a camera's turn. Light falls on the middle row when the robot takes the
    /// picture to be taken.
    pub fn skew(&self) -> Skew {
        let (width, height) = self.size();
        let read_out = self.flaws.read_out.min(1.0 / self.settings.frame_hz);
        let way = read_out * self.optics.focal_length(width) / height as f32;
        let shift = |rate: f32| (rate * way).clamp(-MOST_SKEW, MOST_SKEW);
        Skew { aside: shift(-self.pan_rate()), along: shift(self.sway.tilt_rate) }
    }
}

/// By how many pixels what a row shows is moved, for each row below the middle one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Skew {
    /// To the right.
    pub aside: f32,
    /// Downwards.
    pub along: f32,
}

/// Pixels from a row to the next: no robot turns faster.
const MOST_SKEW: f32 = 8.0;

/// A camera's place and direction in the hall, ready for many points. Agrees with [`Optics::project`].
#[derive(Clone, Copy, Debug)]
pub struct Viewpoint {
    /// Of the lens, in the pitch frame.
    pub eye: Vec2,
    /// Of the lens above the carpet, m.
    pub height: f32,
    /// Where it looks, along the carpet: a unit vector.
    pub ahead: Vec2,
    /// Sine and cosine of the angle by which it looks down.
    pub tilt: (f32, f32),
    /// Pixels.
    pub focal: f32,
    /// Width and height of the picture with its margin, pixels.
    pub size: (usize, usize),
}

/// A point as a camera has it, and how bright it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// m.
    pub left: f32,
    /// Along the picture's columns, m.
    pub up: f32,
    /// Along the lens's axis, m.
    pub depth: f32,
    /// Its [shade](super::material::FULL_SHADE).
    pub shade: f32,
}

/// No lens touches the carpet, m.
const LOWEST: f32 = 0.001;

impl Viewpoint {
    /// That of a shot, with its margin.
    pub fn of(shot: &Shot) -> Viewpoint {
        let ((width, height), beyond) = (shot.size(), 2 * shot.margin());
        Viewpoint {
            eye: shot.from.position,
            height: (shot.optics.mount + shot.sway.rise).max(LOWEST),
            ahead: unit(shot.from.heading + shot.gaze.pan + shot.sway.pan),
            tilt: ops::sin_cos(shot.gaze.tilt + shot.sway.tilt),
            focal: shot.optics.focal_length(width),
            size: (width + beyond, height + beyond),
        }
    }

    /// A point of the pitch at a height in metres.
    pub fn corner(&self, at: Vec2, height: f32, shade: f32) -> Corner {
        let way = at - self.eye;
        let (ahead, left, rise) = (self.ahead.dot(way), self.ahead.perp_dot(way), height - self.height);
        let (sin, cos) = self.tilt;
        Corner { left, up: ahead * sin + rise * cos, depth: ahead * cos - rise * sin, shade }
    }

    /// The middle of the picture, in pixels from its left upper corner.
    pub fn middle(&self) -> Vec2 {
        Vec2::new(self.size.0 as f32, self.size.1 as f32) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;
    use crate::vision::{Resolution, WhiteBalance};

    fn shot() -> Shot {
        Shot {
            robot: RobotId::new(Team::Home, 1),
            from: Pose::new(1.0, -0.5, 2.0),
            gaze: Gaze { pan: -0.4, tilt: 0.3 },
            sway: Sway::default(),
            optics: Optics {
                width: 208,
                height: 160,
                field_of_view: 56.9,
                mount: 0.19,
                tilt: 10.0,
                nod: 40.0,
            },
            flaws: CameraFlaws::default(),
            settings: CameraSettings::default(),
            turn_rate: 0.0,
            hides_ball: false,
        }
    }

    #[test]
    fn a_point_comes_to_where_the_optics_project_it() {
        for resolution in [Resolution::Full, Resolution::Quarter] {
            let mut shot = shot();
            shot.settings.resolution = resolution;
            let view = Viewpoint::of(&shot);
            for local in [Vec2::new(1.0, 0.2), Vec2::new(2.0, -1.0), Vec2::new(0.4, 0.0)] {
                let corner = view.corner(shot.from.to_field(local), 0.3, 1.0);
                let middle = view.middle() - Vec2::splat(shot.margin() as f32);
                let ours = middle - Vec2::new(corner.left, corner.up) * (view.focal / corner.depth);
                let way = local.extend(0.3 - shot.optics.mount);
                let theirs = shot.optics.project(shot.size(), shot.gaze, way).unwrap();
                assert!(ours.distance(theirs) < 1e-2, "{ours} {theirs}");
            }
        }
    }

    #[test]
    fn light_falls_no_longer_than_a_frame_lasts() {
        let mut shot = shot();
        assert_eq!(shot.amplification(), [1.0; 3]);
        shot.settings.exposure = 2.0;
        shot.settings.white_balance = WhiteBalance { red: 1.5, blue: 0.5 };
        assert_eq!(shot.amplification(), [3.0, 2.0, 1.0]);
        shot.settings.frame_hz = 100.0;
        assert_eq!(shot.exposure_time(), SHUTTER);
    }

    #[test]
    fn a_turn_smears_by_the_way_that_the_picture_moves_while_light_falls() {
        let shot = Shot { turn_rate: -2.0, ..shot() };
        let way = shot.optics.focal_length(208) * 2.0 * SHUTTER;
        assert!((shot.smear() - way).abs() < 1e-4);
    }

    #[test]
    fn rows_that_are_read_late_show_a_turn_askew_and_no_row_is_read_after_the_next_picture() {
        let flaws = CameraFlaws { read_out: 0.03, ..CameraFlaws::default() };
        let mut shot = Shot { turn_rate: 1.0, flaws, ..shot() };
        let way = shot.optics.focal_length(208) * 0.03;
        assert!((shot.skew().aside * 160.0 + way).abs() < 1e-3, "{:?}", shot.skew());
        shot.settings.frame_hz = 100.0;
        assert!((shot.skew().aside * 160.0 + way / 3.0).abs() < 1e-3, "{:?}", shot.skew());
    }
}
