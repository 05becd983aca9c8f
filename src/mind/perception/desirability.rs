//! How desirable a tactical behaviour is, worked out from one robot's beliefs.

use super::{Memory, Perception};
use crate::strategy::Desirability;

impl Perception<'_> {
    /// A degree from 0 to 1. Every part of it is asked, so that memories do not depend on the order of its parts.
    pub fn degree(&self, desirability: &Desirability, memory: &mut Memory) -> f32 {
        match desirability {
            Desirability::Degree(degree) => *degree,
            Desirability::If(feature) => f32::from(self.holds(feature, memory)),
            Desirability::Distance { a, b, full, none } => self
                .distance(a, b, memory)
                .map_or(0.0, |distance| ((none - distance) / (none - full)).clamp(0.0, 1.0)),
            Desirability::Not(of) => 1.0 - self.degree(of, memory),
            Desirability::All(parts) => {
                parts.iter().map(|part| self.degree(part, memory)).fold(1.0, f32::min)
            }
            Desirability::Any(parts) => {
                parts.iter().map(|part| self.degree(part, memory)).fold(0.0, f32::max)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::mind::perception::Memory;
    use crate::mind::perception::fixture::Situation;
    use crate::strategy::Desirability::{self, All, Any, Degree, Distance, If, Not};
    use crate::strategy::language::{Feature, Point};

    fn degree(desirability: Desirability) -> f32 {
        let here = Situation::at(0.0, 0.0, 0.0).ball(1.0, 0.0);
        here.senses().degree(&desirability, &mut Memory::new(0))
    }

    fn to_ball(full: f32, none: f32) -> Desirability {
        Distance { a: Point::Own, b: Point::Ball, full, none }
    }

    #[test]
    fn distance_counts_on_a_straight_line_between_full_and_none_and_either_way() {
        assert_eq!([to_ball(1.5, 2.0), to_ball(0.5, 1.5), to_ball(0.2, 0.9)].map(degree), [1.0, 0.5, 0.0]);
        assert_eq!([to_ball(0.5, 0.0), to_ball(1.25, 0.75), to_ball(2.0, 1.0)].map(degree), [1.0, 0.5, 0.0]);
        let unknown = Distance { a: Point::Own, b: Point::Carrier, full: 9.0, none: 10.0 };
        assert_eq!(degree(unknown), 0.0);
    }

    #[test]
    fn degrees_are_combined_as_in_fuzzy_logic() {
        let known = If(Feature::Known(Point::Ball));
        assert_eq!(degree(known.clone()), 1.0);
        assert_eq!(degree(Not(Box::new(Degree(0.25)))), 0.75);
        assert_eq!(degree(All(vec![known.clone(), Degree(0.3), Degree(0.6)])), 0.3);
        assert_eq!(degree(Any(vec![Not(Box::new(known)), Degree(0.3), Degree(0.6)])), 0.6);
        assert_eq!([All(vec![]), Any(vec![])].map(degree), [1.0, 0.0]);
    }

    #[test]
    fn a_memory_is_asked_whatever_the_other_parts_say() {
        let lasting = Feature::Lasting { what: Box::new(Feature::Always), seconds: 1.0, slot: 0 };
        let parts = All(vec![Degree(0.0), If(lasting.clone())]);
        let mut memory = Memory::new(1);
        let mut here = Situation::at(0.0, 0.0, 0.0);
        assert_eq!(here.senses().degree(&parts, &mut memory), 0.0);
        here.now = 1.0;
        assert_eq!(here.senses().degree(&If(lasting), &mut memory), 1.0);
    }
}
