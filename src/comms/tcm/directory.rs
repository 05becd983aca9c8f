//! The directory (TeamChaos, section 3): the table of peers and their socket addresses, which the paper keeps in `TCM.ini`
//! and Touchline in a RON file, `{"home 0": "127.0.0.1:7400", "computer 0": "127.0.0.1:7499"}`.

use std::fmt;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::external_message::{HOST, Peer};

/// The socket address of every robot and computer that can be spoken to, in the order of the peers.
///
/// A directory from a file may say anything: ask [`Directory::fault`] before using it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Directory {
    entries: Vec<(Peer, SocketAddr)>,
}

/// There are not enough ports after the first for a directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{peers} peers do not find ports from {base_port} on")]
pub struct OutOfPorts {
    /// The first port.
    pub base_port: u16,
    /// Peers at most.
    pub peers: usize,
}

impl Directory {
    /// How many ports after the first that of computer 0 is in [`Directory::loopback`], unless robots have it.
    pub const COMPUTER: u16 = 99;

    /// Everybody on this machine: the robots of all teams, each team of so many players, at `base_port` and the ports after
    /// it, then computer 0 at the port [`Directory::COMPUTER`] after the first or, if robots have that, after theirs.
    ///
    /// # Errors
    /// If the ports do not reach, or the first is 0.
    pub fn loopback(base_port: u16, teams: &[u8]) -> Result<Directory, OutOfPorts> {
        let robots = (0u8..)
            .zip(teams)
            .flat_map(|(team, &players)| (0..players).map(move |number| Peer::Robot { team, number }));
        let robots: Vec<Peer> = robots.collect();
        let out_of_ports = OutOfPorts { base_port, peers: robots.len() + 1 };
        let computer = robots.len().max(usize::from(Directory::COMPUTER));
        let places = robots.into_iter().enumerate().chain([(computer, Peer::Computer(0))]);
        let entry = |(place, peer)| {
            let port = u16::try_from(place).ok()?.checked_add(base_port).filter(|_| base_port > 0)?;
            Some((peer, SocketAddr::from((Ipv4Addr::LOCALHOST, port))))
        };
        places.map(entry).collect::<Option<Directory>>().ok_or(out_of_ports)
    }

    /// All entries, in the order of the peers.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = (Peer, SocketAddr)> {
        self.entries.iter().copied()
    }

    /// Where a peer is; `None` if it is not in the table, and for groups.
    pub fn address_of(&self, peer: Peer) -> Option<SocketAddr> {
        self.entries().find(|&(there, _)| there == peer).map(|(_, address)| address)
    }

    /// Puts a peer at an address, in place of the one before.
    pub fn put(&mut self, peer: Peer, address: SocketAddr) {
        self.entries.retain(|&(there, _)| there != peer);
        self.entries.push((peer, address));
        self.entries.sort_by_key(|&(peer, _)| peer);
    }

    /// The peer at an address. An IPv4 address that is written as an IPv6 address is the same.
    pub fn peer_at(&self, address: SocketAddr) -> Option<Peer> {
        self.entries().find(|&(_, there)| is_same(there, address)).map(|(peer, _)| peer)
    }

    /// The receivers of a message from `source` for `destination`, in the order of the peers: one for a robot or computer, several for
    /// a group, never the sender. What is for a team also goes to every computer but the match itself, so that tools can
    /// follow.
    pub fn receivers(&self, destination: Peer, source: Peer) -> impl Iterator<Item = Peer> {
        let follows = matches!(destination, Peer::Team(_));
        let hears = move |peer: Peer| {
            destination.includes(peer) || (follows && matches!(peer, Peer::Computer(_)) && peer != HOST)
        };
        self.entries().map(|(peer, _)| peer).filter(move |peer| *peer != source && hears(*peer))
    }

    /// What is wrong with the table, as the peer's name and a reason.
    pub fn fault(&self) -> Option<(String, String)> {
        self.entries().enumerate().find_map(|(place, (peer, address))| {
            let mut before = self.entries().take(place);
            let reason = if !peer.is_one() {
                "must be a robot or a computer: groups have no address".into()
            } else if address.port() == 0 {
                "must have a port other than 0".into()
            } else if !is_of_one_host(address.ip()) {
                format!("must be the address of one machine, not {}", address.ip())
            } else if address.is_ipv4() != self.entries[0].1.is_ipv4() {
                let (first, there) = self.entries[0];
                format!(
                    "must be of one kind with that of {first}, {there}: IPv4 and IPv6 do not reach each other"
                )
            } else if before.any(|(other, _)| other == peer) {
                "is there twice".into()
            } else {
                let (other, _) = self.entries().take(place).find(|&(_, there)| is_same(there, address))?;
                format!("must have an address of its own, not {address}, which is that of {other}")
            };
            Some((peer.to_string(), reason))
        })
    }
}

/// In any order.
impl FromIterator<(Peer, SocketAddr)> for Directory {
    fn from_iter<I: IntoIterator<Item = (Peer, SocketAddr)>>(entries: I) -> Directory {
        let mut entries = Vec::from_iter(entries);
        entries.sort_by_key(|&(peer, _)| peer);
        Directory { entries }
    }
}

impl Serialize for Directory {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.entries())
    }
}

impl<'de> Deserialize<'de> for Directory {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Directory, D::Error> {
        deserializer.deserialize_map(Entries)
    }
}

/// Reads a map and keeps keys that come twice, for [`Directory::fault`] to tell.
struct Entries;

impl<'de> Visitor<'de> for Entries {
    type Value = Directory;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map from robots and computers to socket addresses")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Directory, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry()? {
            entries.push(entry);
        }
        Ok(entries.into_iter().collect())
    }
}

fn is_same(one: SocketAddr, other: SocketAddr) -> bool {
    one.port() == other.port() && one.ip().to_canonical() == other.ip().to_canonical()
}

fn is_of_one_host(address: IpAddr) -> bool {
    let broadcast = matches!(address.to_canonical(), IpAddr::V4(address) if address.is_broadcast());
    !(broadcast || address.is_unspecified() || address.to_canonical().is_multicast())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const COMPUTER: Peer = Peer::Computer(0);

    fn home(number: u8) -> Peer {
        Peer::Robot { team: 0, number }
    }

    fn away(number: u8) -> Peer {
        Peer::Robot { team: 1, number }
    }

    fn read(text: &str) -> Directory {
        ron::from_str(text).unwrap()
    }

    #[test]
    fn the_table_is_read_from_a_file_and_written_to_one() {
        let text = r#"{"computer 0":"[::1]:7499","home 0":"[::ffff:127.0.0.1]:7400"}"#;
        let directory = read(text);
        assert_eq!(directory.fault(), None);
        assert_eq!(directory.address_of(home(0)), Some("[::ffff:127.0.0.1]:7400".parse().unwrap()));
        assert_eq!(directory.address_of(home(1)), None);
        assert_eq!(directory.peer_at("[::1]:7499".parse().unwrap()), Some(COMPUTER));
        assert_eq!(directory.peer_at("[::1]:7400".parse().unwrap()), None);
        assert_eq!(directory.peer_at("127.0.0.1:7400".parse().unwrap()), Some(home(0)));
        assert_eq!(read(&ron::to_string(&directory).unwrap()), directory);
        assert!(
            ron::from_str::<Directory>(r#"{"guest": "127.0.0.1:1"}"#)
                .unwrap_err()
                .to_string()
                .contains("guest")
        );
        assert!(ron::from_str::<Directory>(r#"{"home 0": "here"}"#).is_err());
    }

    #[test]
    fn the_default_table_counts_ports_through_the_teams() {
        let directory = Directory::loopback(7400, &[2, 1]).unwrap();
        let entries: Vec<_> = directory.entries().map(|(peer, address)| (peer, address.port())).collect();
        assert_eq!(entries, [(home(0), 7400), (home(1), 7401), (away(0), 7402), (COMPUTER, 7499)]);
        assert_eq!(directory.fault(), None);
        let many = Directory::loopback(7400, &[60, 40]).unwrap();
        assert_eq!(many.address_of(COMPUTER).map(|address| address.port()), Some(7500));
        let base_port = 65_500;
        assert_eq!(Directory::loopback(base_port, &[]), Err(OutOfPorts { base_port, peers: 1 }));
        assert!(Directory::loopback(0, &[1]).is_err());
    }

    #[test]
    fn messages_reach_one_or_a_team_or_everybody_but_never_their_sender() {
        let mut directory = Directory::loopback(7400, &[2, 2]).unwrap();
        directory.put(HOST, "127.0.0.1:7498".parse().unwrap());
        let receivers = |to, from| directory.receivers(to, from).collect::<Vec<_>>();
        assert_eq!(receivers(away(1), home(0)), [away(1)]);
        assert_eq!(receivers(away(7), home(0)), []);
        assert_eq!(receivers(home(0), home(0)), []);
        assert_eq!(receivers(Peer::Team(0), home(0)), [home(1), COMPUTER], "tools can follow");
        assert_eq!(receivers(Peer::Team(0), COMPUTER), [home(0), home(1)]);
        assert_eq!(receivers(Peer::Everybody, away(0)), [home(0), home(1), away(1), COMPUTER, HOST]);
    }

    #[test]
    fn a_table_that_cannot_work_tells_why() {
        let fault = |text| read(text).fault().unwrap();
        let (peer, reason) = fault(r#"{"home 1": "127.0.0.1:7400", "home 1": "127.0.0.1:7401"}"#);
        assert_eq!((peer.as_str(), reason.as_str()), ("home 1", "is there twice"));
        let (peer, reason) = fault(r#"{"home 1": "127.0.0.1:7400", "home 0": "127.0.0.1:7400"}"#);
        assert_eq!(peer, "home 1");
        assert!(reason.ends_with("127.0.0.1:7400, which is that of home 0"), "{reason}");
        for (text, word) in [
            (r#"{"home": "127.0.0.1:7400"}"#, "groups"),
            (r#"{"everybody": "127.0.0.1:7400"}"#, "groups"),
            (r#"{"home 0": "127.0.0.1:0"}"#, "port"),
            (r#"{"home 0": "127.0.0.1:7400", "home 1": "[::1]:7401"}"#, "that of home 0, 127.0.0.1:7400"),
            (r#"{"home 0": "0.0.0.0:7400"}"#, "one machine"),
            (r#"{"home 0": "224.0.0.1:7400"}"#, "one machine"),
            (r#"{"home 0": "255.255.255.255:7400"}"#, "one machine"),
        ] {
            let (_, reason) = fault(text);
            assert!(reason.contains(word), "{text}: {reason}");
        }
    }

    proptest! {
        #[test]
        fn every_default_table_is_sound(base_port in 1u16..60_000, teams in prop::collection::vec(0u8..30, 0..4)) {
            let directory = Directory::loopback(base_port, &teams).unwrap();
            prop_assert_eq!(directory.fault(), None);
            for (peer, address) in directory.entries() {
                prop_assert_eq!(directory.peer_at(address), Some(peer));
                prop_assert_eq!(directory.address_of(peer), Some(address));
            }
        }
    }
}
