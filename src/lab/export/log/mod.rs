//! A match as a log in the format [MCAP](https://mcap.dev), for Foxglove and other tools: JSON messages with their schemas, in match
//! time, and drawings as `foxglove.SceneUpdate`.

mod logged;
mod scene;
mod topics;

use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use serde::Serialize;

use super::moment::{MatchMoment, RobotMoment};
use crate::comms::radio::Transmission;
use crate::game::MatchPlan;
use logged::{
    LoggedBeliefs, LoggedBooking, LoggedEvent, LoggedMessage, LoggedPercepts, LoggedPoses, LoggedRole,
    LoggedState,
};
use topics::{LogTopic, TOPICS};

/// Ticks between two logs of poses, of frames, of beliefs and of their drawings: twenty, ten, five and two and a half a second.
const POSES_EVERY: u64 = 3;
const FRAMES_EVERY: u64 = 6;
const BELIEFS_EVERY: u64 = 12;
const DRAWINGS_EVERY: u64 = 24;

/// Writes a log, tick by tick.
pub(super) struct LogWriter {
    writer: Writer<Cursor<Vec<u8>>>,
    /// By [`LogTopic`].
    channels: Vec<u16>,
    counts: Vec<u32>,
    before: Option<MatchMoment>,
    pitch: crate::pitch::Pitch,
    ball_radius: f32,
}

impl LogWriter {
    /// Begins a log with its schemas and channels.
    pub fn new(plan: &MatchPlan) -> Result<LogWriter, McapError> {
        let library = concat!("touchline ", env!("CARGO_PKG_VERSION"));
        let options = WriteOptions::new().compression(None).library(library);
        let mut writer = Writer::with_options(Cursor::new(Vec::new()), options)?;
        let mut channels = Vec::new();
        for topic in &TOPICS {
            let schema = writer.add_schema(topic.schema, "jsonschema", topic.text.as_bytes())?;
            channels.push(writer.add_channel(schema, topic.name, "json", &BTreeMap::new())?);
        }
        let counts = vec![0; channels.len()];
        let (pitch, ball_radius) = (plan.pitch.clone(), plan.ball.radius);
        Ok(LogWriter { writer, channels, counts, before: None, pitch, ball_radius })
    }

    /// Takes note of a moment.
    pub fn observe(&mut self, moment: &MatchMoment) -> Result<(), McapError> {
        let now = moment.seconds;
        let before = self.before.replace(moment.clone());
        if before.is_none() {
            self.log(LogTopic::Pitch, now, &scene::pitch(&self.pitch, now))?;
            self.log(LogTopic::Robots, now, &scene::bodies(moment, self.ball_radius))?;
        }
        if moment.tick.is_multiple_of(POSES_EVERY) {
            self.log(LogTopic::Poses, now, &LoggedPoses::of(moment))?;
        }
        if moment.tick.is_multiple_of(FRAMES_EVERY) {
            self.log(LogTopic::Frames, now, &scene::frames(moment, self.ball_radius))?;
        }
        if moment.tick.is_multiple_of(BELIEFS_EVERY) {
            for robot in &moment.robots {
                self.log(LogTopic::Beliefs, now, &LoggedBeliefs::of(moment.tick, robot))?;
            }
        }
        if moment.tick.is_multiple_of(DRAWINGS_EVERY) {
            self.log(LogTopic::BeliefScene, now, &scene::beliefs(moment, self.ball_radius))?;
        }
        for (place, robot) in moment.robots.iter().enumerate() {
            let before = before.as_ref().and_then(|before| before.robots.get(place));
            self.log_changes(moment, robot, before)?;
        }
        for entry in &moment.settled {
            self.log_packet(entry, now)?;
        }
        for event in LoggedEvent::all(moment, before.as_ref()) {
            self.log(LogTopic::Events, now, &event)?;
        }
        Ok(())
    }

    fn log_changes(
        &mut self,
        moment: &MatchMoment,
        robot: &RobotMoment,
        before: Option<&RobotMoment>,
    ) -> Result<(), McapError> {
        let (tick, now) = (moment.tick, moment.seconds);
        let strategy = &moment.strategies[robot.id.team.index()];
        let [role, acting_as, state] = robot.names(strategy);
        if let Some(frame) = &robot.frame {
            self.log(LogTopic::Percepts, now, &LoggedPercepts::of(tick, robot.id, frame))?;
        }
        if before.is_none_or(|before| before.role != robot.role) {
            let role = LoggedRole { tick, robot: robot.id, role: role.into() };
            self.log(LogTopic::Roles, now, &role)?;
        }
        if before.is_none_or(|before| before.activity != robot.activity) {
            let because = robot.because.clone();
            let (acting_as, state) = (acting_as.into(), state.into());
            let state = LoggedState { tick, robot: robot.id, acting_as, state, because };
            self.log(LogTopic::States, now, &state)?;
        }
        let booking = |robot: &RobotMoment| (robot.booker, robot.goes);
        if before.map_or(robot.booker.is_some(), |before| booking(before) != booking(robot)) {
            let (booker, goes) = booking(robot);
            self.log(LogTopic::Bookings, now, &LoggedBooking { tick, robot: robot.id, booker, goes })?;
        }
        Ok(())
    }

    fn log_packet(&mut self, entry: &Transmission, now: f64) -> Result<(), McapError> {
        self.log(LogTopic::Messages, now, &LoggedMessage::of(entry))
    }

    fn log(&mut self, topic: LogTopic, now: f64, message: &impl Serialize) -> Result<(), McapError> {
        let place = topic as usize;
        let time = (now * 1e9).round() as u64;
        let (channel_id, sequence) = (self.channels[place], self.counts[place]);
        self.counts[place] += 1;
        let header = MessageHeader { channel_id, sequence, log_time: time, publish_time: time };
        // Plain data in memory can always be written there.
        let data = serde_json::to_vec(message).unwrap_or_default();
        self.writer.write_to_known_channel(&header, &data)
    }

    /// The whole file, and how many messages it has by topic. Packets that are still under way come last.
    pub fn finish<'a>(
        mut self,
        under_way: impl Iterator<Item = &'a Transmission>,
    ) -> Result<(Vec<u8>, BTreeMap<String, u64>), McapError> {
        let now = self.before.as_ref().map_or(0.0, |moment| moment.seconds);
        for entry in under_way {
            self.log_packet(entry, now)?;
        }
        self.writer.finish()?;
        let counts = TOPICS.iter().zip(&self.counts);
        let counts = counts.map(|(topic, count)| (topic.name.to_owned(), u64::from(*count))).collect();
        Ok((self.writer.into_inner().into_inner(), counts))
    }
}
