//! Files of all kinds, as a person keeps, damages and changes them.

mod bases;
mod probabilities;
mod variants;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use tempfile::TempDir;
use touchline::data::AssetKind;

use crate::support::assets;

/// A folder of a person's own files.
struct Own(TempDir);

impl Own {
    fn new() -> Own {
        Own(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("the folder is made");
        fs::write(&path, text).expect("the file is written");
        path
    }

    /// Calls the program in this folder, with the shipped assets.
    fn touchline(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_touchline"))
            .args(arguments)
            .env("TOUCHLINE_ASSETS", assets().root())
            .current_dir(self.0.path())
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .output()
            .expect("the program starts")
    }

    /// What `check` prints of files, and its exit code.
    fn check(&self, files: &[&str]) -> (String, Option<i32>) {
        let output = self.touchline(&[&["check"], files].concat());
        (String::from_utf8_lossy(&output.stdout).into_owned(), output.status.code())
    }
}

/// The text of a shipped file.
fn shipped(kind: AssetKind, name: &str) -> String {
    fs::read_to_string(assets().file(kind, name)).expect("the shipped file can be read")
}

#[test]
fn a_name_given_twice_is_told_at_its_second_place_in_every_kind_of_file() {
    use AssetKind::{Addresses, Camera, Experiment, Match, Pitch, Radio, Robot, Scenario, Sensing, Tuning};
    let (strategy, swap) =
        ((AssetKind::Strategy, "hammerheads_2001"), (Scenario, "swap_with_radio_that_fails_later"));
    let own = Own::new();
    for ((kind, name), piece, again, field) in [
        (strategy, "\"goal_area\": (min", "\"goal_area\": (min: (0, 0), max: (1, 1))", "zones.goal_area"),
        (strategy, "\"before_area\": At", "\"before_area\": Ball", "percepts.before_area"),
        (strategy, "\"betters\": Union", "\"betters\": Superiors", "point_sets.betters"),
        (strategy, "\"ball_known\": Known", "\"ball_known\": Known(Own)", "features.ball_known"),
        (
            strategy,
            "\"dock\": DockBehind",
            "\"dock\": DockBehind(toward: OurGoal, standoff: 1)",
            "schemas.dock",
        ),
        (strategy, "\"acquire\": WeightedSum", "\"acquire\": WeightedSum([])", "assemblages.acquire"),
        (strategy, "\"goalie\": (", "\"goalie\": (start: \"a\", states: {\"a\": ()})", "machines.goalie"),
        (strategy, "goalie: \"goalie\"", "goalie: \"halfback\"", "teamwork.goalie"),
        (strategy, "\"cye\", \"aibo_ers7\"", "\"cye\"", "robot_kinds[1]"),
        (strategy, "TeammateAvoidance", "TeammateAvoidance", "teamwork.mechanisms[2]"),
        (
            strategy,
            "\"halfback\", \"floater\", \"forward\"],\n        goalie",
            "\"halfback\"",
            "teamwork.hierarchy[2]",
        ),
        (swap, "0: \"goalie\", 1: \"half", "0: \"forward\"", "RolesAre[1].0"),
        (swap, "seconds:", "seconds: 1", "seconds"),
        (
            (Robot, "aibo_ers7"),
            "\"power\": (",
            "\"power\": (direction: 0, run_out: 1, run_out_spread: 0, spread: 1, time: 1, from_hold: true)",
            "kicks.power",
        ),
        ((Match, "friendly"), "strategy: \"ball", "strategy: \"x\"", "away.strategy"),
        ((Pitch, "middle_size_2001"), "length:", "length: 1", "length"),
        ((Sensing, "cye_2001"), "frame_hz:", "frame_hz: 1", "eyes.Real.camera.frame_hz"),
        ((Radio, "good"), "jitter:", "jitter: 0", "latency.jitter"),
        ((Camera, "cye_2001"), "Red: (y", "Red: (y: (1, 2), u: (1, 2), v: (1, 2))", "colours.Red"),
        ((Camera, "cye_2001"), "tilt:", "tilt: 1", "optics.tilt"),
        ((Experiment, "booking"), "blocks:", "blocks: (first: 1, number: 1)", "blocks"),
        ((Tuning, "booking"), "candidates:", "candidates: 2", "candidates"),
        ((Addresses, ""), "\"home 0\"", "\"home 0\": \"127.0.0.1:7401\"", "[\"home 0\"]"),
    ] {
        let text =
            if kind == Addresses { "{\"home 0\": \"127.0.0.1:7400\"}".into() } else { shipped(kind, name) };
        assert!(text.contains(piece), "`{piece}` is not in {name}");
        let place = text.find(piece).expect("it is there");
        let (line, column) = (
            text[..place].matches('\n').count() + 1,
            text[..place].rfind('\n').map_or(place, |end| place - end - 1),
        );
        let file = own.write("twice.ron", text.replacen(piece, &format!("{again}, {piece}"), 1));
        let (told, code) = own.check(&["twice.ron"]);
        assert_eq!(code, Some(2), "{told}");
        let fault = told.lines().next().unwrap_or_default();
        let at = column + again.chars().count() + 3;
        assert!(
            fault.starts_with(&format!("fault twice.ron:{line}:{at}: ")),
            "{line}:{at} for {piece}: {fault}"
        );
        assert!(fault.contains(field) && fault.contains("is given twice"), "{field}: {fault}");
        fs::remove_file(file).expect("the file is removed");
    }
}

#[test]
fn places_for_a_kick_off_are_checked_in_a_strategy_by_itself_for_its_robots_on_its_pitch() {
    let own = Own::new();
    let shipped = shipped(AssetKind::Strategy, "ball_chasers");
    let line = shipped.lines().position(|line| line.contains("theirs: [")).expect("it is there") + 1;
    let check = |changes: &[(&str, &str)]| {
        let text = changes.iter().fold(shipped.clone(), |text, (from, to)| {
            assert!(text.contains(from), "`{from}` is not in the strategy");
            text.replacen(from, to, 1)
        });
        own.write("mine.ron", text);
        own.check(&["mine.ron"])
    };
    let theirs = "theirs: [(-0.95, 0.3), (-1.4, 1.2)";
    let close = (theirs, "theirs: [(-0.95, 0.3), (-1.0, 0.6)");
    let faults: [(&[(&str, &str)], &str); 5] = [
        (&[close], "a robot at (-1, 0.6) would stand in the one at (-0.95, 0.3) by kick_off.theirs[0]"),
        (&[(theirs, "theirs: [(-0.95, 0.3), (-1.4, 2.45)")], "a robot at (-1.4, 2.45) would stand in a wall"),
        (
            &[(theirs, "theirs: [(-0.95, 0.3), (-0.05, 1.2)")],
            "a robot at (-0.05, 1.2) would reach into the wrong half",
        ),
        // Stretched to the nearest pitch that there is.
        (
            &[(theirs, "theirs: [(-0.95, 0.3), (-1.4, 2.75)"), ("pitch: (9.0, 5.0)", "pitch: (9.0, 5.5)")],
            "a robot at (-1.4, 2.5) would stand in a wall",
        ),
        (
            &[
                (theirs, "theirs: [(-0.95, 0.3), (-1.4, 2.1)"),
                ("pitch: (9.0, 5.0)", "pitch: (5.4, 4.0)"),
                ("\"cye\", ", ""),
            ],
            "a robot at (-1.4, 2.1) would not stand on the pitch",
        ),
    ];
    for (changes, message) in faults {
        let (told, code) = check(changes);
        let fault = told.lines().next().unwrap_or_default();
        assert!(
            fault.starts_with(&format!("fault mine.ron:{line}:")) && fault.contains("kick_off.theirs[1]: "),
            "{fault}"
        );
        assert!(fault.ends_with(message) && code == Some(2), "{message}: {fault}");
    }
    // Robots without trailers have room there.
    let (told, code) = check(&[close, ("\"cye\", ", "")]);
    assert_eq!(code, Some(0), "{told}");
}

#[test]
fn two_scenarios_of_one_name_are_told_apart_before_their_results_are_mixed_up() {
    let own = Own::new();
    let text = shipped(AssetKind::Scenario, "booking_one_goes").replace("seconds:", "seeds: 1, seconds:");
    own.write("one.ron", &text);
    own.write("other.ron", text);
    let (told, code) = own.check(&["one.ron", "one.ron", "other.ron"]);
    assert_eq!(code, Some(2), "{told}");
    let fault = told.lines().find(|line| line.starts_with("fault")).unwrap_or_default();
    assert!(
        fault.contains("other.ron:") && fault.contains(" name: ") && fault.ends_with("one.ron"),
        "{told}"
    );
    assert_eq!(told.matches("fault").count(), 2, "{told}");
}

#[test]
fn check_reads_every_file_as_what_it_is_and_counts_the_kinds() {
    let own = Own::new();
    let copies = [
        (AssetKind::Strategy, "ball_chasers"),
        (AssetKind::Match, "friendly"),
        (AssetKind::Pitch, "four_legged_2005"),
        (AssetKind::Robot, "cye"),
        (AssetKind::Sensing, "perfect"),
        (AssetKind::Radio, "good"),
        (AssetKind::Radio, "awful"),
    ];
    let mut files: Vec<String> =
        copies.map(|(kind, name)| assets().file(kind, name).to_string_lossy().into_owned()).into();
    own.write("who.ron", "{\"home 0\": \"127.0.0.1:7400\"}");
    files.push("who.ron".into());
    let (told, code) = own.check(&files.iter().map(String::as_str).collect::<Vec<_>>());
    let last =
        "1 strategy, 1 match, 1 pitch, 1 robot, 1 sensing preset, 2 radios, 1 table of addresses: all sound";
    assert_eq!((told.lines().last(), code), (Some(last), Some(0)), "{told}");
}

#[test]
fn files_after_a_faulty_one_are_checked_too() {
    let own = Own::new();
    let pitch = shipped(AssetKind::Pitch, "four_legged_2005");
    own.write("sound.ron", &pitch);
    own.write("faulty.ron", pitch.replacen("name:", "nam:", 1));
    let (told, code) = own.check(&["faulty.ron", "sound.ron"]);
    assert!(told.contains("faulty.ron:") && told.contains("\nok    sound.ron\n"), "{told}");
    assert_eq!(code, Some(2));
}

#[test]
fn what_a_comment_or_a_string_says_does_not_make_a_file_a_scenario() {
    let own = Own::new();
    let strategy = shipped(AssetKind::Strategy, "ball_chasers");
    own.write(
        "strategy.ron",
        format!("// expect: [\n{}", strategy.replacen("name: \"", "name: \"expect: ", 1)),
    );
    let (told, code) = own.check(&["strategy.ron"]);
    assert_eq!((told.as_str(), code), ("ok    strategy.ron\n1 strategy: all sound\n", Some(0)));
    let scenario = shipped(AssetKind::Scenario, "booking_one_goes").replace("expect:", "expect :");
    own.write("scenario.ron", scenario.replace("seconds:", "seeds: 1, seconds:"));
    let (told, code) = own.check(&["scenario.ron"]);
    assert!(told.ends_with("\n1 scenario: all sound\n"), "{told}");
    assert_eq!(code, Some(0));
}

#[test]
fn a_file_of_no_kind_is_told_which_kinds_there_are() {
    let own = Own::new();
    own.write("what.ron", "(name: \"What\", colour: \"red\")");
    let (told, code) = own.check(&["what.ron"]);
    let fault = told.lines().next().unwrap_or_default();
    assert_eq!(code, Some(2));
    for kind in AssetKind::ALL {
        assert!(fault.starts_with("fault what.ron: ") && fault.contains(&kind.to_string()), "{fault}");
    }
}

#[test]
fn a_folder_without_assets_is_not_all_sound() {
    let own = Own::new();
    let output = own.touchline(&["--assets", ".", "check"]);
    assert_eq!(output.status.code(), Some(2));
    let told = [output.stdout, output.stderr].concat();
    assert_eq!(String::from_utf8_lossy(&told), ".: there are no assets to check\n");
}

#[test]
fn a_file_that_is_no_text_for_a_person_is_told_in_one_line() {
    let own = Own::new();
    fs::create_dir(own.path("folder.ron")).expect("the folder is made");
    own.write("empty.ron", "");
    own.write("latin.ron", b"(name: \"gr\xfc\xdfe\")");
    own.write("huge.ron", vec![b' '; 5 << 20]);
    for (file, words) in [
        ("folder.ron", "folder.ron: is a folder"),
        ("empty.ron", "empty.ron: the file is empty"),
        ("latin.ron", "latin.ron:1:11: not UTF-8"),
        ("huge.ron", "huge.ron: is longer than 4 MB"),
        ("absent.ron", "absent.ron: no such file"),
    ] {
        for option in [&["--home"][..], &["--match"], &["--radio"], &["--radio", "udp", "--addresses"]] {
            let output = own.touchline(&[&["run"], option, &[file]].concat());
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!((output.status.code(), told.lines().count()), (Some(2), 1), "{option:?}: {told}");
            assert!(told.starts_with(words), "{option:?}: {told}");
        }
        let (told, code) = own.check(&[file]);
        assert!(told.starts_with(&format!("fault {words}")) && code == Some(2), "{told}");
    }
}

#[test]
fn a_file_is_opened_whatever_the_size_of_the_letters_of_its_ending() {
    let own = Own::new();
    own.write("UPPER.RON", shipped(AssetKind::Strategy, "ball_chasers").replace("Ball chasers", "Upper"));
    own.write("bare", shipped(AssetKind::Radio, "good").replace("latency: (", "latency: (oops: 1, "));
    let output = own.touchline(&["run", "--home", "UPPER.RON", "--minutes", "0.02"]);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(told.starts_with("Upper "), "{told}{}", String::from_utf8_lossy(&output.stderr));
    let output = own.touchline(&["run", "--radio", "bare"]);
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("bare:"));
    own.write("SCENE.Ron", "(name: \"Scene\", oops: 1)");
    let output = own.touchline(&["play", "SCENE.Ron"]);
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("SCENE.Ron:1:17: oops:"));
}

#[test]
fn a_file_that_a_match_names_and_that_is_not_there_is_told_in_the_match() {
    let own = Own::new();
    for (kind, field, from, word) in [
        (AssetKind::Match, "pitch", "\"middle_size_2001\"", "pitch"),
        (AssetKind::Match, "away.strategy", "\"ball_chasers\"", "strategy"),
        (AssetKind::Scenario, "home.strategy", "\"chaos_b3p\"", "strategy"),
    ] {
        let name = if kind == AssetKind::Match { "friendly" } else { "booking_one_goes" };
        let text = shipped(kind, name);
        assert!(text.contains(from), "`{from}` is not in {name}");
        own.write("mine.ron", text.replacen(from, "\"nobody\"", 1));
        let (told, _) = own.check(&["mine.ron"]);
        let fault = told.lines().next().unwrap_or_default();
        assert!(fault.contains(&format!(": {field}: there is no {word} `nobody`; known: ")), "{fault}");
        assert!(fault.starts_with("fault mine.ron:"), "{fault}");
    }
}
