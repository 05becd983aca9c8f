//! The Sense stage: truth becomes what a robot can know of it. Everything after this stage works on percepts and beliefs.
//!
//! A camera takes frames at its own rate, each arrives after its latency. The wheels report at every tick.

mod camera;
mod eyesight;
mod images;
mod landmarks;
mod localisation;
mod odometry;
pub mod picture;
mod shutter;
pub mod sway;
#[cfg(test)]
mod tests;

pub use camera::{Blob, detection, visible_share};
pub use eyesight::Eyesight;
pub use images::{HallLight, ImageEyes, ImageMemory, LastLook, PictureHall, nod};
pub use picture::{Light, LightDrift, Lighting, robot_paint};

use bevy::prelude::*;
use smallvec::SmallVec;

use camera::look;
use landmarks::{View, fix_share};
use localisation::PoseError;
use odometry::read_odometry;

use crate::clock::Clock;
use crate::geometry::{Pose, Sighting, wrap_angle};
use crate::ids::RobotId;
use crate::pitch::{BallKind, Pitch};
use crate::rng::{Dice, DiceStirred};
use crate::robot::handling::Handling;
use crate::robot::{
    Camera, Eyes, Fix, Frame, Head, Localisation, Misled, OffPitch, Percepts, PutDown, Robot, RobotStart,
    SwitchedOn, Trailer,
};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::world::ball::Ball;
use crate::world::referee::MatchState;

pub(super) fn plugin(app: &mut App) {
    app.match_component::<Eyesight>()
        .starts(|start: &RobotStart, _| Eyesight::new(&start.sensing, start.seed, start.id))
        .on(|eyesight, _: &PutDown, _| eyesight.blink())
        .on(|eyesight, _: &SwitchedOn, _| eyesight.blink())
        .on(|eyesight, misled: &Misled, _| eyesight.misled = PoseError::of(misled.by, misled.turn))
        .on(|eyesight, stirred: &DiceStirred, _| eyesight.stir(*stirred));
    images::state(app);
    let pictures = shutter::take_pictures.run_if(any_with_component::<ImageEyes>);
    let in_order = (take_frames, read_odometry, shutter::drift_light, pictures, deliver_frames).chain();
    app.add_systems(Tick, in_order.in_set(TickSystems::Sense));
}

/// What a robot takes its pose in the team frame to be that people have put down, if it is a robot.
pub fn told_place(world: &mut World, robot: Entity, truth: Pose) -> Pose {
    let Some(sensing) = world.get::<Robot>(robot).map(|robot| robot.sensing.clone()) else { return truth };
    let mut eyes = world.get_mut::<Eyesight>(robot);
    eyes.as_mut().map_or(truth, |eyesight| eyesight.put_down(truth, &sensing))
}

/// Everything solid that a camera may see.
struct Surroundings {
    ball: Vec2,
    ball_radius: f32,
    /// Drive units, with their markers.
    robots: Vec<(RobotId, Vec2, f32)>,
    /// Trailers only hide other things.
    trailers: Vec<(RobotId, Vec2, f32)>,
}

type SeenBodies<'w, 's> = Query<'w, 's, (&'static RobotId, &'static Robot, &'static Pose), Without<OffPitch>>;

type Watching<'a> = (&'a RobotId, &'a Robot, &'a Pose, &'a Head, &'a Handling, &'a mut Eyesight);

/// Where a camera looks from, and how.
#[derive(Clone, Copy, Debug)]
struct CameraPose {
    from: Pose,
    pan: f32,
    chin_down: bool,
}

fn take_frames(
    clock: Res<Clock>,
    (state, pitch, kind): (Res<MatchState>, Res<Pitch>, Res<BallKind>),
    ball: Single<&Pose, With<Ball>>,
    bodies: SeenBodies,
    trailers: Query<(&Trailer, &Pose)>,
    mut eyes: Query<Watching, Without<OffPitch>>,
) {
    let mut scene = None;
    for (&id, robot, &pose, head, handling, mut eyesight) in &mut eyes {
        let eyesight = &mut *eyesight;
        let team_pose = state.attacking(id.team).turn_pose(eyesight.misled.applied(pose));
        match &robot.sensing.eyes {
            Eyes::Perfect if robot.senses(&clock) => {
                let scene = scene.get_or_insert_with(|| Surroundings::of((&kind, *ball), &bodies, &trailers));
                eyesight.under_way.push_back(scene.seen_perfectly(id, pose, team_pose, clock.tick));
            }
            Eyes::Real { camera, localisation, .. } if clock.is_due(camera.frame_hz) => {
                let dt = 1.0 / camera.frame_hz;
                eyesight.error = eyesight.error.drift(localisation, dt, &mut eyesight.localisation_dice);
                let scene = scene.get_or_insert_with(|| Surroundings::of((&kind, *ball), &bodies, &trailers));
                let gaze = CameraPose { from: pose, pan: head.pan, chin_down: handling.hides_ball() };
                let (mut frame, robots) = scene.seen_through(camera, id, gaze, &mut eyesight.camera_dice);
                let view = View {
                    from: Pose { heading: pose.heading + head.pan, ..pose },
                    field_of_view: camera.field_of_view,
                    ball: frame.ball,
                    robots: &robots,
                };
                let share = share_of(localisation, &pitch, &view);
                mistake_teams(&mut frame, camera.wrong_team, &mut eyesight.identity_dice);
                frame.taken = clock.tick;
                frame.fix = (share > 0.0).then(|| Fix { pose: eyesight.error.applied(team_pose), share });
                eyesight.under_way.push_back(frame);
            }
            _ => {}
        }
    }
}

/// Takes some robots of a frame for robots of the other team.
fn mistake_teams(frame: &mut Frame, chance: f32, dice: &mut Dice) {
    for (team, _) in &mut frame.robots {
        if dice.chance(chance) {
            *team = team.opponent();
        }
    }
}

/// How much of a full fix a frame gives.
fn share_of(localisation: &Localisation, pitch: &Pitch, view: &View) -> f32 {
    localisation.landmarks.as_ref().map_or(1.0, |landmarks| fix_share(landmarks, pitch, view))
}

impl Surroundings {
    fn of(
        (ball, pose): (&BallKind, &Pose),
        bodies: &SeenBodies,
        trailers: &Query<(&Trailer, &Pose)>,
    ) -> Surroundings {
        let mut robots: Vec<_> =
            bodies.iter().map(|(id, robot, pose)| (*id, pose.position, robot.kind.reach())).collect();
        let mut trailers: Vec<_> = (trailers.iter())
            .map(|(trailer, pose)| (trailer.of, pose.to_field(trailer.middle), trailer.radius))
            .collect();
        // A query's order depends on which other components robots have; dice must not.
        robots.sort_unstable_by_key(|(id, ..)| *id);
        trailers.sort_unstable_by_key(|(id, ..)| *id);
        Surroundings { ball: pose.position, ball_radius: ball.radius, robots, trailers }
    }

    fn seen_perfectly(&self, own: RobotId, pose: Pose, team_pose: Pose, tick: u64) -> Frame {
        Frame {
            taken: tick,
            ball: Some(Sighting::of(self.ball, pose)),
            robots: (self.robots.iter().filter(|(id, ..)| *id != own))
                .map(|(id, at, _)| (id.team, Sighting::of(*at, pose)))
                .collect(),
            fix: Some(Fix { pose: team_pose, share: 1.0 }),
            pan: 0.0,
            chin_down: false,
        }
    }

    /// The frame, without a fix, and the robots before the camera.
    fn seen_through(
        &self,
        camera: &Camera,
        own: RobotId,
        gaze: CameraPose,
        dice: &mut Dice,
    ) -> (Frame, SmallVec<[Blob; 8]>) {
        let pose = Pose { heading: gaze.from.heading + gaze.pan, ..gaze.from };
        let from_body =
            |sighting: Sighting| Sighting { bearing: wrap_angle(sighting.bearing + gaze.pan), ..sighting };
        let others = |bodies: &[(RobotId, Vec2, f32)]| {
            let mut others = SmallVec::<[(RobotId, Blob); 8]>::new();
            for (id, at, radius) in bodies.iter().filter(|(id, ..)| *id != own) {
                others.push((*id, Blob::of(*at, *radius, pose)));
            }
            others
        };
        let (units, trailers) = (others(&self.robots), others(&self.trailers));
        let solid = || units.iter().chain(&trailers);
        let ball = Blob::of(self.ball, self.ball_radius, pose);
        let mut seen = look(camera, ball, camera.ball_range, solid().map(|(_, blob)| *blob), dice);
        if seen.is_none() && dice.chance(camera.false_positive) {
            let bearing = (dice.uniform() - 0.5) * camera.field_of_view.to_radians();
            seen = Some(Sighting { range: 0.3 + dice.uniform() * (camera.ball_range - 0.3), bearing });
        }
        let ball = seen.filter(|_| !gaze.chin_down).map(from_body);
        let robots = (units.iter())
            .filter_map(|(id, blob)| {
                let between = solid().filter(|(other, _)| other != id).map(|(_, blob)| *blob);
                look(camera, *blob, camera.robot_range, between, dice)
                    .map(|sighting| (id.team, from_body(sighting)))
            })
            .collect();
        let frame = Frame { taken: 0, ball, robots, fix: None, pan: gaze.pan, chin_down: gaze.chin_down };
        (frame, units.into_iter().map(|(_, blob)| blob).collect())
    }
}

fn deliver_frames(
    clock: Res<Clock>,
    mut eyes: Query<(&Robot, &mut Eyesight, &mut Percepts), Without<OffPitch>>,
) {
    for (robot, mut eyesight, mut percepts) in &mut eyes {
        let latency =
            robot.sensing.eyes.camera().map_or(0, |camera| (camera.latency / clock.dt).round() as u64);
        while eyesight.under_way.front().is_some_and(|frame| frame.taken + latency <= clock.tick) {
            percepts.frame = eyesight.under_way.pop_front();
        }
    }
}
