//! How desirable a tactical behaviour is in a situation: a degree from 0 to 1. Degrees are combined as truth values are in fuzzy
//! logic, by least and greatest.

use serde::{Deserialize, Serialize};

use super::language::{Feature, Point};

/// A degree from 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Desirability {
    /// Always the same.
    Degree(f32),
    /// 1 while a statement is true, 0 while it is not.
    If(Feature),
    /// By the distance between two points, m: 1 at `full`, 0 at `none`, on a straight line in between and the same beyond. 0 while
    /// a point is unknown.
    Distance { a: Point, b: Point, full: f32, none: f32 },
    /// What is missing to 1.
    Not(Box<Desirability>),
    /// The least of these; 1 for none.
    All(Vec<Desirability>),
    /// The greatest of these; 0 for none.
    Any(Vec<Desirability>),
}
