//! What a person finds out without the manual, each from the beginning of a match to the end of the story: they read what is on the
//! screen, press keys, click and drag, and the match becomes what it then becomes.

use std::path::Path;

use bevy::prelude::*;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect};

use super::rewind::SIZE;
use super::{LaidOutFrame, LaidOutWindow, egui};
use crate::app::match_request::MatchRequest;
use crate::app::view::time::asking::AskedWhy;
use crate::app::view::time::expectations::Expectations;
use crate::comms::radio::{RadioRecord, TransmissionState};
use crate::ids::{RobotId, Team};
use crate::lab::rewind::{BranchId, MatchEventKind};
use crate::lab::scenario::ScenarioRef;
use crate::strategy::{Role, Strategies};
use crate::world::referee::{Decision, MatchState};

/// A robot looks on, is locked, its wheels fail, and the referee takes it off.
const STANDS_STILL: &str = r#"(
    name: "Robot 3 stands still for one reason after another",
    source: "a test",
    seconds: 12,
    home: (strategy: "hammerheads_swap_paper", line_up: "at_home"),
    ball: (at: (-4.2, -2.2)),
    script: [
        (at: 2, what: InitiateSwap(robot: "home 1", roles: [("halfback", "forward"), ("forward", "halfback")])),
        (at: 2.02, what: Crash("home 1")),
        (at: 5, what: Freeze("home 3")),
        (at: 7, what: Penalise("home 3")),
    ],
    expect: [Finally(what: Unlocked(Home))],
)"#;

/// Roles are swapped, and all goes well.
const SWAP: &str = r#"(
    name: "Three robots swap their roles",
    source: "a test",
    seconds: 8,
    home: (strategy: "hammerheads_swap_paper", line_up: "at_home"),
    ball: (at: (-4.2, -2.2)),
    script: [(at: 1, what: InitiateSwap(
        robot: "home 1",
        roles: [("halfback", "forward"), ("forward", "floater"), ("floater", "halfback")],
    ))],
    expect: [Finally(what: Unlocked(Home))],
)"#;

/// The forward has the ball before the goal, and nobody is in its way.
const GOAL: &str = r#"(
    name: "A forward alone before the goal",
    source: "a test",
    seconds: 12,
    referee: Whole,
    home: (strategy: "hammerheads_2001", players: [(number: 3, at: (2.0, 0.0))]),
    ball: (at: (2.8, 0.0)),
    expect: [Eventually(what: Goals(team: Home, at_least: 1), within: 12)],
)"#;

/// Robot 3 stands before its goal and is the forward; it swaps with the halfback up the field, who clears balls there, and the
/// halfback's answer is lost. An opponent comes.
const LOST_ANSWER: &str = r#"(
    name: "A lost acknowledgement leaves the goal to the opponents",
    source: "a test",
    seconds: 14,
    referee: Whole,
    home: (strategy: "hammerheads_swap", players: [(number: 1, at: (2.5, 1.5)), (number: 3, at: (-3.3, 0.8))]),
    away: (strategy: "ball_chasers", players: [(number: 0, at: (0.6, 0.0), facing: 180)]),
    ball: (at: (-2.2, 0.0)),
    faults: [(kind: AckLock, from: "home 1", to: "home 3", which: First, act: Drop)],
    script: [
        (at: 0.5, what: InitiateSwap(robot: "home 3", roles: [("halfback", "forward"), ("forward", "halfback")])),
    ],
    expect: [Eventually(what: Goals(team: Away, at_least: 1), within: 14)],
)"#;

/// A window with a scenario of one's own, in a folder that lasts as long as it.
fn scenario(folder: &Path, text: &str) -> LaidOutWindow {
    let path = folder.join("story.ron");
    std::fs::write(&path, text).expect("the folder is there");
    let mut window =
        LaidOutWindow::with(MatchRequest::Scenario { scenario: ScenarioRef::from(path), seed: None });
    window.show(SIZE, 1.0);
    window
}

impl LaidOutFrame {
    /// A text that is seen whole and of which this is a part.
    fn text(&self, part: &str) -> Option<&str> {
        self.texts.iter().find(|(text, whole)| *whole && text.contains(part)).map(|(text, _)| text.as_str())
    }

    fn assert_says(&self, part: &str) {
        assert!(self.text(part).is_some(), "no {part} in {:?}", self.texts);
    }

    /// The text in the row of another one, to the right of it and nearest to the right edge of its panel.
    fn beside(&self, text: &str) -> Option<&str> {
        let at = self.rect_of(text)?;
        let in_row = |rect: &Rect| (rect.center().y - at.center().y).abs() < 6.0 && rect.left() > at.left();
        let mut found = self.places.iter().filter(|(_, rect)| in_row(rect)).map(|(text, _)| text.as_str());
        found.next()
    }

    fn rect_of(&self, text: &str) -> Option<Rect> {
        self.places.iter().find(|(shown, _)| shown == text).map(|(_, rect)| *rect)
    }

    /// The middle of a text in the row of another one.
    fn in_row(&self, text: &str, row: &str) -> Pos2 {
        let rows: Vec<Rect> =
            self.places.iter().filter(|(shown, _)| shown == row).map(|(_, rect)| *rect).collect();
        let is_near = |rect: &Rect| rows.iter().any(|row| (row.center().y - rect.center().y).abs() < 6.0);
        let found = self.places.iter().find(|(shown, rect)| shown == text && is_near(rect));
        found.unwrap_or_else(|| panic!("no {text} beside {row} in {:?}", self.texts)).1.center()
    }
}

impl LaidOutWindow {
    /// A click on a text.
    pub(super) fn click_on(&mut self, text: &str) -> LaidOutFrame {
        let frame = self.show(SIZE, 1.0);
        let at = frame.place(text).unwrap_or_else(|| panic!("no {text} in {:?}", frame.texts));
        self.click(SIZE, at, PointerButton::Primary)
    }

    /// What the window shows while the pointer rests at a place.
    fn rest_at(&mut self, at: Pos2) -> LaidOutFrame {
        self.frame_with(SIZE, 1.0, vec![Event::PointerMoved(at)]);
        (0..60).for_each(|_| drop(self.frame(SIZE, 1.0)));
        let frame = self.frame(SIZE, 1.0);
        self.frame_with(SIZE, 1.0, vec![Event::PointerGone]);
        frame
    }

    fn type_text(&mut self, text: &str) {
        let key =
            |key, modifiers| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
        let all = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
        self.frame_with(SIZE, 1.0, vec![key(Key::A, all)]);
        self.frame_with(SIZE, 1.0, vec![Event::Text(text.into())]);
        self.frame_with(SIZE, 1.0, vec![key(Key::Enter, Modifiers::NONE)]);
    }

    /// Selects a robot with the key for the next one.
    pub(super) fn select(&mut self, robot: RobotId) {
        for _ in 0..8 {
            self.press(KeyCode::Tab, "");
            if self.app.world().resource::<crate::app::view::state::Selected>().0 == Some(robot) {
                return;
            }
        }
        panic!("{robot} is not there");
    }

    fn roles(&mut self, team: Team) -> Vec<(u8, String)> {
        let strategy = self.app.world().resource::<Strategies>().0[team.index()].clone();
        let mut robots = self.app.world_mut().query::<(&RobotId, &Role)>();
        let of_team = robots.iter(self.app.world()).filter(|(id, _)| id.team == team);
        let mut roles: Vec<(u8, String)> =
            of_team.map(|(id, role)| (id.number, strategy.roles[role.0].name.clone())).collect();
        roles.sort();
        roles
    }

    fn score(&self) -> [u32; 2] {
        self.app.world().resource::<MatchState>().score
    }

    /// The last tick on the line of a scenario.
    fn last_tick(&self) -> u64 {
        let end = self.app.world().resource::<Expectations>().end().expect("it is a scenario");
        end.max(self.rewind().end())
    }

    /// Plays until there is a goal; the tick at which it is then, and that of the goal.
    fn play_to_a_goal(&mut self) -> (u64, u64) {
        while self.score() == [0, 0] {
            let next = self.clock() + 20;
            self.play_to(next);
        }
        let goal = self.tick_of(|what| matches!(what, MatchEventKind::Call(Decision::Goal { .. })));
        (self.clock(), goal.expect("it is on the line"))
    }

    /// The tick of an event of the present branch.
    fn tick_of(&self, is_meant: impl Fn(&MatchEventKind) -> bool) -> Option<u64> {
        let mut events = self.rewind().events(self.rewind().present());
        events.find(|event| is_meant(&event.what)).map(|event| event.tick)
    }
}

const HOME_3: RobotId = RobotId::new(Team::Home, 3);

#[test]
fn a_person_finds_out_why_robot_3_stands_still() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = scenario(folder.path(), STANDS_STILL);
    window.play_to(110);
    window.select(HOME_3);
    // It looks on, by its own strategy.
    let frame = window.show(SIZE, 1.0);
    assert_eq!((frame.beside("health"), frame.beside("lock")), (Some("well"), Some("free")));
    let moves = frame.beside("moves").expect("it is told").to_owned();
    assert!(moves.starts_with("stands still: track, because "), "{moves}");
    window.press(KeyCode::KeyG, "g");
    let frame = window.show(SIZE, 1.0);
    assert!(frame.shows("States of home 3") && frame.shows("Ways out of track"), "{:?}", frame.texts);
    // A team mate holds its lock, and has crashed.
    window.play_to(135);
    let frame = window.show(SIZE, 1.0);
    assert_eq!(frame.beside("lock"), Some("held by home 1, for swap 1"), "{:?}", frame.texts);
    window.play_to(290);
    assert_eq!(window.show(SIZE, 1.0).beside("lock"), Some("free"), "its timer has run out");
    // Its wheels fail; a person sees to that.
    window.play_to(310);
    let frame = window.show(SIZE, 1.0);
    assert_eq!(frame.beside("moves"), Some("stands still: its wheels are off (frozen)"));
    assert_eq!(frame.beside("health"), Some("frozen wheels"));
    window.press(KeyCode::KeyM, "m");
    window.click_on("Robots");
    let revive = window.show(SIZE, 1.0).in_row("Revive", "home 3");
    window.click(SIZE, revive, PointerButton::Primary);
    window.play_to(330);
    assert_eq!(window.show(SIZE, 1.0).beside("health"), Some("well"));
    // The referee takes it off.
    window.play_to(440);
    let frame = window.show(SIZE, 1.0);
    assert_eq!(frame.beside("moves"), Some("stands still: taken off"));
    assert_eq!(window.rewind().branches().len(), 1, "it was the match itself all the time");
}

#[test]
fn a_person_drops_one_ackswap_and_watches_the_roll_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = scenario(folder.path(), SWAP);
    let before = window.roles(Team::Home);
    window.press(KeyCode::KeyM, "m");
    window.play_to(150);
    let swapped = window.roles(Team::Home);
    let role = |roles: &[(u8, String)], number: usize| roles[number].1.clone();
    assert_eq!([1, 2, 3].map(|number| role(&swapped, number)), ["forward", "halfback", "floater"]);
    // The messages of the swap are there; a click on one tells of it.
    let labels: Vec<Pos2> = {
        let frame = window.show(SIZE, 1.0);
        let mut labels = frame.places.iter().filter(|(text, _)| text == "ACKSWAP 1");
        labels.by_ref().map(|(_, rect)| rect.center()).collect()
    };
    assert_eq!(labels.len(), 3, "all others have acknowledged");
    let told = labels.into_iter().find(|label| {
        window.click(SIZE, *label, PointerButton::Primary).text("ACKSWAP 1 from home 3 to home 1").is_some()
    });
    assert!(told.is_some(), "one of them is of home 3");
    window.show(SIZE, 1.0).assert_says("arrived after ");
    window.click_on("Go there");
    let frame = window.show(SIZE, 1.0);
    frame.assert_says("on its way");
    let tick = window.clock();
    assert!((60..80).contains(&tick), "{tick}");
    window.click_on("Drop");
    window.play_to(150);
    window.show(SIZE, 1.0).assert_says("lost: fault rule");
    // The swap has come to nothing: each has its role back.
    assert_eq!(window.roles(Team::Home), before);
    assert_eq!(window.rewind().branch(window.rewind().present()).name, "a message dropped");
    let back = window.tick_of(|what| matches!(what, MatchEventKind::RolledBack { robot: HOME_3, .. }));
    let back = back.expect("it is on the line");
    let place = window.show(SIZE, 1.0).place_of(back, window.last_tick());
    let frame = window.rest_at(place);
    frame.assert_says("home 3 has its role forward back: the swap is rolled back");
    frame.assert_says("home 2 has its role floater back: the swap is rolled back");
    // The old future is beside it, as it went.
    window.press(KeyCode::KeyJ, "j");
    assert_eq!(window.clock(), back, "the last that happened");
    let old = window.rewind().branch(BranchId(0));
    assert!(!old.events.iter().any(|event| matches!(event.what, MatchEventKind::RolledBack { .. })));
    let radio = window.app.world().resource::<RadioRecord>();
    let lost = radio.transmissions().filter(|sent| matches!(sent.state, TransmissionState::Lost(_)));
    assert_eq!(lost.count(), 1, "it took no other");
}

/// The weight of the pushing itself.
const PUSH: &str = "assemblages.push_to_goal.WeightedSum[0][0][0]";

#[test]
fn a_person_goes_back_to_before_a_goal_and_prevents_it_by_one_weight() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = scenario(folder.path(), GOAL);
    let (end, goal) = window.play_to_a_goal();
    let frame = window.show(SIZE, 1.0);
    frame.assert_says("Goal for home, 1:0");
    // A click on the goal's mark goes there, and a drag to some seconds before.
    let last = window.last_tick();
    window.drag(frame.place_of(goal, last), frame.place_of(goal, last));
    assert_eq!((window.clock(), window.score()), (goal, [0, 0]));
    window.drag(frame.place_of(goal, last), frame.place_of(100, last));
    assert!(window.clock().abs_diff(100) <= 2, "{}", window.clock());
    // The numbers of its strategy.
    window.select(HOME_3);
    for section in ["Activity", "Motor", "Beliefs beside the truth", "Percepts"] {
        window.click_on(section);
    }
    window.click_on("Every number of the strategy");
    let hint = window.show(SIZE, 1.0).text("find among ").expect("numbers can be looked for").to_owned();
    window.click_on(&hint);
    window.type_text("push_to_goal");
    let frame = window.show(SIZE, 1.0);
    assert_eq!(frame.beside(PUSH), Some("1"), "{:?}", frame.texts);
    let value = frame.in_row("1", PUSH);
    window.click(SIZE, value, PointerButton::Primary);
    window.type_text("0");
    window.show(SIZE, 1.0).assert_says("changed (1)");
    window.play_to(end + 60);
    // No goal here, and one in the old future beside it.
    let frame = window.show(SIZE, 1.0);
    assert_eq!(window.score(), [0, 0]);
    assert_eq!(window.rewind().branches().len(), 2);
    assert_eq!(window.rewind().branch(window.rewind().present()).name, "the strategy of home");
    frame.assert_says("1 : 0");
}

#[test]
fn a_person_sees_which_lost_message_cost_the_goal() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = scenario(folder.path(), LOST_ANSWER);
    let (end, goal) = window.play_to_a_goal();
    window.show(SIZE, 1.0).assert_says("Goal for away, 0:1");
    // To the goal, and why.
    while window.clock() != goal {
        window.press(KeyCode::KeyJ, "j");
    }
    window.press(KeyCode::KeyY, "y");
    while window.app.world().resource::<AskedWhy>().report.is_none() {
        window.frame(SIZE, 1.0);
        std::thread::yield_now();
    }
    let frame = window.show(SIZE, 1.0);
    frame.assert_says("it is 0 : 1. This would have changed it:");
    let (found, _) =
        frame.texts.iter().find(|(text, whole)| *whole && text.contains("  If ")).expect("a row");
    let reason = "the ACKLOCK from home 1 to home 3 arrives, which was lost (fault rule)";
    assert!(found.contains(reason), "the first is {found}, in {:?}", frame.texts);
    let found = found.clone();
    assert_eq!(frame.beside("0:0 instead of 0:1"), Some("4 of 4 other dice agree"), "{:?}", frame.texts);
    // A click plays on with it.
    window.click_on(&found);
    assert_eq!(window.rewind().branches().len(), 2);
    assert_eq!(window.rewind().branch(window.rewind().present()).name, reason);
    window.play_to(end + 30);
    assert_eq!(window.score(), [0, 0]);
    window.show(SIZE, 1.0).assert_says("0 : 1");
}
