//! Rings around robots: in its team's colour around the one that is selected, white around the one that a person drives.

use bevy::prelude::*;

use super::robots::{Plate, reach};
use super::shapes::ring;
use super::visuals::{BodyVisual, Drawn, height};
use crate::app::view::colours;
use crate::app::view::state::{FrameSystems, MatchBegun, Piloted, Selected};
use crate::ids::{RobotId, Team};
use crate::robot::Robot;

pub(super) fn plugin(app: &mut App) {
    app.add_observer(draw_rings).add_systems(Update, place_rings.in_set(FrameSystems::Picture));
}

/// What a ring tells of the robot in it. Each team has its own, since its robots may have their own size.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
enum RobotRing {
    Selected(Team),
    Piloted(Team),
}

/// Radii of the rings around a robot that is selected and one that a person drives, in reaches of the robot, and their
/// widths, m.
pub const SELECTED: f32 = 1.36;
const PILOTED: f32 = 1.22;
const WIDTHS: [f32; 2] = [0.035, 0.05];

/// The reach of a robot whose rings are as wide as they may be, m.
const LARGE: f32 = 0.36;

fn draw_rings(
    _: On<MatchBegun>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<ColorMaterial>>,
    robots: Query<(&RobotId, &Robot)>,
) {
    let reach_of = |team: Team| {
        let mates = robots.iter().filter(|(id, _)| id.team == team);
        mates.map(|(_, robot)| reach(&robot.kind)).fold(0.0, f32::max)
    };
    let rings = Team::BOTH.map(|team| {
        let reach = reach_of(team);
        let thin = (reach / LARGE).min(1.0);
        [
            (RobotRing::Selected(team), colours::team(team), SELECTED * reach, WIDTHS[0] * thin),
            (RobotRing::Piloted(team), colours::PILOT, PILOTED * reach, WIDTHS[1] * thin),
        ]
    });
    for (tells, colour, radius, width) in
        rings.into_iter().flatten().filter(|(_, _, radius, _)| *radius > 0.0)
    {
        commands.spawn((
            Drawn,
            tells,
            Mesh2d(meshes.add(ring(radius, width))),
            MeshMaterial2d(materials.add(ColorMaterial::from_color(colour))),
            Transform::from_xyz(0.0, 0.0, height::RINGS),
            Visibility::Hidden,
        ));
    }
}

impl RobotRing {
    fn robot(self, selected: &Selected, piloted: &Piloted) -> Option<RobotId> {
        match self {
            RobotRing::Selected(team) => selected.0.filter(|robot| robot.team == team),
            RobotRing::Piloted(team) => piloted.0.filter(|robot| robot.team == team),
        }
    }
}

fn place_rings(
    (selected, piloted): (Res<Selected>, Res<Piloted>),
    shown: Query<&BodyVisual>,
    plates: Query<(&Plate, &BodyVisual)>,
    mut rings: Query<(&RobotRing, &mut Transform, &mut Visibility)>,
) {
    for (ring, mut transform, mut visibility) in &mut rings {
        let around = ring.robot(&selected, &piloted).and_then(|robot| {
            let unit = shown.iter().find(|shown| shown.robot == Some(robot))?.pose.position;
            let plate = plates.iter().find(|(plate, _)| plate.of == robot);
            Some(plate.map_or(unit, |(plate, shown)| unit.midpoint(shown.pose.to_field(plate.middle))))
        });
        if let Some(at) = around {
            transform.translation = at.extend(height::RINGS);
        }
        visibility.set_if_neq(if around.is_some() { Visibility::Inherited } else { Visibility::Hidden });
    }
}
