//! Whether the places of a strategy for a kick-off can be taken, by these robots on this pitch.

use bevy::prelude::*;

use crate::data::Field;
use crate::geometry::Pose;
use crate::pitch::{BallKind, Pitch};
use crate::robot::RobotKind;
use crate::strategy::KickOff;
use crate::world::physics::Footprint;

/// What stands on the pitch at a kick-off; a strategy by itself knows of no ball.
pub(super) struct LineUp {
    robot: Footprint,
    ball: Option<Footprint>,
    walls: Footprint,
    pitch: Pitch,
}

impl LineUp {
    pub(super) fn new(kind: &RobotKind, ball: Option<&BallKind>, pitch: &Pitch) -> LineUp {
        LineUp {
            robot: Footprint::of_robot(kind),
            ball: ball.map(Footprint::of_ball),
            walls: Footprint::of_walls(pitch),
            pitch: pitch.clone(),
        }
    }

    /// The first place on which a robot cannot stand, and why.
    pub(super) fn fault(&self, kick_off: &KickOff) -> Option<(Field, String)> {
        let sides = [("ours", &kick_off.ours), ("theirs", &kick_off.theirs)];
        sides.into_iter().find_map(|(side, places)| {
            let at = Field::root().key("kick_off").key(side);
            let faults = (0..places.len()).map(|i| (i, self.obstacle(i, places, &at)));
            faults.into_iter().find_map(|(i, obstacle)| {
                let place = places[i];
                Some((at.index(i), format!("a robot at ({}, {}) {}", place.x, place.y, obstacle?)))
            })
        })
    }

    fn obstacle(&self, i: usize, places: &[Vec2], at: &Field) -> Option<String> {
        let own = standing(places[i]);
        if !self.pitch.holds(own.position, 0.0) {
            return Some("would not stand on the pitch".into());
        }
        if self.robot.overlaps(own, &self.walls, Pose::default()) {
            return Some("would stand in a wall".into());
        }
        let in_ball = |ball: &Footprint| self.robot.overlaps(own, ball, Pose::default());
        if self.ball.as_ref().is_some_and(in_ball) {
            return Some("would stand in the ball".into());
        }
        if own.position.x + self.robot.front() > 0.0 {
            return Some("would reach into the wrong half".into());
        }
        let taken = |other: &usize| self.robot.overlaps(own, &self.robot, standing(places[*other]));
        (0..i).find(taken).map(|other| {
            let there = places[other];
            format!("would stand in the one at ({}, {}) by {}", there.x, there.y, at.index(other))
        })
    }
}

/// A robot that looks at the opponents' goal.
fn standing(position: Vec2) -> Pose {
    Pose { position, heading: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{BALL, cye, pitch};

    fn fault(theirs: &[(f32, f32)]) -> Option<String> {
        let place = |(x, y): &(f32, f32)| Vec2::new(*x, *y);
        let kick_off =
            KickOff { ours: vec![Vec2::new(-1.0, 0.0)], theirs: theirs.iter().map(place).collect() };
        let fault = LineUp::new(&cye(), Some(&BALL), &pitch()).fault(&kick_off);
        fault.map(|(field, message)| format!("{field}: {message}"))
    }

    #[test]
    fn robots_line_up_apart_in_their_own_half() {
        assert_eq!(fault(&[(-0.3, 0.0), (-4.2, 0.0), (-2.0, 2.2)]), None);
        for (places, expected) in [
            (
                vec![(-1.0, 0.0), (-1.1, 0.3)],
                "[1]: a robot at (-1.1, 0.3) would stand in the one at (-1, 0) by",
            ),
            (vec![(-1.0, 0.0), (-1.0, 0.0)], "by kick_off.theirs[0]"),
            (vec![(-4.2, 1.5)], "[0]: a robot at (-4.2, 1.5) would stand in a wall"),
            (vec![(-1.0, 2.4)], "would stand in a wall"),
            (vec![(-9.0, 0.0)], "would not stand on the pitch"),
            (vec![(-0.2, 0.0)], "would stand in the ball"),
            (vec![(-0.1, 1.0)], "would reach into the wrong half"),
        ] {
            let message = fault(&places).unwrap();
            assert!(message.starts_with("kick_off.theirs[") && message.contains(expected), "{message}");
        }
    }
}
