//! Where robots go that leave the ball to a team mate: to "optimal positions in the field" (TeamChaos, section 4, requirement 4).
//! Section 6 leaves their calculation to further work, so it is ours.
//!
//! The places follow from ball, goals, opponents and the team mates that are left. Every robot works them out for all, and the
//! robots are spread over them so that they have the least way in all: robots that believe the same choose different places.
//! All is in metres in the team frame.

use bevy::prelude::*;
use pathfinding::kuhn_munkres::kuhn_munkres_min;
use pathfinding::matrix::Matrix;
use smallvec::SmallVec;

use crate::pitch::Pitch;
use crate::strategy::language::CoverTask;

/// What the places follow from.
#[derive(Clone, Copy, Debug)]
pub struct FieldView<'a> {
    /// The field.
    pub pitch: &'a Pitch,
    /// Where the ball is taken to be.
    pub ball: Vec2,
    /// The team mates, the goalie and the robot at the ball among them, that need no place.
    pub busy: &'a [Vec2],
    /// The opponents.
    pub opponents: &'a [Vec2],
    /// The room that a robot's body needs on each side.
    pub room: f32,
}

/// Of the places of the robots that are left that of one, by its index among them. `None` without tasks or with a wrong index.
pub fn optimal_position(
    view: &FieldView,
    tasks: &[CoverTask],
    robots: &[Vec2],
    index: usize,
) -> Option<Vec2> {
    let places = places(view, tasks, robots)?;
    // The order in which robots are known differs among them, their places do not.
    let mut order: SmallVec<[usize; 8]> = (0..robots.len()).collect();
    order.sort_by(|a, b| {
        let (a, b) = (robots[*a], robots[*b]);
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
    });
    let row = order.iter().position(|robot| *robot == index)?;
    let way = |(row, column): (usize, usize)| millimetres(robots[order[row]].distance(places[column]));
    let (_, columns) = kuhn_munkres_min(&Matrix::from_fn(robots.len(), places.len(), way));
    Some(places[columns[row]])
}

/// The places for so many robots, by importance: one for each task in turn, then more of the last task. `None` without tasks.
pub fn places(view: &FieldView, tasks: &[CoverTask], robots: &[Vec2]) -> Option<SmallVec<[Vec2; 8]>> {
    let last = tasks.last()?;
    let mut taken = SmallVec::<[Vec2; 8]>::new();
    for index in 0..robots.len() {
        let place = match tasks.get(index).unwrap_or(last) {
            CoverTask::ScreenGoal => view.screen(),
            CoverTask::ReceiveRebound => view.rebound(robots),
            CoverTask::CoverSpace => view.space(&taken),
        };
        let fits = |place: Vec2| taken.iter().all(|other| other.distance(place) >= 2.0 * view.room);
        taken.push(if fits(place) { place } else { view.space(&taken) });
    }
    Some(taken)
}

/// Points that are tried along and across the field, an odd number, so that the middle is among them.
const GRID: (u8, u8) = (13, 9);
/// So much free space is worth being nearer to the ball by a metre, m. ASSUMPTION.
const BALL_SIDE: f32 = 0.5;

impl FieldView<'_> {
    /// Half the size of the part of the field in which places are.
    fn half(&self) -> Vec2 {
        (self.pitch.half_size() - self.room).max(Vec2::ZERO)
    }

    /// Half-way between the ball and the own goal, but not in the goalie's area.
    fn screen(&self) -> Vec2 {
        let goal = -self.pitch.goal_centre();
        let half = self.pitch.half_size();
        let way = self.ball.clamp(-half, half) - goal;
        let direction = way.try_normalize().unwrap_or(Vec2::X);
        let distance = (way.length() / 2.0).max(self.way_out(direction));
        (goal + direction * distance).clamp(-self.half(), self.half())
    }

    /// From the middle of the own goal line to where a robot has its whole body outside the penalty area.
    fn way_out(&self, direction: Vec2) -> f32 {
        let area = self.pitch.penalty_area;
        let ahead = (area.depth + self.room) / direction.x.max(f32::EPSILON);
        let aside = (area.width / 2.0 + self.room) / direction.y.abs().max(f32::EPSILON);
        ahead.min(aside)
    }

    /// Before their goal and aside: half-way from the ball to their goal line, no farther than their penalty area, beside the
    /// way of a shot. Of both sides the one across from the ball, free of opponents and near to a robot that is left.
    fn rebound(&self, robots: &[Vec2]) -> Vec2 {
        let (goal, area) = (self.pitch.goal_centre(), self.pitch.penalty_area);
        let x = ((self.ball.x + goal.x) / 2.0).min(goal.x - area.depth - self.room);
        let y = area.width / 2.0 + self.room;
        let spot = |side: f32| Vec2::new(x, side * y).clamp(-self.half(), self.half());
        let worth = |side: f32| {
            let (at, widest) = (spot(side), self.pitch.width / 2.0);
            let freedom = nearest(at, self.opponents.iter()).unwrap_or(widest).min(widest);
            let way = nearest(at, robots.iter()).unwrap_or(0.0);
            freedom - way - side * self.ball.y
        };
        spot(if worth(1.0) >= worth(-1.0) { 1.0 } else { -1.0 })
    }

    /// The place that is farthest from all robots and places that are taken, rather on the ball's side. A place with room beside those that
    /// are taken comes before one without.
    fn space(&self, taken: &[Vec2]) -> Vec2 {
        let half = self.half();
        let share = |step: u8, steps: u8| 2.0 * f32::from(step) / f32::from(steps - 1) - 1.0;
        let points = (0..GRID.0).flat_map(|i| (0..GRID.1).map(move |j| (i, j)));
        let points = points.map(|(i, j)| Vec2::new(share(i, GRID.0), share(j, GRID.1)) * half);
        let goal = -self.pitch.goal_centre();
        let is_free = |at: &Vec2| {
            let from_goal = *at - goal;
            let area = self.pitch.penalty_area;
            from_goal.x >= area.depth + self.room || from_goal.y.abs() >= area.width / 2.0 + self.room
        };
        let worth = |at: &Vec2| {
            let others = self.busy.iter().chain(self.opponents).chain(taken);
            nearest(*at, others).unwrap_or(self.pitch.length) - BALL_SIDE * at.distance(self.ball)
        };
        let has_room = |at: &Vec2| taken.iter().all(|other| other.distance(*at) >= 2.0 * self.room);
        let rated = points.filter(is_free).map(|at| (has_room(&at), worth(&at), at));
        let best = rated.max_by(|(room, a, _), (other_room, b, _)| room.cmp(other_room).then(a.total_cmp(b)));
        best.map_or(Vec2::ZERO, |(.., at)| at)
    }
}

fn nearest<'a>(at: Vec2, others: impl Iterator<Item = &'a Vec2>) -> Option<f32> {
    others.map(|other| other.distance(at)).min_by(f32::total_cmp)
}

/// Whole millimetres, which the assignment can compare exactly.
fn millimetres(metres: f32) -> i64 {
    (metres * 1000.0).round() as i64
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::testing::pitch;

    const ALL: [CoverTask; 3] = [CoverTask::ScreenGoal, CoverTask::ReceiveRebound, CoverTask::CoverSpace];
    const ROOM: f32 = 0.3;

    fn four_legged() -> Pitch {
        let source = include_str!("../../assets/pitches/four_legged_2005.ron");
        crate::data::ron_options().from_str(source).expect("the shipped pitch is sound")
    }

    fn view<'a>(pitch: &'a Pitch, ball: Vec2, opponents: &'a [Vec2]) -> FieldView<'a> {
        FieldView { pitch, ball, busy: &[], opponents, room: ROOM }
    }

    fn all_places(view: &FieldView, robots: &[Vec2]) -> SmallVec<[Vec2; 8]> {
        places(view, &ALL, robots).expect("there are tasks")
    }

    #[test]
    fn one_that_is_left_screens_the_goal_on_the_line_from_the_ball() {
        let pitch = four_legged();
        let ball = Vec2::new(0.9, 1.2);
        let only = all_places(&view(&pitch, ball, &[]), &[Vec2::ZERO])[0];
        let goal = -pitch.goal_centre();
        assert!((only - goal).perp_dot(ball - goal).abs() < 1e-4, "{only} is off the line");
        assert!((only - goal).length() < (ball - goal).length());
    }

    #[test]
    fn the_screen_leaves_the_penalty_area_to_the_goalie() {
        let pitch = four_legged();
        for ball in [(-2.2, 0.0), (-2.6, 0.5), (-2.69, -1.9), (-2.7, 0.0), (-3.4, 0.1)] {
            let place = all_places(&view(&pitch, ball.into(), &[]), &[Vec2::ZERO])[0];
            assert!(!pitch.own_penalty_area().contains(place), "{place} for a ball at {ball:?}");
        }
    }

    #[test]
    fn a_rebound_is_awaited_before_their_goal_across_from_the_ball() {
        let pitch = four_legged();
        let robots = [Vec2::new(-1.0, 0.0), Vec2::new(0.5, 0.0)];
        let place = all_places(&view(&pitch, Vec2::new(2.2, 0.8), &[]), &robots)[1];
        assert!(place.x < 2.05 && place.x > 1.0 && place.y < -0.65, "{place}");
        // On the other side if an opponent has the place.
        let place = all_places(&view(&pitch, Vec2::new(2.2, 0.1), &[place]), &robots)[1];
        assert!(place.y > 0.65, "{place}");
    }

    #[test]
    fn the_third_covers_the_space_that_others_leave_on_the_balls_side() {
        let pitch = four_legged();
        let robots = [Vec2::ZERO, Vec2::X, Vec2::Y];
        let places = all_places(&view(&pitch, Vec2::new(0.0, 1.5), &[]), &robots);
        assert!(places[2].y > 0.5, "{places:?}");
    }

    #[test]
    fn with_fewer_robots_the_later_tasks_are_left_out_and_with_more_the_last_is_repeated() {
        let pitch = four_legged();
        let view = view(&pitch, Vec2::ZERO, &[]);
        let robots = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::NEG_X];
        let four = all_places(&view, &robots);
        assert_eq!(all_places(&view, &robots[..2])[0], four[0]);
        assert_eq!(four.len(), 4);
        assert_eq!(places(&view, &[], &robots), None);
        assert_eq!(optimal_position(&view, &ALL, &robots, 4), None);
    }

    fn place() -> impl Strategy<Value = Vec2> {
        (-2.9f32..2.9, -2.2f32..2.2).prop_map(Vec2::from)
    }

    fn some(most: usize) -> impl Strategy<Value = Vec<Vec2>> {
        prop::collection::vec(place(), 1..=most)
    }

    const MIRROR: Vec2 = Vec2::new(1.0, -1.0);

    fn mirrored(points: &[Vec2]) -> Vec<Vec2> {
        points.iter().map(|point| *point * MIRROR).collect()
    }

    proptest! {
        #[test]
        fn places_are_on_the_pitch_outside_the_own_area_and_apart(
            ball in place(), robots in some(4), opponents in some(4),
        ) {
            for pitch in [four_legged(), pitch()] {
                let places = all_places(&view(&pitch, ball, &opponents), &robots);
                let half = pitch.half_size() - ROOM + 1e-4;
                for (index, place) in places.iter().enumerate() {
                    prop_assert!(place.abs().cmple(half).all(), "{place}");
                    prop_assert!(!pitch.own_penalty_area().contains(*place), "{place}");
                    for other in &places[..index] {
                        prop_assert!(place.distance(*other) >= 2.0 * ROOM, "{places:?}");
                    }
                }
            }
        }

        /// The place that is farthest from everybody else is beside one that is taken.
        #[test]
        fn opponents_all_round_leave_room_between_places(dx in -0.05f32..0.05, dy in -0.05f32..0.05) {
            let opponents = [(2.54, 0.66), (1.37, 1.37), (1.76, 0.62)].map(Vec2::from);
            let pitch = four_legged();
            let ball = Vec2::new(2.03 + dx, 0.99 + dy);
            let places = all_places(&view(&pitch, ball, &opponents), &[Vec2::ZERO; 4]);
            for (index, place) in places.iter().enumerate() {
                prop_assert!(places[..index].iter().all(|other| place.distance(*other) >= 2.0 * ROOM), "{places:?}");
            }
        }

        #[test]
        fn robots_that_believe_the_same_choose_different_places(
            ball in place(), robots in some(4), opponents in some(4), turn in 0usize..4,
        ) {
            let pitch = four_legged();
            let view = view(&pitch, ball, &opponents);
            // Each lists the robots in another order, itself first.
            let chosen: Vec<Vec2> = (0..robots.len()).filter_map(|index| {
                let mut known = robots.clone();
                let own = known.remove(index);
                let shift = turn % known.len().max(1);
                known.rotate_left(shift);
                known.insert(0, own);
                optimal_position(&view, &ALL, &known, 0)
            }).collect();
            prop_assert_eq!(chosen.len(), robots.len());
            for (index, place) in chosen.iter().enumerate() {
                prop_assert!(chosen[..index].iter().all(|other| other.distance(*place) > ROOM), "{:?}", chosen);
            }
        }

        #[test]
        fn a_mirrored_field_has_mirrored_places(ball in place(), robots in some(2), opponents in some(4)) {
            let pitch = four_legged();
            let seen = view(&pitch, ball, &opponents);
            let opponents = mirrored(&opponents);
            let reflected = view(&pitch, ball * MIRROR, &opponents);
            let (places, others) = (all_places(&seen, &robots), all_places(&reflected, &mirrored(&robots)));
            for (place, other) in places.iter().zip(others) {
                prop_assert!((*place * MIRROR).distance(other) < 1e-3, "{place} {other}");
            }
        }

        #[test]
        fn a_ball_that_moves_a_little_moves_the_screen_a_little_and_the_rebound_but_for_its_side(
            ball in place(), by in (-0.02f32..0.02, -0.02f32..0.02), robots in some(2),
        ) {
            let pitch = four_legged();
            let near = all_places(&view(&pitch, ball, &[]), &robots);
            let far = all_places(&view(&pitch, ball + Vec2::from(by), &[]), &robots);
            // A ball beside the goal turns the line to it fast.
            prop_assume!(ball.distance(-pitch.goal_centre()) > 0.5);
            prop_assert!(near[0].distance(far[0]) < 0.2, "{near:?} {far:?}");
            if let (Some(one), Some(other)) = (near.get(1), far.get(1)) {
                prop_assert!((one.abs() - other.abs()).length() < 0.2, "{near:?} {far:?}");
            }
        }
    }
}
