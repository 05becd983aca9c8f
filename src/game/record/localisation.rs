//! Localisation: for how long robots are not where they believe they are, and how soon they know their place again.

use smallvec::SmallVec;

use crate::ids::PlayerNumber;

/// A robot that is farther than this from where it believes it is has lost its place, m. Ours.
const PLACE_LOST: f32 = 0.5;
/// It has found it again when it is nearer than this, m. Ours.
const PLACE_FOUND: f32 = 0.25;

/// How well the robots of a team that play know their places, told from what they believe.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocalisationFigures {
    /// The time of all of them, added up, s.
    pub robots: f64,
    /// Of it, that of those that have lost their place, s.
    pub lost: f64,
    /// How often one found its place again.
    pub recoveries: u32,
    /// How long that took in all, s.
    pub recovering: f64,
    /// Those that have lost their place, and since when, s of play.
    since: SmallVec<[(PlayerNumber, f64); 8]>,
}

impl LocalisationFigures {
    /// The robots that play, and how far each is from where it believes it is, m.
    pub(super) fn update(&mut self, errors: &[(PlayerNumber, f32)], now: f64, dt: f64) {
        self.since.retain(|(lost, _)| errors.iter().any(|(number, _)| number == lost));
        for (number, error) in errors {
            self.robots += dt;
            match self.since.iter().position(|(lost, _)| lost == number) {
                Some(place) if *error < PLACE_FOUND => {
                    self.recoveries += 1;
                    self.recovering += now - self.since.swap_remove(place).1;
                }
                Some(_) => self.lost += dt,
                None if *error > PLACE_LOST => {
                    self.since.push((*number, now));
                    self.lost += dt;
                }
                None => {}
            }
        }
    }

    /// Play is interrupted: people may put robots elsewhere.
    pub(super) fn interrupt(&mut self) {
        self.since.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: PlayerNumber = 1;
    const TWO: PlayerNumber = 2;

    fn after(steps: &[&[(PlayerNumber, f32)]]) -> LocalisationFigures {
        let mut figures = LocalisationFigures::default();
        for (step, errors) in steps.iter().enumerate() {
            figures.update(errors, step as f64, 1.0);
        }
        figures
    }

    #[test]
    fn a_place_is_lost_beyond_the_one_distance_and_found_within_the_other() {
        let figures = after(&[&[(ONE, 0.4)], &[(ONE, 0.6)], &[(ONE, 0.3)], &[(ONE, 0.2)], &[(ONE, 0.4)]]);
        assert_eq!((figures.robots, figures.lost), (5.0, 2.0));
        assert_eq!((figures.recoveries, figures.recovering), (1, 2.0));
    }

    #[test]
    fn each_robot_has_its_own_place_and_who_goes_off_finds_none() {
        let figures = after(&[&[(ONE, 9.0), (TWO, 0.0)], &[(ONE, 9.0)], &[(TWO, 0.0)], &[(ONE, 0.0)]]);
        assert_eq!((figures.robots, figures.lost), (5.0, 2.0));
        assert_eq!(figures.recoveries, 0);
    }

    #[test]
    fn an_interruption_ends_what_goes_on() {
        let mut figures = after(&[&[(ONE, 9.0)]]);
        figures.interrupt();
        figures.update(&[(ONE, 0.1)], 5.0, 1.0);
        assert_eq!(figures.recoveries, 0);
    }
}
