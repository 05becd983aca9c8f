use std::path::Path;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use bevy::prelude::*;

use super::*;
use crate::comms::radio::Loss;
use crate::comms::tcm::DataType;
use crate::data::AssetFolder;
use crate::game::Match;
use crate::game::requests::{Request, Requests, RobotChange};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::lab::export::{ExportWishes, PageForks, PageWish, export};
use crate::lab::replay::{Recorded, Recorder, Replay, ReplayHeader};
use crate::lab::scenario::ScenarioRef;
use crate::robot::RobotFailure;
use crate::world::ball::Ball;

const HOME_1: RobotId = RobotId::new(Team::Home, 1);
const HOME_3: RobotId = RobotId::new(Team::Home, 3);

/// Records a scenario for so many ticks; `meddle` may ask for something before each.
fn recorded(name: &str, path: &Path, ticks: u64, meddle: impl Fn(&mut Match)) -> Replay {
    let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
    let scenario = ScenarioRef::named(&assets, name);
    let place = Vec2::new(-4.2, -2.2);
    let scenario = Recorded::Scenario { scenario, place, seed: 1, without: None };
    let (header, (plan, _)) = ReplayHeader::of(scenario, &assets).unwrap();
    let mut recorder = Recorder::create(path, header).unwrap();
    let mut game = Match::new(&plan);
    while game.clock().tick < ticks {
        meddle(&mut game);
        game.tick();
        recorder.note(game.world_mut()).unwrap();
    }
    recorder.finish().unwrap();
    Replay::read(path).unwrap()
}

fn ask(replay: &Replay, at: u64) -> (WhyPlan, WhyReport) {
    let choice = WhyChoice { at: Some(at), horizon: 4.0, seeds: 3, most: 1000 };
    let plan = WhyPlan::read(replay, choice).unwrap();
    let report = plan.run(|_| {}, |_| true);
    (plan, report)
}

const DOUBLED: &str = "counterexample_02_two_generals_unlocked_at_once:paper";

#[test]
fn the_lost_acknowledgement_that_doubled_a_role_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let replay = recorded(DOUBLED, &folder.path().join("a.replay"), 240, |_| {});
    let (plan, report) = ask(&replay, 200);
    assert_eq!(report.outcome.doubled, [(Team::Home, "halfback".to_owned())]);
    assert!(!report.interrupted && report.left_out == 0 && report.tried > 10);
    let arrives = |finding: &&WhyFinding| match &finding.candidate.meddling {
        Meddling::Deliver { packet, reason } => {
            *reason == Loss::Fault
                && (packet.kind, packet.from, packet.to) == (DataType::ACK_SWAP, HOME_3, HOME_1)
        }
        _ => false,
    };
    let found = report.findings.iter().find(arrives).expect("it makes a difference");
    let once = StandingDifference::DoubledRoles { now: Vec::new(), before: vec!["home halfback".into()] };
    assert_eq!((&found.difference, found.agree), (&once, 3));
    let told = report.to_string();
    let line = "the ACKSWAP from home 3 to home 1 arrives, which was lost (fault rule): no role is given twice; \
                it was home halfback (3 of 3 other dice agree)";
    assert!(told.contains(line), "{told}");
    // What is more likely to be the reason comes before what is less.
    let ranks = report.findings.iter().map(|finding| (finding.difference.weight(), finding.agree));
    assert!(ranks.is_sorted_by(|one, other| one >= other));
    let fork = folder.path().join("fork.replay");
    plan.record(found, &fork).unwrap();
    let fork = Replay::read(&fork).unwrap();
    assert_eq!(fork.header.branched, Some(found.candidate.tick));
    let mut game = Match::new(&fork.plans().unwrap().0);
    while game.clock().tick <= 200 {
        game.tick();
    }
    assert_eq!(MatchStanding::of(game.world_mut()).doubled, []);
}

/// What the script of a page reads.
fn page_data(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("type=\"application/octet-stream\">").unwrap();
    let packed = BASE64_STANDARD.decode(rest.split_once("</script>").unwrap().0).unwrap();
    serde_json::from_reader(flate2::read::GzDecoder::new(&packed[..])).unwrap()
}

#[test]
fn a_page_plays_the_findings_as_other_futures_beside_the_match_in_their_order() {
    let folder = tempfile::tempdir().unwrap();
    let replay = recorded(DOUBLED, &folder.path().join("a.replay"), 240, |_| {});
    let plan =
        WhyPlan::read(&replay, WhyChoice { at: Some(200), horizon: 4.0, seeds: 1, most: 1000 }).unwrap();
    let report = plan.run(|_| {}, |_| true);
    let findings = &report.findings[..2];
    let forks = PageForks::Given(findings.iter().map(|finding| plan.fork(finding)).collect());
    let wishes = ExportWishes { page: Some(PageWish { forks }), ..ExportWishes::default() };
    let (match_plan, _) = replay.plans().unwrap();
    let exported = export(&match_plan, Some(240), wishes, &mut |_| true).unwrap();
    let page = page_data(&exported.page.unwrap());
    let forks = page["forks"].as_array().unwrap();
    assert_eq!((forks.len(), exported.counts.page.unwrap().forks), (2, 2));
    for (fork, finding) in forks.iter().zip(findings) {
        let told = |name: &str| fork[name].as_str().unwrap().to_owned();
        assert_eq!(told("title"), format!("If {}", finding.candidate.meddling));
        let found = format!("{} ({} of 1 other dice agree); ", finding.difference, finding.agree);
        assert!(told("detail").starts_with(&found), "{}", told("detail"));
        assert_eq!(
            (fork["from"].as_u64(), fork["until"].as_u64()),
            (Some(finding.candidate.tick), Some(240))
        );
        // It goes the way of the match that is recorded of the finding.
        let path = folder.path().join("fork.replay");
        plan.record(finding, &path).unwrap();
        let mut game = Match::new(&Replay::read(&path).unwrap().plans().unwrap().0);
        while game.clock().tick < 240 {
            game.tick();
        }
        let ball =
            game.world_mut().query_filtered::<&Pose, With<Ball>>().single(game.world()).unwrap().position;
        let unit = page["exact"]["place"][0].as_f64().unwrap();
        let end = |axis: usize| {
            let steps = fork["ball"]["v"][axis].as_array().unwrap();
            steps.iter().map(|step| step.as_f64().unwrap()).sum::<f64>() * unit
        };
        let off = [end(0) - f64::from(ball.x), end(1) - f64::from(ball.y)];
        assert!(off.iter().all(|off| off.abs() < 0.006), "{off:?}");
    }
}

#[test]
fn a_crash_is_undone_and_a_swap_goes_unheard() {
    let folder = tempfile::tempdir().unwrap();
    let crash = |game: &mut Match| {
        if game.clock().tick == 61 {
            let fail = RobotChange::Fail(RobotFailure::Crashed);
            game.world_mut().resource_mut::<Requests>().ask(Request::Robot(HOME_1, fail));
        }
    };
    let replay = recorded("swap_figure_8", &folder.path().join("a.replay"), 240, crash);
    let plan = WhyPlan::read(&replay, WhyChoice { at: None, horizon: 4.0, seeds: 0, most: 1000 }).unwrap();
    let mut tried = 0;
    let report = plan.run(|count| tried = count, |_| true);
    assert_eq!((report.outcome.tick, report.tried), (240, tried));
    let crash = Candidate { tick: 61, meddling: Meddling::NoCrash(HOME_1) };
    let script = &replay.plans().unwrap().0.script;
    assert_eq!(crash.applied(script, 1.0 / 60.0).len(), script.len() - 1);
    let unheard = Meddling::Unheard { kind: DataType::LOCK, from: HOME_1, until: 62 };
    assert!(unheard.to_string().contains("the swap of home 1"));
}

#[test]
fn a_person_can_stop_it_and_what_the_recording_does_not_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let replay = recorded(DOUBLED, &folder.path().join("a.replay"), 120, |_| {});
    let choice = WhyChoice { at: None, horizon: 2.0, seeds: 0, most: 7 };
    let plan = WhyPlan::read(&replay, choice).unwrap();
    let report = plan.run(|_| {}, |done| done < 2);
    assert!(report.interrupted && report.tried < 7, "{}", report.tried);
    assert!(report.left_out > 0);
    let error = WhyPlan::read(&replay, WhyChoice { at: Some(120), ..choice }).err().unwrap();
    assert_eq!(error.to_string(), "--at: the recording ends with tick 119");
}
