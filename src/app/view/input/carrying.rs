//! A hand on the pitch: with Shift, a robot or the ball is dragged to another place, and nobody tells it.

use bevy::prelude::*;

use super::pointer::Pointer;
use crate::app::view::picture::camera::PitchCamera;
use crate::app::view::picture::robots::reach;
use crate::app::view::picture::visuals::BodyVisual;
use crate::app::view::state::{Carried, FrameSystems, InHand};
use crate::game::requests::{BodyChange, Request, Requests};
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::pitch::BallKind;
use crate::robot::Robot;
use crate::world::ball::Ball;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Update, carry.in_set(FrameSystems::Keys).after(super::pointer::follow_pointer));
}

/// A press this near to the ball means it, in points.
const NEAR: f32 = 16.0;

fn carry(
    (keys, buttons): (Res<ButtonInput<KeyCode>>, Res<ButtonInput<MouseButton>>),
    (camera, kind): (Res<PitchCamera>, Res<BallKind>),
    (robots, balls): (Query<&Robot>, Query<(), With<Ball>>),
    shown: Query<&BodyVisual>,
    (mut pointer, mut carried): (ResMut<Pointer>, ResMut<Carried>),
    mut requests: ResMut<Requests>,
) {
    let shift = keys.any_pressed([KeyCode::ShiftLeft, KeyCode::ShiftRight]);
    if buttons.just_pressed(MouseButton::Left)
        && shift
        && let Some(at) = pointer.over_pitch
    {
        let point = camera.to_pitch(at);
        let reach_of = |shown: &BodyVisual| {
            if balls.contains(shown.body) {
                return Some((InHand::Ball, kind.radius.max(NEAR / camera.scale)));
            }
            Some((InHand::Robot(shown.robot?), reach(&robots.get(shown.body).ok()?.kind)))
        };
        let nearest = shown.iter().filter_map(|shown| {
            let ((what, reach), distance) = (reach_of(shown)?, shown.pose.position.distance(point));
            (distance < reach).then_some((distance, what))
        });
        carried.0 = nearest.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, what)| (what, point));
    }
    let Some((what, place)) = carried.0 else { return };
    // It is neither a click nor a drag of the pitch.
    (pointer.clicked, pointer.dragged) = (None, None);
    let at = pointer.over_pitch.map_or(place, |at| camera.to_pitch(at));
    if buttons.pressed(MouseButton::Left) {
        carried.0 = Some((what, at));
        return;
    }
    carried.0 = None;
    let heading_of = |robot: RobotId| {
        shown.iter().find(|shown| shown.robot == Some(robot)).map_or(0.0, |shown| shown.pose.heading)
    };
    requests.ask(Request::Body(match what {
        InHand::Ball => BodyChange::Ball { at, velocity: Vec2::ZERO },
        InHand::Robot(robot) => {
            BodyChange::Kidnap { robot, to: Pose { position: at, heading: heading_of(robot) } }
        }
    }));
}
