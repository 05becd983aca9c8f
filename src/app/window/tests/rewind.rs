//! A person goes back in a match, and on from there another way, by keys and on the time line.

use std::collections::BTreeMap;

use bevy::input::ButtonState;
use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;
use egui::{Event, Modifiers, PointerButton, Pos2, Rect, pos2, vec2};

use super::{LaidOutFrame, LaidOutWindow, assets, egui};
use crate::app::inspector::RadioView;
use crate::app::match_request::MatchRequest;
use crate::app::view::interface::saving::ScenarioFolder;
use crate::app::view::picture::ghosts::GhostVisual;
use crate::app::view::state::{
    Action, Beside, Inspector, Overlay, PendingMatch, Piloted, Playback, Selected, Session,
};
use crate::app::view::time::recording::Recording;
use crate::clock::Clock;
use crate::comms::radio::{Loss, Packet, RadioRecord, TransmissionState};
use crate::game::record::Record;
use crate::game::requests::{BodyChange, RadioChange, Request, Requests};
use crate::game::{Choice, Match};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::lab::replay::Replay;
use crate::lab::rewind::{BranchId, MatchEventKind, Rewind};
use crate::lab::scenario::{ScenarioPlan, ScenarioRef};
use crate::robot::Trailer;
use crate::robot::pilot::Pilot;
use crate::world::ball::Ball;

pub(super) const SIZE: egui::Vec2 = vec2(1280.0, 720.0);
const MINE: RobotId = RobotId::new(Team::Home, 1);

impl LaidOutWindow {
    pub(super) fn clock(&self) -> u64 {
        self.app.world().resource::<Clock>().tick
    }

    pub(super) fn digest(&self) -> u64 {
        self.app.world().resource::<Record>().digest
    }

    pub(super) fn rewind(&self) -> &Rewind {
        self.app.world().resource::<Rewind>()
    }

    /// Plays until so many ticks are over, and is paused there.
    pub(super) fn play_to(&mut self, until: u64) {
        while self.clock() < until {
            let before = self.clock();
            let mut playback = self.app.world_mut().resource_mut::<Playback>();
            (playback.paused, playback.single_ticks) = (true, 1);
            self.frame(SIZE, 1.0);
            assert!(self.clock() > before, "the match stands still at tick {before}");
        }
        self.frame(SIZE, 1.0);
    }

    /// Presses a key and lets it go.
    pub(super) fn press(&mut self, key_code: KeyCode, writes: &str) {
        self.key(key_code, writes, ButtonState::Pressed);
        self.key(key_code, writes, ButtonState::Released);
    }

    pub(super) fn key(&mut self, key_code: KeyCode, writes: &str, state: ButtonState) {
        let logical_key = Key::Character(writes.into());
        let window = Entity::PLACEHOLDER;
        let key = KeyboardInput { key_code, logical_key, state, text: None, repeat: false, window };
        self.app.world_mut().write_message(key);
        self.frame(SIZE, 1.0);
    }

    /// Presses the pointer at one place, moves it to another and lets it go.
    pub(super) fn drag(&mut self, from: Pos2, to: Pos2) {
        let pressed = |pos, pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        self.frame_with(SIZE, 1.0, vec![Event::PointerMoved(from)]);
        self.frame_with(SIZE, 1.0, vec![pressed(from, true)]);
        if from != to {
            self.frame_with(SIZE, 1.0, vec![Event::PointerMoved(from.lerp(to, 0.5))]);
            self.frame_with(SIZE, 1.0, vec![Event::PointerMoved(to)]);
        }
        self.frame_with(SIZE, 1.0, vec![pressed(to, false)]);
        self.frame_with(SIZE, 1.0, vec![Event::PointerGone]);
        self.frame(SIZE, 1.0);
    }

    pub(super) fn go_to(&mut self, tick: u64) {
        self.app.world_mut().write_message(Action::GoTo(tick));
        self.frame(SIZE, 1.0);
        self.frame(SIZE, 1.0);
        assert_eq!(self.clock(), tick);
    }

    fn undo(&mut self) {
        let modifiers = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
        let key =
            Event::Key { key: egui::Key::Z, physical_key: None, pressed: true, repeat: false, modifiers };
        self.frame_with(SIZE, 1.0, vec![key]);
        self.frame(SIZE, 1.0);
    }
}

impl LaidOutFrame {
    /// The middle of a text.
    fn place_of_text(&self, text: &str) -> Pos2 {
        let found = self.places.iter().find(|(shown, _)| shown == text);
        found.unwrap_or_else(|| panic!("no {text} in {:?}", self.texts)).1.center()
    }

    /// The line of the match: the widest control of the window's lower edge.
    fn time_line(&self) -> Rect {
        let controls = self.layers.iter().flat_map(|(_, controls)| controls);
        let low = controls.filter(|rect| rect.top() > self.screen.bottom() - 60.0);
        let widest = low.max_by(|a, b| a.width().total_cmp(&b.width())).expect("there is a line");
        widest.shrink2(vec2(44.0, 0.0))
    }

    /// Where a tick of a match without breaks lies on its line.
    pub(super) fn place_of(&self, tick: u64, last: u64) -> Pos2 {
        let line = self.time_line();
        pos2(line.left() + line.width() * tick as f32 / last as f32, line.top() + 13.0)
    }
}

#[test]
fn comma_and_full_stop_go_one_tick_back_and_one_ahead() {
    let mut window = LaidOutWindow::playing(None);
    window.play_to(200);
    let (tick, digest) = (window.clock(), window.digest());
    (0..3).for_each(|_| window.press(KeyCode::Comma, ","));
    assert_eq!(window.clock(), tick - 3);
    assert_ne!(window.digest(), digest);
    (0..3).for_each(|_| window.press(KeyCode::Period, "."));
    assert_eq!((window.clock(), window.digest()), (tick, digest));
    assert!(window.app.world().resource::<Playback>().paused);
    assert_eq!(window.rewind().branches().len(), 1, "nothing was asked for");
}

#[test]
fn a_drag_on_the_line_scrubs_and_a_click_on_an_event_goes_to_it() {
    let mut window = LaidOutWindow::scenario("swap_figure_8");
    let swap_in = |window: &LaidOutWindow| {
        let mut events = window.rewind().events(BranchId(0));
        events.find(|event| matches!(event.what, MatchEventKind::RoleTaken { .. })).map(|event| event.tick)
    };
    let swap = (400..1200).step_by(100).find_map(|tick| {
        window.play_to(tick);
        swap_in(&window)
    });
    let swap = swap.expect("the scenario is about a swap");
    let now = window.clock();
    let frame = window.frame(SIZE, 1.0);
    let last = window.app.world().resource::<crate::app::view::time::expectations::Expectations>().end();
    let last = last.expect("it is a scenario").max(now);
    window.drag(frame.place_of(now - 5, last), frame.place_of(100, last));
    assert!(window.clock().abs_diff(100) <= 1, "{} on {}", window.clock(), frame.time_line());
    window.drag(frame.place_of(swap, last), frame.place_of(swap, last));
    assert_eq!(window.clock(), swap);
}

#[test]
fn a_picture_that_goes_back_is_the_one_that_was_there() {
    let mut window = LaidOutWindow::playing(None);
    window.play_to(300);
    let seen = |window: &mut LaidOutWindow| {
        let world = window.app.world_mut();
        let mut shown = world.query::<(Entity, &Transform, &Visibility)>();
        let mut shown: Vec<String> = shown
            .iter(world)
            .filter(|(_, _, visibility)| **visibility != Visibility::Hidden)
            .map(|(entity, at, _)| format!("{entity} {at:?}"))
            .collect();
        shown.sort();
        shown
    };
    let before = seen(&mut window);
    window.play_to(517);
    assert_ne!(seen(&mut window), before);
    window.go_to(300);
    assert_eq!(window.clock(), 300);
    assert_eq!(seen(&mut window), before);
}

#[test]
fn a_match_that_was_steered_is_driven_again_and_is_in_hand_where_that_ends() {
    let mut window = LaidOutWindow::playing(Some(MINE));
    window.play_to(100);
    window.key(KeyCode::KeyW, "w", ButtonState::Pressed);
    window.play_to(150);
    window.key(KeyCode::KeyW, "w", ButtonState::Released);
    window.play_to(200);
    let (end, digest) = (window.clock(), window.digest());
    window.go_to(121);
    window.press(KeyCode::Comma, ",");
    assert_eq!(*window.app.world().resource::<Piloted>(), Piloted(None), "the hands are off");
    window.play_to(199);
    assert_eq!(*window.app.world().resource::<Piloted>(), Piloted(None));
    window.play_to(200);
    assert_eq!((window.clock(), window.digest()), (end, digest));
    assert_eq!(*window.app.world().resource::<Piloted>(), Piloted(Some(MINE)));
    assert_eq!(window.rewind().branches().len(), 1);
}

#[test]
fn who_takes_a_robot_over_in_the_past_drives_a_branch_and_the_old_future_is_kept_beside_it() {
    let mut window = LaidOutWindow::playing(None);
    window.play_to(200);
    window.go_to(150);
    window.app.insert_resource(Selected(Some(MINE)));
    window.press(KeyCode::KeyH, "h");
    window.play_to(210);
    assert_eq!(window.rewind().present(), BranchId(1));
    assert_eq!(*window.app.world().resource::<Beside>(), Beside(Some(BranchId(0))));
    let mut driven = window.app.world_mut().query_filtered::<&RobotId, With<Pilot>>();
    assert_eq!(driven.iter(window.app.world()).collect::<Vec<_>>(), [&MINE]);
    window.app.world_mut().write_message(Action::TakeBranch(BranchId(0)));
    window.frame(SIZE, 1.0);
    window.frame(SIZE, 1.0);
    let mut alone = LaidOutWindow::playing(None);
    alone.play_to(210);
    assert_eq!((window.clock(), window.digest()), (210, alone.digest()), "it went on beside the branch");
    assert_eq!(*window.app.world().resource::<Beside>(), Beside(Some(BranchId(1))));
}

#[test]
fn ctrl_z_takes_the_last_meddling_back() {
    let mut window = LaidOutWindow::playing(None);
    window.play_to(50);
    window.app.world_mut().resource_mut::<Requests>().ask(Request::Radio(RadioChange::Jam(true)));
    window.play_to(80);
    window.undo();
    assert_eq!(window.clock(), 50);
    assert_eq!(window.rewind().branch(window.rewind().present()).name, "without the radio jammed");
    let frame = window.frame(SIZE, 1.0);
    assert!(frame.shows("Undone: the radio jammed"), "{:?}", frame.texts);
    let mut calm = LaidOutWindow::playing(None);
    calm.play_to(80);
    window.play_to(80);
    assert_eq!((window.clock(), window.digest()), (80, calm.digest()));
}

#[test]
fn a_bookmark_is_a_place_to_go_back_to() {
    let mut window = LaidOutWindow::playing(None);
    window.play_to(40);
    window.press(KeyCode::KeyB, "b");
    window.play_to(80);
    let rewind = window.rewind();
    assert_eq!(rewind.bookmarks(rewind.present()).collect::<Vec<_>>(), [(40, "A bookmark")]);
    window.go_to(40);
    window.press(KeyCode::KeyB, "b");
    assert_eq!(window.rewind().bookmarks(BranchId(0)).count(), 0);
}

#[test]
fn the_present_moment_is_saved_as_a_scenario_that_can_be_played() {
    let folder = tempfile::tempdir().expect("a folder");
    for (mut window, tick) in
        [(LaidOutWindow::playing(None), 400), (LaidOutWindow::scenario("swap_figure_8"), 200)]
    {
        window.app.insert_resource(ScenarioFolder(folder.path().to_owned()));
        window.play_to(tick);
        window.app.world_mut().write_message(Action::SaveScenario);
        let frame = window.show(SIZE, 1.0);
        let seed = window.app.world().resource::<Session>().plan.as_ref().expect("a match").seed;
        let path = folder.path().join(format!("moment_{seed}_{tick}.ron"));
        assert!(path.exists(), "{:?}", frame.texts);
        let plan =
            ScenarioPlan::read(&assets(), &ScenarioRef::from(path)).unwrap_or_else(|error| panic!("{error}"));
        assert!(plan.run(None).runs.iter().all(|run| run.verdict.passed()));
        assert!(plan.scenario.players().count() >= 5);
    }
}

#[test]
fn a_click_on_a_message_under_way_and_on_drop_loses_it_in_a_branch() {
    let choice = Choice {
        radio: Some("awful".into()),
        home: Some("hammerheads_swap".into()),
        seed: 3,
        ..Choice::default()
    };
    let mut window = LaidOutWindow::with(MatchRequest::Match(choice));
    window = window.open([Overlay::Radio]);
    window.app.insert_resource(Inspector::default());
    window.play_to(200);
    let under_way = |window: &LaidOutWindow| {
        let radio = window.app.world().resource::<RadioRecord>();
        let now = window.clock();
        let is_far =
            |state: TransmissionState| matches!(state, TransmissionState::InFlight(due) if due > now + 5);
        let mine = |packet: &Packet| packet.from.team == Team::Home;
        radio.transmissions().find(|sent| is_far(sent.state) && mine(&sent.packet)).map(|sent| sent.id)
    };
    while under_way(&window).is_none() {
        let next = window.clock() + 1;
        window.play_to(next);
    }
    let (id, tick) = (under_way(&window).expect("it was found"), window.clock());
    window.app.world_mut().resource_mut::<RadioView>().message = Some(id);
    window.play_to(tick + 30);
    window.go_to(tick);
    let frame = window.show(SIZE, 1.0);
    let drop = frame.place_of_text("Drop");
    window.drag(drop, drop);
    window.play_to(tick + 1);
    let radio = window.app.world().resource::<RadioRecord>();
    let state = radio.transmissions().find(|sent| sent.id == id).map(|sent| sent.state);
    assert_eq!(state, Some(TransmissionState::Lost(Loss::Fault)));
    assert_eq!(window.rewind().branch(window.rewind().present()).name, "a message dropped");
}

#[test]
fn another_future_is_shown_as_ghosts_where_it_has_gone_and_goes_on_beside() {
    let mut window = LaidOutWindow::playing(None);
    window.play_to(150);
    window.go_to(100);
    let at = Vec2::new(2.0, 1.0);
    window
        .app
        .world_mut()
        .resource_mut::<Requests>()
        .ask(Request::Body(BodyChange::Ball { at, velocity: Vec2::ZERO }));
    let ghosts = |window: &mut LaidOutWindow| {
        let mut ghosts = window.app.world_mut().query::<(&GhostVisual, &Transform, &Visibility)>();
        let shown =
            ghosts.iter(window.app.world()).filter(|(.., visibility)| **visibility != Visibility::Hidden);
        let (mut bodies, mut trailers) = (Vec::new(), BTreeMap::new());
        for (what, transform, _) in shown {
            match what {
                GhostVisual::Trailer(of) => drop(trailers.insert(*of, *transform)),
                _ => bodies.push(transform.translation.xy()),
            }
        }
        bodies.sort_by(|a, b| (a.x, a.y).partial_cmp(&(b.x, b.y)).expect("they are numbers"));
        (bodies, trailers)
    };
    assert_eq!(ghosts(&mut window), (Vec::new(), BTreeMap::new()));
    let mut alone = LaidOutWindow::playing(None);
    for tick in [140, 220] {
        window.play_to(tick);
        (0..20).for_each(|_| drop(window.frame(SIZE, 1.0)));
        alone.play_to(tick);
        let mut there = alone.app.world_mut().query_filtered::<&Pose, Or<(With<RobotId>, With<Ball>)>>();
        let mut there: Vec<Vec2> = there.iter(alone.app.world()).map(|pose| pose.position).collect();
        there.sort_by(|a, b| (a.x, a.y).partial_cmp(&(b.x, b.y)).expect("they are numbers"));
        let (bodies, trailers) = ghosts(&mut window);
        assert_eq!(bodies, there, "at {tick}");
        let mut pulled = alone.app.world_mut().query::<(&Trailer, &Pose)>();
        let pulled: Vec<_> = pulled.iter(alone.app.world()).collect();
        assert_eq!((pulled.len(), trailers.len()), (8, 8));
        for (trailer, pose) in pulled {
            let shown = trailers[&trailer.of];
            assert!(shown.translation.xy().distance(pose.position) < 0.02, "at {tick}: {}", trailer.of);
            let turned = shown.rotation.angle_between(Quat::from_rotation_z(pose.heading));
            assert!(turned < 1e-3, "at {tick}: {}", trailer.of);
        }
    }
    assert_eq!(window.rewind().branch(BranchId(0)).end, 220, "the old future went on");
}

#[test]
fn each_branch_is_recorded_in_a_file_of_its_own_with_its_bookmarks_and_can_be_played_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let mut window = LaidOutWindow::new();
    window.app.insert_resource(Recording::to(Some(path("mine.replay"))));
    window
        .app
        .insert_resource(PendingMatch(Some(MatchRequest::Match(Choice { seed: 3, ..Choice::default() }))));
    window.frame(SIZE, 1.0);
    window.play_to(130);
    window.go_to(70);
    window.press(KeyCode::KeyB, "b");
    window.app.world_mut().resource_mut::<Requests>().ask(Request::Radio(RadioChange::Jam(true)));
    window.play_to(200);
    let branch = window.digest();
    window.app.world_mut().write_message(Action::TakeBranch(BranchId(0)));
    window.frame(SIZE, 1.0);
    window.play_to(200);
    let first = window.digest();
    window.app.world_mut().write_message(AppExit::Success);
    window.app.update();
    for (name, digest) in [("mine.replay", first), ("mine-2.replay", branch)] {
        let replay = Replay::read(&path(name)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((replay.ticks(), replay.digest()), (200, Some(digest)), "{name}");
        let (plan, _) = replay.plans().expect("it has all its files");
        let mut game = Match::new(&plan);
        (0..200).for_each(|_| game.tick());
        assert_eq!(game.record().digest, digest, "{name}");
        assert_eq!(replay.bookmarks().len(), 1, "{name} shares the tick");
    }
    let mut again = LaidOutWindow::with(MatchRequest::Replay(path("mine-2.replay")));
    again.play_to(200);
    assert_eq!(again.digest(), branch);
    assert_eq!(again.rewind().bookmarks(BranchId(0)).collect::<Vec<_>>(), [(70, "A bookmark")]);
}
