//! What fuzzing has found worth keeping, run through the same checks.

use std::path::Path;

#[path = "../../fuzz/checks/files.rs"]
mod files;
#[path = "../../fuzz/checks/gamecontroller.rs"]
mod gamecontroller;
#[path = "../../fuzz/checks/pictures.rs"]
mod pictures;
#[path = "../../fuzz/checks/requests.rs"]
mod requests;
#[path = "../../fuzz/checks/shipped.rs"]
mod shipped;
#[path = "../../fuzz/checks/tcm.rs"]
mod tcm;

/// Runs a check over every file of a fuzz target's corpus.
fn replay(target: &str, check: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let mut files = 0;
    for entry in std::fs::read_dir(&folder).unwrap() {
        let input = std::fs::read(entry.unwrap().path()).unwrap();
        check(&input);
        files += 1;
    }
    assert!(files > 0, "{} is empty", folder.display());
}

#[test]
fn datagrams_of_the_tcm_keep_within_the_limits() {
    replay("tcm_datagrams", tcm::datagrams);
}

#[test]
fn headers_of_the_tcm_are_read_as_they_are_written() {
    replay("tcm_header", tcm::header);
}

#[test]
fn messages_of_the_tcm_arrive_as_they_were_sent() {
    replay("external_message", tcm::external_message);
}

#[test]
fn what_chaos_manager_and_robots_say_comes_back_as_it_was() {
    replay("chaos_data", tcm::chaos_data);
}

#[test]
fn control_packets_are_read_as_they_are_written() {
    replay("gamecontroller_control", gamecontroller::control);
}

#[test]
fn status_packets_are_read_as_they_are_written() {
    replay("gamecontroller_status", gamecontroller::status);
}

#[test]
fn a_referee_box_is_followed_or_ignored() {
    replay("gamecontroller_box", gamecontroller::referee_box);
}

#[test]
fn assets_are_read_or_told_what_is_wrong_with_them() {
    replay("asset", files::asset);
}

#[test]
fn recordings_are_read_or_told_what_is_wrong_with_them() {
    replay("replay", files::replay);
}

#[test]
fn a_match_stays_in_the_world_whatever_is_asked_of_it() {
    replay("requests", requests::requests);
}

#[test]
fn what_is_recognised_in_a_picture_is_at_a_place() {
    replay("picture", pictures::picture);
}
