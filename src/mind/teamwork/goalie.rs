//! What the goalie tells of itself, and what the others know of it (section VI-C).

use bevy::prelude::*;

use crate::comms::messages::{GoalSide, GoalieBehaviour, GoalieNews};
use crate::geometry::Zone;
use crate::strategy::teamwork::TeamWatch;

/// The goalie's own watch over the border of its penalty area.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BorderWatch {
    is_out: bool,
}

impl BorderWatch {
    /// What there is to tell, given the goalie's place in the team frame: it leaves when it comes out on the ball's account,
    /// and enters when it is back, whatever brings it.
    pub fn update(
        &mut self,
        own: Vec2,
        area: Zone,
        acquires: bool,
        watch: &TeamWatch,
    ) -> Option<(GoalieBehaviour, GoalSide)> {
        let behaviour = match self.is_out {
            false if acquires && !area.grown(watch.border).contains(own) => GoalieBehaviour::Leaving,
            true if area.contains(own) => GoalieBehaviour::Entering,
            _ => return None,
        };
        self.is_out = behaviour == GoalieBehaviour::Leaving;
        Some((behaviour, side(own, watch.centre)))
    }
}

/// Which side of the goal a place is on, if it is farther from the middle than `centre` metres.
fn side(own: Vec2, centre: f32) -> GoalSide {
    match own.y {
        y if y > centre => GoalSide::Left,
        y if y < -centre => GoalSide::Right,
        _ => GoalSide::Centre,
    }
}

/// What a robot knows of its goalie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GoalieWhereabouts {
    /// Whether it is believed to be outside its area.
    pub is_out: bool,
    /// The side by which it crossed the border last.
    pub side: Option<GoalSide>,
    /// Milliseconds on the goalie's clock.
    time: u32,
    /// The tick in which it was heard or seen.
    heard: u64,
}

impl GoalieWhereabouts {
    /// Takes note of a goalie message, unless a later one came earlier.
    pub fn hear(&mut self, news: &GoalieNews, tick: u64) {
        if news.time < self.time {
            return;
        }
        *self = GoalieWhereabouts {
            is_out: news.behaviour == GoalieBehaviour::Leaving,
            side: Some(news.side),
            time: news.time,
            heard: tick,
        };
    }

    /// Takes note of a goalie that was seen to have crossed the border at a place.
    pub(super) fn crossed(&mut self, at: Vec2, is_out: bool, watch: &TeamWatch, tick: u64) {
        (self.is_out, self.side, self.heard) = (is_out, Some(side(at, watch.centre)), tick);
    }

    /// A goalie that left this many ticks ago and was not heard since is taken to be back: its message may have been lost.
    pub fn forget(&mut self, tick: u64, memory: u64) {
        self.is_out &= tick.saturating_sub(self.heard) <= memory;
    }

    /// The y coordinate, m, so far from the middle on the side away from where the goalie crossed last.
    pub fn away(&self, y: f32, own: Vec2) -> f32 {
        match self.side {
            Some(GoalSide::Left) => -y,
            Some(GoalSide::Right) => y,
            Some(GoalSide::Centre) | None => y.copysign(own.y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Zone = Zone { min: Vec2::new(-4.5, -1.5), max: Vec2::new(-3.5, 1.5) };

    #[test]
    fn the_goalie_tells_when_it_leaves_for_the_ball_and_when_it_is_back() {
        let (mut border, watch) = (BorderWatch::default(), TeamWatch::default());
        let mut update = |at: Vec2, acquires| border.update(at, AREA, acquires, &watch);
        assert_eq!(update(Vec2::new(-4.0, 0.0), true), None);
        assert_eq!(update(Vec2::new(-3.45, 1.0), true), None, "on the border");
        let left = update(Vec2::new(-3.3, 1.0), true);
        assert_eq!(left, Some((GoalieBehaviour::Leaving, GoalSide::Left)));
        assert_eq!(update(Vec2::new(-2.0, 1.0), false), None);
        assert_eq!(update(Vec2::new(-3.45, 0.0), false), None, "on the border");
        let entered = update(Vec2::new(-3.6, 0.0), false);
        assert_eq!(entered, Some((GoalieBehaviour::Entering, GoalSide::Centre)));
    }

    #[test]
    fn a_goalie_that_is_carried_out_says_nothing() {
        assert_eq!(BorderWatch::default().update(Vec2::ZERO, AREA, false, &TeamWatch::default()), None);
    }

    fn news(time: u32, behaviour: GoalieBehaviour, side: GoalSide) -> GoalieNews {
        GoalieNews { time, robot: 0, behaviour, side }
    }

    #[test]
    fn overtaken_goalie_news_changes_nothing() {
        let mut known = GoalieWhereabouts::default();
        known.hear(&news(200, GoalieBehaviour::Entering, GoalSide::Left), 12);
        known.hear(&news(100, GoalieBehaviour::Leaving, GoalSide::Right), 14);
        assert!(!known.is_out);
        assert_eq!(known.away(1.2, Vec2::ZERO), -1.2);
    }

    #[test]
    fn a_goalie_of_which_nothing_was_heard_is_taken_to_be_back() {
        let mut known = GoalieWhereabouts::default();
        known.hear(&news(100, GoalieBehaviour::Leaving, GoalSide::Centre), 10);
        known.forget(70, 60);
        assert!(known.is_out);
        known.forget(71, 60);
        assert!(!known.is_out);
        assert_eq!(known.away(1.2, Vec2::new(0.0, -0.3)), -1.2, "at the centre, the robot's own side");
    }
}
