//! Marks of the past: bookmarks are kept at once, two keys go from event to event, and Escape closes what is open.

use bevy::input::ButtonState;
use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;
use egui::{Event, Modifiers, PointerButton};

use super::rewind::SIZE;
use super::{LaidOutWindow, egui};
use crate::app::match_request::MatchRequest;
use crate::app::view::state::{Action, OpenDialogues, PendingMatch, Question};
use crate::app::view::time::recording::Recording;
use crate::game::Choice;
use crate::lab::replay::Replay;
use crate::lab::rewind::BranchId;

#[test]
fn a_bookmark_is_in_the_file_within_a_second_although_the_match_is_paused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.replay");
    let mut window = LaidOutWindow::new();
    window.app.insert_resource(Recording::to(Some(path.clone())));
    window
        .app
        .insert_resource(PendingMatch(Some(MatchRequest::Match(Choice { seed: 3, ..Choice::default() }))));
    window.frame(SIZE, 1.0);
    window.play_to(75);
    let second = |window: &mut LaidOutWindow| (0..62).for_each(|_| drop(window.frame(SIZE, 1.0)));
    let kept = || {
        let replay = Replay::read(&path).expect("it was begun");
        replay.bookmarks().into_iter().map(|bookmark| (bookmark.tick, bookmark.note)).collect::<Vec<_>>()
    };
    window.press(KeyCode::KeyB, "b");
    second(&mut window);
    assert_eq!(kept(), [(75, "A bookmark".to_owned())], "the program may die now");
    window.press(KeyCode::KeyB, "b");
    second(&mut window);
    assert_eq!(kept(), []);
}

#[test]
fn two_keys_go_from_event_to_event_and_say_what_happened() {
    let mut window = LaidOutWindow::scenario("swap_figure_8");
    window.play_to(60);
    window.press(KeyCode::KeyB, "b");
    window.play_to(400);
    let rewind = window.rewind();
    let mut ticks: Vec<u64> = rewind.events(BranchId(0)).map(|event| event.tick).chain([60]).collect();
    ticks.sort_unstable();
    ticks.dedup();
    let mut back = Vec::new();
    for _ in 0..ticks.len() {
        window.press(KeyCode::KeyJ, "j");
        back.push(window.clock());
    }
    assert_eq!(back.iter().rev().copied().collect::<Vec<_>>(), ticks);
    window.press(KeyCode::KeyJ, "j");
    assert!(window.frame(SIZE, 1.0).shows("Nothing has happened before"));
    assert_eq!(window.clock(), ticks[0]);
    window.go_to(59);
    window.press(KeyCode::KeyK, "k");
    assert!(window.clock() == 60 && window.frame(SIZE, 1.0).shows("A bookmark"));
    window.go_to(400);
    window.press(KeyCode::KeyK, "k");
    assert!(window.clock() == 400 && window.frame(SIZE, 1.0).shows("Nothing is known of what comes"));
}

#[test]
fn escape_closes_the_menu_of_the_past_and_the_world_and_asks_nothing() {
    let mut window = LaidOutWindow::playing(None);
    window.play_to(30);
    let question = |window: &LaidOutWindow| window.app.world().resource::<OpenDialogues>().question;
    let escape = |window: &mut LaidOutWindow| {
        let key = Event::Key {
            key: egui::Key::Escape,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        let logical_key = Key::Escape;
        let (key_code, state) = (KeyCode::Escape, ButtonState::Pressed);
        let window_of = Entity::PLACEHOLDER;
        let pressed =
            KeyboardInput { key_code, logical_key, state, text: None, repeat: false, window: window_of };
        window.app.world_mut().write_message(pressed);
        window.frame_with(SIZE, 1.0, vec![key]);
        window.show(SIZE, 1.0)
    };
    let past = window.show(SIZE, 1.0).place("Past ⏶").expect("there is a menu");
    assert!(window.click(SIZE, past, PointerButton::Primary).shows("Save as scenario"));
    let closed = escape(&mut window);
    assert!(!closed.shows("Save as scenario") && question(&window).is_none(), "{:?}", closed.texts);
    window.app.world_mut().write_message(Action::World);
    assert!(window.show(SIZE, 1.0).shows("World (F12)"));
    assert!(!escape(&mut window).shows("World (F12)") && question(&window).is_none());
    escape(&mut window);
    assert_eq!(question(&window), Some(Question::Leave), "nothing else is open");
}
