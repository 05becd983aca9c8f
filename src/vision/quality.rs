//! How well a calibration does: what pixels are taken for, against what they show.

use std::ops::AddAssign;

use serde::{Deserialize, Serialize};

use super::colours::ColourClass;

/// Pixels of one class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClassQuality {
    /// They show the class and are taken for it.
    pub hits: u64,
    /// They show the class and are taken for another one, or for none.
    pub missed: u64,
    /// They are taken for the class and do not show it.
    pub false_alarms: u64,
}

impl ClassQuality {
    /// The share of what shows the class that is taken for it; nothing, if nothing shows it.
    pub fn recall(self) -> Option<f32> {
        share(self.hits, self.hits + self.missed)
    }

    /// The share of what is taken for the class that shows it; nothing, if nothing is taken for it.
    pub fn precision(self) -> Option<f32> {
        share(self.hits, self.hits + self.false_alarms)
    }
}

fn share(part: u64, whole: u64) -> Option<f32> {
    (whole > 0).then(|| (part as f64 / whole as f64) as f32)
}

impl AddAssign for ClassQuality {
    fn add_assign(&mut self, other: ClassQuality) {
        self.hits += other.hits;
        self.missed += other.missed;
        self.false_alarms += other.false_alarms;
    }
}

/// Pixels of all classes, of one picture or of many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Quality {
    classes: [ClassQuality; ColourClass::ALL.len()],
    /// Pictures that were counted.
    pub pictures: u64,
}

impl Quality {
    /// Of one picture: for each pixel what it shows, and what it is taken for.
    pub fn of(truth: &[Option<ColourClass>], taken_for: &[Option<ColourClass>]) -> Quality {
        let mut quality = Quality { pictures: 1, ..Quality::default() };
        for (truth, taken) in truth.iter().zip(taken_for) {
            if truth == taken {
                truth.iter().for_each(|class| quality.classes[class.index()].hits += 1);
            } else {
                truth.iter().for_each(|class| quality.classes[class.index()].missed += 1);
                taken.iter().for_each(|class| quality.classes[class.index()].false_alarms += 1);
            }
        }
        quality
    }

    /// Of one class.
    pub fn class(&self, class: ColourClass) -> ClassQuality {
        self.classes[class.index()]
    }
}

impl AddAssign for Quality {
    fn add_assign(&mut self, other: Quality) {
        self.pictures += other.pictures;
        self.classes.iter_mut().zip(other.classes).for_each(|(own, other)| *own += other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_misses_and_false_alarms_add_up_over_pictures() {
        const O: Option<ColourClass> = Some(ColourClass::Orange);
        const R: Option<ColourClass> = Some(ColourClass::Red);
        let mut quality = Quality::of(&[O, O, O, O, R, None], &[O, O, R, None, R, O]);
        assert_eq!(quality.class(ColourClass::Orange), ClassQuality { hits: 2, missed: 2, false_alarms: 1 });
        quality += Quality::of(&[O, R], &[O, R]);
        assert_eq!(quality.pictures, 2);
        let (orange, red) = (quality.class(ColourClass::Orange), quality.class(ColourClass::Red));
        assert_eq!((orange.recall(), orange.precision()), (Some(0.6), Some(0.75)));
        assert_eq!((red.recall(), red.precision()), (Some(1.0), Some(2.0 / 3.0)));
        assert_eq!(quality.class(ColourClass::Pink).recall(), None);
    }
}
