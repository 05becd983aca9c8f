//! Checks that nothing stands in anything else when a scenario begins.

use bevy::prelude::Vec2;

use super::{Checker, Result};
use crate::data::Field;
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::file::ScenarioFile;
use crate::world::physics::Footprint;

/// A body, where it stands, and where the file says so.
struct Standing {
    name: String,
    footprint: Footprint,
    pose: Pose,
    field: Field,
}

impl Checker<'_> {
    /// Names, positions and headings are sound by now; the ball starts at any of these places.
    pub(super) fn stand_apart(&self, file: &ScenarioFile, places: &[Vec2]) -> Result<()> {
        let walls = Footprint::of_walls(self.known.pitch);
        let mut standing: Vec<Standing> = Vec::new();
        for robot in self.robots_of(file) {
            self.finds_room(&robot, &standing, &walls)?;
            standing.push(robot);
        }
        places.iter().try_for_each(|place| self.finds_room(&self.ball_at(*place), &standing, &walls))
    }

    fn finds_room(&self, body: &Standing, others: &[Standing], walls: &Footprint) -> Result<()> {
        let (name, at) = (&body.name, body.pose.position);
        if body.footprint.overlaps(body.pose, walls, Pose::default()) {
            return self.fault(&body.field, format!("{name} at ({}, {}) would stand in a wall", at.x, at.y));
        }
        let in_body = |other: &&Standing| body.footprint.overlaps(body.pose, &other.footprint, other.pose);
        let Some(other) = others.iter().find(in_body) else { return Ok(()) };
        let there = other.pose.position;
        let message = format!(
            "{name} at ({}, {}) would stand in {}, which is at ({}, {}) by {}",
            at.x, at.y, other.name, there.x, there.y, other.field
        );
        self.fault(&body.field, message)
    }

    fn robots_of(&self, file: &ScenarioFile) -> Vec<Standing> {
        let sides = [(Team::Home, Some(&file.home), "home"), (Team::Away, file.away.as_ref(), "away")];
        let mut standing = Vec::new();
        for (team, side, key) in sides {
            let (Some(side), Some(kind)) = (side, self.known.teams[team.index()].kind) else { continue };
            let footprint = Footprint::of_robot(kind);
            let field = Field::root().key(key).key("players");
            standing.extend(side.players.iter().enumerate().map(|(i, player)| Standing {
                name: RobotId::new(team, player.number).to_string(),
                footprint: footprint.clone(),
                pose: Pose { position: player.at, heading: player.facing.to_radians() },
                field: field.index(i).key("at"),
            }));
        }
        standing
    }

    fn ball_at(&self, position: Vec2) -> Standing {
        Standing {
            name: "the ball".into(),
            footprint: Footprint::of_ball(self.known.ball),
            pose: Pose { position, heading: 0.0 },
            field: Field::root().key("ball").key("at"),
        }
    }
}
