//! What must hold for any bytes that come from the network as packets of a referee box or of a robot.

use std::mem::discriminant;
use std::net::{Ipv4Addr, SocketAddr};

use touchline::world::gamecontroller::control::{ControlPacket, PacketError, Penalty, Version};
use touchline::world::gamecontroller::referee_box::RefereeBox;
use touchline::world::gamecontroller::status::{STATUS_LEN, StatusPacket};

/// A control packet is written as it was read, and what is refused does not begin as one of its length.
pub fn control(data: &[u8]) {
    let version = data.get(4).and_then(|number| Version::from_number(*number));
    let good = data.starts_with(b"RGme") && version.is_some_and(|version| version.packet_len() == data.len());
    match ControlPacket::read(data) {
        Ok(packet) => {
            assert!(good);
            assert_eq!(packet.write(), data);
            for version in Version::ALL {
                let written = ControlPacket { version, ..packet.clone() }.write();
                assert_eq!(written.len(), version.packet_len());
                assert_eq!(ControlPacket::read(&written).map(|packet| packet.write()), Ok(written));
            }
        }
        Err(error) => {
            assert!(!good);
            assert_eq!(error == PacketError::NotOurs, data.len() < 5 || !data.starts_with(b"RGme"));
        }
    }
}

/// A status packet that was read reads back as the same, but for the rounding of lengths and numbers that are none.
pub fn status(data: &[u8]) {
    let good = data.starts_with(b"RGrt\x04") && data.len() == STATUS_LEN;
    let read = StatusPacket::read(data);
    assert_eq!(read.is_ok(), good);
    let Ok(packet) = read else { return };
    let written = packet.write();
    assert_eq!(written.len(), STATUS_LEN);
    assert_eq!(written[..7], data[..7]);
    let again = StatusPacket::read(&written).expect("what was written reads");
    let (player, team) = (packet.player_number, packet.team_number);
    assert_eq!((again.player_number, again.team_number, again.fallen), (player, team, packet.fallen));
    let (was, is) = (packet.ball, again.ball);
    assert_eq!(was.is_some(), is.is_some());
    assert!(was.is_none_or(|ball| ball.age >= 0.0));
    let ball = was.zip(is).map(|(was, is)| [(was.age, is.age), (was.x, is.x), (was.y, is.y)]);
    let pose = [(packet.x, again.x), (packet.y, again.y), (packet.theta, again.theta)];
    for (was, is) in pose.into_iter().chain(ball.into_iter().flatten()) {
        let same = was == is || was.is_nan() && is.is_nan();
        assert!(same || (was - is).abs() <= was.abs() * 1e-6 + 1e-40, "{was} became {is}");
    }
}

/// A referee box that hears any packets in any order counts each once, believes only good ones and says of them what it
/// would say had it heard nothing else.
///
/// The data are the number of players, whether the teams are known, and packets: the time since the last in sixteenths of
/// a second, how the packet is made and who of four sends it, its length, its bytes. In two of eight ways it is the last packet with a byte changed.
pub fn referee_box(data: &[u8]) {
    let [players, known, rest @ ..] = data else { return };
    let teams = (known % 2 == 1).then_some([6, 9]);
    let mut referee = RefereeBox::new(teams, [*players; 2]);
    let (mut rest, mut now, mut packet, mut heard) = (rest, 0u64, Vec::new(), 0);
    while let [wait, how, length, tail @ ..] = rest {
        let (bytes, tail) = tail.split_at(usize::from(*length).min(tail.len()));
        (rest, now) = (tail, now + u64::from(*wait) * 1000 / 16);
        match (how % 8, bytes) {
            (0, _) => packet = bytes.to_vec(),
            (1 | 5, _) => packet = begun(Version::V18, bytes),
            (2 | 6, _) => packet = begun(Version::V19, bytes),
            (4, _) => packet = begun(Version::V20, bytes),
            (_, [place, value, ..]) if usize::from(*place) < packet.len() => {
                packet[usize::from(*place)] = *value
            }
            _ => {}
        }
        heard += 1;
        let from = SocketAddr::from((Ipv4Addr::LOCALHOST, u16::from(how / 64)));
        hear(&mut referee, (from, &packet), now, *players);
        let count = referee.heard();
        let refused = [count.not_ours, count.version, count.length, count.teams, count.sender, count.stale];
        assert_eq!(count.news + count.repeated + refused.iter().sum::<u64>(), 2 * heard);
    }
}

/// A packet of this version with these bytes after its beginning, and zeros where they do not reach.
fn begun(version: Version, bytes: &[u8]) -> Vec<u8> {
    let mut packet = [b"RGme", &[version as u8][..], bytes].concat();
    packet.resize(version.packet_len(), 0);
    packet
}

/// Hears a packet twice.
fn hear(referee: &mut RefereeBox, (from, packet): (SocketAddr, &[u8]), now: u64, players: u8) {
    let teams = referee.team_numbers();
    let first = referee.hear(from, packet, now);
    match &first {
        Ok(Some(view)) => {
            assert!(referee.team_numbers().is_some() && (teams.is_none() || teams == referee.team_numbers()));
            let alone = RefereeBox::new(referee.team_numbers(), [players; 2]).hear(from, packet, 0);
            assert_eq!(alone.as_ref(), Ok(&Some(view.clone())));
            for penalised in view.penalties.iter().flatten() {
                assert!(penalised.player < players.min(20));
                assert!(penalised.penalty != Penalty::None);
            }
            assert!(view.missing.iter().flatten().all(|player| (players..20).contains(player)));
            assert!(view.kicking.is_none_or(|side| side < 2) && view.left < 2);
            assert!(referee.followed().is_some_and(|(box_at, _)| box_at == from) && !referee.is_silent(now));
        }
        Ok(None) => assert!(teams.is_some()),
        Err(reason) => {
            assert_eq!(referee.team_numbers(), teams);
            let kind = discriminant(reason);
            let known = referee.ignored().iter().filter(|(_, reason)| discriminant(reason) == kind);
            assert!(known.count() == 1 && !reason.to_string().is_empty());
        }
    }
    let again = referee.hear(from, packet, now);
    assert_eq!(again, first.map(|_| None));
}
