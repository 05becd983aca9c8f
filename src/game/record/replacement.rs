//! How soon a robot that went for the ball and then out of play is replaced.

use serde::Serialize;

/// How long nobody of a team went for the ball after the only robot that did went out of play: switched off, broken or taken off.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Replacement {
    /// How long it took each time until one of the team went for the ball again, before play was interrupted, s.
    pub seconds: Vec<f64>,
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
            self.seconds.push(now - since);
        }
    }

    /// Play is interrupted.
    pub(super) fn interrupt(&mut self) {
        self.since = None;
    }
}
