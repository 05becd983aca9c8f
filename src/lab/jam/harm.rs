//! What counts as harm.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::Serialize;

use crate::game::Match;
use crate::game::record::{Invariant, Invariants};
use crate::ids::Team;
use crate::lab::scenario::{Condition, Expectation};

/// What counts as harm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Harm {
    /// Home breaks an invariant.
    Broken(Invariant),
    /// Away scores.
    GoalAgainst,
    /// Two robots of home play one role for so long, s.
    DoubledRole(f32),
}

impl Harm {
    /// How often it was done so far.
    pub(super) fn count(self, game: &Match) -> u32 {
        match self {
            Harm::Broken(invariant) => {
                let broken = &game.world().resource::<Invariants>().broken;
                let of_home = [Some(Team::Home), None].map(|team| broken.get(&(invariant, team)));
                of_home.into_iter().flatten().map(|count| count.times).sum()
            }
            Harm::GoalAgainst => game.state().score[Team::Away.index()],
            Harm::DoubledRole(seconds) => {
                let doubled = game.record().role_cover[Team::Home.index()].doubled.now;
                // As long as that but for the rounding of sums of ticks.
                u32::from(doubled + 1e-6 >= f64::from(seconds))
            }
        }
    }

    /// What a scenario says in which it must not be done.
    pub(super) fn forbidden(self, from: f32, because: String) -> Expectation {
        let what = match self {
            Harm::Broken(invariant) => Condition::Broken { invariant, team: Some(Team::Home) },
            Harm::GoalAgainst => Condition::Goals { team: Team::Away, at_least: Some(1), at_most: None },
            Harm::DoubledRole(seconds) => {
                let doubled = Condition::Not(Box::new(Condition::RolesDistinct(Team::Home)));
                Condition::For { seconds, what: Box::new(doubled) }
            }
        };
        Expectation::Never { what, from, until: None, because }
    }
}

impl FromStr for Harm {
    type Err = String;

    fn from_str(text: &str) -> Result<Harm, String> {
        if let Some(seconds) = text.strip_prefix("DoubledRole:") {
            let seconds = seconds.parse::<f32>().ok().filter(|seconds| (0.01..=60.0).contains(seconds));
            return seconds
                .map(Harm::DoubledRole)
                .ok_or_else(|| "DoubledRole: needs seconds, from 0.01 to 60".into());
        }
        let found = Invariant::ALL.into_iter().find(|invariant| format!("{invariant:?}") == text);
        let harm = found.map(Harm::Broken).or((text == "GoalAgainst").then_some(Harm::GoalAgainst));
        harm.ok_or_else(|| {
            let known: Vec<String> =
                Invariant::ALL.iter().map(|invariant| format!("{invariant:?}")).collect();
            format!("no such harm; known: GoalAgainst, DoubledRole:SECONDS, {}", known.join(", "))
        })
    }
}

impl Display for Harm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Harm::Broken(invariant) => invariant.fmt(f),
            Harm::GoalAgainst => f.write_str("a goal against home"),
            Harm::DoubledRole(seconds) => write!(f, "a role is doubled for {seconds} s"),
        }
    }
}
