//! What the constants of a policy must be like.

pub(super) type Fault = (&'static str, String);

#[derive(Clone, Copy)]
pub(super) enum Bound {
    Positive,
    AtLeast0,
    Share,
}

/// The first number that is out of bounds, by its field's path.
pub(super) fn first_fault(fields: &[(&'static str, f32, Bound)]) -> Option<Fault> {
    fields.iter().find_map(|(field, value, bound)| {
        let (sound, rule) = match bound {
            Bound::Positive => (*value > 0.0, "a positive number"),
            Bound::AtLeast0 => (*value >= 0.0, "at least 0"),
            Bound::Share => ((0.0..=1.0).contains(value), "between 0 and 1"),
        };
        (!(sound && value.is_finite())).then(|| (*field, format!("must be {rule}, not {value}")))
    })
}
