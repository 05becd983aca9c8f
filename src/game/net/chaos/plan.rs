//! Where ChaosManager is heard, and who may speak to the match through it.

use std::fmt;
use std::net::{IpAddr, SocketAddr};

use serde::{Deserialize, Serialize};

use super::table::ChaosSocket;

/// Where ChaosManager is heard, and who may speak to the match through it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ChaosPlan {
    /// Of the first of three sockets, whose ports follow each other.
    pub at: SocketAddr,
    /// The addresses that may give orders; those of this machine itself, if none is given.
    pub from: Vec<IpAddr>,
}

impl ChaosPlan {
    /// The addresses of the three sockets; nothing, if ports do not reach.
    pub fn addresses(&self) -> Option<[SocketAddr; 3]> {
        let [images, data, orders] = ChaosSocket::ALL.map(|socket| socket.address(self.at));
        Some([images?, data?, orders?])
    }

    /// Whether somebody at an address may give orders. An IPv4 address that is written as an IPv6 address is the same.
    pub fn accepts(&self, from: IpAddr) -> bool {
        let from = from.to_canonical();
        match &self.from[..] {
            [] => from.is_loopback(),
            listed => listed.iter().any(|known| known.to_canonical() == from),
        }
    }
}

/// Who may give orders.
impl fmt::Display for ChaosPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.from[..] {
            [] => f.write_str("this machine only"),
            listed => {
                let listed: Vec<String> = listed.iter().map(IpAddr::to_string).collect();
                f.write_str(&listed.join(", "))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_machine_is_accepted_unless_others_are_listed() {
        let at = SocketAddr::from(([0, 0, 0, 0], 7500));
        let accepts = |from: &[&str], who: &str| {
            let from = from.iter().map(|ip| ip.parse().unwrap()).collect();
            ChaosPlan { at, from }.accepts(who.parse().unwrap())
        };
        assert!(accepts(&[], "127.0.0.1") && accepts(&[], "::1") && accepts(&[], "::ffff:127.0.0.1"));
        assert!(!accepts(&[], "10.0.0.7"));
        assert!(accepts(&["10.0.0.7"], "::ffff:10.0.0.7") && !accepts(&["10.0.0.7"], "127.0.0.1"));
    }
}
