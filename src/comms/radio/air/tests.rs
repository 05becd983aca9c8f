use proptest::prelude::*;

use super::*;
use crate::comms::tcm::{DataType, Peer};
use crate::ids::Team;

fn said(from: u8, bytes: usize) -> Datagram {
    let robot = |number: u8| RobotId::new(Team::BOTH[usize::from(number % 2)], number / 2);
    Datagram {
        from: robot(from),
        to: Peer::Team(0),
        kind: DataType::POSITION,
        bytes: vec![from; bytes].into(),
    }
}

/// How many datagrams are said, come off the air, and are heard, in this order.
type Counts = [usize; 3];

/// So many stations each say something with this probability in each of so many ticks, and are silent in as many as come then.
fn talk(
    airtime: &Airtime,
    mut clock: Clock,
    (stations, bytes, probability): (u8, usize, f32),
    (loud, silent): (u32, u32),
) -> Counts {
    let (mut air, mut dice) = (Air::new(Seed(7)), Dice::new(Seed(8), "talk", None));
    let [mut all, mut off, mut clear] = [0; 3];
    for tick in 0..loud + silent {
        let speaks = |dice: &mut Dice| tick < loud && dice.chance(probability);
        let said: Vec<_> =
            (0..stations).filter(|_| speaks(&mut dice)).map(|from| said(from, bytes)).collect();
        all += said.len();
        let fates = air.tick(airtime, said, &clock);
        off += fates.len();
        clear += fates.iter().filter(|fate| matches!(fate, OffAir::Clear(_))).count();
        clock.tick += 1;
    }
    [all, off, clear]
}

/// The share of datagrams that were heard, and that of those that came off the air by the end.
fn delivered(airtime: &Airtime, stations: u8, bytes: usize, probability: f32) -> (f64, f64) {
    let [all, off, clear] = talk(airtime, Clock::new(60.0), (stations, bytes, probability), (6_000, 0));
    (clear as f64 / off.max(1) as f64, off as f64 / all.max(1) as f64)
}

#[test]
fn who_speaks_alone_is_always_heard() {
    let (heard, off) = delivered(&Airtime::default(), 1, 100, 1.0);
    assert_eq!((heard, off), (1.0, 1.0));
}

#[test]
fn the_more_robots_speak_the_more_of_them_collide() {
    let heard = [2, 8, 22].map(|stations| delivered(&Airtime::default(), stations, 200, 0.25).0);
    assert!(heard[0] > 0.97 && heard[0] > heard[1] && heard[1] > heard[2] && heard[2] > 0.3, "{heard:?}");
}

#[test]
fn a_channel_that_is_full_loses_what_waits_for_too_long() {
    // 60 frames a second of 13 ms.
    let slow = Airtime { bits_per_second: 1e5, queue: 3, ..Airtime::default() };
    let (heard, _) = delivered(&slow, 4, 100, 1.0);
    assert!(heard < 0.4, "{heard}");
}

#[test]
fn what_is_said_to_all_is_one_frame() {
    let mut air = Air::new(Seed(7));
    let bytes: std::sync::Arc<[u8]> = vec![1; 10_000].into();
    let to_all: Vec<Datagram> = (0..3).map(|_| Datagram { bytes: bytes.clone(), ..said(0, 0) }).collect();
    let slow = Airtime { queue: 1, ..Airtime::default() };
    let fates = air.tick(&slow, to_all, &Clock::new(60.0));
    assert!(fates.len() == 3 && fates.iter().all(|fate| matches!(fate, OffAir::Clear(_))), "{fates:?}");
}

#[test]
fn two_that_begin_in_one_slot_collide_and_others_wait_for_them() {
    let airtime = Airtime { window: 0, ..Airtime::default() };
    let (mut air, clock) = (Air::new(Seed(7)), Clock::new(60.0));
    air.free = 0.1;
    // The channel is busy for all of them, and without slots to draw they begin together.
    let fates = air.tick(&airtime, vec![said(0, 100), said(1, 100)], &clock);
    assert!(fates.is_empty());
    let later = Clock { tick: 6, ..clock };
    let fates = air.tick(&airtime, Vec::new(), &later);
    assert!(fates.len() == 2 && fates.iter().all(|fate| matches!(fate, OffAir::Lost(_))), "{fates:?}");
}

/// Which share of frames ns-3 delivers.
#[derive(Debug, serde::Deserialize)]
struct Ns3Row {
    stations: u8,
    /// The share of the time that all frames together would take.
    load: f64,
    /// Where all stations are equally loud.
    equal: f64,
    /// Where they stand on a pitch, and a frame that is much louder than the other one is heard.
    pitch: f64,
}

/// The share of frames of 200 bytes that are heard if so many stations speak at random moments, as in `ns3_values.py`.
fn heard_at(load: f64, stations: u8) -> f64 {
    const TICKS_PER_SECOND: u32 = 1000;
    let airtime = Airtime::default();
    let each = load / airtime.frame(200) / f64::from(stations) / f64::from(TICKS_PER_SECOND);
    let ticks = (20 * TICKS_PER_SECOND, TICKS_PER_SECOND);
    let [all, _, clear] =
        talk(&airtime, Clock::new(TICKS_PER_SECOND as f32), (stations, 200, each as f32), ticks);
    clear as f64 / all as f64
}

#[test]
fn as_many_frames_are_heard_as_in_ns3() {
    let rows = csv::Reader::from_reader(&include_bytes!("../../../../tests/airtime/ns3_values.csv")[..])
        .into_deserialize()
        .collect::<Result<Vec<Ns3Row>, _>>()
        .unwrap();
    assert_eq!(rows.len(), 35);
    for row in rows {
        let ours = heard_at(row.load, row.stations);
        assert!((ours - row.equal).abs() < 0.05, "{row:?}, and {ours}");
        assert!(ours < row.pitch + 0.02, "{row:?}, and {ours}");
    }
}

proptest! {
    #[test]
    fn every_datagram_comes_off_the_air_once(
        talk in prop::collection::vec(prop::collection::vec((0u8..8, 1usize..400), 0..10), 1..40),
        window in 0u16..40,
        queue in 1usize..6,
    ) {
        let airtime = Airtime { window, queue, ..Airtime::default() };
        let (mut air, mut clock) = (Air::new(Seed(1)), Clock::new(60.0));
        let all: usize = talk.iter().map(Vec::len).sum();
        let mut off = 0;
        for tick in talk {
            let tick = tick.into_iter().map(|(from, bytes)| said(from, bytes)).collect();
            off += air.tick(&airtime, tick, &clock).len();
            clock.tick += 1;
        }
        for _ in 0..200 {
            off += air.tick(&airtime, Vec::new(), &clock).len();
            clock.tick += 1;
        }
        prop_assert_eq!(off, all);
    }
}
