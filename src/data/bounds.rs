//! The bounds of the numbers that a file, an option or a hand brings in: wide enough for every real use, and such that a match
//! computes safely with whatever lies within.

use bevy::math::Vec2;

use super::fault::Fault;

/// The least and the greatest value that a number may have, and its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    least: f32,
    most: f32,
    unit: &'static str,
}

/// What positive numbers are at least, in their units.
const SMALLEST: f32 = 0.001;

impl Bound {
    /// A share of a whole.
    pub const SHARE: Bound = Bound::up_to(1.0, "");
    /// A probability that trials can show: less than certainty.
    pub const PROBABILITY: Bound = Bound { least: SMALLEST, most: 0.999, unit: "" };
    /// How sure a verdict is: more than a guess, less than certainty.
    pub const CONFIDENCE: Bound = Bound { least: 0.5, most: 0.9999, unit: "" };
    /// When something happens or how long it takes: a day.
    pub const SECONDS: Bound = Bound::up_to(86_400.0, " s");
    /// A day.
    pub const MINUTES: Bound = Bound::up_to(1440.0, " min");
    /// By how much something comes late.
    pub const DELAY: Bound = Bound::up_to(600.0, " s");
    /// Times a second.
    pub const RATE: Bound = Bound::up_to(1000.0, " Hz");
    /// Between two things.
    pub const LENGTH: Bound = Bound::up_to(1000.0, " m");
    /// A coordinate.
    pub const PLACE: Bound = Bound::LENGTH.signed();
    /// Of a body or of a part of it.
    pub const SIZE: Bound = Bound::up_to(2.0, " m");
    /// Of a corner of a body.
    pub const CORNER: Bound = Bound::SIZE.signed();
    /// Length or width of a pitch.
    pub const PITCH: Bound = Bound { least: 1.0, most: 200.0, unit: " m" };
    /// A speed of a body.
    pub const SPEED: Bound = Bound::up_to(50.0, " m/s");
    /// Of one coordinate.
    pub const VELOCITY: Bound = Bound::SPEED.signed();
    /// An acceleration of a body.
    pub const ACCELERATION: Bound = Bound::up_to(1000.0, " m/s²");
    /// An angle without direction.
    pub const ANGLE: Bound = Bound::up_to(360.0, "°");
    /// From edge to edge of a picture.
    pub const VIEW: Bound = Bound { least: 10.0, most: 150.0, unit: "°" };
    /// By how much something sways or is held askew.
    pub const SWAY: Bound = Bound::up_to(20.0, "°");
    /// By how much a camera looks down.
    pub const NOD: Bound = Bound { least: -80.0, most: 80.0, unit: "°" };
    /// An angle with direction.
    pub const HEADING: Bound = Bound::ANGLE.signed();
    /// A speed of turning.
    pub const TURN_RATE: Bound = Bound::up_to(3600.0, "°/s");
    /// An acceleration of turning.
    pub const TURN_ACCELERATION: Bound = Bound::up_to(100_000.0, "°/s²");
    /// A mass.
    pub const MASS: Bound = Bound::up_to(1000.0, " kg");
    /// An impulse.
    pub const IMPULSE: Bound = Bound::up_to(10_000.0, " N·s");
    /// A force.
    pub const FORCE: Bound = Bound::up_to(10_000.0, " N");
    /// The stiffness of a spring.
    pub const STIFFNESS: Bound = Bound::up_to(100_000.0, " N/m");
    /// The damping of a spring.
    pub const DAMPING: Bound = Bound::up_to(10_000.0, " N·s/m");
    /// Per second.
    pub const GAIN: Bound = Bound::up_to(1000.0, "/s");
    /// Of friction and the like.
    pub const COEFFICIENT: Bound = Bound::up_to(10.0, "");
    /// What something else is multiplied with, or compared with without a unit.
    pub const FACTOR: Bound = Bound::up_to(1000.0, "");
    /// A weight of a schema.
    pub const WEIGHT: Bound = Bound::FACTOR.signed();
    /// A number of bytes.
    pub const BYTES: Bound = Bound::up_to(1e9, " bytes");
    /// How often something happened, or for how many seconds in all.
    pub const COUNT: Bound = Bound::up_to(1e15, "");
    /// Whatever a number of a file is about: no other bound is wider, but for counts.
    pub const ANY: Bound = Bound::up_to(1e9, "").signed();
    /// On a screen.
    pub const POINTS: Bound = Bound::up_to(100_000.0, " points");

    const fn up_to(most: f32, unit: &'static str) -> Bound {
        Bound { least: 0.0, most, unit }
    }

    /// The same bound without 0 and what is hardly more.
    pub const fn positive(self) -> Bound {
        Bound { least: SMALLEST, ..self }
    }

    /// The same bound on both sides of 0.
    pub const fn signed(self) -> Bound {
        Bound { least: -self.most, ..self }
    }

    /// Whether a value is within the bound.
    pub fn holds(self, value: f32) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// Checks the value of a field, as in `loss.to_bad` or `reach.0`.
    ///
    /// # Errors
    /// If it is out of the bound.
    pub fn check(self, field: &str, value: f32) -> Result<(), Fault> {
        let Bound { least, most, unit } = self;
        let rule = if value > most {
            format!("at most {}{unit}", written(most))
        } else if value < least {
            format!("at least {}{unit}", written(least))
        } else if value.is_nan() {
            "a number".to_owned()
        } else {
            return Ok(());
        };
        Err(Fault::new(field, format!("must be {rule}, not {}", written(value))))
    }

    /// Checks both coordinates of points in a list.
    ///
    /// # Errors
    /// The first coordinate that is out of the bound.
    pub fn check_points(self, field: &str, points: &[Vec2]) -> Result<(), Fault> {
        points.iter().enumerate().try_for_each(|(index, point)| {
            self.check(&format!("{field}.{index}.0"), point.x)?;
            self.check(&format!("{field}.{index}.1"), point.y)
        })
    }

    /// The value within the bound that is nearest; what is no number becomes the one nearest to 0.
    pub fn clamp(self, value: f32) -> f32 {
        if value.is_nan() { self.clamp(0.0) } else { value.clamp(self.least, self.most) }
    }

    /// A vector with both coordinates within the bound.
    pub fn clamp_vector(self, vector: Vec2) -> Vec2 {
        Vec2::new(self.clamp(vector.x), self.clamp(vector.y))
    }
}

/// A number as people write it: `1e30` instead of thirty zeros.
fn written(value: f32) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-4..1e7).contains(&value.abs());
    if plain { value.to_string() } else { format!("{value:e}") }
}

/// Checks numbers by their bounds.
///
/// # Errors
/// The first number that is out of its bound.
pub fn check_all<'a>(fields: impl IntoIterator<Item = (&'a str, f32, Bound)>) -> Result<(), Fault> {
    fields.into_iter().try_for_each(|(field, value, bound)| bound.check(field, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_side_of_a_bound_that_is_passed_is_named_with_its_unit() {
        let seconds = Bound::SECONDS;
        let message = |bound: Bound, value| bound.check("at", value).unwrap_err().message;
        assert_eq!(seconds.check("at", 0.0), Ok(()));
        assert_eq!(seconds.check("at", 86_400.0), Ok(()));
        assert_eq!(message(seconds, 1e30), "must be at most 86400 s, not 1e30");
        assert_eq!(message(seconds, f32::INFINITY), "must be at most 86400 s, not inf");
        assert_eq!(message(seconds, -1.5), "must be at least 0 s, not -1.5");
        assert_eq!(message(seconds, f32::NAN), "must be a number, not NaN");
        assert_eq!(message(seconds.positive(), 0.0), "must be at least 0.001 s, not 0");
        assert_eq!(message(seconds.positive(), 1e-30), "must be at least 0.001 s, not 1e-30");
        assert_eq!(message(Bound::PLACE, -1000.5), "must be at least -1000 m, not -1000.5");
        assert_eq!(message(Bound::SHARE, 2.0), "must be at most 1, not 2");
    }

    #[test]
    fn the_first_number_out_of_its_bounds_is_named() {
        let fields = |a, b| [("a", a, Bound::SHARE), ("b", b, Bound::LENGTH.positive())];
        assert_eq!(check_all(fields(1.0, 2.0)), Ok(()));
        assert_eq!(check_all(fields(1.0, 0.0)).unwrap_err().field.to_string(), "b");
        assert_eq!(check_all(fields(-1.0, 0.0)), Err(Fault::new("a", "must be at least 0, not -1")));
        let fault = Bound::SHARE.check_points("spots", &[Vec2::ONE, Vec2::new(0.5, 2.0)]).unwrap_err();
        assert_eq!(fault.field.to_string(), "spots[1][1]");
    }

    #[test]
    fn what_is_clamped_is_within_the_bound() {
        for bound in [Bound::SHARE, Bound::PLACE, Bound::MASS.positive()] {
            for value in [0.0, -1e30, 1e30, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.5] {
                assert!(bound.holds(bound.clamp(value)), "{bound:?} {value}");
            }
        }
        assert_eq!(Bound::VELOCITY.clamp_vector(Vec2::new(1.0, -1e9)), Vec2::new(1.0, -50.0));
    }
}
