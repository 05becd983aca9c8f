//! Where a robot is that has nothing but its pictures and its odometry: an extended Kalman filter over its pose, corrected by
//! landmarks with known places (Thrun, Burgard and Fox, "Probabilistic Robotics", sections 7.4 and 7.5).
//!
//! The estimate is always that of the newest frame. Odometry since then is kept, so that a frame that comes late corrects the pose
//! of its own time. Landmarks that do not fit are left out; where they keep contradicting the estimate, the robot was
//! carried, and finds its place anew from two of them.

mod estimate;
mod resection;
mod sightings;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;

use bevy::math::Vec2;

use estimate::{Estimate, LandmarkReading};
use resection::{Bearings, locate};
use sightings::LEAST_RANGE;
pub use sightings::{FilterErrors, PoseDeviation, SeenLandmark};

use crate::geometry::{Pose, Sighting, wrap_angle};

/// A robot's own idea of where it is.
#[derive(Clone, Debug)]
pub struct PoseFilter {
    /// What is known at the tick of the newest frame; nothing, if the robot is lost.
    estimate: Option<Estimate>,
    /// The tick and the odometry for which the estimate holds.
    at: (u64, Pose),
    /// The odometry of the last ticks, oldest first.
    past: VecDeque<(u64, Pose)>,
    /// The landmarks of the last seconds, each place once.
    known: Vec<RememberedLandmark>,
    /// Landmarks that have contradicted the estimate more often than others have agreed with it.
    doubts: f32,
}

/// A landmark that was seen a while ago.
#[derive(Clone, Copy, Debug)]
struct RememberedLandmark {
    place: Vec2,
    /// Where it was seen, in the frame of the odometry, m.
    seen: Vec2,
    range: f32,
    range_deviation: f32,
    tick: u64,
}

/// Sightings nearer or farther than this are none, m.
const RANGES: std::ops::Range<f32> = 0.05..50.0;
/// Ticks of odometry that are kept: two seconds, which no latency should exceed.
const PAST: usize = 128;
/// How long landmarks are remembered to find the place anew, s. Odometry has to hold for so long.
const MEMORY: f32 = 2.0;
/// Landmarks remembered at most, the newest.
const MOST_REMEMBERED: usize = 16;
/// After this many landmarks that contradict the estimate, the robot takes itself to be elsewhere.
const DOUBTS: f32 = 15.0;
/// An estimate as good as this is worth a full fix.
const GOOD: PoseDeviation = PoseDeviation { place: 0.25, heading: 0.2 };

impl PoseFilter {
    /// A robot that was told where it is, about.
    pub fn told(pose: Pose, deviation: PoseDeviation) -> PoseFilter {
        PoseFilter { estimate: Estimate::new(pose, deviation), ..PoseFilter::lost() }
    }

    /// A robot that knows nothing of its place.
    pub fn lost() -> PoseFilter {
        PoseFilter {
            estimate: None,
            at: (0, Pose::default()),
            past: VecDeque::new(),
            known: Vec::new(),
            doubts: 0.0,
        }
    }

    /// Takes note of the odometry's pose at a tick, later than the last one. The first one is where the robot was told its place.
    pub fn odometry(&mut self, tick: u64, pose: Pose) {
        if !pose.is_finite() || self.past.back().is_some_and(|(last, _)| *last >= tick) {
            return;
        }
        if self.past.is_empty() {
            self.at = (tick, pose);
        }
        self.past.push_back((tick, pose));
        if self.past.len() > PAST {
            self.past.pop_front();
        }
    }

    /// Takes in the landmarks of a frame that was taken at a tick, with `dt` seconds a tick. Frames come in order; one without
    /// landmarks tells that time has passed.
    pub fn see(&mut self, taken: u64, seen: &[SeenLandmark], errors: &FilterErrors, dt: f32) {
        if taken < self.at.0 || self.past.is_empty() {
            return;
        }
        let now = self.odometry_at(taken);
        let time = (taken - self.at.0) as f32 * dt;
        self.estimate = self.estimate.and_then(|estimate| estimate.moved(self.at.1, now, time, errors));
        self.at = (taken, now);
        let seen = seen.iter().filter(|seen| RANGES.contains(&seen.sighting.range) && seen.is_sound());
        let readings: Vec<LandmarkReading> = seen.map(|seen| self.reading(seen, errors, dt)).collect();
        self.remember(&readings, dt);
        match self.estimate {
            Some(estimate) => self.correct(estimate, &readings, errors),
            None => self.find(errors),
        }
    }

    /// A landmark as the estimate takes it in. Errors of one landmark last: what it tells soon after it was seen is hardly new.
    fn reading(&self, seen: &SeenLandmark, errors: &FilterErrors, dt: f32) -> LandmarkReading {
        let known = self.known.iter().find(|known| known.place == seen.place);
        let news = known.map_or(1.0, |known| (self.at.0 - known.tick) as f32 * dt / errors.lasting);
        LandmarkReading::new(*seen, errors.bearing, news)
    }

    fn correct(&mut self, estimate: Estimate, readings: &[LandmarkReading], errors: &FilterErrors) {
        let fitting: Vec<LandmarkReading> =
            readings.iter().filter(|reading| estimate.expects(reading)).copied().collect();
        let contradicting = readings.len() - fitting.len();
        self.doubts = (self.doubts + contradicting as f32 - fitting.len() as f32).clamp(0.0, DOUBTS);
        self.estimate = estimate.corrected(&fitting);
        if self.doubts >= DOUBTS && contradicting > 0 {
            self.find(errors);
        }
    }

    /// Finds the robot's place from the landmarks of the last seconds alone, if they tell another one. If they tell none, the robot
    /// doubts where it is.
    fn find(&mut self, errors: &FilterErrors) {
        let seen: Vec<Bearings> = (self.known.iter())
            .map(|known| {
                let across = errors.bearing * known.range;
                let deviation = known.range_deviation.max(across).max(LEAST_RANGE);
                Bearings { place: known.place, seen: known.seen, deviation }
            })
            .collect();
        let Some((odometry_frame, fitting)) = locate(&seen) else {
            self.estimate = self.estimate.and_then(Estimate::doubted);
            return;
        };
        let here = self.at.1;
        let reading = |index: usize| self.known[index].reading(here, errors);
        let fitting: Vec<LandmarkReading> = fitting.into_iter().map(reading).collect();
        let expects = |estimate: Estimate| fitting.iter().all(|reading| estimate.expects(reading));
        if self.estimate.is_some_and(expects) {
            self.doubts = 0.0;
            return;
        }
        let pose = Pose {
            position: odometry_frame.to_field(here.position),
            heading: wrap_angle(odometry_frame.heading + here.heading),
        };
        let wide = PoseDeviation { place: 1.0, heading: 1.0 };
        self.estimate = Estimate::new(pose, wide).and_then(|estimate| estimate.corrected(&fitting));
        self.doubts = 0.0;
    }

    /// Keeps where landmarks were seen, each place once, for a while.
    fn remember(&mut self, readings: &[LandmarkReading], dt: f32) {
        let (tick, odometry) = self.at;
        self.known.retain(|known| {
            let is_renewed = readings.iter().any(|reading| reading.seen.place == known.place);
            !is_renewed && (tick - known.tick) as f32 * dt <= MEMORY
        });
        self.known.extend(readings.iter().map(|reading| RememberedLandmark {
            place: reading.seen.place,
            seen: reading.seen.sighting.placed(odometry),
            range: reading.seen.sighting.range,
            range_deviation: reading.seen.range_deviation,
            tick,
        }));
        let excess = self.known.len().saturating_sub(MOST_REMEMBERED);
        self.known.drain(..excess);
    }

    /// The odometry's pose at a tick, between two that are known too.
    fn odometry_at(&self, tick: u64) -> Pose {
        let later = self.past.partition_point(|(at, _)| *at <= tick);
        let before = later.checked_sub(1).and_then(|index| self.past.get(index));
        match (before, self.past.get(later)) {
            (Some(&(start, from)), Some(&(end, to))) => {
                let share = (tick - start) as f32 / (end - start) as f32;
                Pose {
                    position: from.position.lerp(to.position, share),
                    heading: wrap_angle(from.heading + share * wrap_angle(to.heading - from.heading)),
                }
            }
            (Some(&(_, pose)), None) | (None, Some(&(_, pose))) => pose,
            (None, None) => self.at.1,
        }
    }

    /// The pose when the newest frame was taken; nothing, if the robot is lost.
    pub fn pose_then(&self) -> Option<Pose> {
        self.estimate.map(|estimate| estimate.pose)
    }

    /// The pose at the newest odometry; nothing, if the robot is lost.
    pub fn pose(&self) -> Option<Pose> {
        let now = self.past.back().map_or(self.at.1, |(_, pose)| *pose);
        self.estimate.map(|estimate| estimate.pose_after(self.at.1, now))
    }

    /// How far the pose of the newest frame may be wrong; nothing, if the robot is lost.
    pub fn deviation(&self) -> Option<PoseDeviation> {
        self.estimate.map(|estimate| estimate.deviation())
    }

    /// How trustworthy the pose is, from 0 for a robot that is lost to 1 for one that knows its place to a quarter of a metre and
    /// to 11 degrees, and that nothing has contradicted.
    pub fn share(&self) -> f32 {
        let sure = 1.0 - self.doubts / DOUBTS;
        self.deviation().map_or(0.0, |deviation| {
            let good = (GOOD.place / deviation.place).min(GOOD.heading / deviation.heading);
            good.clamp(0.0, 1.0) * sure
        })
    }
}

impl RememberedLandmark {
    /// The landmark as a robot has it whose odometry is this.
    fn reading(&self, odometry: Pose, errors: &FilterErrors) -> LandmarkReading {
        let sighting = Sighting::of(self.seen, odometry);
        let seen = SeenLandmark { place: self.place, sighting, range_deviation: self.range_deviation };
        LandmarkReading::new(seen, errors.bearing, 1.0)
    }
}
