//! The panel under a person's hands, without a window: clicks and keys on what is drawn, and what they ask for.

use bevy_egui::egui::{self, Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};

use super::hand::{DrawnFrame, Hand, click, key};
use super::samples;
use super::view::{CalibrationView, CalibrationWish};
use super::widget::{CalibrationPage, CalibrationWidget};
use crate::vision::{
    CameraCalibration, ColourBox, ColourClass, ColourLookup, Gaze, Image, Resolution, Segmenter,
};

/// The panel on a picture, and the camera that does what it asks for.
struct Calibrating {
    hand: Hand,
    widget: CalibrationWidget,
    image: Image,
    truth: Vec<Option<ColourClass>>,
    calibration: CameraCalibration,
    file: CameraCalibration,
    wishes: Vec<CalibrationWish>,
}

impl Calibrating {
    fn of(calibration: CameraCalibration) -> Calibrating {
        let (image, truth) = samples::hall();
        let mut panel = Calibrating {
            hand: Hand::on(vec2(1280.0, 900.0)),
            widget: CalibrationWidget::default(),
            image,
            truth,
            calibration,
            file: samples::calibration(),
            wishes: Vec::new(),
        };
        panel.frame(Vec::new());
        panel
    }

    fn frame(&mut self, events: Vec<Event>) -> DrawnFrame {
        let view = CalibrationView {
            whose: "home 1".into(),
            image: Some(&self.image),
            truth: Some(&self.truth),
            quality: None,
            gaze: Gaze::default(),
            known: None,
            calibration: &self.calibration,
            file: Some(("hall", &self.file)),
            light: None,
        };
        let names = Vec::new;
        let mut page = CalibrationPage::new(&mut self.widget, view, &names);
        let drawn = self.hand.frame(events, |ctx, screen| {
            let place = egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(screen);
            let mut ui = egui::Ui::new(ctx.clone(), egui::Id::new("panel"), place);
            ui.horizontal_wrapped(|ui| page.show_toolbar(ui));
            page.show(&mut ui);
        });
        let asked = page.finish();
        for wish in &asked {
            match wish {
                CalibrationWish::Camera(settings) => self.calibration.settings = *settings,
                CalibrationWish::Colours(colours) => self.calibration.colours = colours.clone(),
                CalibrationWish::Light(_) | CalibrationWish::Save(_) | CalibrationWish::Load(_) => {}
            }
        }
        self.wishes.extend(asked);
        drawn
    }

    fn click(&mut self, at: Pos2, button: PointerButton, modifiers: Modifiers) -> DrawnFrame {
        click(at, button, modifiers).map(|events| self.frame(events)).into_iter().last().expect("a frame")
    }

    /// Clicks the middle of a pixel in one of the pictures.
    fn click_pixel(
        &mut self,
        picture: usize,
        pixel: (usize, usize),
        (button, modifiers): (PointerButton, Modifiers),
    ) -> DrawnFrame {
        let at = self.frame(Vec::new()).pixel(picture, self.image.width, pixel);
        self.click(at, button, modifiers)
    }

    fn click_text(&mut self, text: &str) -> DrawnFrame {
        let at = self.frame(Vec::new()).place_of(text).center();
        self.click(at, PointerButton::Primary, Modifiers::NONE)
    }

    fn press(&mut self, pressed: Key, modifiers: Modifiers) {
        self.frame(key(pressed, modifiers));
        self.frame(Vec::new());
    }

    /// Pixels of a class, as the calibration in force cuts the picture.
    fn found(&self, class: ColourClass) -> usize {
        let mut segmenter = Segmenter::default();
        let cut = segmenter.segment(&self.image, &ColourLookup::new(&self.calibration.colours));
        cut.classes.iter().filter(|of| **of == Some(class)).count()
    }
}

const LEFT: (PointerButton, Modifiers) = (PointerButton::Primary, Modifiers::NONE);
const RIGHT: (PointerButton, Modifiers) = (PointerButton::Secondary, Modifiers::NONE);
const WITH_ALT: (PointerButton, Modifiers) = (PointerButton::Primary, Modifiers::ALT);

/// A calibration that takes nothing for the ball.
fn spoilt() -> CameraCalibration {
    let mut calibration = samples::calibration();
    let nothing = ColourBox { y: (250, 255), u: (0, 5), v: (250, 255) };
    calibration.colours.0.insert(ColourClass::Orange, nothing);
    calibration
}

const BALL: (usize, usize) = (30, 25);

#[test]
fn three_pictures_lie_side_by_side_and_those_that_are_switched_off_make_room() {
    let mut panel = Calibrating::of(samples::calibration());
    let three = panel.frame(Vec::new()).pictures;
    assert_eq!(three.len(), 3);
    assert!(three[0].right() < three[1].left() && three[1].right() < three[2].left(), "{three:?}");
    panel.click_text("Classes");
    let one = panel.click_text("Blobs").pictures;
    assert!(one.len() == 1 && one[0].width() > three[0].width(), "{one:?} after {three:?}");
}

#[test]
fn a_click_teaches_the_chosen_class_in_any_picture_and_a_right_click_or_alt_takes_away() {
    for picture in 0..3 {
        let mut panel = Calibrating::of(spoilt());
        assert_eq!(panel.found(ColourClass::Orange), 0);
        panel.click_pixel(picture, BALL, LEFT);
        let taught = panel.found(ColourClass::Orange);
        assert!(taught > 0, "picture {picture}");
        panel.click_pixel(picture, BALL, RIGHT);
        assert!(panel.found(ColourClass::Orange) < taught, "picture {picture}");
        panel.click_pixel(picture, BALL, LEFT);
        panel.click_pixel(picture, BALL, WITH_ALT);
        assert!(panel.found(ColourClass::Orange) < taught, "picture {picture}");
    }
}

#[test]
fn another_class_is_taught_after_a_click_on_its_chip() {
    let mut panel = Calibrating::of(spoilt());
    panel.click_text("■ pink");
    panel.click_pixel(0, BALL, LEFT);
    assert!(panel.found(ColourClass::Pink) > 0 && panel.found(ColourClass::Orange) == 0);
}

#[test]
fn clicks_are_taken_back_and_done_again_by_buttons_and_by_keys() {
    let mut panel = Calibrating::of(spoilt());
    panel.click_pixel(0, BALL, LEFT);
    let once = panel.calibration.clone();
    panel.click_pixel(0, (27, 21), LEFT);
    let twice = panel.calibration.clone();
    assert!(once != twice && once != spoilt());
    panel.click_text("Undo");
    assert_eq!(panel.calibration, once);
    panel.press(Key::Z, Modifiers::COMMAND);
    assert_eq!(panel.calibration, spoilt());
    panel.press(Key::Z, Modifiers::COMMAND | Modifiers::SHIFT);
    assert_eq!(panel.calibration, once);
    panel.click_text("Redo");
    assert_eq!(panel.calibration, twice);
    panel.click_text("Back to file");
    assert_eq!(panel.calibration, samples::calibration());
    panel.press(Key::Z, Modifiers::COMMAND);
    assert_eq!(panel.calibration, twice, "also the way back to the file can be taken back");
}

#[test]
fn a_button_sets_the_resolution_and_a_dragged_slider_is_one_step() {
    let mut panel = Calibrating::of(samples::calibration());
    panel.click_text("32 × 24");
    assert_eq!(panel.calibration.settings.resolution, Resolution::Half);
    let row = panel.frame(Vec::new()).place_of("gain");
    let mut at = pos2(row.left() + 120.0, row.center().y);
    panel.frame(vec![Event::PointerMoved(at)]);
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    panel.frame(vec![button(at, true)]);
    for _ in 0..5 {
        at.x += 8.0;
        panel.frame(vec![Event::PointerMoved(at)]);
    }
    panel.frame(vec![button(at, false)]);
    panel.frame(Vec::new());
    let gain = panel.calibration.settings.gain;
    assert!(gain != 1.0 && panel.wishes.len() > 3, "{gain} {:?}", panel.wishes);
    panel.press(Key::Z, Modifiers::COMMAND);
    assert_eq!(panel.calibration.settings.gain, 1.0);
    assert_eq!(panel.calibration.settings.resolution, Resolution::Half);
}

#[test]
fn a_calibration_is_saved_under_the_name_that_is_typed() {
    let mut panel = Calibrating::of(samples::calibration());
    panel.click_text("Save");
    assert_eq!(panel.wishes, [CalibrationWish::Save("hall".into())]);
    panel.click_text("hall");
    panel.press(Key::A, Modifiers::COMMAND);
    panel.frame(vec![Event::Text("mine".into())]);
    panel.click_text("Save");
    assert_eq!(panel.wishes.last(), Some(&CalibrationWish::Save("mine".into())));
}
