//! The kinds of files that there are, and what each is called.

use std::fmt;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AssetKind {
    /// What a team does.
    Strategy,
    /// A situation with expectations.
    Scenario,
    /// Who plays whom, where and by which rules.
    Match,
    /// A pitch with its goals.
    Pitch,
    /// A kind of robot.
    Robot,
    /// How well robots sense.
    Sensing,
    /// A camera, how it is set and what colours look like to it.
    Camera,
    /// How good the radio is.
    Radio,
    /// Matches that are to be compared.
    Experiment,
    /// A search for the best numbers of a strategy.
    Tuning,
    /// Where robots and computers are.
    Addresses,
}

impl AssetKind {
    /// Every kind.
    pub const ALL: [AssetKind; 11] = [
        AssetKind::Strategy,
        AssetKind::Scenario,
        AssetKind::Match,
        AssetKind::Pitch,
        AssetKind::Robot,
        AssetKind::Sensing,
        AssetKind::Camera,
        AssetKind::Radio,
        AssetKind::Experiment,
        AssetKind::Tuning,
        AssetKind::Addresses,
    ];

    /// The folder of its files among the assets.
    pub const fn folder(self) -> &'static str {
        match self {
            AssetKind::Strategy => "strategies",
            AssetKind::Scenario => "scenarios",
            AssetKind::Match => "matches",
            AssetKind::Pitch => "pitches",
            AssetKind::Robot => "robots",
            AssetKind::Sensing => "sensing",
            AssetKind::Camera => "cameras",
            AssetKind::Radio => "radios",
            AssetKind::Experiment => "experiments",
            AssetKind::Tuning => "tunings",
            AssetKind::Addresses => "addresses",
        }
    }

    /// Several of them, in words for people.
    pub const fn plural(self) -> &'static str {
        match self {
            AssetKind::Sensing => "sensing presets",
            AssetKind::Addresses => "tables of addresses",
            _ => self.folder(),
        }
    }
}

/// One of them, in words for people.
impl fmt::Display for AssetKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            AssetKind::Strategy => "strategy",
            AssetKind::Scenario => "scenario",
            AssetKind::Match => "match",
            AssetKind::Pitch => "pitch",
            AssetKind::Robot => "robot",
            AssetKind::Sensing => "sensing preset",
            AssetKind::Camera => "camera",
            AssetKind::Radio => "radio",
            AssetKind::Experiment => "experiment",
            AssetKind::Tuning => "tuning",
            AssetKind::Addresses => "table of addresses",
        })
    }
}
