//! What a person asks of the window. Which keys ask for it is said in `input::keys`.

use bevy::prelude::*;

use super::overlays::Overlay;
use crate::lab::rewind::BranchId;

/// What a person asks of the window.
#[derive(Message, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Play, or pause.
    PlayOrPause,
    /// Play one tick.
    OneTick,
    /// Go one tick back.
    TickBack,
    /// Go to the last event before now.
    EventBack,
    /// Go to the next event that is known.
    EventAhead,
    /// Go to where so many ticks are over.
    GoTo(u64),
    /// Play on in another branch.
    TakeBranch(BranchId),
    /// Take back what a person did last.
    Undo,
    /// Write the present moment as a scenario.
    SaveScenario,
    /// Say why things stand as they do.
    Why,
    /// Play on in a branch with one of the reasons undone, by its place.
    TakeReason(usize),
    /// Keep a bookmark here.
    Bookmark,
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
