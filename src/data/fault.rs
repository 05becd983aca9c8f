//! What is wrong inside a value that a file holds, and how a type says so.

use std::ops::RangeInclusive;

use super::field::Field;

/// What is wrong with a value, and with which part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// From the value that was checked inwards.
    pub field: Field,
    /// In words, without the place.
    pub message: String,
}

impl Fault {
    /// A fault of the part that a path such as `loss.to_bad` or `reach.0` leads to; of the whole, if it is empty.
    pub fn new(field: &str, message: impl Into<String>) -> Fault {
        let root = Field::root();
        let field = if field.is_empty() { root } else { root.dotted(field) };
        Fault { field, message: message.into() }
    }

    /// The same fault, seen from a value of which the checked one is a part.
    #[must_use]
    pub fn inside(self, outer: &Field) -> Fault {
        Fault { field: outer.inside(self.field.segments()), ..self }
    }
}

/// What comes from a file, an option or a hand, and may hold numbers with which nothing can be done.
pub trait Validate {
    /// Checks every number of it.
    ///
    /// # Errors
    /// The first fault.
    fn validate(&self) -> Result<(), Fault>;

    /// As [`Validate::validate`], for the part `field` of something larger.
    ///
    /// # Errors
    /// The first fault, seen from outside.
    fn validate_as(&self, field: &str) -> Result<(), Fault> {
        self.validate().map_err(|fault| fault.inside(&Field::root().key(field)))
    }
}

/// What is not there is sound.
impl<T: Validate> Validate for Option<T> {
    fn validate(&self) -> Result<(), Fault> {
        self.as_ref().map_or(Ok(()), T::validate)
    }
}

/// Checks that something holds for a field; the message says what is wrong.
///
/// # Errors
/// If it does not hold.
pub fn ensure(holds: bool, field: &str, message: impl FnOnce() -> String) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(Fault::new(field, message())) }
}

/// Checks a whole number. The message begins with `what`, such as "the number of corners".
///
/// # Errors
/// If it is less or more than it may be.
pub fn check_count(
    field: &str,
    what: &str,
    count: usize,
    within: RangeInclusive<usize>,
) -> Result<(), Fault> {
    let (side, limit) = match () {
        () if count > *within.end() => ("most", within.end()),
        () if count < *within.start() => ("least", within.start()),
        () => return Ok(()),
    };
    Err(Fault::new(field, format!("{what} must be at {side} {limit}, not {count}").trim_start()))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Share(f32);

    impl Validate for Share {
        fn validate(&self) -> Result<(), Fault> {
            ensure(self.0 <= 1.0, "0", || format!("{} is more than there is", self.0))
        }
    }

    #[test]
    fn a_fault_is_seen_from_the_value_around_it() {
        assert_eq!(Share(1.0).validate_as("cake"), Ok(()));
        assert_eq!(None::<Share>.validate(), Ok(()));
        let fault =
            Some(Share(2.0)).validate_as("cake").unwrap_err().inside(&Field::root().key("plates").index(3));
        assert_eq!(
            (fault.field.to_string().as_str(), fault.message.as_str()),
            ("plates[3].cake[0]", "2 is more than there is")
        );
        assert_eq!(Fault::new("", "is empty").inside(&Field::root().key("a")).field.to_string(), "a");
    }

    #[test]
    fn counts_have_bounds_too() {
        let message =
            |count| check_count("list", "the number of names", count, 1..=9).map_err(|fault| fault.message);
        assert_eq!(message(1), Ok(()));
        assert_eq!(message(0).unwrap_err(), "the number of names must be at least 1, not 0");
        assert_eq!(message(10).unwrap_err(), "the number of names must be at most 9, not 10");
        assert_eq!(check_count("list", "", 0, 1..=9).unwrap_err().message, "must be at least 1, not 0");
    }
}
