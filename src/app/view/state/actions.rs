//! What a person asks of the window. Which keys ask for it is said in `input::keys`.

use bevy::prelude::*;

use super::overlays::Overlay;

/// What a person asks of the window.
#[derive(Message, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Play, or pause.
    PlayOrPause,
    /// Play one tick.
    OneTick,
    /// Play faster.
    Faster,
    /// Play slower.
    Slower,
    /// Play the match from its beginning.
    Restart,
    /// Select the next robot.
    NextRobot,
    /// Select the robot before.
    PreviousRobot,
    /// Take a robot over, or hand it back.
    HandOver,
    /// Show the whole pitch.
    Fit,
    /// Opens or closes the inspector.
    Inspector,
    /// Opens or closes the view of the whole world.
    World,
    /// Show the help.
    Help,
    /// Close what is open.
    Escape,
    /// Go back to the menu.
    Leave,
    /// Show an overlay, or hide it.
    Switch(Overlay),
}
