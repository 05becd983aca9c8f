//! What a picture of a robot's camera costs: an AIBO's on the four-legged pitch, with all robots there, on one core.

use bevy::math::Vec2;
use criterion::{Criterion, criterion_group, criterion_main};
use touchline::data::{AssetFolder, AssetKind, Source};
use touchline::game::{Choice, MatchPlan};
use touchline::geometry::{Pose, angle};
use touchline::ids::{RobotId, Team};
use touchline::rng::{Dice, Seed};
use touchline::robot::RobotKind;
use touchline::vision::{CameraFlaws, CameraSettings, Gaze, Optics, Resolution};
use touchline::world::sense::picture::{Canvas, Hall, Light, Lighting, Moment, Shot};
use touchline::world::sense::sway::Sway;

const NOSE: Optics =
    Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 10.0, nod: 40.0 };

/// Everybody near the ball, as in the thick of play.
fn crowd(kind: &RobotKind) -> Moment {
    let mut moment = Moment::default();
    moment.ball = Some(Vec2::new(0.05, 0.1));
    for team in Team::BOTH {
        for number in 0..4 {
            let side = team.index() as f32 * 2.0 - 1.0;
            let at = Vec2::new(side * (0.3 + 0.4 * f32::from(number)), 0.25 * f32::from(number) * side);
            let pose = Pose { position: at, heading: angle(at) + 3.0 };
            moment.add(RobotId::new(team, number), kind, pose, 0.3, None);
        }
    }
    moment
}

fn pictures(criterion: &mut Criterion) {
    let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
    let choice = Choice { file: Some("four_legged_2005".into()), ..Choice::default() };
    let plan = MatchPlan::read(&assets, &choice).unwrap_or_else(|error| panic!("{error}"));
    let kind = Source::read(assets.file(AssetKind::Robot, "aibo_ers7"))
        .and_then(|source| source.parse::<RobotKind>());
    let kind = kind.unwrap_or_else(|error| panic!("{error}"));
    let (hall, moment, light) =
        (Hall::of(&plan.pitch, &plan.ball), crowd(&kind), Light::new(Lighting::default()));
    let mut canvas = Canvas::default();
    let mut dice = Dice::new(Seed(1), "pictures", None);
    let resolutions = [Resolution::Full, Resolution::Half, Resolution::Quarter];
    for (name, from, turn_rate) in [
        ("the crowd", Pose::new(-1.1, -0.5, 0.35), 0.0),
        ("an empty corner", Pose::new(1.6, 1.0, 0.6), 0.0),
        ("the crowd in a turn", Pose::new(-1.1, -0.5, 0.35), 5.0),
    ] {
        for resolution in resolutions {
            let shot = Shot {
                robot: RobotId::new(Team::Home, 2),
                from,
                gaze: Gaze { pan: 0.0, tilt: 0.17 },
                sway: Sway { roll: 0.02, ..Sway::default() },
                optics: NOSE,
                flaws: CameraFlaws { distortion: (-0.147, 0.385), read_out: 0.033, ..CameraFlaws::default() },
                settings: CameraSettings { resolution, ..CameraSettings::default() },
                turn_rate,
                hides_ball: false,
            };
            let (width, height) = shot.size();
            criterion.bench_function(&format!("{name}, {width} x {height}"), |bencher| {
                bencher.iter(|| canvas.draw(&hall, &moment, &shot, &light, &mut dice));
            });
        }
    }
    criterion.bench_function("the moment for all cameras", |bencher| bencher.iter(|| crowd(&kind)));
}

criterion_group!(benches, pictures);
criterion_main!(benches);
