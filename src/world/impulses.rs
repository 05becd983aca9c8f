//! Which robots touched each other and the ball in the last step, and how hard.

use std::cell::LazyCell;

use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use bevy_rapier2d::rapier::dynamics::RigidBodyHandle;
use bevy_rapier2d::rapier::geometry::ColliderHandle;
use smallvec::{SmallVec, smallvec};

use crate::ids::RobotId;
use crate::robot::RobotBodies;
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::world::ball::Ball;
use crate::world::physics::step;

pub(super) fn plugin(app: &mut App) {
    app.match_resource::<ContactImpulses>().starts_empty();
    app.add_systems(Tick, note_contacts.after(step).in_set(TickSystems::Physics));
}

/// The contacts of the last step, in order.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct ContactImpulses {
    /// Two robots that press each other, the lesser first, and the impulse between them, N·s. Each pair once, whatever parts of
    /// them touch. Robots that are near without a force between them do not press.
    pub robots: SmallVec<[(RobotId, RobotId, f32); 4]>,
    /// Robots that press the ball, and the impulse, N·s.
    pub ball: SmallVec<[(RobotId, f32); 4]>,
    /// Two robots whose drive units touch, pressed or not, the lesser first; each pair once.
    pub units: SmallVec<[(RobotId, RobotId); 4]>,
    /// Robots whose drive units touch the ball, pressed or not; each once.
    pub units_at_ball: SmallVec<[RobotId; 4]>,
}

impl ContactImpulses {
    /// The robots that a robot touches, with the impulses, N·s.
    pub fn of(&self, robot: RobotId) -> impl Iterator<Item = (RobotId, f32)> + '_ {
        self.robots.iter().filter_map(move |(one, other, impulse)| match robot {
            _ if robot == *one => Some((*other, *impulse)),
            _ if robot == *other => Some((*one, *impulse)),
            _ => None,
        })
    }

    /// The impulse with which others than this robot press the ball, N·s.
    pub fn on_ball_without(&self, robot: RobotId) -> f32 {
        self.ball.iter().filter(|(other, _)| *other != robot).map(|(_, impulse)| impulse).sum()
    }

    fn clear(&mut self) {
        self.robots.clear();
        self.ball.clear();
        self.units.clear();
        self.units_at_ball.clear();
    }

    fn sort(&mut self) {
        self.robots.sort_unstable_by_key(|(one, other, _)| (*one, *other));
        self.ball.sort_unstable_by_key(|(robot, _)| *robot);
        self.units.sort_unstable();
        self.units_at_ball.sort_unstable();
    }

    fn press(&mut self, one: Option<RobotId>, other: Option<RobotId>, impulse: f32) {
        match (one, other) {
            (Some(one), Some(other)) if one != other => {
                let (one, other) = (one.min(other), one.max(other));
                let known = self.robots.iter_mut().find(|(a, b, _)| (*a, *b) == (one, other));
                match known {
                    Some((.., sum)) => *sum += impulse,
                    None => self.robots.push((one, other, impulse)),
                }
            }
            (Some(robot), None) | (None, Some(robot)) => {
                match self.ball.iter_mut().find(|(known, _)| *known == robot) {
                    Some((_, sum)) => *sum += impulse,
                    None => self.ball.push((robot, impulse)),
                }
            }
            _ => {}
        }
    }

    fn touch(&mut self, one: Option<RobotId>, other: Option<RobotId>) {
        match (one, other) {
            (Some(one), Some(other)) if one != other => {
                let pair = (one.min(other), one.max(other));
                if !self.units.contains(&pair) {
                    self.units.push(pair);
                }
            }
            (Some(robot), None) | (None, Some(robot)) if !self.units_at_ball.contains(&robot) => {
                self.units_at_ball.push(robot);
            }
            _ => {}
        }
    }
}

/// Bodies that rest beside each other exchange less than this, N·s.
const TOUCH: f32 = 1e-3;

/// A body, whose it is and whether it is a drive unit or the ball, and no trailer. Nobody's is the ball.
type Owned = (RigidBodyHandle, Option<RobotId>, bool);

fn note_contacts(
    world: Single<(&RapierContextSimulation, &RapierContextColliders)>,
    robots: Query<(&RobotId, &RobotBodies)>,
    ball: Single<&RapierRigidBodyHandle, With<Ball>>,
    mut contacts: ResMut<ContactImpulses>,
) {
    let (simulation, colliders) = *world;
    contacts.clear();
    let owners = LazyCell::new(|| {
        let mut owners: SmallVec<[Owned; 24]> = smallvec![(ball.0, None, true)];
        for (id, bodies) in &robots {
            owners.push((bodies.unit.0, Some(*id), true));
            owners.extend(bodies.trailer.map(|trailer| (trailer.0, Some(*id), false)));
        }
        owners
    });
    let owner = |collider: ColliderHandle| {
        let body = colliders.colliders.get(collider)?.parent()?;
        owners.iter().find(|(known, ..)| *known == body).map(|(_, owner, is_main)| (*owner, *is_main))
    };
    for pair in simulation.narrow_phase.contact_pairs() {
        let (impulse, touches) = (pair.total_impulse_magnitude(), pair.has_any_active_contact());
        if (impulse > TOUCH || touches)
            && let (Some(one), Some(other)) = (owner(pair.collider1), owner(pair.collider2))
        {
            if impulse > TOUCH {
                contacts.press(one.0, other.0, impulse);
            }
            if touches && one.1 && other.1 {
                contacts.touch(one.0, other.0);
            }
        }
    }
    contacts.sort();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn contacts_of_several_parts_are_one_and_nobody_touches_itself() {
        let (one, other) = (RobotId::new(Team::Home, 1), RobotId::new(Team::Away, 0));
        let mut contacts = ContactImpulses::default();
        contacts.press(Some(other), Some(one), 1.0);
        contacts.press(Some(one), Some(other), 0.5);
        contacts.press(Some(one), Some(one), 9.0);
        contacts.press(None, Some(one), 0.25);
        contacts.press(Some(one), None, 0.25);
        contacts.press(Some(other), None, 2.0);
        assert_eq!(contacts.robots.as_slice(), [(one, other, 1.5)]);
        assert_eq!(contacts.of(other).collect::<Vec<_>>(), [(one, 1.5)]);
        assert_eq!(contacts.of(one).collect::<Vec<_>>(), [(other, 1.5)]);
        assert_eq!((contacts.on_ball_without(one), contacts.on_ball_without(other)), (2.0, 0.5));
    }
    #[test]
    fn units_touch_once_however_many_parts_of_them_touch() {
        let (one, other) = (RobotId::new(Team::Home, 1), RobotId::new(Team::Away, 0));
        let mut contacts = ContactImpulses::default();
        for (a, b) in
            [(Some(other), Some(one)), (Some(one), Some(other)), (None, Some(one)), (Some(one), None)]
        {
            contacts.touch(a, b);
        }
        contacts.touch(Some(one), Some(one));
        assert_eq!(contacts.units.as_slice(), [(one, other)]);
        assert_eq!(contacts.units_at_ball.as_slice(), [one]);
        assert!(contacts.robots.is_empty() && contacts.ball.is_empty(), "nothing presses");
    }
}
