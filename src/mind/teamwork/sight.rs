//! What a robot makes of the team mates that it sees: who has the ball, and whether the goalie is out (section VIII). Markers
//! tell the team and no role.

use bevy::prelude::*;
use smallvec::SmallVec;

use super::goalie::GoalieWhereabouts;
use super::team_model::{Carrier, TeamModel};
use crate::clock::Clock;
use crate::geometry::Zone;
use crate::ids::{RobotId, Team};
use crate::mind::world_model::WorldModel;
use crate::pitch::Pitch;
use crate::protocol::role_swap::RoleIndex;
use crate::robot::Robot;
use crate::strategy::teamwork::{TeamWatch, Teamwork};
use crate::strategy::{Part, Role, Strategies, Strategy};

/// The team mate that a robot sees at the ball: within reach of it, and nearer to it than the robot itself and all others. While
/// the robot knows of no ball, which is often hidden by the one that has it, it is the one that had it.
pub(super) fn carrier_in_sight(
    model: &WorldModel,
    team: &TeamModel,
    of: Team,
    own_area: Zone,
    teamwork: &Teamwork,
) -> Option<Carrier> {
    let nearest = |place: Vec2| {
        let order = |a: &Vec2, b: &Vec2| a.distance(place).total_cmp(&b.distance(place));
        model.of_team(of).min_by(order)
    };
    let at = match (&model.ball, team.carrier) {
        (Some(ball), _) => nearest(ball.position).filter(|at| {
            let gap = at.distance(ball.position);
            gap <= teamwork.watch.control && gap < model.pose.position.distance(ball.position)
        })?,
        (None, Some(Carrier::Seen { at: before, .. })) => {
            nearest(before).filter(|at| at.distance(before) <= teamwork.watch.control)?
        }
        (None, _) => return None,
    };
    let known = model.known_as(at).filter(|_| teamwork.supports_by.hears());
    let role = known.and_then(|number| Some((number, team.roles.of(number)?)));
    Some(match role {
        Some((number, role)) => Carrier::Known(number, role),
        None => Carrier::Seen { at, is_goalie: own_area.contains(at) },
    })
}

impl GoalieWhereabouts {
    /// Takes note of team mates that may be the goalie. One in the area is; one in the goalie's danger zone and outside the
    /// area is, if none is seen within.
    pub(super) fn see(
        &mut self,
        mates: &[Vec2],
        area: Zone,
        danger_zone: Zone,
        watch: &TeamWatch,
        tick: u64,
    ) {
        let is_out = |at: &Vec2| danger_zone.contains(*at) && !area.grown(watch.border).contains(*at);
        let inside = mates.iter().find(|at| area.contains(**at));
        match inside.or_else(|| mates.iter().find(|at| is_out(at))) {
            Some(&at) if inside.is_none() || self.is_out => self.crossed(at, inside.is_none(), watch, tick),
            _ => {}
        }
    }
}

/// Robots that may know by sight whether their goalie is out watch for it.
pub(super) fn watch_goalie(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    mut robots: Query<(&RobotId, &Robot, &Role, &WorldModel, &mut TeamModel)>,
) {
    for (id, robot, role, model, mut team) in &mut robots {
        let strategy = strategies.of(id.team);
        let teamwork = &strategy.teamwork;
        if !robot.decides(&clock) || !teamwork.supports_by.sees() {
            continue;
        }
        let Some((goalie, danger_zone)) = goalie_of(strategy) else { continue };
        if role.0 == usize::from(goalie) {
            continue;
        }
        let team = &mut *team;
        let (roles, hears) = (&team.roles, teamwork.supports_by.hears());
        let may_be_goalie = |at: &Vec2| {
            let known = model.known_as(*at).filter(|_| hears);
            known.and_then(|number| roles.of(number)).is_none_or(|role| role == goalie)
        };
        let mates: SmallVec<[Vec2; 8]> = model.of_team(id.team).filter(may_be_goalie).collect();
        team.goalie.see(&mates, pitch.own_penalty_area(), danger_zone, &teamwork.watch, clock.tick);
    }
}

/// The goalie's role and its zone of control.
fn goalie_of(strategy: &Strategy) -> Option<(RoleIndex, Zone)> {
    let goalie = strategy.teamwork.goalie?;
    match &strategy.roles.get(usize::from(goalie))?.part {
        Part::Plays(play) => Some((goalie, play.danger_zone)),
        Part::ActsAs(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team::Home;
    use crate::mind::perception::fixture::Situation;
    use crate::strategy::teamwork::TeammatesBy;

    const AREA: Zone = Zone { min: Vec2::new(-4.5, -1.5), max: Vec2::new(-3.5, 1.5) };
    const DANGER: Zone = Zone { min: Vec2::new(-6.0, -1.9), max: Vec2::new(-3.1, 1.9) };

    fn carrier(here: &Situation) -> Option<Carrier> {
        carrier_in_sight(&here.model, &here.team_model, Home, AREA, &here.teamwork)
    }

    fn watcher(x: f32, y: f32) -> Situation {
        let mut here = Situation::at(x, y, 0.0);
        here.teamwork.supports_by = TeammatesBy::Sight;
        here.teamwork.goalie = Some(0);
        here
    }

    #[test]
    fn the_mate_that_is_seen_at_the_ball_has_it_and_one_farther_off_has_not() {
        let here = watcher(-1.0, 0.0).ball(1.0, 0.0).robot(Home, 0.7, 0.0);
        assert_eq!(carrier(&here), Some(Carrier::Seen { at: Vec2::new(0.7, 0.0), is_goalie: false }));
        assert_eq!(carrier(&watcher(-1.0, 0.0).ball(1.0, 0.0).robot(Home, 0.3, 0.0)), None);
        assert_eq!(
            carrier(&watcher(0.8, 0.0).ball(1.0, 0.0).robot(Home, 0.7, 0.0)),
            None,
            "it is nearer itself"
        );
        assert_eq!(carrier(&watcher(-1.0, 0.0).robot(Home, 0.7, 0.0)), None, "it knows of no ball");
    }

    #[test]
    fn who_had_the_ball_when_it_was_seen_last_has_it_while_it_is_hidden() {
        let mut here = watcher(-1.0, 0.0).robot(Home, 0.7, 0.0);
        let seen_at = |x: f32| Carrier::Seen { at: Vec2::new(x, 0.0), is_goalie: false };
        here.team_model.carrier = Some(seen_at(0.5));
        assert_eq!(carrier(&here), Some(seen_at(0.7)));
        assert_eq!(carrier(&here.ball(2.0, 0.0)), None, "the ball is seen elsewhere");
    }

    #[test]
    fn who_says_that_it_is_there_is_known_by_name_if_messages_count() {
        let mut here = watcher(-1.0, 0.0).ball(1.0, 0.0).robot(Home, 0.7, 0.0).mate(3, 0.8, 0.1);
        assert!(matches!(carrier(&here), Some(Carrier::Seen { .. })));
        here.teamwork.supports_by = TeammatesBy::MessagesAndSight;
        assert_eq!(carrier(&here), Some(Carrier::Known(3, 3)));
    }

    #[test]
    fn a_carrier_that_is_only_seen_is_the_goalie_where_the_goalie_is_and_else_a_field_player() {
        let teamwork = watcher(0.0, 0.0).teamwork;
        let seen = |is_goalie| Carrier::Seen { at: Vec2::ZERO, is_goalie };
        assert!(seen(false).has_one_of([1, 2], &teamwork) && seen(false).has_one_of([], &teamwork));
        assert!(!seen(true).has_one_of([1, 2], &teamwork) && seen(true).has_one_of([0], &teamwork));
        assert!(Carrier::Known(3, 2).has_one_of([1, 2], &teamwork));
        assert!(!Carrier::Known(3, 3).has_one_of([1, 2], &teamwork));
        assert!(seen(false).outranks(1, &teamwork) && !Carrier::Known(3, 3).outranks(3, &teamwork));
    }

    #[test]
    fn the_goalie_is_out_while_a_mate_is_before_the_area_and_none_within() {
        let (mut known, watch) = (GoalieWhereabouts::default(), TeamWatch::default());
        let mut see = |mates: &[(f32, f32)], tick| {
            let places: Vec<Vec2> = mates.iter().map(|place| Vec2::from(*place)).collect();
            known.see(&places, AREA, DANGER, &watch, tick);
            (known.is_out, known.away(1.0, Vec2::ZERO))
        };
        assert_eq!(see(&[(-3.2, 1.0), (-4.0, 0.0)], 1), (false, 1.0), "another one is in the area");
        assert!(!see(&[(-2.0, 1.0)], 2).0, "that is the halfback's place");
        assert_eq!(see(&[(-3.2, 1.0), (2.0, 0.0)], 3), (true, -1.0));
        assert!(see(&[], 4).0, "nothing was seen of it since");
        assert_eq!(see(&[(-3.6, -1.0)], 5), (false, 1.0), "it is back, on the right");
    }
}
