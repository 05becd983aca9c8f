//! What view and inspector share: the match that is played, the selection, what is open, what was decided, and what is asked of
//! the window. It names nothing else of the window, and everything else of the window may name it.

mod actions;
mod layout;
mod news;
mod overlays;
mod panels;
mod playback;
mod session;

use bevy::ecs::schedule::{ScheduleLabel, SingleThreadedExecutor};
use bevy::prelude::*;

use crate::game::requests::{Request, Requests};
use crate::ids::RobotId;

pub use actions::Action;
pub use layout::{Edge, FreeArea, PITCH, PanelSystems, nearest_within};
pub use news::{Announcement, FileError, StopReason};
pub use overlays::{Overlay, Overlays, Press, shows};
pub use panels::{Inspector, OpenDialogues, OpenPanels, PanelSizes, Question, RememberedPanels};
pub use playback::Playback;
pub use session::{Beside, Folder, MatchBegun, PendingMatch, Rewound, Session};

pub(super) fn plugin(app: &mut App) {
    app.init_state::<Screen>()
        .init_resource::<Selected>()
        .init_resource::<Piloted>()
        .init_resource::<Carried>()
        .init_resource::<Overlays>()
        .init_resource::<Playback>()
        .init_resource::<OpenDialogues>()
        .init_resource::<Announcement>()
        .init_resource::<FileError>()
        .init_resource::<StopReason>()
        .init_resource::<PendingMatch>()
        .init_resource::<Beside>()
        .init_resource::<Session>()
        .init_schedule(AfterTick)
        .edit_schedule(AfterTick, |schedule| {
            schedule.set_executor(SingleThreadedExecutor::new());
        })
        .configure_sets(
            Update,
            (FrameSystems::Keys, FrameSystems::Input, FrameSystems::Time, FrameSystems::Picture)
                .chain()
                .run_if(in_state(Screen::Match)),
        );
}

/// What is shared by keys, panels and camera alone; a match can be tried without it.
pub(super) fn interface(app: &mut App) {
    app.add_message::<Action>()
        .init_resource::<Inspector>()
        .init_resource::<RememberedPanels>()
        .init_resource::<PanelSizes>()
        .add_plugins(layout::plugin);
}

/// The robot that a person has clicked or cycled to.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Selected(pub Option<RobotId>);

/// The robot under a person's hands, if any.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Piloted(pub Option<RobotId>);

impl Piloted {
    /// Puts a person's hands on a robot, or on none. The one that they had before goes back to its strategy.
    pub fn change(&mut self, to: Option<RobotId>, requests: &mut Requests) {
        let before = std::mem::replace(&mut self.0, to);
        if before == to {
            return;
        }
        if let Some(before) = before {
            requests.ask(Request::HandBack(before));
        }
        if let Some(robot) = to {
            requests.ask(Request::TakeOver(robot));
        }
    }
}

/// What a person carries over the pitch, and where it would be put down, in the pitch frame.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct Carried(pub Option<(InHand, Vec2)>);

/// What can be carried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InHand {
    /// The ball.
    Ball,
    /// A robot.
    Robot(RobotId),
}

/// What the window shows.
#[derive(States, Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Screen {
    /// The menu.
    #[default]
    Menu,
    /// A match.
    Match,
}

/// The order of a frame in `Update`.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameSystems {
    /// Keys and pointer become actions.
    Keys,
    /// Actions become requests.
    Input,
    /// The ticks that are due.
    Time,
    /// The picture follows.
    Picture,
}

/// Run after each tick, to look at the match; what runs here changes nothing of it.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct AfterTick;
