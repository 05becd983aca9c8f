//! How good a radio is, as data: the named presets in `assets/radios/*.ron`.
//!
//! Times are seconds, lengths metres; shares and chances lie between 0 and 1.

use serde::{Deserialize, Serialize};

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
    /// Nothing is heard farther away, m. Unlimited if left out.
    #[serde(default)]
    pub range: Option<f32>,
    /// Unlimited if left out.
    #[serde(default)]
    pub budget: Option<Budget>,
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

/// How messages are lost by chance, on each directed link for itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum LossModel {
    /// No message is lost.
    None,
    /// Each message with this chance.
    Independent(f32),
    /// A link is good or bad, and may change with each message. It begins good.
    GilbertElliott {
        /// Chance per message that a good link turns bad before the message is sent.
        to_bad: f32,
        /// Chance per message that a bad link turns good before the message is sent.
        to_good: f32,
        loss_in_good: f32,
        loss_in_bad: f32,
    },
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

impl LossModel {
    /// Whether the next message of a link is lost. `bad` is the link's state; the two numbers are fresh and uniform in
    /// [0, 1), one for the link's change and one for the message.
    pub(super) fn loses(&self, bad: &mut bool, change: f32, message: f32) -> bool {
        match *self {
            LossModel::None => false,
            LossModel::Independent(chance) => message < chance,
            LossModel::GilbertElliott { to_bad, to_good, loss_in_good, loss_in_bad } => {
                *bad = if *bad { change >= to_good } else { change < to_bad };
                message < if *bad { loss_in_bad } else { loss_in_good }
            }
        }
    }
}

impl Validate for Radio {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("latency.fixed", self.latency.fixed, Bound::DELAY),
            ("latency.jitter", self.latency.jitter, Bound::DELAY),
            ("duplication", self.duplication, Bound::SHARE),
        ])?;
        match self.loss {
            LossModel::None => {}
            LossModel::Independent(chance) => Bound::SHARE.check("loss", chance)?,
            LossModel::GilbertElliott { to_bad, to_good, loss_in_good, loss_in_bad } => check_all([
                ("loss.to_bad", to_bad, Bound::SHARE),
                ("loss.to_good", to_good, Bound::SHARE),
                ("loss.loss_in_good", loss_in_good, Bound::SHARE),
                ("loss.loss_in_bad", loss_in_bad, Bound::SHARE),
            ])?,
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
        if let Some(budget) = self.budget {
            check_all([
                ("budget.bytes_per_second", budget.bytes_per_second, Bound::BYTES.positive()),
                ("budget.burst", budget.burst, Bound::BYTES.positive()),
            ])?;
        }
        Ok(())
    }
}

/// What a model promises, for the tests to hold it to.
#[cfg(test)]
impl LossModel {
    /// The share of the messages that is lost in the long run.
    pub(super) fn mean_loss(&self) -> f32 {
        match *self {
            LossModel::None => 0.0,
            LossModel::Independent(chance) => chance,
            LossModel::GilbertElliott { loss_in_good, loss_in_bad, .. } => {
                let bad = self.bad_share();
                bad * loss_in_bad + (1.0 - bad) * loss_in_good
            }
        }
    }

    /// The mean number of messages that are lost in a row: 0 if none is ever lost, infinite if all are.
    pub(super) fn mean_burst(&self) -> f32 {
        let lost = self.mean_loss();
        if lost <= 0.0 {
            return 0.0;
        }
        // The chance that two messages in a row are lost.
        let both = match *self {
            LossModel::None | LossModel::Independent(_) => lost * lost,
            LossModel::GilbertElliott { to_bad, to_good, loss_in_good, loss_in_bad } => {
                let bad = self.bad_share();
                let after_bad = (1.0 - to_good) * loss_in_bad + to_good * loss_in_good;
                let after_good = (1.0 - to_bad) * loss_in_good + to_bad * loss_in_bad;
                bad * loss_in_bad * after_bad + (1.0 - bad) * loss_in_good * after_good
            }
        };
        lost / (lost - both).max(0.0)
    }

    /// The share of its messages for which a link is bad; a link that never turns bad never is.
    fn bad_share(&self) -> f32 {
        match *self {
            LossModel::GilbertElliott { to_bad, to_good, .. } if to_bad > 0.0 => to_bad / (to_bad + to_good),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

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
        assert_eq!(bad_field(|r| r.duplication = 2.0), "duplication");
        assert_eq!(bad_field(|r| r.late = tail(-1.0, 1.0)), "late.min");
        assert_eq!(bad_field(|r| r.late = tail(2.0, 1.0)), "late.max");
        assert_eq!(bad_field(|r| r.late = tail(1.0, f32::INFINITY)), "late.max");
        assert_eq!(bad_field(|r| r.range = Some(0.0)), "range");
        assert_eq!(bad_field(|r| r.budget = bucket(0.0, 10.0)), "budget.bytes_per_second");
        assert_eq!(bad_field(|r| r.budget = bucket(10.0, -1.0)), "budget.burst");
    }

    #[test]
    fn losses_in_a_row_follow_from_the_chances() {
        assert_eq!(LossModel::None.mean_burst(), 0.0);
        assert_eq!(LossModel::Independent(0.0).mean_burst(), 0.0);
        assert_eq!(LossModel::Independent(0.5).mean_burst(), 2.0);
        assert_eq!(LossModel::Independent(1.0).mean_burst(), f32::INFINITY);
    }

    #[test]
    fn a_link_that_never_turns_bad_loses_as_a_good_one() {
        let model =
            LossModel::GilbertElliott { to_bad: 0.0, to_good: 0.0, loss_in_good: 0.1, loss_in_bad: 1.0 };
        assert_eq!(model.mean_loss(), 0.1);
    }

    proptest! {
        #[test]
        fn a_model_that_loses_as_much_in_both_states_is_independent(
            to_bad in 0.01f32..1.0,
            to_good in 0.01f32..1.0,
            p in 0.01f32..0.9,
        ) {
            let model = LossModel::GilbertElliott { to_bad, to_good, loss_in_good: p, loss_in_bad: p };
            prop_assert!((model.mean_loss() - p).abs() < 1e-5);
            prop_assert!((model.mean_burst() / LossModel::Independent(p).mean_burst() - 1.0).abs() < 1e-3);
        }
    }
}
