//! What a person does to the camera: the wheel zooms at the pointer, dragging pans, and a key fits the pitch.

use bevy::input::mouse::{MouseScrollUnit, MouseWheel};
use bevy::prelude::*;

use super::pointer::Pointer;
use crate::app::view::picture::camera::{PitchCamera, zone_to_show};
use crate::app::view::state::{Action, FrameSystems};
use crate::pitch::Pitch;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Update, (fit_on_demand, zoom, pan).chain().in_set(FrameSystems::Input));
}

fn fit_on_demand(mut actions: MessageReader<Action>, mut camera: ResMut<PitchCamera>) {
    if actions.read().any(|action| *action == Action::Fit) {
        camera.fitted = true;
    }
}

fn zoom(
    mut wheel: MessageReader<MouseWheel>,
    pointer: Res<Pointer>,
    pitch: Res<Pitch>,
    mut camera: ResMut<PitchCamera>,
) {
    const LINE: f32 = 1.0 / 40.0;
    let turned: f32 =
        (wheel.read()).map(|turn| turn.y * if turn.unit == MouseScrollUnit::Line { 1.0 } else { LINE }).sum();
    let Some(at) = pointer.over_pitch.filter(|_| turned != 0.0) else { return };
    let smallest = FARTHEST * camera.fit(zone_to_show(&pitch, std::iter::empty())).scale;
    *camera = camera.zoomed(crate::ops::powf(1.15, turned), at, smallest);
}

/// The smallest scale, as a share of that which fits.
const FARTHEST: f32 = 0.6;

fn pan(pointer: Res<Pointer>, pitch: Res<Pitch>, mut camera: ResMut<PitchCamera>) {
    let Some(moved) = pointer.dragged else { return };
    let edge = pitch.half_size() + pitch.margin() + 1.0;
    let centre = camera.centre - Vec2::new(moved.x, -moved.y) / camera.scale;
    camera.centre = centre.clamp(-edge, edge);
    camera.fitted = false;
}
