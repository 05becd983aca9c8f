//! The one door of a match. Whatever comes from outside and may change it, from a person, a script, a changed file, a referee
//! box or a robot in another process, is a [`Request`]: plain data that wait in [`Requests`] and are due at the next tick.
//! Seed, assets and the requests of each tick are the whole match; a [`RequestLog`] keeps them.
//!
//! A tick begins with the door: who has something to say says it ([`DoorSystems::Ask`]), and what waited is put into an order
//! that does not depend on what arrived first. Then each kind of request is carried out by the file of its name.

mod bodies;
mod dice;
mod light;
mod pilots;
mod queue;
mod radio;
mod referee_box;
mod remote;
mod request;
mod robots;
mod strategies;
#[cfg(test)]
mod tests;

use bevy::prelude::*;

use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::{Strategies, StrategySources};
use crate::world::referee::PenaltiesDue;
pub use queue::{RequestLog, Requests, Script};
pub use request::{
    BodyChange, Calibration, NetworkDatagram, RadioChange, RemoteNews, Request, RobotChange, RobotWants,
};

pub(super) fn plugin(app: &mut App) {
    door(app);
    let of_a_match = (
        pilots::seat_pilots,
        radio::change_radio,
        bodies::move_bodies,
        light::change_light,
        dice::stir_dice,
        referee_box::hear_referee_box,
        remote::hear_remote_robots,
    );
    app.match_resource::<Script>();
    app.init_resource::<Script>()
        .add_systems(Tick, queue::follow_script.in_set(DoorSystems::Script))
        .add_systems(Tick, of_a_match.chain().in_set(DoorSystems::CarryOut).after(robots::change_robots));
}

/// What a match shares with a robot's mind that is a process of its own: there, too, strategies and robots are changed.
pub(crate) fn door(app: &mut App) {
    let order = (
        DoorSystems::Script,
        DoorSystems::Ask,
        DoorSystems::Open,
        DoorSystems::CarryOut.run_if(queue::is_any_due),
    );
    let of_minds = (strategies::change_strategies, robots::change_robots);
    app.match_resource::<Requests>().starts_empty();
    app.match_resource::<RequestLog>();
    app.match_resource::<Strategies>();
    app.match_resource::<StrategySources>();
    app.init_resource::<PenaltiesDue>()
        .init_resource::<StrategySources>()
        .configure_sets(Tick, order.chain().in_set(TickSystems::Script))
        .add_systems(Tick, queue::open_door.in_set(DoorSystems::Open))
        .add_systems(Tick, of_minds.chain().in_set(DoorSystems::CarryOut));
}

/// The order of the Script stage.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DoorSystems {
    /// A script makes its requests; people have made theirs between the ticks.
    Script,
    /// Sockets bring theirs.
    Ask,
    /// The requests that have waited are due.
    Open,
    /// They are carried out.
    CarryOut,
}
