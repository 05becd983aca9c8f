//! Policies as a strategy file spells them, and what is wrong with their numbers.

use super::*;
use crate::data::ron_options;

fn read(text: &str) -> Policy {
    ron_options().from_str(text).unwrap()
}

#[test]
fn every_policy_can_be_written_with_nothing_but_its_name() {
    let texts = ["CaseBased()", "ClosestBecomesForward()", "CsFreiburg()", "Art()", "Rmit()", "Optimal()"];
    assert_eq!(texts.map(read).to_vec(), properties::policies());
}

#[test]
fn a_constant_that_is_written_replaces_its_default() {
    let places = Places { guard: 0.3, ..Places::default() };
    let expected = Policy::Optimal(Optimal { places, min_gain: 2.5, ..Optimal::default() });
    assert_eq!(read("Optimal(min_gain: 2.5, places: (guard: 0.3))"), expected);
    assert!(ron_options().from_str::<Policy>("Optimal(gain: 2.5)").is_err());
}

#[test]
fn the_defaults_are_sound() {
    assert!(properties::policies().iter().all(|policy| policy.validate().is_ok()));
}

#[test]
fn a_bad_constant_is_named_with_its_field() {
    for (text, field, message) in [
        ("CaseBased(beyond: 1.5)", "beyond", "must be at most 1, not 1.5"),
        ("ClosestBecomesForward(beyond: -1.0)", "beyond", "must be at least 0, not -1"),
        ("CsFreiburg(half: 0.0)", "half", "must be at least 0.001 m, not 0"),
        ("CsFreiburg(places: (guard: NaN))", "places.guard", "must be a number, not NaN"),
        ("Art(enter: 1.0, leave: 1.0)", "leave", "must be less than enter, 1, not 1"),
        ("Rmit(bonus: -0.5)", "bonus", "must be at least 0 m, not -0.5"),
        ("Art(max_age: inf)", "max_age", "must be at most 86400 s, not inf"),
        ("Optimal(min_gain: -1.0)", "min_gain", "must be at least 0 m, not -1"),
    ] {
        assert_eq!(read(text).validate(), Err(Fault::new(field, message)), "{text}");
    }
}
