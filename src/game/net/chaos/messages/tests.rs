use proptest::prelude::*;

use super::*;
use crate::comms::tcm::DataType;
use crate::vision::{CameraFlaws, ColourBox, ColourClass, Optics};

const OPTICS: Optics =
    Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 10.0, nod: 40.0 };

fn back<T: Data>(data: &T) -> Option<T> {
    let (known, bytes) = data.serialise();
    T::unserialise(known.number, &bytes)
}

fn order(instruction: Instruction) -> ChaosOrder {
    ChaosOrder { number: 300, instruction }
}

fn colours() -> ColourTable {
    let orange = ColourBox { y: (80, 200), u: (40, 110), v: (160, 230) };
    ColourTable([(ColourClass::Orange, orange), (ColourClass::Green, orange)].into())
}

fn debug_data() -> DebugData {
    DebugData {
        number: 7,
        tick: 300,
        pose: Pose::new(1.5, -0.25, 0.5),
        is_localised: true,
        ball: Some(BallData { position: Vec2::X, velocity: Vec2::Y, age: 0.5 }),
        role: "halfback".into(),
        acting_as: "attacker".into(),
        states: vec!["play".into(), "acquire".into()],
        steering: SteeringIntent::Steer { heading: 0.5, facing: 0.25, speed: 1.0 },
        kick: KickIntent::Kick(2),
        head: HeadIntent { pan: 0.5, speed: 1.0 },
        is_driven: false,
        quality: Some(Quality::of(&[Some(ColourClass::Orange), None], &[Some(ColourClass::Green), None])),
    }
}

/// The examples of `docs/tcm.md`.
#[test]
fn orders_and_answers_have_these_bytes() {
    let pilot = Pilot { throttle: 1.0, turn: -0.5, head: Some(0.25), kick: KickIntent::Kick(2), aside: 0.0 };
    let subscription = Subscription { images_hz: 10.0, data_hz: 0.0 };
    let refusal = Refusal { what: "strategy".into(), why: "no".into() };
    #[rustfmt::skip]
    let golden: [(Vec<u8>, &[u8]); 5] = [
        (order(Instruction::Subscribe(subscription)).serialise().1, &[
            0xAC, 0x02,             // order 300
            0x00, 0x00, 0x20, 0x41, // 10 pictures a second
            0x00, 0x00, 0x00, 0x00, // no data
        ]),
        (order(Instruction::Teleoperate(Some(pilot))).serialise().1, &[
            0xAC, 0x02,
            0x01,                   // controls
            0x00, 0x00, 0x80, 0x3F, // throttle: 1
            0x00, 0x00, 0x00, 0x00, // aside: 0
            0x00, 0x00, 0x00, 0xBF, // turn: -0.5
            0x01, 0x00, 0x00, 0x80, 0x3E, // head: 0.25
            0x02, 0x02,             // kick 2
        ]),
        (order(Instruction::Teleoperate(None)).serialise().1, &[0xAC, 0x02, 0x00]),
        (OrderAnswer { number: 300, outcome: Ok(()) }.serialise().1, &[0xAC, 0x02, 0x00]),
        (OrderAnswer { number: 1, outcome: Err(refusal) }.serialise().1, b"\x01\x01\x08strategy\x02no"),
    ];
    for (bytes, expected) in golden {
        assert_eq!(bytes, expected);
    }
}

/// The example of `docs/tcm.md`.
#[test]
fn a_picture_has_these_bytes() {
    let image =
        Image { width: 2, height: 1, pixels: vec![Yuv { y: 1, u: 2, v: 3 }, Yuv { y: 4, u: 5, v: 6 }] };
    let data = ImageData::of(&image, Gaze { pan: 0.5, tilt: -0.25 }, 300, 1);
    let (known, bytes) = data.serialise();
    assert_eq!(known.number, DataType(22));
    #[rustfmt::skip]
    assert_eq!(bytes, [
        0x01,                   // picture 1
        0xAC, 0x02,             // of tick 300
        0x02, 0x01,             // of 2 x 1 pixels
        0x00, 0x00, 0x00, 0x3F, // pan: 0.5
        0x00, 0x00, 0x80, 0xBE, // tilt: -0.25
        0x06, 1, 2, 3, 4, 5, 6, // six bytes
    ]);
    assert_eq!(back(&data).map(|data| data.image()), Some(image));
}

#[test]
fn everything_comes_back_as_it_was() {
    let calibration = CameraCalibration {
        name: "hall".into(),
        optics: OPTICS,
        flaws: CameraFlaws { read_out: 0.033, ..CameraFlaws::default() },
        settings: CameraSettings::default(),
        colours: colours(),
    };
    let camera = CameraData { tick: 9, calibration };
    assert_eq!(back(&camera), Some(camera.clone()));
    assert_eq!(back(&debug_data()), Some(debug_data()));
    for instruction in [
        Instruction::Subscribe(Subscription { images_hz: 30.0, data_hz: 5.0 }),
        Instruction::SetCamera(CameraSettings::default()),
        Instruction::SetColours(colours()),
        Instruction::PlayStrategy(StrategyText { name: "mine.ron".into(), text: "(".repeat(100_000) }),
        Instruction::Teleoperate(None),
    ] {
        let order = order(instruction);
        assert_eq!(back(&order), Some(order));
    }
}

#[test]
fn what_makes_no_sense_is_not_read() {
    let image = ImageData::of(&Image::new(4, 3), Gaze::default(), 0, 1);
    assert_eq!(back(&ImageData { width: 5, ..image.clone() }), None);
    assert_eq!(back(&ImageData { gaze: Gaze { pan: f32::NAN, tilt: 0.0 }, ..image }), None);
    let lost = Pose { heading: f32::INFINITY, ..Pose::default() };
    assert_eq!(back(&DebugData { pose: lost, ..debug_data() }), None);
    for hz in [-1.0, 61.0, f32::NAN] {
        let subscription = Subscription { images_hz: hz, data_hz: 1.0 };
        assert_eq!(back(&order(Instruction::Subscribe(subscription))), None);
    }
    let wild = Pilot { turn: f32::NAN, ..Pilot::default() };
    assert_eq!(back(&order(Instruction::Teleoperate(Some(wild)))), None);
}

proptest! {
    #[test]
    fn any_picture_comes_back(width in 0usize..30, height in 0usize..30, seed: u8, number: u32, tick: u64) {
        let pixels = (0..width * height).map(|place| {
            let value = (place as u8).wrapping_mul(31).wrapping_add(seed);
            Yuv { y: value, u: value.wrapping_add(1), v: value.wrapping_mul(3) }
        });
        let image = Image { width, height, pixels: pixels.collect() };
        let data = ImageData::of(&image, Gaze::default(), tick, number);
        let again = back(&data);
        prop_assert_eq!(again.as_ref().map(ImageData::image), Some(image));
        prop_assert_eq!(again, Some(data));
    }
}
