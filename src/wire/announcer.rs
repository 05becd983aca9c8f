//! Announces a match in the GameController's own format, so that other tools can follow it.

use std::net::{Ipv4Addr, SocketAddr};

use bevy::prelude::*;

use crate::clock::Clock;
use crate::gamecontroller::announcement::{Sentence, Standing};
use crate::gamecontroller::control::{Penalty, SetPlay, State};
use crate::ids::RobotId;
use crate::record::Record;
use crate::referee::{MatchState, Phase};
use crate::tcm::udp::{UdpConn, UdpError};

/// How often a match is announced, per second: as often as referee boxes speak.
const HZ: f32 = 2.0;
/// The numbers that the teams have in the league's format, home first.
const TEAM_NUMBERS: [u8; 2] = [1, 2];

pub(super) struct Announcer {
    conn: UdpConn,
    to: SocketAddr,
    packet_number: u8,
}

impl Announcer {
    pub fn open(to: SocketAddr) -> Result<Announcer, UdpError> {
        let conn = UdpConn::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, 0)))?;
        Ok(Announcer { conn, to, packet_number: 0 })
    }

    pub fn announce_when_due(&mut self, world: &mut World) {
        if world.resource::<Clock>().is_due(HZ) {
            self.announce(world);
        }
    }

    pub fn announce(&mut self, world: &mut World) {
        let robots: Vec<RobotId> =
            world.resource::<Record>().driven.iter().map(|(robot, _)| *robot).collect();
        let standing = standing(world.resource::<MatchState>(), &robots, self.packet_number);
        self.packet_number = self.packet_number.wrapping_add(1);
        // Whether anybody listens there is not known.
        let _ = self.conn.send(self.to, &standing.packet().write());
    }
}

fn standing(state: &MatchState, robots: &[RobotId], packet_number: u8) -> Standing {
    let players = robots.iter().map(|robot| robot.number + 1).max().unwrap_or(0);
    let sentences = state.removed.iter().map(|removal| Sentence {
        side: removal.robot.team.index(),
        player: removal.robot.number,
        penalty: Penalty::Manual,
        seconds_left: removal.seconds_left,
    });
    Standing {
        packet_number,
        state: match state.phase {
            Phase::Initial => State::Initial,
            Phase::Ready => State::Ready,
            Phase::Set => State::Set,
            Phase::Playing => State::Playing,
            Phase::Finished => State::Finished,
        },
        set_play: SetPlay::None,
        stopped: false,
        first_half: state.half == 1,
        kicking: Some(state.kick_off.index()),
        seconds_left: state.time_left,
        secondary_time: 0.0,
        score: state.score,
        team_numbers: TEAM_NUMBERS,
        players_per_team: players,
        penalties: sentences.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gamecontroller::control::ControlPacket;
    use crate::gamecontroller::referee_box::RefereeBox;
    use crate::ids::Team;
    use crate::referee::RuleBook;

    #[test]
    fn what_is_announced_is_what_another_match_would_follow() {
        let robots = [RobotId::new(Team::Home, 0), RobotId::new(Team::Away, 3)];
        let mut state = MatchState::in_play(Team::Away, &RuleBook::default(), true);
        state.score = [2, 1];
        let bytes = standing(&state, &robots, 7).packet().write();
        assert_eq!(ControlPacket::read(&bytes).map(|packet| packet.packet_number), Ok(7));
        let view = RefereeBox::new(Some(TEAM_NUMBERS), 4).hear(&bytes, 0);
        let view = view.expect("it is a good packet").expect("it is news");
        assert_eq!((view.state, view.score, view.kicking), (State::Playing, [2, 1], Some(1)));
        assert_eq!((view.seconds_left, view.first_half), (600, true));
    }
}
