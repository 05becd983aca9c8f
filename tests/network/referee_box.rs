//! Matches that a referee box referees.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};

use bevy::prelude::*;
use touchline::game::net::NetworkPlan;
use touchline::game::requests::{BodyChange, Request, Requests};
use touchline::game::{Match, MatchPlan};
use touchline::geometry::Pose;
use touchline::ids::{RobotId, Team};
use touchline::mind::teamwork::{Booking, TeamModel};
use touchline::mind::world_model::WorldModel;
use touchline::pitch::Pitch;
use touchline::robot::{OffPitch, Orders, RobotState};
use touchline::world::gamecontroller::BoxNews;
use touchline::world::gamecontroller::announcement::MatchAnnouncement;
use touchline::world::gamecontroller::control::{ControlPacket, GamePhase, Penalty, SetPlay, State, Version};
use touchline::world::gamecontroller::referee_box::{BoxView, PacketCounts, Penalised};
use touchline::world::gamecontroller::status::{PORT, STATUS_LEN, StatusPacket};
use touchline::world::referee::{Decision, Phase, Whistles};

use super::announced::{announced, next};
use super::{HOME_0, open, plan, stranger, talkative};
use crate::support::ball;

mod orders;
mod penalties;
mod program;

/// The league's numbers of home and away.
const TEAMS: [u8; 2] = [12, 34];

/// A match and the box that referees it.
pub(super) struct Refereed {
    pub game: Match,
    pub plan: MatchPlan,
    socket: UdpSocket,
    to: SocketAddr,
    says: MatchAnnouncement,
    /// Says the same twice a second, once it has said anything.
    speaks: bool,
}

impl Refereed {
    pub fn new(plan: MatchPlan) -> Refereed {
        // Any address here is moved to a free one.
        let gamecontroller = Some(SocketAddr::from((Ipv4Addr::LOCALHOST, 0)));
        let plan = MatchPlan { network: NetworkPlan { gamecontroller, ..plan.network }, ..plan };
        let players = plan.teams[0].strategy.players.len() as u8;
        let (game, plan) = open(&plan);
        let says = MatchAnnouncement {
            view: BoxView { kicking: Some(0), seconds_left: 600, ..BoxView::default() },
            team_numbers: TEAMS,
            players_per_team: players,
            ..MatchAnnouncement::default()
        };
        let to = plan.network.gamecontroller.expect("it was asked for");
        Refereed { game, plan, socket: stranger(), to, says, speaks: false }
    }

    /// The same, with the ball in play.
    fn playing(plan: MatchPlan) -> Refereed {
        let mut refereed = Refereed::new(plan);
        refereed.begin();
        refereed
    }

    /// The box leads the match to where the ball is in play.
    pub fn begin(&mut self) {
        for state in [State::Initial, State::Ready, State::Set, State::Playing] {
            self.say(|says| says.state = state);
        }
    }

    /// The box says something else, and the match hears it in a tick.
    pub fn say(&mut self, change: impl FnOnce(&mut BoxView)) {
        change(&mut self.says.view);
        self.speak();
        self.silence(1);
    }

    fn speak(&mut self) {
        self.speaks = true;
        self.says.packet_number = self.says.packet_number.wrapping_add(1);
        self.send(&self.says.packet().write());
    }

    pub fn send(&self, bytes: &[u8]) {
        self.socket.send_to(bytes, self.to).expect("it is sent");
    }

    /// So many ticks in which the box goes on speaking.
    pub fn ticks(&mut self, ticks: u64) {
        for _ in 0..ticks {
            if self.speaks && self.game.clock().tick.is_multiple_of(30) {
                self.speak();
            }
            self.game.tick();
        }
    }

    /// So many ticks in which the box says nothing.
    fn silence(&mut self, ticks: u64) {
        (0..ticks).for_each(|_| self.game.tick());
    }

    fn phase(&self) -> Phase {
        self.game.state().phase
    }

    fn heard(&self) -> PacketCounts {
        self.game.world().resource::<BoxNews>().heard()
    }

    /// What the referee tells a robot, and whether it is off the pitch.
    fn orders(&mut self, robot: RobotId) -> (RobotState, bool) {
        let mut robots = self.game.world_mut().query::<(&RobotId, &Orders, Has<OffPitch>)>();
        let found = robots.iter(self.game.world()).find(|(id, ..)| **id == robot);
        found.map(|(_, orders, off)| (orders.state, off)).expect("the robot is in the match")
    }

    /// The robots that claim the ball.
    fn claimants(&mut self) -> Vec<RobotId> {
        let mut robots = self.game.world_mut().query::<(&RobotId, &TeamModel)>();
        robots.iter(self.game.world()).filter(|(_, own)| own.has_ball).map(|(id, _)| *id).collect()
    }

    /// Plays on until all mates of a robot of home know that it has booked the ball; its number.
    fn until_the_ball_is_booked(&mut self) -> u8 {
        loop {
            self.ticks(1);
            let bookings = self.bookings();
            let booked = (0..4).find(|booker| bookings.iter().filter(|(_, of)| of == booker).count() == 3);
            if let Some(booker) = booked {
                return booker;
            }
            assert!(self.game.clock().now() < 60.0, "nobody books the ball");
        }
    }

    /// The robots of home that take another one to have booked the ball, with that one.
    fn bookings(&mut self) -> Vec<(u8, u8)> {
        let tick = self.game.clock().tick;
        let mut robots = self.game.world_mut().query::<(&RobotId, &Booking)>();
        let booked =
            robots.iter(self.game.world()).filter(|(id, _)| id.team == Team::Home).filter_map(|(id, own)| {
                let booking = own.0.booking().filter(|_| own.0.is_booked(tick))?;
                (booking.robot_booker != id.number).then_some((id.number, booking.robot_booker))
            });
        booked.collect()
    }
}

/// Puts the ball somewhere to rest.
pub(super) fn put_ball(game: &mut Match, at: Vec2) {
    let put = Request::Body(BodyChange::Ball { at, velocity: Vec2::ZERO });
    game.world_mut().resource_mut::<Requests>().ask(put);
}

pub(super) const IN_THE_EASTERN_GOAL: Vec2 = Vec2::new(4.7, 0.0);

#[test]
fn a_box_leads_a_match_through_its_states_to_its_end() {
    let mut refereed = Refereed::new(talkative(10.0));
    refereed.ticks(600);
    assert_eq!(refereed.phase(), Phase::Initial, "nobody begins without the box");
    let states = [State::Initial, State::Ready, State::Set, State::Playing];
    let phases = [Phase::Initial, Phase::Ready, Phase::Set, Phase::Playing];
    for (half, kicking) in [(1, 1), (2, 0)] {
        for (state, phase) in states.into_iter().zip(phases) {
            refereed.say(|says| {
                says.left = usize::from(half == 2);
                (says.state, says.first_half, says.kicking) = (state, half == 1, Some(kicking));
                says.seconds_left = 500 - phase as i16;
            });
            let is = refereed.game.state();
            let expected = 500.0 - f64::from(phase as u8);
            assert_eq!((is.phase, is.half, is.time_left), (phase, half, expected));
            assert_eq!(is.kick_off, Team::BOTH[kicking]);
            // For longer than our own referee would leave robots in any of the states.
            refereed.ticks(300);
            assert_eq!(refereed.phase(), phase);
        }
        let home_attacks = refereed.game.state().attacking(Team::Home).turn(Vec2::X).x;
        assert_eq!(home_attacks > 0.0, half == 1);
        refereed.say(|says| says.state = State::Finished);
        assert!(!refereed.game.is_over());
    }
    refereed.say(|says| says.score = [1, 0]);
    refereed.ticks(19 * 60);
    assert!(!refereed.game.is_over(), "the box may go on");
    refereed.ticks(2 * 60);
    assert!(refereed.game.is_over());
}

#[test]
fn a_ball_in_the_goal_is_a_goal_when_the_box_says_so() {
    let mut ours = Match::new(&talkative(10.0));
    while ours.state().phase != Phase::Playing {
        ours.tick();
    }
    let mut refereed = Refereed::playing(talkative(10.0));
    put_ball(&mut ours, IN_THE_EASTERN_GOAL);
    put_ball(&mut refereed.game, IN_THE_EASTERN_GOAL);
    ours.tick();
    assert_eq!(ours.state().score, [1, 0], "our own referee sees a goal there");
    refereed.ticks(60);
    assert_eq!((refereed.game.state().score, refereed.phase()), ([0, 0], Phase::Playing));
    let rests = ball(&mut refereed.game).0.position;
    assert!(rests.distance(IN_THE_EASTERN_GOAL) < 0.1, "{rests}: nobody has taken it out");
    refereed.say(|says| (says.state, says.score, says.kicking) = (State::Ready, [1, 0], Some(1)));
    let state = refereed.game.state();
    assert_eq!((state.score, state.phase, state.kick_off), ([1, 0], Phase::Ready, Team::Away));
    assert_eq!(ball(&mut refereed.game).0.position, Vec2::ZERO);
    let whistles = refereed.game.world().resource::<Whistles>();
    let goals =
        whistles.heard.iter().filter(|(_, call)| matches!(call, Decision::Goal { by: Team::Home, .. }));
    assert_eq!(goals.count(), 1);
}

#[test]
fn what_is_no_packet_about_this_match_is_counted_and_not_followed() {
    let mut refereed = Refereed::playing(talkative(10.0));
    let before = refereed.heard();
    assert_eq!(before, PacketCounts { news: 4, ..PacketCounts::default() });
    let (says, first_half) = (refereed.says.clone(), false);
    let view = BoxView { state: State::Finished, first_half, score: [9, 9], ..says.view.clone() };
    let over = MatchAnnouncement { packet_number: says.packet_number + 1, view, ..says.clone() };
    let elsewhere = MatchAnnouncement { team_numbers: [12, 35], ..over.clone() }.packet().write();
    let version = [b"RGme\x15", &over.packet().write()[5..]].concat();
    let whole = over.packet().write();
    let short = &whole[..whole.len() - 1];
    let late = MatchAnnouncement { packet_number: says.packet_number - 1, ..over.clone() }.packet().write();
    for bytes in [&b"hello"[..], &version, short, &elsewhere, &late] {
        refereed.send(bytes);
    }
    let other = stranger();
    other.send_to(&over.packet().write(), refereed.to).expect("it is sent");
    refereed.silence(1);
    let state = refereed.game.state();
    assert_eq!((state.phase, state.half, state.score), (Phase::Playing, 1, [0, 0]));
    let expected =
        PacketCounts { not_ours: 1, version: 1, length: 1, teams: 1, sender: 1, stale: 1, ..before };
    assert_eq!(refereed.heard(), expected);
}

#[test]
fn a_match_whose_numbers_are_known_passes_by_a_box_of_other_teams_that_is_heard_first() {
    let plan = talkative(10.0);
    let plan = MatchPlan { network: NetworkPlan { team_numbers: Some(TEAMS), ..plan.network }, ..plan };
    let mut refereed = Refereed::new(plan);
    let elsewhere = MatchAnnouncement { team_numbers: [5, 6], ..refereed.says.clone() };
    let other = stranger();
    other.send_to(&elsewhere.packet().write(), refereed.to).expect("it is sent");
    refereed.ticks(5);
    assert_eq!((refereed.heard().news, refereed.heard().teams), (0, 1));
    refereed.begin();
    assert_eq!((refereed.phase(), refereed.heard().teams), (Phase::Playing, 1));
}

#[test]
fn a_tick_hears_so_many_packets_at_most_and_the_next_ones_the_rest() {
    let mut refereed = Refereed::new(talkative(10.0));
    (0..200).for_each(|_| refereed.send(b"hello"));
    refereed.silence(1);
    assert_eq!(refereed.heard().not_ours, 128);
    refereed.silence(1);
    assert_eq!(refereed.heard().not_ours, 200);
}

#[test]
#[cfg(target_os = "linux")]
fn a_box_is_told_twice_a_second_how_the_robots_are() {
    // Linux has all addresses that begin with 127: each process takes one for itself.
    let [.., high, middle, low] = std::process::id().to_be_bytes();
    let me = Ipv4Addr::new(127, 1 + high % 250, middle, low);
    let ears = UdpSocket::bind((me, PORT)).expect("nobody else has this address");
    ears.set_nonblocking(true).expect("sockets can do that");
    let mut refereed = Refereed::new(talkative(10.0));
    refereed.socket = UdpSocket::bind((me, 0)).expect("there is a free port");
    refereed.begin();
    let mut bytes = [0; STATUS_LEN];
    while ears.recv(&mut bytes).is_ok() {
        let packet = StatusPacket::read(&bytes).expect("it is a status packet");
        assert!((packet.x, packet.y) != (0.0, 0.0), "nobody tells a place that it does not know");
    }
    let mut told = 0;
    for _ in 0..120 {
        let due = refereed.game.clock().tick.is_multiple_of(30);
        let mut robots = refereed.game.world_mut().query::<(&RobotId, &WorldModel)>();
        let mut models: Vec<(RobotId, WorldModel)> =
            robots.iter(refereed.game.world()).map(|(id, model)| (*id, model.clone())).collect();
        models.sort_by_key(|(id, _)| *id);
        refereed.silence(1);
        for (id, model) in models.iter().filter(|_| due) {
            let mut bytes = [0; STATUS_LEN + 1];
            let length = ears.recv(&mut bytes).expect("each robot is told of");
            let packet = StatusPacket::read(&bytes[..length]).expect("it is a status packet");
            assert_eq!((packet.player_number, packet.team_number), (id.number + 1, TEAMS[id.team.index()]));
            let at = Vec2::new(packet.x, packet.y);
            assert!(at.distance(model.pose.position) < 1e-5, "{packet:?}, {model:?}");
            assert_eq!(packet.theta, model.pose.heading);
            assert!(packet.ball.is_some() || model.ball.is_none(), "{packet:?}, {model:?}");
            told += 1;
        }
        assert!(ears.recv(&mut [0]).is_err(), "and of nobody more");
    }
    assert_eq!(told, 4 * 8);
}

#[test]
fn one_match_can_referee_another() {
    let (mut leader, socket) = announced(talkative(0.1));
    let mut follower = Refereed::new(talkative(0.1));
    let mut followed = 0;
    while !leader.is_over() {
        if leader.state().phase == Phase::Playing && leader.state().score == [0, 0] {
            put_ball(&mut leader, IN_THE_EASTERN_GOAL);
        }
        let was = leader.state().clone();
        leader.tick();
        let packets: Vec<_> = std::iter::from_fn(|| next(&socket)).collect();
        packets.iter().for_each(|packet| follower.send(packet));
        follower.silence(1);
        if !packets.is_empty() {
            let is = follower.game.state();
            assert_eq!((is.phase, is.half, is.score), (was.phase, was.half, was.score));
            assert_eq!((is.kick_off, is.home_attacks), (was.kick_off, was.home_attacks));
            followed += packets.len() as u64;
        }
    }
    assert!(followed > 20, "{followed}");
    assert_eq!((follower.heard().news, follower.game.state().score), (followed, [1, 0]));
}

#[test]
fn a_match_under_a_box_is_announced_with_the_stops_set_plays_phases_and_penalties_of_the_box() {
    let ears = stranger();
    ears.set_nonblocking(true).expect("sockets can do that");
    let announce = Some(ears.local_addr().expect("it is bound"));
    let network = NetworkPlan { announce, ..NetworkPlan::default() };
    let mut refereed = Refereed::playing(MatchPlan { network, ..talkative(10.0) });
    let pushed = Penalised { player: 2, penalty: Penalty::Pushing, seconds_left: 17 };
    refereed.say(|says| {
        (says.set_play, says.stopped, says.kicking) = (SetPlay::CornerKick, true, Some(1));
        (says.secondary_time, says.seconds_left) = (31, -2);
        says.penalties[1] = vec![pushed];
    });
    refereed.ticks(60);
    let last = std::iter::from_fn(|| next(&ears)).last().expect("it is announced");
    let told = ControlPacket::read(&last).expect("it is a control packet");
    let said = refereed.says.packet();
    assert_eq!(
        (told.state, told.set_play, told.stopped.is_set()),
        (State::Playing, SetPlay::CornerKick, true)
    );
    assert_eq!(told.kicking_team, Some(told.teams[1].team_number));
    assert_eq!((told.secs_remaining, told.secondary_time), (-2, 31));
    for (told, said) in told.teams.iter().zip(&said.teams) {
        assert_eq!((told.team_number, told.players), (said.team_number, said.players));
    }
    refereed
        .say(|says| (says.state, says.game_phase, says.kicking) = (State::Initial, GamePhase::TimeOut, None));
    refereed.ticks(60);
    let last = std::iter::from_fn(|| next(&ears)).last().expect("it is announced");
    let told = ControlPacket::read(&last).expect("it is a control packet");
    assert_eq!((told.state, told.game_phase, told.kicking_team), (State::Initial, GamePhase::TimeOut, None));
}
