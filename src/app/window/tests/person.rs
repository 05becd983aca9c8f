//! A match of a person who drives, drags, jams and changes a strategy's file, played again from its recording.
//!
//! One such recording is kept in `tests/golden/person.replay`, which any build of the program plays again. Where play is meant to
//! change, this writes it anew: `INSTA_UPDATE=always cargo test --lib a_match_of_a_person`.

use std::path::Path;

use bevy::input::ButtonState;
use bevy::input::mouse::MouseButtonInput;
use bevy::prelude::*;
use egui::{Event, Modifiers, PointerButton, Pos2};

use super::rewind::SIZE;
use super::{LaidOutWindow, egui};
use crate::app::match_request::MatchRequest;
use crate::app::view::picture::camera::PitchCamera;
use crate::app::view::state::{Folder, PendingMatch, Piloted};
use crate::app::view::time::recording::Recording;
use crate::data::{AssetFolder, AssetKind};
use crate::game::requests::{BodyChange, RadioChange, Request};
use crate::game::{Choice, Match, MatchPlan};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::lab::replay::{Comparison, Replay};
use crate::world::ball::Ball;

const MINE: RobotId = RobotId::new(Team::Home, 1);
const OTHER: RobotId = RobotId::new(Team::Away, 2);
const FIXTURE: &str = "tests/golden/person.replay";

/// Whether a request is what a person has done.
type IsDeed = fn(&Request) -> bool;

/// What a person needs to write the file of their strategy: where it is, and another speed in it.
struct OwnStrategy {
    path: std::path::PathBuf,
    text: String,
}

impl OwnStrategy {
    fn in_folder(folder: &Path, assets: &AssetFolder) -> OwnStrategy {
        let shipped = assets.file(AssetKind::Strategy, "hammerheads_2001");
        let text = std::fs::read_to_string(shipped).expect("it is shipped");
        let own = OwnStrategy { path: folder.join("mine.ron"), text };
        own.save(&own.text);
        own
    }

    fn save(&self, text: &str) {
        std::fs::write(&self.path, text).expect("the folder is there");
    }
}

impl LaidOutWindow {
    /// Presses the left button of the mouse at a place or lets it go, as the pitch and the panels hear of it.
    fn mouse(&mut self, pos: Pos2, pressed: bool) {
        let state = if pressed { ButtonState::Pressed } else { ButtonState::Released };
        let button = MouseButtonInput { button: MouseButton::Left, state, window: Entity::PLACEHOLDER };
        self.app.world_mut().write_message(button);
        let button = PointerButton::Primary;
        let event = Event::PointerButton { pos, button, pressed, modifiers: Modifiers::SHIFT };
        self.frame_with(SIZE, 1.0, vec![event]);
    }

    /// With Shift, carries what is at one place of the pitch to another.
    fn carry(&mut self, from: Vec2, to: Vec2) {
        let camera = *self.app.world().resource::<PitchCamera>();
        let [from, to] = [from, to].map(|place| camera.to_screen(place));
        self.key(KeyCode::ShiftLeft, "", ButtonState::Pressed);
        self.frame_with(SIZE, 1.0, vec![Event::PointerMoved(from)]);
        self.mouse(from, true);
        for at in [from.lerp(to, 0.5), to] {
            self.frame_with(SIZE, 1.0, vec![Event::PointerMoved(at)]);
            self.frame(SIZE, 1.0);
        }
        self.mouse(to, false);
        self.key(KeyCode::ShiftLeft, "", ButtonState::Released);
        self.frame_with(SIZE, 1.0, vec![Event::PointerGone]);
    }

    fn place_of_robot(&mut self, robot: RobotId) -> Vec2 {
        let mut robots = self.app.world_mut().query::<(&RobotId, &Pose)>();
        let found = robots.iter(self.app.world()).find(|(id, _)| **id == robot);
        found.expect("it plays").1.position
    }

    fn place_of_ball(&mut self) -> Vec2 {
        let mut balls = self.app.world_mut().query_filtered::<&Pose, With<Ball>>();
        balls.single(self.app.world()).expect("there is one ball").position
    }

    fn hold(&mut self, key: KeyCode, writes: &str, until: u64) {
        self.key(key, writes, ButtonState::Pressed);
        self.play_to(until);
        self.key(key, writes, ButtonState::Released);
    }
}

/// A person plays for ten seconds; what is recorded is asked for by keys, by the mouse and by a file that changes.
fn play(window: &mut LaidOutWindow, own: &OwnStrategy) {
    window.play_to(60);
    window.select(MINE);
    window.press(KeyCode::KeyH, "h");
    assert_eq!(*window.app.world().resource::<Piloted>(), Piloted(Some(MINE)));
    window.hold(KeyCode::KeyW, "w", 120);
    window.hold(KeyCode::KeyA, "a", 150);
    let robot = window.place_of_robot(OTHER);
    window.carry(robot, robot + Vec2::new(0.3, if robot.y > 0.0 { -0.8 } else { 0.8 }));
    window.play_to(200);
    let ball = window.place_of_ball();
    window.carry(ball, Vec2::new(-1.5, if ball.y > 0.0 { -0.6 } else { 0.6 }));
    window.hold(KeyCode::ArrowUp, "", 260);
    window.press(KeyCode::KeyM, "m");
    window.click_on("Jam");
    window.play_to(380);
    window.click_on("Jammed: end it");
    window.press(KeyCode::KeyM, "m");
    window.play_to(400);
    own.save(&own.text.replace("speed: 0.85", "speed: 0.5"));
    // Time stands still until the file is seen to be another one.
    (0..60).for_each(|_| drop(window.frame(SIZE, 1.0)));
    window.hold(KeyCode::KeyS, "s", 440);
    window.press(KeyCode::KeyH, "h");
    window.play_to(600);
}

/// Plays a recording without a window and compares every tick of it.
fn play_again(replay: &Replay) -> Match {
    let mut game = Match::new(&replay.plans().expect("it holds its files").0);
    let mut comparison = Comparison::with(replay);
    for _ in 0..replay.ticks() {
        game.tick();
        comparison.check(game.world_mut()).unwrap_or_else(|parting| panic!("{parting}"));
    }
    game
}

#[test]
fn a_match_of_a_person_is_played_again_from_its_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.replay");
    // Of this package, so that the recording names no folder of this machine.
    let assets = AssetFolder::new("assets");
    let own = OwnStrategy::in_folder(folder.path(), &assets);
    let mut window = LaidOutWindow::new();
    window.app.insert_resource(Folder(assets));
    window.app.insert_resource(Recording::to(Some(path.clone())));
    let home = own.path.to_str().map(str::to_owned);
    let choice = Choice { home, seed: 3, ..Choice::default() };
    window.app.insert_resource(PendingMatch(Some(MatchRequest::Match(choice))));
    window.show(SIZE, 1.0);
    play(&mut window, &own);
    assert_eq!(window.rewind().branches().len(), 1, "nobody went back");
    let asked = window.rewind().requests();
    let deeds: [(&str, IsDeed); 9] = [
        ("takes a robot over", |it| *it == Request::TakeOver(MINE)),
        ("drives", |it| matches!(it, Request::Steer { robot: MINE, pilot } if pilot.throttle == 1.0)),
        ("turns", |it| matches!(it, Request::Steer { robot: MINE, pilot } if pilot.turn == 1.0)),
        ("drags a robot", |it| matches!(it, Request::Body(BodyChange::Kidnap { robot: OTHER, .. }))),
        ("drags the ball", |it| matches!(it, Request::Body(BodyChange::Ball { .. }))),
        ("jams", |it| *it == Request::Radio(RadioChange::Jam(true))),
        ("ends the jam", |it| *it == Request::Radio(RadioChange::Jam(false))),
        ("changes the strategy", |it| matches!(it, Request::ChangeStrategy { team: Team::Home, .. })),
        ("hands it back", |it| *it == Request::HandBack(MINE)),
    ];
    for (what, is_it) in deeds {
        assert!(asked.iter().any(|(_, request)| is_it(request)), "nobody {what}");
    }
    let (ticks, digest) = (window.clock(), window.digest());
    window.app.world_mut().write_message(AppExit::Success);
    window.app.update();
    let replay = Replay::read(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((replay.is_whole, replay.ticks(), replay.digest()), (true, ticks, Some(digest)));
    assert_eq!(play_again(&replay).record().digest, digest);
    // Without what the person did it is another match.
    let (plan, _) = replay.plans().expect("it holds its files");
    let mut alone = Match::new(&MatchPlan { script: Vec::new(), ..plan });
    (0..ticks).for_each(|_| alone.tick());
    assert_ne!(alone.record().digest, digest);
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::copy(&path, FIXTURE).expect("the package can be written");
    }
}
