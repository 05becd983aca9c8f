//! Writes what each robot's camera sees at a moment of a match, as PPM files: `cargo run --example camera_picture -- 20 pictures`.
//!
//! The first word is the time in seconds, the second a folder; a third one is a match file among the assets.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::ExitCode;

use bevy::prelude::*;
use touchline::data::{AssetFolder, AssetKind, Source};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::geometry::Pose;
use touchline::ids::RobotId;
use touchline::rng::{Dice, Seed};
use touchline::robot::{Head, OffPitch, Robot, Trailer};
use touchline::vision::{CameraCalibration, Gaze, Image};
use touchline::world::ball::Ball;
use touchline::world::sense::picture::{Canvas, Hall, Light, Lighting, Moment, Shot};
use touchline::world::sense::sway::{MountError, Stride, Sway};

fn main() -> ExitCode {
    match write_pictures(std::env::args().skip(1).collect()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn write_pictures(words: Vec<String>) -> Result<(), Box<dyn std::error::Error>> {
    let word = |index: usize| words.get(index).cloned();
    let seconds: f64 = word(0).as_deref().unwrap_or("20").parse()?;
    let folder = word(1).unwrap_or_else(|| "pictures".into());
    let assets = AssetFolder::find(None)?;
    let plan = MatchPlan::read(&assets, &Choice { file: word(2), ..Choice::default() })?;
    let mut game = Match::new(&plan);
    while game.clock().now() < seconds && !game.is_over() {
        game.tick();
    }
    fs::create_dir_all(&folder)?;
    let hall = Hall::of(&plan.pitch, &plan.ball);
    let (moment, watching) = observed(game.world_mut());
    let mut canvas = Canvas::default();
    for (robot, from, pan, walks) in watching {
        let camera = assets.file(AssetKind::Camera, if walks { "aibo_ers7" } else { "cye_2001" });
        let CameraCalibration { optics, flaws, settings, .. } = Source::read(camera)?.parse()?;
        let gaze = Gaze { pan, tilt: optics.tilt.to_radians() };
        let mut dice = Dice::new(Seed(plan.seed), "pictures", Some(robot));
        let stride = Stride { phase: dice.uniform(), effort: 0.5 };
        let sway = Sway::of(&flaws, stride, MountError::drawn(&flaws.play, &mut dice), pan);
        let (turn_rate, hides_ball) = (0.0, false);
        let shot = Shot { robot, from, gaze, sway, optics, flaws, settings, turn_rate, hides_ball };
        canvas.draw(&hall, &moment, &shot, &Light::new(Lighting::default()), &mut dice);
        let path = Path::new(&folder).join(format!("{}_{}.ppm", robot.team, robot.number));
        write_ppm(&path, canvas.image())?;
        println!("{}", path.display());
    }
    Ok(())
}

type Watching = Vec<(RobotId, Pose, f32, bool)>;

/// What cameras may see, and where each is.
fn observed(world: &mut World) -> (Moment, Watching) {
    let trailers: Vec<(RobotId, Pose)> =
        world.query::<(&Trailer, &Pose)>().iter(world).map(|(trailer, pose)| (trailer.of, *pose)).collect();
    let mut moment = Moment::default();
    let mut watching = Watching::new();
    let mut robots = world.query_filtered::<(&RobotId, &Robot, &Pose, &Head), Without<OffPitch>>();
    for (&id, robot, &pose, head) in robots.iter(world) {
        let trailer = trailers.iter().find(|(of, _)| *of == id).map(|(_, pose)| *pose);
        moment.add(id, &robot.kind, pose, head.pan, trailer);
        watching.push((id, pose, head.pan, robot.kind.neck.is_some()));
    }
    moment.ball = world.query_filtered::<&Pose, With<Ball>>().iter(world).next().map(|pose| pose.position);
    (moment, watching)
}

fn write_ppm(path: &Path, image: &Image) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    write!(file, "P6\n{} {}\n255\n", image.width, image.height)?;
    image.pixels.iter().try_for_each(|pixel| file.write_all(&pixel.to_rgb()))?;
    file.flush()
}
