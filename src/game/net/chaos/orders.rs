//! What an order comes to: requests, or a line that says why not.

use std::collections::VecDeque;
use std::net::SocketAddr;
use std::sync::Arc;

use super::messages::{OrderAnswer, StrategyText};
use crate::data::{Fault, Validate};
use crate::game::MatchPlan;
use crate::game::requests::{Request, RobotChange};
use crate::ids::{RobotId, Team};
use crate::vision::{CameraSettings, ColourTable};

/// What is said to somebody who wants pictures where there are none.
pub(super) const NO_CAMERA: &str =
    "it does not see by pictures: the eyes of its team's sensing must be `Images`";

/// Answers that are remembered, so that an order that comes again is not carried out again.
const REMEMBERED: usize = 64;

/// A running camera is to be set otherwise.
pub(super) fn set_camera(
    robot: RobotId,
    settings: CameraSettings,
    has_camera: bool,
) -> Result<Request, String> {
    let checked = settings.validate().map_err(line);
    with_camera(has_camera).and(checked)?;
    Ok(Request::Robot(robot, RobotChange::SetCamera(settings)))
}

/// Colours are to be cut otherwise.
pub(super) fn set_colours(robot: RobotId, colours: ColourTable, has_camera: bool) -> Result<Request, String> {
    let checked = colours.validate().map_err(line);
    with_camera(has_camera).and(checked)?;
    Ok(Request::Robot(robot, RobotChange::SetColours(colours)))
}

/// A robot that is to show pictures must have some.
pub(super) fn with_camera(has_camera: bool) -> Result<(), String> {
    if has_camera { Ok(()) } else { Err(NO_CAMERA.into()) }
}

fn line(fault: Fault) -> String {
    format!("{}: {}", fault.field, fault.message)
}

/// A team is to play another strategy: read and checked as its file would be.
pub(super) fn play_strategy(plan: &MatchPlan, team: Team, text: StrategyText) -> Result<Request, String> {
    let reading = plan.read_sent(team, &text.name, text.text);
    let strategy = reading.strategy.map_err(|error| error.to_string())?;
    Ok(Request::ChangeStrategy { team, strategy: Arc::new(strategy), texts: reading.texts })
}

/// Which orders were answered lately, and how.
#[derive(Debug, Default)]
pub(super) struct Answered(VecDeque<(SocketAddr, RobotId, OrderAnswer)>);

impl Answered {
    /// The answer to an order that comes again.
    pub fn find(&self, from: SocketAddr, robot: RobotId, number: u32) -> Option<&OrderAnswer> {
        let mut known = self.0.iter();
        known.find(|known| (known.0, known.1, known.2.number) == (from, robot, number)).map(|known| &known.2)
    }

    /// Remembers an answer, and forgets the oldest.
    pub fn remember(&mut self, from: SocketAddr, robot: RobotId, answer: OrderAnswer) {
        if self.0.len() == REMEMBERED {
            self.0.pop_front();
        }
        self.0.push_back((from, robot, answer));
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::vision::{ColourBox, ColourClass};

    const ROBOT: RobotId = RobotId::new(Team::Home, 1);

    #[test]
    fn settings_and_colours_are_checked_and_the_field_is_named() {
        let settings = CameraSettings::default();
        let set = Request::Robot(ROBOT, RobotChange::SetCamera(settings));
        assert_eq!(set_camera(ROBOT, settings, true), Ok(set));
        assert_eq!(set_camera(ROBOT, settings, false), Err(NO_CAMERA.into()));
        let dark = CameraSettings { exposure: -1.0, ..settings };
        let why = set_camera(ROBOT, dark, true).unwrap_err();
        assert!(why.starts_with("exposure: ") && why.lines().count() == 1, "{why}");
        let colour = ColourBox { y: (0, 255), u: (120, 110), v: (0, 255) };
        let table = ColourTable(BTreeMap::from([(ColourClass::Pink, colour)]));
        let why = set_colours(ROBOT, table, true).unwrap_err();
        assert!(why.starts_with("Pink.u: "), "{why}");
    }

    #[test]
    fn the_oldest_answer_is_forgotten() {
        let from = SocketAddr::from(([127, 0, 0, 1], 1));
        let mut answered = Answered::default();
        for number in 0..=REMEMBERED as u32 {
            answered.remember(from, ROBOT, OrderAnswer { number, outcome: Ok(()) });
        }
        assert_eq!(answered.find(from, ROBOT, 0), None);
        assert!(answered.find(from, ROBOT, 1).is_some());
        assert_eq!(answered.find(from, RobotId::new(Team::Away, 1), 1), None);
    }
}
