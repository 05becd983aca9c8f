//! From an assemblage to one vector, by way of the assemblages in it.

use bevy::prelude::*;
use smallvec::SmallVec;

use super::evaluate::evaluate;
use crate::mind::perception::{Memory, Perception};
use crate::mind::schemas::combine::{blend, weighted_sum, winner_take_all};
use crate::rng::Dice;
use crate::strategy::{Assemblage, Combination, Influence, Strategy, Term};

/// What each schema of the running assemblage wants, in the team frame, and the intent that followed.
#[derive(Component, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Component)]
pub struct Contributions {
    /// In the order of the assemblage's terms, unweighted; of an assemblage in it, times how desirable that is.
    pub vectors: Vec<Vec2>,
    /// The combination of all, in the team frame.
    pub sum: Vec2,
}

/// What a robot's assemblages are worked out from.
pub(super) struct Combining<'a> {
    pub strategy: &'a Strategy,
    pub senses: &'a Perception<'a>,
    pub memory: &'a mut Memory,
    pub dice: &'a mut Dice,
}

/// A term's vector and how desirable it is.
type Wanted = (Vec2, f32);

impl Combining<'_> {
    pub(super) fn combine(&mut self, assemblage: &Assemblage) -> Contributions {
        let wanted: SmallVec<[Wanted; 16]> = assemblage.terms.iter().map(|term| self.wanted(term)).collect();
        let terms = || assemblage.terms.iter().zip(&wanted);
        let weighted = terms().map(|(term, (vector, _))| (term.weight, *vector));
        let sum = match assemblage.combination {
            Combination::WeightedSum => weighted_sum(weighted),
            Combination::WinnerTakeAll => winner_take_all(weighted),
            Combination::Blend => {
                blend(terms().map(|(term, (vector, degree))| (term.weight * degree, *vector)))
            }
        };
        Contributions { vectors: wanted.iter().map(|(vector, degree)| *vector * *degree).collect(), sum }
    }

    fn wanted(&mut self, term: &Term) -> Wanted {
        match &term.influence {
            Influence::Schema(schema) => {
                let vector = evaluate(schema, self.senses, self.memory, self.dice);
                (vector.unwrap_or(Vec2::ZERO), 1.0)
            }
            Influence::Assemblage { index, desirability } => {
                let degree = self.senses.degree(desirability, self.memory);
                (self.combine(&self.strategy.assemblages[*index]).sum, degree)
            }
        }
    }
}
