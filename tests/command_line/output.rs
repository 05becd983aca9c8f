//! Where output goes: closed pipes, full disks, files and terminals.

use std::io::{BufRead, BufReader};
use std::net::{Ipv4Addr, UdpSocket};
use std::process::Stdio;
use std::sync::mpsc;
use std::time::Duration;

use super::{closed_pipe, failing_scenario, program, text, touchline};

const STRATEGY: &str = "assets/strategies/ball_chasers.ron";

#[test]
fn who_does_not_listen_to_errors_still_gets_the_exit_code() {
    for call in [&["run", "--home", "nobody"][..], &["run", "--no-such-option"]] {
        let status = program(call).stderr(closed_pipe()).status().expect("the program starts");
        assert_eq!(status.code(), Some(2), "{call:?}");
    }
    let output = program(&["play", "--minutes", "0.02"]).stderr(closed_pipe()).output();
    let output = output.expect("the program starts");
    assert_eq!(output.status.code(), Some(0));
    assert!(text(&output.stdout).contains("digest"), "{}", text(&output.stdout));
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_that_is_full_is_named_after_the_rest_was_said() {
    let output = touchline(&["check", STRATEGY, "--junit", "/dev/full"]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{message}");
    assert!(message.starts_with("/dev/full: ") && message.lines().count() == 1, "{message}");
    assert!(text(&output.stdout).contains(STRATEGY), "{}", text(&output.stdout));
}

#[test]
fn a_report_that_cannot_be_written_is_known_before_anything_is_played() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for path in [folder.path().to_owned(), folder.path().join("missing").join("report.xml")] {
        let output = touchline(&["check", STRATEGY, "--junit", &path.to_string_lossy()]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(5), "{message}");
        assert!(message.starts_with(&*path.to_string_lossy()) && message.lines().count() == 1, "{message}");
        assert!(output.stdout.is_empty(), "{}", text(&output.stdout));
    }
}

#[test]
fn the_report_of_a_scenario_with_a_wild_name_holds_no_character_that_xml_forbids() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = failing_scenario(folder.path());
    let scenario = std::fs::read_to_string(&path).expect("it was written");
    let wild = "The \\u{1}\\u{1b}[31m<ball>\\u{FFFE}\\n & so on";
    std::fs::write(&path, scenario.replace("The ball", wild)).expect("the file is written");
    let report = folder.path().join("report.xml");
    let output = touchline(&["check", &path.to_string_lossy(), "--junit", &report.to_string_lossy()]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    let said = text(&output.stdout);
    assert_eq!(said.lines().count(), 3, "{said}");
    assert!(!said.contains(['\u{1}', '\u{1b}']), "{said:?}");
    let xml = std::fs::read_to_string(&report).expect("the report is there");
    assert!(!xml.contains(['\u{1}', '\u{1b}', '\u{FFFE}']), "{xml:?}");
    assert!(xml.contains("&lt;ball&gt;") && xml.contains("&amp; so on"), "{xml}");
    assert_eq!(
        std::fs::read_dir(folder.path()).expect("it is there").count(),
        2,
        "nothing half-done is left"
    );
}

#[test]
fn log_lines_have_no_colours_where_no_terminal_reads() {
    let talk = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port");
    let at =
        UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).and_then(|free| free.local_addr()).expect("a free port");
    let call = ["run", "--gamecontroller", &at.to_string()];
    let mut process = program(&call).stderr(Stdio::piped()).spawn().expect("the program starts");
    let lines = BufReader::new(process.stderr.take().expect("it is a pipe")).lines();
    let (tell, told) = mpsc::channel();
    let reader = std::thread::spawn(move || {
        for line in lines.map_while(Result::ok) {
            let _ = tell.send(line);
        }
    });
    let line = loop {
        // Until it listens, nobody hears that.
        let _ = talk.send_to(b"no packet of a referee box", at);
        match told.recv_timeout(Duration::from_millis(20)) {
            Ok(line) if line.contains("a packet from") => break line,
            Ok(_) | Err(mpsc::RecvTimeoutError::Timeout) => {}
            Err(mpsc::RecvTimeoutError::Disconnected) => panic!("the program has ended"),
        }
    };
    process.kill().and_then(|()| process.wait()).expect("it is ours");
    reader.join().expect("it reads to the end");
    assert!(line.contains("WARN") && !line.contains('\u{1b}'), "{line:?}");
}

/// What the program says on a terminal, with a variable of its environment; no other asks for colours or for none.
#[cfg(target_os = "linux")]
fn on_a_terminal(arguments: &str, variable: Option<(&str, &str)>) -> String {
    let call = format!("'{}' {arguments}", env!("CARGO_BIN_EXE_touchline"));
    let mut script = std::process::Command::new("script");
    script.args(["--quiet", "--return", "--command", &call, "/dev/null"]);
    script.current_dir(env!("CARGO_MANIFEST_DIR")).stdin(Stdio::null());
    for asking in ["CI", "CLICOLOR", "CLICOLOR_FORCE", "NO_COLOR"] {
        script.env_remove(asking);
    }
    script.env("TERM", "xterm").envs(variable);
    text(&script.output().expect("`script` of util-linux is here").stdout)
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_colours_unless_it_has_none_or_nobody_wants_them() {
    let is_coloured = |line: &str| line.contains("\u{1b}[3");
    for call in ["run --minutes 0.02 --announce 127.0.0.1:0", "run --no-such-option"] {
        let first = |variable| on_a_terminal(call, variable).lines().next().unwrap_or_default().to_owned();
        assert!(is_coloured(&first(None)), "{call}");
        for variable in [("NO_COLOR", "1"), ("TERM", "dumb")] {
            let line = first(Some(variable));
            assert!(!line.is_empty() && !is_coloured(&line), "{call}, {variable:?}: {line:?}");
        }
    }
    let moves = |variable| on_a_terminal("duel --trials 2", variable).contains('\u{1b}');
    assert!(moves(None) && !moves(Some(("TERM", "dumb"))), "a bar is drawn where a line can be drawn again");
}

#[test]
fn that_a_match_cannot_be_announced_is_said_once_and_it_is_played() {
    let output = touchline(&["run", "--minutes", "0.1", "--announce", "127.0.0.1:0"]);
    let (said, told) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{told}");
    assert_eq!(told.lines().count(), 1, "{told}");
    assert!(told.contains("the match cannot be announced: cannot send to 127.0.0.1:0"), "{told}");
    assert!(said.contains("digest"), "{said}");
}
