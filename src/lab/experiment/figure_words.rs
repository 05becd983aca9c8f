//! Figures with their intervals, as people read them.

use std::fmt::{self, Display, Formatter};

use crate::lab::statistics::Interval;

/// "0.310 [0.280, 0.340]", in the unit of the metric; with a sign if one is asked for by `{:+}`.
pub struct MeanWithInterval {
    /// `None` if there is nothing to take a mean of.
    pub value: Option<f64>,
    /// In which the true mean lies.
    pub interval: Option<Interval>,
}

impl Display for MeanWithInterval {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Some(value) = self.value else { return write!(f, "-") };
        let places = decimal_places(value, self.interval);
        let number = |value: f64| {
            let value = rounded(value, places);
            if f.sign_plus() { format!("{value:+.places$}") } else { format!("{value:.places$}") }
        };
        match self.interval {
            None => write!(f, "{}", number(value)),
            Some(Interval { low, high }) => {
                write!(f, "{} [{}, {}]", number(value), number(low), number(high))
            }
        }
    }
}

/// How many decimal places show a figure: three, or up to six if with fewer there would be less than two digits of the largest number, or if
/// an interval without zero would seem to begin there.
fn decimal_places(value: f64, interval: Option<Interval>) -> usize {
    let [low, high] = interval.map_or([value; 2], |Interval { low, high }| [low, high]);
    let largest = value.abs().max(low.abs()).max(high.abs());
    let nearest = if low > 0.0 || high < 0.0 { low.abs().min(high.abs()) } else { largest };
    let is_told = |&places: &usize| rounded(nearest, places) > 0.0 && rounded(largest, places - 1) > 0.0;
    if largest > 0.0 { (3..6).find(is_told).unwrap_or(6) } else { 3 }
}

/// To so many decimal places, without a negative zero.
fn rounded(value: f64, places: usize) -> f64 {
    let scale = 10_f64.powi(places as i32);
    (value * scale).round() / scale + 0.0
}

/// The probability of a test.
pub fn probability(p: f64) -> String {
    if p < 0.001 { "< 0.001".into() } else { format!("{p:.3}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_stands_before_its_interval_and_nothing_is_a_negative_zero() {
        let interval = Some(Interval { low: -0.0001, high: 1.5 });
        let figure = MeanWithInterval { value: Some(0.25), interval };
        assert_eq!(figure.to_string(), "0.250 [0.000, 1.500]");
        assert_eq!(format!("{figure:+}"), "+0.250 [+0.000, +1.500]");
        assert_eq!(MeanWithInterval { value: None, interval: None }.to_string(), "-");
    }

    #[test]
    fn what_is_small_but_not_nothing_is_told_to_more_places() {
        let told = |value, low, high| {
            format!("{:+}", MeanWithInterval { value: Some(value), interval: Some(Interval { low, high }) })
        };
        assert_eq!(told(-0.00012, -0.0003, -0.00004), "-0.00012 [-0.00030, -0.00004]");
        assert_eq!(told(0.5, 0.0002, 1.5), "+0.5000 [+0.0002, +1.5000]", "it does not hold zero");
        assert_eq!(told(0.5, -0.0002, 1.5), "+0.500 [+0.000, +1.500]");
        assert_eq!(told(1e-9, 1e-10, 1e-8), "+0.000000 [+0.000000, +0.000000]", "nobody cares for that");
        assert_eq!(told(0.0, 0.0, 0.0), "+0.000 [+0.000, +0.000]");
        assert_eq!(MeanWithInterval { value: Some(0.0004), interval: None }.to_string(), "0.00040");
    }
}
