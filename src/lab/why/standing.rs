//! What a match has come to at a tick, as far as people ask why.

use std::fmt;

use bevy::prelude::*;
use serde::Serialize;

use crate::clock::Clock;
use crate::game::record::{AGGLOMERATION, RADII};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::robot::Robot;
use crate::strategy::{Role, Strategies};
use crate::world::ball::Ball;
use crate::world::referee::MatchState;

/// What a match has come to at a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MatchStanding {
    /// After so many ticks.
    pub tick: u64,
    /// Home first.
    pub score: [u32; 2],
    /// Who is nearest to the ball, if anybody is near.
    pub ball: Option<RobotId>,
    /// Roles that two robots of a team have, by team and name.
    pub doubled: Vec<(Team, String)>,
    /// The teams of which several robots are within half a metre of the ball.
    pub crowded: Vec<Team>,
}

/// In what one outcome differs from another, the weightiest thing first.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum StandingDifference {
    /// The score, and what it was.
    Score { is: [u32; 2], was: [u32; 2] },
    /// Roles that are now given once, or now given twice.
    DoubledRoles { now: Vec<String>, before: Vec<String> },
    /// Another team has the ball.
    Ball { is: Option<RobotId>, was: Option<RobotId> },
    /// Other teams crowd.
    Crowded { is: Vec<Team>, was: Vec<Team> },
}

/// A robot that is nearer to the ball than this has it, if nobody is nearer, m.
const HAS_BALL: f32 = 0.6;

impl MatchStanding {
    /// Of the match in a world.
    pub fn of(world: &mut World) -> MatchStanding {
        let ball = world.query_filtered::<&Pose, With<Ball>>().iter(world).next().map(|pose| pose.position);
        let mut robots = world.query::<(&RobotId, &Pose, &Robot, &Role)>();
        let mut robots: Vec<(RobotId, f32, usize)> = robots
            .iter(world)
            .filter(|(_, _, robot, _)| !robot.health.crashed)
            .map(|(id, pose, _, role)| {
                (*id, ball.map_or(f32::MAX, |ball| ball.distance(pose.position)), role.0)
            })
            .collect();
        robots.sort_unstable_by_key(|(id, ..)| *id);
        let nearest = robots.iter().min_by(|(_, one, _), (_, other, _)| one.total_cmp(other));
        let near = |team: Team| {
            robots.iter().filter(|(id, at, _)| id.team == team && *at < RADII[AGGLOMERATION]).count()
        };
        MatchStanding {
            tick: world.resource::<Clock>().tick,
            score: world.resource::<MatchState>().score,
            ball: nearest.filter(|(_, distance, _)| *distance < HAS_BALL).map(|(id, ..)| *id),
            doubled: doubled(&robots, world.resource::<Strategies>()),
            crowded: Team::BOTH.into_iter().filter(|team| near(*team) > 1).collect(),
        }
    }

    /// In what this outcome differs from another one; the weightiest thing, if there are several.
    pub fn difference(&self, was: &MatchStanding) -> Option<StandingDifference> {
        let names = |doubled: &[(Team, String)]| {
            doubled.iter().map(|(team, role)| format!("{team} {role}")).collect()
        };
        let team = |ball: Option<RobotId>| ball.map(|robot| robot.team);
        if self.score != was.score {
            Some(StandingDifference::Score { is: self.score, was: was.score })
        } else if self.doubled != was.doubled {
            Some(StandingDifference::DoubledRoles { now: names(&self.doubled), before: names(&was.doubled) })
        } else if team(self.ball) != team(was.ball) {
            Some(StandingDifference::Ball { is: self.ball, was: was.ball })
        } else if self.crowded != was.crowded {
            Some(StandingDifference::Crowded { is: self.crowded.clone(), was: was.crowded.clone() })
        } else {
            None
        }
    }
}

/// The roles that two robots of a team have.
fn doubled(robots: &[(RobotId, f32, usize)], strategies: &Strategies) -> Vec<(Team, String)> {
    let mut doubled = Vec::new();
    for team in Team::BOTH {
        for (role, known) in strategies.of(team).roles.iter().enumerate() {
            let holders = robots.iter().filter(|(id, _, has)| id.team == team && *has == role).count();
            if holders > 1 {
                doubled.push((team, known.name.clone()));
            }
        }
    }
    doubled
}

impl StandingDifference {
    /// The greater, the more it matters.
    pub fn weight(&self) -> u8 {
        match self {
            StandingDifference::Score { .. } => 3,
            StandingDifference::DoubledRoles { .. } => 2,
            StandingDifference::Ball { .. } => 1,
            StandingDifference::Crowded { .. } => 0,
        }
    }

    /// Whether another difference says the same: of the score, that the same side fares better.
    pub fn agrees(&self, other: &StandingDifference) -> bool {
        let swing = |is: &[u32; 2], was: &[u32; 2]| {
            let lead = |score: &[u32; 2]| i64::from(score[0]) - i64::from(score[1]);
            (lead(is) - lead(was)).signum()
        };
        match (self, other) {
            (StandingDifference::Score { is: a, was: b }, StandingDifference::Score { is: c, was: d }) => {
                swing(a, b) == swing(c, d)
            }
            _ => self.weight() == other.weight(),
        }
    }
}

impl fmt::Display for StandingDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let who = |ball: &Option<RobotId>| ball.map_or("nobody".to_owned(), |robot| robot.to_string());
        let teams = |teams: &[Team]| match teams {
            [] => "nobody".to_owned(),
            teams => teams.iter().map(Team::to_string).collect::<Vec<_>>().join(" and "),
        };
        match self {
            StandingDifference::Score { is, was } => {
                write!(f, "{}:{} instead of {}:{}", is[0], is[1], was[0], was[1])
            }
            StandingDifference::DoubledRoles { now, before } if now.is_empty() => {
                write!(f, "no role is given twice; it was {}", before.join(", "))
            }
            StandingDifference::DoubledRoles { now, .. } => {
                write!(f, "a role is given twice: {}", now.join(", "))
            }
            StandingDifference::Ball { is, was } => write!(f, "{} has the ball, not {}", who(is), who(was)),
            StandingDifference::Crowded { is, was } => write!(f, "{} crowds, not {}", teams(is), teams(was)),
        }
    }
}
