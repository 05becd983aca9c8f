//! Ways over time, thinned out: a few knots between which a straight line errs by no more than it may, at any tick.
//!
//! Each run of a track is a broken line, found by a swinging door: a knot is set when no line from the last one passes near
//! enough to all points since. Numbers are whole multiples of a unit, written as differences.

use std::f32::consts::PI;

use serde::Serialize;

use crate::geometry::{Pose, Vec2, wrap_angle};

/// How exact a track is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exactness {
    /// What numbers are multiples of.
    pub unit: f64,
    /// How far a track may be off at any tick, at least half a unit.
    pub tolerance: f64,
}

/// Of true places, m.
pub const PLACE: Exactness = Exactness { unit: 0.002, tolerance: 0.005 };
/// Of true headings, rad.
pub const HEADING: Exactness = Exactness { unit: DEGREE / 2.0, tolerance: DEGREE };
/// Of believed places, m.
pub const BELIEVED_PLACE: Exactness = Exactness { unit: 0.01, tolerance: 0.02 };
/// Of believed headings, and of heads, rad.
pub const BELIEVED_HEADING: Exactness = Exactness { unit: DEGREE, tolerance: 3.0 * DEGREE };

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// The knots of a track, by column. Each number but the first of a column is the difference to the one before.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct KnotTable {
    /// Ticks.
    t: Vec<i64>,
    /// Values in units, a column for each dimension.
    v: Vec<Vec<i64>>,
    /// Knots, by number from 0, that begin a run but for the first. Between two runs there is nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    runs: Vec<usize>,
}

/// Writes a track of so many dimensions, tick by tick.
#[derive(Clone, Debug)]
pub struct TrackWriter<const N: usize> {
    exactness: [Exactness; N],
    knots: Vec<(u64, [i64; N])>,
    runs: Vec<usize>,
    run: Option<RunInProgress<N>>,
}

#[derive(Clone, Copy, Debug)]
struct RunInProgress<const N: usize> {
    /// The last point, which may become the next knot.
    last: (u64, [i64; N]),
    /// The slopes, a tick, by which lines from the last knot pass near enough to all points since.
    slopes: [(f64, f64); N],
}

const ANY_SLOPE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

impl<const N: usize> TrackWriter<N> {
    /// A track that is so exact.
    pub fn new(exactness: [Exactness; N]) -> TrackWriter<N> {
        TrackWriter { exactness, knots: Vec::new(), runs: Vec::new(), run: None }
    }

    /// Goes on at a later tick; without values there is nothing until the next ones.
    pub fn push(&mut self, tick: u64, values: Option<[f64; N]>) {
        let Some(values) = values else { return self.end_run() };
        let here = (tick, std::array::from_fn(|i| (values[i] / self.exactness[i].unit).round() as i64));
        let Some(run) = &mut self.run else {
            if !self.knots.is_empty() {
                self.runs.push(self.knots.len());
            }
            self.knots.push(here);
            self.run = Some(RunInProgress { last: here, slopes: [ANY_SLOPE; N] });
            return;
        };
        let from = *self.knots.last().unwrap_or(&here);
        if !run.reaches(&self.exactness, from, here) {
            self.knots.push(run.last);
            run.slopes = [ANY_SLOPE; N];
        }
        let from = *self.knots.last().unwrap_or(&here);
        run.pass(&self.exactness, from, (tick, values));
        run.last = here;
    }

    fn end_run(&mut self) {
        if let Some(run) = self.run.take()
            && self.knots.last() != Some(&run.last)
        {
            self.knots.push(run.last);
        }
    }

    /// The knots so far.
    pub fn finish(mut self) -> KnotTable {
        self.end_run();
        let mut table = KnotTable { t: Vec::new(), v: vec![Vec::new(); N], runs: self.runs };
        let mut before = (0, [0; N]);
        for (tick, values) in self.knots {
            let tick = tick as i64;
            table.t.push(tick - before.0);
            for (column, (value, known)) in table.v.iter_mut().zip(values.iter().zip(before.1)) {
                column.push(value - known);
            }
            before = (tick, values);
        }
        table
    }
}

impl<const N: usize> RunInProgress<N> {
    /// Whether a line from a knot to a point passes near enough to all points between them.
    fn reaches(&self, of: &[Exactness; N], from: (u64, [i64; N]), to: (u64, [i64; N])) -> bool {
        let ticks = (to.0 - from.0) as f64;
        (0..N).all(|i| {
            let slope = (to.1[i] - from.1[i]) as f64 * of[i].unit / ticks;
            (self.slopes[i].0..=self.slopes[i].1).contains(&slope)
        })
    }

    fn pass(&mut self, of: &[Exactness; N], from: (u64, [i64; N]), (tick, values): (u64, [f64; N])) {
        let ticks = (tick - from.0) as f64;
        for i in 0..N {
            let way = values[i] - from.1[i] as f64 * of[i].unit;
            let (least, most) = self.slopes[i];
            let margin = of[i].tolerance;
            self.slopes[i] = (least.max((way - margin) / ticks), most.min((way + margin) / ticks));
        }
    }
}

/// Writes where a body is, tick by tick.
#[derive(Clone, Debug)]
pub struct PoseTrack {
    track: TrackWriter<3>,
    heading: Unwound,
}

impl PoseTrack {
    /// A track that is so exact in its places and its headings.
    pub fn new(place: Exactness, heading: Exactness) -> PoseTrack {
        PoseTrack { track: TrackWriter::new([place, place, heading]), heading: Unwound::default() }
    }

    /// Goes on at a later tick.
    pub fn push(&mut self, tick: u64, pose: Option<Pose>) {
        let values = pose.map(|Pose { position, heading }| {
            let [x, y] = position.to_array().map(f64::from);
            [x, y, self.heading.next(heading)]
        });
        self.track.push(tick, values);
    }

    /// The knots.
    pub fn finish(self) -> KnotTable {
        self.track.finish()
    }
}

/// Writes where something without a heading is.
#[derive(Clone, Debug)]
pub struct PointTrack(TrackWriter<2>);

impl PointTrack {
    /// A track that is so exact.
    pub fn new(place: Exactness) -> PointTrack {
        PointTrack(TrackWriter::new([place; 2]))
    }

    /// Goes on at a later tick.
    pub fn push(&mut self, tick: u64, point: Option<Vec2>) {
        self.0.push(tick, point.map(|point| point.to_array().map(f64::from)));
    }

    /// The knots.
    pub fn finish(self) -> KnotTable {
        self.0.finish()
    }
}

/// Writes an angle.
#[derive(Clone, Debug)]
pub struct AngleTrack {
    track: TrackWriter<1>,
    angle: Unwound,
}

impl AngleTrack {
    /// A track that is so exact.
    pub fn new(exactness: Exactness) -> AngleTrack {
        AngleTrack { track: TrackWriter::new([exactness]), angle: Unwound::default() }
    }

    /// Goes on at a later tick, with radians.
    pub fn push(&mut self, tick: u64, angle: f32) {
        let angle = self.angle.next(angle);
        self.track.push(tick, Some([angle]));
    }

    /// The knots.
    pub fn finish(self) -> KnotTable {
        self.track.finish()
    }
}

/// An angle that goes on beyond half a turn, so that a line between two knots turns the way that the body turned.
#[derive(Clone, Copy, Debug, Default)]
struct Unwound {
    turns: f64,
    before: f32,
}

impl Unwound {
    fn next(&mut self, angle: f32) -> f64 {
        let step = angle - self.before;
        if step.abs() > PI {
            self.turns -= f64::from((step - wrap_angle(step)) / (2.0 * PI)).round();
        }
        self.before = angle;
        f64::from(angle) + self.turns * std::f64::consts::TAU
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// What a reader makes of a track at a tick.
    pub fn value_at<const N: usize>(table: &KnotTable, of: &[Exactness; N], tick: u64) -> Option<[f64; N]> {
        let sums = |column: &[i64]| -> Vec<i64> {
            column.iter().scan(0, |sum, step| Some(std::mem::replace(sum, *sum + step) + step)).collect()
        };
        let times = sums(&table.t);
        let after = times.partition_point(|time| *time <= tick as i64);
        let before = after.checked_sub(1)?;
        let ends_here = after == times.len() || table.runs.contains(&after);
        if ends_here && times[before] != tick as i64 {
            return None;
        }
        Some(std::array::from_fn(|i| {
            let column = sums(&table.v[i]);
            let value = |knot: usize| column[knot] as f64 * of[i].unit;
            if times[before] == tick as i64 {
                return value(before);
            }
            let share = (tick as i64 - times[before]) as f64 / (times[after] - times[before]) as f64;
            value(before) + share * (value(after) - value(before))
        }))
    }

    const FINE: [Exactness; 1] = [Exactness { unit: 0.01, tolerance: 0.02 }];

    fn track_of(values: &[Option<f64>]) -> KnotTable {
        let mut writer = TrackWriter::new(FINE);
        for (tick, value) in values.iter().enumerate() {
            writer.push(tick as u64, value.map(|value| [value]));
        }
        writer.finish()
    }

    #[test]
    fn a_straight_way_needs_two_knots() {
        let values: Vec<_> = (0..1000).map(|tick| Some(f64::from(tick) * 0.013)).collect();
        assert_eq!(track_of(&values).t.len(), 2);
    }

    #[test]
    fn a_body_that_is_carried_does_not_glide() {
        let values: Vec<_> = (0..100).map(|tick| Some(if tick < 50 { 0.0 } else { 4.0 })).collect();
        let table = track_of(&values);
        assert_eq!(value_at(&table, &FINE, 49), Some([0.0]));
        assert_eq!(value_at(&table, &FINE, 50), Some([4.0]));
        assert_eq!(table.t, [0, 49, 1, 49]);
    }

    #[test]
    fn an_angle_turns_on_beyond_half_a_turn() {
        let mut unwound = Unwound::default();
        let angles: Vec<f64> = (0..200).map(|step| unwound.next(wrap_angle(0.1 * step as f32))).collect();
        assert!(angles.iter().enumerate().all(|(step, angle)| (angle - 0.1 * step as f64).abs() < 1e-4));
        let back: Vec<f64> = (0..200).rev().map(|step| unwound.next(wrap_angle(0.1 * step as f32))).collect();
        assert!((back[199] - 0.0).abs() < 1e-4, "{}", back[199]);
    }

    proptest! {
        #[test]
        fn a_track_is_as_exact_at_every_tick_as_it_may_err(
            steps in prop::collection::vec((-0.3f64..0.3, 0u8..20), 1..300),
        ) {
            let mut at = 0.0;
            let values: Vec<Option<f64>> = steps.iter().map(|(step, what)| {
                at += if *what < 15 { step * 0.1 } else { step * 10.0 };
                (*what != 19).then_some(at)
            }).collect();
            let table = track_of(&values);
            for (tick, value) in values.iter().enumerate() {
                let read = value_at(&table, &FINE, tick as u64);
                prop_assert_eq!(read.is_some(), value.is_some(), "tick {}", tick);
                if let (Some([read]), Some(value)) = (read, value) {
                    prop_assert!((read - value).abs() <= 0.02 + 1e-9, "tick {}: {} for {}", tick, read, value);
                }
            }
        }
    }
}
