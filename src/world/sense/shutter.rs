//! When pictures are taken, and of what.

use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;

use super::eyesight::Eyesight;
use super::images::{HallLight, ImageEyes, ImageMemory, ImageSight, PictureHall};
use super::picture::{Moment, Shot, robot_paint};
use super::sway::{Stride, Sway};
use crate::clock::Clock;
use crate::geometry::{Pose, Twist};
use crate::ids::{RobotId, Team};
use crate::pitch::{BallKind, Pitch};
use crate::robot::handling::Handling;
use crate::robot::{CalibratedCamera, Head, Odometry, OffPitch, Robot, Trailer};
use crate::vision::Gaze;
use crate::vision::localise::{FilterErrors, PoseDeviation};
use crate::vision::paint::RobotPaint;
use crate::world::ball::Ball;
use crate::world::referee::MatchState;

/// A robot that sees by pictures.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Watcher {
    id: &'static RobotId,
    robot: &'static Robot,
    pose: &'static Pose,
    twist: &'static Twist,
    head: &'static Head,
    handling: &'static Handling,
    odometry: &'static Odometry,
    camera: &'static CalibratedCamera,
    eyes: &'static mut ImageEyes,
    memory: &'static mut ImageMemory,
    eyesight: &'static mut Eyesight,
}

type PaintedBody = (&'static RobotId, &'static Robot, &'static Pose, &'static Head);

/// All that pictures show.
#[derive(SystemParam)]
pub(super) struct Subjects<'w, 's> {
    pitch: Res<'w, Pitch>,
    kind: Res<'w, BallKind>,
    ball: Single<'w, 's, &'static Pose, With<Ball>>,
    bodies: Query<'w, 's, PaintedBody, Without<OffPitch>>,
    trailers: Query<'w, 's, (&'static Trailer, &'static Pose)>,
}

/// How often light that drifts is changed, Hz.
const DRIFT_HZ: f32 = 1.0;

pub(super) fn drift_light(clock: Res<Clock>, mut light: ResMut<HallLight>) {
    let drift = light.light.mean.drift;
    if clock.is_due(DRIFT_HZ) && (drift.brightness > 0.0 || drift.colour > 0.0) {
        light.drift(1.0 / DRIFT_HZ);
    }
}

pub(super) fn take_pictures(
    clock: Res<Clock>,
    state: Res<MatchState>,
    light: Res<HallLight>,
    subjects: Subjects,
    mut hall: ResMut<PictureHall>,
    mut moment: Local<Moment>,
    mut watchers: Query<Watcher, Without<OffPitch>>,
) {
    let mut is_filled = false;
    for watcher in &mut watchers {
        let WatcherItem {
            id,
            robot,
            pose,
            twist,
            head,
            handling,
            odometry,
            camera,
            mut eyes,
            mut memory,
            mut eyesight,
        } = watcher;
        let camera = &camera.0;
        let (Some(errors), true) = (errors(robot), clock.is_due(camera.settings.frame_hz)) else { continue };
        if robot.health.crashed {
            continue;
        }
        if !is_filled {
            subjects.fill(&mut moment);
            is_filled = true;
        }
        let (hall, known) = &*hall.of(&subjects.pitch, &subjects.kind, || subjects.paints());
        let tilt = if handling.hides_ball() { camera.optics.nod.to_radians() } else { memory.tilt() };
        let stride = Stride::after(clock.now(), camera.flaws.sway.rate, effort(robot, twist));
        let shot = Shot {
            robot: *id,
            from: *pose,
            gaze: Gaze { pan: head.pan, tilt },
            sway: Sway::of(&camera.flaws, stride, memory.mount(camera), head.pan),
            optics: camera.optics,
            flaws: camera.flaws,
            settings: camera.settings,
            turn_rate: twist.angular + memory.pan_rate(head.pan, &clock),
            hides_ball: handling.hides_ball(),
        };
        let sight = ImageSight {
            hall,
            known,
            moment: &moment,
            light: &light.light,
            pitch: &subjects.pitch,
            tick: clock.tick,
            dt: clock.dt,
            ends: state.attacking(id.team),
            odometry: odometry.pose,
            misled: eyesight.misled,
            errors,
        };
        let frame = memory.look(&mut eyes, &sight, &shot, camera);
        eyesight.under_way.push_back(frame);
    }
}

/// How fast a robot moves, as a share of its full speed, turns included.
fn effort(robot: &Robot, twist: &Twist) -> f32 {
    twist.linear.length() / robot.kind.max_speed() + twist.angular.abs() / robot.kind.max_turn()
}

impl Subjects<'_, '_> {
    /// Where everything is now. The order of a query depends on which other components robots have; a picture must not.
    fn fill(&self, moment: &mut Moment) {
        moment.clear();
        moment.ball = Some(self.ball.position);
        for (id, robot, pose, head) in self.bodies.iter().sort::<&RobotId>() {
            let trailer = self.trailers.iter().find(|(trailer, _)| trailer.of == *id).map(|(_, pose)| *pose);
            moment.add(*id, &robot.kind, *pose, head.pan, trailer);
        }
    }

    /// How the robots of each team are painted.
    fn paints(&self) -> [RobotPaint; 2] {
        Team::BOTH.map(|team| {
            let of_team = self.bodies.iter().find(|(id, ..)| id.team == team);
            of_team.map_or(RobotPaint::WALKER, |(_, robot, ..)| robot_paint(&robot.kind))
        })
    }
}

/// What pushes and slips that no motor feels do to a robot's place. ASSUMPTION.
const UNFELT: PoseDeviation = PoseDeviation { place: 0.05, heading: 0.1 };

/// How long the error of one landmark lasts, s. ASSUMPTION.
const LASTING: f32 = 0.3;

/// The errors that a robot takes its own odometry and pictures to have.
fn errors(robot: &Robot) -> Option<FilterErrors> {
    let eyes = &robot.sensing.eyes;
    let (camera, odometry) = (eyes.camera()?, eyes.odometry()?);
    Some(FilterErrors {
        bearing: camera.bearing_noise.to_radians(),
        lasting: LASTING,
        way: odometry.distance,
        turn: odometry.heading.to_radians(),
        unfelt: UNFELT,
    })
}
