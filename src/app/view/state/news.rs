//! What has just happened, in words: the last announcement, and what is wrong with a file.

use bevy::prelude::*;

/// The sentence at the top, while it is news.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Announcement {
    text: String,
    weight: u8,
    /// Seconds on the wall.
    left: f32,
}

impl Announcement {
    /// The sentence, if there is one.
    pub fn text(&self) -> Option<&str> {
        (self.left > 0.0).then_some(self.text.as_str())
    }

    /// Something that people did, and not the referee.
    pub fn tell(&mut self, text: String) {
        self.say(text, NEWS);
    }

    /// Shows a sentence unless a weightier one is shown.
    pub fn say(&mut self, text: String, weight: u8) {
        if self.left <= 0.0 || weight >= self.weight {
            *self = Announcement { text, weight, left: SHOWN };
        }
    }

    /// Lets some seconds pass on the wall.
    pub fn pass(&mut self, seconds: f32) {
        self.left = (self.left - seconds).max(0.0);
    }
}

/// How long a call is shown, s.
const SHOWN: f32 = 3.0;

/// Weight of the news that a file was taken over.
const NEWS: u8 = 2;

/// Why the match was stopped, in words, while it stands where it was.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct StopReason(pub Option<String>);

/// What went wrong with a file, in one line.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct FileError(pub Option<String>);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_that_has_been_read_gives_way_to_anything() {
        let mut announcement = Announcement::default();
        announcement.say("Half time".into(), 3);
        announcement.pass(SHOWN);
        assert_eq!(announcement.text(), None);
        announcement.say("Play".into(), 0);
        assert_eq!(announcement.text(), Some("Play"));
    }
}
