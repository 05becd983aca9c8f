//! `touchline fit-eyes` as a person or a script calls it.

use serde_json::Value;

use super::{text, touchline};

fn json(arguments: &[&str]) -> Value {
    let output = touchline(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("the report is JSON")
}

const AIBO: [&str; 7] =
    ["fit-eyes", "--match", "four_legged_2005", "--camera", "aibo_ers7", "--views", "600"];

#[test]
fn a_calibrated_camera_recognises_the_ball_and_its_errors_grow_with_the_range() {
    let call = [&AIBO[..], &["--json"]].concat();
    let report = json(&call);
    let number = |field: &str| {
        let numbers = report["numbers"].as_array().expect("a list of numbers");
        let found = numbers.iter().find(|number| number["field"] == field).expect("the field is there");
        (found["file"].as_f64().expect("a number"), found["fitted"].as_f64().unwrap_or(f64::NAN))
    };
    assert_eq!((report["views"].as_u64(), report["interrupted"].as_bool()), (Some(600), Some(false)));
    assert!(number("detection").1 > 0.6, "{report}");
    assert!((1.0..=7.0).contains(&number("ball_range").1), "{report}");
    assert!(number("range_noise").1 > 0.0 && number("bearing_noise").1 > 0.0, "{report}");
    assert!((number("ball_range").0 - 5.9).abs() < 1e-6, "{report}");
    let bias = report["range_bias"].as_f64().expect("balls were seen");
    assert!(bias.abs() < 0.03, "ranges are wrong by a share of {bias} on average");
    assert_eq!(report, json(&call), "equal seeds give equal pictures");
}

#[test]
fn people_read_both_numbers_side_by_side() {
    let output = touchline(&["fit-eyes", "--camera", "cye_2001", "--views", "50"]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", text(&output.stderr));
    assert!(said.contains("ball_range") && said.contains("50 pictures, seed 1"), "{said}");
}

#[test]
fn a_camera_that_cannot_be_is_refused_in_one_line() {
    for (call, named) in [
        (&["fit-eyes", "--camera", "no_such_camera"][..], "no_such_camera"),
        (&["fit-eyes", "--camera", "cye_2001", "--match", "no_such_match"], "no_such_match"),
    ] {
        let output = touchline(call);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{call:?}: {message}");
        assert!(message.contains(named) && message.lines().count() == 1, "{call:?}: {message}");
    }
    let output = touchline(&["fit-eyes"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("--camera"), "{}", text(&output.stderr));
}
