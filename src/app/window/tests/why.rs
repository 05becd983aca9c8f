//! A person asks why things stand as they do.

use bevy::prelude::*;

use super::LaidOutWindow;
use super::rewind::SIZE;
use crate::app::view::time::asking::AskedWhy;
use crate::ids::Team;
use crate::lab::why::MatchStanding;

#[test]
fn a_person_asks_why_a_role_is_doubled_and_plays_on_without_the_loss_that_did_it() {
    let mut window = LaidOutWindow::scenario("counterexample_02_two_generals_unlocked_at_once:paper");
    window.play_to(201);
    let doubled = |window: &mut LaidOutWindow| MatchStanding::of(window.app.world_mut()).doubled;
    assert_eq!(doubled(&mut window), [(Team::Home, "halfback".to_owned())]);
    window.press(KeyCode::KeyY, "y");
    while window.app.world().resource::<AskedWhy>().report.is_none() {
        window.frame(SIZE, 1.0);
        std::thread::yield_now();
    }
    assert_eq!(window.clock(), 201, "the match stands meanwhile");
    let frame = window.show(SIZE, 1.0);
    let line = "If the ACKSWAP from home 3 to home 1 arrives, which was lost (fault rule)";
    let (shown, place) = frame.places.iter().find(|(shown, _)| shown.contains(line)).expect("it is told");
    assert!(
        frame.texts.iter().any(|(text, _)| text.contains("no role is given twice; it was home halfback"))
    );
    let place = place.center();
    assert!(shown.starts_with("1."), "at about a second: {shown}");
    window.drag(place, place);
    assert_eq!(window.rewind().branches().len(), 2);
    let name = &window.rewind().branch(window.rewind().present()).name;
    assert!(name.contains("the ACKSWAP from home 3 to home 1"), "{name}");
    window.play_to(201);
    assert_eq!(doubled(&mut window), []);
}
