//! Telling others about our own match as a referee box would, so that programs that show matches show ours.

use super::control::{
    Colour, CompetitionPhase, CompetitionType, ControlPacket, Flag, PLAYER_SLOTS, Penalty, PlayerInfo,
    TeamInfo, Version,
};
use super::view::BoxView;

/// What home and away wear, keepers and all: of the league's colours those that come nearest to our markers, which are
/// magenta and cyan.
const COLOURS: [Colour; 2] = [Colour::Purple, Colour::Blue];

/// What is told of our match. A side is 0 for home and 1 for away.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MatchAnnouncement {
    /// Of the packets.
    pub version: Version,
    /// One more than in the last packet; wraps.
    pub packet_number: u8,
    /// Where the match stands. The side that defends the left goal is listed first, so that the order changes with the ends.
    pub view: BoxView,
    /// The league's numbers of home and away.
    pub team_numbers: [u8; 2],
    /// In each team. The packet has room for 20.
    pub players_per_team: u8,
    /// The players that keep the goals, counted from 0.
    pub goalkeepers: [Option<u8>; 2],
    /// Messages that each team may still send; more than 65535 are told as that.
    pub message_budgets: [u64; 2],
}

impl Default for MatchAnnouncement {
    /// A match of nobody against nobody that has not begun.
    fn default() -> MatchAnnouncement {
        MatchAnnouncement {
            version: Version::default(),
            packet_number: 0,
            view: BoxView::default(),
            team_numbers: [1, 2],
            players_per_team: 0,
            goalkeepers: [None, None],
            message_budgets: [0, 0],
        }
    }
}

impl MatchAnnouncement {
    /// The packet that says this. Of players that do not exist it says nothing, and more than 255 goals are told as 255.
    pub fn packet(&self) -> ControlPacket {
        let view = &self.view;
        let left = view.left.min(1);
        ControlPacket {
            version: self.version,
            packet_number: self.packet_number,
            players_per_team: self.players_per_team,
            competition_phase: CompetitionPhase::RoundRobin,
            competition_type: CompetitionType::Small,
            stopped: Flag::from(view.stopped),
            game_phase: view.game_phase,
            state: view.state,
            set_play: view.set_play,
            first_half: Flag::from(view.first_half),
            kicking_team: view.kicking.and_then(|side| self.team_numbers.get(side).copied()),
            secs_remaining: view.seconds_left,
            secondary_time: view.secondary_time,
            teams: [left, 1 - left].map(|side| self.team(side)),
        }
    }

    fn team(&self, side: usize) -> TeamInfo {
        let player = |penalty, secs_till_unpenalised| PlayerInfo {
            penalty,
            secs_till_unpenalised,
            warnings: 0,
            cautions: 0,
        };
        let mut players = [player(Penalty::Substitute, 0); PLAYER_SLOTS];
        let exist = &mut players[..PLAYER_SLOTS.min(usize::from(self.players_per_team))];
        exist.fill(player(Penalty::None, 0));
        for penalised in &self.view.penalties[side] {
            if let Some(slot) = exist.get_mut(usize::from(penalised.player)) {
                *slot = player(penalised.penalty, penalised.seconds_left);
            }
        }
        TeamInfo {
            team_number: self.team_numbers[side],
            field_player_colour: COLOURS[side],
            goalkeeper_colour: COLOURS[side],
            goalkeeper: self.goalkeepers[side].map_or(0, |player| player.saturating_add(1)),
            score: u8::try_from(self.view.score[side]).unwrap_or(u8::MAX),
            penalty_shot: 0,
            single_shots: 0,
            message_budget: u16::try_from(self.message_budgets[side]).unwrap_or(u16::MAX),
            players,
        }
    }
}

/// Seconds as a referee box tells them: rounded up, so that a clock shows 0 when it has run out, and the nearest number that
/// the packet can hold; what is no number is 0.
pub fn whole_seconds(seconds: f64) -> i16 {
    seconds.ceil() as i16
}

/// As [`whole_seconds`], for the end of a penalty; an end that nobody knows is 0, as boxes tell it before they count the time.
pub fn penalty_seconds(seconds: f64) -> u8 {
    if seconds.is_finite() { seconds.ceil() as u8 } else { 0 }
}

#[cfg(test)]
mod tests {
    use std::net::{IpAddr, Ipv4Addr, SocketAddr};

    use proptest::prelude::*;

    use super::super::control::{GamePhase, State};
    use super::super::referee_box::{Penalised, RefereeBox};
    use super::*;

    const BOX: SocketAddr = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 4000);
    const PUSHED: Penalised = Penalised { player: 3, penalty: Penalty::Pushing, seconds_left: 30 };

    fn view() -> BoxView {
        BoxView {
            state: State::Playing,
            first_half: false,
            kicking: Some(1),
            seconds_left: 60,
            score: [2, 1],
            penalties: [vec![], vec![PUSHED]],
            ..BoxView::default()
        }
    }

    fn announcement(view: BoxView) -> MatchAnnouncement {
        let (team_numbers, players_per_team) = ([70, 71], 4);
        MatchAnnouncement {
            packet_number: 200,
            view,
            team_numbers,
            players_per_team,
            ..MatchAnnouncement::default()
        }
    }

    #[test]
    fn the_team_that_defends_the_left_goal_is_listed_first() {
        for (left, numbers) in [(0, [70, 71]), (1, [71, 70])] {
            let packet = announcement(BoxView { left, ..view() }).packet();
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
            let told = MatchAnnouncement { version, goalkeepers, message_budgets, ..announcement(view()) };
            let bytes = told.packet().write();
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
    fn a_referee_box_that_announces_our_match_is_followed_as_one() {
        let mut referee = RefereeBox::new(Some([70, 71]), [4; 2]);
        assert_eq!(referee.hear(BOX, &announcement(view()).packet().write(), 0), Ok(Some(view())));
    }

    #[test]
    fn slots_without_a_player_are_substitutes() {
        let [home, away] = announcement(view()).packet().teams;
        for team in [home, away] {
            let substitutes = team.players.iter().filter(|player| player.penalty == Penalty::Substitute);
            assert_eq!((substitutes.count(), team.players[4].penalty), (16, Penalty::Substitute));
        }
    }

    #[test]
    fn what_the_packet_cannot_hold_is_told_as_the_nearest() {
        assert_eq!([-1e9, 59.2, 1e9, f64::NAN].map(whole_seconds), [i16::MIN, 60, i16::MAX, 0]);
        assert_eq!([-1.0, 29.5, 1e9, f64::INFINITY].map(penalty_seconds), [0, 30, 255, 0]);
        let nobody = |player| Penalised { player, ..PUSHED };
        let penalties = [vec![nobody(4), nobody(255), nobody(0)], vec![]];
        let view = BoxView { score: [1000, 255], kicking: Some(2), penalties, ..view() };
        let packet = announcement(view).packet();
        assert_eq!(packet.teams.each_ref().map(|team| team.score), [255, 255]);
        assert_eq!(packet.kicking_team, None);
        let penalised = |player: &&PlayerInfo| player.penalty == Penalty::Pushing;
        assert_eq!(packet.teams.iter().flat_map(|team| &team.players).filter(penalised).count(), 1);
    }

    proptest! {
        #[test]
        fn an_announcement_reads_back_as_it_was_written(
            (packet_number, players_per_team, first_half, stopped) in any::<(u8, u8, bool, bool)>(),
            (seconds_left, kicking) in (any::<i16>(), prop::option::of(0usize..2)),
        ) {
            let game_phase = GamePhase::ExtraTime;
            let view = BoxView { first_half, stopped, seconds_left, kicking, game_phase, ..view() };
            let packet = MatchAnnouncement { packet_number, players_per_team, ..announcement(view) }.packet();
            prop_assert_eq!(ControlPacket::read(&packet.write()), Ok(packet));
        }
    }
}
