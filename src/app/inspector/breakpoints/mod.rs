//! Breakpoints: the match stops after the very tick in which something happens that a person waits for. They look at the match after
//! each tick and change nothing of it.

mod breakpoint;
mod features;
mod kept;
mod list;
mod page;
mod tick_news;
mod watch;

use bevy::prelude::*;

pub use breakpoint::StopAt;
#[cfg(test)]
pub use breakpoint::{Breakpoint, MessageEvent, WhistleKind};
pub use list::Breakpoints;
pub use page::{BreakpointForm, OfferedStops, show_page};

use crate::app::view::state::{AfterTick, MatchBegun, Rewound, StopReason};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Breakpoints>()
        .init_resource::<BreakpointForm>()
        .add_plugins(kept::plugin)
        .add_observer(|_: On<MatchBegun>, mut reason: ResMut<StopReason>| *reason = StopReason(None))
        // On the way to where a person went, breakpoints were passed.
        .add_observer(|_: On<Rewound>, mut reason: ResMut<StopReason>| *reason = StopReason(None))
        .add_systems(AfterTick, watch::stop_at_breakpoints);
}
