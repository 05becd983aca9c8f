//! What a picture of a moment gave, beside the truth. Pure.

use crate::geometry::{Sighting, wrap_angle};
use crate::ids::Team;

/// What was recognised of all moments.
#[derive(Clone, Debug, Default)]
pub(super) struct Readings {
    pub balls: Vec<ComparedSighting>,
    pub robots: Vec<ComparedSighting>,
    /// For each picture that does not show the ball as such: whether something else was taken for it.
    pub phantoms: Vec<bool>,
    /// For each robot that was recognised: whether it was taken for one of the other team.
    pub mistaken: Vec<bool>,
}

/// One thing that a camera may have seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct ComparedSighting {
    /// Where it is.
    pub truth: Sighting,
    /// The share of it that is in the field of view and behind nothing, 0 to 1.
    pub visible: f32,
    /// Where it was recognised, if it was.
    pub seen: Option<Sighting>,
}

/// A robot that a camera may have seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct OtherRobot {
    pub team: Team,
    pub truth: Sighting,
    pub visible: f32,
}

/// A sighting farther from a thing than this is of something else: rad beside it, and a share of the range beside a floor in metres.
const SAME: (f32, f32, f32) = (0.17, 0.6, 0.2);

/// Whether a sighting is of a thing that covers this half of an angle, rad.
fn is_of(seen: Sighting, truth: Sighting, half_angle: f32) -> bool {
    let (angle, share, floor) = SAME;
    wrap_angle(seen.bearing - truth.bearing).abs() < angle + half_angle
        && (seen.range - truth.range).abs() < floor + share * truth.range
}

impl Readings {
    /// Takes note of where the ball was, which half of an angle it covers (rad), how much of it was to be seen, and where it was seen.
    pub fn note_ball(&mut self, (truth, half_angle): (Sighting, f32), visible: f32, seen: Option<Sighting>) {
        let own = seen.filter(|seen| is_of(*seen, truth, half_angle));
        self.balls.push(ComparedSighting { truth, visible, seen: own });
        if own.is_none() {
            self.phantoms.push(seen.is_some());
        }
    }

    /// Takes note of where the other robots were and which were seen. Each sighting is of the nearest robot that is not taken yet, of its
    /// own team if there is one.
    pub fn note_robots(&mut self, robots: &[OtherRobot], seen: &[(Team, Sighting)]) {
        let mut matched: Vec<Option<(Team, Sighting)>> = vec![None; robots.len()];
        let mut left = seen.to_vec();
        for takes_other_team in [false, true] {
            left.retain(|&(team, sighting)| {
                let free = robots.iter().enumerate().filter(|(index, robot)| {
                    matched[*index].is_none()
                        && robot.visible > 0.0
                        && is_of(sighting, robot.truth, 0.0)
                        && (takes_other_team || robot.team == team)
                });
                let off = |robot: &OtherRobot| wrap_angle(robot.truth.bearing - sighting.bearing).abs();
                let nearest = free.min_by(|(_, a), (_, b)| off(a).total_cmp(&off(b))).map(|(index, _)| index);
                nearest.into_iter().for_each(|index| matched[index] = Some((team, sighting)));
                nearest.is_none()
            });
        }
        for (robot, matched) in robots.iter().zip(matched) {
            let seen = matched.map(|(_, sighting)| sighting);
            self.robots.push(ComparedSighting { truth: robot.truth, visible: robot.visible, seen });
            self.mistaken.extend(matched.map(|(team, _)| team != robot.team));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team::{Away, Home};

    fn at(range: f32, bearing: f32) -> Sighting {
        Sighting { range, bearing }
    }

    #[test]
    fn a_ball_that_is_seen_elsewhere_is_a_phantom_and_a_miss() {
        let mut readings = Readings::default();
        readings.note_ball((at(2.0, 0.1), 0.05), 1.0, Some(at(2.4, 0.12)));
        readings.note_ball((at(2.0, 0.1), 0.05), 1.0, Some(at(2.0, -0.4)));
        readings.note_ball((at(2.0, 0.1), 0.05), 0.4, None);
        let seen: Vec<bool> = readings.balls.iter().map(|look| look.seen.is_some()).collect();
        assert_eq!((seen, readings.phantoms), (vec![true, false, false], vec![true, false]));
    }

    #[test]
    fn a_near_ball_of_which_a_corner_is_seen_is_no_phantom() {
        let mut readings = Readings::default();
        readings.note_ball((at(0.25, 0.75), 0.45), 0.6, Some(at(0.32, 0.55)));
        assert_eq!(readings.phantoms, [false; 0]);
    }

    #[test]
    fn a_robot_is_of_the_team_that_its_own_marker_says_whatever_else_is_seen_beside_it() {
        let robots = [OtherRobot { team: Away, truth: at(2.0, 0.0), visible: 1.0 }];
        let mut readings = Readings::default();
        readings.note_robots(&robots, &[(Home, at(2.2, 0.02)), (Away, at(2.0, 0.05))]);
        readings.note_robots(&robots, &[(Home, at(2.2, 0.02))]);
        assert_eq!(readings.mistaken, [false, true]);
    }

    #[test]
    fn each_sighting_is_of_one_robot_and_tells_its_team() {
        let robot = |team, bearing, visible| OtherRobot { team, truth: at(1.0, bearing), visible };
        let robots = [robot(Home, 0.0, 1.0), robot(Away, 0.1, 1.0), robot(Away, 0.5, 0.0)];
        let mut readings = Readings::default();
        readings.note_robots(&robots, &[(Home, at(1.1, 0.09)), (Home, at(1.0, 0.01)), (Away, at(1.0, 0.5))]);
        let seen: Vec<bool> = readings.robots.iter().map(|look| look.seen.is_some()).collect();
        assert_eq!(seen, [true, true, false], "who is hidden cannot be seen");
        assert_eq!(readings.mistaken, [false, true]);
    }
}
