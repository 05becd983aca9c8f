use std::collections::BTreeMap;
use std::fs;

use proptest::prelude::*;
use serde::Deserialize;

use super::*;

#[derive(Debug, Deserialize, PartialEq)]
struct Metres(f32);

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Ring {
    radius: Metres,
    gain: Option<f32>,
    count: Option<u32>,
}

#[derive(Debug, Deserialize, PartialEq)]
enum Schema {
    Avoid(Ring),
    Go(f32, f32),
    At((f32, f32)),
    Turn { by: f32 },
    Stop,
    All(Vec<Schema>),
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Plan {
    name: String,
    #[serde(default)]
    schemas: BTreeMap<String, Schema>,
    #[serde(default)]
    spots: Vec<(f32, f32)>,
    #[serde(default)]
    numbers: BTreeMap<u32, Ring>,
}

fn parse(text: &str) -> Result<Plan, DataError> {
    Source::new("x.ron", text).parse()
}

/// What is wrong with a plan that holds these fields on its second line.
fn trouble(fields: &str) -> String {
    parse(&format!("(name: \"é\",\n{fields})")).unwrap_err().to_string()
}

#[test]
fn some_newtypes_and_the_inner_brackets_of_variants_are_left_out() {
    let text = r#"Plan(name: "a", schemas: {
        "a": Avoid(radius: 0.5, gain: 2), "b": At(1, 2), "c": All([Stop, Go(1.0, 2.0), Turn(by: 3)]),
    })"#;
    let ring = Ring { radius: Metres(0.5), gain: Some(2.0), count: None };
    let all = Schema::All(vec![Schema::Stop, Schema::Go(1.0, 2.0), Schema::Turn { by: 3.0 }]);
    let schemas = [("a", Schema::Avoid(ring)), ("b", Schema::At((1.0, 2.0))), ("c", all)];
    assert!(parse(text).unwrap().schemas.into_values().eq(schemas.map(|(_, schema)| schema)));
}

#[test]
fn an_unknown_field_is_reported_where_it_stands() {
    let error = trouble("/* ( */ nme : 3");
    assert_eq!(error, "x.ron:2:9: nme: there is no field `nme`; known: name, schemas, spots, numbers");
}

#[test]
fn a_missing_field_is_reported_at_the_struct_that_lacks_it() {
    assert_eq!(parse(" ()").unwrap_err().to_string(), "x.ron:1:2: the field `name` is missing");
    let error = trouble(r#"schemas: {"a b": Avoid(gain: 1)}"#);
    assert_eq!(error, r#"x.ron:2:18: schemas["a b"].Avoid: the field `radius` is missing"#);
    assert_eq!(trouble("numbers: {7: ()}"), "x.ron:2:14: numbers.7: the field `radius` is missing");
}

#[test]
fn a_field_given_twice_is_reported_at_the_second() {
    assert_eq!(trouble(r#"name: "b""#), "x.ron:2:1: name: the field `name` is given twice");
}

#[test]
fn a_key_given_twice_is_reported_at_the_second() {
    let error = trouble("schemas: {\"a\": Stop,\n \"b\": All([Stop]),\n \"a\": Stop}");
    assert_eq!(error, "x.ron:4:2: schemas.a: `a` is given twice, first in line 2");
    let error = trouble("numbers: {7: (radius: 1), 0x7: (radius: 2)}");
    assert_eq!(error, "x.ron:2:27: numbers.7: `7` is given twice, first in line 2");
}

#[test]
fn a_name_twice_in_a_list_is_reported_at_the_second() {
    let source = Source::new("x.ron", "(kinds: [\"a\", \"b\",\n\"a\"])");
    let kinds = Field::root().key("kinds");
    assert_eq!(source.distinct(&kinds, &["a", "b"]), Ok(()));
    let error = source.distinct(&kinds, &["a", "b", "a"]).unwrap_err();
    assert_eq!(error.to_string(), "x.ron:2:1: kinds[2]: `a` is given twice");
}

#[test]
fn a_wrong_type_is_reported_at_the_value() {
    for (fields, expected) in [
        ("spots: [(1, 2), (3, nine)]", "2:21: spots[1][1]: expected a number"),
        ("spots: [(1, 2), (3)]", "2:17: spots[1]: expected a tuple of size 2 but found one element instead"),
        (
            "schemas: {\"a\": All([Stop, Turn(by: true)])}",
            "2:36: schemas.a.All[1].Turn.by: expected a number",
        ),
        ("numbers: {7: (radius: 1, count: -1)}", "2:33: numbers.7.count: integer is out of bounds"),
        ("numbers: {7: (radius: 1, count: 1.5)}", "2:34: numbers.7: expected a whole number"),
        ("schemas: {\"a\": 3}", "2:16: schemas.a: expected a name"),
        ("schemas: {a: Stop}", "2:11: schemas: expected a string in quotes"),
    ] {
        assert_eq!(trouble(fields), format!("x.ron:{expected}"));
    }
}

#[test]
fn an_unknown_variant_is_reported_with_those_that_exist() {
    let error = trouble(r#"schemas: {"a": Avid (radius: 1)}"#);
    let message = "there is no variant `Avid`; known: Avoid, Go, At, Turn, Stop, All";
    assert_eq!(error, format!("x.ron:2:16: schemas.a: {message}"));
}

#[test]
fn text_that_is_not_ron_is_reported_where_it_stops_making_sense() {
    for (text, expected) in [
        ("(name: \"é\"\n  spots: [])", "x.ron:2:3: expected a comma or a closing bracket before this"),
        ("(name: \"é\"", "x.ron:1:11: expected a comma or a closing bracket here"),
        ("(name: \"é", "x.ron:1:8: name: this string is never closed"),
        ("(name: \"é\",) x", "x.ron:1:14: there is text after the end of the value"),
        ("(name = 3)", "x.ron:1:7: expected a colon"),
        ("", "x.ron: the file is empty"),
        ("// only a comment\n", "x.ron: the file is empty"),
        ("/* open", "x.ron:1:8: unclosed block comment"),
    ] {
        assert_eq!(parse(text).unwrap_err().to_string(), expected);
    }
}

#[test]
fn superfluous_brackets_in_a_variant_are_explained() {
    let error = trouble(r#"schemas: {"a": Avoid((radius: 1))}"#);
    let message = "expected a name, as one pair of brackets is enough here";
    assert_eq!(error, format!("x.ron:2:22: schemas.a.Avoid: {message}"));
}

#[test]
fn the_outside_of_a_text_is_told_from_comments_and_strings() {
    let top = |text| {
        Source::new("x.ron", text)
            .top_level()
            .map_err(|error| error.to_string())
            .map(|top| format!("{top:?}"))
    };
    let text = "#![enable(implicit_some)] // a: 1\nPlan(r#b /* c: */ : (d: 1), e: \"f: 2\", g: )";
    assert_eq!(top(text), Ok(r#"Struct(["b", "e", "g"])"#.into()));
    assert_eq!(top("{\"a\": 1}"), Ok(r#"Map(["a"])"#.into()));
    assert_eq!(top("[a]\nb = 1"), Ok("Other".into()));
    assert_eq!(top(" // a: 1"), Err("x.ron: the file is empty".into()));
}

#[test]
fn errors_found_after_parsing_point_at_the_value() {
    let source = Source::new("x.ron", "(\n  // ]\n  spots: [(1, 2), (3, NaN)],\n)");
    let field = Field::root().key("spots").index(1).index(1);
    let error = source.within(&field, f32::NAN, Bound::PLACE).unwrap_err();
    assert_eq!(error.to_string(), "x.ron:3:23: spots[1][1]: must be a number, not NaN");
    let spot = Field::root().key("spots").index(1);
    let error = source.vector_within(&spot, Vec2::new(3.0, f32::NAN), Bound::PLACE).unwrap_err();
    assert_eq!(error.field, field);
    assert_eq!(source.within(&field, 1.5, Bound::PLACE), Ok(()));
    let lost = source.error_at(&Field::root().key("walls"), "there are no walls");
    assert_eq!(lost.to_string(), "x.ron:1:1: walls: there are no walls");
}

#[test]
fn files_are_read_without_byte_order_mark() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ron");
    fs::write(&path, "\u{feff}(name: \"a\")").unwrap();
    assert_eq!(Source::read(&path).unwrap(), Source::new(&path, "(name: \"a\")"));
}

#[test]
fn files_that_cannot_be_read_are_errors_that_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("b.ron");
    let message = |path: &Path| Source::read(path).unwrap_err().message;
    assert_eq!(message(&path), "no such file");
    assert_eq!(message(&folder.path().join("none/b.ron")), "no such file");
    for name in ["c.ron", "a.ron", "d.txt"] {
        fs::write(folder.path().join(name), b"(\n \xc3\xa9\xff)").unwrap();
    }
    assert_eq!(message(&path), "no such file; there are: a, c");
    assert_eq!(message(folder.path()), "is a folder, not a file");
    fs::write(folder.path().join("huge"), vec![b' '; (4 << 20) + 1]).unwrap();
    assert_eq!(message(&folder.path().join("huge")), "is longer than 4 MB");
    let error = Source::read(folder.path().join("a.ron")).unwrap_err();
    assert!(error.to_string().ends_with("a.ron:2:3: not UTF-8 text from here"));
    assert_eq!(message(Path::new("")), "no such file");
}

#[test]
fn values_nested_too_deeply_are_an_error() {
    let deep = format!("(name: \"\", schemas: {{\"\": {}", "All([".repeat(10_000));
    assert!(parse(&deep).unwrap_err().message.contains("recursion limit"));
}

proptest! {
    #[test]
    fn parsing_any_text_is_a_value_or_an_error_of_one_line(
        text in "\\PC*|(\\(name: \"a\",\n)?([\\[\\](){},:\"'\\\\#!r/* \nab0-2é.-]|schemas: |All|Go|spots|numbers){0,40}",
    ) {
        if let Err(error) = parse(&text) {
            prop_assert_eq!(error.to_string().lines().count(), 1);
        }
    }
}
