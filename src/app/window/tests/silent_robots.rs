//! What a person sees of robots that are processes of their own and do not answer.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use egui::{Rect, vec2};

use super::{LaidOutWindow, assets, egui};
use crate::app::match_request::MatchRequest;
use crate::app::view::colours;
use crate::app::view::time::remote_robots::Missing;
use crate::app::view::time::remote_robots::tests::{REMOTE, write_addresses};
use crate::clock::Clock;
use crate::comms::tcm::Peer;
use crate::game::net::{self, NetworkPlan, RobotProcess};
use crate::game::{Choice, MatchPlan};

#[test]
fn robots_elsewhere_are_awaited_in_the_middle_and_who_falls_silent_in_play_is_named_on_a_red_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let addresses = folder.path().join("addresses.ron");
    drop(write_addresses(&addresses));
    let network = Box::new(NetworkPlan { udp: true, remote: vec![REMOTE], ..NetworkPlan::default() });
    let choice = Choice { network, addresses: Some(addresses), seed: 3, ..Choice::default() };
    let plan = MatchPlan::read(&assets(), &choice).expect("the shipped match");
    let at = plan.directory().address_of(Peer::from(REMOTE)).expect("it has an address");
    let mut program = LaidOutWindow::with(MatchRequest::Match(choice));
    let size = vec2(1280.0, 720.0);
    let line = format!("Home 1 stands still: nobody answers at {at}");
    let waiting = program.show(size, 1.0);
    assert!(waiting.shows("The match begins when these robots have answered"), "{:?}", waiting.texts);
    assert!(waiting.shows(&format!("Home 1 at {at}")) && !waiting.shows(&line), "{:?}", waiting.texts);
    let stops = Arc::new(AtomicBool::new(false));
    let stopped = stops.clone();
    let robot = std::thread::spawn(move || {
        let mut process = RobotProcess::open(&plan, REMOTE, at).expect("its address is free");
        process.play(net::PATIENCE, &|| stopped.load(Ordering::Relaxed))
    });
    while program.app.world().resource::<Clock>().tick == 0 {
        let frame = program.frame(size, 1.0);
        assert!(!frame.shows(&line) && !robot.is_finished(), "{:?}", frame.texts);
    }
    stops.store(true, Ordering::Relaxed);
    robot.join().expect("it does not panic").expect("it belongs to the match");
    while program.app.world().resource::<Missing>().robots.is_empty() {
        program.frame(size, 1.0);
    }
    let silent = program.show(size, 1.0);
    assert!(silent.shows(&line) && silent.shows("Play it here"), "{:?}", silent.texts);
    let red = colours::egui(colours::TROUBLE);
    let grounds: Vec<Rect> =
        silent.grounds.iter().filter(|(_, fill)| *fill == red).map(|(rect, _)| *rect).collect();
    assert!(grounds.len() == 1 && grounds[0].width() == size.x, "{grounds:?}");
    silent.assert_apart("a silent robot");
    silent.assert_time_and_pitch("a silent robot");
}
