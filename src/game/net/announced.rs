//! What is announced of a match: what a referee box would say of it, or what the box says that referees it.

use bevy::prelude::*;

use crate::clock::Clock;
use crate::comms::tcm::MessageBudgets;
use crate::game::record::Record;
use crate::geometry::Attacking;
use crate::ids::{RobotId, Team};
use crate::strategy::{Role, Strategies};
use crate::world::gamecontroller::BoxNews;
use crate::world::gamecontroller::announcement::{MatchAnnouncement, penalty_seconds, whole_seconds};
use crate::world::gamecontroller::control::{Penalty, State};
use crate::world::gamecontroller::referee_box::{BoxView, Penalised};
use crate::world::referee::{
    Decision, DefenderRule, MatchState, Phase, Removal, RemovalReason, RuleBook, Whistles,
};

/// Seconds for which a team has the ball for its kick-off, once it is in play, unless a robot touches it before. Our rules
/// do not ask for that; boxes tell it.
const KICK_OFF: f64 = 10.0;

/// What there is to announce now. Version, packet number and team numbers are the announcer's.
pub(super) fn announcement(world: &mut World) -> MatchAnnouncement {
    let goalkeepers = goalkeepers(world);
    let state = world.resource::<MatchState>();
    let driven = &world.resource::<Record>().driven;
    let budgets = world.get_resource::<MessageBudgets>();
    let view = match world.get_resource::<BoxNews>().and_then(|news| news.view.as_ref()) {
        Some(view) => followed(view, state),
        None => refereed(
            state,
            world.resource::<RuleBook>(),
            world.resource::<Whistles>(),
            world.resource::<Clock>(),
        ),
    };
    MatchAnnouncement {
        view,
        goalkeepers,
        players_per_team: driven.iter().map(|(robot, _)| robot.number + 1).max().unwrap_or(0),
        message_budgets: Team::BOTH.map(|team| budgets.map_or(0, |budgets| budgets.left(team))),
        ..MatchAnnouncement::default()
    }
}

/// The end of a half and the wait for the next, which take no time in our matches: what a box says between the play of
/// the first half and the walk to the places of the second.
pub(super) fn half_time(second: &BoxView) -> [BoxView; 2] {
    let first = BoxView {
        state: State::Finished,
        first_half: true,
        left: 1 - second.left,
        kicking: None,
        seconds_left: 0,
        secondary_time: 0,
        ..second.clone()
    };
    let interval = BoxView { state: State::Initial, secondary_time: 0, ..second.clone() };
    [first, interval]
}

/// Where a match stands that our own referee referees.
fn refereed(state: &MatchState, book: &RuleBook, whistles: &Whistles, clock: &Clock) -> BoxView {
    let kick_off = kick_off_left(state, whistles, clock);
    let owns_ball = match state.phase {
        Phase::Initial | Phase::Ready | Phase::Set => true,
        Phase::Playing => kick_off.is_some(),
        Phase::Finished => false,
    };
    BoxView {
        state: match state.phase {
            Phase::Initial => State::Initial,
            Phase::Ready => State::Ready,
            Phase::Set => State::Set,
            Phase::Playing => State::Playing,
            Phase::Finished => State::Finished,
        },
        first_half: state.half == 1,
        left: left(state),
        kicking: owns_ball.then_some(state.kick_off.index()),
        seconds_left: whole_seconds(state.time_left),
        secondary_time: whole_seconds(state.ready_left(book).or(kick_off).unwrap_or(0.0)),
        score: state.score,
        penalties: penalties(state, |_| true),
        ..BoxView::default()
    }
}

/// Where a match stands that a referee box referees: as the box says. Who was taken off otherwise is told, too.
fn followed(view: &BoxView, state: &MatchState) -> BoxView {
    let mut penalties = penalties(state, |reason| reason != RemovalReason::RefereeBox);
    for (told, by_the_box) in penalties.iter_mut().zip(&view.penalties) {
        told.extend(by_the_box);
    }
    BoxView { left: left(state), penalties, ..view.clone() }
}

/// The robots that are off the field for such a reason, by side.
fn penalties(state: &MatchState, is_told: impl Fn(RemovalReason) -> bool) -> [Vec<Penalised>; 2] {
    Team::BOTH.map(|team| {
        let off =
            state.removed.iter().filter(|removal| removal.robot.team == team && is_told(removal.reason));
        let penalised = |removal: &Removal| Penalised {
            player: removal.robot.number,
            penalty: penalty(removal.reason),
            seconds_left: penalty_seconds(removal.seconds_left),
        };
        off.map(penalised).collect()
    })
}

/// The side that defends the left goal, which is the western one.
fn left(state: &MatchState) -> usize {
    let defends_west = Team::BOTH.into_iter().find(|team| state.attacking(*team) == Attacking::East);
    defends_west.map_or(0, Team::index)
}

/// Seconds that a team has yet for its kick-off, while the ball is in play.
fn kick_off_left(state: &MatchState, whistles: &Whistles, clock: &Clock) -> Option<f64> {
    let begun = |(tick, decision): &(u64, Decision)| {
        (*decision == Decision::PhaseChanged(Phase::Playing)).then_some(*tick)
    };
    let begun = whistles.heard.iter().rev().find_map(begun)?;
    let left = KICK_OFF - clock.tick.saturating_sub(begun) as f64 * f64::from(clock.dt);
    let waits = state.phase == Phase::Playing && state.last_touch.is_none() && left > 0.0;
    waits.then_some(left)
}

/// The league's penalty that comes nearest to a reason of our referee.
fn penalty(reason: RemovalReason) -> Penalty {
    match reason {
        RemovalReason::SecondDefender | RemovalReason::IllegalDefender => Penalty::IllegalPosition,
        RemovalReason::BallHolding => Penalty::BallHolding,
        RemovalReason::Pushing | RemovalReason::GoaliePushing | RemovalReason::Charging => Penalty::Pushing,
        RemovalReason::LeftTheField => Penalty::LeavingTheField,
        RemovalReason::LocalStuck => Penalty::LocalGameStuck,
        RemovalReason::RefereeBox | RemovalReason::Ordered => Penalty::Manual,
    }
}

/// The robots that keep the goals: those that the rules name, if they do, else the first that have the goalie's role now.
fn goalkeepers(world: &mut World) -> [Option<u8>; 2] {
    if world.resource::<RuleBook>().defenders == DefenderRule::KeeperOnly {
        return [Some(RuleBook::KEEPER); 2];
    }
    let mut roles = world.query::<(&RobotId, &Role)>();
    let strategies = world.resource::<Strategies>();
    Team::BOTH.map(|team| {
        let goalie = strategies.of(team).teamwork.goalie.map(usize::from);
        let keeps =
            |(id, role): (&RobotId, &Role)| (id.team == team && Some(role.0) == goalie).then_some(id.number);
        roles.iter(world).filter_map(keeps).min()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::gamecontroller::control::{GamePhase, SetPlay};

    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const AWAY_3: RobotId = RobotId::new(Team::Away, 3);

    fn off(robot: RobotId, reason: RemovalReason, seconds_left: f64) -> Removal {
        Removal { robot, reason, seconds_left }
    }

    /// A match in play for so many ticks since the kick-off of home.
    fn in_play(ticks: u64) -> (MatchState, Whistles, Clock) {
        let state = MatchState::in_play(Team::Home, &RuleBook::default(), true);
        let mut whistles = Whistles::default();
        whistles.heard.push_back((40, Decision::PhaseChanged(Phase::Playing)));
        (state, whistles, Clock { tick: 40 + ticks, ..Clock::default() })
    }

    fn told((state, whistles, clock): &(MatchState, Whistles, Clock)) -> BoxView {
        refereed(state, &RuleBook::default(), whistles, clock)
    }

    #[test]
    fn each_reason_has_its_own_penalty_and_its_seconds() {
        for (reason, penalty) in [
            (RemovalReason::SecondDefender, Penalty::IllegalPosition),
            (RemovalReason::IllegalDefender, Penalty::IllegalPosition),
            (RemovalReason::BallHolding, Penalty::BallHolding),
            (RemovalReason::Pushing, Penalty::Pushing),
            (RemovalReason::GoaliePushing, Penalty::Pushing),
            (RemovalReason::Charging, Penalty::Pushing),
            (RemovalReason::LeftTheField, Penalty::LeavingTheField),
            (RemovalReason::LocalStuck, Penalty::LocalGameStuck),
            (RemovalReason::Ordered, Penalty::Manual),
        ] {
            let mut game = in_play(0);
            game.0.removed = vec![off(AWAY_3, reason, 12.5)];
            let expected = Penalised { player: 3, penalty, seconds_left: 13 };
            assert_eq!(told(&game).penalties, [vec![], vec![expected]], "{reason:?}");
        }
    }

    #[test]
    fn a_team_has_the_ball_for_ten_seconds_after_its_kick_off_or_until_somebody_touches_it() {
        for (ticks, kicking, seconds) in [(0, Some(0), 10), (300, Some(0), 5), (600, None, 0)] {
            let view = told(&in_play(ticks));
            assert_eq!((view.kicking, view.secondary_time), (kicking, seconds), "{ticks}");
        }
        let mut game = in_play(300);
        game.0.last_touch = Some(AWAY_3);
        assert_eq!((told(&game).kicking, told(&game).secondary_time), (None, 0));
    }

    #[test]
    fn the_time_to_walk_is_told_and_nobody_kicks_when_the_match_is_over() {
        let mut game = in_play(0);
        game.0.phase = Phase::Ready;
        let view = told(&game);
        assert_eq!((view.secondary_time, view.kicking), (3, Some(0)));
        game.0.phase = Phase::Set;
        assert_eq!((told(&game).secondary_time, told(&game).kicking), (0, Some(0)));
        game.0.phase = Phase::Finished;
        assert_eq!(told(&game).kicking, None);
    }

    #[test]
    fn the_order_of_the_teams_changes_with_the_ends() {
        let mut game = in_play(0);
        assert_eq!(told(&game).left, Team::Home.index());
        game.0.home_attacks = game.0.home_attacks.reversed();
        assert_eq!(told(&game).left, Team::Away.index());
    }

    #[test]
    fn half_time_is_told_as_the_end_of_one_half_and_the_wait_for_the_other() {
        let mut game = in_play(0);
        (game.0.half, game.0.phase, game.0.kick_off) = (2, Phase::Ready, Team::Away);
        game.0.home_attacks = game.0.home_attacks.reversed();
        let ready = told(&game);
        let [end, wait] = half_time(&ready);
        assert_eq!((end.state, end.first_half, end.left, end.kicking), (State::Finished, true, 0, None));
        assert_eq!((end.seconds_left, wait.seconds_left), (0, 600));
        assert_eq!(
            (wait.state, wait.first_half, wait.left, wait.kicking),
            (State::Initial, false, 1, Some(1))
        );
        assert_eq!((wait.secondary_time, ready.secondary_time), (0, 3));
    }

    #[test]
    fn a_match_under_a_box_is_told_as_the_box_tells_it() {
        let penalised = Penalised { player: 1, penalty: Penalty::MotionInStop, seconds_left: 0 };
        let view = BoxView {
            state: State::Playing,
            game_phase: GamePhase::ExtraTime,
            set_play: SetPlay::CornerKick,
            stopped: true,
            score: [3, 2],
            seconds_left: -4,
            secondary_time: 27,
            penalties: [vec![penalised], vec![]],
            ..BoxView::default()
        };
        let (mut state, ..) = in_play(0);
        state.removed = vec![
            off(HOME_1, RemovalReason::RefereeBox, f64::INFINITY),
            off(AWAY_3, RemovalReason::Ordered, f64::INFINITY),
        ];
        let manual = Penalised { player: 3, penalty: Penalty::Manual, seconds_left: 0 };
        let told = BoxView { penalties: [vec![penalised], vec![manual]], ..view.clone() };
        assert_eq!(followed(&view, &state), told);
    }
}
