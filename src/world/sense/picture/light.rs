//! The light of the hall: how bright and of which colour it is, how uneven, and how it drifts.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all};
use crate::ops;
use crate::rng::Dice;

/// The light of a hall, as data. What is not given is the light that cameras are made for, without drift.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Lighting {
    /// As a multiple of what an exposure of 1 suits.
    pub brightness: f32,
    /// Of the red in it, against green.
    pub red: f32,
    /// Of the blue in it, against green.
    pub blue: f32,
    /// By what share of the mean the brightest places are brighter, and the darkest ones darker.
    pub unevenness: f32,
    /// How it changes by itself.
    pub drift: LightDrift,
}

/// How light changes by itself, as clouds pass and lamps warm up: an Ornstein-Uhlenbeck process for each value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LightDrift {
    /// Standard deviation, as a share of the mean.
    pub brightness: f32,
    /// Standard deviation of red and of blue, each as a share of its mean.
    pub colour: f32,
    /// The time in which a deviation falls to a third, s.
    pub time: f32,
}

/// ASSUMPTION: an unevenness of a tenth.
impl Default for Lighting {
    fn default() -> Lighting {
        Lighting { brightness: 1.0, red: 1.0, blue: 1.0, unevenness: 0.1, drift: LightDrift::default() }
    }
}

impl Default for LightDrift {
    fn default() -> LightDrift {
        LightDrift { brightness: 0.0, colour: 0.0, time: 60.0 }
    }
}

impl Validate for Lighting {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("brightness", self.brightness, Bound::COEFFICIENT),
            ("red", self.red, Bound::COEFFICIENT),
            ("blue", self.blue, Bound::COEFFICIENT),
            ("unevenness", self.unevenness, Bound::SHARE),
        ])?;
        self.drift.validate_as("drift")
    }
}

impl Validate for LightDrift {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("brightness", self.brightness, Bound::SHARE),
            ("colour", self.colour, Bound::SHARE),
            ("time", self.time, Bound::SECONDS.positive()),
        ])
    }
}

/// Light at a moment: as it is meant to be, and how far it has drifted from that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Light {
    /// As it is meant to be.
    pub mean: Lighting,
    /// Shares of brightness, red and blue.
    drifted: [f32; 3],
}

impl Light {
    /// Light that has not drifted.
    pub fn new(mean: Lighting) -> Light {
        Light { mean, drifted: [0.0; 3] }
    }

    /// This light some seconds later.
    pub fn drifted(mut self, dt: f32, dice: &mut Dice) -> Light {
        let drift = self.mean.drift;
        let kept = ops::exp(-dt / drift.time);
        let fresh = (1.0 - kept * kept).sqrt();
        for (value, deviation) in self.drifted.iter_mut().zip([drift.brightness, drift.colour, drift.colour])
        {
            *value = *value * kept + dice.normal(deviation * fresh);
        }
        self
    }

    /// Red, green and blue; 1 is what cameras are made for.
    pub fn rgb(&self) -> [f32; 3] {
        let [brightness, red, blue] = self.drifted.map(|share| (1.0 + share).max(0.0));
        let all = self.mean.brightness * brightness;
        [all * self.mean.red * red, all, all * self.mean.blue * blue]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    #[test]
    fn light_drifts_by_its_deviation_and_forgets_in_its_time() {
        let drift = LightDrift { brightness: 0.2, colour: 0.1, time: 10.0 };
        let mut light = Light::new(Lighting { drift, ..Lighting::default() });
        let mut dice = Dice::new(Seed(3), "light", None);
        let steps = 40_000;
        let (mut squares, mut products) = ([0.0_f64; 3], 0.0_f64);
        for _ in 0..steps {
            let before = light.drifted;
            light = light.drifted(10.0, &mut dice);
            let now = light.drifted.map(f64::from);
            [0, 1, 2].into_iter().for_each(|index| squares[index] += now[index].powi(2));
            products += f64::from(before[0]) * now[0];
        }
        let [brightness, red, blue] = squares.map(|sum| (sum / f64::from(steps)).sqrt());
        assert!((brightness - 0.2).abs() < 0.005 && (red - 0.1).abs() < 0.003 && (blue - 0.1).abs() < 0.003);
        let kept = products / squares[0];
        assert!((kept - 0.3679).abs() < 0.02, "{kept}");
    }

    #[test]
    fn light_without_drift_stays() {
        let mean = Lighting { brightness: 0.5, red: 1.2, ..Lighting::default() };
        let light = Light::new(mean).drifted(5.0, &mut Dice::new(Seed(3), "light", None));
        assert_eq!(light, Light::new(mean));
        assert_eq!(light.rgb(), [0.6, 0.5, 0.5]);
    }

    #[test]
    fn a_light_out_of_its_bounds_is_a_fault_at_its_field() {
        let drift = LightDrift { time: 0.0, ..LightDrift::default() };
        let fault = Lighting { drift, ..Lighting::default() }.validate().unwrap_err();
        assert_eq!(fault.field.to_string(), "drift.time");
    }
}
