//! What is known here of a robot elsewhere, and what is wanted of it. Pure.

use super::orders::OrderLine;
use crate::game::net::chaos::{CameraData, ChaosNews, DebugData, Instruction, Refusal, StrategyText};
use crate::ids::RobotId;
use crate::vision::{CameraCalibration, CameraSettings, ColourTable, Gaze, Image};

/// What is refused by a robot that sees without pictures when pictures are wanted.
const SUBSCRIPTION: &str = "subscription";

/// A robot elsewhere.
#[derive(Clone, Debug)]
pub struct RobotElsewhere {
    pub id: RobotId,
    /// Its last picture, and where the camera looked.
    pub picture: Option<(Image, Gaze)>,
    /// What it last said of itself.
    pub debug: Option<DebugData>,
    /// Whether it sees without pictures, so that only its data can be had.
    pub is_blind: bool,
    /// What became of the last order or file, and whether it went well.
    pub told: Option<(bool, String)>,
    in_force: Option<CameraCalibration>,
    settings: OrderLine<CameraSettings>,
    colours: OrderLine<ColourTable>,
    strategy: OrderLine<StrategyText>,
}

impl RobotElsewhere {
    /// One of which nothing is known yet.
    pub fn new(id: RobotId) -> RobotElsewhere {
        RobotElsewhere {
            id,
            picture: None,
            debug: None,
            is_blind: false,
            told: None,
            in_force: None,
            settings: OrderLine::default(),
            colours: OrderLine::default(),
            strategy: OrderLine::default(),
        }
    }

    /// The calibration of its camera, with what is wanted and not yet in force.
    pub fn calibration(&self) -> Option<CameraCalibration> {
        let in_force = self.in_force.as_ref()?;
        Some(CameraCalibration {
            settings: *self.settings.shown().unwrap_or(&in_force.settings),
            colours: self.colours.shown().unwrap_or(&in_force.colours).clone(),
            ..in_force.clone()
        })
    }

    /// Wants its camera set otherwise.
    pub fn set_camera(&mut self, settings: CameraSettings) {
        self.settings.want(settings);
    }

    /// Wants its pictures cut otherwise.
    pub fn set_colours(&mut self, colours: ColourTable) {
        self.colours.want(colours);
    }

    /// Wants its team to play a strategy.
    pub fn play(&mut self, strategy: StrategyText) {
        self.strategy.want(strategy);
    }

    /// Sends what is to be sent; `send` returns an order's number.
    pub fn send(&mut self, mut send: impl FnMut(Instruction) -> u32) {
        self.settings.send(|settings| send(Instruction::SetCamera(settings)));
        self.colours.send(|colours| send(Instruction::SetColours(colours)));
        self.strategy.send(|strategy| send(Instruction::PlayStrategy(strategy)));
    }

    /// Hears news of it.
    pub fn hear(&mut self, news: ChaosNews) {
        match news {
            ChaosNews::Image(data) => self.picture = Some((data.image(), data.gaze)),
            ChaosNews::Camera(CameraData { calibration, .. }) => self.in_force = Some(calibration),
            ChaosNews::Debug(data) => self.debug = Some(*data),
            ChaosNews::Accepted(number) => self.accept(number),
            ChaosNews::Refused(_, Refusal { what, .. }) if what == SUBSCRIPTION => self.is_blind = true,
            ChaosNews::Refused(number, refusal) => {
                self.give_up(number);
                let what = refusal.what;
                self.told = Some((false, format!("{} refuses the {what}: {}", self.id, refusal.why)));
            }
            ChaosNews::Unanswered(number) => {
                self.give_up(number);
                self.told = Some((false, format!("{} has not answered an order", self.id)));
            }
        }
    }

    fn accept(&mut self, number: u32) {
        if let Some(in_force) = &mut self.in_force {
            self.settings.answered(number).into_iter().for_each(|settings| in_force.settings = settings);
            self.colours.answered(number).into_iter().for_each(|colours| in_force.colours = colours);
        }
        if let Some(strategy) = self.strategy.answered(number) {
            self.told = Some((true, format!("{} plays {} from now on", self.id.team, strategy.name)));
        }
    }

    fn give_up(&mut self, number: u32) {
        self.settings.answered(number);
        self.colours.answered(number);
        self.strategy.answered(number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::inspector::vision::samples;
    use crate::game::net::chaos::{ChaosOrder, Subscription};
    use crate::ids::Team;

    const ROBOT: RobotId = RobotId::new(Team::Home, 1);

    /// A robot whose camera is known, and that wants two things of it.
    fn wanting() -> (RobotElsewhere, CameraSettings) {
        let mut robot = RobotElsewhere::new(ROBOT);
        assert_eq!(robot.calibration(), None);
        let calibration = samples::calibration();
        robot.hear(ChaosNews::Camera(CameraData { tick: 3, calibration }));
        let settings = CameraSettings { gain: 2.0, ..CameraSettings::default() };
        robot.set_camera(settings);
        robot.set_colours(ColourTable::default());
        let mut number = 0;
        robot.send(|_| {
            number += 1;
            number
        });
        assert_eq!(number, 2);
        (robot, settings)
    }

    #[test]
    fn what_is_wanted_is_shown_and_what_is_refused_is_not_any_more_and_told() {
        let (mut robot, settings) = wanting();
        let wanted =
            CameraCalibration { settings, colours: ColourTable::default(), ..samples::calibration() };
        assert_eq!(robot.calibration(), Some(wanted));
        robot.hear(ChaosNews::Accepted(1));
        let refusal = Refusal { what: "colour table".into(), why: "it has none".into() };
        robot.hear(ChaosNews::Refused(2, refusal));
        let left = CameraCalibration { settings, ..samples::calibration() };
        assert_eq!(robot.calibration(), Some(left));
        let told = "home 1 refuses the colour table: it has none";
        assert_eq!(robot.told, Some((false, told.to_owned())));
    }

    #[test]
    fn a_robot_that_refuses_pictures_sees_without_them() {
        let mut robot = RobotElsewhere::new(ROBOT);
        let subscribe = Instruction::Subscribe(Subscription { images_hz: 1.0, data_hz: 1.0 });
        let what = ChaosOrder { number: 1, instruction: subscribe }.what().to_owned();
        robot.hear(ChaosNews::Refused(1, Refusal { what, why: "it has no camera".into() }));
        assert!(robot.is_blind && robot.told.is_none());
    }

    #[test]
    fn an_order_that_nobody_answers_is_given_up_and_told() {
        let (mut robot, settings) = wanting();
        robot.hear(ChaosNews::Unanswered(1));
        assert_eq!(robot.calibration().map(|it| it.settings), Some(CameraSettings::default()));
        assert_ne!(settings, CameraSettings::default());
        assert_eq!(robot.told, Some((false, "home 1 has not answered an order".into())));
    }
}
