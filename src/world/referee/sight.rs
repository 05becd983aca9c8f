//! What the referee can see besides places: who touches the ball, who pushes whom, who stands still.

use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use smallvec::SmallVec;

use super::rulebook::RuleBook;
use super::rules::{Laws, Observation};
use crate::geometry::{Pose, Twist};
use crate::ids::RobotId;
use crate::pitch::BallKind;
use crate::pitch::Pitch;
use crate::robot::handling::Handling;
use crate::robot::{DriveCommand, OffPitch};
use crate::world::ball::Ball;
use crate::world::impulses::ContactImpulses;

/// A robot as the referee sees it.
#[derive(QueryData)]
pub struct SeenRobot {
    id: &'static RobotId,
    pose: &'static Pose,
    twist: &'static Twist,
    command: &'static DriveCommand,
    handling: &'static Handling,
}

type Players<'w, 's> = Query<'w, 's, SeenRobot, Without<OffPitch>>;

/// All that the referee looks at.
#[derive(SystemParam)]
pub(crate) struct RefereeView<'w, 's> {
    pitch: Res<'w, Pitch>,
    book: Res<'w, RuleBook>,
    contacts: Res<'w, ContactImpulses>,
    kind: Res<'w, BallKind>,
    ball: Single<'w, 's, &'static Pose, With<Ball>>,
    players: Players<'w, 's>,
}

impl RefereeView<'_, '_> {
    pub(super) fn laws(&self) -> Laws<'_> {
        Laws { pitch: &self.pitch, book: &self.book, ball_radius: self.kind.radius }
    }

    /// Contacts and motion only where a rule asks for them.
    pub(super) fn sight(&self) -> Sight {
        let places = Sight::of_places(self.ball.position, &self.players);
        if self.book.watches_contacts() { places.with_motion(&self.players, &self.contacts) } else { places }
    }
}

/// Everything that happens between bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct Sight {
    ball: Vec2,
    robots: SmallVec<[(RobotId, Vec2); 8]>,
    touching: SmallVec<[RobotId; 4]>,
    held_by: Option<RobotId>,
    contacts: SmallVec<[(RobotId, RobotId); 4]>,
    shoving: SmallVec<[(RobotId, RobotId); 4]>,
    still: SmallVec<[RobotId; 8]>,
}

/// A robot that is told to move towards another faster than this pushes it, m/s.
const SHOVE: f32 = 0.05;
/// Slower robots stand still, m/s and rad/s.
const STILL: (f32, f32) = (0.02, 0.1);

impl SeenRobotItem<'_, '_> {
    /// Whether it is told to move towards another robot.
    fn shoves(&self, other: &SeenRobotItem) -> bool {
        let way = (other.pose.position - self.pose.position).normalize_or_zero();
        self.pose.forward().rotate(self.command.velocity()).dot(way) > SHOVE
    }
}

impl Sight {
    /// Places alone: all that the rules of walled pitches ask for.
    fn of_places(ball: Vec2, players: &Players) -> Sight {
        let mut robots: SmallVec<[(RobotId, Vec2); 8]> = SmallVec::new();
        for player in players {
            robots.push((*player.id, player.pose.position));
        }
        robots.sort_unstable_by_key(|(id, _)| *id);
        Sight { ball, robots, ..Sight::default() }
    }

    /// Also contacts and motion.
    fn with_motion(mut self, players: &Players, contacts: &ContactImpulses) -> Sight {
        for player in players {
            let id = *player.id;
            if contacts.units_at_ball.contains(&id) {
                self.touching.push(id);
            }
            if player.handling.holds() {
                self.held_by = Some(id);
            }
            if player.twist.linear.length() < STILL.0 && player.twist.angular.abs() < STILL.1 {
                self.still.push(id);
            }
            if contacts.units.iter().any(|(lesser, _)| *lesser == id) {
                self.add_contacts(&player, players, contacts);
            }
        }
        self
    }

    /// Those that a robot touches, of the robots after it.
    fn add_contacts(&mut self, player: &SeenRobotItem, players: &Players, contacts: &ContactImpulses) {
        let id = *player.id;
        for other in players.iter().filter(|other| contacts.units.contains(&(id, *other.id))) {
            self.contacts.push((id, *other.id));
            self.shoving.extend(player.shoves(&other).then_some((id, *other.id)));
            self.shoving.extend(other.shoves(player).then_some((*other.id, id)));
        }
    }

    pub fn observation(&self) -> Observation<'_> {
        Observation {
            ball: self.ball,
            robots: &self.robots,
            touching: &self.touching,
            held_by: self.held_by,
            contacts: &self.contacts,
            shoving: &self.shoving,
            still: &self.still,
        }
    }
}
