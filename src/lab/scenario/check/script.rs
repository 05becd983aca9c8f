//! Checks of what happens to radio and robots: fault rules and the events of the script.

use super::{Checked, Checker, Known};
use crate::comms::radio::FaultRule;
use crate::data::{Bound, Field, Source, Validate, no_such};
use crate::ids::{RobotId, Team};
use crate::lab::scenario::event::{Event, TimedEvent};

/// Checks an event of something that goes on for as long as it likes and in which these robots take part.
pub(in crate::lab::scenario) fn check_event(
    (source, at): (&Source, &Field),
    event: &TimedEvent,
    known: &Known,
    robots: Vec<RobotId>,
) -> Checked<()> {
    Checker { source, known, seconds: f32::INFINITY, seeds: 0, robots, standing: Vec::new() }.event(event, at)
}

impl Checker<'_> {
    pub(super) fn rule(&self, rule: &FaultRule, at: &Field) -> Checked<()> {
        self.maybe_robot(rule.from, &at.key("from"))?;
        self.maybe_robot(rule.to, &at.key("to"))?;
        self.source.locate(at, rule.validate())
    }

    pub(super) fn event(&self, event: &TimedEvent, at: &Field) -> Checked<()> {
        self.time(event.at, &at.key("at"))?;
        let at = at.key("what");
        match &event.what {
            Event::Crash(robot) => self.robot(*robot, &at.key("Crash")),
            Event::Penalise(robot) => self.robot(*robot, &at.key("Penalise")),
            Event::Freeze(robot) => self.robot(*robot, &at.key("Freeze")),
            Event::Deaf(robot) => self.robot(*robot, &at.key("Deaf")),
            Event::Mute(robot) => self.robot(*robot, &at.key("Mute")),
            Event::CutOff(robot) => self.robot(*robot, &at.key("CutOff")),
            Event::Reconnect(robot) => self.robot(*robot, &at.key("Reconnect")),
            Event::Revive { robot, .. } => self.robot(*robot, &at.key("Revive").key("robot")),
            Event::Partition(one, other) => self.partition(one, other, &at.key("Partition")),
            Event::Heal | Event::Jam(_) => Ok(()),
            Event::Radio(name) if self.known.radios.contains(name) => Ok(()),
            Event::Radio(name) => self.fault(&at.key("Radio"), no_such("radio", name, &self.known.radios)),
            Event::Ball { at: place, velocity } => {
                self.on_pitch(*place, &at.key("Ball").key("at"))?;
                self.source.vector_within(&at.key("Ball").key("velocity"), *velocity, Bound::VELOCITY)
            }
            Event::Push { robot, by } => {
                self.robot(*robot, &at.key("Push").key("robot"))?;
                self.source.vector_within(&at.key("Push").key("by"), *by, Bound::VELOCITY)
            }
            Event::Kidnap { robot, to, facing } => {
                let at = at.key("Kidnap");
                self.robot(*robot, &at.key("robot"))?;
                self.on_pitch(*to, &at.key("to"))?;
                self.source.within(&at.key("facing"), *facing, Bound::HEADING)
            }
            Event::Mislead { robot, by, turn } => {
                let at = at.key("Mislead");
                self.robot(*robot, &at.key("robot"))?;
                self.source.vector_within(&at.key("by"), *by, Bound::PLACE)?;
                self.source.within(&at.key("turn"), *turn, Bound::HEADING)
            }
            Event::InitiateSwap { robot, roles } => {
                self.robot(*robot, &at.key("InitiateSwap").key("robot"))?;
                self.swap(robot.team, roles, &at.key("InitiateSwap").key("roles"))
            }
            Event::TakeOver(robot) => self.robot(*robot, &at.key("TakeOver")),
            Event::HandBack(robot) => self.robot(*robot, &at.key("HandBack")),
            Event::Steer { robot, throttle, aside, turn, .. } => {
                let at = at.key("Steer");
                self.robot(*robot, &at.key("robot"))?;
                let levers = [("throttle", throttle), ("aside", aside), ("turn", turn)];
                let lever = |(name, value): (&str, &f32)| {
                    self.source.within(&at.key(name), *value, Bound::SHARE.signed())
                };
                levers.into_iter().try_for_each(lever)
            }
            Event::Strategy { team, .. } if self.known.teams[team.index()].kind.is_none() => {
                self.fault(&at.key("Strategy").key("team"), format!("{team} does not play"))
            }
            Event::Strategy { name, .. } if self.known.strategies.contains(name) => Ok(()),
            Event::Strategy { name, .. } => {
                let known = &self.known.strategies;
                self.fault(&at.key("Strategy").key("name"), no_such("strategy", name, known))
            }
        }
    }

    fn partition(&self, one: &[RobotId], other: &[RobotId], at: &Field) -> Checked<()> {
        for (side, group) in [one, other].into_iter().enumerate() {
            if group.is_empty() {
                return self.fault(&at.index(side), "needs at least one robot");
            }
            for (i, robot) in group.iter().enumerate() {
                self.robot(*robot, &at.index(side).index(i))?;
            }
            self.source.distinct(&at.index(side), group)?;
        }
        match other.iter().position(|robot| one.contains(robot)) {
            Some(i) => self.fault(&at.index(1).index(i), format!("{} cannot be on both sides", other[i])),
            None => Ok(()),
        }
    }

    /// A swap takes and gives the same roles, each once.
    fn swap(&self, team: Team, roles: &[(String, String)], at: &Field) -> Checked<()> {
        for (i, (from, to)) in roles.iter().enumerate() {
            self.role(team, from, &at.index(i).index(0))?;
            self.role(team, to, &at.index(i).index(1))?;
        }
        let sorted = |side: fn(&(String, String)) -> &String| {
            let mut names: Vec<&String> = roles.iter().map(side).collect();
            names.sort();
            names
        };
        let (from, to) = (sorted(|pair| &pair.0), sorted(|pair| &pair.1));
        if roles.is_empty() || from != to || from.windows(2).any(|pair| pair[0] == pair[1]) {
            return self.fault(at, "must take and give the same roles, each once");
        }
        Ok(())
    }
}
