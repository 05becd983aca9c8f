//! Ways to make one motor vector of several: the weighted sum of an assemblage, its winner-take-all rival,
//! and the capped sum by which one schema answers to many things at once.
//!
//! Source: Clay's StaticWeightedSum and WinnerTakeAll nodes; the sum is Arkin's motor-schema combination.

use bevy::prelude::*;

/// Σ wᵢ·vᵢ, not limited in length: the pilot limits the speed fraction last (Clay's StaticWeightedSum,
/// Arkin's vector summation). The weights have no unit; zero for no terms.
pub fn weighted_sum(terms: impl IntoIterator<Item = (f32, Vec2)>) -> Vec2 {
    terms.into_iter().fold(Vec2::ZERO, |sum, (weight, vector)| sum + vector * weight)
}

/// The longest of the wᵢ·vᵢ, the first of them in a tie; zero for no terms (Clay's WinnerTakeAll).
pub fn winner_take_all(terms: impl IntoIterator<Item = (f32, Vec2)>) -> Vec2 {
    terms.into_iter().map(|(weight, vector)| vector * weight).fold(Vec2::ZERO, |best, vector| {
        if vector.length_squared() > best.length_squared() { vector } else { best }
    })
}

/// Σ wᵢ·vᵢ / Σ wᵢ: the mean of what several behaviours want, weighted by how desirable each is (the centre of gravity, by which
/// fuzzy behaviours are blended); zero while none is desirable.
pub fn blend(terms: impl IntoIterator<Item = (f32, Vec2)>) -> Vec2 {
    let add = |(sum, weights), (weight, vector): (f32, Vec2)| (sum + vector * weight, weights + weight);
    let (sum, weights) = terms.into_iter().fold((Vec2::ZERO, 0.0), add);
    if weights > 0.0 { sum / weights } else { Vec2::ZERO }
}

/// The sum of the terms; if that is longer than 1 it keeps its direction and takes the length of the longest
/// single term. So many far walls do not add up to one near wall (Clay's rule for attraction and avoidance of
/// a list).
pub fn capped_sum(terms: impl IntoIterator<Item = Vec2>) -> Vec2 {
    let (sum, longest) = sum_and_longest(terms);
    if sum.length() > 1.0 { sum.normalize_or_zero() * longest } else { sum }
}

/// The direction of the sum with the length of the longest single term; zero if the terms cancel (Clay's rule
/// for swirls).
pub fn longest_along_sum(terms: impl IntoIterator<Item = Vec2>) -> Vec2 {
    let (sum, longest) = sum_and_longest(terms);
    sum.normalize_or_zero() * longest
}

fn sum_and_longest(terms: impl IntoIterator<Item = Vec2>) -> (Vec2, f32) {
    terms
        .into_iter()
        .fold((Vec2::ZERO, 0.0_f32), |(sum, longest), term| (sum + term, longest.max(term.length())))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::unit;

    #[test]
    fn a_weighted_sum_scales_each_term_and_is_not_clipped() {
        let sum = weighted_sum([(2.0, Vec2::X), (0.5, Vec2::Y), (-1.0, Vec2::new(0.0, 3.0))]);
        assert_eq!(sum, Vec2::new(2.0, -2.5));
        assert_eq!(weighted_sum([]), Vec2::ZERO);
    }

    #[test]
    fn the_winner_is_the_longest_after_weighting() {
        let terms = [(1.0, Vec2::new(0.9, 0.0)), (-2.0, Vec2::new(0.0, 0.5)), (0.1, Vec2::new(5.0, 0.0))];
        assert_eq!(winner_take_all(terms), Vec2::new(0.0, -1.0));
        assert_eq!(winner_take_all([]), Vec2::ZERO);
    }

    #[test]
    fn a_blend_is_the_mean_by_weight_however_small_the_weights_are() {
        assert_eq!(blend([(0.75, Vec2::X), (0.25, Vec2::Y)]), Vec2::new(0.75, 0.25));
        assert_eq!(blend([(0.001, Vec2::X), (0.0, Vec2::Y)]), Vec2::X);
        assert_eq!(blend([(0.0, Vec2::X)]), Vec2::ZERO);
        assert_eq!(blend([]), Vec2::ZERO);
    }

    #[test]
    fn the_first_wins_a_tie() {
        assert_eq!(winner_take_all([(1.0, Vec2::Y), (1.0, Vec2::X)]), Vec2::Y);
        assert_eq!(winner_take_all([(1.0, Vec2::X), (-1.0, Vec2::Y)]), Vec2::X);
    }

    #[test]
    fn a_capped_sum_of_up_to_one_is_the_plain_sum() {
        let sum = capped_sum([Vec2::new(0.6, 0.0), Vec2::new(0.25, 0.3)]);
        assert!((sum - Vec2::new(0.85, 0.3)).length() < 1e-6, "{sum}");
    }

    #[test]
    fn a_capped_sum_of_more_than_one_has_the_length_of_its_longest_term() {
        let sum = capped_sum([Vec2::new(0.7, 0.0), Vec2::new(0.7, 0.0), Vec2::new(0.0, 0.2)]);
        assert!((sum.length() - 0.7).abs() < 1e-6, "{sum}");
        assert!((sum.y / sum.x - 0.2 / 1.4).abs() < 1e-6, "{sum}");
    }

    #[test]
    fn the_longest_along_the_sum_is_zero_where_the_terms_cancel() {
        assert_eq!(longest_along_sum([Vec2::X, Vec2::NEG_X]), Vec2::ZERO);
        let short = longest_along_sum([Vec2::new(0.3, 0.0), Vec2::new(0.0, 0.4)]);
        assert!((short - Vec2::new(0.6, 0.8) * 0.4).length() < 1e-6, "{short}");
    }

    proptest! {
        #[test]
        fn turning_the_terms_turns_every_combination(
            terms in prop::collection::vec((-2.0f32..2.0, -2.0f32..2.0), 1..6), turn in -3.0f32..3.0,
        ) {
            let terms: Vec<Vec2> = terms.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
            // Off the threshold of the cap and off cancelling terms, where rounding alone decides.
            let length = terms.iter().sum::<Vec2>().length();
            prop_assume!((length - 1.0).abs() > 1e-3 && length > 1e-2);
            let turned = || terms.iter().map(|&v| unit(turn).rotate(v));
            let expected = unit(turn).rotate(capped_sum(terms.iter().copied()));
            prop_assert!((capped_sum(turned()) - expected).length() < 1e-3);
            let expected = unit(turn).rotate(longest_along_sum(terms.iter().copied()));
            prop_assert!((longest_along_sum(turned()) - expected).length() < 1e-3);
        }
    }
}
