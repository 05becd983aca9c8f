//! Rings around robots: in its team's colour around the one that is selected, white around the one that a person drives.

use bevy::prelude::*;

use super::FrameSystems;
use super::colours;
use super::robots::Plate;
use super::session::MatchBegun;
use super::shapes::ring;
use super::shown::{Drawn, Shown, height};
use super::state::{Piloted, Selected};
use crate::ids::{RobotId, Team};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(draw_rings).add_systems(Update, place_rings.in_set(FrameSystems::Picture));
}

/// What a ring tells of the robot in it.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
enum Ring {
    Selected(Team),
    Piloted,
}

fn draw_rings(
    _: On<MatchBegun>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<ColorMaterial>>,
) {
    let selected = Team::BOTH.map(|team| (Ring::Selected(team), colours::team(team), 0.5, 0.035));
    for (tells, colour, radius, width) in
        selected.into_iter().chain([(Ring::Piloted, colours::PILOT, 0.45, 0.05)])
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

impl Ring {
    fn robot(self, selected: &Selected, piloted: &Piloted) -> Option<RobotId> {
        match self {
            Ring::Selected(team) => selected.0.filter(|robot| robot.team == team),
            Ring::Piloted => piloted.0,
        }
    }
}

fn place_rings(
    (selected, piloted): (Res<Selected>, Res<Piloted>),
    shown: Query<&Shown>,
    plates: Query<(&Plate, &Shown)>,
    mut rings: Query<(&Ring, &mut Transform, &mut Visibility)>,
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
