//! A person looks at the whole world.

use std::collections::BTreeSet;

use egui::{PointerButton, vec2};

use super::{LaidOutFrame, LaidOutWindow, egui};
use crate::app::view::state::{Action, Playback};
use crate::comms::radio::InFlight;
use crate::ids::RobotId;
use crate::mind::teamwork::Booking;

const SIZE: egui::Vec2 = vec2(1600.0, 1000.0);
/// So that all components of a robot are in sight.
const TALL: egui::Vec2 = vec2(1600.0, 3000.0);

/// A scenario of robots that swap roles, paused while a message of a swap is in flight, with the world open; and what that message
/// is to be called.
fn open_world() -> (LaidOutWindow, String) {
    let mut window = LaidOutWindow::scenario("swap_figure_8");
    let in_flight = |window: &mut LaidOutWindow| {
        let world = window.app.world_mut();
        let mut messages = world.query::<&InFlight>();
        let mut packets = messages.iter(world).map(|message| message.packet.clone());
        packets.find(|packet| packet.kind.to_string() == "LOCK")
    };
    let packet = (0..3000).find_map(|_| {
        window.frame(SIZE, 1.0);
        in_flight(&mut window)
    });
    let packet = packet.expect("somebody wants to swap");
    window.app.insert_resource(Playback { paused: true, ..Playback::default() });
    window.app.world_mut().write_message(Action::World);
    (window, format!("LOCK from {} to {}", packet.from, packet.to))
}

#[test]
fn robots_messages_and_walls_have_names_and_a_click_shows_their_components() {
    let (mut window, message) = open_world();
    let frame = window.show(SIZE, 1.0);
    let texts: BTreeSet<&str> = frame.texts.iter().map(|(text, _)| text.as_str()).collect();
    for name in ["home 1", "trailer of home 1", "ball", message.as_str()] {
        assert!(texts.contains(name), "{name} in {texts:?}");
    }
    assert!(texts.iter().any(|text| text.starts_with("wall at ")), "{texts:?}");
    let nameless =
        texts.iter().find(|text| text.starts_with("Entity") || text.contains("without components"));
    assert_eq!(nameless, None);
    let robot = frame.place("home 1").expect("it is in sight");
    window.click(SIZE, robot, PointerButton::Primary);
    let opened = window.show(SIZE, 1.0);
    // In the order of the alphabet; the others are below the edge.
    for component in ["Activity", "Contributions", "DriveCommand"] {
        assert!(opened.texts.iter().any(|(text, _)| text == component), "{component} in {:?}", opened.texts);
    }
}

#[test]
fn what_a_person_looks_for_is_found_by_a_part_of_its_name() {
    let (mut window, message) = open_world();
    let find = window.show(SIZE, 1.0).place("Find").expect("there is a field");
    window.click(SIZE, find + vec2(60.0, 0.0), PointerButton::Primary);
    window.frame_with(SIZE, 1.0, vec![egui::Event::Text("lock f".into())]);
    let frame = window.show(SIZE, 1.0);
    assert!(frame.shows(&message) && !frame.shows("trailer of home 1"), "{:?}", frame.texts);
}

/// A click on a text, in a window in which all components of a robot are in sight.
fn open(window: &mut LaidOutWindow, text: &str) -> LaidOutFrame {
    let frame = window.show(TALL, 1.0);
    let at = frame.place(text).unwrap_or_else(|| panic!("no {text} in {:?}", frame.texts));
    window.click(TALL, at, PointerButton::Primary);
    window.show(TALL, 1.0)
}

/// Opens each component and looks for a field of it.
fn assert_shows_fields(window: &mut LaidOutWindow, expected: &[(&str, &str)]) {
    for (component, field) in expected {
        let opened = open(window, component);
        // A field that has parts is told with its type.
        let is_named = |text: &str| text.split("  ").next() == Some(*field);
        let is_there = opened.texts.iter().any(|(text, whole)| *whole && is_named(text));
        assert!(is_there, "{field} of {component} in {:?}", opened.texts);
        open(window, component);
    }
}

#[test]
fn what_robots_and_messages_are_made_of_is_shown_field_by_field() {
    let (mut window, message) = open_world();
    open(&mut window, "home 1");
    let fields = [
        ("Robot", "crashed"),
        ("Pose", "heading"),
        ("Percepts", "frame"),
        ("WorldModel", "mates"),
        ("DriveCommand", "left"),
        ("Orders", "state"),
        ("Odometry", "turn_rate"),
        ("Contributions", "vectors"),
        ("Swapping", "held"),
        ("Swapping", "attempt"),
        ("TeamModel", "carrier"),
        ("TcmClient", "queues"),
    ];
    assert_shows_fields(&mut window, &fields);
    open(&mut window, "home 1");
    open(&mut window, &message);
    let fields = [("InFlight", "due"), ("InFlight", "late"), ("InFlight", "packet")];
    assert_shows_fields(&mut window, &fields);
}

#[test]
fn whom_a_robot_believes_to_have_booked_the_ball_is_shown_field_by_field() {
    let mut window = LaidOutWindow::scenario("booking_one_goes");
    let booked = |window: &mut LaidOutWindow| {
        let world = window.app.world_mut();
        let mut robots = world.query::<(&RobotId, &Booking)>();
        robots.iter(world).find(|(_, booking)| booking.0.booking().is_some()).map(|(robot, _)| *robot)
    };
    let robot = (0..600).find_map(|_| {
        window.frame(SIZE, 1.0);
        booked(&mut window)
    });
    window.app.insert_resource(Playback { paused: true, ..Playback::default() });
    window.app.world_mut().write_message(Action::World);
    open(&mut window, &robot.expect("somebody books the ball").to_string());
    assert_shows_fields(&mut window, &[("Booking", "booking"), ("Booking", "robot_booker")]);
}
