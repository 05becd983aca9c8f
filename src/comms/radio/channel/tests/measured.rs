//! The radios of `odin` and `nora` against what was measured of the real ones: as many packets at 100 Hz as there.

use super::*;
use crate::data::ron_options;

/// What was published of half an hour of echoes (SSL-A-Team, 2026).
struct Measured {
    radio: &'static str,
    packets: usize,
    /// Share of the packets.
    lost: f64,
    /// Packets lost in a row.
    longest: usize,
    /// Round trips at 0, 50, 95, 99 and 100 %, ms.
    round_trips: [f64; 5],
}

const ODIN: Measured = Measured {
    radio: include_str!("../../../../../assets/radios/odin.ron"),
    packets: 179_218,
    lost: 0.0186,
    longest: 86,
    round_trips: [4.2, 5.7, 15.6, 108.9, 1836.0],
};
const NORA: Measured = Measured {
    radio: include_str!("../../../../../assets/radios/nora.ron"),
    packets: 179_998,
    lost: 0.0141,
    longest: 4,
    round_trips: [6.5, 7.2, 8.2, 9.7, 116.0],
};

/// Within a share of what was measured.
#[track_caller]
fn assert_near(what: &str, is: f64, measured: f64, share: f64) {
    assert!((is / measured - 1.0).abs() < share, "{what}: {is:.4}, and {measured} were measured");
}

/// What a link did with as many packets.
struct Link {
    lost: f64,
    longest: f64,
    /// Of those that arrived, in order, ms.
    one_way: Vec<f64>,
}

impl Link {
    fn measure(bench: &mut Bench, to: u8, packets: usize) -> Link {
        let (mut one_way, mut in_a_row, mut longest) = (Vec::new(), 0, 0);
        for _ in 0..packets {
            let sent = bench.clock.tick;
            match bench.send(&packet(0, to)).arrivals.first() {
                Some(arrival) => {
                    one_way.push((arrival.due - sent) as f64 / 100.0);
                    in_a_row = 0;
                }
                None => in_a_row += 1,
            }
            longest = longest.max(in_a_row);
            bench.clock.tick += 1000;
        }
        one_way.sort_by(f64::total_cmp);
        Link { lost: 1.0 - one_way.len() as f64 / packets as f64, longest: f64::from(longest), one_way }
    }

    fn round_trip(&self, share: f64) -> f64 {
        2.0 * self.one_way[((self.one_way.len() - 1) as f64 * share) as usize]
    }
}

/// As many packets over each of five links: what one packet or one burst decides differs from half an hour to the next, so the middle one
/// of the five counts.
#[track_caller]
fn assert_as_measured(measured: &Measured) {
    let radio = ron_options().from_str(measured.radio).expect("the preset is sound");
    let mut bench = Bench::at(100_000.0, radio);
    let links: Vec<Link> = (1..=5).map(|to| Link::measure(&mut bench, to, measured.packets)).collect();
    let middle = |figure: &dyn Fn(&Link) -> f64| {
        let mut figures: Vec<f64> = links.iter().map(figure).collect();
        figures.sort_by(f64::total_cmp);
        figures[figures.len() / 2]
    };
    assert_near("lost", middle(&|link| link.lost), measured.lost, 0.1);
    assert_near("longest burst", middle(&|link| link.longest), measured.longest as f64, 0.3);
    for (share, round_trip) in [0.0, 0.5, 0.95, 0.99, 1.0].into_iter().zip(measured.round_trips) {
        let what = format!("round trip at {share}");
        assert_near(&what, middle(&|link| link.round_trip(share)), round_trip, 0.2);
    }
}

#[test]
fn odin_loses_and_delays_as_it_was_measured() {
    assert_as_measured(&ODIN);
}

#[test]
fn nora_loses_and_delays_as_it_was_measured() {
    assert_as_measured(&NORA);
}

/// What is sent in one stall is late together.
#[test]
fn delays_of_odin_are_correlated() {
    let radio = ron_options().from_str(ODIN.radio).expect("the preset is sound");
    let mut bench = Bench::at(10_000.0, radio);
    let delays = (0..100_000).map(|_| {
        bench.clock.tick += 100;
        bench.send(&packet(0, 1)).arrivals.first().map_or(0, |arrival| arrival.due - bench.clock.tick)
    });
    let slow: Vec<bool> = delays.map(|ticks| ticks > 200).collect();
    let after_slow = slow.windows(2).filter(|pair| pair[0] && pair[1]).count();
    let share = after_slow as f64 / slow.iter().filter(|slow| **slow).count() as f64;
    assert!(share > 0.5, "one slow packet is followed by another: {share}");
}
