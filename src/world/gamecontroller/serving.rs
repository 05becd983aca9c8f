//! How each penalty is served.

use super::control::Penalty;

/// What becomes of a penalised robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Serving {
    /// It stands where it is and keeps what it knows.
    InPlace,
    /// It is carried off, and comes back at a side line.
    CarriedOff,
    /// It does not take part: it is off until the box lets it play.
    NotPlaying,
}

impl Serving {
    /// How it ends a sentence about a robot.
    pub fn words(self) -> &'static str {
        match self {
            Serving::InPlace => "stands where it is",
            Serving::CarriedOff => "is carried off",
            Serving::NotPlaying => "does not play",
        }
    }
}

impl Penalty {
    /// How the penalty is served; none for a player without one. One that we do not know is served off the pitch.
    pub fn serving(self) -> Option<Serving> {
        match self {
            Penalty::None => None,
            // The robot has moved before the ball was in play, and is frozen until some time after the kick-off.
            Penalty::MotionInSet => Some(Serving::InPlace),
            Penalty::Substitute | Penalty::SentOff => Some(Serving::NotPlaying),
            Penalty::IllegalPosition
            | Penalty::IllegalPositionInSet
            | Penalty::MotionInStop
            | Penalty::MotionInStandby
            | Penalty::LocalGameStuck
            | Penalty::Inactive
            | Penalty::PickUp
            | Penalty::BallContact
            | Penalty::BallHolding
            | Penalty::LeavingTheField
            | Penalty::ArmsOrHands
            | Penalty::Pushing
            | Penalty::Stance
            | Penalty::Cautioned
            | Penalty::Manual
            | Penalty::Other(_) => Some(Serving::CarriedOff),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::codes::{Code, Coded};
    use super::super::control::Version;
    use super::*;

    #[test]
    fn who_is_sent_off_or_a_substitute_does_not_play_and_all_others_but_the_frozen_are_carried_off() {
        for (penalty, _) in Penalty::ROWS.iter().chain([&(Penalty::Other(99), [Code::Is(99); 3])]) {
            let expected = match penalty {
                Penalty::None => None,
                Penalty::MotionInSet => Some("stands where it is"),
                Penalty::Substitute | Penalty::SentOff => Some("does not play"),
                _ => Some("is carried off"),
            };
            assert_eq!(penalty.serving().map(Serving::words), expected, "{penalty}");
        }
    }

    #[test]
    fn motion_in_set_is_served_in_place_in_every_version_and_other_penalties_are_not() {
        for (version, number) in Version::ALL.into_iter().zip([3, 2, 2]) {
            let in_place = (0..=u8::MAX)
                .filter(|number| Penalty::read(*number, version).serving() == Some(Serving::InPlace));
            assert_eq!(in_place.collect::<Vec<_>>(), [number], "{version:?}");
        }
    }
}
