//! What the radio carries.

use crate::comms::messages::MessageKind;
use crate::ids::RobotId;

/// One delivery of a message to one receiver, as the radio sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Packet {
    pub kind: MessageKind,
    pub from: RobotId,
    pub to: RobotId,
    pub bytes: usize,
    /// Between the two robots, m.
    pub distance: f32,
}
