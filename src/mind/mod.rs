//! What a robot believes, agrees with its team mates and wants. It knows only what it sensed and heard.

pub mod behaviour;
pub mod motor;
pub mod perception;
pub mod positioning;
pub mod schemas;
pub mod teamwork;
pub mod world_model;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::comms::messages::Inbox;
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};

pub(crate) fn plugin(app: &mut App) {
    let stages = (TickSystems::WorldModel, TickSystems::Teamwork, TickSystems::Behaviour, TickSystems::Motor);
    app.configure_sets(Tick, stages.run_if(there_is_something_to_do));
    app.add_plugins((world_model::plugin, teamwork::plugin, behaviour::plugin, motor::plugin));
}

/// Whether a decision falls into this tick, or a robot that does not hear has messages to drop. The stages of the mind do nothing in
/// other ticks, which are most.
fn there_is_something_to_do(clock: Res<Clock>, robots: Query<(&Robot, &Inbox)>) -> bool {
    robots
        .iter()
        .any(|(robot, inbox)| robot.is_due(clock.tick) || !(inbox.0.is_empty() || robot.health.hears()))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::comms::messages::{Received, TeamMessage};
    use crate::robot::{Health, RobotFailure};
    use crate::testing::{cye, perfect_sensing};

    #[test]
    fn the_stages_run_when_a_decision_falls_due_or_a_robot_that_does_not_hear_has_messages() {
        let mut app = App::new();
        app.add_plugins(crate::schedule::plugin);
        let clock = *app.world().resource::<Clock>();
        let robot = Robot::new(Arc::new(cye()), Arc::new(perfect_sensing()), &clock);
        let entity = app.world_mut().spawn((robot.clone(), Inbox::default())).id();
        let mut run = |tick: u64, health: Health, inbox: &[Received]| {
            app.world_mut().resource_mut::<Clock>().tick = tick;
            let mut body = app.world_mut().entity_mut(entity);
            body.get_mut::<Robot>().expect("it is a robot").health = health;
            body.get_mut::<Inbox>().expect("it has one").0 = inbox.to_vec();
            app.world_mut().run_system_cached(there_is_something_to_do).expect("it runs")
        };
        let (well, deaf) = (Health::default(), Health::default().with(RobotFailure::Deaf));
        let heard = [Received { from: 1, message: TeamMessage::Text("go".into()) }];
        for tick in 0..9 {
            let due = robot.is_due(tick);
            assert_eq!(run(tick, well, &heard), due, "tick {tick}");
            assert_eq!(run(tick, deaf, &[]), due, "tick {tick}");
            assert!(run(tick, deaf, &heard), "tick {tick}");
        }
    }
}
