//! For unit tests: a robot's situation with plain defaults.

use bevy::prelude::*;

use super::Perception;
use crate::geometry::{Pose, Zone};
use crate::ids::Team;
use crate::mind::teamwork::TeamModel;
use crate::mind::world_model::{BallBelief, MateBelief, RobotBelief, WorldModel};
use crate::pitch::Pitch;
use crate::protocol::role_swap::Assignment;
use crate::strategy::teamwork::{Mechanism, Teamwork};
use crate::testing::pitch;

/// What a home robot believes, and the rest of a [`Perception`]; change what a test is about.
pub struct Situation {
    pub model: WorldModel,
    pub team_model: TeamModel,
    pub teamwork: Teamwork,
    pub pitch: Pitch,
    pub now: f32,
    pub ball_age: Option<f32>,
    pub time_in_state: f32,
    pub bumped: bool,
    pub messages_left: Option<f32>,
    pub stalled_for: f32,
}

impl Situation {
    pub const DANGER_ZONE: Zone = Zone { min: Vec2::new(-2.0, -1.0), max: Vec2::new(0.5, 1.0) };
    pub const HOMEBASE: Vec2 = Vec2::new(-1.5, 0.25);
    /// From the centre to the front, and the ball's radius, m.
    pub const FRONT: f32 = 0.125;
    pub const BALL_RADIUS: f32 = 0.125;

    /// A robot at this place, m, that looks in this direction, degrees, and knows of nothing else.
    pub fn at(x: f32, y: f32, degrees: f32) -> Situation {
        Situation {
            model: WorldModel::told(Pose::new(x, y, degrees.to_radians())),
            team_model: TeamModel::of(Assignment::new([0, 1, 2, 3])),
            teamwork: Teamwork::default(),
            pitch: pitch(),
            now: 0.0,
            ball_age: None,
            time_in_state: 0.0,
            bumped: false,
            messages_left: None,
            stalled_for: 0.0,
        }
    }

    pub fn ball(self, x: f32, y: f32) -> Situation {
        self.rolling_ball(x, y, Vec2::ZERO)
    }

    pub fn rolling_ball(mut self, x: f32, y: f32, velocity: Vec2) -> Situation {
        self.model.ball = Some(BallBelief { position: Vec2::new(x, y), velocity, seen: 0 });
        self
    }

    pub fn robot(mut self, team: Team, x: f32, y: f32) -> Situation {
        self.model.robots.push(RobotBelief { team, position: Vec2::new(x, y), seen: 0 });
        self
    }

    /// A team mate that has told where it is.
    pub fn mate(mut self, number: u8, x: f32, y: f32) -> Situation {
        let (position, heading) = (Vec2::new(x, y), Vec2::X);
        self.model.mates.push(MateBelief { number, position, heading, time: 0, heard: 0 });
        self
    }

    /// Switches a mechanism of teamwork on.
    pub fn with(mut self, mechanism: Mechanism) -> Situation {
        let on = Mechanism::ALL.into_iter().filter(|other| self.teamwork.has(*other));
        self.teamwork.mechanisms = on.chain([mechanism]).collect();
        self
    }

    pub fn senses(&self) -> Perception<'_> {
        Perception {
            team: Team::Home,
            role: 2,
            model: &self.model,
            team_model: &self.team_model,
            teamwork: &self.teamwork,
            pitch: &self.pitch,
            danger_zone: Situation::DANGER_ZONE,
            homebase: Situation::HOMEBASE,
            now: self.now,
            ball_age: self.ball_age,
            time_in_state: self.time_in_state,
            holds_ball: false,
            bumped: self.bumped,
            messages_left: self.messages_left,
            stalled_for: self.stalled_for,
            front: Situation::FRONT,
            ball_radius: Situation::BALL_RADIUS,
        }
    }
}
