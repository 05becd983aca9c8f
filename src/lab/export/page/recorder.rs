//! What a page shows of a match, collected tick by tick.

use super::data::{
    EventKind, ExactnessTable, FORMAT, MessageTable, PageBall, PageEvent, PageFork, PageMatch, PagePhase,
    PagePitch,
};
use super::robot_recorder::RobotRecorder;
use super::spans::WordList;
use super::track::{BELIEVED_HEADING, BELIEVED_PLACE, Exactness, HEADING, PLACE, PointTrack};
use crate::comms::messages::TeamMessage;
use crate::comms::radio::{Transmission, TransmissionState};
use crate::comms::tcm::DataType;
use crate::game::MatchPlan;
use crate::ids::RobotId;
use crate::lab::export::moment::{MatchMoment, RobotMoment};
use crate::lab::export::outlines::RobotOutlines;
use crate::pitch::Pitch;
use crate::world::referee::{Decision, PlacementReason};

/// Collects what a page shows of a match.
pub struct PageRecorder {
    page: PageMatch,
    ball: PointTrack,
    robots: Vec<RobotRecorder>,
    before: Option<MatchMoment>,
    messages: Vec<Transmission>,
    words: WordList,
}

impl PageRecorder {
    /// Begins with a match of this plan.
    pub fn new(plan: &MatchPlan, dt: f32) -> PageRecorder {
        let of = |exactness: Exactness| [exactness.unit, exactness.tolerance];
        PageRecorder {
            page: PageMatch {
                format: FORMAT,
                program: concat!("Touchline ", env!("CARGO_PKG_VERSION")).into(),
                name: plan.name.clone(),
                seed: plan.seed,
                digest: String::new(),
                teams: plan.teams.each_ref().map(|team| team.strategy.name.clone()),
                dt: f64::from(dt),
                ticks: 0,
                half_seconds: plan.rules.half_seconds(),
                exact: ExactnessTable {
                    place: of(PLACE),
                    heading: of(HEADING),
                    believed_place: of(BELIEVED_PLACE),
                    believed_heading: of(BELIEVED_HEADING),
                },
                pitch: page_pitch(&plan.pitch),
                ball: PageBall { radius: plan.ball.radius, track: PointTrack::new(PLACE).finish() },
                kinds: Vec::new(),
                robots: Vec::new(),
                tags: Default::default(),
                phases: Vec::new(),
                events: Vec::new(),
                messages: MessageTable::default(),
                forks: Vec::new(),
                words: Vec::new(),
            },
            ball: PointTrack::new(PLACE),
            robots: Vec::new(),
            before: None,
            messages: Vec::new(),
            words: WordList::default(),
        }
    }

    /// Takes note of a moment. They come in order, the first one before the first tick.
    pub fn observe(&mut self, moment: &MatchMoment) {
        let tick = moment.tick;
        if self.robots.is_empty() {
            self.robots = moment.robots.iter().map(|robot| recorder(&mut self.page.kinds, robot)).collect();
        }
        self.ball.push(tick, Some(moment.ball));
        for (recorder, robot) in self.robots.iter_mut().zip(&moment.robots) {
            let strategy = &moment.strategies[robot.id.team.index()];
            recorder.observe(tick, robot, strategy, &mut self.words);
        }
        self.note_phase(moment);
        self.page.events.extend(moment.calls.iter().filter_map(|call| event_of(tick, call)));
        if let Some(before) = &self.before {
            self.page.events.extend(robot_events(before, moment));
        }
        self.messages.extend(moment.settled.iter().filter(|entry| is_told(entry.packet.kind)).cloned());
        self.page.ticks = tick;
        self.before = Some(moment.clone());
    }

    /// Tells that packets are still under way at the end.
    pub fn note_under_way<'a>(&mut self, entries: impl Iterator<Item = &'a Transmission>) {
        self.messages.extend(entries.filter(|entry| is_told(entry.packet.kind)).cloned());
    }

    /// Adds another future.
    pub fn add_fork(&mut self, fork: PageFork) {
        self.page.forks.push(fork);
    }

    /// The ticks in which goals fell.
    pub fn goals(&self) -> impl Iterator<Item = u64> + '_ {
        self.page.events.iter().filter(|event| event.kind == EventKind::Goal).map(|event| event.tick)
    }

    /// The packets of messages that the page tells of, in the order in which their fates were known.
    pub fn told_messages(&self) -> &[Transmission] {
        &self.messages
    }

    /// All of it, with the digest of the match.
    pub fn finish(self, digest: u64) -> PageMatch {
        let PageRecorder { mut page, ball, robots, mut messages, mut words, before } = self;
        let names: Vec<RobotId> =
            before.iter().flat_map(|moment| moment.robots.iter().map(|robot| robot.id)).collect();
        messages.sort_unstable_by_key(|entry| entry.id);
        for (tags, strategy) in page.tags.iter_mut().zip(before.iter().flat_map(|moment| &moment.strategies))
        {
            tags.extend(strategy.roles.iter().map(|role| (role.name.clone(), role.tag.clone())));
        }
        page.digest = format!("{digest:016x}");
        page.ball.track = ball.finish();
        page.robots = robots.into_iter().map(|robot| robot.finish(page.ticks)).collect();
        page.messages = message_table(&messages, &names, &mut words);
        page.words = words.finish();
        page
    }

    fn note_phase(&mut self, moment: &MatchMoment) {
        let phase = PagePhase {
            tick: moment.tick,
            phase: moment.phase.to_string(),
            half: moment.half,
            left: moment.time_left,
            score: moment.score,
        };
        let known = self.page.phases.last();
        let is_known = |known: &PagePhase| {
            (&known.phase, known.half, known.score) == (&phase.phase, phase.half, phase.score)
        };
        if !known.is_some_and(is_known) {
            self.page.phases.push(phase);
        }
    }
}

/// A recorder for a robot, whose kind is drawn like one that is known, or like a new one.
fn recorder(kinds: &mut Vec<RobotOutlines>, robot: &RobotMoment) -> RobotRecorder {
    let outlines = RobotOutlines::of(&robot.kind);
    let known = kinds.iter().position(|kind| *kind == outlines);
    let kind = known.unwrap_or_else(|| {
        kinds.push(outlines);
        kinds.len() - 1
    });
    RobotRecorder::new(robot, kind)
}

fn page_pitch(pitch: &Pitch) -> PagePitch {
    PagePitch {
        length: pitch.length,
        width: pitch.width,
        goal: [pitch.goal.width, pitch.goal.depth],
        area: [pitch.penalty_area.depth, pitch.penalty_area.width],
        circle: pitch.centre_circle_radius,
        spots: pitch.penalty_spots.clone(),
        margin: pitch.margin(),
        wall: pitch.walls.thickness,
    }
}

/// Whether a page tells of messages of a kind. Routine news that all robots send several times a second would hide the others.
pub fn is_told(kind: DataType) -> bool {
    ![DataType::POSITION, DataType::BALL_REPORT, DataType::VALUES].contains(&kind)
}

fn message_table(messages: &[Transmission], robots: &[RobotId], words: &mut WordList) -> MessageTable {
    let mut table = MessageTable::default();
    let mut before = 0;
    let place = |robot: RobotId| robots.iter().position(|known| *known == robot);
    for entry in messages {
        let (Some(from), Some(to)) = (place(entry.packet.from), place(entry.packet.to)) else { continue };
        // What is said in a tick belongs to the moment after it.
        let sent = entry.sent as i64 + 1;
        table.sent.push(sent - before);
        before = sent;
        let (took, lost) = match entry.state {
            TransmissionState::Arrived(at) | TransmissionState::InFlight(at) => {
                (at.saturating_sub(entry.sent), 0)
            }
            TransmissionState::Lost(loss) => (0, 1 + words.number(&loss.to_string())),
        };
        table.took.push(took);
        table.from.push(from);
        table.to.push(to);
        table.kind.push(words.number(&entry.packet.kind.to_string()));
        table.attempt.push(attempt_of(entry));
        table.lost.push(lost);
        table.late.push(entry.late.into());
    }
    table
}

fn attempt_of(entry: &Transmission) -> u64 {
    match entry.packet.message() {
        Some(TeamMessage::RoleSwap(message)) => u64::from(message.sequence()),
        _ => 0,
    }
}

/// What a page marks of a decision.
pub(super) fn event_of(tick: u64, call: &Decision) -> Option<PageEvent> {
    let (kind, team) = match call {
        Decision::Goal { by, .. } => (EventKind::Goal, Some(by.index())),
        Decision::NoGoal { by, .. } => (EventKind::Call, Some(by.index())),
        Decision::Untouched { .. } => (EventKind::Call, None),
        Decision::RobotWarned { robot } | Decision::RobotRemoved { robot, .. } => {
            (EventKind::Removal, Some(robot.team.index()))
        }
        Decision::RobotReturned { robot, .. } => (EventKind::Call, Some(robot.team.index())),
        Decision::HalfEnded { .. } | Decision::MatchFinished { .. } => (EventKind::Half, None),
        Decision::BallPlaced { reason: PlacementReason::KickOff, .. }
        | Decision::PhaseChanged(_)
        | Decision::RobotPlaced { .. }
        | Decision::RobotsPlaced { .. } => return None,
        Decision::BallPlaced { .. } => (EventKind::Call, None),
    };
    Some(PageEvent { tick, kind, text: call.to_string(), team })
}

/// What has changed of robots' roles and health.
fn robot_events(before: &MatchMoment, now: &MatchMoment) -> Vec<PageEvent> {
    let mut events = Vec::new();
    for (before, robot) in before.robots.iter().zip(&now.robots) {
        let team = robot.id.team.index();
        let event = |kind, text| PageEvent { tick: now.tick, kind, text, team: Some(team) };
        if before.role != robot.role {
            let strategy = &now.strategies[team];
            let [old, new] = [before, robot].map(|robot| robot.names(strategy)[0].clone());
            events.push(event(EventKind::Role, format!("{}: {old} becomes {new}", robot.id)));
        }
        if before.health.crashed != robot.health.crashed {
            let what = if robot.health.crashed { "crashes" } else { "is back" };
            events.push(event(EventKind::Crash, format!("{} {what}", robot.id)));
        }
    }
    events
}
