//! Kicks: how many were tried, and what became of them, told from the motion of the ball.

use bevy::prelude::*;
use serde::Serialize;
use smallvec::SmallVec;

use super::play_tick::PlayTick;
use crate::ids::{PlayerNumber, Team};

/// The kicks of a team. Those that are neither struck nor missed were broken off or go on.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct KickFigures {
    /// Kicks that began.
    pub tried: u32,
    /// Kicks that sent the ball off: at the strike its velocity changed by more than [`STRUCK`].
    pub struck: u32,
    /// Kicks that did not.
    pub missed: u32,
    /// The tick at which each robot's last kick ends.
    #[serde(skip)]
    until: SmallVec<[(PlayerNumber, u64); 8]>,
}

/// A strike changes the velocity of the ball by more than this, m/s.
pub const STRUCK: f32 = 0.2;
/// No kick reaches a ball that is farther from the middle of the robot, m.
const REACH: f32 = 0.5;

impl KickFigures {
    /// `ball_before` is the velocity of the ball one tick before.
    pub(super) fn update(&mut self, team: Team, tick: &PlayTick, ball_before: Vec2) {
        let is_sent_off = tick.ball_velocity.distance(ball_before) > STRUCK;
        for player in tick.of(team) {
            let Some(kicking) = player.kicking else { continue };
            if self.note(player.id.number, kicking.until) {
                self.tried += 1;
            }
            if kicking.strikes == tick.tick {
                let is_struck = is_sent_off && player.position.distance(tick.ball) < REACH;
                *(if is_struck { &mut self.struck } else { &mut self.missed }) += 1;
            }
        }
    }

    /// Whether the kick that ends then is another one than the robot's last.
    fn note(&mut self, number: PlayerNumber, until: u64) -> bool {
        match self.until.iter_mut().find(|(known, _)| *known == number) {
            Some(known) => std::mem::replace(&mut known.1, until) != until,
            None => {
                self.until.push((number, until));
                true
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::play_tick::PlayerTick;
    use super::super::play_tick::stage::*;
    use super::*;
    use crate::robot::Kick;
    use crate::robot::handling::Kicking;

    const KICK: Kick =
        Kick { direction: 0.0, run_out: 1.0, run_out_spread: 0.0, spread: 0.0, time: 1.0, from_hold: false };

    /// Kicks of one robot after these, each begun after the last one ended: the ball's velocity after the strike.
    fn after(strikes: &[(f32, f32)]) -> KickFigures {
        let (mut figures, mut tick_now) = (KickFigures::default(), 0);
        for (x, speed) in strikes {
            let kicking = Some(Kicking::begun(KICK, tick_now, 10));
            for _ in 0..10 {
                let struck = tick_now % 10 == 5;
                let ball_velocity = if struck { Vec2::X * *speed } else { Vec2::ZERO };
                let robot = PlayerTick { kicking, ..player(HOME_1, *x, 0.0) };
                let tick = PlayTick { tick: tick_now, ball_velocity, ..tick(&[robot]) };
                figures.update(Team::Home, &tick, Vec2::ZERO);
                tick_now += 1;
            }
        }
        figures
    }

    #[test]
    fn a_kick_that_sends_the_ball_off_is_struck_and_any_other_missed() {
        let figures = after(&[(-0.2, 0.8), (-0.2, 0.1), (-0.2, 1.0)]);
        assert_eq!((figures.tried, figures.struck, figures.missed), (3, 2, 1));
    }

    #[test]
    fn a_ball_that_another_sends_off_far_away_is_not_struck() {
        assert_eq!(after(&[(-0.6, 0.8)]).missed, 1);
    }

    #[test]
    fn a_kick_that_is_broken_off_was_tried() {
        let mut figures = KickFigures::default();
        let robot = PlayerTick { kicking: Some(Kicking::begun(KICK, 0, 10)), ..player(HOME_1, 0.2, 0.0) };
        figures.update(Team::Home, &PlayTick { tick: 1, ..tick(&[robot]) }, Vec2::ZERO);
        figures.update(Team::Home, &PlayTick { tick: 5, ..tick(&[player(HOME_1, 0.2, 0.0)]) }, Vec2::ZERO);
        assert_eq!((figures.tried, figures.struck, figures.missed), (1, 0, 0));
    }
}
