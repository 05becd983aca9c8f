//! Eyes that are pictures: each is drawn of the truth, cut by colour and worked out as a robot's own program does it. Whatever is
//! wrong in a picture is wrong in what the robot knows.

use std::fmt;
use std::sync::Arc;

use bevy::prelude::*;

use super::localisation::PoseError;
use super::picture::{Canvas, Hall, Light, Moment, Shot};
use super::sway::MountError;
use crate::clock::Clock;
use crate::geometry::{Attacking, Pose, Sighting};
use crate::ops;
use crate::pitch::{BallKind, Pitch};
use crate::rng::{Dice, DiceStirred, Seed};
use crate::robot::{Fix, Frame, PlaceError, PutDown, Robot, RobotStart, SwitchedOn};
use crate::state::RegisterState;
use crate::vision::localise::{FilterErrors, PoseDeviation, PoseFilter, SeenLandmark};
use crate::vision::paint::RobotPaint;
use crate::vision::{
    CameraCalibration, ColourClass, ColourLookup, Gaze, Image, KnownObjects, LandmarkSighting, Optics,
    Recognised, Segmented, Segmenter, recognise,
};

pub(super) fn state(app: &mut App) {
    app.match_resource::<PictureHall>().starts_empty();
    app.match_resource::<HallLight>();
    app.match_component::<ImageMemory>()
        .may_start(|start: &RobotStart, _| start.calibration.is_some().then(|| ImageMemory::new(start)))
        .on(|memory, stirred: &DiceStirred, _| memory.dice.stir(*stirred))
        .on(|memory, put: &PutDown, owner| {
            if let Some(robot) = owner.get::<Robot>() {
                memory.filter = PoseFilter::told(put.told, by_hand(robot.sensing.eyes.put_down()));
            }
        })
        .on(|memory, _: &SwitchedOn, _| memory.filter = PoseFilter::lost());
    // Pixels are drawn anew with the next frame.
    app.match_component_by::<ImageEyes, ()>(|_| (), |(), _| {}, |()| String::new())
        .may_start(|start: &RobotStart, _| start.calibration.is_some().then(ImageEyes::default));
}

/// How well a robot knows its place that people have put down.
fn by_hand(error: PlaceError) -> PoseDeviation {
    PoseDeviation { place: error.position, heading: error.heading.to_radians() }
}

/// The light of the hall, and the dice by which it drifts.
#[derive(Resource, Clone, Debug)]
pub struct HallLight {
    /// As it is now.
    pub light: Light,
    dice: Dice,
}

impl HallLight {
    /// The light with which a match begins.
    pub fn new(light: Light, seed: Seed) -> HallLight {
        HallLight { light, dice: Dice::new(seed, "light", None) }
    }

    /// Another chance from here on.
    pub fn stir(&mut self, stirred: DiceStirred) {
        self.dice.stir(stirred);
    }

    /// Lets the light drift for some seconds.
    pub(super) fn drift(&mut self, dt: f32) {
        self.light = self.light.drifted(dt, &mut self.dice);
    }
}

/// What of a hall does not move and robots know beforehand; drawn when the first picture is.
#[derive(Resource, Clone, Default)]
pub struct PictureHall(Option<Arc<(Hall, KnownObjects)>>);

impl PictureHall {
    /// What robots know of it beforehand. Nothing before the first picture.
    pub fn known(&self) -> Option<&KnownObjects> {
        self.0.as_deref().map(|(_, known)| known)
    }

    pub(super) fn of(
        &mut self,
        pitch: &Pitch,
        ball: &BallKind,
        paints: impl FnOnce() -> [RobotPaint; 2],
    ) -> Arc<(Hall, KnownObjects)> {
        let draw = || Arc::new((Hall::of(pitch, ball), KnownObjects::new(pitch, ball, paints())));
        self.0.get_or_insert_with(draw).clone()
    }
}

impl fmt::Debug for PictureHall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "drawn" } else { "not drawn" })
    }
}

/// The camera of a robot that sees by pictures, with the last picture and how it was cut.
#[derive(Component, Default)]
pub struct ImageEyes {
    canvas: Canvas,
    segmenter: Segmenter,
    /// The calibration by which pictures are cut, worked out.
    cut_by: Option<(Arc<CameraCalibration>, ColourLookup)>,
}

/// What a robot that sees by pictures knows of the last ones, and what the next one depends on.
#[derive(Component, Clone, Debug)]
pub struct ImageMemory {
    last: Option<LastLook>,
    /// In the team frame.
    filter: PoseFilter,
    /// rad downwards
    tilt: f32,
    /// What joints and mount of the camera are off, of which the robot knows nothing.
    mount: MountError,
    mount_dice: Dice,
    dice: Dice,
}

/// The last picture, but for its pixels.
#[derive(Clone, Debug)]
pub struct LastLook {
    /// When it was taken.
    pub tick: u64,
    /// Where the camera looked.
    pub gaze: Gaze,
    /// What the robot recognised.
    pub recognised: Recognised,
}

impl ImageEyes {
    /// The last picture; black before the first one.
    pub fn image(&self) -> &Image {
        self.canvas.image()
    }

    /// How the last picture was cut.
    pub fn segmented(&self) -> Segmented<'_> {
        self.segmenter.segmented()
    }

    /// What each pixel of the last picture truly shows.
    pub fn truth(&self) -> impl Iterator<Item = Option<ColourClass>> + '_ {
        self.canvas.truth()
    }

    /// Takes a picture and recognises what it shows.
    fn recognise(
        &mut self,
        sight: &ImageSight,
        shot: &Shot,
        camera: &Arc<CameraCalibration>,
        dice: &mut Dice,
    ) -> Recognised {
        let known = self.cut_by.take().filter(|(known, _)| Arc::ptr_eq(known, camera));
        let cut_by = known.unwrap_or_else(|| (camera.clone(), ColourLookup::new(&camera.colours)));
        self.canvas.draw(sight.hall, sight.moment, shot, sight.light, dice);
        let segmented = self.segmenter.segment(self.canvas.image(), &cut_by.1);
        self.cut_by = Some(cut_by);
        recognise(segmented, &camera.optics, shot.gaze, sight.known)
    }
}

impl ImageMemory {
    fn new(start: &RobotStart) -> ImageMemory {
        let tilt = start.calibration.as_ref().map_or(0.0, |camera| camera.optics.tilt.to_radians());
        let error = by_hand(start.sensing.eyes.put_down());
        let filter = start.told.map_or_else(PoseFilter::lost, |told| PoseFilter::told(told, error));
        let dice = Dice::new(start.seed, "picture", Some(start.id));
        let mut mount_dice = Dice::new(start.seed, "camera mount", Some(start.id));
        let play = start.calibration.as_ref().map(|camera| camera.flaws.play).unwrap_or_default();
        let mount = MountError::drawn(&play, &mut mount_dice);
        ImageMemory { last: None, filter, tilt, mount, mount_dice, dice }
    }

    /// What joints and mount are off now.
    pub(super) fn mount(&mut self, camera: &CameraCalibration) -> MountError {
        let dt = 1.0 / camera.settings.frame_hz;
        self.mount = self.mount.drifted(&camera.flaws.play, dt, &mut self.mount_dice);
        self.mount
    }

    /// The last picture, and what the robot recognised in it. Nothing before the first one.
    pub fn last(&self) -> Option<&LastLook> {
        self.last.as_ref()
    }

    /// The robot's own idea of its place, in its team frame.
    pub fn filter(&self) -> &PoseFilter {
        &self.filter
    }

    /// By how much the camera looks down, rad.
    pub(super) fn tilt(&self) -> f32 {
        self.tilt
    }

    /// How fast the head has turned since the last picture, rad/s.
    pub(super) fn pan_rate(&self, pan: f32, clock: &Clock) -> f32 {
        self.last.as_ref().map_or(0.0, |last| {
            (pan - last.gaze.pan) / (clock.tick.saturating_sub(last.tick).max(1) as f32 * clock.dt)
        })
    }

    /// Takes a picture and works it out. What the robot recognises is a frame of its camera; a fix is where its own filter has
    /// it, once that is as sure as a fix should be.
    pub(super) fn look(
        &mut self,
        eyes: &mut ImageEyes,
        sight: &ImageSight,
        shot: &Shot,
        camera: &Arc<CameraCalibration>,
    ) -> Frame {
        let recognised = eyes.recognise(sight, shot, camera, &mut self.dice);
        self.tilt = nod(&camera.optics, recognised.ball);
        let frame = Frame {
            taken: sight.tick,
            ball: recognised.ball.filter(|_| !shot.hides_ball),
            robots: recognised.robots.clone(),
            fix: self.find_place(sight, &recognised.landmarks),
            pan: shot.gaze.pan,
            chin_down: shot.hides_ball,
        };
        self.last = Some(LastLook { tick: sight.tick, gaze: shot.gaze, recognised });
        frame
    }

    /// Where the robot takes itself to be, after what it recognised.
    fn find_place(&mut self, sight: &ImageSight, landmarks: &[LandmarkSighting]) -> Option<Fix> {
        let place = |seen: &LandmarkSighting| {
            let place = sight.ends.turn(seen.landmark.place(sight.pitch)?);
            Some(SeenLandmark { place, sighting: seen.sighting, range_deviation: seen.range_deviation })
        };
        let seen: Vec<SeenLandmark> = landmarks.iter().filter_map(place).collect();
        self.filter.odometry(sight.tick, sight.odometry);
        self.filter.see(sight.tick, &seen, &sight.errors, sight.dt);
        let found = self.filter.pose_then().filter(|_| self.filter.share() >= SURE)?;
        let misled = sight.misled.applied(sight.ends.turn_pose(found));
        Some(Fix { pose: sight.ends.turn_pose(misled), share: 1.0 })
    }
}

/// What one robot's look is taken of, and when.
pub(super) struct ImageSight<'a> {
    pub hall: &'a Hall,
    pub known: &'a KnownObjects,
    pub moment: &'a Moment,
    pub light: &'a Light,
    pub pitch: &'a Pitch,
    pub tick: u64,
    /// Seconds of a tick.
    pub dt: f32,
    /// Which way the robot's team plays.
    pub ends: Attacking,
    /// The pose of its odometry.
    pub odometry: Pose,
    /// What a script adds to the robot's place, in the pitch frame.
    pub misled: PoseError,
    pub errors: FilterErrors,
}

/// A filter less trustworthy than this brings no fix. ASSUMPTION.
const SURE: f32 = 0.3;
/// How far below the middle of a picture a near ball is held, as a share of half the picture's angle. ASSUMPTION: so that
/// what is ahead of it is seen too.
const LOW: f32 = 0.5;

/// By how much a camera looks down to keep a ball in its pictures, rad.
pub fn nod(optics: &Optics, ball: Option<Sighting>) -> f32 {
    let (rest, most) = (optics.tilt.to_radians(), optics.nod.to_radians());
    let Some(ball) = ball else { return rest };
    let half_height = ops::atan(optics.height as f32 / 2.0 / optics.focal_length(optics.width));
    let down = ops::atan2(optics.mount, ball.range);
    (down - LOW * half_height).clamp(rest, most.max(rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_looks_down_at_a_near_ball_and_straight_ahead_else() {
        let optics =
            Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 10.0, nod: 40.0 };
        let nods = |range: f32| nod(&optics, Some(Sighting { range, bearing: 0.0 })).to_degrees();
        assert_eq!(nod(&optics, None).to_degrees(), 10.0);
        assert!((nods(3.0) - 10.0).abs() < 1e-4);
        assert!(nods(0.3) > 20.0 && nods(0.3) < 25.0, "{}", nods(0.3));
        assert!((nods(0.02) - 40.0).abs() < 1e-4);
    }
}
