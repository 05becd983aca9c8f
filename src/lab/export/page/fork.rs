//! Another future as a page shows it: where the bodies are from a tick on, and what the referee says.

use super::data::{ForkedRobot, PageFork};
use super::recorder::event_of;
use super::track::{AngleTrack, HEADING, PLACE, PointTrack, PoseTrack};
use crate::lab::export::moment::MatchMoment;

/// Collects another future, tick by tick.
pub struct ForkRecorder {
    title: String,
    from: Option<u64>,
    until: u64,
    score: [u32; 2],
    ball: PointTrack,
    robots: Vec<(PoseTrack, Option<AngleTrack>)>,
    events: Vec<(u64, String)>,
}

impl ForkRecorder {
    /// Begins with a title that says what is changed.
    pub fn new(title: String) -> ForkRecorder {
        let ball = PointTrack::new(PLACE);
        ForkRecorder {
            title,
            from: None,
            until: 0,
            score: [0; 2],
            ball,
            robots: Vec::new(),
            events: Vec::new(),
        }
    }

    /// Takes note of a moment. The first one is that in which the fork leaves the match.
    pub fn observe(&mut self, moment: &MatchMoment) {
        let tick = moment.tick;
        if self.from.is_none() {
            self.from = Some(tick);
            let tracks = moment.robots.iter().map(|robot| {
                (PoseTrack::new(PLACE, HEADING), robot.trailer.map(|_| AngleTrack::new(HEADING)))
            });
            self.robots = tracks.collect();
        } else {
            let events = moment.calls.iter().filter_map(|call| event_of(tick, call));
            self.events.extend(events.map(|event| (event.tick, event.text)));
        }
        self.ball.push(tick, Some(moment.ball));
        for ((track, trailer), robot) in self.robots.iter_mut().zip(&moment.robots) {
            track.push(tick, Some(robot.pose));
            if let (Some(track), Some(pose)) = (trailer, robot.trailer) {
                track.push(tick, pose.heading);
            }
        }
        (self.until, self.score) = (tick, moment.score);
    }

    /// The fork, with what its end tells.
    pub fn finish(self, detail: impl FnOnce(u64, [u32; 2]) -> String) -> PageFork {
        let robots = self.robots.into_iter();
        PageFork {
            title: self.title,
            detail: detail(self.until, self.score),
            from: self.from.unwrap_or(self.until),
            until: self.until,
            score: self.score,
            ball: self.ball.finish(),
            robots: robots
                .map(|(track, trailer)| ForkedRobot {
                    track: track.finish(),
                    trailer: trailer.map(AngleTrack::finish),
                })
                .collect(),
            events: self.events,
        }
    }
}
