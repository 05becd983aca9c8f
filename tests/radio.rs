//! The radio in whole matches: what is counted, what is lost, what a dead radio leaves.

use std::collections::{BTreeMap, BTreeSet};

use bevy::prelude::*;
use touchline::comms::radio::{InFlight, Loss, RadioRecord, TransmissionState};
use touchline::game::record::Record;
use touchline::game::requests::{Request, Requests, RobotChange};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::robot::RobotFailure;

use crate::support::assets;

/// The Hammerheads with role swaps against themselves.
fn talkative(radio: &str, seed: u64) -> MatchPlan {
    let team = Some("hammerheads_swap".to_owned());
    let choice = Choice {
        home: team.clone(),
        away: team,
        radio: Some(radio.into()),
        half_minutes: Some(0.5),
        seed,
        ..Choice::default()
    };
    MatchPlan::read(&assets(), &choice).expect("the shipped files are sound")
}

/// What a link has seen, counted from the messages themselves.
#[derive(Debug, Default, PartialEq, Eq)]
struct Seen {
    sent: u64,
    bytes: u64,
    launched: u64,
    landed: u64,
    lost_on_air: u64,
    late: u64,
}

type Links = BTreeMap<(RobotId, RobotId), Seen>;

/// Plays a match and watches every message in flight and every line of the log.
fn watch(game: &mut Match) -> Links {
    let mut links = Links::new();
    let mut in_flight: BTreeMap<Entity, (RobotId, RobotId)> = BTreeMap::new();
    let mut logged: BTreeSet<u64> = BTreeSet::new();
    while !game.is_over() {
        game.tick();
        let world = game.world_mut();
        let mut flying = world.query::<(Entity, &InFlight)>();
        let now: BTreeMap<Entity, InFlight> =
            flying.iter(world).map(|(entity, in_flight)| (entity, in_flight.clone())).collect();
        for (from, to) in
            in_flight.iter().filter(|(entity, _)| !now.contains_key(entity)).map(|(_, link)| *link)
        {
            links.entry((from, to)).or_default().landed += 1;
        }
        for new in now.iter().filter(|(entity, _)| !in_flight.contains_key(entity)).map(|(_, new)| new) {
            let seen = links.entry((new.packet.from, new.packet.to)).or_default();
            seen.launched += 1;
            seen.late += u64::from(new.late);
        }
        let bytes: BTreeMap<u64, u64> =
            now.values().map(|flying| (flying.id, flying.packet.bytes.len() as u64)).collect();
        for entry in world.resource::<RadioRecord>().transmissions() {
            if logged.insert(entry.id) {
                let seen = links.entry((entry.packet.from, entry.packet.to)).or_default();
                seen.sent += 1;
                seen.lost_on_air += u64::from(matches!(entry.state, TransmissionState::Lost(_)));
                seen.bytes += bytes.get(&entry.id).copied().unwrap_or_default();
            }
        }
        let link = |flying: InFlight| (flying.packet.from, flying.packet.to);
        in_flight = now.into_iter().map(|(entity, flying)| (entity, link(flying))).collect();
    }
    links
}

#[test]
fn counters_of_every_link_agree_with_the_messages_seen() {
    for radio in ["perfect", "good", "bursty", "awful"] {
        let mut game = Match::new(&talkative(radio, 3));
        let links = watch(&mut game);
        let traffic = game.world().resource::<RadioRecord>();
        assert_eq!(links.len(), 24, "two teams of four have 24 links");
        for ((from, to), seen) in &links {
            let counted = traffic.link(*from, *to);
            let at = format!("{radio}, from {from} to {to}: {seen:?}, {counted:?}");
            assert!(counted.sent > 100, "{at}");
            assert_eq!(counted.sent, seen.sent, "{at}");
            assert_eq!(counted.delivered, seen.landed, "{at}");
            assert_eq!(counted.lost_in_all(), seen.lost_on_air, "{at}");
            assert_eq!(counted.sent + counted.duplicated - seen.lost_on_air, seen.launched, "{at}");
            assert_eq!(counted.under_way(), seen.launched - seen.landed, "{at}");
            assert_eq!(counted.late, seen.late, "{at}");
            if radio == "perfect" {
                assert_eq!((counted.bytes, counted.lost_in_all()), (seen.bytes, 0), "{at}");
            }
        }
        for id in game.record().driven.iter().map(|(id, _)| *id).collect::<Vec<_>>() {
            let of_links: u64 =
                links.iter().filter(|((from, _), _)| *from == id).map(|(_, seen)| seen.sent).sum();
            assert_eq!(traffic.sent_by(id).sent, of_links, "{radio}, {id}");
        }
    }
}

#[test]
fn what_is_said_to_a_deaf_robot_or_by_a_mute_one_is_lost_and_counted_as_such() {
    let (deaf, mute) = (RobotId::new(Team::Home, 1), RobotId::new(Team::Home, 2));
    let mut game = Match::new(&talkative("perfect", 1));
    let mut requests = game.world_mut().resource_mut::<Requests>();
    requests.ask(Request::Robot(deaf, RobotChange::Fail(RobotFailure::Deaf)));
    requests.ask(Request::Robot(mute, RobotChange::Fail(RobotFailure::Mute)));
    for _ in 0..600 {
        game.tick();
    }
    let traffic = game.world().resource::<RadioRecord>();
    let (to_deaf, by_mute) = (traffic.sent_to(deaf), traffic.sent_by(mute));
    assert_eq!((to_deaf.delivered, by_mute.delivered), (0, 0));
    assert_eq!(by_mute.lost_to(Loss::Mute), by_mute.sent);
    assert!(to_deaf.lost_to(Loss::Deaf) > 50, "{to_deaf:?}");
    assert!(traffic.sent_by(deaf).delivered > 50, "a deaf robot is heard");
}

/// A match of a team of Hammerheads against the ball chasers, as home or as away.
fn against_chasers(team: &str, is_home: bool, radio: &str, half_minutes: f32, seed: u64) -> Match {
    let sides = if is_home { [team, "ball_chasers"] } else { ["ball_chasers", team] };
    let [home, away] = sides.map(|side| Some(side.to_owned()));
    let (radio, half_minutes) = (Some(radio.into()), Some(half_minutes));
    let choice = Choice { home, away, radio, half_minutes, seed, ..Choice::default() };
    let mut game = Match::new(&MatchPlan::read(&assets(), &choice).expect("the shipped files are sound"));
    while !game.is_over() {
        game.tick();
    }
    game
}

/// The share of play in which somebody of home drove at the ball.
fn somebody_drove(record: &Record) -> f64 {
    1.0 - record.pursuit[0].nobody.total / record.played
}

/// Section VIII: without communication the players play as they did the year before. They still go for the ball, nearly as much as
/// with a radio, and have it.
#[test]
fn every_team_of_hammerheads_plays_on_when_the_radio_is_dead() {
    for team in ["hammerheads_2000", "hammerheads_2001", "hammerheads_swap"] {
        let (mut with, mut without, mut had) = (0.0, 0.0, 0.0);
        for seed in 10_001..=10_002 {
            let game = against_chasers(team, true, "dead", 3.0, seed);
            let traffic = game.world().resource::<RadioRecord>().total();
            assert_eq!(traffic.delivered, 0, "{team}: the radio is dead");
            assert!(traffic.sent > 500, "{team}: and everybody talks");
            without += somebody_drove(game.record()) / 2.0;
            had += game.record().possession_shares()[0] / 2.0;
            with += somebody_drove(against_chasers(team, true, "good", 3.0, seed).record()) / 2.0;
        }
        assert!(without > 0.6 * with, "{team}: somebody drove at the ball for {without:.2} and {with:.2}");
        assert!(had > 0.2, "{team} had the ball for {had:.2} of the time");
    }
}

/// Sections V and VI are there to keep team mates apart: 12 matches of six minutes, sides swapped. On other seeds the Hammerheads
/// touched each other for two fifths of the time for which the chasers did, and four fifths as long had several at the ball.
#[test]
fn the_hammerheads_touch_each_other_less_than_the_ball_chasers_do() {
    let (mut touched, mut several) = ([0.0; 2], [0.0; 2]);
    for (seed, swapped) in (10_001..=10_006).flat_map(|seed| [(seed, false), (seed, true)]) {
        let game = against_chasers("hammerheads_2001", !swapped, "good", 3.0, seed);
        let sides = if swapped { [Team::Away, Team::Home] } else { Team::BOTH };
        for (i, side) in sides.into_iter().enumerate() {
            touched[i] += game.record().contacts.of_mates(side).seconds;
            several[i] += game.record().pursuit[side.index()].several.total;
        }
    }
    assert!(touched[0] < 0.8 * touched[1], "seconds of contact between mates: {touched:.0?}");
    assert!(several[0] < 1.1 * several[1], "seconds with several that drive at the ball: {several:.0?}");
}

/// A match runs for hours, and millions of messages come and go.
#[test]
fn a_match_does_not_keep_account_of_messages_that_are_gone() {
    let mut game = Match::new(&talkative("perfect", 2));
    for _ in 0..1200 {
        game.tick();
    }
    assert!(game.world().resource::<RadioRecord>().total().delivered > 1000);
    assert_eq!(game.world().removed::<InFlight>().count(), 0);
}
