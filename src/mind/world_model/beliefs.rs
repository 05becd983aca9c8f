//! A robot's beliefs about itself, the ball and the others, in its team frame.
//!
//! Between frames everything is dead-reckoned; a frame corrects the beliefs as they were when its shutter opened. What has
//! not been seen for a while is forgotten.

use std::collections::VecDeque;

use bevy::prelude::*;
use smallvec::SmallVec;

use super::ball_filter::{BallFilter, roll_on};
use super::progress::{Progress, WayReported};
use crate::clock::Clock;
use crate::comms::messages::{Inbox, TeamMessage};
use crate::geometry::{Pose, Sighting, unit, wrap_angle};
use crate::ids::{PlayerNumber, Team};
use crate::ops;
use crate::pitch::Pitch;
use crate::robot::{
    Eyes, Fix, Frame, Localisation, MemorySpans, Odometry, Sensing, range_deviation, should_be_seen,
};

/// What a robot believes, in its team frame.
#[derive(Component, Clone, Debug, Default, Reflect)]
#[reflect(Component, from_reflect = false)]
pub struct WorldModel {
    /// Where the robot believes it is itself, in the team frame.
    pub pose: Pose,
    /// What it believes of the ball, if anything.
    pub ball: Option<BallBelief>,
    /// The other robots, its own team's and the opponents', as far as it knows of them.
    pub robots: Vec<RobotBelief>,
    /// The team mates that have told where they are lately.
    pub mates: SmallVec<[MateBelief; 8]>,
    is_localised: bool,
    #[reflect(ignore)]
    filter: Option<BallFilter>,
    /// Believed poses of the last decisions, oldest first: a frame is older than now.
    past: VecDeque<(u64, Pose)>,
    odometry: Option<Pose>,
    #[reflect(ignore)]
    progress: Progress,
    last_frame: Option<u64>,
    misses: u32,
    /// How long robots have hidden the ball since it was seen last, s.
    hidden_for: f32,
    /// Where something was seen that is not believed to be the ball yet, and how often.
    elsewhere: Option<(Vec2, u32)>,
}

/// A ball that a robot believes in.
#[derive(Clone, Copy, Debug, PartialEq, Reflect)]
pub struct BallBelief {
    /// m
    pub position: Vec2,
    /// m/s
    pub velocity: Vec2,
    /// The tick of the frame that showed it last.
    pub seen: u64,
}

/// A team mate that has told where it is.
#[derive(Clone, Copy, Debug, PartialEq, Reflect)]
pub struct MateBelief {
    /// The team mate's number.
    pub number: PlayerNumber,
    /// m, where it believed itself to be.
    pub position: Vec2,
    /// A unit vector.
    pub heading: Vec2,
    /// Milliseconds on its clock when it said so.
    pub time: u32,
    /// The tick in which it was heard.
    pub heard: u64,
}

/// Another robot that a robot believes in.
#[derive(Clone, Copy, Debug, PartialEq, Reflect)]
pub struct RobotBelief {
    /// The team that its marker shows.
    pub team: Team,
    /// m
    pub position: Vec2,
    /// The tick of the frame that showed it last.
    pub seen: u64,
}

/// Share of a localisation fix that is believed at once where every frame brings one; the rest is dead reckoning.
const FIX_GAIN: f32 = 0.2;
/// A fix farther off than this is believed whole, as after being carried, m and rad.
const FIX_JUMP: (f32, f32) = (1.0, 0.7);
/// Sightings nearer to a known robot of the same team than this are taken for it, m, or than twice their deviation.
const SAME_ROBOT: f32 = 0.7;
/// Two robots do not fit nearer together than this: of two beliefs that do, the newer one is kept, m.
const ONE_PLACE: f32 = 0.35;
/// Robots of each team that are believed in at most; the one seen longest ago gives way.
pub(super) const MOST_OF_A_TEAM: usize = 8;
/// Share of a new sighting in the place of a known robot.
const SIGHTING_GAIN: f32 = 0.6;
/// Readings nearer to each other than this may be of one ball, m, or than twice their deviation.
const SAME_BALL: f32 = 0.3;
/// After this many frames that should have shown the ball and did not, it is gone.
const MISSES: u32 = 6;
/// Deceleration that robots expect of a rolling ball, m/s².
pub const EXPECTED_ROLLING: f32 = 0.3;

impl WorldModel {
    /// The beliefs of a robot that people have just put down somewhere and told where it is.
    pub fn told(pose: Pose) -> WorldModel {
        WorldModel { pose, is_localised: true, ..WorldModel::default() }
    }

    /// Whether the robot has found out where it is, or was told; before that its pose means nothing.
    pub fn is_localised(&self) -> bool {
        self.is_localised
    }

    /// What it believes of a team mate.
    pub fn mate(&self, number: PlayerNumber) -> Option<&MateBelief> {
        self.mates.iter().find(|mate| mate.number == number)
    }

    /// The team mates seen that are none of those heard.
    pub fn strangers(&self, team: Team) -> impl Iterator<Item = Vec2> + '_ {
        self.of_team(team).filter(|seen| self.known_as(*seen).is_none())
    }

    /// The team mate that says that it is where one is seen.
    pub fn known_as(&self, seen: Vec2) -> Option<PlayerNumber> {
        let near = self.mates.iter().filter(|mate| mate.position.distance(seen) < SAME_ROBOT);
        let nearest = near.min_by(|a, b| a.position.distance(seen).total_cmp(&b.position.distance(seen)));
        nearest.map(|mate| mate.number)
    }

    /// The robots of a team that were seen.
    pub fn of_team(&self, team: Team) -> impl Iterator<Item = Vec2> + '_ {
        self.robots.iter().filter(move |robot| robot.team == team).map(|robot| robot.position)
    }

    /// How long the robot has been told to move and has found itself not to, s.
    pub fn stalled_for(&self, clock: &Clock) -> f32 {
        self.progress.stalled_for(clock)
    }

    pub(super) fn dead_reckon(&mut self, odometry: &Odometry, clock: &Clock) {
        if let Some(before) = self.odometry.replace(odometry.pose) {
            let turn = wrap_angle(odometry.pose.heading - before.heading);
            let way = before.to_local(odometry.pose.position);
            self.pose =
                Pose { position: self.pose.to_field(way), heading: wrap_angle(self.pose.heading + turn) };
            let time = self.past.back().map_or(0.0, |(tick, _)| clock.seconds_since(*tick));
            self.progress.felt(WayReported { told: odometry.told, way: way.length(), turn, time }, clock);
        }
        self.past.push_back((clock.tick, self.pose));
        if self.past.len() > PAST {
            self.past.pop_front();
        }
    }

    /// The believed pose at a tick, between two decisions too.
    fn pose_at(&self, tick: u64) -> Pose {
        let later = self.past.partition_point(|(at, _)| *at <= tick);
        let before = later.checked_sub(1).map(|index| self.past[index]);
        match (before, self.past.get(later)) {
            (Some((start, from)), Some(&(end, to))) => {
                let share = (tick - start) as f32 / (end - start) as f32;
                Pose {
                    position: from.position.lerp(to.position, share),
                    heading: wrap_angle(from.heading + share * wrap_angle(to.heading - from.heading)),
                }
            }
            (Some((_, pose)), None) | (None, Some(&(_, pose))) => pose,
            (None, None) => self.pose,
        }
    }

    /// Takes in the fix of a frame, if it has one. A robot that does not know its place at all waits for a full one.
    fn localise(&mut self, frame: &Frame, eyes: &Eyes, clock: &Clock) {
        let Some(fix) = frame.fix.filter(|fix| self.is_localised || fix.share >= 1.0) else { return };
        let then = self.pose_at(frame.taken);
        let offset = fix.pose.position - then.position;
        let turn = wrap_angle(fix.pose.heading - then.heading);
        self.compare_places(frame.taken, fix, clock);
        let gain = if self.is_localised { fix_gain(fix.share, offset, turn, eyes) } else { 1.0 };
        // The way since then is as long as before, but leads elsewhere if the robot looked elsewhere.
        let turned = unit(gain * turn);
        let correct = |pose: Pose| Pose {
            position: then.position + gain * offset + turned.rotate(pose.position - then.position),
            heading: wrap_angle(pose.heading + gain * turn),
        };
        self.is_localised = true;
        self.pose = correct(self.pose);
        self.past.iter_mut().for_each(|(_, pose)| *pose = correct(*pose));
    }

    /// Whether landmarks show that it gets on as its wheels or steps report. Beliefs of the past move with every fix, as one, so
    /// that the way between two of them is what was reckoned.
    fn compare_places(&mut self, taken: u64, fix: Fix, clock: &Clock) {
        let mut progress = std::mem::take(&mut self.progress);
        let way = |from: u64, to: u64| self.pose_at(to).position - self.pose_at(from).position;
        progress.saw((taken, fix.pose.position), fix.share, way, clock);
        self.progress = progress;
    }

    /// The chin holds the ball, a little ahead of the robot's centre.
    pub(super) fn feel_ball(&mut self, ahead: Vec2, tick: u64) {
        let position = self.pose.to_field(ahead);
        self.filter = Some(BallFilter::new(position, 0.02));
        self.ball = Some(BallBelief { position, velocity: Vec2::ZERO, seen: tick });
        (self.misses, self.hidden_for, self.elsewhere) = (0, 0.0, None);
    }

    fn see_ball(&mut self, frame: &Frame, sensing: &Sensing, dt_since_last: f32) {
        let (then, eyes) = (self.pose_at(frame.taken), &sensing.eyes);
        self.filter = self.filter.map(|filter| filter.predict(dt_since_last, EXPECTED_ROLLING));
        let reading = frame.ball.map(|sighting| (sighting.placed(then), deviation(eyes, sighting)));
        match reading.and_then(|(at, deviation)| self.believed(at, deviation, sensing.memory)) {
            Some(filter) => {
                self.filter = Some(self.as_touched(filter, frame, then, sensing.memory));
                (self.misses, self.hidden_for, self.elsewhere) = (0, 0.0, None);
                self.ball = self.filter.map(|filter| BallBelief {
                    position: filter.position,
                    velocity: filter.velocity,
                    seen: frame.taken,
                });
            }
            None => {
                self.filter = self.filter.map(|filter| self.as_touched(filter, frame, then, sensing.memory));
                let expected = self.filter.map(|filter| Sighting::of(filter.position, then));
                if let Some(expected) = expected.filter(|expected| should_be_seen(eyes, frame, *expected)) {
                    self.miss_ball(is_hidden(expected, frame), dt_since_last, sensing.memory);
                }
            }
        }
    }

    /// What is believed of the ball after a reading, if the reading is believed: one far from where the ball should be, or of a ball
    /// of which nothing is known, needs others near it.
    fn believed(&mut self, at: Vec2, deviation: f32, memory: MemorySpans) -> Option<BallFilter> {
        if let Some(filter) = self.filter.filter(|filter| !filter.is_far(at, deviation)) {
            return Some(filter.update(at, deviation));
        }
        let near = (self.elsewhere).filter(|(other, _)| other.distance(at) < SAME_BALL.max(2.0 * deviation));
        let readings = near.map_or(1, |(_, readings)| readings + 1);
        self.elsewhere = Some((at, readings));
        (readings >= memory.jump_readings).then(|| BallFilter::new(at, deviation))
    }

    fn as_touched(&self, filter: BallFilter, frame: &Frame, from: Pose, memory: MemorySpans) -> BallFilter {
        let touches = |(_, robot): &(Team, Sighting)| {
            robot.placed(from).distance(filter.position) < memory.touched_ball
        };
        if frame.robots.iter().any(touches) { filter.touched() } else { filter }
    }

    /// A frame should have shown the ball and did not.
    fn miss_ball(&mut self, is_hidden: bool, dt: f32, memory: MemorySpans) {
        if is_hidden {
            self.hidden_for += dt;
        }
        let excused = is_hidden && memory.hidden_ball.is_none_or(|longest| self.hidden_for <= longest);
        self.misses += u32::from(!excused);
    }

    /// Each sighting renews one belief or adds one. Noise makes two beliefs of one robot now and then; they are made one
    /// where they meet, fade with the memory otherwise, and are never more than [`MOST_OF_A_TEAM`].
    fn see_robots(&mut self, frame: &Frame, eyes: &Eyes) {
        let then = self.pose_at(frame.taken);
        let gain = if *eyes == Eyes::Perfect { 1.0 } else { SIGHTING_GAIN };
        for (team, sighting) in &frame.robots {
            let (at, seen) = (sighting.placed(then), frame.taken);
            let reach = SAME_ROBOT.max(2.0 * deviation(eyes, *sighting));
            let known = (self.robots.iter_mut())
                .filter(|known| known.team == *team && known.seen < seen)
                .map(|known| (known.position.distance(at), known))
                .filter(|(distance, _)| *distance < reach)
                .min_by(|(a, _), (b, _)| a.total_cmp(b));
            match known {
                Some((_, known)) => {
                    known.position = known.position.lerp(at, gain);
                    known.seen = seen;
                }
                None => self.robots.push(RobotBelief { team: *team, position: at, seen }),
            }
        }
        self.drop_doubles(frame.taken);
    }

    fn drop_doubles(&mut self, seen: u64) {
        let fresh: SmallVec<[RobotBelief; 8]> =
            self.robots.iter().filter(|robot| robot.seen == seen).copied().collect();
        let is_double = |robot: &RobotBelief| {
            let same = |other: &RobotBelief| other.team == robot.team;
            let near = |other: &RobotBelief| other.position.distance(robot.position) < ONE_PLACE;
            robot.seen < seen && fresh.iter().any(|other| same(other) && near(other))
        };
        self.robots.retain(|robot| !is_double(robot));
        for team in Team::BOTH {
            while self.of_team(team).count() > MOST_OF_A_TEAM {
                let of_team = self.robots.iter().enumerate().filter(|(_, robot)| robot.team == team);
                let Some((oldest, _)) = of_team.min_by_key(|(_, robot)| robot.seen) else { break };
                self.robots.remove(oldest);
            }
        }
    }

    /// Where the ball has rolled to since the last frame; it stays on the pitch.
    pub(super) fn roll_ball(&mut self, pitch: &Pitch, clock: &Clock) {
        if let (Some(ball), Some(filter), Some(last)) = (&mut self.ball, self.filter, self.last_frame) {
            let age = (clock.tick - last) as f32 * clock.dt;
            let (position, velocity) = roll_on(filter.position, filter.velocity, EXPECTED_ROLLING, age);
            let half = pitch.half_size();
            ball.position = position.clamp(-half - pitch.goal.depth, half + pitch.goal.depth);
            ball.velocity = velocity;
        }
    }

    /// Takes in a camera frame, unless it is known already.
    pub(super) fn see(&mut self, frame: &Frame, sensing: &Sensing, clock: &Clock) {
        if Some(frame.taken) <= self.last_frame {
            return;
        }
        let since = frame.taken - self.last_frame.unwrap_or(frame.taken);
        self.localise(frame, &sensing.eyes, clock);
        self.see_ball(frame, sensing, since as f32 * clock.dt);
        self.see_robots(frame, &sensing.eyes);
        self.last_frame = Some(frame.taken);
    }

    /// Takes note of position messages; one that was overtaken by a later one is no news.
    pub(super) fn hear(&mut self, inbox: &Inbox, tick: u64) {
        for message in &inbox.0 {
            let TeamMessage::Position(said) = &message.message else { continue };
            let mate = MateBelief {
                number: message.from,
                position: said.position,
                heading: said.heading,
                time: said.time,
                heard: tick,
            };
            match self.mates.iter_mut().find(|known| known.number == mate.number) {
                Some(known) if mate.time < known.time => {}
                Some(known) => *known = mate,
                None => {
                    self.mates.push(mate);
                    self.mates.sort_unstable_by_key(|mate| mate.number);
                }
            }
        }
    }

    pub(super) fn forget_mates(&mut self, tick: u64, memory: u64) {
        self.mates.retain(|mate| tick.saturating_sub(mate.heard) <= memory);
    }

    pub(super) fn forget(&mut self, spans: MemorySpans, clock: &Clock) {
        let age = |seen: u64| clock.tick.saturating_sub(seen) as f32 * clock.dt;
        if self.misses >= MISSES || self.ball.is_some_and(|ball| age(ball.seen) > spans.ball) {
            (self.ball, self.filter, self.elsewhere) = (None, None, None);
            (self.misses, self.hidden_for) = (0, 0.0);
        }
        self.robots.retain(|robot| age(robot.seen) <= spans.robots);
    }
}

/// The share of a fix that is believed at once. Among landmarks beliefs follow at their own pace, however far off they are. Who
/// finds its place in pictures has weighed each landmark already.
fn fix_gain(share: f32, offset: Vec2, turn: f32, eyes: &Eyes) -> f32 {
    match eyes {
        Eyes::Perfect | Eyes::Images { .. } => 1.0,
        Eyes::Real { camera, localisation: Localisation { landmarks: Some(landmarks), .. }, .. } => {
            1.0 - ops::exp(-share / (camera.frame_hz * landmarks.settle))
        }
        Eyes::Real { .. } if offset.length() > FIX_JUMP.0 || turn.abs() > FIX_JUMP.1 => 1.0,
        Eyes::Real { .. } => FIX_GAIN,
    }
}

/// Decisions whose poses are kept: 3 s at 20 a second, which no latency should exceed.
const PAST: usize = 64;

/// Whether a robot that the frame shows stands in the way of something.
fn is_hidden(expected: Sighting, frame: &Frame) -> bool {
    frame.robots.iter().any(|(_, robot)| {
        let beside = wrap_angle(expected.bearing - robot.bearing).abs() * robot.range;
        robot.range < expected.range && beside < ROBOT_RADIUS
    })
}

/// Robots take each other to be this large, m.
const ROBOT_RADIUS: f32 = 0.25;

fn deviation(eyes: &Eyes, sighting: Sighting) -> f32 {
    eyes.camera().map_or(0.001, |camera| {
        let across = camera.bearing_noise.to_radians() * sighting.range;
        range_deviation(camera, sighting.range).max(across).max(0.01)
    })
}
