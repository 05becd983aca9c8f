//! What a person has chosen in the panel, and what they do to the values in one frame. Pure.

use super::history::{CalibrationHistory, CameraValues};
use super::view::CalibrationWish;
use crate::vision::{CameraCalibration, ColourClass};

/// What is chosen in the panel.
#[derive(Clone, Debug)]
pub struct CalibrationPanel {
    /// The class that clicks teach.
    pub class: ColourClass,
    /// Which of the pictures are shown.
    pub shown: [bool; 3],
    /// The name under which to save; that of the robot's own file until another one is typed.
    pub name: Option<String>,
    /// What became of the last wish about a file, and whether it went well.
    pub told: Option<(bool, String)>,
    history: CalibrationHistory,
    whose: String,
}

impl Default for CalibrationPanel {
    fn default() -> CalibrationPanel {
        CalibrationPanel {
            class: ColourClass::Orange,
            shown: [true; 3],
            name: None,
            told: None,
            history: CalibrationHistory::default(),
            whose: String::new(),
        }
    }
}

impl CalibrationPanel {
    /// Looks at a robot. What was done to another one cannot be taken back here.
    pub fn turn_to(&mut self, whose: &str) {
        if self.whose != whose {
            whose.clone_into(&mut self.whose);
            self.history = CalibrationHistory::default();
            (self.name, self.told) = (None, None);
        }
    }

    /// What has been done.
    pub fn history(&self) -> &CalibrationHistory {
        &self.history
    }
}

/// The values in a frame: as they were, and as a person wants them.
#[derive(Clone, Debug)]
pub struct CalibrationEdit {
    before: CameraValues,
    /// As a person wants them.
    pub values: CameraValues,
    /// Whether they come from the history, which takes no note of them then.
    travelled: bool,
}

impl CalibrationEdit {
    /// Nothing is changed yet.
    pub fn new(calibration: &CameraCalibration) -> CalibrationEdit {
        let before = CameraValues::of(calibration);
        CalibrationEdit { values: before.clone(), before, travelled: false }
    }

    /// Takes the last step back.
    pub fn undo(&mut self, panel: &mut CalibrationPanel) {
        self.travel(panel.history.undo(&self.before));
    }

    /// Does again what was taken back last.
    pub fn redo(&mut self, panel: &mut CalibrationPanel) {
        self.travel(panel.history.redo(&self.before));
    }

    fn travel(&mut self, to: Option<CameraValues>) {
        if let Some(values) = to {
            self.values = values;
            self.travelled = true;
        }
    }

    /// What is asked for, of which the history takes note; `held` while the pointer is down.
    pub fn finish(self, panel: &mut CalibrationPanel, held: bool) -> Vec<CalibrationWish> {
        let CalibrationEdit { before, values, travelled } = self;
        if before != values && !travelled {
            panel.history.step(before.clone(), held);
        }
        if !held {
            panel.history.let_go();
        }
        CalibrationWish::between(&before, &values)
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    fn change(panel: &mut CalibrationPanel, calibration: &mut CameraCalibration, gain: f32, held: bool) {
        let mut edit = CalibrationEdit::new(calibration);
        edit.values.settings.gain = gain;
        apply(edit.finish(panel, held), calibration);
    }

    fn apply(wishes: Vec<CalibrationWish>, calibration: &mut CameraCalibration) {
        for wish in wishes {
            match wish {
                CalibrationWish::Camera(settings) => calibration.settings = settings,
                CalibrationWish::Colours(colours) => calibration.colours = colours,
                _ => panic!("nobody wants {wish:?}"),
            }
        }
    }

    #[test]
    fn what_is_changed_is_asked_for_and_can_be_taken_back_and_done_again() {
        let (mut panel, mut calibration) = (CalibrationPanel::default(), samples::calibration());
        let first = calibration.clone();
        change(&mut panel, &mut calibration, 1.5, true);
        change(&mut panel, &mut calibration, 2.0, true);
        assert_eq!(CalibrationEdit::new(&calibration).finish(&mut panel, false), []);
        change(&mut panel, &mut calibration, 3.0, false);
        let last = calibration.clone();
        for expected in [2.0, 1.0] {
            let mut edit = CalibrationEdit::new(&calibration);
            edit.undo(&mut panel);
            apply(edit.finish(&mut panel, false), &mut calibration);
            assert_eq!(calibration.settings.gain, expected);
        }
        assert_eq!(calibration, first);
        for _ in 0..2 {
            let mut edit = CalibrationEdit::new(&calibration);
            edit.redo(&mut panel);
            apply(edit.finish(&mut panel, false), &mut calibration);
        }
        assert_eq!(calibration, last);
    }

    #[test]
    fn the_history_is_that_of_one_robot() {
        let (mut panel, mut calibration) = (CalibrationPanel::default(), samples::calibration());
        panel.turn_to("home 1");
        change(&mut panel, &mut calibration, 1.5, false);
        panel.turn_to("home 1");
        assert_eq!(panel.history().undoable(), 1);
        panel.turn_to("home 2");
        assert_eq!(panel.history().undoable(), 0);
    }
}
