//! What a referee box says about robots is done by them.

use super::*;

/// The robots, and where they and the ball are.
fn places(refereed: &mut Refereed) -> (Vec<(RobotId, Vec2)>, Vec2) {
    let mut robots = refereed.game.world_mut().query::<(&RobotId, &Pose)>();
    let mut places: Vec<(RobotId, Vec2)> =
        robots.iter(refereed.game.world()).map(|(id, pose)| (*id, pose.position)).collect();
    places.sort_by_key(|(id, _)| *id);
    (places, ball(&mut refereed.game).0.position)
}

/// How far each robot goes in some ticks.
fn driven(refereed: &mut Refereed, ticks: u64) -> Vec<f32> {
    let (before, _) = places(refereed);
    refereed.ticks(ticks);
    let (after, _) = places(refereed);
    before.iter().zip(&after).map(|((_, from), (_, to))| from.distance(*to)).collect()
}

/// The robots that may move now.
fn movers(refereed: &mut Refereed) -> Vec<RobotId> {
    let mut robots = refereed.game.world_mut().query::<(&RobotId, &Orders, Has<OffPitch>)>();
    let all = robots.iter(refereed.game.world());
    let mut movers: Vec<RobotId> =
        all.filter(|(_, orders, off)| orders.may_move() && !off).map(|(id, ..)| *id).collect();
    movers.sort_unstable();
    movers
}

/// Matches on wheels and on legs.
fn matches() -> [MatchPlan; 2] {
    [talkative(10.0), plan("four_legged_2005", ["chaos_b3p", "chaos_plain"], 10.0)]
}

#[test]
fn robots_stand_within_a_second_of_a_stop_and_go_on_after_it() {
    for plan in matches() {
        let mut refereed = Refereed::playing(plan);
        let moves = driven(&mut refereed, 120);
        assert!(moves.iter().any(|way| *way > 0.2), "they play: {moves:?}");
        refereed.say(|says| says.stopped = true);
        refereed.ticks(59);
        let moves = driven(&mut refereed, 600);
        assert!(moves.iter().all(|way| *way < 0.02), "{moves:?}");
        refereed.say(|says| says.stopped = false);
        let moves = driven(&mut refereed, 120);
        assert!(moves.iter().any(|way| *way > 0.2), "{moves:?}");
    }
}

#[test]
fn a_box_that_is_lost_stops_the_play_until_it_is_heard_again() {
    let mut refereed = Refereed::playing(talkative(10.0));
    refereed.silence(118);
    assert_eq!(movers(&mut refereed).len(), 8);
    refereed.silence(10);
    assert_eq!((movers(&mut refereed).len(), refereed.phase()), (0, Phase::Playing));
    refereed.say(|_| ());
    assert_eq!(movers(&mut refereed).len(), 8);
}

#[test]
fn another_box_is_followed_only_when_the_first_one_is_silent() {
    let mut refereed = Refereed::playing(talkative(10.0));
    let first = std::mem::replace(&mut refereed.socket, stranger());
    refereed.says.packet_number = 200;
    refereed.say(|says| says.state = State::Initial);
    assert_eq!((refereed.phase(), refereed.heard().sender), (Phase::Playing, 1));
    refereed.silence(120);
    refereed.say(|says| says.score = [5, 0]);
    let state = refereed.game.state();
    assert_eq!((state.phase, state.score), (Phase::Initial, [5, 0]));
    refereed.socket = first;
    refereed.say(|says| says.score = [6, 0]);
    assert_eq!((refereed.game.state().score, refereed.heard().sender), ([5, 0], 2));
}

#[test]
fn opponents_keep_away_from_the_ball_of_a_set_play_until_it_is_over() {
    for plan in matches() {
        let least = plan.pitch.centre_circle_radius + plan.rules.spot_clearance;
        let mut refereed = Refereed::playing(plan);
        refereed.ticks(300);
        let spot = ball(&mut refereed.game).0.position;
        refereed.say(|says| {
            (says.set_play, says.kicking, says.stopped) = (SetPlay::DirectFreeKick, Some(1), true);
        });
        refereed.ticks(60);
        let lies = ball(&mut refereed.game).0.position;
        assert!(lies.distance(spot) < 0.2, "the ball lies where it was: {spot}, {lies}");
        refereed.say(|says| says.stopped = false);
        for _ in 0..600 {
            refereed.ticks(1);
            let (robots, ball) = places(&mut refereed);
            if ball.distance(lies) > 0.15 {
                break;
            }
            for (robot, at) in robots.iter().filter(|(robot, _)| robot.team == Team::Home) {
                assert!(at.distance(ball) > least - 0.05, "{robot} is {} m away", at.distance(ball));
            }
        }
        refereed.say(|says| says.set_play = SetPlay::None);
        assert_eq!(movers(&mut refereed).len(), 8);
    }
}

#[test]
fn at_a_penalty_kick_one_robot_and_the_goalkeeper_move_with_the_ball_on_the_spot() {
    for plan in matches() {
        let pitch = plan.pitch.clone();
        let mut refereed = Refereed::playing(plan);
        refereed.say(|says| (says.set_play, says.kicking) = (SetPlay::PenaltyKick, Some(1)));
        refereed.say(|says| says.state = State::Ready);
        assert_eq!(movers(&mut refereed), [], "people put them in place");
        refereed.say(|says| says.state = State::Set);
        refereed.ticks(60);
        let (robots, ball) = places(&mut refereed);
        assert!(ball.y == 0.0 && ball.x < -pitch.half_size().x / 2.0, "{ball}");
        refereed.say(|says| says.state = State::Playing);
        let movers = movers(&mut refereed);
        assert_eq!(movers.len(), 2, "{movers:?}");
        assert_eq!((movers[0], movers[1].team), (HOME_0, Team::Away));
        for (robot, at) in robots.iter().filter(|(robot, _)| !movers.contains(robot)) {
            assert!(at.x > ball.x && !pitch.own_penalty_area().contains(*at), "{robot} at {at}");
        }
        refereed.say(|says| says.set_play = SetPlay::None);
        assert_eq!(self::movers(&mut refereed).len(), 8);
    }
}

#[test]
fn a_robot_that_moved_in_set_stands_where_it_is_and_keeps_what_it_knows() {
    let mut refereed = Refereed::playing(talkative(10.0));
    refereed.ticks(240);
    refereed.say(|says| says.state = State::Set);
    refereed.ticks(60);
    let robot = RobotId::new(Team::Home, 1);
    let believed = |refereed: &mut Refereed| {
        let mut robots = refereed.game.world_mut().query::<(&RobotId, &WorldModel)>();
        let found = robots.iter(refereed.game.world()).find(|(id, _)| **id == robot);
        found.map(|(_, model)| (model.pose.position, model.ball.is_some())).expect("the robot is there")
    };
    let before = believed(&mut refereed);
    let moved = Penalised { player: 1, penalty: Penalty::MotionInSet, seconds_left: 15 };
    refereed.say(|says| says.penalties[0] = vec![moved]);
    refereed.say(|says| says.state = State::Playing);
    assert_eq!(refereed.orders(robot), (RobotState::Penalised, false));
    let after = believed(&mut refereed);
    assert!(before.0.distance(after.0) < 0.2 && before.1 == after.1, "{before:?}, {after:?}");
    let moves = driven(&mut refereed, 240);
    assert!(moves[1] < 0.01 && moves.iter().any(|way| *way > 0.1), "others play: {moves:?}");
    let served = places(&mut refereed).0[1];
    refereed.say(|says| says.penalties[0].clear());
    let (state, off) = refereed.orders(robot);
    assert!(state != RobotState::Penalised && !off, "{state:?}");
    let again = places(&mut refereed).0[1];
    assert!(
        served.0 == robot && served.1.distance(again.1) < 0.05,
        "it goes on where it stood: {served:?}, {again:?}"
    );
    assert!(movers(&mut refereed).contains(&robot));
    let pushed = Penalised { penalty: Penalty::Pushing, ..moved };
    refereed.say(|says| says.penalties[0] = vec![pushed]);
    assert_eq!(refereed.orders(robot), (RobotState::Penalised, true));
}

#[test]
fn substitutes_and_players_beyond_the_boxs_number_do_not_play() {
    let mut refereed = Refereed::playing(talkative(10.0));
    let substitute = Penalised { player: 2, penalty: Penalty::Substitute, seconds_left: 0 };
    refereed.says.players_per_team = 3;
    refereed.say(|says| says.penalties[0] = vec![substitute]);
    let off = [(Team::Home, 2), (Team::Home, 3), (Team::Away, 3)].map(|(team, n)| RobotId::new(team, n));
    refereed.ticks(60);
    for robot in off {
        assert_eq!(refereed.orders(robot), (RobotState::Penalised, true), "{robot}");
    }
    assert_eq!(movers(&mut refereed).len(), 5);
    refereed.says.players_per_team = 4;
    refereed.say(|says| says.penalties[0].clear());
    refereed.ticks(60);
    assert_eq!(movers(&mut refereed).len(), 8);
}

#[test]
fn the_first_packet_of_a_second_half_tells_sides_and_ends() {
    let mut refereed = Refereed::new(talkative(10.0));
    refereed.says.view.left = 1;
    refereed.say(|says| (says.state, says.first_half, says.score) = (State::Playing, false, [1, 0]));
    let state = refereed.game.state();
    assert_eq!((state.half, state.score), (2, [1, 0]));
    assert!(state.attacking(Team::Home).turn(Vec2::X).x < 0.0);
    let (robots, _) = places(&mut refereed);
    let pitch = refereed.game.world().resource::<Pitch>();
    assert!(robots.iter().all(|(_, at)| pitch.holds(*at, 0.0)), "nobody waits beside the pitch");
    // And a new match of the box, after it was silent.
    refereed.silence(180);
    refereed.says.view.left = 0;
    refereed.says.packet_number = u8::MAX;
    refereed.say(|says| (says.state, says.first_half, says.score) = (State::Initial, true, [0, 0]));
    let state = refereed.game.state();
    assert_eq!((state.phase, state.half, state.score), (Phase::Initial, 1, [0, 0]));
    assert!(state.attacking(Team::Home).turn(Vec2::X).x > 0.0);
    let (robots, _) = places(&mut refereed);
    assert!(robots.iter().all(|(robot, at)| (robot.team == Team::Home) == (at.x < 0.0)), "{robots:?}");
}

#[test]
fn extra_time_and_a_shoot_out_follow_and_every_version_is_understood() {
    let mut refereed = Refereed::playing(talkative(10.0));
    refereed.says.view.left = 1;
    refereed.say(|says| (says.state, says.first_half) = (State::Finished, false));
    refereed.ticks(60 * 60);
    assert!(!refereed.game.is_over(), "nobody has won");
    for (version, phase) in
        Version::ALL.into_iter().zip([GamePhase::ExtraTime, GamePhase::TimeOut, GamePhase::PenaltyShootOut])
    {
        let state = if phase == GamePhase::TimeOut { State::Initial } else { State::Playing };
        refereed.says.view.left = 0;
        (refereed.says.view.state, refereed.says.view.first_half) = (state, true);
        refereed.says.packet_number += 1;
        let view = BoxView { game_phase: phase, ..refereed.says.view.clone() };
        let packet = MatchAnnouncement { version, view, ..refereed.says.clone() };
        refereed.send(&packet.packet().write());
        refereed.silence(1);
        let moving = movers(&mut refereed).len();
        let expected = match phase {
            GamePhase::ExtraTime => 8,
            GamePhase::TimeOut => 0,
            _ => 2,
        };
        assert_eq!((moving, refereed.game.state().half), (expected, 1), "{phase}");
    }
}

#[test]
fn nobody_kicks_off_at_a_dropped_ball() {
    let mut refereed = Refereed::playing(talkative(10.0));
    refereed.say(|says| (says.state, says.kicking) = (State::Ready, None));
    assert!(Team::BOTH.iter().all(|team| !refereed.game.state().kicks_off(*team)));
    let (robots, _) = places(&mut refereed);
    let mirrored =
        |from: Team| robots.iter().filter(move |(id, _)| id.team == from).map(|(_, at)| at.x.abs());
    assert!(mirrored(Team::Home).zip(mirrored(Team::Away)).all(|(a, b)| (a - b).abs() < 1e-3), "{robots:?}");
    refereed.say(|says| says.state = State::Set);
    refereed.say(|says| says.state = State::Playing);
    assert_eq!(movers(&mut refereed).len(), 8);
    let moves = driven(&mut refereed, 300);
    let (home, away) = moves.split_at(4);
    assert!([home, away].iter().all(|team| team.iter().any(|way| *way > 0.2)), "both play: {moves:?}");
}
