//! What the inspector draws on the pitch, around the selected robot and between team mates, in metres of the pitch frame.
//!
//! One meaning a colour: sensed is white dots, believed is dashed, true is solid; see [`super::colours`].

mod beliefs;
mod bookings;
mod messages;
mod sight;
mod teamwork;
mod vectors;
mod zones;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::EguiPrimaryContextPass;

use super::subject::InspectedMatch;
use crate::app::view::picture::visuals::BodyVisual;
use crate::app::view::picture::walkers::HeadVisual;
use crate::app::view::state::{Overlay, Overlays, PanelSystems, Screen};
use crate::geometry::Pose;

pub(super) fn plugin(app: &mut App) {
    app.init_gizmo_group::<Broad>()
        .init_gizmo_group::<Strong>()
        .init_gizmo_group::<Fine>()
        .add_systems(Startup, set_widths)
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

/// Lines that lie under others.
#[derive(Default, Reflect, GizmoConfigGroup)]
struct Broad;

/// Lines that are looked at.
#[derive(Default, Reflect, GizmoConfigGroup)]
struct Strong;

/// Lines that only connect or bound.
#[derive(Default, Reflect, GizmoConfigGroup)]
struct Fine;

fn set_widths(mut store: ResMut<GizmoConfigStore>) {
    store.config_mut::<Broad>().0.line.width = 5.0;
    store.config_mut::<Strong>().0.line.width = 2.5;
    store.config_mut::<Fine>().0.line.width = 1.2;
}

/// What overlays are drawn with.
#[derive(SystemParam)]
pub(super) struct Pens<'w, 's> {
    broad: Gizmos<'w, 's, Broad>,
    strong: Gizmos<'w, 's, Strong>,
    fine: Gizmos<'w, 's, Fine>,
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

/// Metres that a pixel of the screen covers, and about a centimetre while there is no camera.
fn pixel(camera: &Query<(&Camera, &GlobalTransform), With<Camera2d>>) -> f32 {
    camera.iter().next().and_then(|(camera, at)| metres_a_pixel(camera, at)).unwrap_or(0.01)
}

fn metres_a_pixel(camera: &Camera, at: &GlobalTransform) -> Option<f32> {
    let there = |x: f32| camera.viewport_to_world_2d(at, Vec2::new(x, 0.0)).ok();
    Some(there(100.0)?.distance(there(0.0)?) / 100.0)
}
