//! One tick as conditions see it: a plain snapshot of the truth and of what the robots believe.

use std::collections::BTreeMap;

use bevy::prelude::Vec2;

use super::condition::{Area, Packets, Thing};
use crate::geometry::{Attacking, Pose, Zone};
use crate::ids::{RobotId, Team};
use crate::messages::MessageKind;
use crate::pitch::Pitch;

/// The snapshot. Names are borrowed from the strategies, so that filling one allocates a single list.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// Ticks that are over.
    pub tick: u64,
    pub pitch: &'a Pitch,
    /// m in the pitch frame.
    pub ball: Vec2,
    /// m/s in the pitch frame.
    pub ball_velocity: Vec2,
    /// Those that take part, in order; also those that are switched off.
    pub robots: Vec<RobotScene<'a>>,
    /// Goals, home first.
    pub score: [u32; 2],
    pub messages: &'a MessageCounts,
}

/// A robot in a [`Scene`].
#[derive(Clone, Debug)]
pub struct RobotScene<'a> {
    pub id: RobotId,
    /// In the pitch frame.
    pub pose: Pose,
    /// m/s
    pub speed: f32,
    /// Switched on: neither crashed nor off from the start.
    pub on: bool,
    pub role: &'a str,
    /// The sub-role in which it acts; the role itself if that has none.
    pub acting_as: &'a str,
    pub activity: &'a str,
    /// Whether it claims the ball.
    pub claims: bool,
    /// The number of the robot of its team that, as it believes, holds the ball.
    pub holder: Option<u8>,
    /// The number of the team mate to which it has given its lock.
    pub locked_by: Option<u8>,
    /// Equal for equal configurations of the hardened role swap.
    pub configuration: Option<u64>,
}

/// How many packets were sent and delivered since the scenario began: a message to three team mates is three packets.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MessageCounts {
    sent: BTreeMap<Link, u64>,
    delivered: BTreeMap<Link, u64>,
}

/// Kind, sender and receiver.
type Link = (MessageKind, RobotId, RobotId);

impl MessageCounts {
    pub fn count_sent(&mut self, kind: MessageKind, from: RobotId, to: RobotId) {
        *self.sent.entry((kind, from, to)).or_default() += 1;
    }

    pub fn count_delivered(&mut self, kind: MessageKind, from: RobotId, to: RobotId) {
        *self.delivered.entry((kind, from, to)).or_default() += 1;
    }

    /// The packets sent so far of a kind, from a robot or any, to a robot or any.
    pub(super) fn sent(&self, packets: &Packets) -> u64 {
        total(&self.sent, packets)
    }

    pub(super) fn delivered(&self, packets: &Packets) -> u64 {
        total(&self.delivered, packets)
    }
}

fn total(counts: &BTreeMap<Link, u64>, packets: &Packets) -> u64 {
    let matching = counts.iter().filter(|((kind, from, to), _)| {
        *kind == packets.kind
            && packets.from.is_none_or(|wanted| wanted == *from)
            && packets.to.is_none_or(|wanted| wanted == *to)
    });
    matching.map(|(_, count)| count).sum()
}

impl Scene<'_> {
    pub fn robot(&self, id: RobotId) -> Option<&RobotScene<'_>> {
        self.robots.iter().find(|robot| robot.id == id)
    }

    /// The robots of a team that are switched on.
    pub fn switched_on(&self, team: Team) -> impl Iterator<Item = &RobotScene<'_>> {
        self.robots.iter().filter(move |robot| robot.on && robot.id.team == team)
    }

    /// m in the pitch frame; `None` for a robot that does not take part.
    pub fn position(&self, thing: Thing) -> Option<Vec2> {
        match thing {
            Thing::Ball => Some(self.ball),
            Thing::Robot(robot) => self.robot(robot).map(|robot| robot.pose.position),
            Thing::At(x, y) => Some(Vec2::new(x, y)),
            Thing::Goal(team) => Some(at_start(team).turn(-self.pitch.goal_centre())),
        }
    }

    /// m/s; `None` for a robot that does not take part.
    pub fn speed(&self, thing: Thing) -> Option<f32> {
        match thing {
            Thing::Ball => Some(self.ball_velocity.length()),
            Thing::Robot(robot) => self.robot(robot).map(|robot| robot.speed),
            Thing::At(..) | Thing::Goal(_) => Some(0.0),
        }
    }

    pub fn contains(&self, area: Area, point: Vec2) -> bool {
        let half = self.pitch.half_size();
        match area {
            Area::PenaltyArea(team) => self.pitch.own_penalty_area().contains(at_start(team).turn(point)),
            Area::Half(team) => at_start(team).turn(point).x <= 0.0,
            Area::Goal(team) => {
                let y = self.pitch.goal.width / 2.0;
                let min = Vec2::new(-half.x - self.pitch.goal.depth, -y);
                Zone { min, max: Vec2::new(-half.x, y) }.contains(at_start(team).turn(point))
            }
            Area::Rectangle(zone) => zone.contains(point),
        }
    }
}

fn at_start(team: Team) -> Attacking {
    match team {
        Team::Home => Attacking::East,
        Team::Away => Attacking::West,
    }
}

#[cfg(test)]
mod tests {
    use super::super::stage;
    use super::*;

    #[test]
    fn a_team_defends_its_own_end() {
        let stage = stage::Stage::default();
        let scene = stage.scene(0);
        let west = Vec2::new(-4.2, 0.3);
        for (team, point) in [(Team::Home, west), (Team::Away, -west)] {
            for area in [Area::PenaltyArea(team), Area::Half(team)] {
                assert!(scene.contains(area, point), "{area:?}");
                assert!(!scene.contains(area, -point), "{area:?}");
            }
            assert!(!scene.contains(Area::Goal(team), point));
        }
        assert!(scene.contains(Area::Goal(Team::Away), Vec2::new(4.6, -0.5)));
        assert_eq!(scene.position(Thing::Goal(Team::Home)), Some(Vec2::new(-4.5, 0.0)));
        assert_eq!(scene.position(Thing::Goal(Team::Away)), Some(Vec2::new(4.5, 0.0)));
    }

    #[test]
    fn packets_are_counted_by_kind_sender_and_receiver() {
        let home = |number| RobotId::new(Team::Home, number);
        let mut counts = MessageCounts::default();
        counts.count_sent(MessageKind::Position, home(1), home(2));
        counts.count_sent(MessageKind::Position, home(1), home(3));
        counts.count_delivered(MessageKind::Position, home(1), home(2));
        let packets = |from, to| Packets { kind: MessageKind::Position, from, to, at_least: 1, since: 0.0 };
        assert_eq!(counts.sent(&packets(None, None)), 2);
        assert_eq!(counts.sent(&packets(Some(home(1)), Some(home(3)))), 1);
        assert_eq!(counts.sent(&packets(Some(home(2)), None)), 0);
        assert_eq!(counts.delivered(&packets(None, Some(home(3)))), 0);
        assert_eq!(counts.delivered(&packets(Some(home(1)), None)), 1);
        assert_eq!(counts.sent(&Packets { kind: MessageKind::Lock, ..packets(None, None) }), 0);
    }
}
