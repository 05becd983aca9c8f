//! What the channel does to packets, one by one and whatever the settings.

mod measured;
mod statistics;

use proptest::prelude::*;

use super::*;
use crate::comms::radio::faults::{FaultRule, Which};
use crate::comms::radio::interference::Partition;
use crate::comms::radio::loss_model::LossModel;
use crate::comms::radio::preset::{LateTail, Latency};
use crate::comms::tcm::DataType;
use crate::ids::Team;

const SEED: Seed = Seed(2001);

struct Bench {
    channel: Channel,
    interference: Interference,
    faults: FaultRules,
    clock: Clock,
}

impl Bench {
    /// At 10 kHz, so that whole ticks hardly round a latency.
    fn new(radio: Radio) -> Bench {
        Bench::at(10_000.0, radio)
    }

    fn at(hz: f32, radio: Radio) -> Bench {
        Bench {
            channel: Channel::new(SEED, radio),
            interference: Interference::default(),
            faults: FaultRules::default(),
            clock: Clock::new(hz),
        }
    }

    fn send(&mut self, packet: &Packet) -> Delivery {
        self.send_over(3.0, packet)
    }

    fn send_over(&mut self, distance: f32, packet: &Packet) -> Delivery {
        self.channel.send(packet, distance, &self.interference, &mut self.faults, &self.clock)
    }

    /// One packet per tick on one link.
    fn deliveries(&mut self, n: usize) -> Vec<Delivery> {
        let mut deliveries = Vec::with_capacity(n);
        for _ in 0..n {
            deliveries.push(self.send(&packet(0, 1)));
            self.clock.tick += 1;
        }
        deliveries
    }

    fn reason(&mut self, from: u8, to: u8) -> Option<Loss> {
        self.send(&packet(from, to)).lost
    }
}

fn home(number: u8) -> RobotId {
    RobotId::new(Team::Home, number)
}

fn packet(from: u8, to: u8) -> Packet {
    long_packet(from, to, 40)
}

fn long_packet(from: u8, to: u8, bytes: usize) -> Packet {
    Packet { kind: DataType::POSITION, from: home(from), to: home(to), bytes: vec![0; bytes].into() }
}

fn perfect() -> Radio {
    Radio {
        name: "Test".into(),
        description: String::new(),
        latency: Latency::default(),
        loss: LossModel::None,
        duplication: 0.0,
        late: None,
        stalls: None,
        range: None,
        budget: None,
        air: None,
    }
}

fn losing(loss: LossModel) -> Radio {
    Radio { loss, ..perfect() }
}

fn jittery() -> Radio {
    Radio { latency: Latency { fixed: 0.005, jitter: 0.01 }, ..perfect() }
}

fn lost(deliveries: &[Delivery]) -> Vec<bool> {
    deliveries.iter().map(|delivery| delivery.lost.is_some()).collect()
}

fn drop_all() -> FaultRule {
    FaultRule { kind: None, from: None, to: None, between: None, which: Which::All, act: Act::Drop }
}

#[test]
fn a_perfect_radio_delivers_everything_once_and_in_the_next_tick() {
    for (tick, delivery) in Bench::at(60.0, perfect()).deliveries(1000).iter().enumerate() {
        let arrival = Arrival { due: tick as u64 + 1, late: false, duplicate: false };
        assert_eq!((delivery.arrivals.as_slice(), delivery.lost), ([arrival].as_slice(), None));
    }
}

#[test]
fn nothing_is_heard_beyond_the_range() {
    let mut bench = Bench::new(Radio { range: Some(5.0), ..perfect() });
    let mut lost = |distance| bench.send_over(distance, &packet(0, 1)).lost;
    assert_eq!([lost(4.9), lost(5.0), lost(5.1)], [None, None, Some(Loss::Range)]);
}

#[test]
fn a_budget_allows_a_burst_and_refuses_a_message_longer_than_the_bucket() {
    let budget = Some(Budget { bytes_per_second: 100.0, burst: 100.0, shared_by: SharedBy::Link });
    let mut bench = Bench::at(60.0, Radio { budget, ..perfect() });
    let burst = [bench.reason(0, 1), bench.reason(0, 1), bench.reason(0, 1)];
    assert_eq!(burst, [None, None, Some(Loss::Budget)]);
    bench.clock.tick += 6000;
    assert_eq!(bench.send(&long_packet(0, 1, 101)).lost, Some(Loss::Budget));
    assert_eq!(bench.send(&long_packet(0, 1, 100)).lost, None);
}

#[test]
fn jamming_and_separation_lose_everything_and_then_nothing() {
    let mut bench = Bench::new(perfect());
    bench.interference.jammed = true;
    assert_eq!(bench.reason(0, 1), Some(Loss::Jammed));
    bench.interference.jammed = false;
    bench.interference.cut_off.insert(home(0));
    assert_eq!([bench.reason(0, 1), bench.reason(1, 0)], [Some(Loss::CutOff); 2]);
    bench.interference.cut_off.clear();
    let wall = Partition { reason: "wall".into(), one: [home(0)].into(), other: [home(1)].into() };
    bench.interference.partitions.push(wall);
    assert_eq!(
        [bench.reason(0, 1), bench.reason(1, 0), bench.reason(1, 2)],
        [Some(Loss::CutOff), Some(Loss::CutOff), None]
    );
    bench.interference.partitions.clear();
    assert_eq!(bench.reason(0, 1), None);
}

#[test]
fn an_extra_delay_holds_everything_up_and_makes_it_late() {
    let mut bench = Bench::at(60.0, Radio { duplication: 1.0, ..perfect() });
    bench.interference.extra_delay = 0.5;
    let delivery = bench.send(&packet(0, 1));
    assert!(delivery.arrivals.iter().all(|copy| copy.due == 30 && copy.late));
}

#[test]
fn fault_rules_drop_delay_and_double_packets() {
    let mut bench = Bench::at(60.0, perfect());
    let rule = |n, act| FaultRule { which: Which::Nth(n), act, ..drop_all() };
    bench.faults = FaultRules::new([
        rule(1, Act::Drop),
        rule(2, Act::Delay(1.5)),
        rule(3, Act::Duplicate(0.5)),
        rule(4, Act::Duplicate(0.5)),
        rule(4, Act::Delay(1.0)),
    ]);
    let mut copies = || bench.send(&packet(0, 1)).arrivals.to_vec();
    let arrival = |due, late, duplicate| Arrival { due, late, duplicate };
    assert_eq!(copies(), []);
    assert_eq!(copies(), [arrival(90, true, false)]);
    assert_eq!(copies(), [arrival(1, false, false), arrival(30, true, true)]);
    assert_eq!(copies(), [arrival(60, true, false), arrival(90, true, true)]);
    assert_eq!(copies(), [arrival(1, false, false)]);
}

#[test]
fn of_several_reasons_the_first_counts() {
    let budget = Some(Budget { bytes_per_second: 1.0, burst: 1.0, shared_by: SharedBy::All });
    let radio = Radio { range: Some(1.0), budget, ..losing(LossModel::Independent(1.0)) };
    let mut bench = Bench::new(radio.clone());
    bench.interference =
        Interference { extra_loss: 1.0, jammed: true, cut_off: [home(0)].into(), ..Interference::default() };
    bench.faults.add(drop_all());
    let mut reasons = vec![bench.reason(0, 1)];
    bench.faults = FaultRules::default();
    reasons.push(bench.reason(0, 1));
    bench.channel.set_radio(Radio { budget: None, ..radio });
    reasons.push(bench.reason(0, 1));
    bench.interference.jammed = false;
    reasons.push(bench.reason(0, 1));
    bench.interference.cut_off.clear();
    reasons.push(bench.reason(0, 1));
    bench.channel.set_radio(losing(LossModel::Independent(1.0)));
    reasons.push(bench.reason(0, 1));
    bench.channel.set_radio(perfect());
    reasons.push(bench.reason(0, 1));
    let (first, last) = (Loss::Fault.index(), Loss::Extra.index());
    assert_eq!(reasons, Loss::ALL.map(Some)[first..=last]);
}

#[test]
fn another_radio_is_in_force_at_once_and_begins_good() {
    let stuck = LossModel::GilbertElliott { to_bad: 1.0, to_good: 0.0, loss_in_good: 0.0, loss_in_bad: 1.0 };
    let mut bench = Bench::new(losing(stuck));
    assert_eq!(bench.reason(0, 1), Some(Loss::Chance));
    let calm = LossModel::GilbertElliott { to_bad: 0.0, to_good: 0.0, loss_in_good: 0.0, loss_in_bad: 1.0 };
    bench.channel.set_radio(losing(calm));
    assert_eq!((bench.channel.radio().loss, bench.reason(0, 1)), (calm, None));
}

#[test]
fn another_radio_begins_with_full_buckets() {
    let budget = Some(Budget { bytes_per_second: 1.0, burst: 40.0, shared_by: SharedBy::Sender });
    let radio = Radio { budget, ..perfect() };
    let mut bench = Bench::new(radio.clone());
    assert_eq!([bench.reason(0, 1), bench.reason(0, 2)], [None, Some(Loss::Budget)]);
    bench.channel.set_radio(radio);
    assert_eq!([bench.reason(0, 1), bench.reason(0, 2)], [None, Some(Loss::Budget)]);
}

#[test]
fn the_same_seed_gives_the_same_fates_and_another_seed_others() {
    let radio = Radio { duplication: 0.1, ..losing(LossModel::Independent(0.3)) };
    let deliveries = |seed| {
        let mut bench = Bench { channel: Channel::new(Seed(seed), radio.clone()), ..Bench::new(perfect()) };
        bench.deliveries(1000)
    };
    assert_eq!(deliveries(1), deliveries(1));
    assert_ne!(deliveries(1), deliveries(2));
}

fn any_radio() -> impl Strategy<Value = Radio> {
    let losses = (0.0f32..0.5, 0.01f32..1.0, 0.0f32..1.0, 0.0f32..1.0).prop_map(
        |(to_bad, to_good, loss_in_good, loss_in_bad)| LossModel::GilbertElliott {
            to_bad,
            to_good,
            loss_in_good,
            loss_in_bad,
        },
    );
    (losses, 0.0f32..0.2, 0.0f32..0.2, 0.0f32..1.0, 0.0f32..1.0).prop_map(
        |(loss, fixed, jitter, duplication, share)| {
            let late = Some(LateTail { share, min: 0.1, max: 1.0 });
            Radio { latency: Latency { fixed, jitter }, duplication, late, ..losing(loss) }
        },
    )
}

proptest! {
    #[test]
    fn a_packet_is_either_lost_or_arrives_in_a_later_tick(
        radio in any_radio(),
        extra_loss in 0.0f32..1.0,
        extra_delay in 0.0f32..1.0,
    ) {
        let mut bench = Bench::at(60.0, radio);
        bench.interference = Interference { extra_loss, extra_delay, ..Interference::default() };
        for (tick, delivery) in (0..).zip(bench.deliveries(100)) {
            prop_assert_eq!(delivery.arrivals.is_empty(), delivery.lost.is_some());
            prop_assert!(delivery.arrivals.iter().all(|copy| copy.due > tick));
            prop_assert!(delivery.arrivals.iter().enumerate().all(|(place, copy)| copy.duplicate == (place > 0)));
        }
    }

    #[test]
    fn other_mechanisms_do_not_change_which_messages_are_lost(radio in any_radio(), jam in 0usize..100) {
        let plain = lost(&Bench::at(60.0, losing(radio.loss)).deliveries(210));
        let mut bench = Bench::at(60.0, radio);
        let mut all = lost(&bench.deliveries(jam));
        prop_assert_eq!(&all, &plain[..jam]);
        bench.interference.jammed = true;
        bench.deliveries(10);
        bench.interference.jammed = false;
        all = lost(&bench.deliveries(100));
        prop_assert_eq!(&all, &plain[jam + 10..jam + 110]);
    }

    #[test]
    fn duplicates_do_not_change_the_packets_themselves(radio in any_radio()) {
        let firsts = |radio| {
            let deliveries = Bench::at(60.0, radio).deliveries(100);
            deliveries.iter().map(|delivery| delivery.arrivals.first().copied()).collect::<Vec<_>>()
        };
        prop_assert_eq!(firsts(Radio { duplication: 0.0, ..radio.clone() }), firsts(radio));
    }
}
