//! Which robots touched each other and the ball in the last step, and how hard.

use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use bevy_rapier2d::rapier::dynamics::RigidBodyHandle;
use bevy_rapier2d::rapier::geometry::ColliderHandle;
use smallvec::SmallVec;

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

/// The contacts of the last step, in order. Robots that are near without a force between them do not touch.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct ContactImpulses {
    /// Two robots, the lesser first, and the impulse between them, N·s. Each pair once, whatever parts of them touch.
    pub robots: SmallVec<[(RobotId, RobotId, f32); 4]>,
    /// Robots that touch the ball, and the impulse, N·s.
    pub ball: SmallVec<[(RobotId, f32); 4]>,
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

    fn add(&mut self, one: Option<RobotId>, other: Option<RobotId>, impulse: f32) {
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
}

/// Bodies that rest beside each other exchange less than this, N·s.
const TOUCH: f32 = 1e-3;

/// Whose a body is; nobody's is the ball.
type Owned = (RigidBodyHandle, Option<RobotId>);

fn note_contacts(
    world: Single<(&RapierContextSimulation, &RapierContextColliders)>,
    robots: Query<(&RobotId, &RobotBodies)>,
    ball: Single<&RapierRigidBodyHandle, With<Ball>>,
    mut contacts: ResMut<ContactImpulses>,
) {
    let (simulation, colliders) = *world;
    contacts.robots.clear();
    contacts.ball.clear();
    let mut owners: SmallVec<[Owned; 24]> = SmallVec::from_iter([(ball.0, None)]);
    for (id, bodies) in &robots {
        owners.extend(bodies.all().into_iter().map(|body| (body.0, Some(*id))));
    }
    let owner = |collider: ColliderHandle| {
        let body = colliders.colliders.get(collider)?.parent()?;
        owners.iter().find(|(known, _)| *known == body).map(|(_, owner)| *owner)
    };
    for pair in simulation.narrow_phase.contact_pairs() {
        let impulse = pair.total_impulse_magnitude();
        if impulse > TOUCH
            && let (Some(one), Some(other)) = (owner(pair.collider1), owner(pair.collider2))
        {
            contacts.add(one, other, impulse);
        }
    }
    contacts.robots.sort_unstable_by_key(|(one, other, _)| (*one, *other));
    contacts.ball.sort_unstable_by_key(|(robot, _)| *robot);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn contacts_of_several_parts_are_one_and_nobody_touches_itself() {
        let (one, other) = (RobotId::new(Team::Home, 1), RobotId::new(Team::Away, 0));
        let mut contacts = ContactImpulses::default();
        contacts.add(Some(other), Some(one), 1.0);
        contacts.add(Some(one), Some(other), 0.5);
        contacts.add(Some(one), Some(one), 9.0);
        contacts.add(None, Some(one), 0.25);
        contacts.add(Some(one), None, 0.25);
        contacts.add(Some(other), None, 2.0);
        assert_eq!(contacts.robots.as_slice(), [(one, other, 1.5)]);
        assert_eq!(contacts.of(other).collect::<Vec<_>>(), [(one, 1.5)]);
        assert_eq!(contacts.of(one).collect::<Vec<_>>(), [(other, 1.5)]);
        assert_eq!((contacts.on_ball_without(one), contacts.on_ball_without(other)), (2.0, 0.5));
    }
}
