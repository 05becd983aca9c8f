//! The messages of a log. Their fields are those of the schemas beside this file.

use serde::Serialize;
use serde_json::Value;

use crate::comms::messages::TeamMessage;
use crate::comms::radio::{Transmission, TransmissionState};
use crate::geometry::{Pose, Sighting, Vec2};
use crate::ids::{PlayerNumber, RobotId, Team};
use crate::lab::export::moment::{MatchMoment, RobotMoment};
use crate::robot::{Fix, Frame};
use crate::world::BodyEvent;

#[derive(Debug, Serialize)]
struct LoggedPoint {
    x: f32,
    y: f32,
}

impl From<Vec2> for LoggedPoint {
    fn from(Vec2 { x, y }: Vec2) -> LoggedPoint {
        LoggedPoint { x, y }
    }
}

#[derive(Debug, Serialize)]
struct LoggedPose {
    x: f32,
    y: f32,
    heading: f32,
}

impl From<Pose> for LoggedPose {
    fn from(Pose { position: Vec2 { x, y }, heading }: Pose) -> LoggedPose {
        LoggedPose { x, y, heading }
    }
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedPoses {
    tick: u64,
    ball: LoggedPoint,
    robots: Vec<LoggedBody>,
}

#[derive(Debug, Serialize)]
struct LoggedBody {
    robot: RobotId,
    #[serde(flatten)]
    pose: LoggedPose,
    #[serde(skip_serializing_if = "Option::is_none")]
    trailer: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    head: Option<f32>,
}

impl LoggedPoses {
    pub fn of(moment: &MatchMoment) -> LoggedPoses {
        let body = |robot: &RobotMoment| LoggedBody {
            robot: robot.id,
            pose: robot.pose.into(),
            trailer: robot.trailer.map(|trailer| trailer.heading),
            head: robot.kind.neck.is_some().then_some(robot.pan),
        };
        let robots = moment.robots.iter().map(body).collect();
        LoggedPoses { tick: moment.tick, ball: moment.ball.into(), robots }
    }
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedPercepts {
    tick: u64,
    robot: RobotId,
    taken: u64,
    pan: f32,
    #[serde(skip_serializing_if = "Option::is_none")]
    ball: Option<Sighting>,
    robots: Vec<LoggedSighting>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fix: Option<LoggedFix>,
}

#[derive(Debug, Serialize)]
struct LoggedSighting {
    team: String,
    #[serde(flatten)]
    sighting: Sighting,
}

#[derive(Debug, Serialize)]
struct LoggedFix {
    #[serde(flatten)]
    pose: LoggedPose,
    share: f32,
}

impl LoggedPercepts {
    pub fn of(tick: u64, robot: RobotId, frame: &Frame) -> LoggedPercepts {
        let seen = |(team, sighting): &(Team, Sighting)| LoggedSighting {
            team: team.to_string(),
            sighting: *sighting,
        };
        LoggedPercepts {
            tick,
            robot,
            taken: frame.taken,
            pan: frame.pan,
            ball: frame.ball,
            robots: frame.robots.iter().map(seen).collect(),
            fix: frame.fix.map(|Fix { pose, share }| LoggedFix { pose: pose.into(), share }),
        }
    }
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedBeliefs {
    tick: u64,
    robot: RobotId,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose: Option<LoggedPose>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ball: Option<LoggedPoint>,
    robots: Vec<LoggedOther>,
}

#[derive(Debug, Serialize)]
struct LoggedOther {
    team: String,
    #[serde(flatten)]
    at: LoggedPoint,
}

impl LoggedBeliefs {
    pub fn of(tick: u64, robot: &RobotMoment) -> LoggedBeliefs {
        let other = |(team, at): &(Team, Vec2)| LoggedOther { team: team.to_string(), at: (*at).into() };
        LoggedBeliefs {
            tick,
            robot: robot.id,
            pose: robot.believed.map(LoggedPose::from),
            ball: robot.believed_ball.map(LoggedPoint::from),
            robots: robot.believed_robots.iter().map(other).collect(),
        }
    }
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedMessage {
    id: u64,
    kind: String,
    from: RobotId,
    to: RobotId,
    sent: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    arrived: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lost: Option<String>,
    late: bool,
    doubled: bool,
    bytes: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    attempt: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    content: Option<Value>,
}

impl LoggedMessage {
    pub fn of(entry: &Transmission) -> LoggedMessage {
        let message = entry.packet.message();
        let (arrived, lost) = match entry.state {
            TransmissionState::Arrived(tick) => (Some(tick), None),
            TransmissionState::InFlight(_) => (None, None),
            TransmissionState::Lost(loss) => (None, Some(loss.to_string())),
        };
        LoggedMessage {
            id: entry.id,
            kind: entry.packet.kind.to_string(),
            from: entry.packet.from,
            to: entry.packet.to,
            sent: entry.sent,
            arrived,
            lost,
            late: entry.late,
            doubled: entry.doubled,
            bytes: entry.packet.bytes.len(),
            attempt: match &message {
                Some(TeamMessage::RoleSwap(message)) => Some(message.sequence()),
                _ => None,
            },
            content: message.as_ref().and_then(content),
        }
    }
}

/// The fields of a message.
fn content(message: &TeamMessage) -> Option<Value> {
    let content = match message {
        TeamMessage::Position(it) => serde_json::to_value(it),
        TeamMessage::HaveBall(it) => serde_json::to_value(it),
        TeamMessage::Goalie(it) => serde_json::to_value(it),
        TeamMessage::RoleSwap(it) => serde_json::to_value(it),
        TeamMessage::Values(it) => serde_json::to_value(it),
        TeamMessage::Book(it) => serde_json::to_value(it),
        TeamMessage::BallReport(it) => serde_json::to_value(it),
        TeamMessage::Text(it) => Ok(serde_json::json!({ "text": it })),
    };
    content.ok()
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedRole {
    pub tick: u64,
    pub robot: RobotId,
    pub role: String,
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedState {
    pub tick: u64,
    pub robot: RobotId,
    pub acting_as: String,
    pub state: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub because: Option<String>,
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedBooking {
    pub tick: u64,
    pub robot: RobotId,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub booker: Option<PlayerNumber>,
    pub goes: bool,
}

#[derive(Debug, Serialize)]
pub(super) struct LoggedEvent {
    tick: u64,
    kind: &'static str,
    text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    robot: Option<RobotId>,
}

impl LoggedEvent {
    /// What has happened in the tick before a moment.
    pub fn all(moment: &MatchMoment, before: Option<&MatchMoment>) -> Vec<LoggedEvent> {
        let tick = moment.tick;
        let calls = moment.calls.iter().map(|call| LoggedEvent {
            tick,
            kind: "call",
            text: call.to_string(),
            robot: None,
        });
        let bodies = moment.body_events.iter().map(|(robot, event)| LoggedEvent {
            tick,
            kind: "body",
            text: format!("{robot} {}", words(*event)),
            robot: Some(*robot),
        });
        let robots = before.into_iter().flat_map(|before| before.robots.iter().zip(&moment.robots));
        let ill = robots.filter(|(before, robot)| before.health != robot.health).map(|(_, robot)| {
            let health = robot.health;
            let all = [
                (health.crashed, "crashed"),
                (health.frozen, "frozen"),
                (health.deaf, "deaf"),
                (health.mute, "mute"),
            ];
            let ill: Vec<&str> = all.into_iter().filter_map(|(is_so, word)| is_so.then_some(word)).collect();
            let now = if ill.is_empty() { "well".to_owned() } else { ill.join(", ") };
            LoggedEvent {
                tick,
                kind: "health",
                text: format!("{} is {now}", robot.id),
                robot: Some(robot.id),
            }
        });
        calls.chain(bodies).chain(ill).collect()
    }
}

fn words(event: BodyEvent) -> &'static str {
    match event {
        BodyEvent::Fell => "falls",
        BodyEvent::KickTried => "kicks",
        BodyEvent::KickStruck => "strikes the ball",
        BodyEvent::KickMissed => "misses the ball",
        BodyEvent::BallCaught => "catches the ball",
        BodyEvent::BallSlipped => "loses the ball from under its chin",
    }
}
