//! Telling others about our own match as a referee box would, so that programs that show matches show ours.

use super::control::{
    Colour, CompetitionPhase, CompetitionType, ControlPacket, Flag, GamePhase, PLAYER_SLOTS, Penalty,
    PlayerInfo, SetPlay, State, TeamInfo, Version,
};

/// What home and away wear, keepers and all: of the league's colours those that come nearest to our markers, which are
/// magenta and cyan.
const COLOURS: [Colour; 2] = [Colour::Purple, Colour::Blue];

/// Where our match stands. A side is 0 for home and 1 for away.
///
/// Seconds are told as a referee box tells them: rounded up, so that a clock shows 0 when it has run out, and kept within
/// what the packet can hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    pub version: Version,
    /// One more than in the last packet; wraps.
    pub packet_number: u8,
    pub game_phase: GamePhase,
    pub state: State,
    pub set_play: SetPlay,
    pub stopped: bool,
    pub first_half: bool,
    /// The side that defends the left goal. It is listed first, so that the order changes with the ends.
    pub left: usize,
    /// The side that has the kick-off or the set play.
    pub kicking: Option<usize>,
    /// Seconds left in the half.
    pub seconds_left: f64,
    /// Seconds on the second clock, 0 if it does not run.
    pub secondary_time: f64,
    /// Goals by side; more than 255 are told as 255.
    pub score: [u32; 2],
    /// The league's numbers of home and away.
    pub team_numbers: [u8; 2],
    /// In each team. The packet has room for 20.
    pub players_per_team: u8,
    /// The players that keep the goals, counted from 0.
    pub goalkeepers: [Option<u8>; 2],
    /// Messages that each team may still send; more than 65535 are told as that.
    pub message_budgets: [u64; 2],
    pub penalties: Vec<Sentence>,
}

/// A player of ours under a penalty. One that does not exist is left out of the packet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sentence {
    pub side: usize,
    /// Counted from 0.
    pub player: u8,
    pub penalty: Penalty,
    /// More than 255 are told as 255; an end that nobody knows as 0, as boxes do before they count the time.
    pub seconds_left: f64,
}

impl Default for Standing {
    /// A match of nobody against nobody that has not begun.
    fn default() -> Standing {
        Standing {
            version: Version::default(),
            packet_number: 0,
            game_phase: GamePhase::Normal,
            state: State::Initial,
            set_play: SetPlay::None,
            stopped: false,
            first_half: true,
            left: 0,
            kicking: None,
            seconds_left: 0.0,
            secondary_time: 0.0,
            score: [0, 0],
            team_numbers: [1, 2],
            players_per_team: 0,
            goalkeepers: [None, None],
            message_budgets: [0, 0],
            penalties: Vec::new(),
        }
    }
}

impl Standing {
    /// The packet that says this.
    pub fn packet(&self) -> ControlPacket {
        let left = self.left.min(1);
        ControlPacket {
            version: self.version,
            packet_number: self.packet_number,
            players_per_team: self.players_per_team,
            competition_phase: CompetitionPhase::RoundRobin,
            competition_type: CompetitionType::Small,
            stopped: Flag::from(self.stopped),
            game_phase: self.game_phase,
            state: self.state,
            set_play: self.set_play,
            first_half: Flag::from(self.first_half),
            kicking_team: self.kicking.and_then(|side| self.team_numbers.get(side).copied()),
            secs_remaining: whole_seconds(self.seconds_left),
            secondary_time: whole_seconds(self.secondary_time),
            teams: [left, 1 - left].map(|side| self.team(side)),
        }
    }

    fn team(&self, side: usize) -> TeamInfo {
        let mut players =
            [PlayerInfo { penalty: Penalty::Substitute, secs_till_unpenalised: 0, warnings: 0, cautions: 0 };
                PLAYER_SLOTS];
        for (player, slot) in (0..self.players_per_team).zip(&mut players) {
            slot.penalty = Penalty::None;
            for sentence in self.penalties.iter().filter(|s| (s.side, s.player) == (side, player)) {
                slot.penalty = sentence.penalty;
                let known = Some(sentence.seconds_left).filter(|seconds| seconds.is_finite());
                slot.secs_till_unpenalised = known.map_or(0, |seconds| seconds.ceil() as u8);
            }
        }
        TeamInfo {
            team_number: self.team_numbers[side],
            field_player_colour: COLOURS[side],
            goalkeeper_colour: COLOURS[side],
            goalkeeper: self.goalkeepers[side].map_or(0, |player| player.saturating_add(1)),
            score: u8::try_from(self.score[side]).unwrap_or(u8::MAX),
            penalty_shot: 0,
            single_shots: 0,
            message_budget: u16::try_from(self.message_budgets[side]).unwrap_or(u16::MAX),
            players,
        }
    }
}

/// Rounded up; what is out of range becomes the nearest number in it, and what is no number 0.
fn whole_seconds(seconds: f64) -> i16 {
    seconds.ceil() as i16
}

#[cfg(test)]
mod tests {
    use std::net::{IpAddr, Ipv4Addr, SocketAddr};

    use proptest::prelude::*;

    use super::super::referee_box::{Penalised, RefereeBox, View};
    use super::*;

    const BOX: SocketAddr = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 4000);

    fn standing() -> Standing {
        Standing {
            packet_number: 200,
            state: State::Playing,
            first_half: false,
            kicking: Some(1),
            seconds_left: 59.2,
            score: [2, 1],
            team_numbers: [70, 71],
            players_per_team: 4,
            penalties: vec![Sentence { side: 1, player: 3, penalty: Penalty::Pushing, seconds_left: 29.5 }],
            ..Standing::default()
        }
    }

    #[test]
    fn the_team_that_defends_the_left_goal_is_listed_first() {
        for (left, numbers) in [(0, [70, 71]), (1, [71, 70])] {
            let packet = Standing { left, ..standing() }.packet();
            assert_eq!(packet.teams.each_ref().map(|team| team.team_number), numbers);
            assert_eq!(packet.teams.each_ref().map(|team| team.score), [2 - left as u8, 1 + left as u8]);
            assert_eq!(packet.teams[1 - left].players[3].penalty, Penalty::Pushing);
            assert_eq!(packet.kicking_team, Some(71));
        }
    }

    #[test]
    fn every_version_is_written_with_the_keepers_the_budgets_and_the_markers() {
        for version in Version::ALL {
            let (goalkeepers, message_budgets) = ([Some(2), None], [11_999, 70_000]);
            let bytes = Standing { version, goalkeepers, message_budgets, ..standing() }.packet().write();
            let packet = ControlPacket::read(&bytes).unwrap();
            assert_eq!((bytes.len(), packet.version), (version.packet_len(), version));
            let [home, away] = packet.teams;
            assert_eq!([home.goalkeeper, away.goalkeeper], [3, 0]);
            assert_eq!([home.message_budget, away.message_budget], [11_999, u16::MAX]);
            assert_eq!([home.field_player_colour, away.field_player_colour], [Colour::Purple, Colour::Blue]);
            assert_eq!([home.goalkeeper_colour, away.goalkeeper_colour], [Colour::Purple, Colour::Blue]);
        }
    }

    #[test]
    fn a_penalty_whose_end_nobody_knows_has_no_seconds() {
        let mut standing = standing();
        standing.penalties[0].seconds_left = f64::INFINITY;
        let player = standing.packet().teams[1].players[3];
        assert_eq!((player.penalty, player.secs_till_unpenalised), (Penalty::Pushing, 0));
    }

    #[test]
    fn a_referee_box_that_announces_our_match_is_followed_as_one() {
        let mut referee = RefereeBox::new(Some([70, 71]), [4; 2]);
        let penalised = Penalised { player: 3, penalty: Penalty::Pushing, seconds_left: 30 };
        let expected = View {
            state: State::Playing,
            game_phase: GamePhase::Normal,
            set_play: SetPlay::None,
            stopped: false,
            first_half: false,
            left: 0,
            kicking: Some(1),
            score: [2, 1],
            seconds_left: 60,
            secondary_time: 0,
            penalties: [vec![], vec![penalised]],
            missing: [vec![], vec![]],
        };
        assert_eq!(referee.hear(BOX, &standing().packet().write(), 0), Ok(Some(expected)));
    }

    #[test]
    fn slots_without_a_player_are_substitutes() {
        let [home, away] = standing().packet().teams;
        for team in [home, away] {
            let substitutes = team.players.iter().filter(|player| player.penalty == Penalty::Substitute);
            assert_eq!((substitutes.count(), team.players[4].penalty), (16, Penalty::Substitute));
        }
    }

    #[test]
    fn what_the_packet_cannot_hold_is_told_as_the_nearest() {
        let nobody = |side, player| Sentence { side, player, penalty: Penalty::PickUp, seconds_left: 1.0 };
        let long = Sentence { side: 0, player: 0, penalty: Penalty::PickUp, seconds_left: 1e9 };
        let packet = Standing {
            seconds_left: -1e9,
            secondary_time: f64::NAN,
            score: [1000, 255],
            kicking: Some(2),
            penalties: vec![nobody(0, 4), nobody(0, 255), nobody(2, 0), long],
            ..standing()
        }
        .packet();
        assert_eq!((packet.secs_remaining, packet.secondary_time), (i16::MIN, 0));
        assert_eq!(packet.teams.each_ref().map(|team| team.score), [255, 255]);
        assert_eq!(packet.kicking_team, None);
        assert_eq!(packet.teams[0].players[0].secs_till_unpenalised, 255);
        let penalised = |p: &&PlayerInfo| p.penalty == Penalty::PickUp;
        assert_eq!(packet.teams.iter().flat_map(|team| &team.players).filter(penalised).count(), 1);
    }

    proptest! {
        #[test]
        fn an_announcement_reads_back_as_it_was_written(
            (packet_number, players_per_team, first_half, stopped) in any::<(u8, u8, bool, bool)>(),
            (seconds_left, kicking) in (any::<f64>(), prop::option::of(0usize..2)),
        ) {
            let packet =
                Standing { packet_number, players_per_team, first_half, stopped, seconds_left, kicking, ..standing() }
                    .packet();
            prop_assert_eq!(ControlPacket::read(&packet.write()), Ok(packet));
        }
    }
}
