//! What must hold of any picture.

use touchline::data::{AssetKind, Source};
use touchline::game::{Choice, MatchPlan};
use touchline::vision::paint::RobotPaint;
use touchline::vision::{
    CameraCalibration, ColourClass, ColourLookup, Gaze, Image, KnownObjects, MOST_BLOBS, Segmenter, Yuv,
    recognise,
};

use super::shipped::shipped;

/// Any picture is cut into patches that lie in it, and what is recognised is at a place. The input is the picture's width, where the
/// camera looks, and its pixels, the larger half of all bytes as colours of things.
pub fn picture(input: &[u8]) {
    let [width, pan, tilt, pixels @ ..] = input else { return };
    let width = usize::from(*width).max(1);
    let height = pixels.len() / width;
    let camera: CameraCalibration = {
        let file = shipped().file(AssetKind::Camera, "aibo_ers7");
        Source::read(file).and_then(|source| source.parse_sound()).expect("the shipped camera is sound")
    };
    let colours: Vec<Yuv> = ColourClass::ALL.into_iter().filter_map(|class| middle(&camera, class)).collect();
    let pixel = |byte: &u8| match usize::from(*byte).checked_sub(128) {
        Some(class) => colours[class % colours.len()],
        None => Yuv { y: byte * 2, u: byte.wrapping_mul(37), v: byte.wrapping_mul(101) },
    };
    let pixels: Vec<Yuv> = pixels[..width * height].iter().map(pixel).collect();
    let image = Image { width, height, pixels };
    let (lookup, mut segmenter) = (ColourLookup::new(&camera.colours), Segmenter::default());
    let segmented = segmenter.segment(&image, &lookup);
    assert!(segmented.blobs.len() <= MOST_BLOBS && segmented.classes.len() == width * height);
    for blob in segmented.blobs {
        assert!(blob.bounds.right < width && blob.bounds.bottom < height, "{blob:?}");
        assert!(
            blob.area <= blob.bounds.width() * blob.bounds.height() && blob.centroid.is_finite(),
            "{blob:?}"
        );
    }
    let angle = |byte: u8| (f32::from(byte) - 128.0) / 80.0;
    let gaze = Gaze { pan: angle(*pan), tilt: angle(*tilt) };
    let plan =
        MatchPlan::read(&shipped(), &Choice { file: Some("four_legged_2005".into()), ..Choice::default() });
    let plan = plan.expect("the shipped match is sound");
    let known = KnownObjects::new(&plan.pitch, &plan.ball, [RobotPaint::WALKER; 2]);
    let seen = recognise(segmented, &camera.optics, gaze, &known);
    let robots = seen.robots.iter().map(|(_, sighting)| sighting);
    let landmarks = seen.landmarks.iter().map(|landmark| &landmark.sighting);
    for sighting in seen.ball.iter().chain(robots).chain(landmarks) {
        assert!(
            sighting.range.is_finite() && sighting.range >= 0.0 && sighting.bearing.is_finite(),
            "{sighting:?}"
        );
    }
}

/// A colour that the camera takes for this class.
fn middle(camera: &CameraCalibration, class: ColourClass) -> Option<Yuv> {
    let colour = camera.colours.0.get(&class)?;
    let middle = |(least, most): (u8, u8)| least / 2 + most / 2;
    Some(Yuv { y: middle(colour.y), u: middle(colour.u), v: middle(colour.v) })
}
