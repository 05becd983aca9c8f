//! Bodies as they are shown: entities of the view that follow those of the simulation, smoothly between two ticks.
//!
//! The physics entities' own transforms are never touched. A body that people have carried does not glide there: it
//! fades in at its new place.

use bevy::prelude::*;

use crate::app::view::state::{AfterTick, FrameSystems, Playback, Rewound};
use crate::geometry::{Pose, wrap_angle};
use crate::ids::RobotId;

pub(super) fn plugin(app: &mut App) {
    app.add_observer(jump)
        .add_systems(AfterTick, remember_poses)
        .add_systems(Update, (place_shown, fade_in).chain().in_set(FrameSystems::Picture));
}

/// Heights of the layers of the picture.
pub mod height {
    /// The carpet.
    pub const GROUND: f32 = 0.0;
    /// The lines.
    pub const LINES: f32 = 1.0;
    /// Rings around robots.
    pub const RINGS: f32 = 2.0;
    /// The way that the ball has come.
    pub const TRAIL: f32 = 3.0;
    /// Robots are at this height and up to 2 above it.
    pub const ROBOTS: f32 = 4.0;
    /// The ball.
    pub const BALL: f32 = 8.0;
}

/// On the entities of the view that go with a match.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct Drawn;

/// Follows a body of the simulation.
#[derive(Component, Clone, Copy, Debug)]
#[require(Drawn, Transform, Visibility)]
pub struct BodyVisual {
    /// The body's entity.
    pub body: Entity,
    /// The robot, if this is a drive unit.
    pub robot: Option<RobotId>,
    before: Pose,
    after: Pose,
    /// Where the picture has it in this frame, in the pitch frame.
    pub pose: Pose,
    /// It was carried and not pushed in the last tick.
    pub carried: bool,
    height: f32,
}

/// What fades in when its body was carried: materials and their full opacities.
#[derive(Component, Clone, Debug, Default)]
pub struct Fade {
    /// Each material with its opacity.
    pub materials: Vec<(Handle<ColorMaterial>, f32)>,
    /// 0 just carried, 1 there.
    progress: f32,
}

/// A body that moves farther than this in one tick was carried, m.
const CARRIED: f32 = 0.5;
/// How long it takes to fade in, s.
const FADE: f32 = 0.4;

impl BodyVisual {
    /// Follows a body that is here now.
    pub fn new(body: Entity, robot: Option<RobotId>, pose: Pose, height: f32) -> BodyVisual {
        BodyVisual { body, robot, before: pose, after: pose, pose, carried: false, height }
    }

    fn follow(&mut self, pose: Pose) {
        let carried = self.after.position.distance(pose.position) > CARRIED;
        self.carried |= carried;
        self.before = if carried { pose } else { self.after };
        self.after = pose;
    }

    /// It is here now, and comes from nowhere.
    fn jump(&mut self, pose: Pose) {
        (self.before, self.after, self.carried) = (pose, pose, false);
    }
}

impl Fade {
    /// Begins with nothing to be seen.
    pub fn of(materials: impl IntoIterator<Item = (Handle<ColorMaterial>, f32)>) -> Fade {
        Fade { materials: materials.into_iter().collect(), progress: 0.0 }
    }
}

/// A pose between two others, the short way round.
pub fn between(before: Pose, after: Pose, share: f32) -> Pose {
    Pose {
        position: before.position.lerp(after.position, share),
        heading: wrap_angle(before.heading + share * wrap_angle(after.heading - before.heading)),
    }
}

/// Takes away everything that was drawn of a match.
pub fn clear(world: &mut World) {
    let mut drawn = world.query_filtered::<Entity, (With<Drawn>, Without<ChildOf>)>();
    for entity in drawn.iter(world).collect::<Vec<_>>() {
        world.despawn(entity);
    }
}

fn remember_poses(bodies: Query<&Pose>, mut shown: Query<&mut BodyVisual>) {
    for mut shown in &mut shown {
        if let Ok(pose) = bodies.get(shown.body) {
            shown.follow(*pose);
        }
    }
}

/// A match that goes back does not carry its bodies there.
fn jump(_: On<Rewound>, bodies: Query<&Pose>, mut shown: Query<&mut BodyVisual>) {
    for mut shown in &mut shown {
        if let Ok(pose) = bodies.get(shown.body) {
            shown.jump(*pose);
        }
    }
}

fn place_shown(playback: Res<Playback>, mut shown: Query<(&mut BodyVisual, &mut Transform)>) {
    for (mut shown, mut transform) in &mut shown {
        shown.pose = between(shown.before, shown.after, playback.between);
        transform.translation = shown.pose.position.extend(shown.height);
        transform.rotation = Quat::from_rotation_z(shown.pose.heading);
    }
}

fn fade_in(
    time: Res<Time>,
    mut materials: ResMut<Assets<ColorMaterial>>,
    mut fading: Query<(&mut BodyVisual, &mut Fade)>,
) {
    for (mut shown, mut fade) in &mut fading {
        if std::mem::take(&mut shown.carried) {
            fade.progress = 0.0;
        }
        if fade.progress >= 1.0 {
            continue;
        }
        fade.progress = (fade.progress + time.delta_secs() / FADE).min(1.0);
        for (handle, full) in &fade.materials {
            if let Some(mut material) = materials.get_mut(handle) {
                material.color.set_alpha(full * fade.progress);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use super::*;

    #[test]
    fn a_heading_turns_the_short_way_round() {
        let halfway = between(Pose::new(0.0, 0.0, PI - 0.1), Pose::new(1.0, 0.0, -PI + 0.1), 0.5);
        assert!((halfway.heading.abs() - PI).abs() < 1e-5, "{}", halfway.heading);
        assert_eq!(halfway.position, Vec2::new(0.5, 0.0));
    }

    #[test]
    fn a_carried_body_does_not_glide() {
        let mut shown = BodyVisual::new(Entity::PLACEHOLDER, None, Pose::default(), 0.0);
        shown.follow(Pose::new(0.02, 0.0, 0.0));
        assert!(!shown.carried && shown.before.position.x == 0.0);
        shown.follow(Pose::new(2.0, 0.0, 0.0));
        assert!(shown.carried);
        assert_eq!(shown.before.position.x, 2.0);
    }
}
