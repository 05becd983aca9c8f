//! For the tests: an example scenario, what its names refer to, and a stage on which scenes are set.

use std::collections::BTreeMap;

use bevy::prelude::Vec2;

use super::check::{Known, KnownTeam, Scenario, check};
use super::file::ScenarioFile;
use super::scene::{RobotScene, Scene};
use crate::comms::radio::RadioRecord;
use crate::data::{DataError, Source};
use crate::game::record::{Invariants, RobotContacts};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::pitch::Pitch;
use crate::testing;

/// Ticks a second.
pub(super) const HZ: f32 = 60.0;

pub(super) const EXAMPLE: &str = r#"(
    name: "The floater takes over from a halfback that breaks down",
    source: "Hammerheads 2001, section VI-B",
    seeds: 3,
    seconds: 20,
    home: (
        strategy: "hammerheads_2001",
        players: [
            (number: 2, at: (-1.2, -1.0), facing: 90),
            (number: 1, at: (-2.2, 0.8), role: "halfback"),
            (number: 3, at: (0.0, 0.0), off: true),
        ],
    ),
    ball: (at: (-1.5, 0.5), velocity: (0.5, 0.0)),
    faults: [(kind: AckSwap, from: "home 2", which: First, act: Drop)],
    script: [
        (at: 3, what: Crash("home 1")),
        (at: 1, what: InitiateSwap(robot: "home 2", roles: [("floater", "forward"), ("forward", "floater")])),
    ],
    expect: [
        Eventually(what: ActingAs("home 2", "halfback"), within: 5, after: 3),
        Always(what: RolesDistinct(Home)),
        Never(what: All([Claims("home 1"), Claims("home 2")]), from: 2, until: 10, because: "one is enough"),
        Finally(what: Distance(from: Ball, to: Goal(Home), above: 0.5)),
    ],
    depends_on: FloaterDropsBack,
)"#;

pub(super) fn example() -> ScenarioFile {
    Source::new("x.ron", EXAMPLE).parse().unwrap()
}

/// The scenario in a text, for a pitch and strategies made up here.
pub(super) fn checked(text: &str) -> Result<Scenario, DataError> {
    let source = Source::new("x.ron", text);
    let pitch = testing::pitch();
    let kind = testing::cye();
    let places = [Vec2::ZERO; 4];
    let team = || KnownTeam {
        kick_off: &places,
        line_ups: BTreeMap::new(),
        kind: Some(&kind),
        roles: vec!["goalie", "halfback", "floater", "forward"],
        activities: vec!["search", "acquire", "push"],
    };
    let radios = vec!["lossy".to_owned(), "perfect".to_owned()];
    let strategies = vec!["zonal".to_owned()];
    let known = Known { pitch: &pitch, ball: &testing::BALL, teams: [team(), team()], radios, strategies };
    check(&source.parse()?, &source, &known)
}

/// The example with other expectations.
pub(super) fn expecting(expectations: &str) -> Scenario {
    let (start, rest) = EXAMPLE.split_once("expect: [").unwrap();
    let (_, end) = rest.split_once("    ],\n").unwrap();
    checked(&format!("{start}expect: [{expectations}],\n{end}")).unwrap()
}

/// The scene of a tick, to be changed at will: four robots of home, all on and in different roles.
pub(super) struct Stage {
    pub pitch: Pitch,
    pub ball: Vec2,
    pub robots: Vec<RobotScene<'static>>,
    pub score: [u32; 2],
    pub radio: RadioRecord,
    pub contacts: RobotContacts,
    pub invariants: Invariants,
}

impl Default for Stage {
    fn default() -> Stage {
        let robots = ["goalie", "halfback", "floater", "forward"].into_iter().enumerate();
        let robots = robots.map(|(number, role)| RobotScene {
            id: RobotId::new(Team::Home, number as u8),
            pose: Pose::new(number as f32 - 3.0, 0.0, 0.0),
            speed: 0.0,
            on: true,
            role,
            acting_as: role,
            activity: "search",
            within: Vec::new(),
            claims: false,
            holder: None,
            goes: false,
            drives: false,
            booker: None,
            locked_by: None,
            configuration: None,
        });
        Stage {
            pitch: testing::pitch(),
            ball: Vec2::ZERO,
            robots: robots.collect(),
            score: [0; 2],
            radio: RadioRecord::default(),
            contacts: RobotContacts::default(),
            invariants: Invariants::default(),
        }
    }
}

impl Stage {
    pub(super) fn scene(&self, tick: u64) -> Scene<'_> {
        Scene {
            tick,
            pitch: &self.pitch,
            ball: self.ball,
            ball_velocity: Vec2::ZERO,
            ball_at_start: Vec2::ZERO,
            robots: self.robots.clone(),
            score: self.score,
            radio: &self.radio,
            contacts: &self.contacts,
            invariants: &self.invariants,
        }
    }
}
