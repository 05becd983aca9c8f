//! Pictures and a calibration made by hand, to try the panel on.

use crate::data::AssetFolder;
use crate::game::{Choice, MatchPlan};
use crate::vision::paint::RobotPaint;
use crate::vision::{
    CameraCalibration, CameraFlaws, CameraSettings, ColourBox, ColourClass, ColourTable, Image, KnownObjects,
    Optics, Yuv,
};

/// A calibration that cuts [`hall`] right.
pub fn calibration() -> CameraCalibration {
    let optics = Optics { width: 64, height: 48, field_of_view: 60.0, mount: 0.3, tilt: 10.0, nod: 30.0 };
    let colours = [ColourClass::Orange, ColourClass::Green].map(|class| (class, around(paint(class))));
    CameraCalibration {
        name: "By hand".into(),
        optics,
        flaws: CameraFlaws::default(),
        settings: CameraSettings::default(),
        colours: ColourTable(colours.into()),
    }
}

/// The colour in which a class is painted by hand, in the least bright of its shades.
pub fn paint(class: ColourClass) -> Yuv {
    match class {
        ColourClass::Orange => Yuv { y: 120, u: 60, v: 190 },
        _ => Yuv { y: 70, u: 110, v: 100 },
    }
}

/// What lies about in a four-legged match.
pub fn known() -> KnownObjects {
    let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
    let choice = Choice { file: Some("four_legged_2005".into()), ..Choice::default() };
    let plan = MatchPlan::read(&assets, &choice).expect("a shipped match");
    KnownObjects::new(&plan.pitch, &plan.ball, [RobotPaint::WALKER; 2])
}

fn around(Yuv { y, u, v }: Yuv) -> ColourBox {
    ColourBox { y: (y - 5, y + 25), u: (u - 5, u + 15), v: (v - 15, v + 5) }
}

/// A ball of 12 by 12 pixels on a carpet, and the class of each pixel.
pub fn hall() -> (Image, Vec<Option<ColourClass>>) {
    let mut image = Image::new(64, 48);
    let class_at = |x: usize, y: usize| {
        let is_ball = (26..38).contains(&x) && (20..32).contains(&y);
        if is_ball { ColourClass::Orange } else { ColourClass::Green }
    };
    let places = (0..48).flat_map(|y| (0..64).map(move |x| (x, y)));
    let truth: Vec<_> = places.map(|(x, y)| class_at(x, y)).collect();
    for (place, (pixel, class)) in image.pixels.iter_mut().zip(&truth).enumerate() {
        let shade = (place / 64 / 3 % 5) as u8;
        let Yuv { y, u, v } = paint(*class);
        *pixel = Yuv { y: y + 4 * shade, u: u + 2 * shade, v: v - 2 * shade };
    }
    (image, truth.into_iter().map(Some).collect())
}
