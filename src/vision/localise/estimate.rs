//! A pose as a normal distribution: how it moves with odometry and what landmarks make of it. Pure.

use bevy::math::{DMat3, DVec3, Vec2};

use super::sightings::{FilterErrors, LEAST_RANGE, PoseDeviation, SeenLandmark};
use crate::geometry::{Pose, Sighting, wrap_angle};

/// The mean and the covariance of x, y and heading.
#[derive(Clone, Copy, Debug)]
pub(super) struct Estimate {
    pub pose: Pose,
    covariance: DMat3,
}

/// A landmark of one frame, with the deviations of its range and bearing, m and rad.
#[derive(Clone, Copy, Debug)]
pub(super) struct LandmarkReading {
    pub seen: SeenLandmark,
    deviations: (f32, f32),
    /// How much of it is new, 0 to 1.
    news: f64,
}

impl LandmarkReading {
    pub fn new(seen: SeenLandmark, bearing: f32, news: f32) -> LandmarkReading {
        let news = if news.is_nan() { 1.0 } else { news.clamp(0.0, 1.0) };
        let deviations = (seen.range_deviation.max(LEAST_RANGE), bearing.max(LEAST_BEARING));
        LandmarkReading { seen, deviations, news: f64::from(news) }
    }
}

/// No bearing is measured better, rad.
const LEAST_BEARING: f32 = 0.005;
/// A landmark farther from where it should be than this is another one: the squared Mahalanobis distance that 1 in 1000 right ones
/// exceeds, of two numbers.
const GATE: f64 = 13.8;
/// Of the optimisation of one frame; each begins at the last one's result.
const ROUNDS: usize = 4;
/// Nobody knows less than this: a variance, m² or rad².
const LARGEST_VARIANCE: f64 = 100.0;
const SMALLEST_VARIANCE: f64 = 1e-8;
/// By how much variances grow when landmarks contradict and give no other place.
const DOUBT: f64 = 1.03;

impl Estimate {
    /// Nothing, if these are no numbers.
    pub fn new(pose: Pose, deviation: PoseDeviation) -> Option<Estimate> {
        let [place, heading] = [deviation.place, deviation.heading].map(|one| f64::from(one * one));
        Estimate { pose, covariance: DMat3::from_diagonal(DVec3::new(place, place, heading)) }.sound()
    }

    /// Keeps variances within what can be computed with; nothing, if something is no number.
    fn sound(self) -> Option<Estimate> {
        let covariance = self.covariance;
        let covariance = (covariance + covariance.transpose()) * 0.5;
        let variances = covariance.diagonal();
        let is_sound = self.pose.is_finite() && covariance.is_finite();
        let pose = Pose { heading: wrap_angle(self.pose.heading), ..self.pose };
        is_sound.then(|| {
            let bounded = variances.clamp(DVec3::splat(SMALLEST_VARIANCE), DVec3::splat(LARGEST_VARIANCE));
            // Rows and columns shrink alike, so that what was a covariance stays one.
            let scale = DVec3::select(variances.cmpgt(DVec3::ZERO), bounded / variances, DVec3::ONE);
            let scale = DMat3::from_diagonal(scale.min(DVec3::ONE).map(f64::sqrt));
            let lifted = (bounded - variances).max(DVec3::ZERO);
            Estimate { pose, covariance: scale * covariance * scale + DMat3::from_diagonal(lifted) }
        })
    }

    /// Where the robot is after the odometry has gone from one pose to another.
    pub fn pose_after(&self, from: Pose, to: Pose) -> Pose {
        Pose {
            position: self.pose.to_field(from.to_local(to.position)),
            heading: wrap_angle(self.pose.heading + wrap_angle(to.heading - from.heading)),
        }
    }

    /// The estimate after the odometry has gone from one pose to another in this time, s.
    pub fn moved(self, from: Pose, to: Pose, time: f32, errors: &FilterErrors) -> Option<Estimate> {
        let pose = self.pose_after(from, to);
        let way = pose.position - self.pose.position;
        let jacobian =
            DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(f64::from(-way.y), f64::from(way.x), 1.0));
        let square = |per_root: f32, much: f32| f64::from(per_root * per_root * much);
        let distance = way.length();
        let place = square(errors.way, distance) + square(errors.unfelt.place, time);
        let heading = square(errors.turn, distance) + square(errors.unfelt.heading, time);
        let noise = DMat3::from_diagonal(DVec3::new(place, place, heading));
        Estimate { pose, covariance: jacobian * self.covariance * jacobian.transpose() + noise }.sound()
    }

    /// Whether a landmark is about where it should be seen.
    pub fn expects(&self, reading: &LandmarkReading) -> bool {
        let Some(row) = SightingRows::of(self.pose, reading) else { return false };
        let [range, bearing] = [row.range, row.bearing];
        // The covariance of both innovations, in units of their measurement's deviation.
        let a = range.dot(self.covariance * range) + 1.0;
        let b = range.dot(self.covariance * bearing);
        let d = bearing.dot(self.covariance * bearing) + 1.0;
        let (u, v) = row.off;
        let distance = (d * u * u - 2.0 * b * u * v + a * v * v) / (a * d - b * b);
        distance <= GATE
    }

    /// The most likely pose, given this estimate and the landmarks of one frame.
    pub fn corrected(self, readings: &[LandmarkReading]) -> Option<Estimate> {
        if readings.is_empty() {
            return Some(self);
        }
        let prior = self.covariance.inverse();
        let mut pose = self.pose;
        let mut covariance = self.covariance;
        for _ in 0..ROUNDS {
            let off = self.pose.position - pose.position;
            let turn = wrap_angle(self.pose.heading - pose.heading);
            let mut information = prior;
            let mut pull = prior * DVec3::new(f64::from(off.x), f64::from(off.y), f64::from(turn));
            for reading in readings {
                let Some(row) = SightingRows::of(pose, reading) else { continue };
                information += (outer(row.range) + outer(row.bearing)) * reading.news;
                pull += (row.range * row.off.0 + row.bearing * row.off.1) * reading.news;
            }
            covariance = information.inverse();
            let step = covariance * pull;
            pose.position += Vec2::new(step.x as f32, step.y as f32);
            pose.heading = wrap_angle(pose.heading + step.z as f32);
        }
        Estimate { pose, covariance }.sound()
    }

    /// The same, but less sure.
    pub fn doubted(self) -> Option<Estimate> {
        Estimate { covariance: self.covariance * DOUBT, ..self }.sound()
    }

    pub fn deviation(&self) -> PoseDeviation {
        let variances = self.covariance.diagonal();
        let place = ((variances.x + variances.y) / 2.0).sqrt() as f32;
        PoseDeviation { place, heading: variances.z.sqrt() as f32 }
    }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// How a landmark's range and bearing change with the pose, and how far both are off what they should be: all in units of the
/// measurement's standard deviation.
struct SightingRows {
    range: DVec3,
    bearing: DVec3,
    off: (f64, f64),
}

impl SightingRows {
    fn of(pose: Pose, reading: &LandmarkReading) -> Option<SightingRows> {
        let LandmarkReading { seen, deviations: (deep, across), .. } = *reading;
        let expected = Sighting::of(seen.place, pose);
        // A range that is measured too short is no better for it.
        let deep = deep * (expected.range / seen.sighting.range).max(1.0).powi(2);
        let offset = seen.place - pose.position;
        let range = expected.range;
        let way = offset / range;
        let rows = SightingRows {
            range: DVec3::new(f64::from(-way.x), f64::from(-way.y), 0.0) / f64::from(deep),
            bearing: DVec3::new(f64::from(way.y / range), f64::from(-way.x / range), -1.0)
                / f64::from(across),
            off: (
                f64::from((seen.sighting.range - range) / deep),
                f64::from(wrap_angle(seen.sighting.bearing - expected.bearing) / across),
            ),
        };
        (range > NEAREST).then_some(rows)
    }
}

/// A landmark at one's own place has no direction, m.
const NEAREST: f32 = 0.02;
