//! What a page knows of a match, as it is written into it: JSON that the page's script reads. Lengths are metres, angles degrees
//! unless a track says otherwise, times ticks. Words that come again and again are numbers of `words`.

use std::collections::BTreeMap;

use bevy::math::Vec2;
use serde::Serialize;

use super::track::KnotTable;
use crate::lab::export::outlines::RobotOutlines;

/// The number of the format; the script refuses another.
pub const FORMAT: u32 = 1;

/// A match as a page shows it.
#[derive(Debug, Serialize)]
pub struct PageMatch {
    pub(super) format: u32,
    pub(super) program: String,
    pub(super) name: String,
    pub(super) seed: u64,
    pub(super) digest: String,
    pub(super) teams: [String; 2],
    /// Seconds of a tick.
    pub(super) dt: f64,
    /// The last tick.
    pub(super) ticks: u64,
    /// Seconds of a half.
    pub(super) half_seconds: f64,
    /// How exact tracks are.
    pub(super) exact: ExactnessTable,
    pub(super) pitch: PagePitch,
    pub(super) ball: PageBall,
    /// Kinds of robots.
    pub(super) kinds: Vec<RobotOutlines>,
    pub(super) robots: Vec<PageRobot>,
    /// The tags of roles by their names, home first.
    pub(super) tags: [BTreeMap<String, String>; 2],
    pub(super) phases: Vec<PagePhase>,
    pub(super) events: Vec<PageEvent>,
    pub(super) messages: MessageTable,
    pub(super) forks: Vec<PageFork>,
    pub(super) words: Vec<String>,
}

/// Units of tracks and how far they may be off, for true and for believed places and headings: m and rad.
#[derive(Debug, Serialize)]
pub struct ExactnessTable {
    pub place: [f64; 2],
    pub heading: [f64; 2],
    pub believed_place: [f64; 2],
    pub believed_heading: [f64; 2],
}

#[derive(Debug, Serialize)]
pub struct PagePitch {
    pub length: f32,
    pub width: f32,
    /// Between the posts, and behind the line.
    pub goal: [f32; 2],
    /// Along x from the goal line, and along y.
    pub area: [f32; 2],
    pub circle: f32,
    pub spots: Vec<Vec2>,
    /// Carpet beyond the lines; 0 where the walls are the lines.
    pub margin: f32,
    /// Thickness of walls.
    pub wall: f32,
}

#[derive(Debug, Serialize)]
pub struct PageBall {
    pub radius: f32,
    pub track: KnotTable,
}

#[derive(Debug, Serialize)]
pub struct PageRobot {
    pub name: String,
    /// 0 for home, 1 for away.
    pub team: usize,
    pub number: u8,
    /// Place in `kinds`.
    pub kind: usize,
    pub track: KnotTable,
    /// The trailer's heading.
    pub trailer: Option<KnotTable>,
    /// Where the head looks, from the body's heading.
    pub head: Option<KnotTable>,
    /// Where it believes itself to be.
    pub believed: KnotTable,
    /// Where it believes the ball to be.
    pub believed_ball: KnotTable,
    /// Where it believes others to be.
    pub others: OthersTable,
    /// Tick, words for role, acted role, state and reason.
    pub states: Vec<(u64, usize, usize, usize, usize)>,
    /// Tick, and what is wrong or special from then on: see [`RobotSigns`].
    pub signs: Vec<(u64, u16)>,
    /// From, until, by whom, sequence.
    pub locks: Vec<(u64, u64, u8, u64)>,
    /// From, until, sequence.
    pub attempts: Vec<(u64, u64, u64)>,
    /// From, until, who has booked, whether the robot itself goes to the ball.
    pub bookings: Vec<(u64, u64, u8, bool)>,
    /// From, until.
    pub claims: Vec<(u64, u64)>,
}

/// Other robots that a robot believes in, a few times a second.
#[derive(Debug, Default, Serialize)]
pub struct OthersTable {
    /// Ticks, as differences.
    pub t: Vec<i64>,
    /// How many there are at each tick.
    pub n: Vec<usize>,
    /// Twice the place in centimetres, x and y; of the away team if x is odd.
    pub at: Vec<i64>,
}

/// What is wrong or special with a robot, as bits.
pub struct RobotSigns;

impl RobotSigns {
    pub const CRASHED: u16 = 1;
    pub const FROZEN: u16 = 2;
    pub const DEAF: u16 = 4;
    pub const MUTE: u16 = 8;
    pub const OFF_PITCH: u16 = 16;
    pub const PILOTED: u16 = 32;
}

#[derive(Debug, PartialEq, Serialize)]
pub struct PagePhase {
    pub tick: u64,
    pub phase: String,
    pub half: u8,
    /// Seconds of the half that are left then. They pass while the phase is `playing`.
    pub left: f64,
    pub score: [u32; 2],
}

/// What a page marks on its time line.
#[derive(Debug, PartialEq, Serialize)]
pub struct PageEvent {
    pub tick: u64,
    pub kind: EventKind,
    pub text: String,
    /// The team that it is of, if it is of one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub team: Option<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    Goal,
    Call,
    Removal,
    Half,
    Role,
    Crash,
}

/// Messages by column.
#[derive(Debug, Default, Serialize)]
pub struct MessageTable {
    /// The ticks in which they were sent, as differences.
    pub sent: Vec<i64>,
    /// How many ticks they took; nothing was heard of those that were lost.
    pub took: Vec<u64>,
    /// Robots by their places.
    pub from: Vec<usize>,
    pub to: Vec<usize>,
    /// Words.
    pub kind: Vec<usize>,
    /// The number of the attempt that a message of a role swap belongs to, from 1; 0 for others.
    pub attempt: Vec<u64>,
    /// 0 for those that arrived; else 1 + the word of the reason.
    pub lost: Vec<usize>,
    /// 1 for those that came late.
    pub late: Vec<u8>,
}

/// Another future of the match, worked out beforehand.
#[derive(Clone, Debug, Serialize)]
pub struct PageFork {
    pub(super) title: String,
    pub(super) detail: String,
    /// Where it leaves the match, and where it ends.
    pub(super) from: u64,
    pub(super) until: u64,
    /// Goals at its end, home first.
    pub(super) score: [u32; 2],
    pub(super) ball: KnotTable,
    /// In the order of the match's robots.
    pub(super) robots: Vec<ForkedRobot>,
    pub(super) events: Vec<(u64, String)>,
}

impl PageFork {
    /// The tick in which it leaves the match.
    pub fn begins_at(&self) -> u64 {
        self.from
    }

    /// Its last tick.
    pub fn ends_at(&self) -> u64 {
        self.until
    }

    /// Whether this is the score at its end.
    pub fn ends_with(&self, score: [u32; 2]) -> bool {
        self.score == score
    }
}

#[derive(Clone, Debug, Serialize)]
pub struct ForkedRobot {
    pub track: KnotTable,
    pub trailer: Option<KnotTable>,
}
