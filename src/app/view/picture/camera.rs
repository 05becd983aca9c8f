//! The camera: fits the pitch into what the panels leave free.
//!
//! [`PitchCamera`] is where it looks, in one small value; text on the pitch is placed by the same value, so that it cannot drift.

use bevy::prelude::*;
use bevy::render::renderer::RenderAdapterInfo;
use bevy::window::PrimaryWindow;
use bevy_egui::egui;

use super::pitch::{WALL, is_open};
use super::robots::extent;
use crate::app::view::state::{FrameSystems, FreeArea, MatchBegun};
use crate::geometry::{Pose, Zone};
use crate::pitch::Pitch;
use crate::robot::{OffPitch, Robot};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<PitchCamera>()
        .add_observer(look_at_new_match)
        .add_systems(Startup, set_up_camera)
        .add_systems(Update, (approach_fit, aim_camera).chain().in_set(FrameSystems::Picture));
}

/// Where the camera looks.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct PitchCamera {
    /// The point of the pitch in the middle of the free area, m.
    pub centre: Vec2,
    /// Points of the interface to a metre.
    pub scale: f32,
    /// The part of the window that shows the pitch, in points.
    pub area: egui::Rect,
    /// It keeps to the pitch as a whole, since nobody has zoomed or panned.
    pub fitted: bool,
    /// It has been aimed before, so a new fit is approached smoothly.
    settled: bool,
}

impl Default for PitchCamera {
    fn default() -> PitchCamera {
        PitchCamera {
            centre: Vec2::ZERO,
            scale: 80.0,
            area: egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 720.0)),
            fitted: true,
            settled: false,
        }
    }
}

/// Floor that is shown around the walls, m.
const MARGIN: f32 = 0.15;
/// Carpet that is shown beyond the lines and the goals of an open pitch, m.
const CARPET: Vec2 = Vec2::new(0.1, 0.35);
/// Room around robots that wait beside the pitch, m.
const BENCH: f32 = 0.05;
/// The largest scale, points to a metre.
const NEAREST: f32 = 900.0;

/// How fast a new fit is approached, 1/s.
const APPROACH: f32 = 10.0;

impl PitchCamera {
    /// Where a point of the pitch is in the window.
    pub fn to_screen(self, point: Vec2) -> egui::Pos2 {
        let offset = (point - self.centre) * self.scale;
        self.area.center() + egui::vec2(offset.x, -offset.y)
    }

    /// Which point of the pitch is at a place in the window.
    pub fn to_pitch(self, at: egui::Pos2) -> Vec2 {
        let offset = at - self.area.center();
        self.centre + Vec2::new(offset.x, -offset.y) / self.scale
    }

    /// Shows the whole of a zone, as large as it goes, in the middle.
    pub fn fit(&self, zone: Zone) -> PitchCamera {
        let size = (zone.max - zone.min).max(Vec2::splat(0.1));
        let scale = (self.area.width() / size.x).min(self.area.height() / size.y);
        PitchCamera { centre: (zone.min + zone.max) / 2.0, scale: scale.clamp(10.0, NEAREST), ..*self }
    }

    /// Larger or smaller by a factor, with the point under the pointer where it is.
    pub fn zoomed(&self, factor: f32, pointer: egui::Pos2, smallest: f32) -> PitchCamera {
        let held = self.to_pitch(pointer);
        let scale = (self.scale * factor).clamp(smallest, NEAREST);
        let centre = held + (self.centre - held) * (self.scale / scale);
        PitchCamera { centre, scale, fitted: false, ..*self }
    }
}

/// What a fit shows: pitch, goals and walls, and the robots that wait beside them.
///
/// Those who wait come with the room that each needs around it, m.
pub fn zone_to_show(pitch: &Pitch, waiting: impl Iterator<Item = (Vec2, f32)>) -> Zone {
    let goals = Vec2::new(pitch.goal.depth, 0.0);
    let beyond = if is_open(pitch) {
        (goals + Vec2::new(pitch.walls.thickness, 0.0) + CARPET).min(Vec2::splat(pitch.margin()))
    } else {
        goals + WALL + MARGIN
    };
    let edge = pitch.half_size() + beyond;
    let zone = Zone { min: -edge, max: edge };
    waiting.fold(zone, |zone, (at, room)| Zone { min: zone.min.min(at - room), max: zone.max.max(at + room) })
}

fn set_up_camera(mut commands: Commands, adapter: Option<Res<RenderAdapterInfo>>) {
    let in_software = adapter.is_some_and(|adapter| adapter.device_type == wgpu::DeviceType::Cpu);
    commands.spawn((Camera2d, if in_software { Msaa::Off } else { Msaa::Sample4 }));
}

fn look_at_new_match(_: On<MatchBegun>, mut camera: ResMut<PitchCamera>) {
    (camera.fitted, camera.settled) = (true, false);
}

fn approach_fit(
    time: Res<Time>,
    (area, pitch): (Res<FreeArea>, Res<Pitch>),
    mut camera: ResMut<PitchCamera>,
    waiting: Query<(&Pose, &Robot), With<OffPitch>>,
) {
    if !area.0.is_positive() {
        return;
    }
    camera.area = area.0;
    if !camera.fitted {
        return;
    }
    // Those beside an open pitch wait far out; their labels come to the edge instead.
    let waiting = (waiting.iter().filter(|_| !is_open(&pitch)))
        .map(|(pose, robot)| (pose.position, extent(&robot.kind) + BENCH));
    let goal = camera.fit(zone_to_show(&pitch, waiting));
    let share = if camera.settled { 1.0 - crate::ops::exp(-APPROACH * time.delta_secs()) } else { 1.0 };
    let settled = true;
    *camera = PitchCamera {
        centre: camera.centre.lerp(goal.centre, share),
        scale: camera.scale + (goal.scale - camera.scale) * share,
        settled,
        ..goal
    };
}

fn aim_camera(
    pitch_camera: Res<PitchCamera>,
    window: Single<&Window, With<PrimaryWindow>>,
    camera: Single<(&mut Transform, &mut Projection), With<Camera2d>>,
) {
    let (mut transform, mut projection) = camera.into_inner();
    let middle = pitch_camera.to_pitch(egui::pos2(window.width() / 2.0, window.height() / 2.0));
    transform.translation = middle.extend(0.0);
    if let Projection::Orthographic(projection) = &mut *projection {
        projection.scale = 1.0 / pitch_camera.scale;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> PitchCamera {
        let area = egui::Rect::from_min_max(egui::pos2(0.0, 60.0), egui::pos2(1000.0, 660.0));
        PitchCamera { area, ..PitchCamera::default() }
    }

    fn zone() -> Zone {
        Zone { min: Vec2::new(-5.0, -3.0), max: Vec2::new(5.0, 4.0) }
    }

    #[test]
    fn a_fit_shows_the_whole_zone_and_wastes_nothing() {
        let camera = camera().fit(zone());
        let (top, bottom) = (camera.to_screen(Vec2::new(-5.0, 4.0)), camera.to_screen(Vec2::new(5.0, -3.0)));
        assert!(camera.area.contains(top) && camera.area.expand(0.01).contains(bottom), "{top} {bottom}");
        assert!((bottom.y - top.y - camera.area.height()).abs() < 0.01, "{top} {bottom}");
    }

    #[test]
    fn an_open_pitch_shows_some_of_its_carpet_and_the_robots_that_wait_beyond() {
        let goal = crate::pitch::Goal { width: 0.8, depth: 0.3 };
        let walls = crate::pitch::Walls { thickness: 0.05, friction: 0.2, restitution: 0.6, margin: 1.0 };
        let mut pitch = Pitch {
            name: "Test".into(),
            length: 5.4,
            width: 4.0,
            goal,
            penalty_area: crate::pitch::PenaltyArea { depth: 0.65, width: 1.3 },
            centre_circle_radius: 0.18,
            penalty_spots: vec![Vec2::ZERO],
            beacons: Vec::new(),
            walls,
        };
        let open = zone_to_show(&pitch, std::iter::empty());
        assert!(open.max.x > 2.7 + 0.3 + 0.05 && open.max.y > 2.0 + 0.2 && open.max.y < 3.0);
        let waiting = Vec2::new(1.0, 3.6);
        assert!(zone_to_show(&pitch, std::iter::once((waiting, 0.3))).max.y > 3.8);
        pitch.walls.margin = 0.0;
        let closed = zone_to_show(&pitch, std::iter::empty());
        assert!((closed.max.y - (2.0 + WALL + MARGIN)).abs() < 1e-6);
    }

    #[test]
    fn the_window_and_the_pitch_agree_both_ways() {
        let camera = camera().fit(zone());
        let point = Vec2::new(1.5, -2.25);
        assert!((camera.to_pitch(camera.to_screen(point)) - point).length() < 1e-4);
        assert!(camera.to_screen(Vec2::Y).y < camera.to_screen(Vec2::ZERO).y, "north is up");
    }

    #[test]
    fn a_zoom_holds_the_point_under_the_pointer() {
        let pointer = egui::pos2(200.0, 500.0);
        let before = camera().fit(zone());
        let after = before.zoomed(1.7, pointer, 10.0);
        assert!((after.to_pitch(pointer) - before.to_pitch(pointer)).length() < 1e-4);
        assert!((after.scale / before.scale - 1.7).abs() < 1e-4);
        assert_eq!(before.zoomed(1e9, pointer, 10.0).scale, NEAREST);
        assert_eq!(before.zoomed(1e-9, pointer, 10.0).scale, 10.0);
    }
}
