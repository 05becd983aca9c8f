//! ChaosManager over the TCM, between processes (TeamChaos, sections 1 and 3): it receives images and data from robots, sets their
//! running cameras and colours, sends strategies and teleoperates, by [external messages](crate::comms::tcm::ExternalMessage) on
//! three sockets beside the team's own. A match opens them if its plan says so; [`ChaosLink`] is the other side.

mod drivers;
mod link;
mod messages;
mod orders;
mod outbox;
mod plan;
mod robot_data;
mod sockets;
mod subscribers;
mod table;
mod talk;

pub use link::ChaosLink;
pub use messages::{
    BallData, CameraData, ChaosOrder, DebugData, ImageData, Instruction, OrderAnswer, Refusal, StrategyText,
    Subscription,
};
pub use outbox::OutboxFigures;
pub use plan::ChaosPlan;
pub(super) use sockets::ChaosSockets;
pub use sockets::{ChaosFigures, OrderFigures};
pub use table::ChaosSocket;
pub use talk::{ChaosNews, ChaosTalk, LinkFigures, StreamFigures};
