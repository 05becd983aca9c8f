//! Checks of expectations and conditions.

use bevy::prelude::Vec2;

use super::{Checked, Checker};
use crate::data::{Bound, Field, no_such};
use crate::geometry::Zone;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::condition::{Area, Condition, Expectation, Packets, Thing};
use crate::lab::statistics::ProbabilityTest;

impl Checker<'_> {
    pub(super) fn expectation(&self, expectation: &Expectation, at: &Field) -> Checked<()> {
        let at = match expectation {
            Expectation::Eventually { within, after, .. } => {
                let at = at.key("Eventually");
                self.source.within(&at.key("within"), *within, Bound::SECONDS)?;
                self.time(*after, &at.key("after"))?;
                // The sum may be a rounding error beyond the end.
                if f64::from(*after) + f64::from(*within) > f64::from(self.seconds) + 1e-4 {
                    let message =
                        format!("{} s is after the end, which is at {} s", after + within, self.seconds);
                    return self.fault(&at.key("within"), message);
                }
                at
            }
            Expectation::Always { from, until, .. } => self.span(*from, *until, at.key("Always"))?,
            Expectation::Never { from, until, .. } => self.span(*from, *until, at.key("Never"))?,
            Expectation::Finally { .. } => at.key("Finally"),
            Expectation::Probability { of, at_least, confidence } => {
                return self.probability(of, *at_least, *confidence, &at.key("Probability"));
            }
        };
        self.condition(expectation.what(), &at.key("what"))
    }

    fn probability(&self, of: &Expectation, at_least: f64, confidence: f64, at: &Field) -> Checked<()> {
        self.source.within(&at.key("at_least"), at_least as f32, Bound::PROBABILITY)?;
        self.source.within(&at.key("confidence"), confidence as f32, Bound::CONFIDENCE)?;
        if of.probability().is_some() {
            return self.fault(&at.key("of"), "a probability of a probability means nothing");
        }
        let most = self.seeds as u32;
        if (ProbabilityTest { at_least, confidence }).fewest(most).is_none() {
            let message = format!(
                "{most} seeds can never show it, though all of them meet it: `seeds` must allow more"
            );
            return self.fault(&at.key("at_least"), message);
        }
        self.expectation(of, &at.key("of"))
    }

    fn span(&self, from: f32, until: Option<f32>, at: Field) -> Checked<Field> {
        self.time(from, &at.key("from"))?;
        if let Some(until) = until {
            self.time(until, &at.key("until"))?;
            if until < from {
                return self.fault(&at.key("until"), format!("{until} s is before the start at {from} s"));
            }
        }
        Ok(at)
    }

    fn condition(&self, condition: &Condition, at: &Field) -> Checked<()> {
        match condition {
            Condition::RoleOf(robot, role) => self.role_of(*robot, role, &at.key("RoleOf")),
            Condition::ActingAs(robot, role) => self.role_of(*robot, role, &at.key("ActingAs")),
            Condition::ActivityOf(robot, names) => self.activities(*robot, names, &at.key("ActivityOf")),
            Condition::Claims(robot) => self.robot(*robot, &at.key("Claims")),
            Condition::Holder { robot, seen_by } => {
                self.mates(*robot, *seen_by, "seen_by", &at.key("Holder"))
            }
            Condition::Goes(robot) => self.robot(*robot, &at.key("Goes")),
            Condition::Drives(robot) => self.robot(*robot, &at.key("Drives")),
            Condition::Driving { team, at_least, at_most } => {
                let at = at.key("Driving");
                self.takes_part(*team, &at.key("team"))?;
                self.counts(*at_least, *at_most, &at)
            }
            Condition::Going { at_least, at_most, .. } => self.counts(*at_least, *at_most, &at.key("Going")),
            Condition::Booker { robot, seen_by } => {
                self.mates(*robot, *seen_by, "seen_by", &at.key("Booker"))
            }
            Condition::Locked { robot, by } => self.mates(*robot, *by, "by", &at.key("Locked")),
            Condition::Distance { from, to, below, above } => {
                let at = at.key("Distance");
                self.thing(*from, &at.key("from"))?;
                self.thing(*to, &at.key("to"))?;
                self.limits(*below, *above, Bound::LENGTH, &at)
            }
            Condition::Behind { what, of, toward, near, far, aside: (least, most) } => {
                let at = at.key("Behind");
                self.thing(*what, &at.key("what"))?;
                self.thing(*of, &at.key("of"))?;
                self.thing(*toward, &at.key("toward"))?;
                self.source.within(&at.key("near"), *near, Bound::PLACE)?;
                self.source.within(&at.key("far"), *far, Bound::PLACE)?;
                self.source.within(&at.key("aside").index(0), *least, Bound::LENGTH)?;
                self.source.within(&at.key("aside").index(1), *most, Bound::LENGTH)?;
                if near <= far && least <= most {
                    return Ok(());
                }
                self.fault(&at, "needs `near` before `far`, and the lesser bound of `aside` first")
            }
            Condition::Speed { of, below, above } => {
                let at = at.key("Speed");
                self.thing(*of, &at.key("of"))?;
                if let Thing::BallAtStart | Thing::At(..) | Thing::Goal(_) = of {
                    return self.fault(&at.key("of"), "does not move");
                }
                self.limits(*below, *above, Bound::SPEED, &at)
            }
            Condition::InZone { what, zone } => {
                let at = at.key("InZone");
                self.thing(*what, &at.key("what"))?;
                match zone {
                    Area::Rectangle(zone) => self.zone(*zone, &at.key("zone").key("Rectangle")),
                    Area::PenaltyArea(_) | Area::Half(_) | Area::Goal(_) => Ok(()),
                }
            }
            Condition::Sent(packets) => self.packets(packets, &at.key("Sent")),
            Condition::Delivered(packets) => self.packets(packets, &at.key("Delivered")),
            Condition::Goals { at_least, at_most, .. } => self.counts(*at_least, *at_most, &at.key("Goals")),
            Condition::Touching(a, b) => self.two_robots(*a, *b, &at.key("Touching")),
            Condition::MateContacts { team, at_least, at_most } => {
                let at = at.key("MateContacts");
                self.two_mates(*team, &at)?;
                self.counts(*at_least, *at_most, &at)
            }
            Condition::MateContactTime { team, below, above } => {
                let at = at.key("MateContactTime");
                self.two_mates(*team, &at)?;
                self.limits(*below, *above, Bound::SECONDS, &at)
            }
            Condition::Broken { team: None, .. } => Ok(()),
            Condition::Broken { team: Some(team), .. } => {
                self.takes_part(*team, &at.key("Broken").key("team"))
            }
            Condition::RolesDistinct(team)
            | Condition::ConfigurationsAgree(team)
            | Condition::Unlocked(team) => self.takes_part(*team, at),
            Condition::RolesAre(team, roles) => {
                let at = at.key("RolesAre").index(1);
                if roles.is_empty() {
                    return self.fault(&at, "needs at least one robot");
                }
                roles.iter().try_for_each(|(number, role)| {
                    let at = at.key(number.to_string());
                    self.robot(RobotId::new(*team, *number), &at)?;
                    self.role(*team, role, &at)
                })
            }
            Condition::All(parts) => self.parts(parts, &at.key("All")),
            Condition::Any(parts) => self.parts(parts, &at.key("Any")),
            Condition::Not(what) => self.condition(what, &at.key("Not")),
            Condition::For { seconds, what } => {
                self.time(*seconds, &at.key("For").key("seconds"))?;
                self.condition(what, &at.key("For").key("what"))
            }
        }
    }

    fn counts(&self, at_least: Option<u32>, at_most: Option<u32>, at: &Field) -> Checked<()> {
        match (at_least, at_most) {
            (None, None) => self.fault(at, "needs `at_least` or `at_most`"),
            (Some(least), Some(most)) if least > most => {
                self.fault(&at.key("at_most"), format!("{most} is less than the {least} of `at_least`"))
            }
            _ => Ok(()),
        }
    }

    fn parts(&self, parts: &[Condition], at: &Field) -> Checked<()> {
        if parts.is_empty() {
            return self.fault(at, "needs at least one condition");
        }
        parts.iter().enumerate().try_for_each(|(i, part)| self.condition(part, &at.index(i)))
    }

    fn role_of(&self, robot: RobotId, role: &str, at: &Field) -> Checked<()> {
        self.robot(robot, &at.index(0))?;
        self.role(robot.team, role, &at.index(1))
    }

    fn activities(&self, robot: RobotId, names: &[String], at: &Field) -> Checked<()> {
        self.robot(robot, &at.index(0))?;
        let at = at.index(1);
        if names.is_empty() {
            return self.fault(&at, "needs at least one activity");
        }
        let known = &self.known.teams[robot.team.index()].activities;
        match names.iter().position(|name| !known.contains(&name.as_str())) {
            Some(i) => self.fault(&at.index(i), no_such("activity", &names[i], known)),
            None => Ok(()),
        }
    }

    /// A robot and perhaps another one of its team.
    fn mates(&self, robot: RobotId, other: Option<RobotId>, key: &str, at: &Field) -> Checked<()> {
        self.robot(robot, &at.key("robot"))?;
        self.maybe_robot(other, &at.key(key))?;
        match other {
            Some(other) if other.team != robot.team => {
                self.fault(&at.key(key), format!("{other} is no team mate of {robot}"))
            }
            _ => Ok(()),
        }
    }

    fn two_robots(&self, a: RobotId, b: RobotId, at: &Field) -> Checked<()> {
        self.robot(a, &at.index(0))?;
        self.robot(b, &at.index(1))?;
        if a == b { self.fault(at, format!("{a} does not touch itself")) } else { Ok(()) }
    }

    /// A team has two robots at least, so that they can touch each other.
    fn takes_part(&self, team: Team, at: &Field) -> Checked<()> {
        if self.robots.iter().any(|robot| robot.team == team) {
            return Ok(());
        }
        self.fault(at, format!("{team} does not take part"))
    }

    fn two_mates(&self, team: Team, at: &Field) -> Checked<()> {
        match self.robots.iter().filter(|robot| robot.team == team).count() {
            0 => self.fault(&at.key("team"), format!("{team} does not take part")),
            1 => self.fault(&at.key("team"), format!("{team} has one robot, which has no team mate")),
            _ => Ok(()),
        }
    }

    fn thing(&self, thing: Thing, at: &Field) -> Checked<()> {
        match thing {
            Thing::Robot(robot) => self.robot(robot, &at.key("Robot")),
            Thing::At(x, y) => self.source.vector_within(&at.key("At"), Vec2::new(x, y), Bound::PLACE),
            Thing::Ball | Thing::BallAtStart | Thing::Goal(_) => Ok(()),
        }
    }

    fn zone(&self, zone: Zone, at: &Field) -> Checked<()> {
        self.source.vector_within(&at.key("min"), zone.min, Bound::PLACE)?;
        self.source.vector_within(&at.key("max"), zone.max, Bound::PLACE)?;
        if zone.is_finite() { Ok(()) } else { self.fault(at, "its min must be below its max") }
    }

    fn limits(&self, below: Option<f32>, above: Option<f32>, bound: Bound, at: &Field) -> Checked<()> {
        for (key, limit) in [("below", below), ("above", above)] {
            if let Some(limit) = limit {
                self.source.within(&at.key(key), limit, bound)?;
            }
        }
        match (below, above) {
            (None, None) => self.fault(at, "needs `below` or `above`"),
            (Some(below), Some(above)) if below <= above => {
                self.fault(&at.key("below"), format!("nothing is below {below} and above {above}"))
            }
            (Some(0.0), _) => self.fault(&at.key("below"), "nothing is below 0"),
            _ => Ok(()),
        }
    }

    fn packets(&self, packets: &Packets, at: &Field) -> Checked<()> {
        self.maybe_robot(packets.from, &at.key("from"))?;
        self.maybe_robot(packets.to, &at.key("to"))?;
        if packets.at_least == 0 {
            return self.fault(&at.key("at_least"), "at least 0 always holds");
        }
        self.time(packets.since, &at.key("since"))
    }
}
