//! Teamwork on the pitch: a ring in the ball's colour round the robot that claims the ball, a line from each supporter to what it
//! supports, an amber ring round each robot that is locked for a role swap.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::pens::Pens;
use crate::app::inspector::outlines;
use crate::app::view::colours;
use crate::app::view::picture::robots::reach;
use crate::app::view::picture::visuals::BodyVisual;
use crate::app::view::state::{Overlay, Overlays};
use crate::geometry::Attacking;
use crate::ids::RobotId;
use crate::mind::teamwork::{Carrier, Swapping, TeamModel};
use crate::pitch::Pitch;
use crate::robot::{OffPitch, Robot};
use crate::strategy::{Activity, Strategies};
use crate::world::referee::MatchState;

/// Radii of the rings of a claim and of a lock, in reaches of the robot.
const CLAIM: f32 = 1.14;
const LOCK: f32 = 1.28;
/// Dashes of a support, m.
const DASH: f32 = 0.09;

#[derive(QueryData)]
pub(super) struct Mate {
    id: &'static RobotId,
    robot: &'static Robot,
    activity: &'static Activity,
    team_model: &'static TeamModel,
    swapping: Option<&'static Swapping>,
    off_pitch: Has<OffPitch>,
}

/// Whom or what a robot supports.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Supported {
    Carrier,
    OwnGoal,
}

/// What an activity supports, by its name.
fn supported(activity: &str) -> Option<Supported> {
    match activity {
        "support" => Some(Supported::Carrier),
        "enter_goal" | "cover_goal" => Some(Supported::OwnGoal),
        _ => None,
    }
}

pub(super) fn draw(
    overlays: Res<Overlays>,
    (state, strategies, pitch): (Res<MatchState>, Res<Strategies>, Res<Pitch>),
    shown: Query<&BodyVisual>,
    mates: Query<Mate>,
    mut pens: Pens,
) {
    if !overlays.shows(Overlay::Teamwork) {
        return;
    }
    let place_of = |robot: RobotId| {
        shown.iter().find(|shown| shown.robot == Some(robot)).map(|shown| shown.pose.position)
    };
    for mate in mates.iter().filter(|mate| !mate.off_pitch) {
        let Some(at) = place_of(*mate.id) else { continue };
        let works = !mate.robot.health.crashed;
        let reach = reach(&mate.robot.kind);
        if works && mate.team_model.has_ball {
            pens.strong.circle_2d(at, CLAIM * reach, colours::CLAIM).resolution(48);
        }
        if mate.swapping.is_some_and(|swapping| swapping.machine.lock().is_some()) {
            pens.strong.circle_2d(at, LOCK * reach, colours::LOCK).resolution(48);
        }
        let strategy = strategies.of(mate.id.team);
        let activity = strategy.machines.get(mate.activity.machine(strategy));
        let activity = activity.and_then(|machine| machine.states.get(mate.activity.state));
        let goal = match activity.and_then(|activity| supported(&activity.name)).filter(|_| works) {
            Some(Supported::Carrier) => {
                let carrier = mate
                    .team_model
                    .carrier
                    .and_then(Carrier::number)
                    .map(|number| RobotId { number, ..*mate.id });
                carrier.and_then(place_of)
            }
            Some(Supported::OwnGoal) => Some(own_goal(&pitch, state.attacking(mate.id.team))),
            None => None,
        };
        if let Some(goal) = goal {
            draw_support(&mut pens, (at, goal), CLAIM * reach, colours::team_text(mate.id.team));
        }
    }
}

fn own_goal(pitch: &Pitch, ends: Attacking) -> Vec2 {
    ends.turn(-pitch.goal_centre())
}

/// A dashed line with a tip at the robot that it serves; it keeps off both ends.
fn draw_support(pens: &mut Pens, (from, to): (Vec2, Vec2), off: f32, tint: Color) {
    let way = (to - from).normalize_or_zero();
    let (from, to) = (from + off * way, to - off * way);
    if (to - from).dot(way) <= DASH {
        return;
    }
    for (a, b) in outlines::dashed_line(from, to, DASH) {
        pens.strong.line_2d(a, b, tint);
    }
    for side in [1.0, -1.0] {
        pens.strong.line_2d(to, to + off * (side * 0.19 * way.perp() - 0.33 * way), tint);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn supporters_serve_the_carrier_or_their_goal() {
        assert_eq!(supported("support"), Some(Supported::Carrier));
        assert_eq!(supported("cover_goal"), Some(Supported::OwnGoal));
        assert_eq!(supported("push"), None);
    }
}
