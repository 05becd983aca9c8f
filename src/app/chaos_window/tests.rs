//! ChaosManager's window under a person's hands, without a window and without a network.

use bevy_egui::egui::{Modifiers, PointerButton, vec2};

use super::desk::{ChaosDesk, KnownMatch};
use super::robot::RobotElsewhere;
use crate::app::inspector::vision::hand::{DrawnFrame, Hand, click};
use crate::app::inspector::vision::samples;
use crate::data::AssetFolder;
use crate::game::net::chaos::{CameraData, ChaosNews, ImageData, Instruction, LinkFigures};
use crate::game::{Choice, MatchPlan};
use crate::ids::{RobotId, Team};
use crate::vision::{ColourClass, ColourTable, Gaze};

const ROBOT: RobotId = RobotId::new(Team::Home, 1);

/// A desk on a robot that has sent a picture, and knows nothing of the ball's colour.
struct ManagedRobot {
    hand: Hand,
    desk: ChaosDesk,
    sent: Vec<Instruction>,
}

impl ManagedRobot {
    fn new() -> ManagedRobot {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let choice = Choice { file: Some("four_legged_2005".into()), ..Choice::default() };
        let plan = MatchPlan::read(&assets, &choice).expect("a shipped match");
        let mut robot = RobotElsewhere::new(ROBOT);
        let mut calibration = samples::calibration();
        calibration.colours.0.remove(&ColourClass::Orange);
        robot.hear(ChaosNews::Camera(CameraData { tick: 1, calibration }));
        let image = ImageData::of(&samples::hall().0, Gaze::default(), 1, 1);
        robot.hear(ChaosNews::Image(image));
        let desk = ChaosDesk::new(robot, assets, Some(KnownMatch::of(&plan, ROBOT)));
        let hand = Hand::on(vec2(1280.0, 800.0));
        let mut looking = ManagedRobot { hand, desk, sent: Vec::new() };
        looking.frame(Vec::new());
        looking
    }

    fn frame(&mut self, events: Vec<bevy_egui::egui::Event>) -> DrawnFrame {
        let drawn = self.hand.frame(events, |ctx, _| {
            self.desk.show(ctx, (&LinkFigures::default(), Some("The match is silent for 3 s"), 1.0));
        });
        let sent = &mut self.sent;
        self.desk.robot.send(|instruction| {
            sent.push(instruction);
            sent.len() as u32
        });
        drawn
    }

    fn click(&mut self, at: bevy_egui::egui::Pos2) {
        for events in click(at, PointerButton::Primary, Modifiers::NONE) {
            self.frame(events);
        }
    }

    fn colours(&self) -> ColourTable {
        self.desk.robot.calibration().expect("the robot has said it").colours
    }
}

#[test]
fn a_click_on_a_picture_from_elsewhere_is_an_order_and_is_shown_until_it_is_answered() {
    let mut looking = ManagedRobot::new();
    let drawn = looking.frame(Vec::new());
    assert_eq!(drawn.pictures.len(), 3);
    drawn.place_of("The match is silent for 3 s");
    looking.click(drawn.pixel(0, 64, (30, 25)));
    let [Instruction::SetColours(colours)] = &looking.sent[..] else { panic!("{:?}", looking.sent) };
    assert!(colours.0.contains_key(&ColourClass::Orange));
    assert_eq!(looking.colours(), *colours);
    looking.desk.robot.hear(ChaosNews::Unanswered(1));
    assert!(!looking.colours().0.contains_key(&ColourClass::Orange));
}

#[test]
fn a_robot_is_driven_from_the_desk_only_while_it_is_taken_over() {
    let mut looking = ManagedRobot::new();
    assert_eq!(looking.desk.pilot(), None);
    let at = looking.frame(Vec::new()).place_of("Take over").center();
    looking.click(at);
    assert!(looking.desk.pilot().is_some());
    let at = looking.frame(Vec::new()).place_of("Hand back").center();
    looking.click(at);
    assert_eq!(looking.desk.pilot(), None);
}
