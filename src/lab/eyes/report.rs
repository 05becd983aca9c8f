//! What came out of many pictures.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::fit::{least_share, range_errors, reach, root_mean_square, share};
use super::readings::{ComparedSighting, Readings};
use crate::data::in_one_line;
use crate::geometry::wrap_angle;
use crate::robot::Camera;

/// The numbers of the fast model of a camera, beside those that pictures give.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EyesReport {
    /// The eyes whose numbers are compared.
    pub eyes: String,
    /// The camera that took the pictures.
    pub camera: String,
    /// Number by number.
    pub numbers: Vec<FittedNumber>,
    /// By which share of itself the range of a ball in full view is measured too long, on average. The fast model's ranges are right on
    /// average. Nothing, if no ball was seen.
    pub range_bias: Option<f32>,
    /// Pictures that were taken.
    pub views: u32,
    /// Of the dice.
    pub seed: u64,
    /// Whether pictures are missing.
    pub interrupted: bool,
}

/// One number of the fast model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FittedNumber {
    /// Its field in the file.
    pub field: &'static str,
    /// As the file has it.
    pub file: f32,
    /// As the pictures give it; nothing, if too few tell of it.
    pub fitted: Option<f32>,
    /// Readings that it is fitted to.
    pub readings: usize,
}

/// Things are seen whole if so much of them is visible.
const WHOLE: f32 = 0.99;

impl EyesReport {
    pub(super) fn new(
        (numbers, range_bias): (Vec<FittedNumber>, Option<f32>),
        [eyes, camera]: [String; 2],
        (views, seed): (u32, u64),
        interrupted: bool,
    ) -> EyesReport {
        EyesReport { eyes, camera, numbers, range_bias, views, seed, interrupted }
    }
}

fn whole(looks: &[ComparedSighting]) -> Vec<ComparedSighting> {
    looks.iter().filter(|look| look.visible > WHOLE).copied().collect()
}

/// True ranges of balls in full view that were seen, and what was measured too much, m.
fn range_errors_of(balls: &[ComparedSighting]) -> Vec<(f32, f32)> {
    let errors =
        balls.iter().filter_map(|look| Some((look.truth.range, look.seen?.range - look.truth.range)));
    errors.collect()
}

/// By which share of itself the range of a ball in full view is measured too long, on average.
pub(super) fn range_bias(readings: &Readings) -> Option<f32> {
    let errors = range_errors_of(&whole(&readings.balls));
    let sum: f64 = errors.iter().map(|(range, error)| f64::from(error / range)).sum();
    (!errors.is_empty()).then(|| (sum / errors.len() as f64) as f32)
}

/// The numbers of a model that readings tell of; ranges up to `most` metres.
pub(super) fn numbers(fast: &Camera, readings: &Readings, most: f32) -> Vec<FittedNumber> {
    let (balls, robots) = (whole(&readings.balls), whole(&readings.robots));
    let looks = |of: &[ComparedSighting]| {
        of.iter().map(|look| (look.truth.range, look.seen.is_some())).collect::<Vec<_>>()
    };
    let of_ball = reach(&looks(&balls), most, fast);
    let of_robots = reach(&looks(&robots), most, fast);
    let errors = range_errors_of(&balls);
    let range = range_errors(&errors);
    let bearings = balls.iter().filter_map(|look| Some(wrap_angle(look.seen?.bearing - look.truth.bearing)));
    // Beyond the range nothing is recognised, however much of it is to be seen.
    let near = of_ball.map_or(0.0, |reach| 0.7 * reach.range);
    let shares: Vec<(f32, bool)> = (readings.balls.iter().filter(|look| look.truth.range < near))
        .map(|look| (look.visible, look.seen.is_some()))
        .collect();
    let number = |field, file, fitted, readings| FittedNumber { field, file, fitted, readings };
    vec![
        number("ball_range", fast.ball_range, of_ball.map(|reach| reach.range), balls.len()),
        number("robot_range", fast.robot_range, of_robots.map(|reach| reach.range), robots.len()),
        number("range_noise", fast.range_noise, range.map(|errors| errors.noise), errors.len()),
        number("range_floor", fast.range_floor, range.map(|errors| errors.floor), errors.len()),
        number(
            "bearing_noise",
            fast.bearing_noise,
            root_mean_square(bearings).map(f32::to_degrees),
            errors.len(),
        ),
        number("detection", fast.detection, of_ball.map(|reach| reach.detection), balls.len()),
        number("visible_share", fast.visible_share, least_share(&shares), shares.len()),
        number(
            "false_positive",
            fast.false_positive,
            share(readings.phantoms.iter().copied()),
            readings.phantoms.len(),
        ),
        number(
            "wrong_team",
            fast.wrong_team,
            share(readings.mistaken.iter().copied()),
            readings.mistaken.len(),
        ),
    ]
}

impl Display for EyesReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.interrupted {
            writeln!(f, "interrupted after {} pictures; the result so far:", self.views)?;
        }
        let (eyes, camera) = (in_one_line(&self.eyes), in_one_line(&self.camera));
        writeln!(f, "{eyes} against pictures of {camera}")?;
        writeln!(f, "{:16}{:>8}{:>10}{:>10}", "", "file", "pictures", "readings")?;
        for FittedNumber { field, file, fitted, readings } in &self.numbers {
            let fitted = fitted.map_or_else(|| "-".to_owned(), |fitted| format!("{fitted:.4}"));
            writeln!(f, "{field:16}{file:>8.4}{fitted:>10}{readings:>10}")?;
        }
        if let Some(bias) = self.range_bias {
            let (percent, way) = (100.0 * bias.abs(), if bias < 0.0 { "short" } else { "long" });
            writeln!(f, "ranges of the ball come out {percent:.1} % too {way} on average")?;
        }
        write!(f, "{} pictures, seed {}", self.views, self.seed)
    }
}
