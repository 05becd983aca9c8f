//! What a person's hands do to a robot, from keys and from the inspector's levers alike. Pure.

use bevy::prelude::*;

use crate::clock::Clock;
use crate::robot::pilot::Pilot;
use crate::robot::{Kick, KickIntent};

/// What keys or levers say about walking: shares from -1 to 1, ahead and to the left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControlInput {
    /// Shares of the top speed ahead and to the left, -1 to 1.
    pub walk: Vec2,
    /// Share of the fastest turn, -1 to 1, positive to the left.
    pub turn: f32,
    /// Whether the ball is to be held.
    pub hold: bool,
}

/// The levers of the inspector, for the robot that a person drives. Keys go before them.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct ManualControl {
    /// What the person does.
    pub input: ControlInput,
    /// Share of the farthest turn of the head; without it the head looks for the ball itself.
    pub head: Option<f32>,
    /// The kick that is asked for, and until which tick.
    kick: Option<(usize, u64)>,
}

/// How long a kick is asked for after a key or a button was pressed, s of the match.
const PATIENCE: f32 = 0.4;

impl ManualControl {
    /// Asks for a kick, by its index among the robot's own.
    pub fn kick(&mut self, kick: usize, clock: &Clock) {
        self.kick = Some((kick, clock.tick + clock.ticks(PATIENCE)));
    }

    /// The kick that is asked for.
    pub fn kick_asked(&self) -> Option<usize> {
        self.kick.map(|(kick, _)| kick)
    }

    /// Gives up a kick that was asked for too long ago: the ball is not there.
    pub fn let_kick_pass(&mut self, clock: &Clock) {
        self.kick = self.kick.filter(|(_, until)| clock.tick < *until);
    }

    /// The controls with these keys down.
    pub fn with(&self, keys: ControlInput) -> Pilot {
        let first = |key: f32, lever: f32| if key == 0.0 { lever } else { key };
        Pilot {
            throttle: first(keys.walk.x, self.input.walk.x),
            aside: first(keys.walk.y, self.input.walk.y),
            turn: first(keys.turn, self.input.turn),
            head: self.head,
            kick: match self.kick {
                Some((kick, _)) => KickIntent::Kick(kick),
                None if keys.hold || self.input.hold => KickIntent::Hold,
                None => KickIntent::Nothing,
            },
        }
    }
}

/// Kicks that differ by less than this go the same way, degrees.
const SAME_WAY: f32 = 30.0;

/// The kick that goes nearest to a direction in degrees, by its index: of those that go the same way, one that needs the ball
/// held if it is, else one that does not; and of these the farthest.
pub fn aimed(kicks: &[Kick], direction: f32, holding: bool) -> Option<usize> {
    let off = |kick: &Kick| (kick.direction - direction).abs();
    let possible = || kicks.iter().enumerate().filter(|(_, kick)| holding || !kick.from_hold);
    let nearest = possible().map(|(_, kick)| off(kick)).min_by(f32::total_cmp)?;
    possible()
        .filter(|(_, kick)| off(kick) < nearest + SAME_WAY)
        .max_by(|(_, a), (_, b)| a.from_hold.cmp(&b.from_hold).then(a.run_out.total_cmp(&b.run_out)))
        .map(|(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kick(direction: f32, run_out: f32, from_hold: bool) -> Kick {
        Kick { direction, run_out, run_out_spread: 0.0, spread: 0.0, time: 0.5, from_hold }
    }

    #[test]
    fn the_farthest_kick_is_taken_that_is_possible_now() {
        let kicks = [
            kick(0.0, 1.6, false),
            kick(75.0, 1.0, false),
            kick(-75.0, 1.0, false),
            kick(0.0, 0.8, false),
            kick(0.0, 2.2, true),
        ];
        let taken = |direction, holding| aimed(&kicks, direction, holding);
        assert_eq!((taken(0.0, false), taken(0.0, true)), (Some(0), Some(4)));
        assert_eq!((taken(75.0, true), taken(-90.0, false)), (Some(1), Some(2)));
        assert_eq!(aimed(&kicks[4..], 0.0, false), None);
    }

    #[test]
    fn keys_go_before_levers() {
        let control = ManualControl {
            input: ControlInput { walk: Vec2::ONE, turn: 0.5, hold: true },
            ..ManualControl::default()
        };
        let pilot = control.with(ControlInput { walk: Vec2::NEG_X, ..ControlInput::default() });
        assert_eq!((pilot.throttle, pilot.aside, pilot.turn), (-1.0, 1.0, 0.5));
        assert_eq!(pilot.kick, KickIntent::Hold);
    }

    #[test]
    fn a_kick_is_asked_for_until_it_is_too_late() {
        let mut clock = Clock::new(60.0);
        let mut control = ManualControl::default();
        control.kick(2, &clock);
        assert_eq!(control.with(ControlInput::default()).kick, KickIntent::Kick(2));
        clock.tick = 23;
        control.let_kick_pass(&clock);
        assert_eq!(control.kick_asked(), Some(2));
        clock.tick = 24;
        control.let_kick_pass(&clock);
        assert_eq!(control.with(ControlInput::default()).kick, KickIntent::Nothing);
    }
}
