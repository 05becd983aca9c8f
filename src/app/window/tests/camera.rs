//! A person calibrates the camera of a robot that plays, by clicks on its pictures.

use bevy::prelude::Entity;
use egui::{Event, Modifiers, PointerButton, vec2};

use super::{LaidOutWindow, egui};
use crate::app::match_request::MatchRequest;
use crate::app::view::state::{Overlay, Overlays, Playback, Selected};
use crate::game::Choice;
use crate::game::requests::{Request, Requests, RobotChange};
use crate::geometry::{Pose, Sighting};
use crate::ids::RobotId;
use crate::robot::CalibratedCamera;
use crate::vision::{ColourBox, ColourClass, ColourTable};
use crate::world::ball::Ball;
use crate::world::sense::{ImageEyes, ImageMemory};

const SIZE: egui::Vec2 = vec2(1280.0, 800.0);
/// Ticks in which every camera takes a picture.
const PICTURE: u32 = 10;

/// A match of robots that see by pictures, and the one that is calibrated.
struct Calibrated {
    window: LaidOutWindow,
    robot: RobotId,
    entity: Entity,
}

impl Calibrated {
    /// The first robot that sees the ball near, with the match paused and its camera's panel open.
    fn sees_the_ball() -> Calibrated {
        let choice = Choice { file: Some("friendly_images".into()), seed: 3, ..Choice::default() };
        let mut window = LaidOutWindow::with(MatchRequest::Match(choice));
        let (robot, entity) = std::iter::repeat_with(|| {
            window.frame(SIZE, 1.0);
            let world = window.app.world_mut();
            let mut robots = world.query::<(Entity, &RobotId, &ImageMemory)>();
            let near = |memory: &ImageMemory| {
                memory.last().is_some_and(|last| last.recognised.ball.is_some_and(|ball| ball.range < 2.0))
            };
            let found = robots.iter(world).find(|(.., memory)| near(memory));
            found.map(|(entity, id, _)| (*id, entity))
        })
        .take(2000)
        .flatten()
        .next()
        .expect("some robot sees the ball");
        window.app.insert_resource(Playback { paused: true, ..Playback::default() });
        window.app.insert_resource(Selected(Some(robot)));
        window.app.insert_resource(Overlays::only([Overlay::Camera]));
        let mut calibrated = Calibrated { window, robot, entity };
        calibrated.play_a_picture();
        calibrated
    }

    fn get<T: bevy::prelude::Component>(&self) -> &T {
        self.window.app.world().get::<T>(self.entity).expect("the robot has it")
    }

    fn colours(&self) -> ColourTable {
        self.get::<CalibratedCamera>().0.colours.clone()
    }

    /// What the robot recognised as the ball in its last picture.
    fn ball(&self) -> Option<Sighting> {
        self.get::<ImageMemory>().last().and_then(|last| last.recognised.ball)
    }

    /// How far the ball truly is, m.
    fn true_range(&mut self) -> f32 {
        let robot = *self.get::<Pose>();
        let world = self.window.app.world_mut();
        let mut balls = world.query_filtered::<&Pose, bevy::prelude::With<Ball>>();
        let ball = balls.single(world).expect("there is one ball");
        robot.position.distance(ball.position)
    }

    fn ask(&mut self, change: RobotChange) {
        let robot = self.robot;
        self.window.app.world_mut().resource_mut::<Requests>().ask(Request::Robot(robot, change));
    }

    /// Plays until the camera has taken a picture with what was asked for.
    fn play_a_picture(&mut self) {
        self.window.app.world_mut().resource_mut::<Playback>().single_ticks += PICTURE;
        self.window.show(SIZE, 1.0);
    }

    /// Clicks the middle of a pixel in the image at the left.
    fn click(&mut self, (x, y): (usize, usize)) {
        let picture = self.window.frame(SIZE, 1.0).pictures[0];
        let scale = picture.width() / self.get::<ImageEyes>().image().width as f32;
        let pos = picture.min + scale * vec2(x as f32 + 0.5, y as f32 + 0.5);
        self.window.frame_with(SIZE, 1.0, vec![Event::PointerMoved(pos)]);
        for pressed in [true, false] {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            let event = Event::PointerButton { pos, button, pressed, modifiers };
            self.window.frame_with(SIZE, 1.0, vec![event]);
        }
        self.window.frame(SIZE, 1.0);
    }

    /// Pixels that truly show the ball, spread over it.
    fn pixels_of_the_ball(&self, count: usize) -> Vec<(usize, usize)> {
        let eyes = self.get::<ImageEyes>();
        let width = eyes.image().width;
        let truth = eyes.truth().enumerate();
        let places = truth.filter(|(_, class)| *class == Some(ColourClass::Orange));
        let all: Vec<_> = places.map(|(place, _)| (place % width, place / width)).collect();
        assert!(all.len() >= 4 * count, "the ball is only {} pixels", all.len());
        (0..count).map(|number| all[(2 * number + 1) * all.len() / (2 * count)]).collect()
    }
}

#[test]
fn a_spoilt_colour_table_loses_the_ball_and_ten_clicks_mend_it() {
    let mut camera = Calibrated::sees_the_ball();
    assert!(camera.ball().is_some());
    let mut spoilt = camera.colours();
    let nothing = ColourBox { y: (200, 255), u: (0, 20), v: (240, 255) };
    spoilt.0.insert(ColourClass::Orange, nothing);
    camera.ask(RobotChange::SetColours(spoilt.clone()));
    camera.play_a_picture();
    assert_eq!((camera.ball(), camera.colours()), (None, spoilt.clone()));
    for pixel in camera.pixels_of_the_ball(10) {
        camera.click(pixel);
    }
    let asked = camera.window.app.world().resource::<Requests>().iter().count();
    assert!((1..=10).contains(&asked), "{asked} requests wait for the next tick");
    camera.play_a_picture();
    assert_ne!(camera.colours(), spoilt);
    let (ball, truth) = (camera.ball().expect("it is seen again"), camera.true_range());
    assert!((ball.range - truth).abs() < 0.1 + 0.2 * truth, "{ball:?}, which is {truth} m away");
}
