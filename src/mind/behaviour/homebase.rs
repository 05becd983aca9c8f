//! Which of its homebases a robot goes back to (section V-B).
//!
//! One from which it has just looked around for the ball in vain is none to go back to: it tries the others, one by one.

use crate::strategy::Searched;
use bevy::prelude::*;

use crate::mind::perception::Perception;
use crate::strategy::teamwork::Mechanism;
use crate::strategy::{HomebaseRule, Play, State, Turn};

/// A robot keeps its present homebase unless another is better by this much, m.
const LOYALTY: f32 = 0.3;

/// A robot that has spun so far has looked around, rad: with the width of its view, once around.
const LOOKED_AROUND: f32 = 5.2;
/// Nearer to a homebase than this a robot looks around from there, m.
const THERE: f32 = 1.0;

/// Takes note that the robot has looked around from a homebase; forgets all when it knows the ball, and all but the latest
/// when it has tried every one.
pub(super) fn note_search(play: &Play, state: &State, searched: &mut Searched, senses: &Perception) {
    if senses.model.ball.is_some() {
        searched.clear();
        return;
    }
    let Turn::Spin(rate) = state.turn else { return };
    if rate.abs() * senses.time_in_state < LOOKED_AROUND {
        return;
    }
    let own = senses.model.pose.position;
    let Some(here) = nearest(play.homebases.iter().copied(), own, Vec2::NAN) else { return };
    if here.distance(own) > THERE || searched.contains(&here) {
        return;
    }
    searched.push(here);
    if play.homebases.iter().all(|home| searched.contains(home)) {
        searched.retain(|home| *home == here);
    }
}

/// The homebase that the role's rule chooses, given the present one.
pub(super) fn choose(play: &Play, present: Vec2, searched: &[Vec2], senses: &Perception) -> Vec2 {
    let own = senses.model.pose.position;
    let mate = |role| {
        let number = senses.team_model.holder_of(role)?;
        Some(senses.model.mate(number)?.position)
    };
    let rule = if senses.teamwork.has(Mechanism::HomebaseSelection) {
        &play.homebase_rule
    } else {
        &HomebaseRule::Nearest
    };
    let is_left = |home: &Vec2| !searched.contains(home);
    let any_left = play.homebases.iter().any(is_left);
    let all = || play.homebases.iter().copied().filter(|home| !any_left || is_left(home));
    let chosen = match rule {
        HomebaseRule::Nearest => None,
        HomebaseRule::AwayFromGoalie => {
            let away = senses.team_model.goalie.side.map(|_| senses.team_model.goalie.away(1.0, own));
            away.and_then(|side| nearest(all().filter(|home| home.y * side > 0.0), own, present))
        }
        HomebaseRule::FarthestFrom(role) => mate(role.index).and_then(|mate| {
            let gain = |home: &Vec2| home.distance(mate) + loyalty(*home, present);
            all().max_by(|a, b| gain(a).total_cmp(&gain(b)))
        }),
        HomebaseRule::NotNearestOf(role) => mate(role.index).and_then(|mate| {
            let taken = nearest(all(), mate, present);
            nearest(all().filter(|home| Some(*home) != taken), own, present)
        }),
    };
    chosen.or_else(|| nearest(all(), own, present)).unwrap_or(present)
}

fn nearest(homebases: impl Iterator<Item = Vec2>, from: Vec2, present: Vec2) -> Option<Vec2> {
    let cost = |home: &Vec2| home.distance(from) - loyalty(*home, present);
    homebases.min_by(|a, b| cost(a).total_cmp(&cost(b)))
}

fn loyalty(home: Vec2, present: Vec2) -> f32 {
    if home == present { LOYALTY } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comms::messages::{GoalSide, GoalieBehaviour, GoalieNews};
    use crate::mind::perception::fixture::Situation;
    use crate::strategy::RoleRef;

    const HOMES: [Vec2; 3] = [Vec2::new(0.0, 0.0), Vec2::new(2.5, 1.25), Vec2::new(2.5, -1.25)];

    fn play(homebase_rule: HomebaseRule) -> Play {
        Play { machine: 0, danger_zone: Situation::DANGER_ZONE, homebases: HOMES.into(), homebase_rule }
    }

    fn role(index: u8) -> RoleRef {
        RoleRef { name: "mate".into(), index }
    }

    fn situation() -> Situation {
        let mut situation = Situation::at(1.5, 1.0, 0.0).with(Mechanism::HomebaseSelection);
        situation.team_model.goalie.hear(
            &GoalieNews { time: 1, robot: 0, behaviour: GoalieBehaviour::Entering, side: GoalSide::Left },
            1,
        );
        situation.mate(3, 2.0, 1.0)
    }

    #[test]
    fn each_rule_chooses_by_where_the_others_are() {
        let situation = situation();
        let chosen = |rule| choose(&play(rule), Vec2::NAN, &[], &situation.senses());
        assert_eq!(chosen(HomebaseRule::Nearest), HOMES[1]);
        assert_eq!(chosen(HomebaseRule::AwayFromGoalie), HOMES[2], "the goalie entered on the left");
        assert_eq!(chosen(HomebaseRule::FarthestFrom(role(3))), HOMES[2]);
        assert_eq!(chosen(HomebaseRule::NotNearestOf(role(3))), HOMES[0]);
    }

    #[test]
    fn without_the_mechanism_or_without_news_the_nearest_is_chosen() {
        let mut situation = situation();
        situation.model.mates.clear();
        assert_eq!(
            choose(&play(HomebaseRule::FarthestFrom(role(3))), Vec2::NAN, &[], &situation.senses()),
            HOMES[1]
        );
        situation.teamwork.mechanisms = Default::default();
        assert_eq!(
            choose(&play(HomebaseRule::AwayFromGoalie), Vec2::NAN, &[], &situation.senses()),
            HOMES[1]
        );
    }

    fn spinning(rate: f32) -> State {
        State {
            name: "search".into(),
            assemblage: None,
            speed: 1.0,
            reverse: false,
            turn: Turn::Spin(rate),
            acquires: false,
            hold: false,
            kicks: Vec::new(),
            transitions: Vec::new(),
            within: Vec::new(),
        }
    }

    /// Spins for so long at a place and says which homebase it would then go to.
    fn look_around(at: Vec2, seconds: f32, searched: &mut Searched) -> Vec2 {
        let mut situation = Situation::at(at.x, at.y, 0.0);
        situation.time_in_state = seconds;
        let play = play(HomebaseRule::Nearest);
        note_search(&play, &spinning(2.0), searched, &situation.senses());
        choose(&play, at, searched, &situation.senses())
    }

    #[test]
    fn who_looked_around_in_vain_goes_to_a_homebase_that_it_has_not_tried() {
        let mut searched = Searched::new();
        assert_eq!(look_around(HOMES[0], 2.0, &mut searched), HOMES[0], "not yet once around");
        assert_eq!(look_around(HOMES[0], 3.0, &mut searched), HOMES[1]);
        assert_eq!(look_around(HOMES[1], 3.0, &mut searched), HOMES[2], "the only one left");
        assert_ne!(look_around(HOMES[2], 3.0, &mut searched), HOMES[2], "all over again");
        assert_eq!(searched.as_slice(), [HOMES[2]]);
    }

    #[test]
    fn who_looks_around_elsewhere_or_sees_the_ball_has_tried_no_homebase() {
        let mut searched = Searched::new();
        assert_eq!(look_around(Vec2::new(-1.5, 0.0), 9.0, &mut searched), HOMES[0]);
        look_around(HOMES[0], 3.0, &mut searched);
        assert_eq!(searched.len(), 1);
        let seen = Situation::at(0.0, 0.0, 0.0).ball(1.0, 1.0);
        note_search(&play(HomebaseRule::Nearest), &spinning(2.0), &mut searched, &seen.senses());
        assert!(searched.is_empty());
    }
}
