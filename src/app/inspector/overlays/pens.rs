//! What overlays are drawn with: lines of three widths, in metres of the pitch frame.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;

pub(super) fn plugin(app: &mut App) {
    app.init_gizmo_group::<Broad>()
        .init_gizmo_group::<Strong>()
        .init_gizmo_group::<Fine>()
        .add_systems(Startup, set_widths);
}

/// Lines that lie under others.
#[derive(Default, Reflect, GizmoConfigGroup)]
pub struct Broad;

/// Lines that are looked at.
#[derive(Default, Reflect, GizmoConfigGroup)]
pub struct Strong;

/// Lines that only connect or bound.
#[derive(Default, Reflect, GizmoConfigGroup)]
pub struct Fine;

fn set_widths(mut store: ResMut<GizmoConfigStore>) {
    store.config_mut::<Broad>().0.line.width = 5.0;
    store.config_mut::<Strong>().0.line.width = 2.5;
    store.config_mut::<Fine>().0.line.width = 1.2;
}

/// What overlays are drawn with.
#[derive(SystemParam)]
pub struct Pens<'w, 's> {
    pub broad: Gizmos<'w, 's, Broad>,
    pub strong: Gizmos<'w, 's, Strong>,
    pub fine: Gizmos<'w, 's, Fine>,
}

/// Metres that a pixel of the screen covers, and about a centimetre while there is no camera.
pub fn pixel(camera: &Query<(&Camera, &GlobalTransform), With<Camera2d>>) -> f32 {
    camera.iter().next().and_then(|(camera, at)| metres_a_pixel(camera, at)).unwrap_or(0.01)
}

fn metres_a_pixel(camera: &Camera, at: &GlobalTransform) -> Option<f32> {
    let there = |x: f32| camera.viewport_to_world_2d(at, Vec2::new(x, 0.0)).ok();
    Some(there(100.0)?.distance(there(0.0)?) / 100.0)
}
