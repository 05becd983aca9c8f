//! The whole interface laid out without a window or a graphics adapter, in windows and with panels that people may have.

mod breakpoints;
mod camera;
mod laid_out;
mod marks;
mod person;
mod rewind;
mod silent_robots;
mod states;
mod stories;
mod why;
mod world;

use bevy::prelude::*;
use bevy_egui::egui;
use egui::vec2;
use laid_out::{LaidOutFrame, LaidOutWindow};
use proptest::prelude::*;

use crate::app::view::interface::window_size::{NEEDED, pixels_a_point};
use crate::app::view::state::{
    Action, FileError, OpenDialogues, Overlay, Overlays, Piloted, Playback, Question, Session,
};
use crate::data::AssetFolder;
use crate::game::requests::Requests;
use crate::ids::{RobotId, Team};
use crate::world::referee::{MatchState, Removal, RemovalReason};

const ROBOT: RobotId = RobotId::new(Team::Home, 1);

fn assets() -> AssetFolder {
    AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))
}

/// Windows in points, from none to large.
const WINDOWS: [(f32, f32); 19] = [
    (1280.0, 720.0),
    (0.3, 0.3),
    (1.0, 1.0),
    (10.0, 10.0),
    (200.0, 100.0),
    (400.0, 700.0),
    (1.0, 900.0),
    (2000.0, 1.0),
    (90.0, 300.0),
    (213.0, 133.0),
    (320.0, 200.0),
    (640.0, 400.0),
    (800.0, 450.0),
    (1189.0, 500.0),
    (1216.0, 400.0),
    (1273.0, 420.0),
    (1275.0, 420.0),
    (700.0, 1200.0),
    (2560.0, 1440.0),
];

/// What may be open, with a name for it.
fn programs() -> Vec<(&'static str, LaidOutWindow)> {
    use Overlay::{Camera, Communication, Labels, Radio, States, Teamwork, Vectors};
    let mut asked = LaidOutWindow::playing(Some(ROBOT)).open([Labels]);
    asked.app.insert_resource(OpenDialogues { question: Some(Question::Leave), ..OpenDialogues::default() });
    let mut helped = LaidOutWindow::playing(None);
    helped.app.insert_resource(OpenDialogues { help: true, ..OpenDialogues::default() });
    let mut over = LaidOutWindow::playing(None);
    over.app.insert_resource(OpenDialogues { result: true, ..OpenDialogues::default() });
    let mut troubled = LaidOutWindow::playing(None).open([Radio]);
    troubled.app.insert_resource(FileError(Some("a_team.ron:1:1: something is wrong. ".repeat(20))));
    let mut troubled_menu = LaidOutWindow::new();
    troubled_menu.app.insert_resource(FileError(Some("a_team.ron:1:1: something is wrong. ".repeat(20))));
    vec![
        ("the menu", LaidOutWindow::new()),
        ("the menu with a trouble", troubled_menu),
        ("watching", LaidOutWindow::playing(None)),
        ("the inspector", LaidOutWindow::playing(None).open([Vectors, Labels, Teamwork])),
        ("playing", LaidOutWindow::playing(Some(ROBOT))),
        ("playing with everything", LaidOutWindow::playing(Some(ROBOT)).open(Overlay::ALL)),
        ("the radio", LaidOutWindow::playing(None).open([Labels, Radio])),
        ("the team communication", LaidOutWindow::playing(None).open([Labels, Communication])),
        ("the states", LaidOutWindow::playing(None).open([Labels, States])),
        ("the camera", LaidOutWindow::playing(None).open([Labels, Camera])),
        ("a scenario", LaidOutWindow::scenario("swap_figure_8").open([Labels, Radio])),
        ("a question", asked),
        ("the keys", helped),
        ("the result", over),
        ("a trouble", troubled),
    ]
}

#[test]
fn in_no_window_do_controls_lie_upon_each_other_and_from_640_by_400_time_and_pitch_are_seen() {
    for (what, mut program) in programs() {
        for (width, height) in WINDOWS {
            for scale in [1.0, 1.5, 3.0] {
                let frame = program.show(vec2(width, height), scale);
                frame.assert_apart(what);
                let needs = width >= NEEDED.x && height >= NEEDED.y;
                if needs && program.app.world().resource::<Session>().plan.is_some() {
                    frame.assert_time_and_pitch(what);
                }
            }
        }
    }
}

#[test]
fn at_any_scale_of_the_screen_time_and_pitch_are_seen_in_a_window_of_640_by_400_pixels() {
    let mut program = LaidOutWindow::playing(Some(ROBOT)).open(Overlay::ALL);
    for scale in [1.0, 1.25, 1.5, 2.0, 2.5, 3.0] {
        let shown = pixels_a_point(UVec2::new(640, 400), scale);
        let frame = program.show(vec2(640.0 / shown, 400.0 / shown), shown);
        frame.assert_apart("everything");
        frame.assert_time_and_pitch("everything");
    }
}

#[test]
fn panels_are_as_large_as_before_when_a_small_window_is_large_again() {
    let mut program = LaidOutWindow::playing(None).open([Overlay::Labels, Overlay::Radio]);
    let large = vec2(1600.0, 1000.0);
    let before = program.show(large, 1.0).free;
    for (width, height) in WINDOWS {
        program.show(vec2(width, height), 1.0);
    }
    assert_eq!(program.show(large, 1.0).free, before);
}

#[test]
fn the_panels_below_the_pitch_show_their_pages_under_their_heads() {
    let no_pictures = "home 1 sees without pictures: the eyes of its sensing preset are not Images.";
    for (overlay, head, page) in [
        (Overlay::Radio, "Jam", "home 0"),
        (Overlay::Communication, "Modules", "queue full"),
        (Overlay::States, "Machine", "Ways out of search"),
        (Overlay::Camera, "Camera", no_pictures),
    ] {
        let mut program = LaidOutWindow::playing(None).open([overlay]);
        let frame = program.show(vec2(1280.0, 720.0), 1.0);
        assert!(frame.shows(head) && frame.shows(page), "{overlay:?}: {:?}", frame.texts);
    }
}

#[test]
fn a_player_sees_no_inspector_and_no_vectors_until_they_are_asked_for() {
    let mut program = LaidOutWindow::playing(Some(ROBOT));
    let small = program.show(vec2(1280.0, 720.0), 1.0);
    assert!(small.free.width() > 1200.0 && !small.shows("Motor"), "{}", small.free);
    assert_eq!(*program.app.world().resource::<Overlays>(), Overlays::only([Overlay::Labels]));
    program.app.world_mut().write_message(Action::Inspector);
    let asked = program.show(vec2(1280.0, 720.0), 1.0);
    assert!(asked.shows("Motor"), "{:?}", asked.texts);
    program.app.insert_resource(Piloted(None));
    program.show(vec2(1280.0, 720.0), 1.0);
    assert_eq!(*program.app.world().resource::<Overlays>(), Overlays::default());
    program.app.insert_resource(Piloted(Some(ROBOT)));
    assert!(program.show(vec2(1280.0, 720.0), 1.0).shows("Motor"));
    assert_eq!(*program.app.world().resource::<Overlays>(), Overlays::only([Overlay::Labels]));
}

#[test]
fn an_open_inspector_asks_for_nothing_by_itself() {
    let mut window = LaidOutWindow::playing(Some(ROBOT)).open([Overlay::Labels]);
    window.app.insert_resource(Playback { paused: true, ..Playback::default() });
    let mut asked = || {
        let frame = window.show(vec2(1280.0, 720.0), 1.0);
        assert!(frame.shows("Hand back"), "{:?}", frame.texts);
        window.app.world().resource::<Requests>().iter().count()
    };
    assert_eq!(asked(), asked());
}

#[test]
fn a_removal_without_end_has_no_time_in_the_inspector() {
    let mut program = LaidOutWindow::playing(None).open([Overlay::Labels]);
    program.app.insert_resource(Playback { paused: true, ..Playback::default() });
    let world = program.app.world_mut();
    let removal = Removal { robot: ROBOT, reason: RemovalReason::Ordered, seconds_left: f64::INFINITY };
    world.resource_mut::<MatchState>().removed.push(removal);
    let mut robots = world.query::<(Entity, &RobotId)>();
    let robot = robots.iter(world).find(|(_, id)| **id == ROBOT).map(|(entity, _)| entity);
    world.entity_mut(robot.expect("the robot")).insert(crate::robot::OffPitch);
    let frame = program.show(vec2(1280.0, 720.0), 1.0);
    let told = frame.texts.iter().filter(|(text, _)| text == "taken off").count();
    assert!(
        told >= 1 && frame.texts.iter().all(|(text, _)| !text.contains("for another")),
        "{:?}",
        frame.texts
    );
}

#[test]
fn the_buttons_are_called_by_the_keys_of_this_persons_keyboard() {
    use bevy::input::ButtonState;
    use bevy::input::keyboard::{Key, KeyboardInput};
    let mut program = LaidOutWindow::playing(None);
    assert!(program.show(vec2(1280.0, 720.0), 1.0).shows("M Radio"));
    for (key_code, written) in [(KeyCode::KeyM, ","), (KeyCode::KeyW, "z")] {
        program.app.world_mut().write_message(KeyboardInput {
            key_code,
            logical_key: Key::Character(written.into()),
            state: ButtonState::Pressed,
            text: None,
            repeat: false,
            window: Entity::PLACEHOLDER,
        });
    }
    program.app.insert_resource(OpenDialogues { help: true, ..OpenDialogues::default() });
    let frame = program.show(vec2(1280.0, 720.0), 1.0);
    assert!(frame.shows(", Radio") && frame.shows("Z or Up"), "{:?}", frame.texts);
    assert!(program.app.world().resource::<Overlays>().shows(Overlay::Radio), "the place means the radio");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn a_window_can_be_dragged_to_any_size(
        windows in proptest::collection::vec((1u32..1500, 1u32..1000, 1.0f32..3.0), 1..8),
    ) {
        let mut program = LaidOutWindow::scenario("swap_figure_8").open(Overlay::ALL);
        for (width, height, scale) in windows {
            let size = vec2(width as f32 / scale, height as f32 / scale);
            program.show(size, scale).assert_apart("everything");
        }
    }
}
