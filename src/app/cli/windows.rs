//! What commands need to open a window, in builds with windows and in those without.

#[cfg(feature = "window")]
pub(super) use with_windows::{missing, open_chaos_window, open_match_window};
#[cfg(not(feature = "window"))]
pub(super) use without_windows::{missing, open_chaos_window, open_match_window};

#[cfg(feature = "window")]
mod with_windows {
    use std::path::PathBuf;

    use crate::app::chaos_window::KnownMatch;
    use crate::app::cli::ending::Ending;
    pub use crate::app::headless_check::missing_for_a_window as missing;
    use crate::app::match_request::MatchRequest;
    use crate::app::window::WindowEnd;
    use crate::data::AssetFolder;
    use crate::game::MatchPlan;
    use crate::game::net::chaos::ChaosLink;

    /// What is played is recorded, if a file for it is given. The frame rate is told, if that is wanted.
    pub fn open_match_window(
        assets: &AssetFolder,
        wanted: Option<MatchRequest>,
        record: Option<PathBuf>,
        frame_rate: bool,
    ) -> Ending {
        ending(crate::app::window::open_window(assets, wanted, record, frame_rate))
    }

    pub fn open_chaos_window(assets: &AssetFolder, link: ChaosLink, game: Option<&MatchPlan>) -> Ending {
        let known = game.map(|plan| KnownMatch::of(plan, link.robot()));
        ending(crate::app::chaos_window::open_chaos_window(link, assets, known))
    }

    fn ending(end: WindowEnd) -> Ending {
        match end {
            WindowEnd::Closed => Ending::Done,
            WindowEnd::ScenarioFailed => Ending::Failed,
            WindowEnd::Interrupted => Ending::Interrupted,
            WindowEnd::Failed => Ending::WindowFailed,
        }
    }

    #[cfg(test)]
    mod tests {
        use bevy::prelude::AppExit;

        use super::*;
        use crate::app::view::time::expectations;
        use crate::app::window::ended;

        #[test]
        fn how_a_window_ended_is_an_exit_code() {
            let code = |exit| ending(ended(exit)) as u8;
            assert_eq!(code(AppExit::Success), 0);
            assert_eq!(code(AppExit::from_code(expectations::FAILED)), 1);
            assert_eq!(code(AppExit::from_code(130)), 130);
            assert_eq!(code(AppExit::error()), 4);
        }
    }
}

#[cfg(not(feature = "window"))]
mod without_windows {
    use std::path::PathBuf;

    use crate::app::cli::ending::Ending;
    use crate::app::match_request::MatchRequest;
    use crate::data::AssetFolder;
    use crate::game::MatchPlan;
    use crate::game::net::chaos::ChaosLink;

    pub fn missing() -> Option<&'static str> {
        Some("this build has no window")
    }

    pub fn open_match_window(
        _: &AssetFolder,
        _: Option<MatchRequest>,
        _: Option<PathBuf>,
        _: bool,
    ) -> Ending {
        Ending::WindowFailed
    }

    pub fn open_chaos_window(_: &AssetFolder, _: ChaosLink, _: Option<&MatchPlan>) -> Ending {
        Ending::WindowFailed
    }
}
