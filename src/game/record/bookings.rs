//! The four requirements on ball booking (TeamChaos, section 4) as the robots themselves have it: for how long each was not met by
//! what their booking machines believe. What they do is in [`super::pursuit`].

use serde::Serialize;

use super::pursuit::PING_PONG;
use super::replacement::Replacement;
use super::span::Span;
use crate::protocol::b3p::Distance;

/// How well a team that books the ball has met the requirements so far, in its own eyes. Times are seconds of play.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BookingFigures {
    /// Requirement 1: a robot that knows the ball was nearer than the one that goes, by more than the threshold.
    pub farther_goes: Span,
    /// Requirement 2: some robot knows the ball, and nobody goes for it.
    pub nobody_goes: Span,
    /// Requirement 3: the ball went from one robot to another and back within [`PING_PONG`].
    pub alternations: u64,
    /// Requirement 4: several go for the ball.
    pub several_go: Span,
    /// How often another robot began to go for the ball.
    pub takeovers: u64,
    /// How soon a booker that was switched off was replaced, while another knew the ball. One that is taken off may say so itself.
    pub replacement: Replacement,
    #[serde(skip)]
    last: [Option<(u8, f64)>; 2],
    /// The robot that alone went for the ball in the tick before.
    #[serde(skip)]
    only: Option<u8>,
}

/// A robot in play that knows where the ball is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BallSeeker {
    pub number: u8,
    /// From the ball, as the robot believes.
    pub distance: Distance,
    pub goes: bool,
}

impl BookingFigures {
    /// The numbers of the robots that are switched off, and those in play that know the ball.
    pub(super) fn update(
        &mut self,
        (off, seekers): (&[u8], &[BallSeeker]),
        threshold: Distance,
        now: f64,
        dt: f64,
    ) {
        let mut going = seekers.iter().filter(|seeker| seeker.goes);
        let first = going.next();
        let several = going.next().is_some();
        let is_nearer = |booker: &BallSeeker| {
            seekers.iter().any(|other| !other.goes && other.distance.is_nearer(threshold, booker.distance))
        };
        self.nobody_goes.update(first.is_none() && !seekers.is_empty(), dt);
        self.several_go.update(several, dt);
        self.farther_goes.update(!several && first.is_some_and(is_nearer), dt);
        let only = first.filter(|_| !several).map(|booker| booker.number);
        self.note_replacement(off, seekers, only.is_some() || several, now);
        self.only = only;
        if let Some(booker) = only {
            self.note_booker(booker, now);
        }
    }

    fn note_replacement(&mut self, off: &[u8], seekers: &[BallSeeker], somebody_goes: bool, now: f64) {
        if seekers.is_empty() {
            return self.replacement.interrupt();
        }
        if self.only.is_some_and(|booker| off.contains(&booker)) {
            self.replacement.miss(now);
        }
        if somebody_goes {
            self.replacement.go(now);
        }
    }

    fn note_booker(&mut self, booker: u8, now: f64) {
        let [before, last] = self.last;
        if last.is_some_and(|(number, _)| number == booker) {
            return;
        }
        self.takeovers += u64::from(last.is_some());
        let is_back = |(number, since): (u8, f64)| number == booker && now - since < PING_PONG;
        // The booker before the last went until the last one began.
        let went_until = before.zip(last).map(|((number, _), (_, until))| (number, until));
        self.alternations += u64::from(went_until.is_some_and(is_back));
        self.last = [last, Some((booker, now))];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const THRESHOLD: Distance = Distance(300);

    fn seeker(number: u8, distance: u32, goes: bool) -> BallSeeker {
        BallSeeker { number, distance: Distance(distance), goes }
    }

    #[test]
    fn each_requirement_has_its_own_time() {
        let mut figures = BookingFigures::default();
        let rounds: [&[BallSeeker]; 4] = [
            &[seeker(1, 900, true), seeker(2, 500, false)],
            &[seeker(1, 900, false), seeker(2, 500, false)],
            &[seeker(1, 900, true), seeker(2, 500, true)],
            &[],
        ];
        for (round, seekers) in rounds.into_iter().enumerate() {
            figures.update((&[], seekers), THRESHOLD, round as f64, 1.0);
        }
        let total = |span: Span| span.total;
        assert_eq!(total(figures.farther_goes), 1.0);
        assert_eq!(total(figures.nobody_goes), 1.0, "a ball that nobody knows is nobody's");
        assert_eq!(total(figures.several_go), 1.0);
    }

    #[test]
    fn a_ball_that_comes_back_soon_has_alternated() {
        let mut figures = BookingFigures::default();
        for (now, number) in [(0.0, 1), (10.0, 2), (12.0, 1), (20.0, 2), (24.0, 1), (24.1, 1)] {
            figures.update((&[], &[seeker(number, 500, true)]), THRESHOLD, now, 0.1);
        }
        assert_eq!((figures.takeovers, figures.alternations), (4, 1));
    }

    /// What is in each tick: who is off, and who knows the ball.
    fn replacement(ticks: &[(&[u8], &[BallSeeker])]) -> Vec<f64> {
        let mut figures = BookingFigures::default();
        for (tick, both) in ticks.iter().enumerate() {
            figures.update(*both, THRESHOLD, tick as f64, 1.0);
        }
        figures.replacement.seconds
    }

    #[test]
    fn a_booker_that_is_switched_off_is_replaced_when_another_goes() {
        let (goes, waits) = (seeker(2, 500, true), seeker(2, 500, false));
        let booker: (&[u8], &[BallSeeker]) = (&[], &[seeker(1, 300, true), waits]);
        let (none, one): (&[u8], &[u8]) = (&[], &[1]);
        assert_eq!(replacement(&[booker, (one, &[waits]), (one, &[waits]), (one, &[goes])]), [2.0]);
        assert_eq!(replacement(&[booker, (one, &[goes])]), [0.0]);
        let not_off = replacement(&[booker, (none, &[waits]), (none, &[goes])]);
        assert!(not_off.is_empty(), "it was not switched off");
        let not_known = replacement(&[booker, (one, &[]), (one, &[goes])]);
        assert!(not_known.is_empty(), "nobody knew the ball");
    }
}
