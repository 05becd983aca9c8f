//! What a match has heard of the referee box that refereed it, for the result.

use std::io::{self, Write};

use serde::Serialize;

use crate::game::Match;
use crate::world::gamecontroller::BoxNews;
use crate::world::gamecontroller::control::Penalty;
use crate::world::gamecontroller::referee_box::PacketCounts;

#[derive(Debug, Serialize)]
pub(super) struct BoxReport {
    /// The league's numbers of home and away; nothing if no box was heard.
    team_numbers: Option<[u8; 2]>,
    /// The version of its packets.
    version: Option<u8>,
    packets: PacketReport,
    /// The penalties that it gave, by robot.
    penalties: Vec<GivenPenalty>,
}

#[derive(Debug, Serialize)]
struct PacketReport {
    /// Followed, or the newest one once more.
    heard: u64,
    ignored: IgnoredPackets,
}

/// PacketReport that were not followed, by their reason.
#[derive(Debug, Serialize)]
struct IgnoredPackets {
    not_control_packets: u64,
    other_version: u64,
    wrong_length: u64,
    other_teams: u64,
    other_box: u64,
    overtaken: u64,
}

/// How often a robot got a penalty.
#[derive(Debug, Serialize)]
struct GivenPenalty {
    robot: String,
    penalty: String,
    times: u64,
}

impl BoxReport {
    pub fn of(game: &Match) -> Option<BoxReport> {
        let news = game.world().get_resource::<BoxNews>()?;
        let penalties = news.penalties.iter().map(|((robot, penalty), times)| GivenPenalty {
            robot: format!("{}:{}", robot.team, robot.number),
            penalty: Penalty::to_string(penalty),
            times: *times,
        });
        let PacketCounts { news: followed, repeated, not_ours, version, length, teams, sender, stale } =
            news.heard();
        let ignored = IgnoredPackets {
            not_control_packets: not_ours,
            other_version: version,
            wrong_length: length,
            other_teams: teams,
            other_box: sender,
            overtaken: stale,
        };
        Some(BoxReport {
            team_numbers: news.team_numbers(),
            version: news.sender().map(|(_, version)| version as u8),
            packets: PacketReport { heard: followed + repeated, ignored },
            penalties: penalties.collect(),
        })
    }

    pub fn print(&self, out: &mut impl Write) -> io::Result<()> {
        let Some(([home, away], version)) = self.team_numbers.zip(self.version) else {
            return writeln!(out, "referee box none was heard");
        };
        writeln!(out, "referee box version {version}: home is team {home}, away team {away}")?;
        let IgnoredPackets {
            not_control_packets,
            other_version,
            wrong_length,
            other_teams,
            other_box,
            overtaken,
        } = self.packets.ignored;
        let ignored =
            not_control_packets + other_version + wrong_length + other_teams + other_box + overtaken;
        let given: u64 = self.penalties.iter().map(|given| given.times).sum();
        let heard = self.packets.heard;
        writeln!(out, "            {heard:6} packets heard, {ignored} ignored, {given} penalties")
    }
}
