//! The league's side of team messages: the budgets that referee boxes keep, and copies of all messages at the league's
//! ports, where boxes count them.
//!
//! With these copies a match keeps the league's rules. Messages are cut into datagrams that the league allows, and the
//! budget is spread over what is left of the match: a robot that wants to say more is not heard, as on a bad radio, and what
//! it wanted to say is counted as over budget.

use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;

use bevy::log::warn;
use bevy::prelude::*;

use crate::clock::Clock;
use crate::comms::radio::transmit_datagrams;
use crate::comms::tcm::udp::{UdpConn, UdpError};
use crate::comms::tcm::{MessageBudgets, OnAir, TcmSystems};
use crate::ids::RobotId;
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};
use crate::world::gamecontroller::BoxNews;
use crate::world::gamecontroller::control::GamePhase;
use crate::world::gamecontroller::league::port_of;
use crate::world::referee::{MatchState, Phase, RuleBook};

pub(super) fn plugin(app: &mut App) {
    let is_match = resource_exists::<MessageBudgets>.and_then(resource_exists::<MatchState>);
    let counts = keep_budgets.in_set(TickSystems::Transmit).before(TcmSystems::Send);
    let copies = copy_messages.in_set(TickSystems::Transmit).after(TcmSystems::Send);
    app.add_systems(Tick, counts.run_if(is_match)).add_systems(
        Tick,
        copies
            .before(transmit_datagrams)
            .before(super::carrier::transmit)
            .run_if(resource_exists::<LeaguePorts>),
    );
}

/// Where the copies go, home's and away's.
#[derive(Resource)]
pub struct LeaguePorts {
    conn: UdpConn,
    to: [SocketAddr; 2],
    trouble: Option<String>,
}

impl LeaguePorts {
    /// Opens the socket.
    pub fn open(host: IpAddr, team_numbers: [u8; 2]) -> Result<LeaguePorts, UdpError> {
        let to = team_numbers.map(|number| SocketAddr::new(host, port_of(number)));
        Ok(LeaguePorts { conn: UdpConn::speaker(to[0])?, to, trouble: None })
    }
}

/// Boxes count while a match is under way, but not in a shoot-out. In extra time there are more messages.
/// A half to come is taken to be as long as the rule book has it.
fn keep_budgets(
    clock: Res<Clock>,
    (state, book): (Res<MatchState>, Res<RuleBook>),
    news: Option<Res<BoxNews>>,
    mut budgets: ResMut<MessageBudgets>,
) {
    let phase = news.as_ref().and_then(|news| news.view.as_ref()).map(|view| view.game_phase);
    if phase == Some(GamePhase::ExtraTime) {
        budgets.begin_extra_time();
    }
    let under_way = matches!(state.phase, Phase::Ready | Phase::Set | Phase::Playing);
    budgets.counts = under_way && phase != Some(GamePhase::PenaltyShootOut);
    let halves_to_come = f64::from(RuleBook::HALVES.saturating_sub(state.half));
    budgets.share_out(f64::from(clock.dt), state.time_left + halves_to_come * book.half_seconds());
}

/// Sends each datagram once, however many robots it is for.
fn copy_messages(mut ports: ResMut<LeaguePorts>, on_air: Res<OnAir>, robots: Query<(&RobotId, &Robot)>) {
    let ports = &mut *ports;
    for copies in on_air.0.chunk_by(|one, other| Arc::ptr_eq(&one.bytes, &other.bytes)) {
        let Some(datagram) = copies.first() else { continue };
        let mute = robots.iter().any(|(id, robot)| *id == datagram.from && robot.health.mute);
        if mute {
            continue;
        }
        let to = ports.to[datagram.from.team.index()];
        if let Err(error) = ports.conn.send(to, &datagram.bytes) {
            let trouble = error.to_string();
            if ports.trouble.as_ref() != Some(&trouble) {
                warn!("team messages do not reach the league's port: {trouble}");
                ports.trouble = Some(trouble);
            }
        }
    }
}
