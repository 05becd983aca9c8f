use super::*;
use crate::geometry::Attacking;
use crate::geometry::Vec2;
use crate::ids::RobotId;
use crate::world::gamecontroller::control::SetPlay;
use crate::world::gamecontroller::control::{GamePhase, Penalty, State};
use crate::world::gamecontroller::referee_box::Penalised;
use crate::world::referee::decision::{PlacementReason, RemovalReason};
use crate::world::referee::rules::table::Table;

const HOME_2: RobotId = RobotId::new(Team::Home, 2);

fn view(state: State) -> BoxView {
    BoxView { state, kicking: Some(1), seconds_left: 600, ..BoxView::default() }
}

/// What is decided at one look at the table.
fn hear(table: &mut Table, view: &BoxView) -> Vec<Decision> {
    look(table, &BoxStatement { view, silence: 0.0, is_lost: false }, 0.02)
}

/// What is decided at one look at the table, so many seconds after the last one.
fn look(table: &mut Table, word: &BoxStatement, dt: f64) -> Vec<Decision> {
    let laws = Laws { pitch: &table.pitch, book: &table.book, ball_radius: 0.11 };
    let mut decisions = Vec::new();
    let observation = Observation::of(table.ball, &table.robots);
    follow(word, &laws, &observation, dt, &mut table.state, &mut decisions);
    for decision in &decisions {
        match decision {
            Decision::RobotRemoved { robot, .. } => table.take_off(*robot),
            Decision::RobotReturned { robot, at } | Decision::RobotPlaced { robot, at } => {
                table.put(*robot, at.position);
            }
            Decision::BallPlaced { at, .. } => table.ball = *at,
            _ => {}
        }
    }
    decisions
}

#[test]
fn the_box_leads_through_the_states_and_chooses_who_kicks_off() {
    let mut table = Table::new(60);
    assert_eq!(hear(&mut table, &view(State::Initial)), []);
    let ready = hear(&mut table, &view(State::Ready));
    assert!(ready.contains(&Decision::RobotsPlaced { kick_off: Some(Team::Away) }), "{ready:?}");
    assert_eq!(hear(&mut table, &view(State::Set)), [Decision::PhaseChanged(Phase::Set)]);
    assert_eq!(hear(&mut table, &view(State::Playing)), [Decision::PhaseChanged(Phase::Playing)]);
    assert_eq!(hear(&mut table, &view(State::Playing)), []);
}

#[test]
fn a_ball_in_the_goal_is_a_goal_when_the_box_says_so_and_not_before() {
    let mut table = Table::new(60);
    for state in [State::Ready, State::Set, State::Playing] {
        hear(&mut table, &view(state));
    }
    table.ball = Vec2::new(4.7, 0.0);
    assert_eq!(hear(&mut table, &view(State::Playing)), []);
    let scored = BoxView { score: [1, 0], ..view(State::Ready) };
    let decisions = hear(&mut table, &scored);
    assert_eq!(decisions[0], Decision::Goal { by: Team::Home, score: [1, 0] });
    assert_eq!(table.state.score, [1, 0]);
}

#[test]
fn a_penalised_robot_is_off_until_the_box_lets_it_back() {
    let mut table = Table::new(60);
    hear(&mut table, &view(State::Playing));
    let mut penalty = view(State::Playing);
    penalty.penalties[0] = vec![Penalised { player: 2, penalty: Penalty::Pushing, seconds_left: 0 }];
    let removed = Decision::RobotRemoved { robot: HOME_2, reason: RemovalReason::RefereeBox };
    assert_eq!(hear(&mut table, &penalty), [removed]);
    assert_eq!(hear(&mut table, &penalty), [], "once");
    assert!(table.state.is_removed(HOME_2));
    let back = hear(&mut table, &view(State::Playing));
    assert!(matches!(back[..], [Decision::RobotReturned { robot: HOME_2, .. }]), "{back:?}");
    assert!(!table.state.is_removed(HOME_2));
}

/// A second half.
fn second(state: State) -> BoxView {
    BoxView { first_half: false, left: 1, ..view(state) }
}

/// With the ball in play.
fn playing() -> Table {
    let mut table = Table::new(60);
    for state in [State::Initial, State::Ready, State::Set, State::Playing] {
        hear(&mut table, &view(state));
    }
    table
}

#[test]
fn halves_and_ends_are_the_boxs_and_may_go_back() {
    let mut table = playing();
    hear(&mut table, &view(State::Finished));
    assert_eq!(table.state.phase, Phase::Initial, "a half is over, not the match");
    let turned = hear(&mut table, &second(State::Initial));
    assert_eq!((table.state.half, table.state.home_attacks), (2, Attacking::West));
    assert!(turned.contains(&Decision::HalfEnded { half: 1 }), "{turned:?}");
    assert!(turned.contains(&Decision::RobotsPlaced { kick_off: Some(Team::Away) }), "at once: {turned:?}");
    assert_eq!(hear(&mut table, &second(State::Initial)), []);
    hear(&mut table, &BoxView { score: [3, 1], ..second(State::Playing) });
    hear(&mut table, &view(State::Initial));
    let state = &table.state;
    assert_eq!((state.half, state.home_attacks, state.score), (1, Attacking::East, [0, 0]), "a new match");
}

#[test]
fn a_match_that_is_joined_in_its_second_half_has_its_ends_and_robots_on_the_pitch() {
    let mut table = Table::new(60);
    let decisions = hear(&mut table, &second(State::Playing));
    assert_eq!((table.state.half, table.state.home_attacks), (2, Attacking::West));
    assert!(decisions.contains(&Decision::RobotsPlaced { kick_off: Some(Team::Away) }), "{decisions:?}");
}

#[test]
fn a_match_goes_on_after_its_second_half_for_as_long_as_the_box_wants() {
    let mut table = playing();
    let level = second(State::Finished);
    let won = BoxView { score: [1, 0], ..level.clone() };
    let run = |table: &mut Table, view: &BoxView, seconds: u32| {
        (0..seconds)
            .for_each(|_| drop(look(table, &BoxStatement { view, silence: 0.5, is_lost: false }, 1.0)));
        table.state.phase
    };
    assert_eq!(run(&mut table, &won, 19), Phase::Initial);
    assert_eq!(run(&mut table, &second(State::Playing), 1), Phase::Playing, "the whistle is taken back");
    assert_eq!(run(&mut table, &level, 200), Phase::Initial, "extra time may come");
    let extra = BoxView { game_phase: GamePhase::ExtraTime, ..view(State::Playing) };
    assert_eq!(run(&mut table, &extra, 1), Phase::Playing);
    assert_eq!((table.state.half, table.state.home_attacks), (1, Attacking::East));
    assert_eq!(run(&mut table, &BoxView { game_phase: GamePhase::ExtraTime, ..won }, 20), Phase::Initial);
    let end =
        look(&mut table, &BoxStatement { view: &second(State::Finished), silence: 0.5, is_lost: false }, 1.0);
    assert_eq!(end, [], "nor has a level match an end");
    let won = BoxView { score: [2, 0], ..level };
    assert_eq!(run(&mut table, &won, 1), Phase::Finished);
    assert!(table.state.following.finished_for > 20.0);
}

#[test]
fn a_box_that_falls_silent_after_the_end_ends_the_match() {
    let mut table = playing();
    let finished = second(State::Finished);
    assert_eq!(
        look(&mut table, &BoxStatement { view: &finished, silence: 4.9, is_lost: true }, 0.1).len(),
        3
    );
    let end = look(&mut table, &BoxStatement { view: &finished, silence: 5.1, is_lost: true }, 0.1);
    assert_eq!(end, [Decision::PhaseChanged(Phase::Finished), Decision::MatchFinished { score: [0, 0] }]);
}

#[test]
fn all_stand_while_play_is_stopped_or_the_box_is_lost_and_the_clock_may_run_over() {
    let mut table = playing();
    hear(&mut table, &BoxView { stopped: true, seconds_left: -3, ..view(State::Playing) });
    assert!(table.state.restraints.stopped && table.state.phase == Phase::Playing);
    assert_eq!((table.state.time_left, table.state.played), (-3.0, 0.0));
    hear(&mut table, &view(State::Playing));
    assert!(!table.state.restraints.stopped && table.state.played > 0.0);
    look(&mut table, &BoxStatement { view: &view(State::Playing), silence: 2.1, is_lost: true }, 0.02);
    assert!(table.state.restraints.stopped);
}

#[test]
fn motion_in_set_freezes_a_robot_and_a_substitute_is_taken_off() {
    let mut table = playing();
    let given = |penalty| {
        let mut view = view(State::Set);
        view.penalties[0] = vec![Penalised { player: 2, penalty, seconds_left: 15 }];
        view
    };
    hear(&mut table, &view(State::Set));
    assert_eq!(hear(&mut table, &given(Penalty::MotionInSet)), []);
    assert_eq!((&table.state.restraints.frozen[..], table.state.is_removed(HOME_2)), (&[HOME_2][..], false));
    let off = hear(&mut table, &given(Penalty::Substitute));
    assert_eq!(off, [Decision::RobotRemoved { robot: HOME_2, reason: RemovalReason::RefereeBox }]);
    assert!(table.state.restraints.frozen.is_empty());
}

#[test]
fn nobody_kicks_off_at_a_dropped_ball() {
    let mut table = playing();
    let decisions = hear(&mut table, &BoxView { kicking: None, ..view(State::Ready) });
    assert!(decisions.contains(&Decision::RobotsPlaced { kick_off: None }), "{decisions:?}");
    assert!(Team::BOTH.iter().all(|team| !table.state.kicks_off(*team)));
    hear(&mut table, &view(State::Playing));
    assert!(table.state.kicks_off(Team::Away));
}

/// A set play of away.
fn set_play(set_play: SetPlay) -> BoxView {
    BoxView { set_play, stopped: true, ..view(State::Playing) }
}

#[test]
fn opponents_are_put_away_from_the_ball_of_a_set_play_and_kept_away() {
    let mut table = playing();
    let spot = Vec2::new(1.0, 0.5);
    table.ball = spot;
    table.put(HOME_2, Vec2::new(0.8, 0.5));
    let decisions = hear(&mut table, &set_play(SetPlay::DirectFreeKick));
    let lies = Decision::BallPlaced { at: spot, reason: PlacementReason::SetPlay };
    assert!(decisions.contains(&lies), "{decisions:?}");
    let least = table.pitch.centre_circle_radius + table.book.spot_clearance;
    assert!(table.place(HOME_2).distance(spot) > least + 0.3, "{}", table.place(HOME_2));
    assert_eq!(hear(&mut table, &set_play(SetPlay::DirectFreeKick)), []);
    table.ball = spot + Vec2::new(0.15, 0.0);
    let pushed = hear(&mut table, &set_play(SetPlay::DirectFreeKick));
    assert!(pushed.contains(&lies), "{pushed:?}");
    let goes_on = BoxView { stopped: false, ..set_play(SetPlay::DirectFreeKick) };
    assert_eq!(hear(&mut table, &goes_on), []);
    assert!(!table.state.restraints.holds(HOME_2));
    let back = spot + (table.place(HOME_2) - spot).normalize() * (least + 0.1);
    table.put(HOME_2, back);
    assert_eq!(hear(&mut table, &goes_on), []);
    assert_eq!(table.state.restraints.held_back, [HOME_2]);
    table.ball = spot + Vec2::new(0.1, -0.5);
    table.put(HOME_2, table.ball);
    assert_eq!(hear(&mut table, &goes_on), [], "the ball is in play");
    hear(&mut table, &view(State::Playing));
    assert_eq!(table.state.restraints.held_back, []);
}

#[test]
fn at_every_set_play_of_every_version_opponents_are_put_away_and_held_and_the_team_that_has_it_is_not() {
    use SetPlay::{CornerKick, DirectFreeKick, GoalKick, IndirectFreeKick, PushingFreeKick, SideLine};
    for play in [CornerKick, DirectFreeKick, GoalKick, IndirectFreeKick, PushingFreeKick, SideLine] {
        let mut table = playing();
        table.ball = Vec2::new(0.5, -1.0);
        let kicker = RobotId::new(Team::Away, 2);
        table.put(kicker, Vec2::new(0.9, -1.0));
        table.put(HOME_2, Vec2::new(0.2, -1.0));
        hear(&mut table, &set_play(play));
        let least = table.pitch.centre_circle_radius + table.book.spot_clearance;
        let mut others = table.robots.iter().filter(|(robot, _)| robot.team == Team::Home);
        assert!(others.all(|(_, at)| at.distance(table.ball) >= least), "{play}: {:?}", table.robots);
        // The referee has put the ball there, and an opponent walks up to it.
        table.put(HOME_2, table.ball - table.ball.normalize() * least);
        hear(&mut table, &BoxView { stopped: false, ..set_play(play) });
        assert_eq!(table.state.restraints.held_back, [HOME_2], "{play}");
        assert!(!table.state.restraints.holds(kicker), "{play}");
    }
}

#[test]
fn the_ball_lies_in_the_corner_and_at_the_goalkeepers_area() {
    let (half, area) = (Table::new(60).pitch.half_size(), Table::new(60).pitch.own_penalty_area());
    for (left, towards_home) in [(0, -1.0), (1, 1.0)] {
        for (play, x, y) in [
            (SetPlay::CornerKick, towards_home * (half.x - 0.11), half.y - 0.11),
            (SetPlay::GoalKick, towards_home * area.max.x, area.max.y),
        ] {
            let mut table = playing();
            table.ball = Vec2::new(0.5, -1.0);
            hear(&mut table, &BoxView { left, ..set_play(play) });
            assert!(table.ball.distance(Vec2::new(x, -y)) < 1e-4, "{play}: {}", table.ball);
        }
    }
}

#[test]
fn at_a_penalty_kick_only_kicker_and_goalkeeper_take_part() {
    for shoot_out in [false, true] {
        let mut table = playing();
        let game_phase = if shoot_out { GamePhase::PenaltyShootOut } else { GamePhase::Normal };
        let play = if shoot_out { SetPlay::None } else { SetPlay::PenaltyKick };
        let kick = |state| BoxView { set_play: play, game_phase, ..view(state) };
        hear(&mut table, &kick(State::Ready));
        let (ball, half) = (table.ball, table.pitch.half_size());
        assert!(ball.y == 0.0 && ball.x < -half.x / 2.0, "away attacks west: {ball}");
        assert!(table.state.restraints.carried);
        hear(&mut table, &kick(State::Set));
        hear(&mut table, &kick(State::Playing));
        let taking: Vec<RobotId> = table.robots.iter().map(|(robot, _)| *robot).collect();
        let taking: Vec<RobotId> =
            taking.into_iter().filter(|robot| !table.state.restraints.holds(*robot)).collect();
        let keeper = RobotId::new(Team::Home, 0);
        let [first, kicker] = taking[..] else { panic!("{taking:?}") };
        assert_eq!((first, kicker.team), (keeper, Team::Away));
        assert!((table.place(keeper).x + half.x).abs() < 0.6 && table.place(keeper).y == 0.0);
        assert!(table.place(kicker).x > ball.x && table.place(kicker).distance(ball) < 1.1);
        for (robot, at) in table.robots.iter().filter(|(robot, _)| !taking.contains(robot)) {
            assert!(at.x > ball.x + 1.0, "{robot} at {at}");
            let apart = |(other, there): &(RobotId, Vec2)| other == robot || there.distance(*at) > 0.6;
            assert!(table.robots.iter().all(apart), "{robot} at {at}");
        }
        table.ball = Vec2::ZERO;
        assert_eq!(hear(&mut table, &kick(State::Playing)), [], "it is placed once");
        hear(&mut table, &view(State::Playing));
        let restraints = &table.state.restraints;
        assert!(restraints.held_back.is_empty() && !restraints.carried);
    }
}
