//! The bounds that the numbers in a file keep.

/// A field's path, and what is wrong with its value.
pub type Fault = (&'static str, String);

/// What a number must be like, besides finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    Positive,
    AtLeast0,
    /// Between 0 and 1.
    Share,
}

/// The first number that is out of its bounds.
pub fn first_fault(fields: impl IntoIterator<Item = (&'static str, f32, Bound)>) -> Option<Fault> {
    fields.into_iter().find_map(|(field, value, bound)| {
        let (sound, rule) = match bound {
            Bound::Positive => (value > 0.0, "a positive number"),
            Bound::AtLeast0 => (value >= 0.0, "at least 0"),
            Bound::Share => ((0.0..=1.0).contains(&value), "between 0 and 1"),
        };
        (!(sound && value.is_finite())).then(|| (field, format!("must be {rule}, not {value}")))
    })
}

/// The fields of a preset with their values, by what they must be like.
#[derive(Clone, Debug, Default)]
pub struct Bounds {
    pub positive: Vec<(&'static str, f32)>,
    pub at_least_0: Vec<(&'static str, f32)>,
    pub shares: Vec<(&'static str, f32)>,
}

impl Bounds {
    /// The first field out of its bounds: first the positive ones, then those of at least 0, then the shares.
    pub fn fault(self) -> Option<Fault> {
        let bound = |list: Vec<(&'static str, f32)>, bound| {
            list.into_iter().map(move |(field, value)| (field, value, bound))
        };
        first_fault(
            bound(self.positive, Bound::Positive)
                .chain(bound(self.at_least_0, Bound::AtLeast0))
                .chain(bound(self.shares, Bound::Share)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_number_out_of_its_bounds_is_named_with_its_rule() {
        let bounds = |positive, at_least_0, share| Bounds {
            positive: vec![("a", positive)],
            at_least_0: vec![("b", at_least_0)],
            shares: vec![("c", share)],
        };
        assert_eq!(bounds(1.0, 0.0, 1.0).fault(), None);
        assert_eq!(bounds(0.0, -1.0, 2.0).fault(), Some(("a", "must be a positive number, not 0".into())));
        assert_eq!(bounds(1.0, -1.0, 2.0).fault(), Some(("b", "must be at least 0, not -1".into())));
        assert_eq!(bounds(1.0, 0.0, 2.0).fault(), Some(("c", "must be between 0 and 1, not 2".into())));
        assert_eq!(bounds(f32::INFINITY, 0.0, 0.0).fault().map(|fault| fault.0), Some("a"));
        assert_eq!(bounds(1.0, f32::NAN, 0.0).fault().map(|fault| fault.0), Some("b"));
    }
}
