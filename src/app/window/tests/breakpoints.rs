//! A match stops at the very tick that a person waits for.

use egui::{PointerButton, vec2};

use super::{LaidOutWindow, ROBOT, assets, egui};
use crate::app::inspector::breakpoints::{Breakpoint, Breakpoints, MessageEvent, StopAt, WhistleKind};
use crate::app::match_request::MatchRequest;
use crate::app::view::state::{Action, Overlay, Overlays, PanelSizes, PendingMatch, Playback, Selected};
use crate::clock::Clock;
use crate::comms::radio::{RadioRecord, TransmissionState};
use crate::game::{Choice, Match, MatchPlan};
use crate::ids::RobotId;
use crate::mind::world_model::WorldModel;
use crate::robot::Robot;
use crate::strategy::{Activity, Strategies};
use crate::world::referee::Whistles;

const SIZE: egui::Vec2 = vec2(1600.0, 1000.0);

fn choice() -> Choice {
    Choice { home: Some("hammerheads_swap".into()), half_minutes: Some(1.0), seed: 3, ..Choice::default() }
}

/// As fast as it goes, so that many ticks are due in each frame.
fn fast() -> Playback {
    Playback { speed: Playback::SPEEDS.len() - 1, ..Playback::default() }
}

/// A window that plays with these breakpoints from the first tick on.
fn window(stops: &[(Option<RobotId>, StopAt)]) -> LaidOutWindow {
    let mut window = LaidOutWindow::new();
    let breakpoints = stops.iter().map(|(who, at)| Breakpoint::new(*who, at.clone()));
    window.app.insert_resource(Breakpoints(breakpoints.collect()));
    window.app.insert_resource(fast());
    window.app.insert_resource(PendingMatch(Some(MatchRequest::Match(choice()))));
    (0..2).for_each(|_| window.app.update());
    window.app.insert_resource(Selected(Some(ROBOT)));
    window.app.insert_resource(Overlays::only([Overlay::States]));
    window.app.insert_resource(PanelSizes { states: 700.0, ..PanelSizes::default() });
    window
}

/// Plays until the match is paused; the ticks that are over then, and what the window says.
fn play_on(window: &mut LaidOutWindow) -> (u64, String) {
    let stopped = (0..4000).map(|_| window.frame(SIZE, 1.0)).find(|frame| frame.shows("▶ Play"));
    let frame = stopped.expect("the match stops");
    let tick = window.app.world().resource::<Clock>().tick;
    (0..5).for_each(|_| drop(window.frame(SIZE, 1.0)));
    assert_eq!(window.app.world().resource::<Clock>().tick, tick, "it stands still");
    let told =
        frame.texts.into_iter().find_map(|(text, _)| text.strip_prefix("Stopped: ").map(str::to_owned));
    (tick, told.expect("it is said why"))
}

/// The ticks of a headless match after which something is so, in their order.
fn ticks(count: usize, mut is_so: impl FnMut(&mut Match) -> bool) -> Vec<u64> {
    let plan = MatchPlan::read(&assets(), &choice()).expect("the match is sound");
    let mut game = Match::new(&plan);
    let mut found = Vec::new();
    while found.len() < count && !game.is_over() {
        game.tick();
        if is_so(&mut game) {
            found.push(game.clock().tick);
        }
    }
    found
}

fn activity_of(game: &mut Match, robot: RobotId) -> Activity {
    let world = game.world_mut();
    let mut robots = world.query::<(&RobotId, &Activity)>();
    let found = robots.iter(world).find(|(id, _)| **id == robot);
    found.map(|(_, activity)| activity.clone()).expect("the robot is there")
}

#[test]
fn a_match_stops_at_each_tick_in_which_a_robot_comes_to_a_state_and_in_no_other() {
    let (machine, state) = ("halfback".to_owned(), "acquire".to_owned());
    let expected = ticks(3, |game| {
        let activity = activity_of(game, ROBOT);
        let strategy = &game.world().resource::<Strategies>().0[0];
        let machine = &strategy.machines[activity.machine(strategy)];
        activity.since + 1 == game.clock().tick
            && (machine.name.as_str(), machine.states[activity.state].name.as_str())
                == ("halfback", "acquire")
    });
    assert_eq!(expected.len(), 3, "the match has enough to stop at");
    let mut window = window(&[(Some(ROBOT), StopAt::State { machine, state })]);
    for tick in expected {
        let (stopped, told) = play_on(&mut window);
        assert_eq!(stopped, tick, "{told}");
        assert!(told.starts_with("home 1 has come to acquire, because "), "{told}");
        window.app.world_mut().write_message(Action::PlayOrPause);
    }
}

#[test]
fn a_match_stops_at_the_tick_of_a_message_and_of_a_whistle() {
    let arrived = |game: &mut Match| {
        let tick = game.clock().tick - 1;
        let mut sent = game.world().resource::<RadioRecord>().transmissions();
        sent.any(|one| {
            one.packet.kind.to_string() == "position" && one.state == TransmissionState::Arrived(tick)
        })
    };
    let message = StopAt::Message { kind: "position".into(), event: MessageEvent::Arrived };
    let whistled = |game: &mut Match| {
        let tick = game.clock().tick - 1;
        let heard = &game.world().resource::<Whistles>().heard;
        heard.iter().any(|(at, decision)| *at == tick && WhistleKind::of(decision) == WhistleKind::BallPlaced)
    };
    let whistle = StopAt::Whistle(Some(WhistleKind::BallPlaced));
    let last = |found: Vec<u64>| *found.last().expect("it happens");
    for (at, tick, words) in [
        (message, last(ticks(1, arrived)), "position from "),
        (whistle, last(ticks(1, whistled)), "the referee: "),
    ] {
        let (stopped, told) = play_on(&mut window(&[(None, at)]));
        assert_eq!(stopped, tick, "{told}");
        assert!(told.starts_with(words), "{told}");
    }
}

#[test]
fn a_match_stops_where_a_feature_becomes_true_as_the_robot_decides() {
    let mut before = None;
    let expected = ticks(2, |game| {
        let played = Clock { tick: game.clock().tick - 1, ..game.clock() };
        let world = game.world_mut();
        let mut robots = world.query::<(&RobotId, &Robot, &WorldModel)>();
        let (_, robot, model) =
            robots.iter(world).find(|(id, ..)| **id == ROBOT).expect("the robot is there");
        if !robot.decides(&played) {
            return false;
        }
        let is_known = model.ball.is_some();
        before.replace(is_known) == Some(false) && is_known
    });
    let mut window = window(&[(Some(ROBOT), StopAt::Feature("ball_known".into()))]);
    for tick in expected {
        assert_eq!(play_on(&mut window), (tick, "home 1 finds that ball_known".into()));
        window.app.world_mut().write_message(Action::PlayOrPause);
    }
}

#[test]
fn a_match_that_goes_back_stops_again_at_the_same_tick_and_not_on_the_way_there() {
    let (machine, state) = ("halfback".to_owned(), "acquire".to_owned());
    let mut window = window(&[(None, StopAt::State { machine, state })]);
    let (first, told) = play_on(&mut window);
    window.app.world_mut().write_message(Action::PlayOrPause);
    let (second, _) = play_on(&mut window);
    window.app.world_mut().write_message(Action::GoTo(second - 1));
    let frame = window.show(SIZE, 1.0);
    assert_eq!(window.app.world().resource::<Clock>().tick, second - 1);
    assert!(frame.texts.iter().all(|(text, _)| !text.starts_with("Stopped: ")), "{:?}", frame.texts);
    window.app.world_mut().write_message(Action::GoTo(first - 1));
    window.show(SIZE, 1.0);
    window.app.world_mut().write_message(Action::PlayOrPause);
    assert_eq!(play_on(&mut window), (first, told));
}

#[test]
fn a_right_click_on_a_state_sets_a_breakpoint_and_the_list_disables_and_removes_it() {
    let mut window = window(&[]);
    window.app.insert_resource(Playback { paused: true, ..Playback::default() });
    let at = window.show(SIZE, 1.0).place("acquire").expect("the state is in sight");
    let menu = window.click(SIZE, at, PointerButton::Secondary);
    let set = menu.place("Stop when home 1 comes to acquire (halfback)");
    window.click(SIZE, set.unwrap_or_else(|| panic!("{:?}", menu.texts)), PointerButton::Primary);
    let stop = StopAt::State { machine: "halfback".into(), state: "acquire".into() };
    let set = |window: &LaidOutWindow| window.app.world().resource::<Breakpoints>().0.clone();
    assert_eq!(set(&window), [Breakpoint::new(Some(ROBOT), stop.clone())]);
    let page = window.show(SIZE, 1.0).place("Breakpoints (1)").expect("the page has a tab");
    let list = window.click(SIZE, page, PointerButton::Primary);
    let row = list.place("home 1 comes to acquire (halfback)").unwrap_or_else(|| panic!("{:?}", list.texts));
    window.click(SIZE, row, PointerButton::Primary);
    assert_eq!(set(&window), [Breakpoint { on: false, ..Breakpoint::new(Some(ROBOT), stop) }]);
    let remove = window.show(SIZE, 1.0).place("Remove").expect("there is a button");
    window.click(SIZE, remove, PointerButton::Primary);
    assert_eq!(set(&window), []);
}

#[test]
fn watching_a_match_for_breakpoints_does_not_change_it() {
    use crate::game::record::Record;
    let stops = ["ball_known", "stuck", "ball_in_scoop"].map(|name| (None, StopAt::Feature(name.into())));
    let mut window = window(&stops);
    // It stops in many frames, and plays a tick at least in each other one.
    for _ in 0..2_000 {
        if window.app.world().resource::<Clock>().tick >= 600 {
            break;
        }
        window.app.world_mut().resource_mut::<Playback>().paused = false;
        window.frame(SIZE, 1.0);
    }
    let tick = window.app.world().resource::<Clock>().tick;
    assert!(tick >= 600, "the match stands still at tick {tick}");
    let plan = MatchPlan::read(&assets(), &choice()).expect("the match is sound");
    let mut game = Match::new(&plan);
    (0..tick).for_each(|_| game.tick());
    assert_eq!(window.app.world().resource::<Record>().digest, game.record().digest);
}
