//! Which of its homebases a robot goes back to (section V-B).

use bevy::prelude::*;

use crate::perception::Perception;
use crate::strategy::teamwork::Mechanism;
use crate::strategy::{HomebaseRule, Play};

/// A robot keeps its present homebase unless another is better by this much, m.
const LOYALTY: f32 = 0.3;

/// The homebase that the role's rule chooses, given the present one.
pub(super) fn choose(play: &Play, present: Vec2, senses: &Perception) -> Vec2 {
    let own = senses.model.pose.position;
    let mate = |role| {
        let number = senses.picture.holder_of(role)?;
        Some(senses.model.mate(number)?.position)
    };
    let rule = if senses.teamwork.has(Mechanism::HomebaseSelection) {
        &play.homebase_rule
    } else {
        &HomebaseRule::Nearest
    };
    let all = || play.homebases.iter().copied();
    let chosen = match rule {
        HomebaseRule::Nearest => None,
        HomebaseRule::AwayFromGoalie => {
            let away = senses.picture.goalie.side.map(|_| senses.picture.goalie.away(1.0, own));
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
    use crate::messages::{GoalieBehaviour, GoalieNews, Side};
    use crate::perception::fixture::Situation;
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
        situation.picture.goalie.hear(
            &GoalieNews { time: 1, robot: 0, behaviour: GoalieBehaviour::Entering, side: Side::Left },
            1,
        );
        situation.mate(3, 2.0, 1.0)
    }

    #[test]
    fn each_rule_chooses_by_where_the_others_are() {
        let situation = situation();
        let chosen = |rule| choose(&play(rule), Vec2::NAN, &situation.senses());
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
            choose(&play(HomebaseRule::FarthestFrom(role(3))), Vec2::NAN, &situation.senses()),
            HOMES[1]
        );
        situation.teamwork.mechanisms = Default::default();
        assert_eq!(choose(&play(HomebaseRule::AwayFromGoalie), Vec2::NAN, &situation.senses()), HOMES[1]);
    }
}
