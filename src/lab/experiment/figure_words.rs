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
        let number = |value: f64| {
            let value = rounded(value);
            if f.sign_plus() { format!("{value:+.3}") } else { format!("{value:.3}") }
        };
        match (self.value, self.interval) {
            (None, _) => write!(f, "-"),
            (Some(value), None) => write!(f, "{}", number(value)),
            (Some(value), Some(Interval { low, high })) => {
                write!(f, "{} [{}, {}]", number(value), number(low), number(high))
            }
        }
    }
}

/// To three digits, without a negative zero.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0 + 0.0
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
}
