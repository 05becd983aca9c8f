//! What ChaosManager and robots say to each other, as data of the TCM (TeamChaos, section 1): it receives images and data, refines
//! camera parameters, reconfigures the running camera and teleoperates.

use bevy::math::Vec2;
use serde::{Deserialize, Serialize};

use super::table::data_types::{
    ANSWER, CAMERA, DEBUG, IMAGE, SET_CAMERA, SET_COLOURS, STRATEGY, SUBSCRIBE, TELEOPERATE,
};
use crate::comms::tcm::{Data, Module, data};
use crate::data::Validate;
use crate::geometry::Pose;
use crate::robot::pilot::Pilot;
use crate::robot::{HeadIntent, KickIntent, SteeringIntent};
use crate::vision::{CameraCalibration, CameraSettings, ColourTable, Gaze, Image, Quality, Yuv};

/// A picture as the robot's camera gave it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageData {
    /// Counts the pictures for this receiver from 1: a number that is missing is a picture that did not arrive.
    pub number: u32,
    /// The tick in which it was taken.
    pub tick: u64,
    /// Pixels.
    pub width: u16,
    /// Pixels.
    pub height: u16,
    /// Where the camera looked.
    pub gaze: Gaze,
    /// Y, U and V of each pixel, row by row from the top.
    pub pixels: Vec<u8>,
}

/// How the robot's camera is calibrated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraData {
    /// The tick in which it was so.
    pub tick: u64,
    /// The calibration.
    pub calibration: CameraCalibration,
}

/// What a robot believes, is in, and wants.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DebugData {
    /// Counts these data for this receiver from 1.
    pub number: u32,
    /// The tick in which it was so.
    pub tick: u64,
    /// Where it believes itself to be, in the team frame.
    pub pose: Pose,
    /// Whether it knows where it is.
    pub is_localised: bool,
    /// What it believes of the ball.
    pub ball: Option<BallData>,
    /// Its role.
    pub role: String,
    /// The role that it acts in.
    pub acting_as: String,
    /// The composite states that it is in, the outermost first, and its own state.
    pub states: Vec<String>,
    /// Where it wants to go.
    pub steering: SteeringIntent,
    /// What it wants to do to the ball.
    pub kick: KickIntent,
    /// Where it wants to look.
    pub head: HeadIntent,
    /// Whether a person drives it.
    pub is_driven: bool,
    /// How well the colours of its last picture were told, if it sees by pictures. The match knows what they show; the robot does
    /// not.
    pub quality: Option<Quality>,
}

/// A ball that a robot believes in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BallData {
    /// m in the team frame.
    pub position: Vec2,
    /// m/s in the team frame.
    pub velocity: Vec2,
    /// How long ago it was seen, s.
    pub age: f32,
}

/// What a computer asks of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct ChaosOrder {
    /// The sender's number of this order; an order that comes again is the same.
    pub number: u32,
    /// What is asked.
    pub instruction: Instruction,
}

/// What a computer may ask of a robot.
#[derive(Clone, Debug, PartialEq)]
pub enum Instruction {
    /// Send pictures and data for some seconds from now on.
    Subscribe(Subscription),
    /// Set the running camera otherwise.
    SetCamera(CameraSettings),
    /// Cut colours by other thresholds.
    SetColours(ColourTable),
    /// The robot's team plays this strategy from now on.
    PlayStrategy(StrategyText),
    /// A person drives the robot for a moment from now on; without controls its strategy takes it back.
    Teleoperate(Option<Pilot>),
}

/// How often something is wanted. 0 is never.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Subscription {
    /// Pictures a second, at most as many as the camera takes.
    pub images_hz: f32,
    /// Data a second.
    pub data_hz: f32,
}

/// A strategy's file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct StrategyText {
    /// The name of the file, by which faults in it are told.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// What became of an order.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OrderAnswer {
    /// The order's number.
    pub number: u32,
    /// Whether it is carried out.
    pub outcome: Result<(), Refusal>,
}

/// Why an order is not carried out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refusal {
    /// What was ordered, such as `strategy`.
    pub what: String,
    /// A line that says what is wrong; of a file with line and field.
    pub why: String,
}

impl ImageData {
    /// A picture for a receiver.
    pub fn of(image: &Image, gaze: Gaze, tick: u64, number: u32) -> ImageData {
        let side = |pixels: usize| u16::try_from(pixels).unwrap_or(u16::MAX);
        let pixels = image.pixels.iter().flat_map(|pixel| [pixel.y, pixel.u, pixel.v]).collect();
        ImageData { number, tick, width: side(image.width), height: side(image.height), gaze, pixels }
    }

    /// The picture.
    pub fn image(&self) -> Image {
        let (whole, _) = self.pixels.as_chunks();
        Image {
            width: self.width.into(),
            height: self.height.into(),
            pixels: whole.iter().map(|&[y, u, v]| Yuv { y, u, v }).collect(),
        }
    }

    fn is_sound(&self) -> bool {
        let pixels = usize::from(self.width) * usize::from(self.height);
        self.pixels.len() == 3 * pixels && self.gaze.pan.is_finite() && self.gaze.tilt.is_finite()
    }
}

impl DebugData {
    fn is_sound(&self) -> bool {
        self.pose.is_finite()
            && self.ball.is_none_or(|ball| {
                ball.position.is_finite() && ball.velocity.is_finite() && ball.age.is_finite()
            })
            && self.steering.is_finite()
            && self.head.is_finite()
    }
}

impl Subscription {
    /// More often than this nothing is sent.
    pub const MOST_HZ: f32 = 60.0;

    fn is_sound(&self) -> bool {
        [self.images_hz, self.data_hz].into_iter().all(|hz| (0.0..=Subscription::MOST_HZ).contains(&hz))
    }
}

impl ChaosOrder {
    /// Whether the sender is told what became of it in any case, and not only that it was refused.
    pub fn is_answered(&self) -> bool {
        !matches!(self.instruction, Instruction::Subscribe(_) | Instruction::Teleoperate(Some(_)))
    }

    /// What is ordered, in a word.
    pub fn what(&self) -> &'static str {
        self.serialise().0.name
    }
}

/// Whether they make sense is told to who sent them; what is no number is no setting.
fn has_finite_settings((_, settings): &(u32, CameraSettings)) -> bool {
    let CameraSettings { exposure, gain, white_balance, frame_hz, .. } = settings;
    [*exposure, *gain, white_balance.red, white_balance.blue, *frame_hz].into_iter().all(f32::is_finite)
}

fn is_sound_pilot((_, pilot): &(u32, Option<Pilot>)) -> bool {
    pilot.is_none_or(|pilot| {
        let levers = [pilot.throttle, pilot.aside, pilot.turn, pilot.head.unwrap_or(0.0)];
        levers.into_iter().all(f32::is_finite)
    })
}

data!(ImageData { IMAGE, "image", Module::CHAOS_MANAGER, Routine; (it) = it: ImageData, if ImageData::is_sound; });
data!(CameraData {
    CAMERA, "camera", Module::CHAOS_MANAGER, Routine; (it) = it: CameraData,
        if |it: &CameraData| it.calibration.validate().is_ok();
});
data!(DebugData { DEBUG, "debug data", Module::CHAOS_MANAGER, Routine; (it) = it: DebugData, if DebugData::is_sound; });
data!(OrderAnswer { ANSWER, "answer", Module::CHAOS_MANAGER, Urgent; (it) = it: OrderAnswer; });
data!(ChaosOrder {
    SUBSCRIBE, "subscription", Module::CHAOS_MANAGER, Urgent;
        (ChaosOrder { number, instruction: Instruction::Subscribe(subscription) })
        = (number, subscription): (u32, Subscription), if |(_, it): &(u32, Subscription)| it.is_sound();
    SET_CAMERA, "camera settings", Module::CHAOS_MANAGER, Urgent;
        (ChaosOrder { number, instruction: Instruction::SetCamera(settings) })
        = (number, settings): (u32, CameraSettings), if has_finite_settings;
    SET_COLOURS, "colour table", Module::CHAOS_MANAGER, Urgent;
        (ChaosOrder { number, instruction: Instruction::SetColours(colours) })
        = (number, colours): (u32, ColourTable);
    STRATEGY, "strategy", Module::CHAOS_MANAGER, Urgent;
        (ChaosOrder { number, instruction: Instruction::PlayStrategy(strategy) })
        = (number, strategy): (u32, StrategyText);
    TELEOPERATE, "teleoperation", Module::CHAOS_MANAGER, Urgent;
        (ChaosOrder { number, instruction: Instruction::Teleoperate(pilot) })
        = (number, pilot): (u32, Option<Pilot>), if is_sound_pilot;
});

#[cfg(test)]
mod tests;
