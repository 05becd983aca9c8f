//! Which parts of a match cross a network.

use std::net::{IpAddr, SocketAddr};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::chaos::ChaosPlan;
use super::error::NetworkError;
use crate::ids::RobotId;
use crate::world::gamecontroller::control::{NO_TEAM, Version};

/// Which parts of a match cross a network.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct NetworkPlan {
    /// Team messages go by UDP and not by the simulated radio.
    pub udp: bool,
    /// Robots that are processes of their own.
    pub remote: Vec<RobotId>,
    /// Where a referee box sends its packets to.
    pub gamecontroller: Option<SocketAddr>,
    /// Where the match is announced to, in the GameController's own format.
    pub announce: Option<SocketAddr>,
    /// The host at whose league's ports each team message arrives, too; then teams keep to the league's limits.
    pub league_ports: Option<IpAddr>,
    /// The version of what is announced and of the league's limits.
    pub version: Version,
    /// The league's numbers of home and away, if they are known.
    pub team_numbers: Option<[u8; 2]>,
    /// How long a match waits for its referee box before it is given up.
    pub wait_for_box: Option<Duration>,
    /// Where ChaosManager is heard, and whom it may obey.
    pub chaos: Option<ChaosPlan>,
}

impl NetworkPlan {
    /// What is wrong with the plan, as the option and a reason.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        if let Some(message) = self.team_numbers.and_then(team_numbers_fault) {
            return Some(("--team-numbers", message));
        }
        if let Some(chaos) = self.chaos.as_ref().filter(|chaos| chaos.addresses().is_none()) {
            return Some(("--chaos", NetworkError::NoPorts(chaos.at).to_string()));
        }
        let (listen, tell) = self.gamecontroller.zip(self.announce)?;
        let is_here = tell.ip().is_loopback() || tell.ip().is_unspecified();
        let itself = listen.ip() == tell.ip() || (listen.ip().is_unspecified() && is_here);
        (listen.port() == tell.port() && itself).then(|| {
            let message = format!("{tell} is where --gamecontroller listens: the match would follow itself");
            ("--announce", message)
        })
    }

    /// Whether anything of the match crosses a socket.
    pub fn has_sockets(&self) -> bool {
        let tells = self.announce.is_some() || self.league_ports.is_some();
        self.udp || tells || self.gamecontroller.is_some() || self.chaos.is_some()
    }

    /// Whether the match follows a clock that is not its own.
    pub fn is_in_real_time(&self) -> bool {
        self.gamecontroller.is_some() || self.chaos.is_some()
    }
}

/// What is wrong with the league's numbers of home and away.
pub fn team_numbers_fault([home, away]: [u8; 2]) -> Option<String> {
    if home == away {
        return Some(format!("both teams have the number {home}"));
    }
    [home, away].contains(&NO_TEAM).then(|| format!("{NO_TEAM} is no team: it stands for neither"))
}
