//! `touchline chaos` as a person or a script calls it.

use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

use super::*;
#[cfg(target_os = "linux")]
use {crate::command_line::closed_pipe, std::fs::File};

/// What `touchline chaos` says while a match is played.
fn chaos(game: &mut Match, plan: &MatchPlan, options: &[&str]) -> Output {
    chaos_into(Stdio::piped(), game, plan, options)
}

/// The same, with somewhere that its output goes.
fn chaos_into(out: Stdio, game: &mut Match, plan: &MatchPlan, options: &[&str]) -> Output {
    let at = sockets(plan)[0].to_string();
    let is_over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let program = scope.spawn(|| {
            let program = Command::new(env!("CARGO_BIN_EXE_touchline"))
                .args(["chaos", "--connect", &at])
                .args(options)
                .current_dir(env!("CARGO_MANIFEST_DIR"))
                .stdout(out)
                .output();
            is_over.store(true, Ordering::Relaxed);
            program.expect("the program starts")
        });
        while !is_over.load(Ordering::Relaxed) {
            game.tick();
        }
        program.join().expect("it does not panic")
    })
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_program_prints_what_a_robot_believes_and_sends_a_strategy() {
    let (mut game, plan) = open_to(talkative(45.0), &[]);
    let output = chaos(&mut game, &plan, &["--robot", "home:1", "--data"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let data: serde_json::Value = serde_json::from_slice(&output.stdout).expect("it is JSON");
    assert!(data["pose"]["position"][0].is_number() && data["role"].is_string(), "{data}");

    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("mine.ron");
    let path = file.to_string_lossy().into_owned();
    std::fs::write(&file, long_strategy("Sent")).expect("it is written");
    let output = chaos(&mut game, &plan, &["--robot", "home:1", "--strategy", &path]);
    assert_eq!((text(&output.stdout), text(&output.stderr)), ("accepted by home 1\n".into(), String::new()));
    assert!(game.world().resource::<Strategies>().of(Team::Home).name.starts_with("Sent "));

    std::fs::write(&file, "(name: 7)").expect("it is written");
    let output = chaos(&mut game, &plan, &["--robot", "home:1", "--strategy", &path]);
    let error = text(&output.stderr);
    assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{error}");
    assert!(error.starts_with("home 1 refuses the strategy: mine.ron:1:8: name: "), "{error}");

    let picture = folder.path().join("picture.png").to_string_lossy().into_owned();
    let output = chaos(&mut game, &plan, &["--robot", "home:1", "--image", &picture]);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.starts_with("home 1 refuses the subscription: it does not see by pictures"), "{error}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_output_that_is_closed_or_full_ends_the_program_with_a_code_of_its_own() {
    let (mut game, plan) = open_to(talkative(45.0), &[]);
    let options = ["--robot", "home:1", "--data"];
    let output = chaos_into(closed_pipe().into(), &mut game, &plan, &options);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(141), String::new()));
    let full = File::options().write(true).open("/dev/full").expect("Linux has it");
    let output = chaos_into(full.into(), &mut game, &plan, &options);
    let error = text(&output.stderr);
    assert_eq!((output.status.code(), error.lines().count()), (Some(5), 1), "{error}");
}

#[test]
fn the_program_says_in_a_line_that_nobody_answers() {
    let at = stranger().local_addr().expect("it is bound").to_string();
    let options = ["chaos", "--connect", &at, "--robot", "home:1", "--data", "--timeout", "0.2"];
    let output = Command::new(env!("CARGO_BIN_EXE_touchline")).args(options).output().expect("it starts");
    let line = format!(
        "network: no match answers ChaosManager at {at} within 0.2 s: start it with `--chaos {at}`\n"
    );
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(2), line));
}
