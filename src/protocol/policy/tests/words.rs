//! Policies as a strategy file spells them, and what is wrong with their numbers.

use super::*;
use crate::data::ron_options;

fn read(text: &str) -> Policy {
    ron_options().from_str(text).unwrap()
}

#[test]
fn every_policy_can_be_written_with_nothing_but_its_name() {
    let texts = [
        "CaseBased()",
        "ClosestBecomesForward()",
        "CsFreiburg()",
        "Art()",
        "Rmit()",
        "ItalianGolem()",
        "Optimal()",
    ];
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
    assert!(properties::policies().iter().all(|policy| policy.fault().is_none()));
}

#[test]
fn a_bad_constant_is_named_with_its_field() {
    let fault = |text| read(text).fault().expect(text);
    assert_eq!(fault("CaseBased(beyond: 1.5)"), ("beyond".into(), "must be at most 1, not 1.5".into()));
    assert_eq!(fault("ClosestBecomesForward(beyond: -1.0)").0, "beyond");
    assert_eq!(fault("CsFreiburg(half: 0.0)"), ("half".into(), "must be at least 0.001 m, not 0".into()));
    assert_eq!(fault("CsFreiburg(places: (guard: NaN))").0, "places.guard");
    assert_eq!(
        fault("Art(enter: 1.0, leave: 1.0)"),
        ("leave".into(), "must be less than enter, 1, not 1".into())
    );
    assert_eq!(fault("Rmit(bonus: -0.5)"), ("bonus".into(), "must be at least 0 m, not -0.5".into()));
    assert_eq!(fault("ItalianGolem(max_age: inf)").0, "max_age");
    assert_eq!(fault("Optimal(min_gain: -1.0)").0, "min_gain");
}
