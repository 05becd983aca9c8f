//! Every shipped scenario passes on all its seeds, and fails without what it depends on.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use touchline::data::AssetKind;
use touchline::lab::scenario::{ScenarioPlan, ScenarioRef, ScenarioReport};

use crate::support::assets;

fn plans() -> Vec<ScenarioPlan> {
    let assets = assets();
    let read = |name: &String| {
        ScenarioPlan::read_all(&assets, &ScenarioRef::named(&assets, name))
            .unwrap_or_else(|error| panic!("{error}"))
    };
    assets.names(AssetKind::Scenario).iter().flat_map(read).collect()
}

/// Plays all scenarios on two threads; the reports are in the scenarios' order.
fn play(
    plans: &[ScenarioPlan],
    run: impl Fn(&ScenarioPlan) -> Option<ScenarioReport> + Sync,
) -> Vec<ScenarioReport> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut done = Vec::new();
        while let Some((index, plan)) = {
            let index = next.fetch_add(1, Ordering::Relaxed);
            plans.get(index).map(|plan| (index, plan))
        } {
            done.extend(run(plan).map(|report| (index, report)));
        }
        done
    };
    let mut reports = thread::scope(|scope| {
        let workers = [scope.spawn(worker), scope.spawn(worker)];
        workers.into_iter().flat_map(|worker| worker.join().expect("no scenario panics")).collect::<Vec<_>>()
    });
    reports.sort_by_key(|(index, _)| *index);
    reports.into_iter().map(|(_, report)| report).collect()
}

#[track_caller]
fn assert_all_pass(reports: &[ScenarioReport]) {
    let failed: Vec<String> =
        reports.iter().filter(|report| !report.passed()).map(ScenarioReport::to_string).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn every_shipped_scenario_passes_on_ten_seeds() {
    let plans = plans();
    assert!(plans.len() >= 20, "{} scenarios", plans.len());
    assert!(plans.iter().all(|plan| plan.scenario.seeds.len() * plan.scenario.places.len() >= 10));
    assert_all_pass(&play(&plans, |plan| Some(plan.run(None))));
}

#[test]
fn a_resting_ball_is_fetched_in_a_scenario_of_every_shipped_strategy() {
    let assets = assets();
    let variants = ["fetch_resting_ball", "fetch_resting_ball_four_legged"].iter().flat_map(|name| {
        let plans = ScenarioPlan::read_all(&assets, &ScenarioRef::named(&assets, name)).expect("it is sound");
        assert!(plans.iter().all(|plan| plan.scenario.places.len() >= 16), "{name}");
        plans.into_iter().filter_map(|plan| plan.origin.variant)
    });
    let variants: BTreeSet<String> = variants.collect();
    assert_eq!(variants, assets.names(AssetKind::Strategy).into_iter().collect());
}

#[test]
fn every_scenario_fails_without_what_it_depends_on() {
    let plans = plans();
    let reports = play(&plans, |plan| plan.scenario.depends_on.map(|dependency| plan.run(Some(dependency))));
    assert!(reports.len() >= 15, "{} scenarios depend on something", reports.len());
    assert_all_pass(&reports);
}
