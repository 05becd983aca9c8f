//! What the program says of a referee box: while it waits, while it follows one, and in its result.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStderr, Command, Stdio};

use touchline::data::AssetKind;
use touchline::game::Choice;

use super::super::{free_addresses, stranger};
use super::*;

/// The program, with its standard error stream.
struct Program {
    child: Child,
    errors: BufReader<ChildStderr>,
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_touchline"));
    command.arg("run").args(arguments).current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

impl Program {
    fn start(arguments: &[&str]) -> Program {
        Program::of(command(arguments))
    }

    fn of(mut command: Command) -> Program {
        let mut child =
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
        let errors = BufReader::new(child.stderr.take().expect("it is piped"));
        Program { child, errors }
    }

    /// Reads lines up to the one with these words, which it gives back.
    fn line_with(&mut self, words: &str) -> String {
        let mut seen = String::new();
        loop {
            let mut line = String::new();
            let read = self.errors.read_line(&mut line).expect("it can be read");
            assert!(read > 0, "the program ended without \"{words}\":\n{seen}");
            if line.contains(words) {
                return line;
            }
            seen.push_str(&line);
        }
    }

    /// The exit code, what is left of its errors, and what it printed.
    fn end(mut self) -> (Option<i32>, String, String) {
        let (mut errors, mut printed) = (String::new(), String::new());
        self.errors.read_to_string(&mut errors).expect("it can be read");
        self.child.stdout.take().expect("it is piped").read_to_string(&mut printed).expect("it can be read");
        (self.child.wait().expect("it ends").code(), errors, printed)
    }
}

#[test]
fn a_match_that_a_box_referees_says_whom_it_waits_for_follows_and_ignores() {
    let address = free_addresses(1)[0];
    let at = address.to_string();
    let mut program =
        Program::start(&["--gamecontroller", &at, "--team-numbers", "34,12", "--minutes", "1", "--json"]);
    let waits = program.line_with("waiting for a referee box");
    assert!(waits.contains(&at) && waits.contains("teams 34 and 12"), "{waits}");
    let referee = stranger();
    let say = |packet: &ControlPacket| {
        referee.send_to(&packet.write(), address).expect("it is sent");
    };
    let mut packet = ControlPacket::read(GOLDEN).expect("it is a packet");
    for length in 100..130 {
        referee.send_to(&GOLDEN[..length], address).expect("it is sent");
    }
    assert!(program.line_with("is ignored").contains("bytes"));
    say(&packet);
    let joined = program.line_with("referees the match");
    assert!(joined.contains("version 20") && joined.contains("home is team 34, away team 12"), "{joined}");
    let penalised = program.line_with("away 1 (team 12, number 2)");
    assert!(penalised.contains("pushing: is carried off"), "{penalised}");
    (packet.state, packet.first_half, packet.packet_number) = (State::Finished, false.into(), 99);
    say(&packet);
    program.line_with("the match is over in 20 s");
    program.line_with("is silent");
    let (code, errors, printed) = program.end();
    assert_eq!(code, Some(0), "{errors}");
    assert!(errors.contains("30 of a wrong length"), "{errors}");
    let report: serde_json::Value = serde_json::from_str(&printed).expect("the report is JSON");
    let said = &report["referee_box"];
    assert_eq!(said["team_numbers"], serde_json::json!([34, 12]));
    assert_eq!((&said["version"], &said["packets"]["heard"]), (&20.into(), &2.into()));
    assert_eq!(said["packets"]["ignored"]["wrong_length"], 30);
    assert_eq!(
        said["penalties"][0],
        serde_json::json!({"robot": "away:1", "penalty": "pushing", "times": 1})
    );
}

const GOLDEN: &[u8] = include_bytes!("../../golden/gamecontroller/v20-stopped-free-kick.bin");

#[test]
fn waiting_for_a_box_can_be_limited() {
    let at = free_addresses(1)[0].to_string();
    let (code, errors, printed) = Program::start(&["--gamecontroller", &at, "--wait-for-box", "0"]).end();
    assert!(code.is_some_and(|code| code != 0) && printed.is_empty(), "{printed}");
    assert_eq!(errors.trim().lines().count(), 1, "{errors}");
    assert!(errors.contains("no referee box") && errors.contains(&at), "{errors}");
}

#[test]
fn a_match_that_is_to_be_played_says_the_same_of_a_box_where_there_is_no_window() {
    let at = free_addresses(1)[0].to_string();
    let mut play = Command::new(env!("CARGO_BIN_EXE_touchline"));
    play.args(["play", "--gamecontroller", &at, "--wait-for-box", "1.5"]);
    play.current_dir(env!("CARGO_MANIFEST_DIR")).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let mut program = Program::of(play);
    assert!(program.line_with("waiting for a referee box").contains("for any teams"));
    let (code, errors, _) = program.end();
    assert!(code.is_some_and(|code| code != 0), "{errors}");
    assert!(errors.contains("no referee box") && errors.contains(&at), "{errors}");
}

#[test]
fn what_makes_no_sense_of_a_box_is_refused_in_one_line() {
    let calls: [(&[&str], &str); 4] = [
        (&["--gamecontroller", "127.0.0.1:3999", "--announce", "127.0.0.1:3999"], "follow itself"),
        (&["--gamecontroller", "0.0.0.0:3999", "--announce", "127.0.0.1:3999"], "follow itself"),
        (&["--team-numbers", "6,6"], "both teams have the number 6"),
        (&["--team-numbers", "255,6"], "255"),
    ];
    for (call, words) in calls {
        let output = command(call).output().expect("the program starts");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{call:?}: {message}");
        assert_eq!(message.trim().lines().count(), 1, "{call:?}: {message}");
        assert!(message.contains(words), "{call:?}: {message}");
    }
}

#[test]
fn team_numbers_come_from_the_match_file_and_an_option_is_stronger() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("league.ron");
    let sound = std::fs::read_to_string(crate::support::assets().file(AssetKind::Match, "friendly"))
        .expect("the shipped file is there");
    let read = |home: &str, away: &str, option: Option<[u8; 2]>| {
        let text =
            sound.replace("home: (", &format!("home: ({home}")).replace("away: (", &format!("away: ({away}"));
        std::fs::write(&file, text).expect("the file is written");
        let choice = Choice {
            file: Some(file.to_string_lossy().into_owned()),
            network: Box::new(NetworkPlan { team_numbers: option, ..NetworkPlan::default() }),
            ..Choice::default()
        };
        MatchPlan::read(&crate::support::assets(), &choice).map(|plan| plan.network.team_numbers)
    };
    assert_eq!(read("", "", None), Ok(None));
    assert_eq!(read("team_number: 6, ", "team_number: 9, ", None), Ok(Some([6, 9])));
    assert_eq!(read("team_number: 6, ", "team_number: 9, ", Some([1, 2])), Ok(Some([1, 2])));
    let half = read("team_number: 6, ", "", None).expect_err("away has none");
    assert_eq!((half.field.to_string().as_str(), half.line.is_some()), ("home.team_number", true));
    assert!(half.message.contains("away"), "{half}");
    let twice = read("team_number: 6, ", "team_number: 6, ", None).expect_err("both have one");
    assert_eq!(twice.field.to_string(), "away.team_number");
}
