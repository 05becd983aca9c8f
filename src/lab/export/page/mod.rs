//! A match as one self-contained page: pitch, time line, messages, states with their reasons, beliefs beside the truth, and other
//! futures as ghosts. The page asks no server for anything.
//!
//! Its script and its style are files beside this one; its data is JSON, compressed, in base64.

mod data;
mod fork;
mod recorder;
mod robot_recorder;
mod spans;
mod track;

use std::io::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;

pub use data::{PageFork, PageMatch};
pub use fork::ForkRecorder;
pub use recorder::{PageRecorder, is_told};

use super::palette;
use crate::ids::Team;
use crate::lab::html::{escaped, filled};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In the order in which they are read.
const SCRIPTS: [&str; 5] = [
    include_str!("data.js"),
    include_str!("pitch.js"),
    include_str!("chart.js"),
    include_str!("time_line.js"),
    include_str!("page.js"),
];

impl PageMatch {
    /// The whole page.
    pub fn to_html(&self) -> String {
        let title = format!("{}: {} – {}", self.name, self.teams[0], self.teams[1]);
        let parts = [
            ("title", escaped(&title)),
            ("colours", colours()),
            ("style", STYLE.trim().to_owned()),
            ("data", BASE64_STANDARD.encode(self.packed())),
            ("script", SCRIPTS.map(str::trim).join("\n\n")),
        ];
        filled(PAGE, &parts)
    }

    /// What the page's script reads.
    fn packed(&self) -> Vec<u8> {
        let mut packer = GzEncoder::new(Vec::new(), Compression::best());
        // Numbers and texts in memory can always be written there.
        let json = serde_json::to_vec(self).unwrap_or_default();
        packer.write_all(&json).and_then(|()| packer.finish()).unwrap_or_default()
    }

    /// Messages, events and other futures that the page tells of.
    pub fn counts(&self) -> [usize; 3] {
        [self.messages.from.len(), self.events.len(), self.forks.len()]
    }
}

/// The colours of the window by their names in the style.
fn colours() -> String {
    let named = [
        ("floor", palette::FLOOR),
        ("carpet", palette::CARPET),
        ("stripe", palette::STRIPE),
        ("fence", palette::FENCE),
        ("chalk", palette::CHALK),
        ("blue-goal", palette::BLUE_GOAL),
        ("yellow-goal", palette::YELLOW_GOAL),
        ("robot", palette::ROBOT),
        ("head", palette::HEAD),
        ("robot-edge", palette::ROBOT_EDGE),
        ("ball", palette::BALL),
        ("ball-edge", palette::BALL_EDGE),
        ("lock", palette::LOCK),
        ("home", palette::team(Team::Home)),
        ("away", palette::team(Team::Away)),
    ];
    let lines = named.map(|(name, colour)| format!("  --{name}: {};", palette::hex(colour)));
    format!(":root {{\n{}\n}}", lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_asks_for_nothing_from_elsewhere() {
        for text in SCRIPTS.into_iter().chain([PAGE, STYLE]) {
            for door in ["http:", "https:", "src=", "href=", "@import", "url(", "fetch(", "XMLHttpRequest"] {
                assert!(!text.contains(door), "{door}");
            }
        }
    }

    #[test]
    fn every_part_of_the_page_is_filled() {
        for name in ["title", "colours", "style", "data", "script"] {
            assert_eq!(PAGE.matches(&format!("{{{{{name}}}}}")).count(), 1, "{name}");
        }
        assert_eq!(PAGE.matches("{{").count(), 5);
    }
}
