//! `touchline check --coverage`: what strategies were seen to do.

use touchline::lab::coverage::Coverage;

use super::{failing_scenario, text, touchline};

#[test]
fn a_check_tells_what_was_never_reached_and_writes_the_same_counts_each_time() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenario = failing_scenario(folder.path());
    let table = folder.path().join("coverage.ron");
    let (scenario, file) = (scenario.to_string_lossy(), table.to_string_lossy());
    let check = || {
        let output = touchline(&["check", &scenario, "--coverage", &file]);
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        (text(&output.stdout), std::fs::read(&table).expect("the table was written"))
    };
    let (said, written) = check();
    assert!(said.contains("ball_chasers, played 10 times: ") && said.contains("never entered: "), "{said}");
    assert_eq!(said.lines().last(), Some("1 scenario: 1 of 1 scenarios failed"), "{said}");
    assert_eq!(check(), (said, written), "a table may be replaced by another");
    let coverage = Coverage::read(&table).unwrap_or_else(|error| panic!("{error}"));
    let machines = coverage.strategies["ball_chasers"].machines.values();
    let seconds: f64 = machines.flat_map(|machine| machine.states.values()).map(|state| state.seconds).sum();
    // One robot for a tenth of a second or less, ten times.
    assert!(seconds > 0.0 && seconds <= 1.01, "{seconds}");
    let only_printed = touchline(&["check", &scenario, "--coverage"]);
    assert!(text(&only_printed.stdout).contains("transitions taken"), "{}", text(&only_printed.stdout));
}

#[test]
fn a_file_that_is_no_table_of_coverage_is_not_replaced() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenario = failing_scenario(folder.path());
    let before = std::fs::read(&scenario).expect("it was written");
    let output = touchline(&["check", "--coverage", &scenario.to_string_lossy()]);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("failing.ron: is there already") && said.lines().count() == 1, "{said}");
    assert!(output.stdout.is_empty());
    assert_eq!(std::fs::read(&scenario).expect("it is still there"), before);
}

#[test]
fn without_a_scenario_there_is_no_coverage_and_it_is_said() {
    let output = touchline(&["check", "assets/strategies/ball_chasers.ron", "--coverage"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("coverage: no scenario was played"), "{}", text(&output.stdout));
}
