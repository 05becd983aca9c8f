//! What touching another robot costs: legs lock and wheels lose their traction, more the longer and the harder bodies touch. Pure
//! but for the dice.
//!
//! Teams of the four-legged league tell of it (Quinlan and others, "Traction monitoring for collision detection with legged
//! robots", RoboCup 2003), and nobody has published how much it is. One number, [`ContactCost::left`], scales all of it.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all, ensure};
use crate::ids::RobotId;
use crate::ops;
use crate::rng::{Dice, Seed};

/// What contact with other robots costs a kind of robot, as data.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactCost {
    /// Share of a walker's speed and push, or of the force and grip of wheels, that is left when the robot is wholly
    /// entangled. 1 turns all costs off.
    pub left: f32,
    /// Time constant with which contact entangles, s.
    pub rise: f32,
    /// Impulse that entangles as much as contact does in `rise`, N·s.
    pub blow: f32,
    /// Time constant with which the cost fades after contact, s.
    pub fade: f32,
    /// Error of a walker's turn if nothing were left of its speed, degrees/s.
    #[serde(default)]
    pub stagger: f32,
    /// How it loses its footing; never, if not given.
    #[serde(default)]
    pub falls: Option<Falls>,
}

/// How a walker falls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Falls {
    /// Falls per second of a wholly entangled robot if nothing were left of its speed.
    pub rate: f32,
    /// Shortest and longest time until it stands again, s.
    pub down: (f32, f32),
}

/// A robot that is less entangled than this is free.
const FREE: f32 = 1e-3;

impl ContactCost {
    /// How entangled a robot is after `dt` seconds, from 0 to 1. `impulse` is what it took from other robots in that time, N·s;
    /// nothing, if it touched none.
    pub fn strained(&self, strain: f32, impulse: Option<f32>, dt: f32) -> f32 {
        match impulse {
            Some(impulse) => 1.0 - (1.0 - strain) * ops::exp(-dt / self.rise - impulse / self.blow),
            None if strain < FREE => 0.0,
            None => strain * ops::exp(-dt / self.fade),
        }
    }

    /// The share of speed and push that is taken away.
    fn taken(&self, strain: f32) -> f32 {
        (1.0 - self.left) * strain
    }

    /// The share of speed and push that is there.
    pub fn share(&self, strain: f32) -> f32 {
        1.0 - self.taken(strain)
    }

    /// Standard deviation of the turn's error, degrees/s.
    pub fn turn_error(&self, strain: f32) -> f32 {
        self.stagger * self.taken(strain)
    }

    /// The chance that it falls within `dt` seconds.
    pub fn fall_chance(&self, strain: f32, dt: f32) -> f32 {
        self.falls.map_or(0.0, |falls| falls.rate * self.taken(strain) * dt)
    }
}

/// How a robot stands: how entangled it is with others, and whether it has fallen. Written by the Drive stage.
#[derive(Component, Clone, Debug)]
pub struct Footing {
    /// From 0, free, to 1, wholly entangled.
    pub strain: f32,
    /// The tick in which it stands again, after a fall.
    pub down_until: Option<u64>,
    pub(super) dice: Dice,
}

impl Footing {
    /// A robot that stands free.
    pub fn new(seed: Seed, robot: RobotId) -> Footing {
        Footing { strain: 0.0, down_until: None, dice: Dice::new(seed, "footing", Some(robot)) }
    }

    /// Whether it stands on its feet.
    pub fn stands(&self) -> bool {
        self.down_until.is_none()
    }

    /// The robot was put on its feet, away from others.
    pub fn stand(&mut self) {
        (self.strain, self.down_until) = (0.0, None);
    }

    /// How it stands one tick of `dt` seconds later, after it took this impulse from other robots, if it touched any. Returns
    /// whether it fell.
    pub fn keep(&mut self, cost: &ContactCost, impulse: Option<f32>, tick: u64, dt: f32) -> bool {
        self.strain = cost.strained(self.strain, impulse, dt);
        if self.down_until.is_some_and(|until| tick >= until) {
            self.down_until = None;
        }
        let Some(falls) = cost.falls.filter(|_| impulse.is_some() && self.stands()) else { return false };
        if !self.dice.chance(cost.fall_chance(self.strain, dt)) {
            return false;
        }
        let (shortest, longest) = falls.down;
        let down = shortest + (longest - shortest) * self.dice.uniform();
        self.down_until = Some(tick + (down / dt).round() as u64);
        true
    }
}

impl Validate for ContactCost {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("left", self.left, Bound::SHARE),
            ("rise", self.rise, Bound::SECONDS.positive()),
            ("blow", self.blow, Bound::IMPULSE.positive()),
            ("fade", self.fade, Bound::SECONDS.positive()),
            ("stagger", self.stagger, Bound::TURN_RATE),
        ])?;
        self.falls.validate_as("falls")
    }
}

impl Validate for Falls {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("rate", self.rate, Bound::GAIN),
            ("down.0", self.down.0, Bound::SECONDS),
            ("down.1", self.down.1, Bound::SECONDS),
        ])?;
        ensure(self.down.0 <= self.down.1, "down", || "needs two times, the lesser one first".into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    const COST: ContactCost = ContactCost {
        left: 0.3,
        rise: 0.3,
        blow: 1.0,
        fade: 0.3,
        stagger: 20.0,
        falls: Some(Falls { rate: 0.1, down: (3.0, 5.0) }),
    };
    const DT: f32 = 1.0 / 60.0;

    fn strain(from: f32, impulse: Option<f32>, seconds: f32) -> f32 {
        (0..(seconds / DT).round() as u32).fold(from, |strain, _| COST.strained(strain, impulse, DT))
    }

    #[test]
    fn contact_costs_more_the_longer_it_lasts_and_fades_after_it() {
        let (short, long) = (strain(0.0, Some(0.0), 0.1), strain(0.0, Some(0.0), 1.0));
        assert!(short < strain(0.0, Some(0.0), 0.3) && long > 0.95 && long <= 1.0, "{short} {long}");
        assert!((strain(0.0, Some(0.0), 0.3) - 0.632).abs() < 0.01);
        assert!((strain(long, None, 0.3) / long - 0.368).abs() < 0.01);
        assert!(strain(long, None, 3.0) < 1e-3);
    }

    #[test]
    fn a_hard_blow_costs_at_once_what_a_touch_costs_with_time() {
        let blow = COST.strained(0.0, Some(1.0), DT);
        assert!((blow - strain(0.0, Some(0.0), 0.3 + DT)).abs() < 0.01, "{blow}");
        assert!(COST.strained(0.0, Some(0.1), DT) < 0.2);
    }

    #[test]
    fn one_number_scales_all_costs_and_turns_them_off() {
        let free = ContactCost { left: 1.0, ..COST };
        assert_eq!((free.share(1.0), free.turn_error(1.0), free.fall_chance(1.0, DT)), (1.0, 0.0, 0.0));
        assert!((COST.share(1.0) - 0.3).abs() < 1e-6 && COST.share(0.0) == 1.0);
        let milder = ContactCost { left: 0.65, ..COST };
        assert!((milder.turn_error(1.0) - COST.turn_error(1.0) / 2.0).abs() < 1e-5);
        assert!((milder.fall_chance(0.5, DT) - COST.fall_chance(0.5, DT) / 2.0).abs() < 1e-6);
    }

    #[test]
    fn an_entangled_robot_falls_as_often_as_asked_and_gets_up_in_time() {
        let mut footing = Footing::new(Seed(1), RobotId::new(Team::Home, 1));
        let (mut falls, mut standing) = (0, 0u32);
        for tick in 0..2_000_000 {
            let stood = footing.stands();
            if footing.keep(&COST, Some(0.5), tick, DT) {
                falls += 1;
                let down = (footing.down_until.unwrap() - tick) as f32 * DT;
                assert!((2.99..=5.01).contains(&down), "{down}");
            }
            standing += u32::from(stood);
        }
        let rate = falls as f32 / (standing as f32 * DT);
        assert!((rate / 0.07 - 1.0).abs() < 0.1, "{falls} falls, {rate} a second");
    }

    #[test]
    fn nobody_falls_without_contact_and_whoever_is_put_down_stands() {
        let mut footing = Footing::new(Seed(1), RobotId::new(Team::Home, 1));
        assert!((0..100_000).all(|tick| !footing.keep(&COST, None, tick, DT)));
        footing.strain = 1.0;
        footing.down_until = Some(u64::MAX);
        footing.stand();
        assert!(footing.stands() && footing.strain == 0.0);
    }
}
