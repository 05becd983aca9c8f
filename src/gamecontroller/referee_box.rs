//! Following a referee box: from its packets to what they say about our match.
//!
//! A side is 0 for home and 1 for away throughout, the place in arrays of two.

use thiserror::Error;

use super::control::{ControlPacket, GamePhase, PacketError, Penalty, SetPlay, State};

/// After this many milliseconds without news the sender is taken to have begun anew, and any packet is news. Boxes send
/// every 500 ms.
pub const SILENCE_MS: u64 = 2_000;
/// Reasons that are remembered as told, so that a noisy network cannot fill a log.
const REASONS_TOLD: usize = 16;
/// A packet that is fewer numbers than this behind the newest is late; one that is more is taken to be ahead, as the
/// number wraps.
const HALF_CIRCLE: u8 = 128;

/// What a control packet says about our match.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct View {
    pub state: State,
    pub game_phase: GamePhase,
    pub set_play: SetPlay,
    pub stopped: bool,
    pub first_half: bool,
    /// The side that has the kick-off or the set play.
    pub kicking: Option<usize>,
    /// Goals by side.
    pub score: [u32; 2],
    /// Seconds left in the half; negative when it has run over.
    pub seconds_left: i16,
    /// Seconds on the second clock: what is left of `Ready`, of a set play, of a time-out.
    pub secondary_time: i16,
    /// By side, in the order of their numbers.
    pub penalties: [Vec<Penalised>; 2],
}

/// A player under a penalty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Penalised {
    /// Counted from 0.
    pub player: u8,
    /// Neither [`Penalty::None`] nor [`Penalty::Substitute`].
    pub penalty: Penalty,
    /// The box's estimate. A penalty may outlast it, as the referee ends it.
    pub seconds_left: u8,
}

/// Why a packet is not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Ignored {
    #[error("{}", PacketError::NotOurs)]
    NotOurs,
    #[error("{}", PacketError::Version(*.0))]
    Version(u8),
    #[error("{}", PacketError::Length { got: *.got, expected: *.expected })]
    Length { got: usize, expected: usize },
    /// The teams that it is about.
    #[error("a control packet about teams {} and {}, who do not play here", .0[0], .0[1])]
    Teams([u8; 2]),
    #[error("a control packet that was overtaken by a later one")]
    Stale,
}

/// The packets heard, by what became of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Heard {
    /// Gave a view.
    pub news: u64,
    /// The newest packet once more.
    pub repeated: u64,
    pub not_ours: u64,
    pub version: u64,
    pub length: u64,
    pub teams: u64,
    pub stale: u64,
}

/// Follows one referee box for one match.
#[derive(Clone, Debug)]
pub struct RefereeBox {
    team_numbers: Option<[u8; 2]>,
    players: u8,
    newest: Option<Newest>,
    heard: Heard,
    told: Vec<Ignored>,
}

/// The last packet that was news.
#[derive(Clone, Debug)]
struct Newest {
    number: u8,
    at: u64,
    bytes: Vec<u8>,
}

impl From<PacketError> for Ignored {
    fn from(error: PacketError) -> Ignored {
        match error {
            PacketError::NotOurs => Ignored::NotOurs,
            PacketError::Version(version) => Ignored::Version(version),
            PacketError::Length { got, expected } => Ignored::Length { got, expected },
        }
    }
}

impl RefereeBox {
    /// Follows the match of these teams, home and away, with this many players each. Without numbers it follows the
    /// match of the first good packet, whose first team is home.
    pub fn new(team_numbers: Option<[u8; 2]>, players: u8) -> RefereeBox {
        RefereeBox { team_numbers, players, newest: None, heard: Heard::default(), told: Vec::new() }
    }

    /// The numbers of home and away, once they are known.
    pub fn team_numbers(&self) -> Option<[u8; 2]> {
        self.team_numbers
    }

    /// The packets heard so far.
    pub fn heard(&self) -> Heard {
        self.heard
    }

    /// Takes a packet that arrived at `now`, in milliseconds on any clock that does not go back: what it says, or `None`
    /// if it is the newest packet once more, as when it came over two networks.
    ///
    /// A packet of the newest number with other content is news: its sender does not count.
    ///
    /// # Errors
    /// If the packet does not concern us, with the reason; nothing but the count of such packets changes.
    pub fn hear(&mut self, bytes: &[u8], now: u64) -> Result<Option<View>, Ignored> {
        let result = self.follow(bytes, now);
        let count = match &result {
            Ok(Some(_)) => &mut self.heard.news,
            Ok(None) => &mut self.heard.repeated,
            Err(Ignored::NotOurs) => &mut self.heard.not_ours,
            Err(Ignored::Version(_)) => &mut self.heard.version,
            Err(Ignored::Length { .. }) => &mut self.heard.length,
            Err(Ignored::Teams(_)) => &mut self.heard.teams,
            Err(Ignored::Stale) => &mut self.heard.stale,
        };
        *count += 1;
        result
    }

    /// Whether this reason was never asked about before; then it deserves a line in the log. After 16 reasons none does.
    pub fn first_time(&mut self, reason: &Ignored) -> bool {
        let new = self.told.len() < REASONS_TOLD && !self.told.contains(reason);
        if new {
            self.told.push(*reason);
        }
        new
    }

    fn follow(&mut self, bytes: &[u8], now: u64) -> Result<Option<View>, Ignored> {
        let packet = ControlPacket::read(bytes)?;
        let listed = [packet.teams[0].team_number, packet.teams[1].team_number];
        let ours = self.team_numbers.unwrap_or(listed);
        // The place in the packet of home and of away.
        let places = match ours {
            _ if ours == listed => [0, 1],
            [home, away] if [away, home] == listed => [1, 0],
            _ => return Err(Ignored::Teams(listed)),
        };
        if let Some(newest) = &self.newest
            && now.saturating_sub(newest.at) <= SILENCE_MS
        {
            let behind = newest.number.wrapping_sub(packet.packet_number);
            if behind == 0 && newest.bytes == bytes {
                return Ok(None);
            }
            if (1..HALF_CIRCLE).contains(&behind) {
                return Err(Ignored::Stale);
            }
        }
        self.team_numbers = Some(ours);
        self.newest = Some(Newest { number: packet.packet_number, at: now, bytes: bytes.to_vec() });
        Ok(Some(self.view(&packet, ours, places)))
    }

    fn view(&self, packet: &ControlPacket, ours: [u8; 2], places: [usize; 2]) -> View {
        let teams = places.map(|place| &packet.teams[place]);
        let penalties = teams.map(|team| {
            let players = (0..self.players).zip(&team.players);
            let penalised = players.map(|(player, info)| Penalised {
                player,
                penalty: info.penalty,
                seconds_left: info.secs_till_unpenalised,
            });
            penalised.filter(|p| !matches!(p.penalty, Penalty::None | Penalty::Substitute)).collect()
        });
        View {
            state: packet.state,
            game_phase: packet.game_phase,
            set_play: packet.set_play,
            stopped: packet.stopped.is_set(),
            first_half: packet.first_half.is_set(),
            kicking: ours.iter().position(|number| packet.kicking_team == Some(*number)),
            score: teams.map(|team| u32::from(team.score)),
            seconds_left: packet.secs_remaining,
            secondary_time: packet.secondary_time,
            penalties,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::control::tests::{
        HSL_INITIAL, HSL_LAST, SPL_INITIAL, SPL_LAST, V20_PENALTIES, packets,
    };
    use super::*;

    /// The last packet of the newer box with another number.
    fn numbered(number: u8) -> Vec<u8> {
        let packet = ControlPacket::read(HSL_LAST).unwrap();
        ControlPacket { packet_number: number, ..packet }.write()
    }

    fn after(numbers: &[u8]) -> RefereeBox {
        let mut referee = RefereeBox::new(Some([6, 9]), 7);
        for number in numbers {
            assert!(matches!(referee.hear(&numbered(*number), 1_000), Ok(Some(_))), "{number}");
        }
        referee
    }

    #[test]
    fn a_packet_tells_what_matters_to_the_match() {
        let pushed = Penalised { player: 1, penalty: Penalty::Pushing, seconds_left: 0 };
        let expected = View {
            state: State::Playing,
            game_phase: GamePhase::Normal,
            set_play: SetPlay::None,
            stopped: false,
            first_half: true,
            kicking: Some(1),
            score: [1, 0],
            seconds_left: 596,
            secondary_time: 8,
            penalties: [vec![], vec![pushed]],
        };
        assert_eq!(RefereeBox::new(Some([6, 9]), 4).hear(HSL_LAST, 0), Ok(Some(expected.clone())));
        let swapped = View { kicking: Some(0), score: [0, 1], penalties: [vec![pushed], vec![]], ..expected };
        assert_eq!(RefereeBox::new(Some([9, 6]), 4).hear(HSL_LAST, 0), Ok(Some(swapped)));
    }

    #[test]
    fn a_packet_of_version_20_is_followed() {
        let view = RefereeBox::new(None, 4).hear(V20_PENALTIES, 0).unwrap().unwrap();
        assert!(view.stopped && view.set_play == SetPlay::DirectFreeKick && view.kicking == Some(1));
        let penalties =
            view.penalties.each_ref().map(|side| side.iter().map(|p| p.penalty).collect::<Vec<_>>());
        let away = vec![Penalty::MotionInStop, Penalty::Cautioned, Penalty::SentOff];
        assert_eq!(penalties, [vec![Penalty::Pushing], away]);
    }

    #[test]
    fn players_who_do_not_play_here_are_not_penalised() {
        let view = RefereeBox::new(Some([6, 9]), 1).hear(HSL_LAST, 0).unwrap().unwrap();
        assert!(view.penalties.iter().all(Vec::is_empty));
        let view = RefereeBox::new(None, 20).hear(SPL_LAST, 0).unwrap().unwrap();
        assert_eq!((view.kicking, view.penalties.each_ref().map(Vec::len)), (None, [0, 1]));
    }

    #[test]
    fn without_numbers_the_first_match_is_followed() {
        let mut referee = RefereeBox::new(None, 7);
        assert_eq!(referee.hear(b"RGme\x15", 0), Err(Ignored::Version(21)));
        assert_eq!(referee.team_numbers(), None);
        assert!(referee.hear(SPL_INITIAL, 0).is_ok());
        assert_eq!(referee.team_numbers(), Some([5, 24]));
        assert_eq!(referee.hear(HSL_INITIAL, 0), Err(Ignored::Teams([6, 9])));
        assert!(matches!(referee.hear(SPL_LAST, 10), Ok(Some(_))));
    }

    #[test]
    fn the_newest_packet_once_more_is_no_news() {
        let mut referee = after(&[7]);
        assert_eq!(referee.hear(&numbered(7), 1_400), Ok(None));
        let goal = {
            let mut packet = ControlPacket::read(&numbered(7)).unwrap();
            packet.teams[1].score = 1;
            packet.write()
        };
        assert_eq!(referee.hear(&goal, 1_500).unwrap().unwrap().score, [1, 1]);
        assert_eq!((referee.heard().news, referee.heard().repeated), (2, 1));
    }

    #[test]
    fn a_packet_from_before_is_stale_until_the_box_was_silent() {
        let mut referee = after(&[250, 255, 3]);
        for late in [2, 255, 132] {
            assert_eq!(referee.hear(&numbered(late), 3_000), Err(Ignored::Stale), "{late}");
        }
        // Stale packets do not break the silence.
        assert!(matches!(referee.hear(&numbered(2), 3_001), Ok(Some(_))));
        assert!(matches!(after(&[3]).hear(&numbered(131), 1_000), Ok(Some(_))));
        assert_eq!(referee.heard(), Heard { news: 4, stale: 3, ..Heard::default() });
    }

    #[test]
    fn a_reason_is_told_once_and_their_number_is_bounded() {
        let mut referee = RefereeBox::new(None, 4);
        assert!(referee.first_time(&Ignored::Version(12)) && referee.first_time(&Ignored::Version(20)));
        assert!(!referee.first_time(&Ignored::Version(12)));
        let lengths = (0..1_000).map(|got| Ignored::Length { got, expected: 118 });
        assert_eq!(lengths.filter(|reason| referee.first_time(reason)).count(), REASONS_TOLD - 2);
    }

    #[test]
    fn a_reason_says_what_was_heard() {
        let length = Ignored::Length { got: 100, expected: 118 }.to_string();
        assert!(length.contains("100") && length.contains("118"));
        assert!(Ignored::Teams([3, 14]).to_string().contains("teams 3 and 14"));
    }

    proptest! {
        #[test]
        fn of_two_packets_that_are_not_opposite_exactly_one_is_stale(a: u8, apart in 1u8..128) {
            let b = a.wrapping_add(apart);
            prop_assert!(after(&[a]).hear(&numbered(b), 1_000).is_ok());
            prop_assert_eq!(after(&[b]).hear(&numbered(a), 1_000), Err(Ignored::Stale));
        }

        #[test]
        fn any_packet_gives_a_view_of_players_who_play(bytes in packets(), players: u8) {
            let view = RefereeBox::new(None, players).hear(&bytes, 0).unwrap().unwrap();
            for penalised in view.penalties.iter().flatten() {
                prop_assert!(penalised.player < players.min(20));
                prop_assert!(!matches!(penalised.penalty, Penalty::None | Penalty::Substitute));
            }
        }
    }
}
