//! The calibration's panel: pictures at the left, controls at the right. It knows neither match nor robot, only what it is given,
//! so that it serves a robot of this process as well as one that is far away.

use bevy_egui::egui::{self, Key, KeyboardShortcut, Modifiers, RichText, vec2};

use super::camera_controls;
use super::classes;
use super::history::CameraValues;
use super::light_controls;
use super::panel_state::{CalibrationEdit, CalibrationPanel};
use super::pictures::{self, FoundThings, PictureKind, PictureTextures, PixelClick, PixelPointer};
use super::seen::{CameraView, seen_things};
use super::thresholds;
use super::view::{CalibrationView, CalibrationWish};
use crate::app::view::colours;
use crate::vision::{ColourClass, ColourLookup, Quality, Segmenter, Yuv, recognise};

/// What the panel keeps from frame to frame.
#[derive(Default)]
pub struct CalibrationWidget {
    /// What a person has chosen.
    pub panel: CalibrationPanel,
    textures: PictureTextures,
    segmenter: Segmenter,
}

/// The panel in one frame.
pub struct CalibrationPage<'a> {
    widget: &'a mut CalibrationWidget,
    view: CalibrationView<'a>,
    edit: CalibrationEdit,
    wishes: Vec<CalibrationWish>,
    /// Names of files that can be loaded.
    files: &'a dyn Fn() -> Vec<String>,
    /// Whether the pointer is down.
    held: bool,
}

const UNDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Z);
const REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
const REDO_TOO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Y);

/// What is so near to a pixel that is taught, in each channel, is taught with it.
const MARGIN: u8 = 4;
/// Room that the controls take beside the pictures, in points.
const CONTROLS: f32 = 330.0;
/// Where the controls have so much room, they are in two columns, in points.
const TWO_COLUMNS: f32 = 720.0;
/// Height of the line that tells of the pixel under the pointer, in points.
const LINE: f32 = 20.0;

impl<'a> CalibrationPage<'a> {
    /// Nothing is changed yet.
    pub fn new(
        widget: &'a mut CalibrationWidget,
        view: CalibrationView<'a>,
        files: &'a dyn Fn() -> Vec<String>,
    ) -> CalibrationPage<'a> {
        widget.panel.turn_to(&view.whose);
        let edit = CalibrationEdit::new(view.calibration);
        CalibrationPage { widget, view, edit, wishes: Vec::new(), files, held: false }
    }

    /// Shows the row above the pictures: which are shown, the classes, steps back, files.
    pub fn show_toolbar(&mut self, ui: &mut egui::Ui) {
        self.held = ui.input(|input| input.pointer.any_down());
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.spacing_mut().button_padding.x = 5.0;
        ui.label(RichText::new(format!("Camera of {}", self.view.whose)).size(15.0).strong());
        ui.separator();
        for ((_, title, tip), shown) in PictureKind::ALL.into_iter().zip(&mut self.widget.panel.shown) {
            ui.toggle_value(shown, title).on_hover_text(tip);
        }
        ui.separator();
        self.show_chips(ui);
        ui.separator();
        self.show_steps(ui);
        ui.separator();
        self.show_files(ui);
    }

    fn show_chips(&mut self, ui: &mut egui::Ui) {
        for class in ColourClass::ALL {
            let chosen = self.widget.panel.class == class;
            let chip = ui.selectable_label(chosen, egui::WidgetText::from(classes::named(class)));
            if chip.on_hover_text("Click pixels to teach this class").clicked() {
                self.widget.panel.class = class;
            }
        }
    }

    fn show_steps(&mut self, ui: &mut egui::Ui) {
        // The longer one first, since the shorter one is a part of it.
        let typing = ui.ctx().egui_wants_keyboard_input();
        let by_key = |shortcut| !typing && ui.input_mut(|input| input.consume_shortcut(shortcut));
        let by_key = if by_key(&REDO) || by_key(&REDO_TOO) {
            Some(false)
        } else if by_key(&UNDO) {
            Some(true)
        } else {
            None
        };
        let panel = &mut self.widget.panel;
        let (steps, again) = (panel.history().undoable(), panel.history().redoable());
        let undo = ui.add_enabled(steps > 0, egui::Button::new("Undo"));
        if undo.on_hover_text(format!("Takes the last step back; {steps} can be (Ctrl+Z)")).clicked()
            || by_key == Some(true)
        {
            self.edit.undo(panel);
        }
        let redo = ui.add_enabled(again > 0, egui::Button::new("Redo"));
        if redo.on_hover_text("Does it again (Ctrl+Shift+Z or Ctrl+Y)").clicked() || by_key == Some(false) {
            self.edit.redo(panel);
        }
    }

    fn show_files(&mut self, ui: &mut egui::Ui) {
        if let Some((name, file)) = self.view.file {
            let filed = CameraValues::of(file);
            let back = ui.add_enabled(filed != self.edit.values, egui::Button::new("Back to file"));
            if back.on_hover_text(format!("Puts everything back to cameras/{name}.ron")).clicked() {
                self.edit.values = filed;
            }
        }
        let panel = &mut self.widget.panel;
        let own = self.view.file.map_or("", |(name, _)| name);
        let mut name = panel.name.clone().unwrap_or_else(|| own.to_owned());
        let field = egui::TextEdit::singleline(&mut name).desired_width(90.0).hint_text("name");
        if ui.add(field).on_hover_text("The name of the file among the cameras").changed() {
            panel.name = Some(name.clone());
        }
        let tip = format!("Writes cameras/{name}.ron; all robots that it is for play on with it");
        if ui.button("Save").on_hover_text(tip).clicked() {
            self.wishes.push(CalibrationWish::Save(name));
        }
        ui.menu_button("Load", |ui| {
            for name in (self.files)() {
                if ui.button(&name).clicked() {
                    self.wishes.push(CalibrationWish::Load(name));
                    ui.close();
                }
            }
        })
        .response
        .on_hover_text("Takes settings and thresholds of another camera's file over");
        if let Some((well, words)) = &self.widget.panel.told {
            let colour = if *well { colours::GOOD } else { colours::PENALTY };
            ui.colored_label(colours::egui(colour), words);
        }
    }

    /// Shows pictures and controls.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        let room = ui.available_size();
        let pictures = vec2((room.x - CONTROLS - 3.0 * pictures::GAP).max(1.0), room.y);
        ui.horizontal_top(|ui| {
            ui.allocate_ui(pictures, |ui| ui.vertical(|ui| self.show_pictures(ui, pictures)));
            ui.separator();
            egui::ScrollArea::vertical().id_salt("controls").auto_shrink(false).show(ui, |ui| {
                ui.vertical(|ui| self.show_controls(ui));
            });
        });
    }

    fn show_pictures(&mut self, ui: &mut egui::Ui, room: egui::Vec2) {
        let Some(image) = self.view.image else {
            ui.weak("No picture yet.");
            return;
        };
        let viewpoint = CameraView {
            optics: &self.view.calibration.optics,
            size: (image.width, image.height),
            gaze: self.view.gaze,
        };
        let lookup = ColourLookup::new(&self.edit.values.colours);
        let cut = self.widget.segmenter.segment(image, &lookup);
        self.widget.textures.follow(ui.ctx(), image, cut.classes);
        let shown = self.widget.panel.shown;
        let size = viewpoint.size;
        let count = shown.iter().filter(|shown| **shown).count();
        let things = self.view.known.map_or(Vec::new(), |known| {
            seen_things(&viewpoint, known, &recognise(cut, viewpoint.optics, viewpoint.gaze, known))
        });
        let found = FoundThings { blobs: cut.blobs, things: &things };
        let scale = pictures::scale(room - vec2(0.0, LINE), size, count);
        let mut pointer = None;
        egui::ScrollArea::both().id_salt("pictures").show(ui, |ui| {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = pictures::GAP;
                for (kind, _) in PictureKind::ALL.into_iter().zip(shown).filter(|(_, shown)| *shown) {
                    let at = pictures::show(ui, kind, &self.widget.textures, (size, scale), &found);
                    pointer = pointer.or(at);
                }
            });
        });
        self.show_pixel(ui, pointer);
        if let Some(PixelPointer { at: (x, y), click: Some(click) }) = pointer
            && let Some(pixel) = image.at(x, y)
        {
            let (class, colours) = (self.widget.panel.class, &mut self.edit.values.colours);
            match click {
                PixelClick::Add => colours.teach_at(class, image, (x, y), MARGIN),
                PixelClick::TakeAway => colours.forget(class, pixel),
            }
        }
    }

    /// What is at the pointer, in a line.
    fn show_pixel(&self, ui: &mut egui::Ui, pointer: Option<PixelPointer>) {
        let class = self.widget.panel.class;
        let pointed =
            pointer.and_then(|pointer| Some((pointer.at, self.view.image?.at(pointer.at.0, pointer.at.1)?)));
        let Some(((x, y), pixel)) = pointed else {
            ui.weak(format!("Click a pixel: it is {class}. Right click, or Alt: it is not."));
            return;
        };
        let named =
            |class: Option<ColourClass>| class.map_or("nothing".to_owned(), |class| class.to_string());
        let is = named(self.edit.values.colours.class_of(pixel));
        let width = self.view.image.map_or(0, |image| image.width);
        let truth = self.view.truth.and_then(|truth| truth.get(y * width + x).copied());
        let truth = truth.map_or(String::new(), |truth| format!(", in truth {}", named(truth)));
        let Yuv { y: bright, u, v } = pixel;
        ui.label(format!("{x}, {y}:  Y {bright}  U {u}  V {v}  is {is}{truth}"));
    }

    /// Beside each other where there is room, else below each other.
    fn show_controls(&mut self, ui: &mut egui::Ui) {
        if ui.available_width() < TWO_COLUMNS {
            self.show_colours(ui);
            ui.separator();
            self.show_settings(ui);
            return;
        }
        ui.columns(2, |columns| {
            if let [left, right] = columns {
                self.show_colours(left);
                self.show_settings(right);
            }
        });
    }

    fn show_colours(&mut self, ui: &mut egui::Ui) {
        let class = self.widget.panel.class;
        let file = self.view.file.map(|(_, file)| file);
        let cut = self.widget.segmenter.segmented();
        let truth = self.view.truth.filter(|truth| truth.len() == cut.classes.len());
        let own = truth.map(|truth| Quality::of(truth, cut.classes));
        if let Some(quality) = own.as_ref().or(self.view.quality) {
            classes::show(ui, quality, &mut self.widget.panel.class);
            ui.separator();
        }
        thresholds::show(ui, class, file.map(|file| &file.colours), &mut self.edit.values.colours);
    }

    fn show_settings(&mut self, ui: &mut egui::Ui) {
        let file = self.view.file.map(|(_, file)| file);
        let filed = file.map_or(self.view.calibration.settings, |file| file.settings);
        camera_controls::show(ui, &self.view.calibration.optics, &filed, &mut self.edit.values.settings);
        if let Some([now, first]) = self.view.light {
            ui.separator();
            let mut light = now;
            light_controls::show(ui, &first, &mut light);
            if light != now {
                self.wishes.push(CalibrationWish::Light(light));
            }
        }
    }

    /// What a person asks for.
    pub fn finish(self) -> Vec<CalibrationWish> {
        let mut wishes = self.wishes;
        wishes.extend(self.edit.finish(&mut self.widget.panel, self.held));
        wishes
    }
}
