//! Which robot is selected: by a click, or by going round with Tab.

use bevy::prelude::*;

use super::pointer::Pointer;
use crate::app::view::picture::camera::PitchCamera;
use crate::app::view::picture::robots::reach;
use crate::app::view::picture::visuals::BodyVisual;
use crate::app::view::state::{Action, FrameSystems, Piloted, Selected};
use crate::game::requests::Requests;
use crate::ids::RobotId;
use crate::robot::Robot;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Update, (select_by_click, select_next).chain().in_set(FrameSystems::Input));
}

/// A click this near to a robot means it, in points; robots that are larger are hit where they are.
const NEAR: f32 = 24.0;

fn select_by_click(
    pointer: Res<Pointer>,
    camera: Res<PitchCamera>,
    shown: Query<&BodyVisual>,
    robots: Query<&Robot>,
    mut selected: ResMut<Selected>,
) {
    let Some(at) = pointer.clicked else { return };
    let point = camera.to_pitch(at);
    let nearest = (shown.iter())
        .filter_map(|shown| {
            let reach = reach(&robots.get(shown.body).ok()?.kind).max(NEAR / camera.scale);
            Some((shown.pose.position.distance(point), reach, shown.robot?))
        })
        .filter(|(distance, reach, _)| distance < reach)
        .map(|(distance, _, id)| (distance, id))
        .min_by(|(a, _), (b, _)| a.total_cmp(b));
    selected.0 = nearest.map(|(_, id)| id);
}

/// The robot after one, or before it, going round; the first or last one if there was none.
pub fn next(of: &[RobotId], present: Option<RobotId>, forward: bool) -> Option<RobotId> {
    let place = present.and_then(|present| of.iter().position(|robot| *robot == present));
    let index = match (place, forward) {
        (Some(place), true) => (place + 1) % of.len(),
        (Some(place), false) => (place + of.len() - 1) % of.len(),
        (None, true) => 0,
        (None, false) => of.len().checked_sub(1)?,
    };
    of.get(index).copied()
}

fn select_next(
    mut actions: MessageReader<Action>,
    (mut selected, mut piloted): (ResMut<Selected>, ResMut<Piloted>),
    mut requests: ResMut<Requests>,
    robots: Query<&RobotId>,
) {
    for action in actions.read() {
        let forward = match action {
            Action::NextRobot => true,
            Action::PreviousRobot => false,
            _ => continue,
        };
        let mut all: Vec<RobotId> = robots.iter().copied().collect();
        all.sort_unstable();
        match piloted.0 {
            None => selected.0 = next(&all, selected.0, forward),
            Some(seat) => {
                all.retain(|robot| robot.team == seat.team);
                let Some(new) = next(&all, Some(seat), forward) else { continue };
                piloted.change(Some(new), &mut requests);
                selected.0 = Some(new);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn going_round_comes_back_to_the_first_robot() {
        let all = [0, 1, 2].map(|number| RobotId::new(Team::Home, number));
        assert_eq!(next(&all, None, true), Some(all[0]));
        assert_eq!(next(&all, Some(all[2]), true), Some(all[0]));
        assert_eq!(next(&all, Some(all[0]), false), Some(all[2]));
        assert_eq!(next(&all, None, false), Some(all[2]));
        assert_eq!(next(&[], None, false), None);
    }
}
