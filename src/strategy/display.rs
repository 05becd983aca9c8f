//! Features as people read them, in transition logs and in the inspector.

use std::fmt;

use super::language::Feature;
use crate::data::ron_options;

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |f: &mut fmt::Formatter<'_>, parts: &[Feature], word: &str| {
            let parts: Vec<String> = parts.iter().map(Feature::to_string).collect();
            f.write_str(&parts.join(word))
        };
        match self {
            Feature::Is(name) => f.write_str(name),
            Feature::Always => f.write_str("always"),
            Feature::Not(what) => write!(f, "not {what}"),
            Feature::All(parts) => list(f, parts, " and "),
            Feature::Any(parts) => list(f, parts, " or "),
            Feature::InRole(role) => write!(f, "is the {}", role.name),
            Feature::HasBall => f.write_str("has the ball"),
            Feature::TeammateHasBall(roles) if roles.is_empty() => f.write_str("a team mate has the ball"),
            Feature::TeammateHasBall(roles) => {
                let names: Vec<&str> = roles.iter().map(|role| role.name.as_str()).collect();
                write!(f, "the {} has the ball", names.join(" or "))
            }
            Feature::SuperiorHasBall => f.write_str("a team mate of higher rank has the ball"),
            Feature::HasBooked => f.write_str("has booked the ball"),
            Feature::TeammateHasBooked => f.write_str("a team mate has booked the ball"),
            Feature::MayExecute(action) => write!(f, "may {action}"),
            Feature::HoldsBall => f.write_str("holds the ball"),
            Feature::GoalieIsOut => f.write_str("the goalie is out"),
            Feature::After(seconds) => write!(f, "after {seconds} s"),
            Feature::Bumped => f.write_str("has bumped into something"),
            Feature::MessagesLeftBelow(share) => write!(f, "less than {share} of the messages is left"),
            Feature::Stalled(seconds) => write!(f, "stalled for {seconds} s"),
            Feature::HoldFor { what, .. } => write!(f, "lately {what}"),
            Feature::Lasting { what, seconds, .. } => write!(f, "{what} for {seconds} s"),
            other => f.write_str(&ron_options().to_string(other).unwrap_or_default()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_read_like_sentences() {
        let feature =
            Feature::All(vec![Feature::Not(Box::new(Feature::Is("ball_seen".into()))), Feature::After(4.0)]);
        assert_eq!(feature.to_string(), "not ball_seen and after 4 s");
    }
}
