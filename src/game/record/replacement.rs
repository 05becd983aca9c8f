//! How soon a robot that went for the ball and then out of play is replaced.

use serde::Serialize;

/// How long nobody of a team went for the ball after the only robot that did went out of play: switched off, broken or taken off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Replacement {
    /// How often one of the team went for the ball again, before play was interrupted.
    pub number: u32,
    /// How long that took in all, s.
    pub seconds: f64,
    /// How long it took at most, s.
    pub longest: f64,
    /// Since when somebody is missed, s of play.
    #[serde(skip)]
    since: Option<f64>,
}

impl Replacement {
    /// The only robot that went for the ball is out of play.
    pub(super) fn miss(&mut self, now: f64) {
        self.since = Some(now);
    }

    /// Somebody goes for the ball.
    pub(super) fn go(&mut self, now: f64) {
        if let Some(since) = self.since.take() {
            self.number += 1;
            self.seconds += now - since;
            self.longest = self.longest.max(now - since);
        }
    }

    /// Play is interrupted.
    pub(super) fn interrupt(&mut self) {
        self.since = None;
    }
}
