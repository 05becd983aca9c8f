//! What a referee box says: the control packet, by UDP on [`PORT`], about twice per second.
//!
//! Numbers are little-endian and nothing is padded. Version 18 has 118 bytes, version 19 has 198, version 20
//! has 158.

use binrw::io::Cursor;
use binrw::{BinRead, BinWrite, binrw};
use thiserror::Error;

use super::codes::Coded;
pub use super::codes::{
    Colour, CompetitionPhase, CompetitionType, Flag, GamePhase, Penalty, SetPlay, State, Version,
};

/// The UDP port to which referee boxes send control packets.
pub const PORT: u16 = 3838;
/// The UDP port on which a referee box hears who else wants to be told about the match.
pub const MONITOR_REQUEST_PORT: u16 = 3636;

/// The slots for players in a team, whether taken or not.
pub const PLAYER_SLOTS: usize = 20;

/// The first bytes of every control packet.
const MAGIC: [u8; 4] = *b"RGme";
/// The number that stands for neither team.
pub const NO_TEAM: u8 = 255;

/// A control packet of any version.
#[binrw]
#[brw(little, magic = b"RGme")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ControlPacket {
    /// The version of the packet.
    pub version: Version,
    /// Counts the packets of a referee box and wraps.
    pub packet_number: u8,
    /// Players that a team may have on the field.
    pub players_per_team: u8,
    /// Only in version 18; otherwise read as the round robin.
    #[br(if(version == Version::V18, CompetitionPhase::RoundRobin))]
    #[br(map = |number| CompetitionPhase::read(number, version))]
    #[bw(if(*version == Version::V18), map = |phase| phase.write(*version))]
    pub competition_phase: CompetitionPhase,
    /// The competition.
    #[br(map = |number| CompetitionType::read(number, version))]
    #[bw(map = |kind| kind.write(*version))]
    pub competition_type: CompetitionType,
    /// The referee has stopped the play, whatever the state. Not in version 18.
    #[br(if(version != Version::V18))]
    #[bw(if(*version != Version::V18))]
    pub stopped: Flag,
    /// The phase of the game.
    #[br(map = |number| GamePhase::read(number, version))]
    #[bw(map = |phase| phase.write(*version))]
    pub game_phase: GamePhase,
    /// The state of the game.
    #[br(map = |number| State::read(number, version))]
    #[bw(map = |state| state.write(*version))]
    pub state: State,
    /// The set play that runs.
    #[br(map = |number| SetPlay::read(number, version))]
    #[bw(map = |set_play| set_play.write(*version))]
    pub set_play: SetPlay,
    /// Whether it is the first half.
    pub first_half: Flag,
    /// The number of the team that has the kick-off or the set play. 255 stands for none.
    #[br(map = |number: u8| (number != NO_TEAM).then_some(number))]
    #[bw(map = |team| team.unwrap_or(NO_TEAM))]
    pub kicking_team: Option<u8>,
    /// Seconds left in the half; negative when it has run over.
    pub secs_remaining: i16,
    /// Seconds on the second clock: what is left of `Ready`, of a set play, of a time-out.
    pub secondary_time: i16,
    /// Either team may be first: both leagues' boxes begin with the one that defends the left goal.
    #[br(args(version))]
    #[bw(args(*version))]
    pub teams: [TeamInfo; 2],
}

/// A team in a control packet.
#[binrw]
#[brw(little, import(version: Version))]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TeamInfo {
    /// The league's number of the team.
    pub team_number: u8,
    /// The colour of its field players.
    #[br(map = |number| Colour::read(number, version))]
    #[bw(map = |colour| colour.write(version))]
    pub field_player_colour: Colour,
    /// The colour of its goalkeeper.
    #[br(map = |number| Colour::read(number, version))]
    #[bw(map = |colour| colour.write(version))]
    pub goalkeeper_colour: Colour,
    /// The goalkeeper's number, from 1. 0 stands for none.
    pub goalkeeper: u8,
    /// Its goals.
    pub score: u8,
    /// Penalty shots so far. In version 18, outside a penalty shoot-out, other than 0 for a team in fallback mode.
    pub penalty_shot: u8,
    /// A bit for each penalty shot, the first the lowest: whether it was a goal.
    pub single_shots: u16,
    /// Messages that the team may still send in this match.
    pub message_budget: u16,
    /// By the number on the shirt, which counts from 1: player 1 is at 0.
    #[brw(args(version))]
    pub players: [PlayerInfo; PLAYER_SLOTS],
}

/// A player in a control packet.
#[binrw]
#[brw(little, import(version: Version))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlayerInfo {
    /// Its penalty.
    #[br(map = |number| Penalty::read(number, version))]
    #[bw(map = |penalty| penalty.write(version))]
    pub penalty: Penalty,
    /// The referee box's estimate, in seconds.
    pub secs_till_unpenalised: u8,
    /// Only in version 19.
    #[brw(if(version == Version::V19))]
    pub warnings: u8,
    /// Yellow cards. Not in version 18.
    #[brw(if(version != Version::V18))]
    pub cautions: u8,
}

/// Why bytes are not a control packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Error)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum PacketError {
    /// It does not begin as such packets do.
    #[error("not a control packet: it does not begin with \"RGme\" and a version")]
    NotOurs,
    /// Its version is unknown.
    #[error("a control packet of version {0}, where 18 to 20 are understood")]
    Version(u8),
    /// It has another length than its version has.
    #[error("a control packet of {got} bytes, where its version has {expected}")]
    Length { got: usize, expected: usize },
}

impl Version {
    /// All that are understood.
    pub const ALL: [Version; 3] = [Version::V18, Version::V19, Version::V20];

    /// The version of this number, if it is understood.
    pub fn from_number(number: u8) -> Option<Version> {
        Version::ALL.into_iter().find(|version| *version as u8 == number)
    }

    /// The bytes of a control packet.
    pub const fn packet_len(self) -> usize {
        match self {
            Version::V18 => 118,
            Version::V19 => 198,
            Version::V20 => 158,
        }
    }
}

impl ControlPacket {
    /// The packet in these bytes.
    ///
    /// # Errors
    /// If they are something else, a version that is not understood, or too short or too long.
    pub fn read(bytes: &[u8]) -> Result<ControlPacket, PacketError> {
        let number = match bytes.split_first_chunk() {
            Some((&MAGIC, [number, ..])) => *number,
            _ => return Err(PacketError::NotOurs),
        };
        let version = Version::from_number(number).ok_or(PacketError::Version(number))?;
        let length = PacketError::Length { got: bytes.len(), expected: version.packet_len() };
        if bytes.len() != version.packet_len() {
            return Err(length);
        }
        // Every byte has some meaning, so that only the length can be wrong.
        <ControlPacket as BinRead>::read(&mut Cursor::new(bytes)).map_err(|_| length)
    }

    /// The bytes of this packet, [`Version::packet_len`] of them. What its version has no place for is left out, and what
    /// it has no number for is written as what comes nearest.
    pub fn write(&self) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::with_capacity(self.version.packet_len()));
        // Writing to memory does not fail.
        match BinWrite::write(self, &mut bytes) {
            Ok(()) => bytes.into_inner(),
            Err(_) => Vec::new(),
        }
    }

    /// Where the team of this number is in `teams`, the first if both have it.
    pub fn place_of(&self, team_number: u8) -> Option<usize> {
        self.teams.iter().position(|team| team.team_number == team_number)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use proptest::prelude::*;

    use super::*;

    pub const SPL_INITIAL: &[u8] = include_bytes!("../../../tests/golden/gamecontroller/SPL-initial.bin");
    pub const SPL_LAST: &[u8] = include_bytes!("../../../tests/golden/gamecontroller/SPL-last.bin");
    pub const HSL_INITIAL: &[u8] =
        include_bytes!("../../../tests/golden/gamecontroller/HumanoidSoccerLeague-initial.bin");
    pub const HSL_LAST: &[u8] =
        include_bytes!("../../../tests/golden/gamecontroller/HumanoidSoccerLeague-last.bin");

    pub const V20_INITIAL: &[u8] = include_bytes!("../../../tests/golden/gamecontroller/v20-initial.bin");
    pub const V20_STOPPED: &[u8] =
        include_bytes!("../../../tests/golden/gamecontroller/v20-stopped-free-kick.bin");
    pub const V20_PENALTIES: &[u8] =
        include_bytes!("../../../tests/golden/gamecontroller/v20-new-penalties.bin");

    /// Packets of any version with anything in them.
    pub fn packets() -> impl Strategy<Value = Vec<u8>> {
        prop::sample::select(Version::ALL.to_vec()).prop_flat_map(|version| {
            prop::collection::vec(any::<u8>(), version.packet_len()).prop_map(move |mut bytes| {
                bytes[..4].copy_from_slice(&MAGIC);
                bytes[4] = version as u8;
                bytes
            })
        })
    }

    fn team(team_number: u8, colours: (Colour, Colour), version: Version) -> TeamInfo {
        let player = |penalty| PlayerInfo { penalty, secs_till_unpenalised: 0, warnings: 0, cautions: 0 };
        TeamInfo {
            team_number,
            field_player_colour: colours.0,
            goalkeeper_colour: colours.1,
            goalkeeper: 1,
            score: 0,
            penalty_shot: 0,
            single_shots: 0,
            message_budget: if version == Version::V18 { 1200 } else { 12000 },
            players: std::array::from_fn(|i| player(if i < 7 { Penalty::None } else { Penalty::Substitute })),
        }
    }

    /// The third packet of either box: seven against seven, ten minutes, the first team has the kick-off.
    fn initial(version: Version, teams: [TeamInfo; 2]) -> ControlPacket {
        ControlPacket {
            version,
            packet_number: 3,
            players_per_team: 7,
            competition_phase: CompetitionPhase::RoundRobin,
            competition_type: CompetitionType::read(0, version),
            stopped: Flag(0),
            game_phase: GamePhase::Normal,
            state: State::Initial,
            set_play: SetPlay::None,
            first_half: Flag(1),
            kicking_team: Some(teams[0].team_number),
            secs_remaining: 600,
            secondary_time: 0,
            teams,
        }
    }

    fn spl_initial() -> ControlPacket {
        let black = team(5, (Colour::Black, Colour::Purple), Version::V18);
        initial(Version::V18, [black, team(24, (Colour::Grey, Colour::Grey), Version::V18)])
    }

    fn hsl_initial() -> ControlPacket {
        initial(Version::V19, [6, 9].map(|number| team(number, (Colour::Red, Colour::Blue), Version::V19)))
    }

    #[track_caller]
    fn is_what_was_captured(bytes: &[u8], packet: &ControlPacket) {
        assert_eq!(ControlPacket::read(bytes).as_ref(), Ok(packet));
        assert_eq!(packet.write(), bytes);
    }

    #[test]
    fn the_first_packets_of_both_boxes_are_understood() {
        is_what_was_captured(SPL_INITIAL, &spl_initial());
        is_what_was_captured(HSL_INITIAL, &hsl_initial());
        assert_eq!(hsl_initial().competition_type, CompetitionType::Small);
    }

    #[test]
    fn a_goal_and_a_penalty_are_understood_in_version_18() {
        let mut packet = spl_initial();
        (packet.packet_number, packet.state, packet.kicking_team) = (24, State::Ready, None);
        (packet.secs_remaining, packet.secondary_time) = (594, 44);
        (packet.teams[0].score, packet.teams[0].message_budget) = (1, 1195);
        packet.teams[1].message_budget = 1199;
        packet.teams[1].players[1].penalty = Penalty::Stance;
        packet.teams[1].players[1].secs_till_unpenalised = 42;
        is_what_was_captured(SPL_LAST, &packet);
    }

    #[test]
    fn a_goal_and_a_penalty_are_understood_in_version_19() {
        let mut packet = hsl_initial();
        (packet.packet_number, packet.state, packet.kicking_team) = (18, State::Playing, Some(9));
        (packet.secs_remaining, packet.secondary_time) = (596, 8);
        (packet.teams[0].score, packet.teams[0].message_budget) = (1, 11995);
        packet.teams[1].message_budget = 11999;
        packet.teams[1].players[1].penalty = Penalty::Pushing;
        is_what_was_captured(HSL_LAST, &packet);
    }

    /// Four against four middle-sized robots in version 20, of teams 12 and 34.
    fn v20_initial() -> ControlPacket {
        let teams = [(12, Colour::Red), (34, Colour::Blue)].map(|(number, colour)| {
            let mut team = team(number, (colour, colour), Version::V20);
            team.players[4..7].iter_mut().for_each(|player| player.penalty = Penalty::Substitute);
            team
        });
        let competition_type = CompetitionType::Middle;
        ControlPacket { players_per_team: 4, competition_type, ..initial(Version::V20, teams) }
    }

    /// A free kick of team 34, one of whose robots is a substitute, while the play is stopped, after a goal of team 12.
    fn v20_stopped() -> ControlPacket {
        let mut packet = v20_initial();
        (packet.packet_number, packet.state, packet.kicking_team) = (24, State::Playing, Some(34));
        (packet.stopped, packet.set_play) = (Flag(1), SetPlay::DirectFreeKick);
        (packet.secs_remaining, packet.secondary_time) = (596, 44);
        (packet.teams[0].score, packet.teams[0].message_budget) = (1, 11995);
        packet.teams[0].players[1] =
            PlayerInfo { penalty: Penalty::Pushing, secs_till_unpenalised: 42, warnings: 0, cautions: 1 };
        packet.teams[1].players[3].penalty = Penalty::Substitute;
        packet
    }

    #[test]
    fn a_stopped_free_kick_is_understood_in_version_20() {
        is_what_was_captured(V20_INITIAL, &v20_initial());
        is_what_was_captured(V20_STOPPED, &v20_stopped());
    }

    #[test]
    fn the_penalties_that_are_new_in_version_20_are_understood() {
        let mut packet = v20_stopped();
        let new = [(Penalty::MotionInStop, 45), (Penalty::Cautioned, 45), (Penalty::SentOff, 0)];
        for (slot, (penalty, seconds)) in packet.teams[1].players.iter_mut().zip(new) {
            (slot.penalty, slot.secs_till_unpenalised) = (penalty, seconds);
        }
        is_what_was_captured(V20_PENALTIES, &packet);
    }

    #[test]
    fn what_is_no_control_packet_is_refused_with_the_reason() {
        let changed = |place: usize, byte| {
            let mut bytes = HSL_INITIAL.to_vec();
            bytes[place] = byte;
            ControlPacket::read(&bytes).unwrap_err()
        };
        assert_eq!(changed(2, b't'), PacketError::NotOurs);
        assert_eq!(changed(4, 21), PacketError::Version(21));
        assert_eq!(changed(4, 20), PacketError::Length { got: 198, expected: 158 });
        assert_eq!(changed(4, 18), PacketError::Length { got: 198, expected: 118 });
        for cut in 0..198 {
            let length = PacketError::Length { got: cut, expected: 198 };
            let expected = if cut < 5 { PacketError::NotOurs } else { length };
            assert_eq!(ControlPacket::read(&HSL_INITIAL[..cut]), Err(expected));
        }
        assert!(changed(4, 21).to_string().contains("version 21"));
    }

    #[test]
    fn a_clock_that_has_run_over_is_negative() {
        let packet = ControlPacket { secs_remaining: -3, ..hsl_initial() };
        assert_eq!(packet.write()[14..16], [0xFD, 0xFF]);
        assert_eq!(ControlPacket::read(&packet.write()), Ok(packet));
    }

    proptest! {
        #[test]
        fn every_packet_is_written_as_it_was_read(bytes in packets()) {
            let packet = ControlPacket::read(&bytes).unwrap();
            prop_assert_eq!(packet.write(), bytes);
        }

        #[test]
        fn a_packet_in_another_version_has_its_length_and_reads(
            bytes in packets(),
            version in prop::sample::select(Version::ALL.to_vec()),
        ) {
            let written = ControlPacket { version, ..ControlPacket::read(&bytes).unwrap() }.write();
            prop_assert_eq!(written.len(), version.packet_len());
            prop_assert_eq!(ControlPacket::read(&written).unwrap().write(), written);
        }

        #[test]
        fn any_bytes_are_read_or_refused(ours: bool, rest in prop::collection::vec(any::<u8>(), 0..256)) {
            let bytes = if ours { [&MAGIC, &rest[..]].concat() } else { rest };
            if let Ok(packet) = ControlPacket::read(&bytes) {
                prop_assert_eq!(packet.write(), bytes);
            }
        }
    }
}
