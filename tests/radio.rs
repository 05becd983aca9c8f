//! The radio in whole matches: what is counted, what is lost, what a dead radio leaves.

use std::collections::{BTreeMap, BTreeSet};

use bevy::prelude::*;
use touchline::comms::radio::{InFlight, Loss, RadioRecord, TransmissionState};
use touchline::game::record::{CROWD, Record};
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

/// Section VIII: without communication the players play as they did the year before.
#[test]
fn every_team_of_hammerheads_plays_on_when_the_radio_is_dead() {
    for team in ["hammerheads_2000", "hammerheads_2001", "hammerheads_swap"] {
        let (mut goals, mut had) = (0, 0.0);
        for seed in 1..=4 {
            let choice = Choice {
                home: Some(team.into()),
                radio: Some("dead".into()),
                half_minutes: Some(5.0),
                seed,
                ..Choice::default()
            };
            let plan = MatchPlan::read(&assets(), &choice).expect("the shipped files are sound");
            let mut game = Match::new(&plan);
            while !game.is_over() {
                game.tick();
            }
            let traffic = game.world().resource::<RadioRecord>().total();
            assert_eq!(traffic.delivered, 0, "{team}: the radio is dead");
            assert!(traffic.sent > 1000, "{team}: and everybody talks");
            goals += game.state().score[0];
            had += game.record().possession_shares()[0] / 4.0;
        }
        assert!(goals >= 4, "{team} scored {goals} goals in 40 minutes");
        assert!(had > 0.3, "{team} had the ball for {had:.2} of the time");
    }
}

/// Forty matches of ten minutes, sides swapped: goals for and against, and the shares of the time with two or more team
/// mates within a metre of the ball. Nobody promises goals: the chasers drive at the same mean speeds, and what the paper's
/// collaboration costs stays as it is.
#[test]
fn the_hammerheads_crowd_the_ball_less_than_the_ball_chasers() {
    let (mut goals, mut crowd) = ([0; 2], [0.0; 2]);
    for (seed, swapped) in (1..=20).flat_map(|seed| [(seed, false), (seed, true)]) {
        let sides = if swapped { [1, 0] } else { [0, 1] };
        let [home, away] = sides.map(|team| Some(["hammerheads_2001", "ball_chasers"][team].to_owned()));
        let choice = Choice { home, away, half_minutes: Some(5.0), seed, ..Choice::default() };
        let mut game = Match::new(&MatchPlan::read(&assets(), &choice).expect("the shipped files are sound"));
        while !game.is_over() {
            game.tick();
        }
        let record: &Record = game.record();
        for (team, side) in sides.into_iter().enumerate() {
            goals[team] += game.state().score[side];
            crowd[team] += record.crowding.seconds(CROWD)[side] / record.played / 40.0;
        }
    }
    println!(
        "hammerheads_2001 {}:{} ball_chasers, crowding {:.3} against {:.3}",
        goals[0], goals[1], crowd[0], crowd[1]
    );
    assert!(goals.iter().all(|goals| *goals > 40), "both score now and then: {goals:?}");
    assert!(crowd[0] < crowd[1], "{crowd:?}");
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
