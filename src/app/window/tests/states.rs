//! A person reads the state machine of a robot and what it came from.

use egui::{PointerButton, vec2};

use super::{LaidOutWindow, ROBOT, egui};
use crate::app::match_request::MatchRequest;
use crate::app::view::state::{Action, Overlay, Overlays, Playback, Selected};
use crate::game::Choice;
use crate::ids::RobotId;
use crate::strategy::{Activity, Strategies};

const SIZE: egui::Vec2 = vec2(1600.0, 1000.0);

/// A match with the chart of a robot open.
fn charted(choice: Choice) -> LaidOutWindow {
    let mut window = LaidOutWindow::with(MatchRequest::Match(Choice { seed: 3, ..choice }));
    window.app.insert_resource(Selected(Some(ROBOT)));
    window.app.insert_resource(Overlays::only([Overlay::States]));
    window
}

fn activity(window: &mut LaidOutWindow) -> Activity {
    let world = window.app.world_mut();
    let mut robots = world.query::<(&RobotId, &Activity)>();
    let found = robots.iter(world).find(|(id, _)| **id == ROBOT);
    found.map(|(_, activity)| activity.clone()).expect("the robot is there")
}

/// The name of the state that the robot is in, and those of all states of its machine.
fn states(window: &mut LaidOutWindow) -> (String, Vec<String>) {
    let activity = activity(window);
    let strategy = window.app.world().resource::<Strategies>().0[ROBOT.team.index()].clone();
    let machine = &strategy.machines[activity.machine(&strategy)];
    let names = machine.all_states().map(|state| machine.name_of(state).to_owned());
    (machine.states[activity.state].name.clone(), names.collect())
}

#[test]
fn the_key_opens_the_chart_of_the_selected_robot_with_all_its_states_and_the_time_in_the_one_it_is_in() {
    for file in ["friendly", "four_legged_2005"] {
        let mut window = charted(Choice { file: Some(file.into()), ..Choice::default() });
        window.app.insert_resource(Overlays::only([]));
        assert!(!window.show(SIZE, 1.0).shows("States of home 1"));
        window.app.world_mut().write_message(Action::Switch(Overlay::States));
        (0..240).for_each(|_| drop(window.frame(SIZE, 1.0)));
        window.app.insert_resource(Playback { paused: true, ..Playback::default() });
        let frame = window.show(SIZE, 1.0);
        let (current, all) = states(&mut window);
        assert!(frame.shows("States of home 1") && frame.shows(&current), "{current} in {:?}", frame.texts);
        let corner = frame.place("Conditions").expect("the chart is below its controls") + vec2(0.0, 30.0);
        window.click(SIZE, corner, PointerButton::Primary);
        window.click(SIZE, corner, PointerButton::Primary);
        let frame = window.show(SIZE, 1.0);
        for state in &all {
            assert!(frame.shows(state), "{file}: {state} in {:?}", frame.texts);
        }
        assert!(
            frame.texts.iter().any(|(text, whole)| *whole && text.starts_with("for ")),
            "{:?}",
            frame.texts
        );
        assert!(frame.shows("How home 1 came here"), "{:?}", frame.texts);
    }
}

#[test]
fn a_click_on_a_state_shows_its_ways_out_and_another_robot_shows_its_own() {
    let mut window = charted(Choice::default());
    window.show(SIZE, 1.0);
    window.app.insert_resource(Playback { paused: true, ..Playback::default() });
    let frame = window.show(SIZE, 1.0);
    let (current, all) = states(&mut window);
    let other = all.iter().find(|state| **state != current && frame.place(state).is_some());
    let other = other.expect("another state is in sight");
    assert!(frame.shows(&format!("Ways out of {current}")), "{:?}", frame.texts);
    let at = frame.place(other).expect("it is in sight");
    let frame = window.click(SIZE, at, PointerButton::Primary);
    assert!(frame.shows(&format!("Ways out of {other}")), "{:?}", frame.texts);
    window.app.world_mut().write_message(Action::NextRobot);
    let frame = window.show(SIZE, 1.0);
    assert!(
        !frame.shows("States of home 1") && !frame.shows(&format!("Ways out of {other}")),
        "{:?}",
        frame.texts
    );
}

#[test]
fn nothing_on_the_chart_moves_while_the_match_is_paused() {
    let mut window = charted(Choice::default());
    let before = activity(&mut window).history.len();
    while activity(&mut window).history.len() == before {
        window.frame(SIZE, 1.0);
    }
    window.app.insert_resource(Playback { paused: true, ..Playback::default() });
    // What was announced has been read.
    (0..200).for_each(|_| drop(window.frame(SIZE, 1.0)));
    let first = window.show(SIZE, 1.0);
    (0..30).for_each(|_| drop(window.frame(SIZE, 1.0)));
    let later = window.show(SIZE, 1.0);
    assert_eq!(first.texts, later.texts);
    assert_eq!(first.colours, later.colours);
    window.app.world_mut().resource_mut::<Playback>().single_ticks += 20;
    assert_ne!(window.show(SIZE, 1.0).colours, first.colours, "the flash fades as the match goes on");
}
