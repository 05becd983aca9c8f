//! A person reads the state machine of a robot and what it came from.

use std::collections::BTreeMap;

use egui::{PointerButton, vec2};

use super::{LaidOutFrame, LaidOutWindow, ROBOT, egui};
use crate::app::match_request::MatchRequest;
use crate::app::view::colours;
use crate::app::view::state::{Action, Overlay, Overlays, PanelSizes, Playback, Selected, Session};
use crate::clock::Clock;
use crate::game::{Choice, Match};
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

/// A double click beside the boxes brings the whole chart into sight.
fn whole_chart(window: &mut LaidOutWindow, frame: &LaidOutFrame) -> LaidOutFrame {
    let corner = frame.place("Conditions").expect("the chart is below its controls") + vec2(0.0, 30.0);
    window.click(SIZE, corner, PointerButton::Primary);
    window.click(SIZE, corner, PointerButton::Primary);
    window.show(SIZE, 1.0)
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
        let frame = whole_chart(&mut window, &frame);
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

/// How often the robots of home have come to each state of the machine that a robot runs, by its name; its robots begin in one each.
fn entered(window: &mut LaidOutWindow, until: u64) -> BTreeMap<String, u32> {
    let (own, strategy) = (activity(window), window.app.world().resource::<Strategies>().0[0].clone());
    let index = own.machine(&strategy);
    let machine = &strategy.machines[index];
    let mut counts: BTreeMap<String, u32> =
        machine.all_states().map(|state| (machine.name_of(state).to_owned(), 0)).collect();
    let plan = window.app.world().resource::<Session>().plan.clone().expect("it is a match");
    let mut game = Match::new(&plan);
    while game.clock().tick < until {
        game.tick();
        let last = game.clock().tick - 1;
        let world = game.world_mut();
        let mut robots = world.query::<(&RobotId, &Activity)>();
        for (_, activity) in robots.iter(world).filter(|(id, _)| id.team == ROBOT.team) {
            if activity.machine(&strategy) == index && activity.since == last {
                *counts.entry(machine.states[activity.state].name.clone()).or_default() += 1;
            }
        }
    }
    counts
}

/// What is written right below the name of a state.
fn told_below<'a>(frame: &'a LaidOutFrame, state: &str, at: egui::Pos2) -> &'a str {
    let is_below = |rect: &egui::Rect| rect.contains(at + vec2(0.0, 12.0));
    let mut below = frame.places.iter().filter(|(text, rect)| text != state && is_below(rect));
    below.next().map(|(text, _)| text.as_str()).unwrap_or_default()
}

#[test]
fn with_counts_the_chart_tells_how_often_each_state_was_reached_and_what_never_was() {
    let mut window = charted(Choice::default());
    window.app.insert_resource(PanelSizes { states: 700.0, ..PanelSizes::default() });
    // The ground of a box, which lies over all others.
    let ground = |frame: &LaidOutFrame, at: egui::Pos2| {
        let covers = |(rect, colour): &&(egui::Rect, egui::Color32)| rect.contains(at) && colour.a() > 0;
        frame.grounds.iter().rev().find(covers).map(|(_, colour)| *colour)
    };
    let [plain, dead] = [colours::RAISED, colours::SUNKEN].map(|colour| Some(colours::egui(colour)));
    while activity(&mut window).history.len() < 3 {
        window.frame(SIZE, 1.0);
    }
    window.app.insert_resource(Playback { paused: true, ..Playback::default() });
    let frame = window.show(SIZE, 1.0);
    let before = whole_chart(&mut window, &frame);
    let choice = before.place("match").expect("there is a choice");
    window.click(SIZE, choice, PointerButton::Primary);
    let frame = window.show(SIZE, 1.0);
    let tick = window.app.world().resource::<Clock>().tick;
    let (current, _) = states(&mut window);
    let (mut reached, mut never) = (0, 0);
    for (state, count) in entered(&mut window, tick) {
        // The name of a state stands in the lists beside the chart, too.
        let named = frame.places.iter().filter(|(text, _)| *text == state).map(|(_, rect)| rect.center());
        let seen: Vec<_> = named
            .map(|at| (told_below(&frame, &state, at), ground(&frame, at), ground(&before, at)))
            .collect();
        let is_told = match count {
            _ if state == current => seen.iter().any(|(told, ..)| told.starts_with("for ")),
            0 => seen.iter().any(|(told, now, _)| (*told, *now) == ("never", dead)),
            _ => seen.iter().any(|(told, now, was)| {
                told.starts_with(&format!("{count}×, ")) && *now != dead && *now != plain && *was == plain
            }),
        };
        assert!(is_told, "{state}, reached {count} times: {seen:?}");
        (reached, never) = (reached + u32::from(count > 0), never + u32::from(count == 0));
    }
    assert!(reached > 1 && never > 0, "{reached} reached, {never} never");
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
