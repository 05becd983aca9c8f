//! What a person has changed of a camera, step by step, to be taken back and done again. Pure.

use crate::vision::{CameraCalibration, CameraSettings, ColourTable};

/// What can be changed of a running camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraValues {
    /// How it is set.
    pub settings: CameraSettings,
    /// How its pictures are cut.
    pub colours: ColourTable,
}

impl CameraValues {
    /// Those of a calibration.
    pub fn of(calibration: &CameraCalibration) -> CameraValues {
        CameraValues { settings: calibration.settings, colours: calibration.colours.clone() }
    }

    /// A calibration with these values in the place of its own.
    pub fn put_into(self, calibration: &CameraCalibration) -> CameraCalibration {
        let CameraValues { settings, colours } = self;
        CameraCalibration { settings, colours, ..calibration.clone() }
    }
}

/// As many steps as this can be taken back.
const STEPS: usize = 200;

/// The values before each step, and those that were taken back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CalibrationHistory {
    done: Vec<CameraValues>,
    undone: Vec<CameraValues>,
    /// A slider that is dragged is one step.
    held: bool,
}

impl CalibrationHistory {
    /// Takes note of a step by the values before it; `held` while the pointer holds what changes them.
    pub fn step(&mut self, before: CameraValues, held: bool) {
        if !self.held {
            self.done.push(before);
            let surplus = self.done.len().saturating_sub(STEPS);
            self.done.drain(..surplus);
        }
        self.undone.clear();
        self.held = held;
    }

    /// The pointer holds nothing any more: the next change is a new step.
    pub fn let_go(&mut self) {
        self.held = false;
    }

    /// The values before the last step, if there is one.
    pub fn undo(&mut self, now: &CameraValues) -> Option<CameraValues> {
        let before = self.done.pop()?;
        self.undone.push(now.clone());
        Some(before)
    }

    /// The values after the step that was taken back last, if nothing else was changed since.
    pub fn redo(&mut self, now: &CameraValues) -> Option<CameraValues> {
        let after = self.undone.pop()?;
        self.done.push(now.clone());
        Some(after)
    }

    /// How many steps can be taken back.
    pub fn undoable(&self) -> usize {
        self.done.len()
    }

    /// How many steps can be done again.
    pub fn redoable(&self) -> usize {
        self.undone.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(gain: f32) -> CameraValues {
        let settings = CameraSettings { gain, ..CameraSettings::default() };
        CameraValues { settings, colours: ColourTable::default() }
    }

    #[test]
    fn steps_are_taken_back_and_done_again_in_order() {
        let mut history = CalibrationHistory::default();
        history.step(values(1.0), false);
        history.step(values(2.0), false);
        assert_eq!(history.undo(&values(3.0)), Some(values(2.0)));
        assert_eq!(history.undo(&values(2.0)), Some(values(1.0)));
        assert_eq!(history.undo(&values(1.0)), None);
        assert_eq!(history.redo(&values(1.0)), Some(values(2.0)));
        assert_eq!(history.redo(&values(2.0)), Some(values(3.0)));
        assert_eq!(history.redo(&values(3.0)), None);
    }

    #[test]
    fn a_new_step_ends_what_could_be_done_again() {
        let mut history = CalibrationHistory::default();
        history.step(values(1.0), false);
        history.undo(&values(2.0));
        history.step(values(1.0), false);
        assert_eq!((history.undoable(), history.redoable()), (1, 0));
    }

    #[test]
    fn a_slider_that_is_dragged_is_one_step_until_it_is_let_go() {
        let mut history = CalibrationHistory::default();
        for gain in [1.0, 1.1, 1.2] {
            history.step(values(gain), true);
        }
        history.let_go();
        history.step(values(1.3), true);
        assert_eq!(history.undoable(), 2);
        assert_eq!(history.undo(&values(1.4)), Some(values(1.3)));
        assert_eq!(history.undo(&values(1.3)), Some(values(1.0)));
    }

    #[test]
    fn the_oldest_steps_are_forgotten_first() {
        let mut history = CalibrationHistory::default();
        for gain in 0..STEPS + 5 {
            history.step(values(gain as f32), false);
        }
        assert_eq!(history.undoable(), STEPS);
        let first = std::iter::from_fn(|| history.undo(&values(0.0))).last();
        assert_eq!(first, Some(values(5.0)));
    }
}
