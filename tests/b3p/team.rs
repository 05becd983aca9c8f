//! What a run is about: the team, its rules, its radio, where the ball may lie and what may happen once.

use touchline::ids::PlayerNumber;
use touchline::protocol::b3p::{B3p, BookingSettings, Distance, Rules, Update};

pub const ALWAYS: Rules = Rules::Paper(Update::Always);
pub const CAUTIOUS: Rules = Rules::Paper(Update::Cautious);
pub const LEXICOGRAPHIC: Rules = Rules::Lexicographic;
pub const HARDENED: Rules = Rules::Hardened { release: false };
pub const RELEASING: Rules = Rules::Hardened { release: true };

/// A model. Each robot turns once in a tick, in any order.
#[derive(Clone, Debug)]
pub struct Team {
    pub rules: Rules,
    pub robots: u8,
    pub radio: Radio,
    pub timeout: u8,
    pub threshold: u8,
    /// All robots turn before any message arrives in that tick.
    pub in_phase: bool,
    pub ball: Ball,
    /// A measured distance is too great by up to this much, drawn in each turn.
    pub noise: u8,
    pub misfortune: Misfortune,
    pub release: Release,
}

/// In ticks, but for the losses.
#[derive(Clone, Copy, Debug)]
pub struct Radio {
    /// A message arrives at the end of this tick or of so many later, or before that.
    pub delay: u8,
    /// A booker announces its booking again after so many.
    pub renewal: u8,
    /// At most so many messages in a row are lost from one robot to another.
    pub losses: u8,
}

/// How far the robots are from the ball: 0 to 2.
#[derive(Clone, Debug)]
pub enum Ball {
    Anywhere,
    At(Vec<u8>),
}

/// What may happen once, at any moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Misfortune {
    None,
    /// The ball comes to lie somewhere else.
    Kick,
    /// A robot is gone for good. What it has sent is still heard.
    Crash,
    /// A robot does not see the ball any more.
    Blindness,
}

/// How a release is told. All but the first show what its ingredients are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Release {
    /// In a new term, and again like every booking.
    Repeated,
    Once,
    /// As a renewal, in the old term, at an infinite distance.
    RepeatedAsRenewal,
    OnceAsRenewal,
}

pub const fn radio(delay: u8, renewal: u8, losses: u8) -> Radio {
    Radio { delay, renewal, losses }
}

impl Radio {
    /// The least timeout that outlasts all that the radio does to renewals.
    pub fn timeout(self) -> u8 {
        (self.losses + 1) * self.renewal + self.delay
    }

    /// How long it takes at most until an announcement is heard.
    pub fn latency(self) -> usize {
        usize::from(self.delay + self.losses * self.renewal)
    }
}

impl Team {
    /// Two robots, the ball anywhere, a threshold of one, the least timeout, and nothing happens.
    pub fn new(rules: Rules, radio: Radio) -> Team {
        Team {
            rules,
            robots: 2,
            radio,
            timeout: radio.timeout(),
            threshold: 1,
            in_phase: false,
            ball: Ball::Anywhere,
            noise: 0,
            misfortune: Misfortune::None,
            release: Release::Repeated,
        }
    }

    /// Robots that are all at distance 1 of the ball.
    pub fn equally_far(self, robots: u8) -> Team {
        Team { robots, ball: Ball::At(vec![1; usize::from(robots)]), ..self }
    }

    pub fn of_three(self) -> Team {
        Team { robots: 3, ..self }
    }

    pub fn in_phase(self) -> Team {
        Team { in_phase: true, ..self }
    }

    pub fn timing_out_after(self, timeout: u8) -> Team {
        Team { timeout, ..self }
    }

    pub fn with(self, misfortune: Misfortune) -> Team {
        Team { misfortune, ..self }
    }

    pub fn machine(&self, robot: PlayerNumber) -> B3p {
        let settings = BookingSettings {
            rules: self.rules,
            threshold: Distance(self.threshold.into()),
            timeout: self.timeout.into(),
            renewal: self.radio.renewal.into(),
        };
        B3p::new(robot, settings)
    }

    /// Where the ball may lie: the distances of the robots.
    pub fn places(&self) -> Vec<Vec<u8>> {
        match &self.ball {
            Ball::At(distances) => vec![distances.clone()],
            Ball::Anywhere => (0..self.robots).fold(vec![Vec::new()], |places, _| {
                let further =
                    |place: Vec<u8>| (0..=2).map(move |distance| [&place[..], &[distance]].concat());
                places.into_iter().flat_map(further).collect()
            }),
        }
    }
}
