//! What touching other robots does to robots that stand: they lose speed, push, traction and now and then their footing.

use bevy::prelude::*;

use crate::clock::Clock;
use crate::ids::RobotId;
use crate::robot::{Footing, OffPitch, Robot};
use crate::world::body_events::{BodyEvent, BodyEvents};
use crate::world::impulses::ContactImpulses;

/// After the contacts of the last step.
pub(super) fn keep_footing(
    clock: Res<Clock>,
    contacts: Res<ContactImpulses>,
    mut robots: Query<(&RobotId, &Robot, &mut Footing), Without<OffPitch>>,
    mut events: ResMut<BodyEvents>,
) {
    events.0.clear();
    for (&id, robot, mut footing) in &mut robots {
        let Some(cost) = &robot.kind.contact else { continue };
        let impulse = contacts.of(id).map(|(_, impulse)| impulse).reduce(|one, other| one + other);
        if (impulse.is_some() || footing.strain > 0.0 || !footing.stands())
            && footing.keep(cost, impulse, clock.tick, clock.dt)
        {
            events.0.push((id, BodyEvent::Fell));
        }
    }
}
