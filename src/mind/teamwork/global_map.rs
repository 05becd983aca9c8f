//! The global map (TeamChaos, section 2): where the ball is by all that a robot saw itself and heard from its team mates.
//!
//! Reports of the ball are placed on the map with the positions of those who tell. Each is worth the more the nearer its
//! reporter stood to the ball and the fresher it is. Those that contradict the others are left out. The world model has the
//! other robots.

use bevy::prelude::*;
use smallvec::SmallVec;

use crate::comms::messages::BallReport;
use crate::ids::PlayerNumber;
use crate::strategy::teamwork::MapFusion;

/// What a robot's team mates said last of the ball.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlobalMap(SmallVec<[Reported; 4]>);

/// What one of them said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reported {
    /// The reporter's number.
    pub by: PlayerNumber,
    /// m in the team frame.
    pub position: Vec2,
    /// Milliseconds on the sender's clock when it saw the ball there.
    seen: u32,
    /// The tick in which it was heard.
    pub heard: u64,
}

/// A place of the ball, and how far off it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallEstimate {
    /// m in the team frame.
    pub position: Vec2,
    /// The standard deviation along each axis, m.
    pub deviation: f32,
}

impl GlobalMap {
    /// Takes note of a report; one that was overtaken by a later one is no news.
    pub fn hear(&mut self, by: PlayerNumber, report: &BallReport, tick: u64) {
        let seen = report.time.saturating_sub((report.age * 1000.0) as u32);
        let reported = Reported { by, position: report.position, seen, heard: tick };
        match self.0.iter_mut().find(|known| known.by == by) {
            Some(known) if seen < known.seen => {}
            Some(known) => *known = reported,
            None => self.0.push(reported),
        }
    }

    /// Forgets what was heard longer ago than `memory` ticks.
    pub fn forget(&mut self, tick: u64, memory: u64) {
        self.0.retain(|reported| tick.saturating_sub(reported.heard) <= memory);
    }

    /// Where the ball was seen last, m in the team frame; of reports of one time that of the lowest number.
    pub fn freshest(&self) -> Option<Vec2> {
        let order = |reported: &&Reported| (reported.seen, std::cmp::Reverse(reported.by));
        self.0.iter().max_by_key(order).map(|reported| reported.position)
    }

    /// The estimates that the mates' reports come to at `now`, s on their clocks. `place` says where a reporter is; one that is
    /// unknown is taken to have seen the ball from `far`, m.
    pub fn estimates(
        &self,
        fusion: &MapFusion,
        now: f32,
        far: f32,
        place: impl Fn(PlayerNumber) -> Option<Vec2>,
    ) -> impl Iterator<Item = BallEstimate> {
        self.0.iter().map(move |reported| {
            let distance = place(reported.by).map_or(far, |at| at.distance(reported.position));
            let age = (now - reported.seen as f32 / 1000.0).max(0.0);
            BallEstimate { position: reported.position, deviation: fusion.deviation(distance, age) }
        })
    }

    /// In the order in which the team mates were first heard.
    pub fn iter(&self) -> impl Iterator<Item = &Reported> {
        self.0.iter()
    }
}

impl MapFusion {
    /// How far a team mate's report may be off that saw the ball from a distance, m, some time ago, s. In m.
    pub fn deviation(&self, distance: f32, age: f32) -> f32 {
        Vec3::new(self.position, self.range * distance, self.rolling * age).length()
    }

    /// As [`deviation`](MapFusion::deviation) of what a robot saw itself: where it stands does not matter then.
    pub fn own_deviation(&self, distance: f32, age: f32) -> f32 {
        Vec2::new(self.range * distance, self.rolling * age).length()
    }
}

/// An estimate is never taken for better than this, m.
const BEST: f32 = 0.01;

/// One estimate of those that agree: their mean, weighted by the inverse of their variances. Two agree if they are no more than
/// `gate` deviations of their difference apart. Where not all agree with one another, those count that have the greatest weight
/// together with one of them; of equals, those with the first.
pub fn fuse(estimates: &[BallEstimate], gate: f32) -> Option<BallEstimate> {
    let weight = |estimate: &BallEstimate| estimate.deviation.max(BEST).powi(-2);
    let agree = |a: &BallEstimate, b: &BallEstimate| {
        let deviation = Vec2::new(a.deviation.max(BEST), b.deviation.max(BEST)).length();
        a.position.distance(b.position) <= gate * deviation
    };
    let with =
        |one: &BallEstimate| -> f32 { estimates.iter().filter(|other| agree(one, other)).map(weight).sum() };
    let heavier =
        |best: (f32, BallEstimate), next: (f32, BallEstimate)| if next.0 > best.0 { next } else { best };
    let (total, seed) = estimates.iter().map(|one| (with(one), *one)).reduce(heavier)?;
    let agreeing = estimates.iter().filter(|other| agree(&seed, other));
    let sum: Vec2 = agreeing.map(|other| other.position * weight(other)).sum();
    Some(BallEstimate { position: sum / total, deviation: total.sqrt().recip() })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn report(time: u32, x: f32, age: f32) -> BallReport {
        BallReport { time, position: Vec2::new(x, 0.0), age }
    }

    fn estimate(x: f32, y: f32, deviation: f32) -> BallEstimate {
        BallEstimate { position: Vec2::new(x, y), deviation }
    }

    #[test]
    fn who_saw_the_ball_last_is_believed() {
        let mut map = GlobalMap::default();
        map.hear(1, &report(5000, 1.0, 2.0), 10);
        map.hear(2, &report(4000, 2.0, 0.1), 11);
        assert_eq!(map.freshest(), Some(Vec2::new(2.0, 0.0)));
    }

    #[test]
    fn overtaken_reports_change_nothing_and_old_ones_are_forgotten() {
        let mut map = GlobalMap::default();
        map.hear(1, &report(2000, 1.0, 0.0), 10);
        map.hear(1, &report(1000, 9.0, 0.0), 12);
        assert_eq!(map.freshest(), Some(Vec2::new(1.0, 0.0)));
        map.forget(40, 30);
        assert!(map.freshest().is_some());
        map.forget(41, 30);
        assert_eq!(map.freshest(), None);
    }

    #[test]
    fn a_report_is_the_less_worth_the_farther_its_reporter_was_from_the_ball_and_the_older_it_is() {
        let fusion = MapFusion { fused: true, position: 0.2, range: 0.1, rolling: 0.5, gate: 3.0 };
        let mut map = GlobalMap::default();
        for (number, age) in [(1, 0.0), (2, 0.0), (3, 1.0), (4, 0.0)] {
            map.hear(number, &report(9000, 1.0, age), 10);
        }
        // The first is 1 m from the ball, the second 2 m, the third 1 m; the fourth has not told where it is.
        let places = [None, Some(Vec2::ZERO), Some(Vec2::new(3.0, 0.0)), Some(Vec2::ZERO), None];
        let place = |number: PlayerNumber| places[usize::from(number)];
        let found: Vec<f32> =
            map.estimates(&fusion, 9.0, 3.0, place).map(|estimate| estimate.deviation).collect();
        assert!(found[0] < found[1] && found[1] < found[3] && found[0] < found[2], "{found:?}");
        assert!((found[0] - 0.05f32.sqrt()).abs() < 1e-5, "{found:?}");
        assert!(fusion.own_deviation(1.0, 0.0) < found[0]);
    }

    #[test]
    fn what_agrees_is_averaged_by_its_worth() {
        let fused = fuse(&[estimate(1.0, 0.0, 0.1), estimate(1.3, 0.0, 0.2)], 3.0).expect("there are two");
        assert!((fused.position - Vec2::new(1.06, 0.0)).length() < 1e-5, "{fused:?}");
        assert!(fused.deviation < 0.1);
        assert_eq!(fuse(&[], 3.0), None);
    }

    #[test]
    fn who_contradicts_two_others_is_left_out() {
        let two = [estimate(1.0, 0.0, 0.2), estimate(1.1, 0.1, 0.2)];
        let without = fuse(&two, 3.0);
        assert_eq!(fuse(&[two[0], estimate(-1.5, 0.8, 0.16), two[1]], 3.0), without);
    }

    proptest! {
        #[test]
        fn the_mean_lies_among_those_that_agree_and_is_no_worse_than_the_best(
            points in prop::collection::vec((-3.0f32..3.0, -2.0f32..2.0, 0.02f32..1.0), 1..6),
        ) {
            let estimates: Vec<_> = points.iter().map(|(x, y, deviation)| estimate(*x, *y, *deviation)).collect();
            let fused = fuse(&estimates, 3.0).expect("there is one at least");
            let (low, high) = estimates.iter().fold((Vec2::MAX, Vec2::MIN), |(low, high), one| {
                (low.min(one.position), high.max(one.position))
            });
            prop_assert!(fused.position.cmpge(low - 1e-3).all() && fused.position.cmple(high + 1e-3).all());
            let worst = points.iter().map(|(.., deviation)| *deviation).fold(0.0, f32::max);
            prop_assert!(fused.deviation <= worst + 1e-4);
        }

        #[test]
        fn the_order_of_the_reports_does_not_matter(
            points in prop::collection::vec((-3.0f32..3.0, -2.0f32..2.0, 0.02f32..1.0), 1..6), turn in 0usize..6,
        ) {
            let mut estimates: Vec<_> =
                points.iter().map(|(x, y, deviation)| estimate(*x, *y, *deviation)).collect();
            let first = fuse(&estimates, 3.0).expect("there is one at least");
            let by = turn % estimates.len();
            estimates.rotate_left(by);
            let second = fuse(&estimates, 3.0).expect("there is one at least");
            // Two groups of one weight may stand against each other; then either is right.
            prop_assume!((first.deviation - second.deviation).abs() > 1e-6 || first.position.distance(second.position) < 1e-2);
            prop_assert!(first.position.distance(second.position) < 1e-2, "{first:?} {second:?}");
        }
    }
}
