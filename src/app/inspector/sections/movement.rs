//! Whether the robot moves, and what keeps it where it is if it does not: from the outside in. Pure.

use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::format;
use crate::app::view::picture::labels::off_text;
use crate::robot::{Health, RobotState, SteeringIntent};

/// What is known of a robot that moves or does not.
#[derive(Clone, Debug, PartialEq)]
pub struct Movement {
    /// m/s
    pub speed: f32,
    /// rad/s
    pub turn: f32,
    /// How long it is off the pitch yet.
    pub off: Option<String>,
    pub health: Health,
    /// What the referee told it to be in.
    pub told: RobotState,
    /// Whether the referee lets it stand although the others play.
    pub held: bool,
    pub piloted: bool,
    pub intent: SteeringIntent,
    /// The state of its machine, and what led to it.
    pub state: String,
    pub because: Option<String>,
}

/// A robot that is slower than this stands, m/s, and one that turns more slowly does not turn, rad/s.
const STANDS: f32 = 0.03;
const TURNS: f32 = 0.2;

impl Movement {
    /// That of a robot.
    pub fn of(robot: &SelectedRobot) -> Movement {
        let activity = robot.of.activity;
        let machine = robot.strategy.machines.get(activity.machine(robot.strategy));
        let state = machine.zip(robot.activity()).map(|(machine, state)| machine.path(state));
        let restraints = &robot.state.restraints;
        Movement {
            speed: robot.of.twist.linear.length(),
            turn: robot.of.twist.angular,
            off: robot.of.off_pitch.then(|| off_text(robot.state, robot.id)),
            health: robot.of.robot.health,
            told: robot.of.orders.state,
            held: restraints.holds(robot.id) || restraints.is_frozen(robot.id),
            piloted: robot.of.piloted,
            intent: *robot.of.intent,
            state: state.unwrap_or_else(|| format::UNKNOWN.into()),
            because: activity.history.back().map(|taken| taken.because.clone()),
        }
    }

    /// In one line.
    pub fn in_words(&self) -> String {
        if self.speed >= STANDS {
            return format::speed(self.speed);
        }
        let does = if self.turn.abs() >= TURNS { "turns on the spot" } else { "stands still" };
        format!("{does}: {}", self.reason())
    }

    fn reason(&self) -> String {
        if let Some(off) = &self.off {
            return off.clone();
        }
        match (self.health, self.told) {
            (Health { crashed: true, .. }, _) => return "its computer has crashed".into(),
            (Health { frozen: true, .. }, _) => return "its wheels are off (frozen)".into(),
            (_, RobotState::Initial | RobotState::Set) => return "all stand until the kick-off".into(),
            (_, RobotState::Finished) => return "the match is over".into(),
            (_, RobotState::Penalised) => return "it serves a penalty".into(),
            _ if self.held => return "the referee holds it".into(),
            _ => {}
        }
        match self.intent {
            SteeringIntent::Steer { speed, .. } if speed != 0.0 => {
                "it wants to drive and does not get on".into()
            }
            _ if self.piloted => "your hand rests".into(),
            _ => match &self.because {
                Some(because) if because != "sub-role" => format!("{}, because {because}", self.state),
                _ => format!("so it does in {}", self.state),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::RobotFailure;

    fn still() -> Movement {
        Movement {
            speed: 0.0,
            turn: 0.0,
            off: None,
            health: Health::default(),
            told: RobotState::Playing,
            held: false,
            piloted: false,
            intent: SteeringIntent::Stop,
            state: "track".into(),
            because: Some("ball_known".into()),
        }
    }

    #[test]
    fn what_holds_a_robot_from_outside_comes_before_what_it_wants_itself() {
        let drives = SteeringIntent::Steer { heading: 0.0, facing: 0.0, speed: 0.5 };
        let crashed = Health::default().with(RobotFailure::Frozen).with(RobotFailure::Crashed);
        let frozen = Health::default().with(RobotFailure::Frozen);
        let cases = [
            (still(), "stands still: track, because ball_known"),
            (Movement { because: None, ..still() }, "stands still: so it does in track"),
            (Movement { turn: 1.9, ..still() }, "turns on the spot: track, because ball_known"),
            (Movement { piloted: true, ..still() }, "stands still: your hand rests"),
            (Movement { intent: drives, ..still() }, "stands still: it wants to drive and does not get on"),
            (Movement { held: true, intent: drives, ..still() }, "stands still: the referee holds it"),
            (Movement { told: RobotState::Set, ..still() }, "stands still: all stand until the kick-off"),
            (Movement { health: frozen, held: true, ..still() }, "stands still: its wheels are off (frozen)"),
            (Movement { health: crashed, ..still() }, "stands still: its computer has crashed"),
            (
                Movement { off: Some("off for 7 s".into()), health: crashed, ..still() },
                "stands still: off for 7 s",
            ),
            (Movement { speed: 0.42, health: frozen, ..still() }, "0.42 m/s"),
        ];
        for (movement, words) in cases {
            assert_eq!(movement.in_words(), words);
        }
    }
}
