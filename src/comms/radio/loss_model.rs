//! How messages are lost by chance.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all};
use crate::ops;

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
    /// The same in time: a link is good for so long in the mean and then bad, however much is sent. It begins good.
    Fading {
        /// s
        good: f32,
        /// s
        bad: f32,
        loss_in_good: f32,
        loss_in_bad: f32,
    },
}

/// The state of a link whose losses come in bursts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LinkFade {
    bad: bool,
    /// The time of the last message, s.
    seen: f64,
}

impl LossModel {
    /// Whether the next message of a link, sent at `now`, s, is lost. The two numbers are fresh and uniform in [0, 1), one for the
    /// link's change and one for the message.
    pub(super) fn loses(&self, fade: &mut LinkFade, now: f64, change: f32, message: f32) -> bool {
        match *self {
            LossModel::None => false,
            LossModel::Independent(chance) => message < chance,
            LossModel::GilbertElliott { to_bad, to_good, loss_in_good, loss_in_bad } => {
                fade.bad = if fade.bad { change >= to_good } else { change < to_bad };
                message < if fade.bad { loss_in_bad } else { loss_in_good }
            }
            LossModel::Fading { good, bad, loss_in_good, loss_in_bad } => {
                // The chance to be bad tends to its share of time, the slower the longer the link stays as it is.
                let (share, rate) = (bad / (good + bad), 1.0 / good + 1.0 / bad);
                let since = (now - fade.seen).max(0.0) as f32;
                let was = if fade.bad { 1.0 } else { 0.0 };
                let chance = share + (was - share) * ops::exp(-rate * since);
                *fade = LinkFade { bad: change < chance, seen: now };
                message < if fade.bad { loss_in_bad } else { loss_in_good }
            }
        }
    }
}

impl Validate for LossModel {
    fn validate(&self) -> Result<(), Fault> {
        match *self {
            LossModel::None => Ok(()),
            LossModel::Independent(chance) => Bound::SHARE.check("", chance),
            LossModel::GilbertElliott { to_bad, to_good, loss_in_good, loss_in_bad } => check_all([
                ("to_bad", to_bad, Bound::SHARE),
                ("to_good", to_good, Bound::SHARE),
                ("loss_in_good", loss_in_good, Bound::SHARE),
                ("loss_in_bad", loss_in_bad, Bound::SHARE),
            ]),
            LossModel::Fading { good, bad, loss_in_good, loss_in_bad } => check_all([
                ("good", good, Bound::SECONDS.positive()),
                ("bad", bad, Bound::SECONDS.positive()),
                ("loss_in_good", loss_in_good, Bound::SHARE),
                ("loss_in_bad", loss_in_bad, Bound::SHARE),
            ]),
        }
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
            LossModel::GilbertElliott { loss_in_good, loss_in_bad, .. }
            | LossModel::Fading { loss_in_good, loss_in_bad, .. } => {
                let bad = self.bad_share();
                bad * loss_in_bad + (1.0 - bad) * loss_in_good
            }
        }
    }

    /// The mean number of messages that are lost in a row: 0 if none is ever lost, infinite if all are. Of a link that fades in time it is
    /// not known.
    pub(super) fn mean_burst(&self) -> f32 {
        let lost = self.mean_loss();
        if lost <= 0.0 {
            return 0.0;
        }
        // The chance that two messages in a row are lost.
        let both = match *self {
            LossModel::None | LossModel::Independent(_) => lost * lost,
            LossModel::Fading { .. } => f32::NAN,
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
            LossModel::Fading { good, bad, .. } => bad / (good + bad),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

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
