//! Telling others about our own match as a referee box would, so that programs that show matches show ours.

use super::control::{
    Colour, CompetitionPhase, CompetitionType, ControlPacket, Flag, GamePhase, PLAYER_SLOTS, Penalty,
    PlayerInfo, SetPlay, State, TeamInfo, Version,
};

/// What home and away wear, in the window and here.
const COLOURS: [Colour; 2] = [Colour::Red, Colour::Blue];

/// Where our match stands. A side is 0 for home and 1 for away.
///
/// Seconds are told as a referee box tells them: rounded up, so that a clock shows 0 when it has run out, and kept within
/// what the packet can hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// One more than in the last packet; wraps.
    pub packet_number: u8,
    pub state: State,
    pub set_play: SetPlay,
    pub stopped: bool,
    pub first_half: bool,
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
    pub penalties: Vec<Sentence>,
}

/// A player of ours under a penalty. One that does not exist is left out of the packet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sentence {
    pub side: usize,
    /// Counted from 0.
    pub player: u8,
    pub penalty: Penalty,
    pub seconds_left: f64,
}

impl Standing {
    /// The packet of version 19 that says this. Home comes first. Nobody is named as goalkeeper, since robots change
    /// roles, and the budget of messages is 0, since it is not counted.
    pub fn packet(&self) -> ControlPacket {
        ControlPacket {
            version: Version::V19,
            packet_number: self.packet_number,
            players_per_team: self.players_per_team,
            competition_phase: CompetitionPhase::RoundRobin,
            competition_type: CompetitionType::Small,
            stopped: Flag::from(self.stopped),
            game_phase: GamePhase::Normal,
            state: self.state,
            set_play: self.set_play,
            first_half: Flag::from(self.first_half),
            kicking_team: self.kicking.and_then(|side| self.team_numbers.get(side).copied()),
            secs_remaining: whole_seconds(self.seconds_left),
            secondary_time: whole_seconds(self.secondary_time),
            teams: [0, 1].map(|side| self.team(side)),
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
                slot.secs_till_unpenalised = sentence.seconds_left.ceil() as u8;
            }
        }
        TeamInfo {
            team_number: self.team_numbers[side],
            field_player_colour: COLOURS[side],
            goalkeeper_colour: COLOURS[side],
            goalkeeper: 0,
            score: u8::try_from(self.score[side]).unwrap_or(u8::MAX),
            penalty_shot: 0,
            single_shots: 0,
            message_budget: 0,
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
    use proptest::prelude::*;

    use super::super::referee_box::{Penalised, RefereeBox, View};
    use super::*;

    fn standing() -> Standing {
        Standing {
            packet_number: 200,
            state: State::Playing,
            set_play: SetPlay::None,
            stopped: false,
            first_half: false,
            kicking: Some(1),
            seconds_left: 59.2,
            secondary_time: 0.0,
            score: [2, 1],
            team_numbers: [70, 71],
            players_per_team: 4,
            penalties: vec![Sentence { side: 1, player: 3, penalty: Penalty::Pushing, seconds_left: 29.5 }],
        }
    }

    #[test]
    fn a_referee_box_that_announces_our_match_is_followed_as_one() {
        let mut referee = RefereeBox::new(Some([70, 71]), 4);
        let penalised = Penalised { player: 3, penalty: Penalty::Pushing, seconds_left: 30 };
        let expected = View {
            state: State::Playing,
            game_phase: GamePhase::Normal,
            set_play: SetPlay::None,
            stopped: false,
            first_half: false,
            kicking: Some(1),
            score: [2, 1],
            seconds_left: 60,
            secondary_time: 0,
            penalties: [vec![], vec![penalised]],
        };
        assert_eq!(referee.hear(&standing().packet().write(), 0), Ok(Some(expected)));
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
