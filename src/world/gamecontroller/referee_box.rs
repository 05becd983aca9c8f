//! Following a referee box: which of the packets that arrive are about our match, and what they say.
//!
//! One box is followed until it falls silent; other boxes are ignored meanwhile. A side is 0 for home
//! and 1 for away throughout, the place in arrays of two.

use std::mem::discriminant;
use std::net::SocketAddr;

use thiserror::Error;

use super::control::{ControlPacket, PacketError, Version};
pub use super::view::{BoxView, GONE_AFTER, NotObeyed, Penalised};

/// After this many milliseconds without news the box is lost: any other one is followed, and a packet of any number is
/// news. Boxes send every 500 ms.
pub const SILENCE_MS: u64 = 2_000;
/// A packet that is fewer numbers than this behind the newest is late; one that is more is taken to be ahead, as the
/// number wraps.
const HALF_CIRCLE: u8 = 128;

/// Why a packet is not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Ignored {
    /// It does not begin as control packets do.
    #[error("{}", PacketError::NotOurs)]
    NotOurs,
    /// Its version is unknown.
    #[error("{}", PacketError::Version(*.0))]
    Version(u8),
    /// It has another length than its version has.
    #[error("{}", PacketError::Length { got: *.got, expected: *.expected })]
    Length { got: usize, expected: usize },
    /// The teams that it is about.
    #[error("a control packet about teams {} and {}, who do not play here", .0[0], .0[1])]
    Teams([u8; 2]),
    /// The box that is followed instead.
    #[error("a control packet of another box than the one at {0}")]
    Sender(SocketAddr),
    /// It is older than the one before.
    #[error("a control packet that was overtaken by a later one")]
    Stale,
}

/// Counts of the packets heard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PacketCounts {
    /// Gave a view.
    pub news: u64,
    /// The newest packet once more.
    pub repeated: u64,
    /// Packets that do not begin as control packets do.
    pub not_ours: u64,
    /// Packets of an unknown version.
    pub version: u64,
    /// Packets of another length than their version has.
    pub length: u64,
    /// Packets of other teams.
    pub teams: u64,
    /// Packets of other boxes.
    pub sender: u64,
    /// Packets that are older than the one before.
    pub stale: u64,
}

impl PacketCounts {
    /// The packets that were not followed: for each reason a word and their number.
    pub fn ignored(&self) -> [(&'static str, u64); 6] {
        [
            ("of something else", self.not_ours),
            ("of another version", self.version),
            ("of a wrong length", self.length),
            ("about other teams", self.teams),
            ("of another box", self.sender),
            ("overtaken", self.stale),
        ]
    }
}

/// Follows one referee box for one match.
#[derive(Clone, Debug)]
pub struct RefereeBox {
    team_numbers: Option<[u8; 2]>,
    players: [u8; 2],
    newest: Option<Newest>,
    heard: PacketCounts,
    /// The first packet that was ignored for each reason.
    ignored: Vec<(SocketAddr, Ignored)>,
}

/// The last packet that was news.
#[derive(Clone, Debug)]
struct Newest {
    from: SocketAddr,
    version: Version,
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
    /// Follows the match of these teams, home and away, with so many players each. Without numbers it follows the match of
    /// the first good packet. Home is then taken to be the team that defends the left goal in the first half: the first
    /// one listed there, and the second one in a packet of a second half.
    pub fn new(team_numbers: Option<[u8; 2]>, players: [u8; 2]) -> RefereeBox {
        RefereeBox {
            team_numbers,
            players,
            newest: None,
            heard: PacketCounts::default(),
            ignored: Vec::new(),
        }
    }

    /// The numbers of home and away, once they are known.
    pub fn team_numbers(&self) -> Option<[u8; 2]> {
        self.team_numbers
    }

    /// The box that was followed last, and the version that it speaks.
    pub fn followed(&self) -> Option<(SocketAddr, Version)> {
        self.newest.as_ref().map(|newest| (newest.from, newest.version))
    }

    /// Whether no box has been followed for [`SILENCE_MS`].
    pub fn is_silent(&self, now: u64) -> bool {
        self.newest.as_ref().is_none_or(|newest| now.saturating_sub(newest.at) > SILENCE_MS)
    }

    /// The packets heard so far.
    pub fn heard(&self) -> PacketCounts {
        self.heard
    }

    /// Takes a packet that arrived at `now`, in milliseconds on any clock that does not go back: what it says, or `None`
    /// if it is the newest packet once more, as when it came over two networks.
    ///
    /// # Errors
    /// If the packet does not concern us, with the reason; nothing but what is known of such packets changes.
    pub fn hear(&mut self, from: SocketAddr, bytes: &[u8], now: u64) -> Result<Option<BoxView>, Ignored> {
        let result = self.follow(from, bytes, now);
        let count = match &result {
            Ok(Some(_)) => &mut self.heard.news,
            Ok(None) => &mut self.heard.repeated,
            Err(Ignored::NotOurs) => &mut self.heard.not_ours,
            Err(Ignored::Version(_)) => &mut self.heard.version,
            Err(Ignored::Length { .. }) => &mut self.heard.length,
            Err(Ignored::Teams(_)) => &mut self.heard.teams,
            Err(Ignored::Sender(_)) => &mut self.heard.sender,
            Err(Ignored::Stale) => &mut self.heard.stale,
        };
        *count += 1;
        if let Err(reason) = &result
            && self.ignored.iter().all(|(_, known)| discriminant(known) != discriminant(reason))
        {
            self.ignored.push((from, *reason));
        }
        result
    }

    /// The first packet that was ignored for each reason, by its sender; they deserve a line in the log.
    pub fn ignored(&self) -> &[(SocketAddr, Ignored)] {
        &self.ignored
    }

    fn follow(&mut self, from: SocketAddr, bytes: &[u8], now: u64) -> Result<Option<BoxView>, Ignored> {
        let packet = ControlPacket::read(bytes)?;
        let [first, second] = packet.teams.each_ref().map(|team| team.team_number);
        let at_start = if packet.first_half.is_set() { [first, second] } else { [second, first] };
        let ours = self.team_numbers.unwrap_or(at_start);
        // The place in the packet of home and of away.
        let places = match ours {
            _ if ours == [first, second] => [0, 1],
            _ if ours == [second, first] => [1, 0],
            _ => return Err(Ignored::Teams([first, second])),
        };
        if let Some(newest) = self.newest.as_ref().filter(|_| !self.is_silent(now)) {
            let behind = newest.number.wrapping_sub(packet.packet_number);
            if behind == 0 && newest.bytes == bytes {
                return Ok(None);
            }
            if newest.from != from {
                return Err(Ignored::Sender(newest.from));
            }
            if (1..HALF_CIRCLE).contains(&behind) {
                return Err(Ignored::Stale);
            }
        }
        self.team_numbers = Some(ours);
        let (version, number) = (packet.version, packet.packet_number);
        self.newest = Some(Newest { from, version, number, at: now, bytes: bytes.to_vec() });
        Ok(Some(BoxView::of(&packet, places, self.players)))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use std::net::{IpAddr, Ipv4Addr};

    use super::super::control::tests::{
        HSL_INITIAL, HSL_LAST, SPL_INITIAL, SPL_LAST, V20_PENALTIES, packets,
    };
    use super::super::control::{GamePhase, Penalty, SetPlay, State};
    use super::*;

    /// Two boxes.
    const ONE: SocketAddr = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 4000);
    const OTHER: SocketAddr = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 4001);

    /// The last packet of the newer box with another number.
    fn numbered(number: u8) -> Vec<u8> {
        let packet = ControlPacket::read(HSL_LAST).unwrap();
        ControlPacket { packet_number: number, ..packet }.write()
    }

    fn after(numbers: &[u8]) -> RefereeBox {
        let mut referee = RefereeBox::new(Some([6, 9]), [7; 2]);
        for number in numbers {
            assert!(matches!(referee.hear(ONE, &numbered(*number), 1_000), Ok(Some(_))), "{number}");
        }
        referee
    }

    #[test]
    fn a_packet_tells_what_matters_to_the_match() {
        let pushed = Penalised { player: 1, penalty: Penalty::Pushing, seconds_left: 0 };
        let expected = BoxView {
            state: State::Playing,
            game_phase: GamePhase::Normal,
            set_play: SetPlay::None,
            stopped: false,
            first_half: true,
            kicking: Some(1),
            score: [1, 0],
            seconds_left: 596,
            secondary_time: 8,
            left: 0,
            penalties: [vec![], vec![pushed]],
            missing: [vec![4, 5, 6], vec![4, 5, 6]],
        };
        assert_eq!(RefereeBox::new(Some([6, 9]), [4; 2]).hear(ONE, HSL_LAST, 0), Ok(Some(expected.clone())));
        let swapped = BoxView {
            left: 1,
            kicking: Some(0),
            score: [0, 1],
            penalties: [vec![pushed], vec![]],
            ..expected
        };
        assert_eq!(RefereeBox::new(Some([9, 6]), [4; 2]).hear(ONE, HSL_LAST, 0), Ok(Some(swapped)));
    }

    #[test]
    fn a_packet_of_version_20_is_followed() {
        let view = RefereeBox::new(None, [4; 2]).hear(ONE, V20_PENALTIES, 0).unwrap().unwrap();
        assert!(view.stopped && view.set_play == SetPlay::DirectFreeKick && view.kicking == Some(1));
        let penalties =
            view.penalties.each_ref().map(|side| side.iter().map(|p| p.penalty).collect::<Vec<_>>());
        let away = vec![Penalty::MotionInStop, Penalty::Cautioned, Penalty::SentOff, Penalty::Substitute];
        assert_eq!(penalties, [vec![Penalty::Pushing], away]);
    }

    #[test]
    fn players_who_do_not_play_here_are_not_penalised() {
        let view = RefereeBox::new(Some([6, 9]), [1; 2]).hear(ONE, HSL_LAST, 0).unwrap().unwrap();
        assert!(view.penalties.iter().all(Vec::is_empty));
        let view = RefereeBox::new(None, [7; 2]).hear(ONE, SPL_LAST, 0).unwrap().unwrap();
        assert_eq!((view.kicking, view.penalties.each_ref().map(Vec::len)), (None, [0, 1]));
    }

    #[test]
    fn without_numbers_the_first_match_is_followed() {
        let mut referee = RefereeBox::new(None, [7; 2]);
        assert_eq!(referee.hear(ONE, b"RGme\x15", 0), Err(Ignored::Version(21)));
        assert_eq!(referee.team_numbers(), None);
        assert!(referee.hear(ONE, SPL_INITIAL, 0).is_ok());
        assert_eq!(referee.team_numbers(), Some([5, 24]));
        assert_eq!(referee.hear(ONE, HSL_INITIAL, 0), Err(Ignored::Teams([6, 9])));
        assert!(matches!(referee.hear(ONE, SPL_LAST, 10), Ok(Some(_))));
    }

    #[test]
    fn the_newest_packet_once_more_is_no_news() {
        let mut referee = after(&[7]);
        assert_eq!(referee.hear(ONE, &numbered(7), 1_400), Ok(None));
        let goal = {
            let mut packet = ControlPacket::read(&numbered(7)).unwrap();
            packet.teams[1].score = 1;
            packet.write()
        };
        assert_eq!(referee.hear(ONE, &goal, 1_500).unwrap().unwrap().score, [1, 1]);
        assert_eq!((referee.heard().news, referee.heard().repeated), (2, 1));
    }

    #[test]
    fn a_packet_from_before_is_stale_until_the_box_was_silent() {
        let mut referee = after(&[250, 255, 3]);
        for late in [2, 255, 132] {
            assert_eq!(referee.hear(ONE, &numbered(late), 3_000), Err(Ignored::Stale), "{late}");
        }
        // Stale packets do not break the silence.
        assert!(matches!(referee.hear(ONE, &numbered(2), 3_001), Ok(Some(_))));
        assert!(matches!(after(&[3]).hear(ONE, &numbered(131), 1_000), Ok(Some(_))));
        assert_eq!(referee.heard(), PacketCounts { news: 4, stale: 3, ..PacketCounts::default() });
    }

    #[test]
    fn the_first_packet_of_each_reason_is_remembered_however_many_lengths_there_are() {
        let mut referee = after(&[7]);
        for length in 5..100 {
            assert!(referee.hear(OTHER, &HSL_LAST[..length], 1_000).is_err());
        }
        for bytes in [&b"RGme\x0c"[..], b"RGme\x15", b"hello", &numbered(8), &numbered(6)] {
            let from = if bytes == numbered(6) { ONE } else { OTHER };
            assert!(referee.hear(from, bytes, 1_000).is_err());
        }
        let length = Ignored::Length { got: 5, expected: 198 };
        let first = [
            (OTHER, length),
            (OTHER, Ignored::Version(12)),
            (OTHER, Ignored::NotOurs),
            (OTHER, Ignored::Sender(ONE)),
            (ONE, Ignored::Stale),
        ];
        assert_eq!(referee.ignored(), first);
    }

    #[test]
    fn another_box_is_ignored_while_the_followed_one_lives() {
        let mut referee = after(&[7]);
        for number in [8, 7, 200] {
            let mut packet = ControlPacket::read(&numbered(number)).unwrap();
            packet.secs_remaining = 1;
            let heard = referee.hear(OTHER, &packet.write(), 3_000);
            assert_eq!(heard, Err(Ignored::Sender(ONE)), "{number}");
        }
        assert_eq!(
            referee.hear(OTHER, &numbered(7), 3_000),
            Ok(None),
            "the same packet over another network"
        );
        assert!(matches!(referee.hear(ONE, &numbered(8), 3_000), Ok(Some(_))));
        assert_eq!((referee.followed(), referee.is_silent(5_000)), (Some((ONE, Version::V19)), false));
        assert!(matches!(referee.hear(OTHER, &numbered(3), 5_001), Ok(Some(_))), "the first one is silent");
        assert_eq!(referee.hear(ONE, &numbered(9), 5_002), Err(Ignored::Sender(OTHER)));
        assert_eq!(referee.heard().sender, 4);
    }

    #[test]
    fn home_is_the_same_team_whenever_the_match_is_joined_and_ends_are_the_packets() {
        let mut packet = ControlPacket::read(HSL_LAST).unwrap();
        let first = RefereeBox::new(None, [4; 2]).hear(ONE, &packet.write(), 0).unwrap().unwrap();
        packet.teams.swap(0, 1);
        packet.first_half = false.into();
        let mut referee = RefereeBox::new(None, [4; 2]);
        let second = referee.hear(ONE, &packet.write(), 0).unwrap().unwrap();
        assert_eq!((referee.team_numbers(), second.score), (Some([6, 9]), first.score));
        assert_eq!((first.left, second.left), (0, 1));
        let mut known = RefereeBox::new(Some([9, 6]), [4; 2]);
        assert_eq!(known.hear(ONE, &packet.write(), 0).unwrap().unwrap().left, 0);
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
            prop_assert!(after(&[a]).hear(ONE, &numbered(b), 1_000).is_ok());
            prop_assert_eq!(after(&[b]).hear(ONE, &numbered(a), 1_000), Err(Ignored::Stale));
        }

        #[test]
        fn any_packet_gives_a_view_of_players_who_play(bytes in packets(), players: u8) {
            let view = RefereeBox::new(None, [players; 2]).hear(ONE, &bytes, 0).unwrap().unwrap();
            for penalised in view.penalties.iter().flatten() {
                prop_assert!(penalised.player < players.min(20));
                prop_assert!(penalised.penalty != Penalty::None);
            }
        }
    }
}
