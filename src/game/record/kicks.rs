//! Kicks and grips: what robots tried to do with the ball, and what became of it.

use serde::Serialize;

use crate::ids::{RobotId, Team};
use crate::world::BodyEvent;

/// The kicks of a team. Those that are neither struck nor missed were broken off or go on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct KickFigures {
    /// Kicks that began.
    pub tried: u32,
    /// Kicks that met the ball.
    pub struck: u32,
    /// Kicks that met nothing.
    pub missed: u32,
}

/// What a team's chins did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct GripFigures {
    /// Balls that they got hold of.
    pub caught: u32,
    /// Balls that others pushed or kicked out from under them.
    pub slipped: u32,
}

impl KickFigures {
    pub(super) fn update(&mut self, team: Team, events: &[(RobotId, BodyEvent)]) {
        for event in of_team(team, events) {
            match event {
                BodyEvent::KickTried => self.tried += 1,
                BodyEvent::KickStruck => self.struck += 1,
                BodyEvent::KickMissed => self.missed += 1,
                BodyEvent::Fell | BodyEvent::BallCaught | BodyEvent::BallSlipped => {}
            }
        }
    }
}

impl GripFigures {
    pub(super) fn update(&mut self, team: Team, events: &[(RobotId, BodyEvent)]) {
        for event in of_team(team, events) {
            match event {
                BodyEvent::BallCaught => self.caught += 1,
                BodyEvent::BallSlipped => self.slipped += 1,
                BodyEvent::Fell | BodyEvent::KickTried | BodyEvent::KickStruck | BodyEvent::KickMissed => {}
            }
        }
    }
}

/// How many robots of a team fell.
pub(super) fn count_falls(team: Team, events: &[(RobotId, BodyEvent)]) -> u32 {
    of_team(team, events).filter(|event| *event == BodyEvent::Fell).count() as u32
}

fn of_team(team: Team, events: &[(RobotId, BodyEvent)]) -> impl Iterator<Item = BodyEvent> {
    events.iter().filter(move |(id, _)| id.team == team).map(|(_, event)| *event)
}

#[cfg(test)]
mod tests {
    use super::super::play_tick::stage::{AWAY_1, HOME_1, HOME_2};
    use super::*;
    use BodyEvent::*;

    const EVENTS: [(RobotId, BodyEvent); 9] = [
        (HOME_1, KickTried),
        (HOME_2, KickTried),
        (HOME_1, KickMissed),
        (AWAY_1, KickTried),
        (AWAY_1, KickStruck),
        (AWAY_1, BallCaught),
        (HOME_2, BallSlipped),
        (HOME_2, Fell),
        (HOME_1, Fell),
    ];

    #[test]
    fn what_happens_to_a_robot_counts_for_its_team() {
        let kicks = Team::BOTH.map(|team| {
            let mut kicks = KickFigures::default();
            kicks.update(team, &EVENTS);
            kicks
        });
        assert_eq!(kicks[0], KickFigures { tried: 2, struck: 0, missed: 1 });
        assert_eq!(kicks[1], KickFigures { tried: 1, struck: 1, missed: 0 });
        let grips = Team::BOTH.map(|team| {
            let mut grips = GripFigures::default();
            grips.update(team, &EVENTS);
            grips
        });
        assert_eq!(grips[0], GripFigures { caught: 0, slipped: 1 });
        assert_eq!(grips[1], GripFigures { caught: 1, slipped: 0 });
        assert_eq!(Team::BOTH.map(|team| count_falls(team, &EVENTS)), [2, 0]);
    }
}
