//! The whole interface laid out without a window or a graphics adapter, in windows and with panels that people may have.

mod camera;
mod rewind;
mod silent_robots;
mod why;

use std::time::Duration;

use bevy::gizmos::prelude::GizmoAsset;
use bevy::input::InputPlugin;
use bevy::prelude::*;
use bevy::state::app::StatesPlugin;
use bevy::time::TimeUpdateStrategy;
use bevy_egui::input::EguiWantsInput;
use bevy_egui::{EguiContext, EguiPrimaryContextPass, EguiUserTextures, PrimaryEguiContext, egui};
use egui::{Rect, vec2};
use proptest::prelude::*;

use crate::app::match_request::MatchRequest;
use crate::app::view::interface::window_size::{NEEDED, pixels_a_point};
use crate::app::view::state::{
    Action, FileError, Folder, FreeArea, Inspector, OpenDialogues, Overlay, Overlays, PITCH, PendingMatch,
    Piloted, Playback, Question, Selected, Session,
};
use crate::app::{inspector, view};
use crate::data::AssetFolder;
use crate::game::Choice;
use crate::game::requests::Requests;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::ScenarioRef;
use crate::world::referee::{MatchState, Removal, RemovalReason};

const ROBOT: RobotId = RobotId::new(Team::Home, 1);

fn assets() -> AssetFolder {
    AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))
}

/// The window's program without a window.
struct LaidOutWindow {
    app: App,
    ctx: egui::Context,
    frames: u32,
}

/// What there is in the window after a frame.
struct LaidOutFrame {
    screen: Rect,
    /// Each layer's controls, where they are seen.
    layers: Vec<(egui::Order, Vec<Rect>)>,
    /// Texts, and whether each is seen whole.
    texts: Vec<(String, bool)>,
    /// Where each of them is.
    places: Vec<(String, Rect)>,
    /// The grounds of panels and the like, with their colours.
    grounds: Vec<(Rect, egui::Color32)>,
    /// Pictures, such as those of a robot's camera.
    pictures: Vec<Rect>,
    /// Of the pitch; nothing in the menu.
    free: Rect,
}

impl LaidOutWindow {
    /// At the menu.
    fn new() -> LaidOutWindow {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, AssetPlugin::default(), StatesPlugin, InputPlugin));
        let window = Window { resolution: bevy::window::WindowResolution::new(1280, 720), ..default() };
        app.add_plugins(WindowPlugin { primary_window: Some(window), ..default() });
        app.init_asset::<Mesh>().init_asset::<ColorMaterial>().init_asset::<GizmoAsset>();
        app.init_resource::<EguiUserTextures>().init_resource::<EguiWantsInput>();
        app.add_plugins((crate::game::simulation, view::plugin, inspector::panels));
        app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(16)));
        app.insert_resource(Folder(assets()));
        let context = EguiContext::default();
        let ctx = context.clone().get_mut().clone();
        app.world_mut().spawn((context, PrimaryEguiContext));
        app.finish();
        app.cleanup();
        app.update();
        LaidOutWindow { app, ctx, frames: 0 }
    }

    fn with(wanted: MatchRequest) -> LaidOutWindow {
        let mut program = LaidOutWindow::new();
        program.app.insert_resource(PendingMatch(Some(wanted)));
        program.app.update();
        program.app.update();
        program
    }

    /// In a match, with a robot under a person's hands or without.
    fn playing(pilot: Option<RobotId>) -> LaidOutWindow {
        LaidOutWindow::with(MatchRequest::Match(Choice { pilot, seed: 3, ..Choice::default() }))
    }

    fn scenario(name: &str) -> LaidOutWindow {
        let scenario = ScenarioRef::named(&assets(), name);
        LaidOutWindow::with(MatchRequest::Scenario { scenario, seed: None })
    }

    /// Opens the inspector of a robot, and these overlays and panels.
    fn open(mut self, overlays: impl IntoIterator<Item = Overlay>) -> LaidOutWindow {
        self.app.insert_resource(Selected(Some(ROBOT)));
        self.app.insert_resource(Inspector { open: true, world: false });
        self.app.insert_resource(Overlays::only(overlays));
        self
    }

    /// As many frames as panels take to settle in a window of a size in points.
    fn show(&mut self, size: egui::Vec2, pixels_a_point: f32) -> LaidOutFrame {
        self.frame(size, pixels_a_point);
        self.frame(size, pixels_a_point);
        self.frame(size, pixels_a_point)
    }

    fn frame(&mut self, size: egui::Vec2, pixels_a_point: f32) -> LaidOutFrame {
        self.frame_with(size, pixels_a_point, Vec::new())
    }

    /// A frame in which a person does something.
    fn frame_with(
        &mut self,
        size: egui::Vec2,
        pixels_a_point: f32,
        events: Vec<egui::Event>,
    ) -> LaidOutFrame {
        self.app.update();
        self.frames += 1;
        let screen = Rect::from_min_size(egui::Pos2::ZERO, size);
        let mut input = egui::RawInput {
            screen_rect: Some(screen),
            time: Some(f64::from(self.frames) / 60.0),
            events,
            ..egui::RawInput::default()
        };
        input.viewports.entry(egui::ViewportId::ROOT).or_default().native_pixels_per_point =
            Some(pixels_a_point);
        self.ctx.begin_pass(input);
        self.app.world_mut().run_schedule(EguiPrimaryContextPass);
        let output = self.ctx.end_pass();
        let mut texts = Vec::new();
        let mut places = Vec::new();
        let mut grounds = Vec::new();
        let mut pictures = Vec::new();
        for clipped in &output.shapes {
            if let egui::Shape::Rect(ground) = &clipped.shape {
                grounds.push((ground.rect.intersect(clipped.clip_rect), ground.fill));
            }
            if let egui::Shape::Mesh(mesh) = &clipped.shape
                && mesh.texture_id != egui::TextureId::default()
            {
                pictures.push(mesh.calc_bounds());
            }
            collect_texts(&clipped.shape, clipped.clip_rect.intersect(screen), &mut texts, &mut places);
        }
        self.ctx.tessellate(output.shapes, output.pixels_per_point);
        let layers = self.ctx.viewport(|viewport| {
            let layers = viewport.this_pass.widgets.layers();
            layers.map(|(layer, widgets)| (layer.order, controls(widgets, screen))).collect()
        });
        let in_match = self.app.world().resource::<Session>().plan.is_some();
        let free = if in_match { self.app.world().resource::<FreeArea>().0 } else { Rect::NOTHING };
        LaidOutFrame { screen, layers, texts, places, grounds, pictures, free }
    }
}

fn collect_texts(
    shape: &egui::Shape,
    seen: Rect,
    texts: &mut Vec<(String, bool)>,
    places: &mut Vec<(String, Rect)>,
) {
    match shape {
        egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect_texts(shape, seen, texts, places)),
        egui::Shape::Text(text) => {
            let rect = text.galley.rect.translate(text.pos.to_vec2()).shrink(1.0);
            texts.push((text.galley.text().to_owned(), seen.contains_rect(rect)));
            places.push((text.galley.text().to_owned(), rect));
        }
        _ => {}
    }
}

/// The edges of panels are no wider than this, in points; they overlap others by design.
const THIN: f32 = 12.0;

/// Buttons, sliders and the like where they are seen; lists that scroll and the grounds of windows lie under those by design.
fn controls(widgets: &[egui::WidgetRect], screen: Rect) -> Vec<Rect> {
    let controls = widgets.iter().filter(|widget| widget.enabled && widget.sense.is_focusable());
    let seen = controls.map(|widget| widget.interact_rect.intersect(screen));
    seen.filter(|rect| rect.width() > THIN && rect.height() > THIN).collect()
}

impl LaidOutFrame {
    /// Controls that overlap each other, in one layer, or the pitch.
    fn clashes(&self) -> Vec<(Rect, Rect)> {
        let mut clashes = Vec::new();
        for (order, layer) in &self.layers {
            for (number, a) in layer.iter().enumerate() {
                let common = layer[..number].iter().filter(|b| {
                    let common = a.intersect(**b);
                    common.width() > 1.0 && common.height() > 1.0
                });
                clashes.extend(common.map(|b| (*a, *b)));
                let on_pitch = a.intersect(self.free);
                if *order == egui::Order::Background && on_pitch.width() > 1.0 && on_pitch.height() > 1.0 {
                    clashes.push((*a, self.free));
                }
            }
        }
        clashes
    }

    fn shows(&self, text: &str) -> bool {
        self.texts.iter().any(|(shown, whole)| *whole && shown == text)
    }

    fn assert_apart(&self, what: &str) {
        let clashes = self.clashes();
        assert!(clashes.is_empty(), "{what}, {}: {clashes:?}", self.screen.size());
    }

    fn assert_time_and_pitch(&self, what: &str) {
        let size = self.screen.size();
        assert!(self.shows("⏸ Pause") || self.shows("▶ Play"), "{what}, {size}: {:?}", self.texts);
        for control in ["Tick", "−", "1×", "+"] {
            assert!(self.shows(control), "{what}, {size}: {control} in {:?}", self.texts);
        }
        let free = self.free;
        assert!(free.width() >= PITCH.x - 1.0 && free.height() >= PITCH.y - 1.0, "{what}, {size}: {free}");
    }
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
    use Overlay::{Camera, Communication, Labels, Radio, Teamwork, Vectors};
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
