//! Ctrl-C ends a command with the result so far.

use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use super::where_there_is_no_display;
use crate::support::strategy_text;

/// Starts the program. The tests may run shielded from Ctrl-C, which children inherit.
pub(super) fn start(arguments: &[&str]) -> Child {
    let mut command = if cfg!(target_os = "linux") {
        let mut command = Command::new("env");
        command.args(["--default-signal=INT", env!("CARGO_BIN_EXE_touchline")]);
        command
    } else {
        Command::new(env!("CARGO_BIN_EXE_touchline"))
    };
    let command = where_there_is_no_display(&mut command).args(arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts")
}

/// Ends a program that runs as Ctrl-C does.
pub(super) fn interrupt(process: &mut Child) {
    let status = Command::new("kill").args(["-INT", &process.id().to_string()]).status();
    assert!(status.expect("every Unix can kill").success());
}

/// Whether Ctrl-C does not end a process at once any more, since it has a handler of its own.
#[cfg(target_os = "linux")]
pub(super) fn listens_to_ctrl_c(process: &Child) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{}/status", process.id())).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap_or_default();
    // SIGINT is the second signal.
    u64::from_str_radix(caught.trim(), 16).is_ok_and(|caught| caught & 0b10 != 0)
}

fn rest(mut from: impl Read) -> String {
    let mut text = String::new();
    from.read_to_string(&mut text).expect("it is text");
    text
}

#[test]
fn ctrl_c_ends_a_match_with_the_result_so_far() {
    let mut process = start(&["play", "--minutes", "40"]);
    let mut messages = BufReader::new(process.stderr.take().expect("it is a pipe"));
    let mut line = String::new();
    messages.read_line(&mut line).expect("it is text");
    assert!(line.contains("headless"), "{line}");
    interrupt(&mut process);
    let said = rest(process.stdout.take().expect("it is a pipe"));
    assert_eq!(process.wait().expect("it is ours").code(), Some(130), "{said}");
    assert!(said.starts_with("interrupted after ") && said.contains("seed 1, digest "), "{said}");
    assert_eq!(rest(messages), "");
}

#[test]
fn a_second_ctrl_c_ends_the_program_though_nobody_takes_the_result() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let strategy = folder.path().join("long.ron");
    let (_, sound) = strategy_text("ball_chasers");
    // A result that no pipe holds.
    let long = sound.replace("\"Ball chasers\"", &format!("\"{}\"", "x".repeat(2 << 20)));
    std::fs::write(&strategy, long).expect("the file is written");
    let mut process = start(&["play", "--minutes", "40", "--home", &strategy.to_string_lossy()]);
    let mut messages = BufReader::new(process.stderr.take().expect("it is a pipe"));
    let mut line = String::new();
    messages.read_line(&mut line).expect("it is text");
    assert!(line.contains("headless"), "{line}");
    interrupt(&mut process);
    let mut result = BufReader::new(process.stdout.take().expect("it is a pipe"));
    line.clear();
    result.read_line(&mut line).expect("it is text");
    assert!(line.starts_with("interrupted after "), "{line}");
    interrupt(&mut process);
    assert_eq!(process.wait().expect("it is ours").code(), Some(130));
    assert!(!rest(result).contains("digest"), "it was not written whole");
}

#[test]
fn ctrl_c_ends_a_check_with_what_was_found_so_far() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let report = folder.path().join("report.xml");
    let mut process = start(&["check", "--junit", &report.to_string_lossy()]);
    let mut found = BufReader::new(process.stdout.take().expect("it is a pipe"));
    let mut line = String::new();
    found.read_line(&mut line).expect("it is text");
    assert!(line.starts_with("ok    "), "{line}");
    interrupt(&mut process);
    let said = rest(found);
    assert_eq!(process.wait().expect("it is ours").code(), Some(130), "{said}");
    let last = said.lines().last().unwrap_or_default();
    assert!(last.contains("interrupted: ") && last.ends_with(" so far"), "{said}");
    assert!(
        std::fs::read_to_string(&report)
            .is_ok_and(|xml| xml.ends_with("</testsuites>\n") || xml.ends_with("/>\n"))
    );
}

/// Writes free addresses of this machine for the robots of the default match and the match itself; returns that of home 1.
fn write_addresses(file: &Path) -> SocketAddr {
    let teams = ["home", "away"].into_iter();
    let names: Vec<String> =
        teams.flat_map(|team| (0..4).map(move |number| format!("{team} {number}"))).collect();
    let names = names.into_iter().chain(["computer 255".into()]);
    let open = |name| (name, UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port"));
    let sockets: Vec<(String, UdpSocket)> = names.map(open).collect();
    let at = |socket: &UdpSocket| socket.local_addr().expect("it is bound");
    let lines = sockets.iter().map(|(name, socket)| format!("\"{name}\": \"{}\",\n", at(socket)));
    std::fs::write(file, format!("{{\n{}}}\n", lines.collect::<String>())).expect("the file is written");
    at(&sockets[1].1)
}

#[test]
fn ctrl_c_ends_a_match_that_waits_for_a_robot() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("addresses.ron");
    write_addresses(&file);
    let addresses = file.to_string_lossy();
    let mut process =
        start(&["run", "--json", "--remote", "home:1", "--patience", "3600", "--addresses", &addresses]);
    let mut messages = BufReader::new(process.stderr.take().expect("it is a pipe"));
    let mut line = String::new();
    messages.read_line(&mut line).expect("it is text");
    assert!(line.contains("waiting for home 1"), "{line}");
    interrupt(&mut process);
    let said = rest(process.stdout.take().expect("it is a pipe"));
    assert_eq!(process.wait().expect("it is ours").code(), Some(130), "{said}");
    let report: serde_json::Value = serde_json::from_str(&said).expect("the report is JSON");
    assert_eq!((&report["interrupted"], &report["ticks"]), (&true.into(), &0.into()));
    assert!(report["ticks_per_second"].is_number() && report["crowding"][0].is_number(), "{said}");
}

#[test]
fn ctrl_c_ends_a_robot_with_its_report() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("addresses.ron");
    let at = write_addresses(&file);
    let addresses = file.to_string_lossy();
    let robot = ["robot", "--json", "--team", "home", "--number", "1"];
    let mut process = start(&[&robot[..], &["--patience", "3600", "--addresses", &addresses]].concat());
    let probe = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).and_then(|probe| probe.connect(at).map(|()| probe));
    let probe = probe.expect("a socket of this machine");
    probe.set_read_timeout(Some(Duration::from_millis(20))).expect("sockets can do that");
    // Until somebody listens there, the system says that nobody does.
    while probe.send(b"?").is_err()
        || probe.recv(&mut [0]).is_err_and(|error| error.kind() == ErrorKind::ConnectionRefused)
    {
        assert!(process.try_wait().expect("it is ours").is_none(), "the robot has ended");
    }
    interrupt(&mut process);
    let said = rest(process.stdout.take().expect("it is a pipe"));
    assert_eq!(process.wait().expect("it is ours").code(), Some(130), "{said}");
    let report: serde_json::Value = serde_json::from_str(&said).expect("the report is JSON");
    assert_eq!((&report["ending"], &report["answered"]), (&"stopped".into(), &0.into()));
}
