//! Checks that nothing stands in anything else when a scenario begins.

use bevy::prelude::Vec2;

use super::{Checked, Checker, PlacedBody};
use crate::data::Field;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::world::physics::Footprint;

impl Checker<'_> {
    /// Adds a robot, which the file places at `at`.
    pub(super) fn stands(&mut self, robot: RobotId, pose: Pose, at: &Field) {
        let Some(kind) = self.known.teams[robot.team.index()].kind else { return };
        let (name, footprint) = (robot.to_string(), Footprint::of_robot(kind));
        self.standing.push(PlacedBody { name, footprint, pose, field: at.clone() });
    }

    /// Names, positions and headings are sound by now; the ball starts at any of these places.
    pub(super) fn stand_apart(&self, places: &[Vec2]) -> Checked<()> {
        let walls = Footprint::of_walls(self.known.pitch);
        for (i, robot) in self.standing.iter().enumerate() {
            self.finds_room(robot, &self.standing[..i], &walls)?;
        }
        places.iter().try_for_each(|place| self.finds_room(&self.ball_at(*place), &self.standing, &walls))
    }

    fn finds_room(&self, body: &PlacedBody, others: &[PlacedBody], walls: &Footprint) -> Checked<()> {
        let (name, at) = (&body.name, body.pose.position);
        if body.footprint.overlaps(body.pose, walls, Pose::default()) {
            return self.fault(&body.field, format!("{name} at ({}, {}) would stand in a wall", at.x, at.y));
        }
        let in_body = |other: &&PlacedBody| body.footprint.overlaps(body.pose, &other.footprint, other.pose);
        let Some(other) = others.iter().find(in_body) else { return Ok(()) };
        let there = other.pose.position;
        let message = format!(
            "{name} at ({}, {}) would stand in {}, which is at ({}, {}) by {}",
            at.x, at.y, other.name, there.x, there.y, other.field
        );
        self.fault(&body.field, message)
    }

    fn ball_at(&self, position: Vec2) -> PlacedBody {
        PlacedBody {
            name: "the ball".into(),
            footprint: Footprint::of_ball(self.known.ball),
            pose: Pose { position, heading: 0.0 },
            field: Field::root().key("ball").key("at"),
        }
    }
}
