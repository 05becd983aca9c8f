//! What holds for every command: of closed pipes, full disks and Ctrl-C.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use super::experiment::{DESIGN, Stage};
use super::interrupt::{interrupt, listens_to_ctrl_c, start};
use super::tune::TUNING;
use super::{closed_pipe, failing_scenario, program, text, touchline, where_there_is_no_display};

/// Commands that print something; `@` is a folder of the test's. Those that need a match that is elsewhere have tests of their own.
const PRINTING: [&str; 21] = [
    "--help",
    "run --help",
    "--version",
    "check assets/strategies/ball_chasers.ron",
    "check @/failing.ron --coverage",
    "run --minutes 0.02",
    "run --minutes 0.02 --json",
    "play swap_figure_8",
    "duel --robots 2v1 --trials 4",
    "replay tests/golden/person.replay",
    "why tests/golden/person.replay --seeds 0 --most 1",
    "export tests/golden/person.replay --svg @/picture.svg --at 5",
    "experiment @/loss.ron --out @/played",
    "experiment @/loss.ron --out @/played --row 0",
    "merge @/loss.ron @/played --out @/merged",
    "report @/played",
    "league art rmit --matches 2 --minutes 0.02 --out @/league",
    "tune @/tuning.ron --out @/tuned",
    "soak hammerheads_2001 --hours 0.001 --out @/soak.ron",
    "jam counterexample_02_two_generals_unlocked_at_once:paper --without-faults --budget 0",
    "fit-eyes --camera cye_2001 --views 4",
];

/// Commands that write files or folders, which are called `new`.
const WRITING: [&str; 18] = [
    "run --minutes 0.02 --record @/new.replay",
    "check @/failing.ron --junit @/new.xml",
    "check @/failing.ron --json @/new.json",
    "check @/failing.ron --coverage=@/new.ron",
    "check @/failing.ron --record @/new",
    "experiment @/loss.ron --out @/new",
    "merge @/loss.ron @/played --out @/new",
    "report @/played --html @/new.html",
    "report @/played --markdown @/new.md",
    "league art rmit --matches 2 --minutes 0.02 --out @/new",
    "tune @/tuning.ron --out @/new",
    "soak hammerheads_swap_paper --hours 0.001 --seed 64 --out @/new.ron",
    "jam counterexample_02_two_generals_unlocked_at_once:paper --without-faults --out @/new.ron",
    "why tests/golden/person.replay --seeds 0 --most 1 --page @/new.html",
    "export tests/golden/person.replay --html @/new.html",
    "export tests/golden/person.replay --mcap @/new.mcap",
    "export tests/golden/person.replay --svg @/new.svg --at 5",
    "export tests/golden/person.replay --gif @/new.gif --from 5 --to 8",
];

/// Commands that take long, and a part of what each says when Ctrl-C ends it.
const LASTING: [(&str, &str); 10] = [
    ("experiment @/long.ron --out @/long", " of 400000 matches in "),
    ("league art rmit --matches 1000 --minutes 0.1 --out @/league", " of 1000 matches in "),
    ("tune @/long_tuning.ron --out @/tuned", "the same command goes on from there"),
    ("soak hammerheads_2001 --hours 1000 --jobs 1 --out @/soak.ron", " h of play"),
    (
        "jam counterexample_03_two_generals_two_losses:paper --budget 20 --all-kinds --without-faults",
        " matches played",
    ),
    ("duel --trials 100000", "interrupted after "),
    ("fit-eyes --camera cye_2001 --views 1000000", "interrupted after "),
    ("why tests/golden/person.replay --seeds 1000", "until it was interrupted"),
    ("replay tests/golden/person.replay", "interrupted after "),
    ("export tests/golden/person.replay --html @/page.html", ""),
];

/// A folder with what the commands read, among it the results of an experiment.
fn stage() -> Stage {
    let stage = Stage::new(&DESIGN.replace("(0.1)", "(0.02)").replace("number: 2", "number: 1"));
    failing_scenario(&stage.path(""));
    let write = |name: &str, text: String| fs::write(stage.path(name), text).expect("the file is written");
    write("tuning.ron", TUNING.replace("(0.1)", "(0.02)").replace("candidates: 4", "candidates: 2"));
    write("long.ron", DESIGN.replace("number: 2", "number: 100000"));
    write("long_tuning.ron", TUNING.replace("number: 6", "number: 40"));
    stage.play("played", &[]);
    stage
}

fn words(call: &str, stage: &Stage) -> Vec<String> {
    let folder = stage.path("").display().to_string();
    call.split(' ').map(|word| word.replace("@/", &folder)).collect()
}

/// The program as it is called.
fn called(call: &str, stage: &Stage) -> Command {
    let words = words(call, stage);
    program(&words.iter().map(String::as_str).collect::<Vec<_>>())
}

/// What the program says of itself, without the news that a match is played headless.
fn told(stderr: &[u8]) -> Vec<String> {
    let told = text(stderr);
    told.lines().filter(|line| !line.ends_with("is played headless")).map(str::to_owned).collect()
}

#[test]
fn every_command_is_tried() {
    let help = text(&touchline(&["--help"]).stdout);
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let commands = commands.take_while(|line| !line.is_empty());
    let known: BTreeSet<&str> = commands.filter_map(|line| line.split_whitespace().next()).collect();
    let tried =
        PRINTING.iter().filter_map(|call| call.split(' ').next()).filter(|word| !word.starts_with('-'));
    let tried: BTreeSet<&str> = tried.chain(["robot", "chaos", "help"]).collect();
    assert_eq!(tried, known);
}

#[test]
fn a_closed_pipe_ends_every_command_quietly() {
    let stage = stage();
    for call in PRINTING {
        let output = called(call, &stage).stdout(closed_pipe()).stderr(Stdio::piped()).output();
        let output = output.expect("the program starts");
        let told = told(&output.stderr);
        assert_eq!((output.status.code(), told.len()), (Some(141), 0), "{call}: {told:?}");
    }
}

#[test]
fn a_full_disk_under_the_output_of_a_command_is_one_line_and_an_exit_code_of_its_own() {
    let stage = stage();
    for call in PRINTING {
        let full = File::options().write(true).open("/dev/full").expect("Linux has it");
        let output = called(call, &stage).stdout(full).stderr(Stdio::piped()).output();
        let output = output.expect("the program starts");
        let told = told(&output.stderr);
        assert_eq!((output.status.code(), told.len()), (Some(5), 1), "{call}: {told:?}");
        assert!(told[0].contains("No space left"), "{call}: {told:?}");
    }
}

/// No file can grow, as on a full disk.
#[test]
fn a_full_disk_under_the_files_of_a_command_is_one_line_and_nothing_half_done() {
    let stage = stage();
    let before = files(&stage);
    for call in WRITING {
        let whole = called(call, &stage);
        let mut shell = Command::new("sh");
        shell.args(["-c", "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\""]);
        shell.arg(whole.get_program()).args(whole.get_args()).stdin(Stdio::null());
        let output = where_there_is_no_display(&mut shell).output().expect("there is a shell");
        let told = told(&output.stderr);
        assert_eq!((output.status.code(), told.len()), (Some(5), 1), "{call}: {told:?}");
        let is_named = told[0].starts_with(&*stage.path("new").to_string_lossy());
        assert!(is_named && told[0].ends_with("cannot be written: File too large (os error 27)"), "{told:?}");
        for new in files(&stage).difference(&before) {
            // A folder is gone on with. A recording is written tick by tick, and can be played up to where it ends.
            assert!(new.is_dir() || new.extension().is_some_and(|it| it == "replay"), "{call}: {new:?}");
            let removed = if new.is_dir() { fs::remove_dir_all(new) } else { fs::remove_file(new) };
            removed.expect("it is ours");
        }
    }
}

fn files(stage: &Stage) -> BTreeSet<PathBuf> {
    let files = fs::read_dir(stage.path("")).expect("the folder is there");
    files.map(|file| file.expect("it can be read").path()).collect()
}

#[test]
fn ctrl_c_ends_every_command_that_takes_long_with_what_there_is_so_far() {
    let stage = stage();
    for (call, says) in LASTING {
        let words = words(call, &stage);
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        // A short one may be done before it hears of it.
        let mut outputs = (0..20).map(|_| interrupted(&words));
        let output = outputs.find(|output| output.status.code() != Some(0));
        let output = output.unwrap_or_else(|| panic!("{call} does not hear it"));
        let (said, told) = (text(&output.stdout), text(&output.stderr));
        assert_eq!(output.status.code(), Some(130), "{call}: {said}{told}");
        let is_said = if says.is_empty() { said.is_empty() } else { said.contains(says) };
        assert!(is_said && told.is_empty(), "{call}: {said}{told}");
    }
}

/// What comes of Ctrl-C as soon as the program hears it.
fn interrupted(words: &[&str]) -> Output {
    let mut process = start(words);
    while process.try_wait().expect("it is ours").is_none() {
        if listens_to_ctrl_c(&process) {
            interrupt(&mut process);
            break;
        }
        std::thread::yield_now();
    }
    process.wait_with_output().expect("it is ours")
}
