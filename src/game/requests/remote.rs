//! News of robots in other processes: what they want becomes what their bodies in the match do, and what people see of their
//! minds.

use bevy::prelude::*;

use super::queue::Requests;
use super::request::{RemoteNews, Request, RobotWants};
use crate::comms::tcm::MessageBudgets;
use crate::ids::RobotId;
use crate::mind::world_model::{BallBelief, WorldModel};
use crate::robot::{HeadIntent, KickIntent, SteeringIntent};
use crate::strategy::{Activity, Part, Role, Strategies, Strategy};

type RemoteBody<'a> = (
    &'a RobotId,
    &'a mut SteeringIntent,
    &'a mut KickIntent,
    &'a mut HeadIntent,
    &'a mut WorldModel,
    &'a mut Role,
    &'a mut Activity,
);

pub(super) fn hear_remote_robots(
    requests: Res<Requests>,
    strategies: Res<Strategies>,
    mut budgets: Option<ResMut<MessageBudgets>>,
    mut robots: Query<RemoteBody>,
) {
    for request in requests.due() {
        let Request::Remote(robot, news) = request else { continue };
        let Some(body) = robots.iter_mut().find(|(id, ..)| *id == robot) else { continue };
        let (_, mut steering, mut kick, mut head, mut model, mut role, mut activity) = body;
        match news {
            RemoteNews::Silent => {
                (*steering, *kick, *head) =
                    (SteeringIntent::Stop, KickIntent::Nothing, HeadIntent::default());
            }
            RemoteNews::Wants { wants, said } => {
                if let Some(budgets) = &mut budgets {
                    budgets.count(robot.team, *said);
                }
                (*steering, *kick, *head) = (wants.steering, wants.kick, wants.head);
                model.pose = wants.pose;
                let seen = wants.tick;
                model.ball = wants.ball.map(|position| BallBelief { position, velocity: Vec2::ZERO, seen });
                if let Some((known, acting_as, state)) = activity_of(wants, strategies.of(robot.team)) {
                    role.0 = known;
                    if (activity.acting_as, activity.state) != (acting_as, state) {
                        activity.acting_as = acting_as;
                        let strategy = strategies.of(robot.team);
                        let machine = &strategy.machines[activity.machine(strategy)];
                        activity.enter(machine, state, 0, wants.tick);
                    }
                }
            }
        }
    }
}

/// Role, acting role and state that a robot tells, if the strategy has them.
fn activity_of(wants: &RobotWants, strategy: &Strategy) -> Option<(usize, usize, usize)> {
    let (role, acting_as) = (usize::from(wants.role), usize::from(wants.acting_as));
    strategy.roles.get(role)?;
    let Part::Plays(play) = &strategy.roles.get(acting_as)?.part else { return None };
    let state = usize::from(wants.state);
    strategy.machines.get(play.machine)?.states.get(state)?;
    Some((role, acting_as, state))
}
