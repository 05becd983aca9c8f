//! What a person asks of the window. Which keys ask for it is said in `input::keys`.

use bevy::prelude::*;

use super::overlays::Overlay;

/// What a person asks of the window.
#[derive(Message, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    PlayOrPause,
    OneTick,
    Faster,
    Slower,
    Restart,
    NextRobot,
    PreviousRobot,
    HandOver,
    Fit,
    /// Opens or closes the inspector.
    Inspector,
    /// Opens or closes the view of the whole world.
    World,
    Help,
    Escape,
    Leave,
    Switch(Overlay),
}
