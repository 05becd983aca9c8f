//! Loose balls, which nobody touches, and the teams that win them.

use serde::Serialize;

use super::play_tick::PlayTick;
use crate::ids::Team;

/// Loose balls of a match and what became of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct LooseBalls {
    /// How often nobody had touched the ball for [`LOOSE_AFTER`].
    pub number: u32,
    /// Those that one team touched first, and that no opponent touched within [`WON_AFTER`] from then on; home first.
    pub won: [u32; 2],
    /// Those that both teams touched within that time.
    pub shared: u32,
    /// Those that nobody touched before the referee put the ball elsewhere or play was interrupted.
    pub untouched: u32,
    #[serde(skip)]
    state: BallState,
}

/// A ball is loose when nobody has touched it for so long, s.
pub const LOOSE_AFTER: f64 = 1.0;
/// A loose ball is won by a team that has touched it alone for so long, s.
pub const WON_AFTER: f64 = 1.0;

#[derive(Clone, Copy, Debug, PartialEq)]
enum BallState {
    /// Somebody had it so long ago, s.
    Played {
        ago: f64,
    },
    Loose,
    /// A team has touched it, so long ago, s.
    Touched {
        by: Team,
        ago: f64,
    },
}

impl Default for BallState {
    fn default() -> BallState {
        BallState::Played { ago: 0.0 }
    }
}

impl LooseBalls {
    pub(super) fn update(&mut self, tick: &PlayTick) {
        if tick.ball_is_put {
            return self.interrupt();
        }
        let by = Team::BOTH.map(|team| tick.touches_ball(team));
        self.state = match self.state {
            BallState::Played { .. } if by[0] || by[1] => BallState::Played { ago: 0.0 },
            BallState::Played { ago } if ago + tick.dt < LOOSE_AFTER - ROUNDING => {
                BallState::Played { ago: ago + tick.dt }
            }
            BallState::Played { .. } => {
                self.number += 1;
                BallState::Loose
            }
            BallState::Loose => match by {
                [false, false] => BallState::Loose,
                [true, true] => self.share(),
                [true, false] => BallState::Touched { by: Team::Home, ago: 0.0 },
                [false, true] => BallState::Touched { by: Team::Away, ago: 0.0 },
            },
            BallState::Touched { by: first, .. } if by[first.opponent().index()] => self.share(),
            BallState::Touched { by, ago } if ago + tick.dt < WON_AFTER - ROUNDING => {
                BallState::Touched { by, ago: ago + tick.dt }
            }
            BallState::Touched { by, .. } => self.win(by),
        };
    }

    /// Play is interrupted, or the ball is put elsewhere.
    pub(super) fn interrupt(&mut self) {
        match self.state {
            BallState::Played { .. } => {}
            BallState::Loose => self.untouched += 1,
            BallState::Touched { by, .. } => {
                self.win(by);
            }
        }
        self.state = BallState::default();
    }

    fn share(&mut self) -> BallState {
        self.shared += 1;
        BallState::default()
    }

    fn win(&mut self, team: Team) -> BallState {
        self.won[team.index()] += 1;
        BallState::default()
    }
}

/// A sum of ticks may miss its true value by this, s.
const ROUNDING: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::super::play_tick::stage::*;
    use super::*;
    use crate::ids::RobotId;

    /// What became of loose balls while these robots touched the ball, each for so many tenths of a second.
    fn after(times: &[(&[RobotId], usize)]) -> LooseBalls {
        let (mut loose, mut now) = (LooseBalls::default(), 0.0);
        for (at_ball, tenths) in times {
            let tick = PlayTick { at_ball: (*at_ball).into(), ..tick(&[]) };
            run(&mut now, *tenths, &tick, |tick| loose.update(tick));
        }
        loose
    }

    fn counts(loose: LooseBalls) -> (u32, [u32; 2], u32, u32) {
        (loose.number, loose.won, loose.shared, loose.untouched)
    }

    #[test]
    fn a_ball_is_loose_after_a_second_without_a_touch() {
        assert_eq!(counts(after(&[(&[], 9), (&[HOME_1], 1), (&[], 9)])), (0, [0, 0], 0, 0));
        assert_eq!(counts(after(&[(&[], 10)])), (1, [0, 0], 0, 0));
    }

    #[test]
    fn who_touches_it_first_wins_it_unless_an_opponent_touches_it_within_a_second() {
        let kicked = after(&[(&[], 15), (&[AWAY_1], 1), (&[], 10)]);
        assert_eq!(counts(kicked), (1, [0, 1], 0, 0));
        let fought = after(&[(&[], 15), (&[AWAY_1], 3), (&[], 3), (&[HOME_2], 1)]);
        assert_eq!(counts(fought), (1, [0, 0], 1, 0));
        assert_eq!(counts(after(&[(&[], 15), (&[HOME_1, AWAY_1], 1)])), (1, [0, 0], 1, 0));
    }

    #[test]
    fn a_ball_under_a_chin_is_touched() {
        let holder = super::super::play_tick::PlayerTick { holds: true, ..player(HOME_1, 0.2, 0.0) };
        let (mut loose, mut now) = (LooseBalls::default(), 0.0);
        run(&mut now, 30, &tick(&[holder]), |tick| loose.update(tick));
        assert_eq!(loose.number, 0);
    }

    #[test]
    fn a_whistle_ends_what_is_loose_and_gives_it_to_who_has_touched_it() {
        let mut loose = after(&[(&[], 15)]);
        loose.interrupt();
        assert_eq!(counts(loose), (1, [0, 0], 0, 1));
        let mut loose = after(&[(&[], 15), (&[HOME_1], 2)]);
        loose.update(&PlayTick { ball_is_put: true, at_ball: [AWAY_1].as_slice().into(), ..tick(&[]) });
        assert_eq!(counts(loose), (1, [1, 0], 0, 0));
    }
}
