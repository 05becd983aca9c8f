//! What the inspector draws on the pitch, around the selected robot and between team mates, in metres of the pitch frame.
//!
//! One meaning a colour: sensed is white dots, believed is dashed, true is solid; see [`crate::app::view::colours`].

mod beliefs;
mod bookings;
mod messages;
mod pens;
mod sight;
mod teamwork;
mod vectors;
mod zones;

use bevy::prelude::*;
use bevy_egui::EguiPrimaryContextPass;
use pens::{Pens, pixel};

use super::subject::InspectedMatch;
use crate::app::view::picture::visuals::BodyVisual;
use crate::app::view::picture::walkers::HeadVisual;
use crate::app::view::state::{Overlay, Overlays, PanelSystems, Screen};
use crate::geometry::Pose;

pub(super) fn plugin(app: &mut App) {
    app.add_plugins(pens::plugin)
        .add_systems(
            PostUpdate,
            (teamwork::draw, bookings::draw, messages::draw, draw)
                .chain()
                .after(TransformSystems::Propagate)
                .run_if(in_state(Screen::Match)),
        )
        .add_systems(
            EguiPrimaryContextPass,
            bookings::write.in_set(PanelSystems::Notes).run_if(in_state(Screen::Match)),
        );
}

fn draw(
    overlays: Res<Overlays>,
    scene: InspectedMatch,
    (shown, gazes): (Query<&BodyVisual>, Query<(&BodyVisual, &HeadVisual)>),
    camera: Query<(&Camera, &GlobalTransform), With<Camera2d>>,
    mut pens: Pens,
) {
    // Upon the bodies as they are shown, which glide between two ticks.
    let placed =
        |entity, pose| shown.iter().find(|shown| shown.body == entity).map_or(pose, |shown| shown.pose);
    let Some(robot) = scene.looked_with(placed) else { return };
    let pixel = pixel(&camera);
    let anchor = robot.ends.turn_pose(robot.pose);
    if overlays.shows(Overlay::Zones) {
        zones::draw(&mut pens, &robot, scene.pitch.half_size());
    }
    if robot.of.off_pitch {
        return;
    }
    if overlays.shows(Overlay::FieldOfView) {
        let pan =
            gazes.iter().find(|(shown, _)| shown.body == robot.of.entity).map_or(0.0, |(_, gaze)| gaze.pan);
        let from = Pose { heading: anchor.heading + pan, ..anchor };
        sight::draw_field_of_view(&mut pens, &robot.of.robot.sensing.eyes, from, pixel);
    }
    if overlays.shows(Overlay::Beliefs) {
        beliefs::draw(&mut pens, &robot, pixel);
        sight::draw_frame(&mut pens, &robot, pixel);
    }
    if overlays.shows(Overlay::Vectors) {
        vectors::draw(&mut pens, &robot, anchor.position);
    }
}
