//! Kicks: how fast a ball leaves and where to, so that it rolls as far as measured kicks did. Pure but for the dice.

use bevy::prelude::*;

use crate::geometry::unit;
use crate::rng::Dice;
use crate::robot::{Kick, Strike};

/// A kick in progress, in ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kicking {
    /// The kick.
    pub kick: Kick,
    /// When the leg or the chest meets the ball.
    pub strikes: u64,
    /// The tick at which it is over.
    pub until: u64,
}

impl Kicking {
    /// A kick that begins in this tick and takes `ticks` in all.
    pub fn begun(kick: Kick, tick: u64, ticks: u64) -> Kicking {
        Kicking { kick, strikes: tick + ticks / 2, until: tick + ticks }
    }
}

/// Shortest run-out of a kick that goes wrong, as a share of the mean.
const WORST: f32 = 0.2;

/// How a kick meets the ball; squarely, if nothing else is said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Glance {
    /// From 0, squarely, to 1, hardly at all.
    pub off: f32,
    /// How far that turns the ball, degrees to the left.
    pub turn: f32,
}

impl Strike {
    /// How a kick meets a ball that is so many metres to the left of the middle; nothing, if it does not.
    pub fn met(&self, aside: f32) -> Option<Glance> {
        let off = ((aside.abs() - self.square) / self.edge).max(0.0);
        (off < 1.0).then(|| Glance { off, turn: self.glance * off * aside.signum() })
    }
}

/// The velocity in m/s, in the robot's frame, of a ball at rest that was kicked: it rolls out as far as drawn if its
/// deceleration is `rolling` m/s². A glancing kick is weaker, goes outwards and scatters up to twice as much.
pub fn launch(kick: &Kick, glance: Glance, rolling: f32, dice: &mut Dice) -> Vec2 {
    let run_out = (kick.run_out + dice.normal(kick.run_out_spread)).max(WORST * kick.run_out);
    let direction = kick.direction + glance.turn + dice.normal(kick.spread * (1.0 + glance.off));
    unit(direction.to_radians()) * (2.0 * rolling * run_out * (1.0 - glance.off)).sqrt()
}

/// The velocity in m/s of a ball that several kicks meet at once, each of which would give it one of these: their mean.
/// Nothing if there is no kick.
pub fn kicked_together(velocities: &[Vec2]) -> Option<Vec2> {
    (!velocities.is_empty()).then(|| velocities.iter().sum::<Vec2>() / velocities.len() as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::angle;
    use crate::rng::Seed;

    const POWER: Kick = Kick {
        direction: 0.0,
        run_out: 2.22,
        run_out_spread: 0.78,
        spread: 14.6,
        time: 1.2,
        from_hold: true,
    };

    #[test]
    fn the_power_kick_launches_at_the_measured_speed() {
        let still = Kick { run_out_spread: 0.0, spread: 0.0, ..POWER };
        let launched = launch(&still, Glance::default(), 0.35, &mut Dice::new(Seed(1), "test", None));
        assert!((launched - Vec2::new(1.2466, 0.0)).length() < 1e-3, "{launched}");
    }

    #[test]
    fn kicks_scatter_as_measured() {
        let mut dice = Dice::new(Seed(2), "test", None);
        let launched: Vec<Vec2> =
            (0..20_000).map(|_| launch(&POWER, Glance::default(), 0.35, &mut dice)).collect();
        let count = launched.len() as f32;
        let run_out = |v: &Vec2| v.length_squared() / 0.7;
        let mean = launched.iter().map(run_out).sum::<f32>() / count;
        assert!((mean - 2.22).abs() < 0.03, "{mean}");
        let spread = (launched.iter().map(|v| angle(*v).powi(2)).sum::<f32>() / count).sqrt().to_degrees();
        assert!((spread - 14.6).abs() < 0.3, "{spread}");
    }

    #[test]
    fn a_kick_that_meets_the_ball_aside_is_weaker_goes_outwards_and_scatters_more() {
        let strike = Strike { square: 0.05, edge: 0.06, glance: 30.0, bumped: 0.5 };
        assert_eq!(strike.met(-0.05), Some(Glance { off: 0.0, turn: 0.0 }));
        assert_eq!((strike.met(0.11), strike.met(-0.2)), (None, None));
        let glance = strike.met(-0.08).unwrap();
        assert!((glance.off - 0.5).abs() < 1e-5 && (glance.turn + 15.0).abs() < 1e-4, "{glance:?}");
        let mut dice = Dice::new(Seed(3), "test", None);
        let launched: Vec<Vec2> = (0..20_000).map(|_| launch(&POWER, glance, 0.35, &mut dice)).collect();
        let count = launched.len() as f32;
        let run_out = launched.iter().map(|v| v.length_squared() / 0.7).sum::<f32>() / count;
        let turn = launched.iter().map(|v| angle(*v)).sum::<f32>() / count;
        let spread = (launched.iter().map(|v| (angle(*v) - turn).powi(2)).sum::<f32>() / count).sqrt();
        assert!((run_out - 1.11).abs() < 0.02, "{run_out}");
        assert!((turn.to_degrees() + 15.0).abs() < 0.7, "{turn}");
        assert!((spread.to_degrees() - 1.5 * 14.6).abs() < 0.5, "{spread}");
    }

    #[test]
    fn a_kick_strikes_half_way() {
        let kicking = Kicking::begun(POWER, 100, 72);
        assert_eq!((kicking.strikes, kicking.until), (136, 172));
    }

    #[test]
    fn two_kicks_at_once_have_their_mean_in_either_order() {
        let (one, other) = (Vec2::new(1.2, 0.1), Vec2::new(-0.8, 0.3));
        assert_eq!(kicked_together(&[one, other]), kicked_together(&[other, one]));
        assert_eq!(kicked_together(&[one, -one]), Some(Vec2::ZERO));
        assert_eq!(kicked_together(&[one]), Some(one));
        assert_eq!(kicked_together(&[]), None);
    }
}
