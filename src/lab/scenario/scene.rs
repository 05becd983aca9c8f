//! One tick as conditions see it: a plain snapshot of the truth and of what the robots believe.

use bevy::prelude::Vec2;

use super::condition::{Area, Thing};
use crate::comms::radio::RadioRecord;
use crate::game::record::{Invariants, RobotContacts};
use crate::geometry::{Pose, Zone};
use crate::ids::{RobotId, Team};
use crate::pitch::Pitch;
use crate::world::referee::MatchState;

/// The snapshot. Names are borrowed from the strategies, so that filling one allocates a single list.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// Ticks that are over.
    pub tick: u64,
    /// The pitch.
    pub pitch: &'a Pitch,
    /// m in the pitch frame.
    pub ball: Vec2,
    /// m/s in the pitch frame.
    pub ball_velocity: Vec2,
    /// Where the ball was at the start, m in the pitch frame.
    pub ball_at_start: Vec2,
    /// Those that take part, in order; also those that are switched off.
    pub robots: Vec<RobotScene<'a>>,
    /// Goals, home first.
    pub score: [u32; 2],
    /// What crossed the radio.
    pub radio: &'a RadioRecord,
    /// Who touches whom, and has touched.
    pub contacts: &'a RobotContacts,
    /// What is broken.
    pub invariants: &'a Invariants,
}

/// A robot in a [`Scene`].
#[derive(Clone, Debug)]
pub struct RobotScene<'a> {
    /// The robot.
    pub id: RobotId,
    /// In the pitch frame.
    pub pose: Pose,
    /// m/s
    pub speed: f32,
    /// Switched on: neither crashed nor off from the start.
    pub on: bool,
    /// Its role's name.
    pub role: &'a str,
    /// The sub-role in which it acts; the role itself if that has none.
    pub acting_as: &'a str,
    /// The name of its machine's state.
    pub activity: &'a str,
    /// The names of the composite states around that, the outermost first.
    pub within: Vec<&'a str>,
    /// Whether it claims the ball.
    pub claims: bool,
    /// The number of the robot of its team that, as it believes, holds the ball.
    pub holder: Option<u8>,
    /// Whether it has booked the ball and goes for it.
    pub goes: bool,
    /// Whether it drives at the ball, whatever it believes.
    pub drives: bool,
    /// The number of the robot of its team that, as it believes, has booked the ball.
    pub booker: Option<u8>,
    /// The number of the team mate to which it has given its lock.
    pub locked_by: Option<u8>,
    /// Equal for equal configurations of the hardened role swap.
    pub configuration: Option<u64>,
}

impl Scene<'_> {
    /// A robot of the scene, if it takes part.
    pub fn robot(&self, id: RobotId) -> Option<&RobotScene<'_>> {
        self.robots.iter().find(|robot| robot.id == id)
    }

    /// The robots of a team that are switched on.
    pub fn switched_on(&self, team: Team) -> impl Iterator<Item = &RobotScene<'_>> {
        self.robots.iter().filter(move |robot| robot.on && robot.id.team == team)
    }

    /// How many robots of a team go for the ball.
    pub fn going(&self, team: Team) -> u32 {
        self.switched_on(team).filter(|robot| robot.goes).count() as u32
    }

    /// m in the pitch frame; `None` for a robot that does not take part.
    pub fn position(&self, thing: Thing) -> Option<Vec2> {
        match thing {
            Thing::Ball => Some(self.ball),
            Thing::BallAtStart => Some(self.ball_at_start),
            Thing::Robot(robot) => self.robot(robot).map(|robot| robot.pose.position),
            Thing::At(x, y) => Some(Vec2::new(x, y)),
            Thing::Goal(team) => Some(MatchState::attacking_at_start(team).turn(-self.pitch.goal_centre())),
        }
    }

    /// m/s; `None` for a robot that does not take part.
    pub fn speed(&self, thing: Thing) -> Option<f32> {
        match thing {
            Thing::Ball => Some(self.ball_velocity.length()),
            Thing::Robot(robot) => self.robot(robot).map(|robot| robot.speed),
            Thing::BallAtStart | Thing::At(..) | Thing::Goal(_) => Some(0.0),
        }
    }

    /// Whether a point lies in a part of the pitch.
    pub fn contains(&self, area: Area, point: Vec2) -> bool {
        let half = self.pitch.half_size();
        match area {
            Area::PenaltyArea(team) => {
                self.pitch.own_penalty_area().contains(MatchState::attacking_at_start(team).turn(point))
            }
            Area::Half(team) => MatchState::attacking_at_start(team).turn(point).x <= 0.0,
            Area::Goal(team) => {
                let y = self.pitch.goal.width / 2.0;
                let min = Vec2::new(-half.x - self.pitch.goal.depth, -y);
                Zone { min, max: Vec2::new(-half.x, y) }
                    .contains(MatchState::attacking_at_start(team).turn(point))
            }
            Area::Rectangle(zone) => zone.contains(point),
        }
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
}
