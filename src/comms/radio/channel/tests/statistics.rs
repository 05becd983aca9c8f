//! The channel against its own statistics. Seeds are fixed; a tolerance is four standard deviations of what is measured.

use super::*;

const N: usize = 100_000;

fn share(events: &[bool]) -> f64 {
    events.iter().filter(|event| **event).count() as f64 / events.len() as f64
}

/// Whether a share of `n` independent events is as its chance has it.
fn fits(measured: f64, chance: f64, n: usize) -> bool {
    (measured - chance).abs() <= 4.0 * (chance * (1.0 - chance) / n as f64).sqrt()
}

fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    (mean, (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n).sqrt())
}

/// From sending to arrival of packets that are all sent in one tick, s.
fn latencies(mut bench: Bench) -> Vec<f64> {
    let arrivals = (0..N).map(|_| bench.send(&packet(0, 1)).arrivals[0].due);
    arrivals.map(|ticks| ticks as f64 / 10_000.0).collect()
}

#[test]
fn loss_0_loses_nothing_and_loss_1_everything() {
    let elliott =
        |loss| LossModel::GilbertElliott { to_bad: 0.3, to_good: 0.3, loss_in_good: loss, loss_in_bad: loss };
    for model in [LossModel::Independent(0.0), elliott(0.0)] {
        assert_eq!(share(&lost(&Bench::new(losing(model)).deliveries(N))), 0.0);
    }
    for model in [LossModel::Independent(1.0), elliott(1.0)] {
        let deliveries = Bench::new(losing(model)).deliveries(N);
        assert!(
            deliveries
                .iter()
                .all(|delivery| delivery.lost == Some(Loss::Chance) && delivery.arrivals.is_empty())
        );
    }
}

#[test]
fn independent_losses_have_the_asked_share_and_do_not_cling_together() {
    for chance in [0.02f32, 0.3] {
        let lost = lost(&Bench::new(losing(LossModel::Independent(chance))).deliveries(N));
        assert!(fits(share(&lost), f64::from(chance), N), "{}", share(&lost));
        let pairs: Vec<bool> = lost.chunks_exact(2).map(|pair| pair[0] && pair[1]).collect();
        assert!(fits(share(&pairs), f64::from(chance).powi(2), N / 2), "{}", share(&pairs));
    }
}

#[test]
fn losses_in_bursts_have_the_asked_share_and_length() {
    let models = [
        LossModel::GilbertElliott { to_bad: 0.0333, to_good: 0.1333, loss_in_good: 0.0, loss_in_bad: 1.0 },
        LossModel::GilbertElliott { to_bad: 0.1, to_good: 0.1, loss_in_good: 0.1, loss_in_bad: 0.9 },
        LossModel::GilbertElliott { to_bad: 0.0056, to_good: 0.05, loss_in_good: 0.0, loss_in_bad: 1.0 },
    ];
    for model in models {
        let lost = lost(&Bench::new(losing(model)).deliveries(N));
        let LossModel::GilbertElliott { to_bad, to_good, .. } = model else { unreachable!() };
        // Neighbours are correlated by at most 1 - to_bad - to_good, which widens the deviation of a share.
        let kept = f64::from(1.0 - to_bad - to_good);
        let (mean, n) = (f64::from(model.mean_loss()), N as f64);
        let deviation = (mean * (1.0 - mean) / n * (1.0 + kept) / (1.0 - kept)).sqrt();
        assert!((share(&lost) - mean).abs() < 4.0 * deviation, "{model:?}: {}", share(&lost));

        let bursts: Vec<f64> =
            lost.chunk_by(|a, b| a == b).filter(|run| run[0]).map(|run| run.len() as f64).collect();
        let (length, deviation) = mean_and_deviation(&bursts);
        let tolerance = 4.0 * deviation / (bursts.len() as f64).sqrt();
        assert!((length - f64::from(model.mean_burst())).abs() < tolerance, "{model:?}: {length}");
    }
}

#[test]
fn latency_is_a_fixed_time_and_an_exponential_jitter() {
    let latencies = latencies(Bench::new(jittery()));
    let (mean, deviation) = mean_and_deviation(&latencies);
    // Mean and deviation of an exponential distribution are the same; the latter scatters as its square root of two.
    let tolerance = 4.0 * 0.01 / (N as f64).sqrt();
    assert!((mean - 0.015).abs() < tolerance, "{mean}");
    assert!((deviation - 0.01).abs() < 1.5 * tolerance, "{deviation}");
    assert!(latencies.iter().all(|latency| *latency >= 0.005));
    let long: Vec<bool> = latencies.iter().map(|latency| *latency > 0.035).collect();
    assert!(fits(share(&long), libm::exp(-3.0), N), "{}", share(&long));
}

#[test]
fn messages_overtake_each_other_only_where_the_latency_varies() {
    let overtaken = |radio| {
        let due: Vec<u64> = Bench::at(1000.0, radio)
            .deliveries(1000)
            .iter()
            .map(|delivery| delivery.arrivals[0].due)
            .collect();
        due.windows(2).filter(|pair| pair[1] < pair[0]).count()
    };
    assert!(overtaken(jittery()) > 300);
    assert_eq!(overtaken(Radio { latency: Latency { fixed: 0.1, jitter: 0.0 }, ..perfect() }), 0);
}

#[test]
fn the_late_tail_has_its_share_and_its_bounds() {
    let late = Some(LateTail { share: 0.05, min: 0.2, max: 1.5 });
    let deliveries = Bench::new(Radio { late, ..perfect() }).deliveries(N);
    let held: Vec<(bool, f64)> = (0..)
        .zip(&deliveries)
        .map(|(tick, delivery)| {
            let arrival = delivery.arrivals[0];
            (arrival.late, (arrival.due - tick) as f64 / 10_000.0)
        })
        .collect();
    assert!(fits(share(&held.iter().map(|(late, _)| *late).collect::<Vec<_>>()), 0.05, N));
    let tail: Vec<f64> = held.iter().filter(|(late, _)| *late).map(|(_, delay)| *delay).collect();
    assert!(tail.iter().all(|delay| (0.2..=1.5001).contains(delay)));
    assert!(held.iter().all(|(late, delay)| *late || *delay <= 0.0001));
    let (mean, _) = mean_and_deviation(&tail);
    let tolerance = 4.0 * 1.3 / (12.0 * tail.len() as f64).sqrt();
    assert!((mean - 0.85).abs() < tolerance, "{mean}");
}

#[test]
fn duplicates_have_their_share_and_a_latency_of_their_own() {
    let deliveries = Bench::new(Radio { duplication: 0.2, ..jittery() }).deliveries(N);
    let doubled: Vec<&Delivery> = deliveries.iter().filter(|delivery| delivery.arrivals.len() == 2).collect();
    assert!(fits(doubled.len() as f64 / N as f64, 0.2, N), "{}", doubled.len());
    assert!(doubled.iter().all(|delivery| !delivery.arrivals[0].duplicate && delivery.arrivals[1].duplicate));
    let first: Vec<bool> = doubled
        .iter()
        .filter(|delivery| delivery.arrivals[0].due != delivery.arrivals[1].due)
        .map(|delivery| delivery.arrivals[1].due < delivery.arrivals[0].due)
        .collect();
    assert!(fits(share(&first), 0.5, first.len()), "the copy came first in {}", share(&first));
}

#[test]
fn a_budget_lets_its_bytes_per_second_through_in_the_long_run() {
    // Three links, of two senders, with 2400 B/s each.
    let links = [(0, 1), (0, 2), (3, 1)];
    let passed = |shared_by| {
        let budget = Some(Budget { bytes_per_second: 1000.0, burst: 400.0, shared_by });
        let mut bench = Bench::at(60.0, Radio { budget, ..perfect() });
        let mut bytes = [0.0; 3];
        for _ in 0..60 * 600 {
            for (sum, (from, to)) in bytes.iter_mut().zip(links) {
                let delivery = bench.send(&packet(from, to));
                assert!(matches!(delivery.lost, None | Some(Loss::Budget)));
                *sum += 40.0 * delivery.arrivals.len() as f64;
            }
            bench.clock.tick += 1;
        }
        bytes
    };
    // The bucket of the start and what flows in during ten minutes, up to the message that does not fit yet.
    let full = |bytes: f64| (600_340.0..=600_400.0).contains(&bytes);
    let [a, b, c] = passed(SharedBy::Link);
    assert!(full(a) && full(b) && full(c), "{a} {b} {c}");
    let [a, b, c] = passed(SharedBy::Sender);
    assert!(full(a + b) && full(c), "{a} {b} {c}");
    let [a, b, c] = passed(SharedBy::All);
    assert!(full(a + b + c), "{a} {b} {c}");
}

#[test]
fn extra_loss_comes_on_top_of_the_radios_own() {
    let mut bench = Bench::new(losing(LossModel::Independent(0.2)));
    bench.interference.extra_loss = 0.5;
    let deliveries = bench.deliveries(N);
    let to =
        |reason| share(&deliveries.iter().map(|delivery| delivery.lost == Some(reason)).collect::<Vec<_>>());
    assert!(fits(to(Loss::Chance), 0.2, N) && fits(to(Loss::Extra), 0.4, N), "{}", to(Loss::Extra));
}

#[test]
fn links_are_independent_of_each_other() {
    let radio = losing(LossModel::Independent(0.5));
    let alone = lost(&Bench::new(radio.clone()).deliveries(N));
    let mut bench = Bench::new(radio);
    for (other_from, other_to) in [(1, 0), (0, 2), (2, 1)] {
        bench.channel = Channel::new(SEED, bench.channel.radio().clone());
        let mut agree = Vec::with_capacity(N);
        for expected in &alone {
            let other = bench.reason(other_from, other_to).is_some();
            assert_eq!(bench.reason(0, 1).is_some(), *expected);
            agree.push(other == *expected);
        }
        assert!(fits(share(&agree), 0.5, N), "{other_from} to {other_to}: {}", share(&agree));
    }
}
