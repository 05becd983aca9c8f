//! Robots that are processes of their own.

use std::io::Write;
use std::net::SocketAddr;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use serde_json::Value;
use touchline::comms::tcm::udp::UdpError;
use touchline::comms::tcm::{Directory, HOST, Peer};
use touchline::game::MatchPlan;
use touchline::game::net::{self, Greeting, NetworkError, NetworkPlan};
use touchline::ids::{RobotId, Team};
use touchline::robot::SteeringIntent;
use touchline::world::referee::Phase;

use super::{HOME_0, HOME_1, address_of, by_udp, free_directory, greet, open, stranger, talkative};
#[cfg(target_os = "linux")]
use crate::command_line::closed_pipe;

/// A process that ends with the test, whatever happens.
struct Process(Option<Child>);

impl Process {
    fn start(arguments: &[&str], addresses: &Path) -> Process {
        Process::start_into(Stdio::piped(), arguments, addresses)
    }

    /// The same, with somewhere that its output goes.
    fn start_into(out: Stdio, arguments: &[&str], addresses: &Path) -> Process {
        let child = Command::new(env!("CARGO_BIN_EXE_touchline"))
            .args(arguments)
            .arg("--addresses")
            .arg(addresses)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .stdout(out)
            .stderr(Stdio::piped())
            .spawn();
        Process(Some(child.expect("the program starts")))
    }

    /// A robot of [`talkative`], once it listens at its address; `None` if it could not.
    fn robot(robot: RobotId, at: SocketAddr, addresses: &Path) -> Option<Process> {
        let (team, number) = (robot.team.to_string(), robot.number.to_string());
        let of = ["robot", "--json", "--team", &team, "--number", &number];
        let mut process = Process::start(&[&of[..], &TALKATIVE].concat(), addresses);
        let child = process.0.as_mut().expect("it was not ended yet");
        while !is_somebody_at(at) {
            if child.try_wait().expect("it is ours").is_some() {
                let error = process.end().stderr;
                assert!(String::from_utf8_lossy(&error).contains("cannot listen at"), "{robot}: {error:?}");
                return None;
            }
            std::thread::yield_now();
        }
        Some(process)
    }

    /// Waits for it and returns what it has printed.
    fn end(&mut self) -> Output {
        let child = self.0.take().expect("it was not ended yet");
        child.wait_with_output().expect("it is ours")
    }

    fn kill(&mut self) {
        if let Some(mut child) = self.0.take() {
            child.kill().and_then(|()| child.wait().map(drop)).expect("it is ours");
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.kill();
    }
}

/// The match that [`talkative`] is, as options, but for the length of its halves.
const TALKATIVE: [&str; 6] = ["--home", "hammerheads_swap", "--away", "hammerheads_swap", "--seed", "7"];

/// Whether a socket is bound to an address. Who is there counts a foreign datagram.
fn is_somebody_at(address: SocketAddr) -> bool {
    let probe = stranger();
    probe.connect(address).expect("it is an address of this machine");
    probe.set_read_timeout(Some(Duration::from_millis(5))).expect("sockets can do that");
    // An error tells of the datagram before.
    let refused = |_| probe.send(b"?").is_err() || probe.recv(&mut [0]).is_err_and(is_refusal);
    !(0..3).any(refused)
}

fn is_refusal(error: std::io::Error) -> bool {
    use std::io::ErrorKind::{ConnectionRefused, ConnectionReset};
    matches!(error.kind(), ConnectionRefused | ConnectionReset)
}

/// Writes the addresses of a match to a file.
fn write_addresses(plan: &MatchPlan, folder: &Path) -> std::path::PathBuf {
    let file = folder.join("addresses.ron");
    std::fs::write(&file, ron_of(plan)).expect("the file is written");
    file
}

fn ron_of(plan: &MatchPlan) -> String {
    let directory = plan.directory();
    let lines = directory.entries().map(|(who, at)| format!("\"{who}\": \"{at}\",\n"));
    format!("{{\n{}}}\n", lines.collect::<String>())
}

/// Free addresses for a match, as a file and as a table; the file lasts as long as its handle.
fn addresses_of(plan: &MatchPlan) -> (tempfile::TempPath, Directory) {
    let plan = MatchPlan { addresses: Some(free_directory(plan)), ..plan.clone() };
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    file.write_all(ron_of(&plan).as_bytes()).expect("the file is written");
    (file.into_temp_path(), plan.directory())
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The result of a match and what its robots in other processes say.
struct Played {
    result: Value,
    robots: Vec<(RobotId, Value)>,
    /// The result of the same match from its recording.
    again: Value,
}

fn json(output: Output) -> Value {
    let Output { status, stdout, stderr } = output;
    assert!(status.success(), "{status}: {}", String::from_utf8_lossy(&stderr));
    serde_json::from_slice(&stdout).expect("the report is JSON")
}

/// Plays [`talkative`] with these robots elsewhere; `None` if somebody else took a port.
fn play(remote: &[RobotId], minutes: &str) -> Option<Played> {
    let mut plan = talkative(1.0);
    plan.addresses = Some(free_directory(&plan));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let addresses = write_addresses(&plan, folder.path());
    let path = folder.path().join("a.replay");
    let recording = path.to_str().expect("a plain path");
    let ears = stranger().local_addr().expect("it is bound").to_string();
    // First the robots, so that none of them speaks to one that does not listen yet.
    let start = |robot: &RobotId| Process::robot(*robot, address_of(&plan, *robot), &addresses);
    let mut robots = remote.iter().map(start).collect::<Option<Vec<_>>>()?;
    let names: Vec<String> = remote.iter().map(|robot| robot.to_string().replace(' ', ":")).collect();
    let elsewhere = names.iter().flat_map(|name| ["--remote", name]);
    let options: Vec<&str> =
        ["run", "--json", "--minutes", minutes, "--announce", &ears, "--record", recording]
            .into_iter()
            .chain(TALKATIVE)
            .chain(elsewhere)
            .collect();
    let output = Process::start(&options, &addresses).end();
    if String::from_utf8_lossy(&output.stderr).contains("cannot listen at") {
        return None;
    }
    let result = json(output);
    let robots = remote.iter().zip(&mut robots).map(|(id, robot)| (*id, json(robot.end()))).collect();
    let again = Command::new(env!("CARGO_BIN_EXE_touchline")).args(["replay", "--json", recording]).output();
    let again = json(again.expect("the program starts"));
    Some(Played { result, robots, again })
}

/// The sum of a figure over these reports.
fn sum<'a>(reports: impl Iterator<Item = &'a Value>, figure: &str) -> u64 {
    reports.map(|report| report[figure].as_u64().expect("it is a number")).sum()
}

/// A machine that is busy with other things can make robots answer late, and what they say after the end is lost; then
/// the match is played again.
fn play_in_time(remote: &[RobotId], minutes: &str) -> Played {
    let mut played = (0..10).filter_map(|_| play(remote, minutes));
    let in_time = |played: &Played| {
        let elsewhere = played.result["network"]["elsewhere"].as_array().expect("it is a list");
        sum(elsewhere.iter(), "missed") == 0
    };
    played.find(in_time).expect("in one of ten matches everybody is in time")
}

#[test]
fn a_match_between_processes_is_played_to_its_end_and_no_datagram_is_lost() {
    let home = (0..4).map(|number| RobotId::new(Team::Home, number));
    let remote: Vec<RobotId> = home.chain([RobotId::new(Team::Away, 2)]).collect();
    let Played { result, robots, again } = play_in_time(&remote, "0.05");
    assert_eq!((&again["digest"], &again["score"]), (&result["digest"], &result["score"]));
    let (seconds, ticks) = (result["seconds"].as_f64(), result["ticks"].as_u64());
    assert!(seconds >= Some(6.0), "both halves of three seconds: {seconds:?}");
    let network = &result["network"];
    let elsewhere = network["elsewhere"].as_array().expect("it is a list");
    assert_eq!(elsewhere.len(), robots.len());
    for (told, (id, robot)) in elsewhere.iter().zip(&robots) {
        assert_eq!((&told["robot"], &robot["robot"]), (&Value::from(id.to_string()), &told["robot"]));
        assert_eq!(told["answered"].as_u64(), ticks, "{id}");
        assert_eq!(told["told"].as_u64(), ticks.map(|ticks| ticks + 1), "{id} is told of the end");
        assert_eq!(robot["answered"].as_u64(), ticks, "{id} plays no tick twice");
        assert_eq!((&told["sent"], &robot["refused"]), (&robot["sent"], &Value::from(0)), "{id}");
        assert!(robot["sent"].as_u64() > Some(50), "{id}: {robot}");
    }
    let (at_home, away): (Vec<_>, Vec<_>) = robots.iter().partition(|(id, _)| id.team == Team::Home);
    let at_home = || at_home.iter().map(|(_, robot)| robot);
    let away = || away.iter().map(|(_, robot)| robot).chain([&network["here"]]);
    assert_eq!(sum(at_home(), "sent"), sum(at_home(), "received"), "{robots:?}");
    // Each message that the league counts went to one to three mates.
    let (counted, sent) = (&result["budgets"][0]["counted"], sum(at_home(), "sent"));
    let counted = counted.as_u64().expect("the match is announced");
    assert!((sent / 4..=sent).contains(&counted), "{counted} messages are {sent} datagrams");
    assert_eq!(sum(away(), "sent"), sum(away(), "received"), "{robots:?}, {network}");
}

#[test]
fn a_match_whose_remote_robot_dies_goes_on_to_its_end_and_the_robot_stands() {
    let remote = NetworkPlan { udp: true, remote: vec![HOME_1], ..NetworkPlan::default() };
    let plan = MatchPlan { network: remote, ..talkative(0.02) };
    let (mut game, mut robot) = loop {
        let (game, plan) = open(&plan);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let addresses = write_addresses(&plan, folder.path());
        if let Some(robot) = Process::robot(HOME_1, address_of(&plan, HOME_1), &addresses) {
            break (game, robot);
        }
    };
    greet(&mut game);
    // Long enough for a robot that has fallen silent to stand, and not much longer, as each tick waits for it.
    let last_ticks = 36.0 / 60.0;
    while game.state().half == 1
        || game.state().phase != Phase::Playing
        || game.state().time_left > last_ticks
    {
        game.tick();
    }
    let before = net::remote_figures(game.world())[0];
    assert!(before.answered > 0, "{before:?}");
    robot.kill();
    while !game.is_over() {
        game.tick();
    }
    let after = net::remote_figures(game.world())[0];
    assert_eq!(after.answered, before.answered);
    assert!(after.missed >= before.missed + 30, "{after:?}");
    assert_eq!(after.answered + after.missed, game.clock().tick);
    assert!(after.told < after.answered + 20, "who is gone is told nothing: {after:?}");
    let mut robots = game.world_mut().query::<(&RobotId, &SteeringIntent)>();
    let intent = robots.iter(game.world()).find(|(id, _)| **id == HOME_1).map(|(_, intent)| *intent);
    assert_eq!(intent, Some(SteeringIntent::Stop));
}

#[test]
fn a_remote_robot_that_never_comes_is_named_and_waited_for_as_long_as_was_asked_for() {
    let plan = MatchPlan { addresses: None, ..talkative(0.1) };
    let (file, addresses) = addresses_of(&plan);
    let run = ["run", "--remote", "home:1", "--patience", "0.7"];
    let output = Process::start(&[&run[..], &TALKATIVE].concat(), &file).end();
    let at = addresses.address_of(Peer::from(HOME_1)).expect("it is there");
    let start = "start it with `touchline robot --team home --number 1`";
    let lines = [
        format!("waiting for home 1 at {at}; {start}"),
        format!("network: home 1 has not answered at {at} for 0.7 s: {start}"),
    ];
    assert_eq!(stderr(&output).lines().collect::<Vec<_>>(), lines);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
}

#[test]
fn a_robot_that_no_match_greets_says_so() {
    let (file, addresses) = addresses_of(&talkative(0.1));
    let robot = ["robot", "--team", "home", "--number", "1", "--patience", "0.1"];
    let output = Process::start(&[&robot[..], &TALKATIVE].concat(), &file).end();
    let host = addresses.address_of(HOST).expect("it is there");
    let line = format!(
        "network: no match has greeted home 1 at {host} for 0.1 s: start it with `touchline run --remote home:1`\n"
    );
    assert_eq!((stderr(&output), output.status.code()), (line, Some(2)));
}

#[test]
fn a_robot_of_another_strategy_is_refused_with_one_line_on_either_side() {
    let remote = NetworkPlan { udp: true, remote: vec![HOME_1], ..NetworkPlan::default() };
    let (mut game, plan) = open(&MatchPlan { network: remote, ..talkative(0.1) });
    let folder = tempfile::tempdir().expect("a temporary folder");
    let addresses = write_addresses(&plan, folder.path());
    let other = ["robot", "--team", "home", "--number", "1", "--home", "ball_chasers", "--seed", "7"];
    let mut robot = Process::start(&other, &addresses);
    let mut refusal = None;
    while refusal.is_none() {
        let Greeting::Awaiting(awaited) = net::poll_greeting(game.world_mut()) else {
            panic!("it is another")
        };
        refusal = awaited[0].refusal.clone();
        std::thread::yield_now();
    }
    let output = robot.end();
    let (line, at) = (refusal.expect("it is there"), address_of(&plan, HOME_1));
    let host = plan.directory().address_of(HOST).expect("it is there");
    let begin =
        format!("home 1 at {at} is refused: it plays another match: the strategy of home differs: here ");
    assert!(line.starts_with(&begin) && line.contains(", there ") && line.lines().count() == 1, "{line}");
    let error = stderr(&output);
    let begin = format!(
        "network: home 1 does not belong to the match at {host}: the strategy of home differs: here "
    );
    assert!(error.starts_with(&begin) && error.lines().count() == 1, "{error}");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
}

#[test]
fn a_robot_whose_match_is_gone_ends_with_its_report_and_one_line() {
    let remote = NetworkPlan { udp: true, remote: vec![HOME_1], ..NetworkPlan::default() };
    let (mut game, plan) = open(&MatchPlan { network: remote, ..talkative(0.1) });
    let folder = tempfile::tempdir().expect("a temporary folder");
    let addresses = write_addresses(&plan, folder.path());
    let robot = ["robot", "--json", "--team", "home", "--number", "1", "--patience", "3"];
    let mut robot = Process::start(&[&robot[..], &TALKATIVE].concat(), &addresses);
    greet(&mut game);
    (0..5).for_each(|_| game.tick());
    net::close(game.world_mut());
    let output = robot.end();
    let report: Value = serde_json::from_slice(&output.stdout).expect("the report is JSON");
    assert_eq!(report["ending"], "match_gone");
    assert!(report["answered"].as_u64() > Some(0), "{report}");
    let line = "home 1 has heard nothing of its match for 3 s\n";
    assert_eq!((stderr(&output).as_str(), output.status.code()), (line, Some(1)));
}

#[cfg(target_os = "linux")]
#[test]
fn a_robot_whose_report_cannot_be_written_ends_with_a_code_of_its_own() {
    let full = std::fs::File::options().write(true).open("/dev/full").expect("Linux has it");
    for (out, code, lines) in [(Stdio::from(closed_pipe()), 141, 0), (Stdio::from(full), 5, 1)] {
        let remote = NetworkPlan { udp: true, remote: vec![HOME_1], ..NetworkPlan::default() };
        let (mut game, plan) = open(&MatchPlan { network: remote, ..talkative(0.02) });
        let folder = tempfile::tempdir().expect("a temporary folder");
        let addresses = write_addresses(&plan, folder.path());
        let robot = ["robot", "--team", "home", "--number", "1"];
        let mut robot = Process::start_into(out, &[&robot[..], &TALKATIVE].concat(), &addresses);
        greet(&mut game);
        while !game.is_over() {
            game.tick();
        }
        net::finish(game.world_mut());
        let output = robot.end();
        let error = stderr(&output);
        assert_eq!((output.status.code(), error.lines().count()), (Some(code), lines), "{error}");
    }
}

#[test]
fn a_second_match_on_the_same_ports_says_which_port_is_taken() {
    let (_game, plan) = open(&by_udp(talkative(0.1)));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let addresses = write_addresses(&plan, folder.path());
    let output = Process::start(&[&["run", "--radio", "udp"][..], &TALKATIVE].concat(), &addresses).end();
    let line = format!(
        "network: cannot listen at {}: the port is taken, perhaps by another match or one of its robots\n",
        address_of(&plan, HOME_0)
    );
    assert_eq!((stderr(&output), output.status.code()), (line, Some(2)));
}

#[test]
fn a_match_needs_an_address_of_its_own_for_robots_elsewhere() {
    let remote = NetworkPlan { udp: true, remote: vec![HOME_1], ..NetworkPlan::default() };
    let plan = MatchPlan { network: remote, ..talkative(0.1) };
    let (mut game, plan) = open(&plan);
    let without = plan.directory().entries().filter(|(who, _)| *who != HOST).collect();
    let plan = MatchPlan { addresses: Some(without), ..plan };
    let error = net::open(game.world_mut(), &plan).expect_err("it has none");
    assert!(!matches!(error, NetworkError::Udp(UdpError::Bind { .. })), "{error}");
    assert!(error.to_string().contains("computer 255 has no address"), "{error}");
}
