//! What a page shows of one robot, collected tick by tick.

use super::data::{OthersTable, PageRobot, RobotSigns};
use super::spans::{SpanWriter, WordList};
use super::track::{AngleTrack, BELIEVED_HEADING, BELIEVED_PLACE, HEADING, PLACE, PointTrack, PoseTrack};
use crate::ids::{PlayerNumber, RobotId, Team};
use crate::lab::export::moment::RobotMoment;
use crate::protocol::role_swap::{Lock, Sequence};
use crate::strategy::Strategy;

/// Ticks between two looks at the other robots that a robot believes in: four a second.
const OTHERS_EVERY: u64 = 15;

/// Collects what a page shows of a robot.
pub(super) struct RobotRecorder {
    id: RobotId,
    kind: usize,
    track: PoseTrack,
    trailer: Option<AngleTrack>,
    head: Option<AngleTrack>,
    believed: PoseTrack,
    believed_ball: PointTrack,
    others: OthersTable,
    others_seen: i64,
    states: Vec<(u64, usize, usize, usize, usize)>,
    signs: Vec<(u64, u16)>,
    locks: SpanWriter<Lock>,
    attempts: SpanWriter<Sequence>,
    bookings: SpanWriter<(PlayerNumber, bool)>,
    claims: SpanWriter<()>,
}

impl RobotRecorder {
    pub fn new(robot: &RobotMoment, kind: usize) -> RobotRecorder {
        let has_neck = robot.kind.neck.is_some();
        RobotRecorder {
            id: robot.id,
            kind,
            track: PoseTrack::new(PLACE, HEADING),
            trailer: robot.trailer.map(|_| AngleTrack::new(HEADING)),
            head: has_neck.then(|| AngleTrack::new(BELIEVED_HEADING)),
            believed: PoseTrack::new(BELIEVED_PLACE, BELIEVED_HEADING),
            believed_ball: PointTrack::new(BELIEVED_PLACE),
            others: OthersTable::default(),
            others_seen: 0,
            states: Vec::new(),
            signs: Vec::new(),
            locks: SpanWriter::default(),
            attempts: SpanWriter::default(),
            bookings: SpanWriter::default(),
            claims: SpanWriter::default(),
        }
    }

    pub fn observe(&mut self, tick: u64, robot: &RobotMoment, strategy: &Strategy, words: &mut WordList) {
        self.track.push(tick, Some(robot.pose));
        if let (Some(track), Some(trailer)) = (&mut self.trailer, robot.trailer) {
            track.push(tick, trailer.heading);
        }
        if let Some(track) = &mut self.head {
            track.push(tick, robot.pan);
        }
        self.believed.push(tick, robot.believed);
        self.believed_ball.push(tick, robot.believed_ball);
        if tick.is_multiple_of(OTHERS_EVERY) {
            self.note_others(tick, robot);
        }
        self.note_state(tick, robot, strategy, words);
        let signs = signs(robot);
        if self.signs.last().is_none_or(|(_, known)| *known != signs) {
            self.signs.push((tick, signs));
        }
        self.locks.note(tick, robot.lock);
        self.attempts.note(tick, robot.attempt);
        self.bookings.note(tick, robot.booker.map(|booker| (booker, robot.goes)));
        self.claims.note(tick, robot.claims.then_some(()));
    }

    fn note_others(&mut self, tick: u64, robot: &RobotMoment) {
        let table = &mut self.others;
        table.t.push(tick as i64 - self.others_seen);
        self.others_seen = tick as i64;
        table.n.push(robot.believed_robots.len());
        for (team, at) in &robot.believed_robots {
            let [x, y] = [at.x, at.y].map(|metres| (100.0 * metres).round() as i64);
            table.at.extend([2 * x + i64::from(*team == Team::Away), y]);
        }
    }

    fn note_state(&mut self, tick: u64, robot: &RobotMoment, strategy: &Strategy, words: &mut WordList) {
        let [role, acting, state] = robot.names(strategy).map(|name| words.number(&name));
        if self.states.last().is_none_or(|(_, a, b, c, _)| (*a, *b, *c) != (role, acting, state)) {
            let because = words.number(robot.because.as_deref().unwrap_or_default());
            self.states.push((tick, role, acting, state, because));
        }
    }

    pub fn finish(self, tick: u64) -> PageRobot {
        let locks = self.locks.finish(tick).into_iter();
        let attempts = self.attempts.finish(tick).into_iter();
        let bookings = self.bookings.finish(tick).into_iter();
        PageRobot {
            name: self.id.to_string(),
            team: self.id.team.index(),
            number: self.id.number,
            kind: self.kind,
            track: self.track.finish(),
            trailer: self.trailer.map(AngleTrack::finish),
            head: self.head.map(AngleTrack::finish),
            believed: self.believed.finish(),
            believed_ball: self.believed_ball.finish(),
            others: self.others,
            states: self.states,
            signs: self.signs,
            locks: locks.map(|(from, until, lock)| (from, until, lock.by, lock.sequence.into())).collect(),
            attempts: attempts.map(|(from, until, sequence)| (from, until, sequence.into())).collect(),
            bookings: bookings.map(|(from, until, (booker, goes))| (from, until, booker, goes)).collect(),
            claims: self.claims.finish(tick).into_iter().map(|(from, until, ())| (from, until)).collect(),
        }
    }
}

fn signs(robot: &RobotMoment) -> u16 {
    let health = robot.health;
    [
        (health.crashed, RobotSigns::CRASHED),
        (health.frozen, RobotSigns::FROZEN),
        (health.deaf, RobotSigns::DEAF),
        (health.mute, RobotSigns::MUTE),
        (robot.off_pitch, RobotSigns::OFF_PITCH),
        (robot.piloted, RobotSigns::PILOTED),
    ]
    .into_iter()
    .filter_map(|(is_so, bit)| is_so.then_some(bit))
    .sum()
}
