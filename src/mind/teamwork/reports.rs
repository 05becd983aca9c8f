//! Where team mates say the ball is (TeamChaos, section 1).

use bevy::prelude::*;
use smallvec::SmallVec;

use crate::comms::messages::BallReport;
use crate::ids::PlayerNumber;

/// What a robot's team mates said last of the ball.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BallReports(SmallVec<[Reported; 4]>);

/// What one of them said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reported {
    /// The reporter's number.
    pub by: PlayerNumber,
    /// m in the team frame.
    pub position: Vec2,
    /// Milliseconds on the sender's clock when it saw the ball there.
    seen: u32,
    /// The tick in which it was heard.
    pub heard: u64,
}

impl BallReports {
    /// Takes note of a report; one that was overtaken by a later one is no news.
    pub fn hear(&mut self, by: PlayerNumber, report: &BallReport, tick: u64) {
        let seen = report.time.saturating_sub((report.age * 1000.0) as u32);
        let reported = Reported { by, position: report.position, seen, heard: tick };
        match self.0.iter_mut().find(|known| known.by == by) {
            Some(known) if seen < known.seen => {}
            Some(known) => *known = reported,
            None => self.0.push(reported),
        }
    }

    /// Forgets what was heard longer ago than `memory` ticks.
    pub fn forget(&mut self, tick: u64, memory: u64) {
        self.0.retain(|reported| tick.saturating_sub(reported.heard) <= memory);
    }

    /// Where the ball was seen last, m in the team frame; of reports of one time that of the lowest number.
    pub fn freshest(&self) -> Option<Vec2> {
        let order = |reported: &&Reported| (reported.seen, std::cmp::Reverse(reported.by));
        self.0.iter().max_by_key(order).map(|reported| reported.position)
    }

    /// In the order in which the team mates were first heard.
    pub fn iter(&self) -> impl Iterator<Item = &Reported> {
        self.0.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(time: u32, x: f32, age: f32) -> BallReport {
        BallReport { time, position: Vec2::new(x, 0.0), age }
    }

    #[test]
    fn who_saw_the_ball_last_is_believed() {
        let mut reports = BallReports::default();
        reports.hear(1, &report(5000, 1.0, 2.0), 10);
        reports.hear(2, &report(4000, 2.0, 0.1), 11);
        assert_eq!(reports.freshest(), Some(Vec2::new(2.0, 0.0)));
    }

    #[test]
    fn overtaken_reports_change_nothing_and_old_ones_are_forgotten() {
        let mut reports = BallReports::default();
        reports.hear(1, &report(2000, 1.0, 0.0), 10);
        reports.hear(1, &report(1000, 9.0, 0.0), 12);
        assert_eq!(reports.freshest(), Some(Vec2::new(1.0, 0.0)));
        reports.forget(40, 30);
        assert!(reports.freshest().is_some());
        reports.forget(41, 30);
        assert_eq!(reports.freshest(), None);
    }
}
