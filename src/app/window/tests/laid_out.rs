//! The window's program laid out without a window or a graphics adapter, frame by frame, and what is in each frame.

use std::time::Duration;

use bevy::gizmos::prelude::GizmoAsset;
use bevy::input::InputPlugin;
use bevy::prelude::*;
use bevy::state::app::StatesPlugin;
use bevy::time::TimeUpdateStrategy;
use bevy_egui::input::EguiWantsInput;
use bevy_egui::{EguiContext, EguiPrimaryContextPass, EguiUserTextures, PrimaryEguiContext, egui};
use egui::Rect;

use super::{ROBOT, assets};
use crate::app::match_request::MatchRequest;
use crate::app::view::state::{
    Folder, FreeArea, Inspector, Overlay, Overlays, PITCH, PendingMatch, Selected, Session,
};
use crate::app::{inspector, view};
use crate::game::Choice;
use crate::ids::RobotId;
use crate::lab::scenario::ScenarioRef;

/// The window's program without a window.
pub struct LaidOutWindow {
    pub app: App,
    pub ctx: egui::Context,
    pub frames: u32,
}

/// What there is in the window after a frame.
pub struct LaidOutFrame {
    pub screen: Rect,
    /// Each layer's controls, where they are seen.
    pub layers: Vec<(egui::Order, Vec<Rect>)>,
    /// Texts, and whether each is seen whole.
    pub texts: Vec<(String, bool)>,
    /// Where each of them is.
    pub places: Vec<(String, Rect)>,
    /// The colours of all lines and curves.
    pub colours: Vec<egui::Color32>,
    /// The grounds of panels and the like, with their colours.
    pub grounds: Vec<(Rect, egui::Color32)>,
    /// Pictures, such as those of a robot's camera.
    pub pictures: Vec<Rect>,
    /// Of the pitch; nothing in the menu.
    pub free: Rect,
}

impl LaidOutWindow {
    /// At the menu.
    pub fn new() -> LaidOutWindow {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, AssetPlugin::default(), StatesPlugin, InputPlugin));
        let window = Window { resolution: bevy::window::WindowResolution::new(1280, 720), ..default() };
        app.add_plugins(WindowPlugin { primary_window: Some(window), ..default() });
        app.init_asset::<Mesh>().init_asset::<ColorMaterial>().init_asset::<GizmoAsset>();
        // The renderer would register them, and the view of the world asks for them.
        app.register_type::<Handle<Image>>();
        app.init_resource::<EguiUserTextures>().init_resource::<EguiWantsInput>();
        app.add_plugins((crate::game::simulation, view::plugin, inspector::plugin));
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

    pub fn with(wanted: MatchRequest) -> LaidOutWindow {
        let mut program = LaidOutWindow::new();
        program.app.insert_resource(PendingMatch(Some(wanted)));
        program.app.update();
        program.app.update();
        program
    }

    /// In a match, with a robot under a person's hands or without.
    pub fn playing(pilot: Option<RobotId>) -> LaidOutWindow {
        LaidOutWindow::with(MatchRequest::Match(Choice { pilot, seed: 3, ..Choice::default() }))
    }

    pub fn scenario(name: &str) -> LaidOutWindow {
        let scenario = ScenarioRef::named(&assets(), name);
        LaidOutWindow::with(MatchRequest::Scenario { scenario, seed: None })
    }

    /// Opens the inspector of a robot, and these overlays and panels.
    pub fn open(mut self, overlays: impl IntoIterator<Item = Overlay>) -> LaidOutWindow {
        self.app.insert_resource(Selected(Some(ROBOT)));
        self.app.insert_resource(Inspector { open: true, world: false });
        self.app.insert_resource(Overlays::only(overlays));
        self
    }

    /// As many frames as panels take to settle in a window of a size in points.
    pub fn show(&mut self, size: egui::Vec2, pixels_a_point: f32) -> LaidOutFrame {
        self.frame(size, pixels_a_point);
        self.frame(size, pixels_a_point);
        self.frame(size, pixels_a_point)
    }

    pub fn frame(&mut self, size: egui::Vec2, pixels_a_point: f32) -> LaidOutFrame {
        self.frame_with(size, pixels_a_point, Vec::new())
    }

    /// A person presses a button of the mouse at a place and lets it go; what there is then.
    pub fn click(&mut self, size: egui::Vec2, pos: egui::Pos2, button: egui::PointerButton) -> LaidOutFrame {
        self.frame_with(size, 1.0, vec![egui::Event::PointerMoved(pos)]);
        for pressed in [true, false] {
            let event = egui::Event::PointerButton { pos, button, pressed, modifiers: egui::Modifiers::NONE };
            self.frame_with(size, 1.0, vec![event]);
        }
        self.frame(size, 1.0)
    }

    /// A frame in which a person does something.
    pub fn frame_with(
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
        let (mut texts, mut places, mut colours) = (Vec::new(), Vec::new(), Vec::new());
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
            collect_colours(&clipped.shape, &mut colours);
        }
        self.ctx.tessellate(output.shapes, output.pixels_per_point);
        let layers = self.ctx.viewport(|viewport| {
            let layers = viewport.this_pass.widgets.layers();
            layers.map(|(layer, widgets)| (layer.order, controls(widgets, screen))).collect()
        });
        let in_match = self.app.world().resource::<Session>().plan.is_some();
        let free = if in_match { self.app.world().resource::<FreeArea>().0 } else { Rect::NOTHING };
        LaidOutFrame { screen, layers, texts, places, colours, grounds, pictures, free }
    }
}

fn collect_texts(
    shape: &egui::Shape,
    seen: Rect,
    texts: &mut Vec<(String, bool)>,
    places: &mut Vec<(String, Rect)>,
) {
    match shape {
        egui::Shape::Vec(shapes) => {
            shapes.iter().for_each(|shape| collect_texts(shape, seen, texts, places));
        }
        egui::Shape::Text(text) => {
            let rect = text.galley.rect.translate(text.pos.to_vec2()).shrink(1.0);
            texts.push((text.galley.text().to_owned(), seen.contains_rect(rect)));
            places.push((text.galley.text().to_owned(), rect));
        }
        _ => {}
    }
}

fn collect_colours(shape: &egui::Shape, colours: &mut Vec<egui::Color32>) {
    match shape {
        egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect_colours(shape, colours)),
        egui::Shape::LineSegment { stroke, .. } => colours.push(stroke.color),
        egui::Shape::CubicBezier(curve) => {
            colours.extend(match curve.stroke.color {
                egui::epaint::ColorMode::Solid(colour) => Some(colour),
                egui::epaint::ColorMode::UV(_) => None,
            });
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
    pub fn clashes(&self) -> Vec<(Rect, Rect)> {
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

    pub fn shows(&self, text: &str) -> bool {
        self.texts.iter().any(|(shown, whole)| *whole && shown == text)
    }

    /// The middle of a text that is seen whole.
    pub fn place(&self, text: &str) -> Option<egui::Pos2> {
        let found = self.texts.iter().zip(&self.places).find(|((shown, whole), _)| *whole && shown == text);
        found.map(|(_, (_, place))| place.center())
    }

    pub fn assert_apart(&self, what: &str) {
        let clashes = self.clashes();
        assert!(clashes.is_empty(), "{what}, {}: {clashes:?}", self.screen.size());
    }

    pub fn assert_time_and_pitch(&self, what: &str) {
        let size = self.screen.size();
        assert!(self.shows("⏸ Pause") || self.shows("▶ Play"), "{what}, {size}: {:?}", self.texts);
        for control in ["Tick", "−", "1×", "+"] {
            assert!(self.shows(control), "{what}, {size}: {control} in {:?}", self.texts);
        }
        let free = self.free;
        assert!(free.width() >= PITCH.x - 1.0 && free.height() >= PITCH.y - 1.0, "{what}, {size}: {free}");
    }
}
