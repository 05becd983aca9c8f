//! Where robots and ball were in each tick of a branch, and how the match stood: enough to show it without playing it.

use bevy::prelude::*;

use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::robot::Trailer;
use crate::world::ball::Ball;
use crate::world::referee::{MatchState, RuleBook};

/// A branch as it went, moment by moment, one for each tick that is over.
#[derive(Clone, Debug, Default)]
pub struct Track {
    /// The ticks that were over at the first moment.
    from: u64,
    robots: Vec<RobotId>,
    /// The robots with trailers, sorted.
    pullers: Vec<RobotId>,
    /// Of each moment the robots' in their order, and the ball's.
    poses: Vec<Pose>,
    /// Of each moment those of the trailers, which hang where their robots are.
    headings: Vec<f32>,
    standings: Vec<Standings>,
}

#[derive(Clone, Copy, Debug)]
struct Standings {
    score: [u16; 2],
    played: f32,
}

/// A moment of a [`Track`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ghost<'a> {
    /// The robots, sorted.
    pub robots: &'a [RobotId],
    /// Their poses, in the pitch frame.
    pub poses: &'a [Pose],
    /// The robots with trailers, sorted.
    pub pullers: &'a [RobotId],
    /// Where their trailers point, radians in the pitch frame.
    pub headings: &'a [f32],
    /// m in the pitch frame.
    pub ball: Vec2,
    /// Goals of home and away.
    pub score: [u16; 2],
    /// Seconds of playing time since the match began.
    pub played: f32,
}

impl Ghost<'_> {
    /// Where a robot is.
    pub fn robot(&self, robot: RobotId) -> Option<Pose> {
        let place = self.robots.iter().position(|known| *known == robot)?;
        self.poses.get(place).copied()
    }

    /// Where the trailer of a robot is, if it has one.
    pub fn trailer(&self, robot: RobotId) -> Option<Pose> {
        let place = self.pullers.iter().position(|known| *known == robot)?;
        Some(Pose { heading: *self.headings.get(place)?, ..self.robot(robot)? })
    }
}

impl Track {
    pub(super) fn starting(from: u64) -> Track {
        Track { from, ..Track::default() }
    }

    /// Adds the present moment.
    pub(super) fn push(&mut self, world: &mut World) {
        let mut bodies = world.query::<(&Pose, Option<&RobotId>, Has<Ball>)>();
        let mut poses: Vec<(Option<RobotId>, Pose)> = (bodies.iter(world))
            .filter(|(_, robot, is_ball)| robot.is_some() || *is_ball)
            .map(|(pose, robot, _)| (robot.copied(), *pose))
            .collect();
        // The ball comes last.
        poses.sort_unstable_by_key(|(robot, _)| (robot.is_none(), *robot));
        let mut trailers = world.query::<(&Trailer, &Pose)>();
        let mut trailers: Vec<(RobotId, f32)> =
            trailers.iter(world).map(|(trailer, pose)| (trailer.of, pose.heading)).collect();
        trailers.sort_unstable_by_key(|(robot, _)| *robot);
        if self.standings.is_empty() {
            self.robots = poses.iter().filter_map(|(robot, _)| *robot).collect();
            self.pullers = trailers.iter().map(|(robot, _)| *robot).collect();
        }
        self.headings.extend(trailers.into_iter().map(|(_, heading)| heading));
        self.poses.extend(poses.into_iter().map(|(_, pose)| pose));
        let (state, book) = (world.resource::<MatchState>(), world.resource::<RuleBook>());
        self.standings.push(Standings {
            score: state.score.map(|goals| u16::try_from(goals).unwrap_or(u16::MAX)),
            played: state.time_played(book) as f32,
        });
    }

    /// The moment at which so many ticks of the match were over, if it is of this branch.
    pub fn at(&self, tick: u64) -> Option<Ghost<'_>> {
        let place = usize::try_from(tick.checked_sub(self.from)?).ok()?;
        let Standings { score, played } = *self.standings.get(place)?;
        let width = self.robots.len() + 1;
        let (ball, poses) = self.poses.get(place * width..(place + 1) * width)?.split_last()?;
        let pulled = self.pullers.len();
        let headings = self.headings.get(place * pulled..(place + 1) * pulled)?;
        let (robots, pullers) = (&self.robots[..], &self.pullers[..]);
        Some(Ghost { robots, poses, pullers, headings, ball: ball.position, score, played })
    }

    /// Bytes that a moment takes.
    pub fn bytes_a_moment(&self) -> usize {
        (self.robots.len() + 1) * size_of::<Pose>()
            + self.pullers.len() * size_of::<f32>()
            + size_of::<Standings>()
    }
}
