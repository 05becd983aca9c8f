//! How good a radio is, as data: the named presets in `assets/radios/*.ron`.
//!
//! Times are seconds, lengths metres; shares and chances lie between 0 and 1.

use serde::{Deserialize, Serialize};

use super::air::Airtime;
use super::loss_model::LossModel;
use super::stalls::Stalls;
use crate::data::{Bound, Fault, Validate, check_all, ensure};

/// The radio that the robots of a match share.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Radio {
    /// Its name for people.
    pub name: String,
    /// What it is like, for people.
    pub description: String,
    /// The time from sending to arrival.
    pub latency: Latency,
    /// How messages are lost by chance.
    pub loss: LossModel,
    /// Share of the delivered messages that arrive twice; the copy has a latency of its own.
    #[serde(default)]
    pub duplication: f32,
    /// Some messages take much longer than the others.
    #[serde(default)]
    pub late: Option<LateTail>,
    /// Each directed link stalls now and then.
    #[serde(default)]
    pub stalls: Option<Stalls>,
    /// Nothing is heard farther away, m. Unlimited if left out.
    #[serde(default)]
    pub range: Option<f32>,
    /// Unlimited if left out.
    #[serde(default)]
    pub budget: Option<Budget>,
    /// Frames take time on a channel that all share; none if left out.
    #[serde(default)]
    pub air: Option<Airtime>,
}

/// From sending to arrival: a fixed time and a jitter of exponential distribution, so that messages overtake each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Latency {
    /// What every message takes, s.
    pub fixed: f32,
    /// Mean of what is added to `fixed`.
    pub jitter: f32,
}

/// A share of the messages takes between `min` and `max` longer, evenly spread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LateTail {
    /// The share of late messages.
    pub share: f32,
    /// The least extra time, s.
    pub min: f32,
    /// The greatest extra time, s.
    pub max: f32,
}

/// A token bucket: a message that finds less than its own bytes in it is not sent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// What flows into the bucket.
    pub bytes_per_second: f32,
    /// Bytes that a full bucket holds, as at the start. A longer message never gets through.
    pub burst: f32,
    /// Which messages draw on the same bucket.
    pub shared_by: SharedBy,
}

/// Which messages draw on the same bucket.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SharedBy {
    /// Those from one robot to one other.
    Link,
    /// Those from one robot.
    Sender,
    /// All of the match.
    All,
}

impl Validate for Radio {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("latency.fixed", self.latency.fixed, Bound::DELAY),
            ("latency.jitter", self.latency.jitter, Bound::DELAY),
            ("duplication", self.duplication, Bound::SHARE),
        ])?;
        self.loss.validate_as("loss")?;
        if let Some(stalls) = self.stalls {
            stalls.validate_as("stalls")?;
        }
        if let Some(LateTail { share, min, max }) = self.late {
            check_all([
                ("late.share", share, Bound::SHARE),
                ("late.min", min, Bound::DELAY),
                ("late.max", max, Bound::DELAY),
            ])?;
            ensure(max >= min, "late.max", || format!("must be at least late.min, {min}, not {max}"))?;
        }
        if let Some(range) = self.range {
            Bound::LENGTH.positive().check("range", range)?;
        }
        if let Some(air) = self.air {
            air.validate_as("air")?;
        }
        if let Some(budget) = self.budget {
            check_all([
                ("budget.bytes_per_second", budget.bytes_per_second, Bound::BYTES.positive()),
                ("budget.burst", budget.burst, Bound::BYTES.positive()),
            ])?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::ron_options;

    fn read(text: &str) -> Radio {
        ron_options().from_str(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
    }

    fn good() -> Radio {
        read(include_str!("../../../assets/radios/good.ron"))
    }

    fn bad_field(change: impl FnOnce(&mut Radio)) -> String {
        let mut radio = good();
        change(&mut radio);
        radio.validate().expect_err("a fault").field.to_string()
    }

    #[test]
    fn the_presets_are_sound_and_lose_what_they_say() {
        let presets = [
            (include_str!("../../../assets/radios/perfect.ron"), "Perfect", 0.0),
            (include_str!("../../../assets/radios/good.ron"), "Good", 0.02),
            (include_str!("../../../assets/radios/bursty.ron"), "Bursty", 0.2),
            (include_str!("../../../assets/radios/awful.ron"), "Awful", 0.5),
            (include_str!("../../../assets/radios/dead.ron"), "Dead", 1.0),
            // As measured.
            (include_str!("../../../assets/radios/nora.ron"), "Nora", 0.0141),
            (include_str!("../../../assets/radios/odin.ron"), "Odin", 0.0186),
        ];
        for (text, name, loss) in presets {
            let radio = read(text);
            assert_eq!(radio.validate(), Ok(()), "{name}");
            assert_eq!(radio.name, name);
            assert!(!radio.description.is_empty());
            assert!((radio.loss.mean_loss() - loss).abs() < 0.005, "{name}: {}", radio.loss.mean_loss());
        }
    }

    #[test]
    fn a_burst_of_the_bursty_preset_is_about_half_a_second_of_traffic() {
        let messages = read(include_str!("../../../assets/radios/bursty.ron")).loss.mean_burst();
        assert!((0.4..0.6).contains(&(messages / 15.0)), "{messages} messages");
    }

    #[test]
    fn what_a_file_leaves_out_is_absent() {
        let radio = read("(name: \"n\", description: \"d\", latency: (fixed: 0.0, jitter: 0.0), loss: None)");
        assert_eq!(
            (radio.loss, radio.duplication, radio.late, radio.range, radio.budget),
            (LossModel::None, 0.0, None, None, None)
        );
    }

    #[test]
    fn a_preset_reads_back_as_it_was_written() {
        let budget = Budget { bytes_per_second: 100.0, burst: 50.0, shared_by: SharedBy::Sender };
        let radio =
            Radio { loss: LossModel::Independent(0.2), range: Some(6.0), budget: Some(budget), ..good() };
        assert_eq!(read(&ron_options().to_string(&radio).unwrap()), radio);
    }

    #[test]
    fn an_unknown_field_is_refused() {
        let text =
            "(name: \"n\", description: \"d\", latency: (fixed: 0.0, jitter: 0.0), loss: None, power: 1.0)";
        assert!(ron_options().from_str::<Radio>(text).is_err());
    }

    #[test]
    fn a_bad_number_is_named_with_its_field() {
        let elliott =
            |to_bad| LossModel::GilbertElliott { to_bad, to_good: 0.1, loss_in_good: 0.0, loss_in_bad: 1.0 };
        let tail = |min, max| Some(LateTail { share: 0.1, min, max });
        let bucket =
            |bytes_per_second, burst| Some(Budget { bytes_per_second, burst, shared_by: SharedBy::All });
        assert_eq!(bad_field(|r| r.latency.fixed = -0.1), "latency.fixed");
        assert_eq!(bad_field(|r| r.latency.fixed = 1e30), "latency.fixed");
        assert_eq!(bad_field(|r| r.latency.jitter = f32::NAN), "latency.jitter");
        assert_eq!(bad_field(|r| r.loss = LossModel::Independent(1.5)), "loss");
        assert_eq!(bad_field(|r| r.loss = elliott(-0.1)), "loss.to_bad");
        let fading = LossModel::Fading { good: 1.0, bad: 0.0, loss_in_good: 0.0, loss_in_bad: 1.0 };
        assert_eq!(bad_field(|r| r.loss = fading), "loss.bad");
        let stalls = Stalls { every: 1.0, least: 0.1, most: 0.05, shape: 1.0 };
        assert_eq!(bad_field(|r| r.stalls = Some(stalls)), "stalls.most");
        assert_eq!(bad_field(|r| r.duplication = 2.0), "duplication");
        assert_eq!(bad_field(|r| r.late = tail(-1.0, 1.0)), "late.min");
        assert_eq!(bad_field(|r| r.late = tail(2.0, 1.0)), "late.max");
        assert_eq!(bad_field(|r| r.late = tail(1.0, f32::INFINITY)), "late.max");
        assert_eq!(bad_field(|r| r.range = Some(0.0)), "range");
        assert_eq!(bad_field(|r| r.budget = bucket(0.0, 10.0)), "budget.bytes_per_second");
        assert_eq!(bad_field(|r| r.budget = bucket(10.0, -1.0)), "budget.burst");
    }
}
