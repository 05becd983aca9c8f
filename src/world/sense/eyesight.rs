//! A robot's eyes: their errors, and the frames under way in them.

use std::collections::VecDeque;

use bevy::prelude::*;

use super::localisation::PoseError;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::rng::{Dice, DiceStirred, Seed};
use crate::robot::{Eyes, Frame, Sensing};

/// A robot's eyes, with the errors and the frames that are under way inside them.
#[derive(Component, Clone, Debug)]
pub struct Eyesight {
    pub(super) error: PoseError,
    /// What a script adds to the error, in the pitch frame.
    pub(super) misled: PoseError,
    pub(super) under_way: VecDeque<Frame>,
    pub(super) camera_dice: Dice,
    pub(super) identity_dice: Dice,
    pub(super) localisation_dice: Dice,
}

impl Eyesight {
    /// The camera of a robot that has seen nothing.
    pub fn new(sensing: &Sensing, seed: Seed, robot: RobotId) -> Eyesight {
        let mut localisation_dice = Dice::new(seed, "localisation", Some(robot));
        let error = match &sensing.eyes {
            Eyes::Perfect | Eyes::Images { .. } => PoseError::default(),
            Eyes::Real { localisation, .. } => PoseError::drawn(localisation, &mut localisation_dice),
        };
        Eyesight {
            error,
            misled: PoseError::default(),
            under_way: VecDeque::new(),
            camera_dice: Dice::new(seed, "camera", Some(robot)),
            identity_dice: Dice::new(seed, "identity", Some(robot)),
            localisation_dice,
        }
    }

    /// Forgets the frames under way, as when people carry the robot elsewhere.
    pub(super) fn blink(&mut self) {
        self.under_way.clear();
    }

    pub(super) fn stir(&mut self, stirred: DiceStirred) {
        for dice in [&mut self.camera_dice, &mut self.identity_dice, &mut self.localisation_dice] {
            dice.stir(stirred);
        }
    }

    /// What a robot takes its pose to be that people put down here.
    pub(super) fn put_down(&mut self, truth: Pose, sensing: &Sensing) -> Pose {
        match sensing.eyes {
            Eyes::Perfect => truth,
            _ => PoseError::of_hands(sensing.eyes.put_down(), &mut self.localisation_dice).applied(truth),
        }
    }
}
