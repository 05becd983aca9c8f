//! Robots on four legs as they are drawn: trunk, paws, and a pale head that turns as the true one does. The chin goes down on a
//! ball that it holds; a kick stretches the front paws, and there is a short flash where it strikes.

use bevy::prelude::*;

use super::shapes::{Paint, Parent, fill, paint, part, polygon, soft_disc};
use super::visuals::{BodyVisual, Drawn, height};
use crate::app::view::colours;
use crate::app::view::state::{AfterTick, FrameSystems, Playback, Rewound};
use crate::clock::Clock;
use crate::geometry::{unit, wrap_angle};
use crate::lab::export::outlines::WalkerOutline;
use crate::robot::handling::{Handling, Kicking};
use crate::robot::{Head, RobotKind};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(jump)
        .add_systems(AfterTick, remember_heads)
        .add_systems(Update, (turn_gaze, move_limbs).chain().in_set(FrameSystems::Picture));
}

/// Where a robot looks, smoothly between two ticks; on its drawn body.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct HeadVisual {
    before: f32,
    after: f32,
    /// As it is drawn in this frame, rad to the left of the body's heading.
    pub pan: f32,
    /// How far the chin is down, 0 to 1.
    chin: f32,
}

impl HeadVisual {
    fn follow(&mut self, pan: f32) {
        (self.before, self.after) = (self.after, pan);
    }

    fn turn(&mut self, between: f32) {
        self.pan = wrap_angle(self.before + between * wrap_angle(self.after - self.before));
    }
}

/// A part of a drawn robot that moves, in the body's frame.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
enum Limb {
    /// With its joint, and what lifts it over the ball.
    Head { joint: Vec2, lift: f32 },
    /// A front paw, where it stands.
    Paw(Vec2),
    /// Where a kick strikes, that far from the body's centre.
    Flash(f32),
}

/// How far the head comes forward with the chin down, as a share of the body's length.
const CHIN: f32 = 0.1;
/// How far a kick stretches the paws, as a share of the body's length.
const STRETCH: f32 = 0.25;
/// How far a kick to the side throws the head, as a share of the kick's direction.
const THROW: f32 = 0.5;
/// How long the flash of a kick is seen, s.
const FLASH: f32 = 0.12;
/// How fast the chin goes down and up in the picture, 1/s.
const NOD: f32 = 9.0;

/// Draws a robot that walks; `level` is the height of its picture.
pub(super) fn draw_walker(
    parent: &mut Parent,
    meshes: &mut Assets<Mesh>,
    paint: &Paint,
    kind: &RobotKind,
    level: f32,
) {
    let outline = WalkerOutline { half: Vec2::new(kind.body.length, kind.body.width) / 2.0 };
    let paw = polygon(&outline.paw(Vec2::ZERO));
    for (hind, front) in outline.hind_paws().into_iter().zip(outline.front_paws()) {
        let level = Transform::from_translation(hind.extend(-0.02));
        parent.spawn((Drawn, Mesh2d(meshes.add(paw.clone())), MeshMaterial2d(paint.edge.clone()), level));
        parent.spawn((
            (Drawn, Limb::Paw(front)),
            Mesh2d(meshes.add(paw.clone())),
            MeshMaterial2d(paint.edge.clone()),
            Transform::from_translation(front.extend(-0.02)),
        ));
    }
    part(parent, meshes, paint, &outline.trunk());
    let (joint, lift) = (outline.neck(), height::BALL + 0.4 - level);
    let mut head = parent.spawn((
        (Drawn, Limb::Head { joint, lift }),
        Transform::from_translation(joint.extend(HEAD_LEVEL)),
        Visibility::Inherited,
    ));
    head.with_children(|head| draw_head(head, meshes, paint, outline));
}

/// Height of a head over its body.
const HEAD_LEVEL: f32 = 0.05;

/// A skull with ears and a dark nose, around the joint.
fn draw_head(parent: &mut Parent, meshes: &mut Assets<Mesh>, paint: &Paint, outline: WalkerOutline) {
    for ear in outline.ears() {
        fill(parent, meshes, &paint.body, polygon(&ear), -0.005);
    }
    fill(parent, meshes, &paint.head, polygon(&outline.skull()), 0.0);
    fill(parent, meshes, &paint.body, polygon(&outline.nose()), 0.005);
}

fn remember_heads(heads: Query<&Head>, mut drawn: Query<(&BodyVisual, &mut HeadVisual)>) {
    for (shown, mut gaze) in &mut drawn {
        if let Ok(head) = heads.get(shown.body) {
            gaze.follow(head.pan);
        }
    }
}

/// A match that goes back turns no heads on its way.
fn jump(_: On<Rewound>, heads: Query<&Head>, mut drawn: Query<(&BodyVisual, &mut HeadVisual)>) {
    for (shown, mut gaze) in &mut drawn {
        if let Ok(head) = heads.get(shown.body) {
            (gaze.before, gaze.after) = (head.pan, head.pan);
        }
    }
}

fn turn_gaze(
    time: Res<Time>,
    playback: Res<Playback>,
    robots: Query<&Handling>,
    mut drawn: Query<(&BodyVisual, &mut HeadVisual)>,
) {
    let step = NOD * time.delta_secs();
    for (shown, mut gaze) in &mut drawn {
        gaze.turn(playback.between);
        let down = robots.get(shown.body).is_ok_and(Handling::hides_ball);
        let goal = if down { 1.0 } else { 0.0 };
        gaze.chin += (goal - gaze.chin).clamp(-step, step);
    }
}

/// How far a kick is carried out at a time in ticks: from 0 to 1, where it strikes, and back.
fn carried_out(kicking: &Kicking, now: f64) -> f32 {
    let half = kicking.until.saturating_sub(kicking.strikes).max(1) as f64;
    let from_strike = (now - kicking.strikes as f64).abs() / half;
    (1.0 - from_strike).clamp(0.0, 1.0) as f32
}

fn move_limbs(
    (clock, playback): (Res<Clock>, Res<Playback>),
    robots: Query<&Handling>,
    kinds: Query<&crate::robot::Robot>,
    drawn: Query<(&BodyVisual, &HeadVisual)>,
    mut limbs: Query<(&ChildOf, &Limb, &mut Transform, &mut Visibility)>,
) {
    // Bodies are shown on their way from the tick before the last to the last.
    let now = clock.tick as f64 - 2.0 + f64::from(playback.between);
    for (of, limb, mut transform, mut visibility) in &mut limbs {
        let Ok((shown, gaze)) = drawn.get(of.parent()) else { continue };
        let kicking = robots.get(shown.body).ok().and_then(|handling| handling.kicking);
        let length = kinds.get(shown.body).map_or(0.0, |robot| robot.kind.body.length);
        let share = kicking.map_or(0.0, |kicking| carried_out(&kicking, now));
        let direction = kicking.map_or(0.0, |kicking| kicking.kick.direction.to_radians());
        match *limb {
            Limb::Head { joint, lift } => {
                let ahead = joint + Vec2::X * (CHIN * length * gaze.chin);
                let over = if gaze.chin > 0.5 { lift } else { HEAD_LEVEL };
                transform.translation = ahead.extend(over);
                transform.rotation = Quat::from_rotation_z(gaze.pan + THROW * direction * share);
            }
            Limb::Paw(home) => {
                let ahead = home + Vec2::X * (STRETCH * length * share * share);
                transform.translation = ahead.extend(transform.translation.z);
            }
            Limb::Flash(distance) => {
                let since = kicking.map(|kicking| (now - kicking.strikes as f64) as f32 * clock.dt);
                let seen = since.is_some_and(|since| (0.0..FLASH).contains(&since));
                let at = unit(direction) * distance;
                transform.translation = at.extend(transform.translation.z);
                visibility.set_if_neq(if seen { Visibility::Inherited } else { Visibility::Hidden });
            }
        }
    }
}

/// Draws the flash of a kick, which is not to be seen until then.
pub(super) fn draw_flash(
    parent: &mut Parent,
    meshes: &mut Assets<Mesh>,
    materials: &mut Assets<ColorMaterial>,
    kind: &RobotKind,
) {
    let length = kind.body.length;
    parent.spawn((
        (Drawn, Limb::Flash(0.62 * length)),
        Mesh2d(meshes.add(soft_disc(0.3 * length, 0.3))),
        MeshMaterial2d(materials.add(paint(colours::PILOT.with_alpha(0.8)))),
        Transform::from_xyz(0.0, 0.0, -0.03),
        Visibility::Hidden,
    ));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Kick;

    #[test]
    fn a_head_glides_between_two_ticks() {
        let mut gaze = HeadVisual::default();
        gaze.follow(0.2);
        gaze.turn(0.5);
        assert!((gaze.pan - 0.1).abs() < 1e-6);
        gaze.follow(0.2);
        gaze.turn(0.0);
        assert!((gaze.pan - 0.2).abs() < 1e-6);
    }

    #[test]
    fn a_kick_is_at_its_longest_where_it_strikes() {
        let kick = Kick {
            direction: 0.0,
            run_out: 1.0,
            run_out_spread: 0.0,
            spread: 0.0,
            time: 0.5,
            from_hold: false,
        };
        let kicking = Kicking::begun(kick, 100, 30);
        let shares = [100.0, 107.5, 115.0, 130.0, 200.0].map(|now| carried_out(&kicking, now));
        assert_eq!(shares, [0.0, 0.5, 1.0, 0.0, 0.0]);
    }
}
