//! Expectations and events in plain words, for reports and the window.

use std::fmt::{self, Display, Formatter};

use bevy::prelude::Vec2;

use super::condition::{Area, Condition, Expectation, Packets, Thing};
use super::event::{Dependency, Event};
use crate::robot::Restart;

/// The parts in their order with a word between each two.
pub(super) fn list<T: Display>(parts: impl IntoIterator<Item = T>, between: &str) -> String {
    parts.into_iter().map(|part| part.to_string()).collect::<Vec<_>>().join(between)
}

/// A point as `(1.25, -0.50)`.
pub(super) fn metres_of(point: Vec2) -> String {
    format!("({:.2}, {:.2})", point.x, point.y)
}

impl Display for Thing {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Thing::Ball => f.write_str("the ball"),
            Thing::BallAtStart => f.write_str("where the ball was at the start"),
            Thing::Robot(robot) => robot.fmt(f),
            Thing::At(x, y) => write!(f, "({x}, {y})"),
            Thing::Goal(team) => write!(f, "{team}'s goal"),
        }
    }
}

impl Display for Area {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Area::PenaltyArea(team) => write!(f, "{team}'s penalty area"),
            Area::Half(team) => write!(f, "{team}'s half"),
            Area::Goal(team) => write!(f, "{team}'s goal"),
            Area::Rectangle(zone) => {
                write!(
                    f,
                    "the rectangle from ({}, {}) to ({}, {})",
                    zone.min.x, zone.min.y, zone.max.x, zone.max.y
                )
            }
        }
    }
}

impl Display for Expectation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Expectation::Probability { of, at_least, confidence } => {
                return write!(
                    f,
                    "with a probability of at least {at_least} (confidence {confidence}), {of}"
                );
            }
            Expectation::Eventually { within, after, .. } if *after > 0.0 => {
                // To the millisecond, as sums of such numbers have more digits than people want.
                let until = ((after + within) * 1000.0).round() / 1000.0;
                write!(f, "between {after} s and {until} s")?;
            }
            Expectation::Eventually { within, .. } => write!(f, "by {within} s")?,
            Expectation::Always { from, until, .. } => write!(f, "always{}", TimeSpan(*from, *until))?,
            Expectation::Never { from, until, .. } => write!(f, "never{}", TimeSpan(*from, *until))?,
            Expectation::Finally { .. } => f.write_str("at the end")?,
        }
        write!(f, ": {}", self.what())?;
        if self.because().is_empty() { Ok(()) } else { write!(f, " ({})", self.because()) }
    }
}

struct TimeSpan(f32, Option<f32>);

impl Display for TimeSpan {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            TimeSpan(from, Some(until)) if from > 0.0 => write!(f, " from {from} s to {until} s"),
            TimeSpan(_, Some(until)) => write!(f, " until {until} s"),
            TimeSpan(from, None) if from > 0.0 => write!(f, " from {from} s on"),
            TimeSpan(..) => Ok(()),
        }
    }
}

impl Display for Condition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Condition::RoleOf(robot, role) => write!(f, "{robot} is {role}"),
            Condition::ActingAs(robot, role) => write!(f, "{robot} acts as {role}"),
            Condition::ActivityOf(robot, names) => write!(f, "{robot} is in {}", list(names, " or ")),
            Condition::Claims(robot) => write!(f, "{robot} claims the ball"),
            Condition::Holder { robot, seen_by: None } => {
                write!(f, "{robot} holds the ball in the eyes of its team")
            }
            Condition::Holder { robot, seen_by: Some(by) } => {
                write!(f, "{robot} holds the ball in the eyes of {by}")
            }
            Condition::Goes(robot) => write!(f, "{robot} goes for the ball"),
            Condition::Drives(robot) => write!(f, "{robot} drives at the ball"),
            Condition::Driving { team, at_least, at_most } => {
                let limits = limits("at least", *at_least, "at most", *at_most, "");
                write!(f, "{limits} of {team} drive at the ball")
            }
            Condition::Going { team, at_least, at_most } => {
                write!(
                    f,
                    "{} of {team} go for the ball",
                    limits("at least", *at_least, "at most", *at_most, "")
                )
            }
            Condition::Booker { robot, seen_by: None } => {
                write!(f, "{robot} has booked the ball in the eyes of its team")
            }
            Condition::Booker { robot, seen_by: Some(by) } => {
                write!(f, "{robot} has booked the ball in the eyes of {by}")
            }
            Condition::Locked { robot, by: None } => write!(f, "{robot} is locked"),
            Condition::Locked { robot, by: Some(by) } => write!(f, "{robot} is locked by {by}"),
            Condition::Unlocked(team) => write!(f, "no robot of {team} is locked"),
            Condition::Distance { from, to, below, above } => {
                let limits = limits("more than", *above, "less than", *below, " m");
                write!(f, "{from} is {limits} from {to}")
            }
            Condition::Behind { what, of, toward, near, far, aside: (least, most) } => write!(
                f,
                "{what} is {near} m to {far} m behind {of} on its way to {toward}, and {least} m to {most} m aside"
            ),
            Condition::Speed { of, below, above } => {
                write!(f, "{of} goes at {}", limits("more than", *above, "less than", *below, " m/s"))
            }
            Condition::InZone { what, zone } => write!(f, "{what} is in {zone}"),
            Condition::Sent(packets) => packets.words(f, "sent"),
            Condition::Delivered(packets) => packets.words(f, "delivered"),
            Condition::Goals { team, at_least, at_most } => {
                write!(f, "{team} has scored {}", limits("at least", *at_least, "at most", *at_most, ""))
            }
            Condition::Touching(a, b) => write!(f, "{a} touches {b}"),
            Condition::MateContacts { team, at_least, at_most } => {
                let limits = limits("at least", *at_least, "at most", *at_most, "");
                write!(f, "robots of {team} have touched each other {limits} times")
            }
            Condition::MateContactTime { team, below, above } => {
                let limits = limits("more than", *above, "less than", *below, " s");
                write!(f, "robots of {team} have touched each other for {limits}")
            }
            Condition::Broken { invariant, team: Some(team) } => write!(f, "of {team}, {invariant}"),
            Condition::Broken { invariant, team: None } => invariant.fmt(f),
            Condition::RolesDistinct(team) => write!(f, "no two robots of {team} have the same role"),
            Condition::RolesAre(team, roles) => f.write_str(&list(
                roles.iter().map(|(number, role)| format!("{team} {number} is {role}")),
                " and ",
            )),
            Condition::ConfigurationsAgree(team) => {
                write!(f, "the robots of {team} agree on their configuration")
            }
            Condition::All(parts) => f.write_str(&list(parts.iter().map(Bracketed), " and ")),
            Condition::Any(parts) => f.write_str(&list(parts.iter().map(Bracketed), " or ")),
            Condition::Not(what) => write!(f, "not ({what})"),
            Condition::For { seconds, what } => write!(f, "{} for {seconds} s", Bracketed(what)),
        }
    }
}

/// A condition inside another one: in brackets if it has parts itself.
struct Bracketed<'a>(&'a Condition);

impl Display for Bracketed<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            Condition::All(_) | Condition::Any(_) | Condition::RolesAre(..) => write!(f, "({})", self.0),
            _ => self.0.fmt(f),
        }
    }
}

fn limits<T: Display>(low: &str, from: Option<T>, high: &str, to: Option<T>, unit: &str) -> String {
    let low = from.map(|from| format!("{low} {from}{unit}"));
    let high = to.map(|to| format!("{high} {to}{unit}"));
    list(low.into_iter().chain(high), " and ")
}

impl Packets {
    fn words(&self, f: &mut Formatter<'_>, verb: &str) -> fmt::Result {
        let was = if self.at_least == 1 { "was" } else { "were" };
        write!(f, "at least {} {} {was} {verb}", self.at_least, self.kind)?;
        if let Some(from) = self.from {
            write!(f, " from {from}")?;
        }
        if let Some(to) = self.to {
            write!(f, " to {to}")?;
        }
        if self.since > 0.0 {
            write!(f, " since {} s", self.since)?;
        }
        Ok(())
    }
}

impl Display for Event {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Event::Crash(robot) => write!(f, "{robot} crashes"),
            Event::Freeze(robot) => write!(f, "{robot} freezes"),
            Event::Deaf(robot) => write!(f, "{robot} goes deaf"),
            Event::Mute(robot) => write!(f, "{robot} goes mute"),
            Event::Penalise(robot) => write!(f, "{robot} is penalised"),
            Event::Revive { robot, memory: Restart::Kept } => write!(f, "{robot} comes back"),
            Event::Revive { robot, memory: Restart::Lost } => write!(f, "{robot} comes back afresh"),
            Event::CutOff(robot) => write!(f, "{robot} is cut off"),
            Event::Reconnect(robot) => write!(f, "{robot} is reconnected"),
            Event::Partition(a, b) => {
                write!(f, "no radio between {} and {}", list(a, ", "), list(b, ", "))
            }
            Event::Heal => f.write_str("the radio between the groups is back"),
            Event::Jam(true) => f.write_str("the radio is jammed"),
            Event::Jam(false) => f.write_str("the radio is no longer jammed"),
            Event::Radio(name) => write!(f, "the radio becomes {name}"),
            Event::Ball { at, velocity } if *velocity == Vec2::ZERO => {
                write!(f, "the ball is put at {}", metres_of(*at))
            }
            Event::Ball { at, velocity } => {
                write!(f, "the ball is shot from {} at {:.2} m/s", metres_of(*at), velocity.length())
            }
            Event::Push { robot, by } => write!(f, "{robot} is pushed by {:.2} m/s", by.length()),
            Event::Kidnap { robot, to, .. } => write!(f, "{robot} is kidnapped to {}", metres_of(*to)),
            Event::Mislead { robot, by, .. } => {
                write!(f, "{robot} takes itself to be {} m elsewhere", metres_of(*by))
            }
            Event::InitiateSwap { robot, roles } => {
                let changes = roles.iter().map(|(from, to)| format!("{from} becomes {to}"));
                write!(f, "{robot} starts a role swap: {}", list(changes, ", "))
            }
            Event::TakeOver(robot) => write!(f, "somebody drives {robot}"),
            Event::Steer { robot, throttle, turn, .. } => {
                write!(f, "{robot} is steered: throttle {throttle}, turn {turn}")
            }
            Event::HandBack(robot) => write!(f, "nobody drives {robot} any more"),
            Event::Strategy { team, name } => write!(f, "{team} plays on with {name}"),
        }
    }
}

impl Display for Dependency {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Dependency::Messages => "messages",
            Dependency::HierarchicalAvoidance => "hierarchical avoidance",
            Dependency::TeammateAvoidance => "avoidance of team mates",
            Dependency::Claims => "claims to the ball",
            Dependency::HomebaseSelection => "selection of homebases",
            Dependency::GoalieSupport => "support of the goalie",
            Dependency::OffensiveSupport => "offensive support",
            Dependency::FloaterDropsBack => "the floater's dropping back",
            Dependency::RoleSwap => "role swaps",
            Dependency::BallReports => "ball reports",
            Dependency::BallBooking => "ball booking",
            Dependency::ActionArbitration => "arbitration over actions",
            Dependency::HardenedSwap => "the hardened role swap",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Source;

    fn words<T: serde::de::DeserializeOwned + Display>(ron: &str) -> String {
        Source::new("x.ron", ron).parse::<T>().unwrap().to_string()
    }

    #[test]
    fn expectations_say_when_what_and_why() {
        for (ron, expected) in [
            (r#"Eventually(what: Claims("home 1"), within: 5)"#, "by 5 s: home 1 claims the ball"),
            (
                r#"Eventually(what: Claims("home 1"), within: 5, after: 2.5)"#,
                "between 2.5 s and 7.5 s: home 1 claims the ball",
            ),
            ("Always(what: Unlocked(Home))", "always: no robot of home is locked"),
            (r#"Never(what: Locked(robot: "home 1"), until: 4)"#, "never until 4 s: home 1 is locked"),
            (
                r#"Always(what: RolesDistinct(Home), from: 2, because: "the paper says so")"#,
                "always from 2 s on: no two robots of home have the same role (the paper says so)",
            ),
            (
                r#"Always(what: ConfigurationsAgree(Away), from: 2, until: 3)"#,
                "always from 2 s to 3 s: the robots of away agree on their configuration",
            ),
            ("Finally(what: Goals(team: Home, at_least: 1))", "at the end: home has scored at least 1"),
        ] {
            assert_eq!(words::<Expectation>(ron), expected);
        }
    }

    #[test]
    fn conditions_read_like_sentences() {
        for (ron, expected) in [
            (
                r#"All([Any([RoleOf("home 1", "a"), RoleOf("home 2", "b")]), ActingAs("home 2", "c")])"#,
                "(home 1 is a or home 2 is b) and home 2 acts as c",
            ),
            (
                r#"Not(For(seconds: 2, what: ActivityOf("home 1", ["x", "y"])))"#,
                "not (home 1 is in x or y for 2 s)",
            ),
            (
                r#"Distance(from: Ball, to: Robot("home 1"), above: 0.2, below: 0.5)"#,
                "the ball is more than 0.2 m and less than 0.5 m from home 1",
            ),
            (
                r#"Behind(what: Robot("home 3"), of: Ball, toward: Goal(Away), near: 0.5, far: 1, aside: (0.25, 1))"#,
                "home 3 is 0.5 m to 1 m behind the ball on its way to away's goal, and 0.25 m to 1 m aside",
            ),
            (r#"Speed(of: Ball, below: 0.1)"#, "the ball goes at less than 0.1 m/s"),
            ("InZone(what: Ball, zone: PenaltyArea(Away))", "the ball is in away's penalty area"),
            (
                r#"Sent(kind: Lock, from: "home 1", to: "home 2", at_least: 2, since: 3)"#,
                "at least 2 LOCK were sent from home 1 to home 2 since 3 s",
            ),
            (r#"Holder(robot: "home 1", seen_by: "home 2")"#, "home 1 holds the ball in the eyes of home 2"),
            (r#"RolesAre(Home, {0: "g", 1: "h"})"#, "home 0 is g and home 1 is h"),
            (r#"Touching("home 1", "away 2")"#, "home 1 touches away 2"),
            (r#"Drives("home 1")"#, "home 1 drives at the ball"),
            ("Broken(invariant: OneRobotARole, team: Home)", "of home, a role is doubled"),
            ("Driving(team: Home, at_most: 1)", "at most 1 of home drive at the ball"),
            (
                "MateContacts(team: Home, at_most: 2)",
                "robots of home have touched each other at most 2 times",
            ),
            (
                "MateContactTime(team: Home, above: 0.5, below: 2)",
                "robots of home have touched each other for more than 0.5 s and less than 2 s",
            ),
        ] {
            assert_eq!(words::<Condition>(ron), expected);
        }
    }

    #[test]
    fn events_say_what_happens() {
        for (ron, expected) in [
            (r#"Crash("home 1")"#, "home 1 crashes"),
            (r#"Partition(["home 0"], ["home 1", "home 2"])"#, "no radio between home 0 and home 1, home 2"),
            ("Ball(at: (1, 0), velocity: (3, 4))", "the ball is shot from (1.00, 0.00) at 5.00 m/s"),
            (
                r#"InitiateSwap(robot: "home 1", roles: [("a", "b"), ("b", "a")])"#,
                "home 1 starts a role swap: a becomes b, b becomes a",
            ),
        ] {
            assert_eq!(words::<Event>(ron), expected);
        }
    }
}
