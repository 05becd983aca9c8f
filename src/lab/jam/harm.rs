//! What counts as harm.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::Serialize;

use crate::game::record::Invariant;

/// What counts as harm.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Harm {
    /// Home breaks an invariant.
    Broken(Invariant),
    /// Away scores.
    GoalAgainst,
}

impl FromStr for Harm {
    type Err = String;

    fn from_str(text: &str) -> Result<Harm, String> {
        let found = Invariant::ALL.into_iter().find(|invariant| format!("{invariant:?}") == text);
        let harm = found.map(Harm::Broken).or((text == "GoalAgainst").then_some(Harm::GoalAgainst));
        harm.ok_or_else(|| {
            let known: Vec<String> =
                Invariant::ALL.iter().map(|invariant| format!("{invariant:?}")).collect();
            format!("no such harm; known: GoalAgainst, {}", known.join(", "))
        })
    }
}

impl Display for Harm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Harm::Broken(invariant) => invariant.fmt(f),
            Harm::GoalAgainst => f.write_str("a goal against home"),
        }
    }
}
