//! Matches that go back, with noise, a bad radio, a script and a person in them.

use std::sync::Arc;

use bevy::prelude::*;

use super::*;
use crate::clock::Clock;
use crate::comms::radio::{Loss, RadioRecord, TransmissionState};
use crate::data::AssetFolder;
use crate::game::record::Record;
use crate::game::requests::{BodyChange, RadioChange, Request, RequestLog, Requests, RobotChange};
use crate::game::{Choice, Match, MatchPlan, net};
use crate::ids::{RobotId, Team};
use crate::lab::scenario::{ScenarioPlan, ScenarioRef};
use crate::robot::pilot::Pilot;
use crate::robot::{Restart, RobotFailure};

const MINE: RobotId = RobotId::new(Team::Home, 1);
/// Ticks of each match.
const TICKS: u64 = 480;

fn assets() -> AssetFolder {
    AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))
}

fn plan(choice: Choice) -> MatchPlan {
    let name = |name: &str| Some(name.to_owned());
    let choice = Choice { home: name("hammerheads_swap"), radio: name("awful"), seed: 5, ..choice };
    MatchPlan::read(&assets(), &choice).expect("the shipped files are sound")
}

fn friendly() -> MatchPlan {
    plan(Choice::default())
}

fn scenario(name: &str) -> MatchPlan {
    let assets = assets();
    ScenarioPlan::read(&assets, &ScenarioRef::named(&assets, name)).expect("a shipped scenario").with_seed(1)
}

/// A match and its past.
struct Played {
    game: Match,
    rewind: Rewind,
}

impl Played {
    fn new(plan: &MatchPlan) -> Played {
        let mut game = Match::new(plan);
        let rewind = Rewind::begin(game.world_mut());
        Played { game, rewind }
    }

    fn ask(&mut self, request: Request) {
        self.game.world_mut().resource_mut::<Requests>().ask(request);
    }

    /// Plays up to a tick, and returns the digest after each tick on the way.
    fn play_to(&mut self, tick: u64, mut person: impl FnMut(u64) -> Vec<Request>) -> Vec<u64> {
        let mut digests = Vec::new();
        while self.game.clock().tick < tick {
            person(self.game.clock().tick).into_iter().for_each(|request| self.ask(request));
            self.rewind.play(self.game.world_mut(), |world| digests.push(digest(world)));
        }
        digests
    }

    fn watch_to(&mut self, tick: u64) -> Vec<u64> {
        self.play_to(tick, |_| Vec::new())
    }

    fn seek(&mut self, tick: u64) {
        self.rewind.seek(self.game.world_mut(), tick, &mut |_| ()).expect("it can go back");
    }

    fn switch(&mut self, branch: usize, tick: u64) {
        let world = self.game.world_mut();
        self.rewind.switch(world, BranchId(branch), tick, &mut |_| ()).expect("it can go back");
    }
}

fn digest(world: &mut World) -> u64 {
    world.resource::<Record>().digest
}

fn steer(throttle: f32, turn: f32) -> Request {
    Request::Steer { robot: MINE, pilot: Pilot { throttle, turn, ..Pilot::default() } }
}

/// A person who drives, meddles with everything, and saves a changed strategy meanwhile.
fn busy_person(plan: &MatchPlan) -> impl FnMut(u64) -> Vec<Request> {
    let mut strategy = plan.team(Team::Home).strategy.as_ref().clone();
    strategy.assemblages[0].terms[0].weight *= 2.0;
    let strategy = Arc::new(strategy);
    move |tick| match tick {
        60 => vec![Request::TakeOver(MINE), steer(1.0, 0.0)],
        61..200 if tick.is_multiple_of(7) => vec![steer(1.0, (tick % 5) as f32 / 2.0 - 1.0)],
        200 => vec![Request::HandBack(MINE)],
        220 => vec![Request::SetWeight { team: Team::Home, assemblage: 0, term: 0, weight: 3.0 }],
        240 => {
            let (strategy, texts) = (strategy.clone(), Arc::default());
            vec![Request::ChangeStrategy { team: Team::Home, strategy, texts }]
        }
        260 => vec![Request::Radio(RadioChange::ExtraLoss(0.3))],
        280 => vec![Request::Body(BodyChange::Ball { at: Vec2::new(1.0, 1.0), velocity: Vec2::X })],
        300 => vec![Request::Robot(MINE, RobotChange::Fail(RobotFailure::Crashed))],
        350 => vec![Request::Robot(MINE, RobotChange::Revive(Restart::Lost))],
        _ => Vec::new(),
    }
}

#[test]
fn a_match_with_noise_and_a_person_goes_the_same_way_again_from_any_tick() {
    let plan = friendly();
    let mut played = Played::new(&plan);
    let digests = played.play_to(TICKS, busy_person(&plan));
    let mut unwatched = Match::new(&plan);
    let mut person = busy_person(&plan);
    while unwatched.clock().tick < TICKS {
        let tick = unwatched.clock().tick;
        let mut requests = unwatched.world_mut().resource_mut::<Requests>();
        person(tick).into_iter().for_each(|request| requests.ask(request));
        unwatched.tick();
    }
    assert_eq!(unwatched.record().digest, digests[digests.len() - 1], "to be kept changes nothing");
    for tick in [130, 0, 239, 240, 241, 305, 121, 479] {
        played.seek(tick);
        assert_eq!(played.game.clock().tick, tick);
        assert_eq!(played.watch_to(TICKS), digests[tick as usize..], "from tick {tick}");
    }
    assert_eq!(played.rewind.branches().len(), 1);
    played.seek(TICKS + 1000);
    assert_eq!(played.game.clock().tick, TICKS, "there is nothing beyond");
}

#[test]
fn a_script_is_carried_out_once_and_goes_on_after_the_last_tick_that_was_played() {
    let plan = scenario("swap_locks_time_out");
    assert!(!plan.script.is_empty());
    let last = plan.script.iter().map(|(tick, _)| *tick).max().unwrap_or_default() + 60;
    let logged = || {
        let mut game = Match::new(&plan);
        game.world_mut().insert_resource(RequestLog::default());
        let rewind = Rewind::begin(game.world_mut());
        Played { game, rewind }
    };
    let [mut plain, mut played] = [logged(), logged()];
    let mut unkept = Match::new(&plan);
    while unkept.clock().tick < last {
        unkept.tick();
    }
    plain.watch_to(last);
    played.watch_to(30);
    for tick in [last / 2, last / 3] {
        played.watch_to(tick);
        played.seek(10);
    }
    played.watch_to(last);
    let log = |played: &Played| played.game.world().resource::<RequestLog>().clone();
    // What is kept from the keyframe before is that of the plain match.
    assert_eq!(log(&plain), log(&played));
    assert_eq!(played.game.record().digest, unkept.record().digest);
    assert_eq!(plain.game.record().digest, unkept.record().digest);
    assert!(played.rewind.branch(BranchId(0)).requests().iter().all(|made| made.scripted));
}

#[test]
fn something_new_begins_another_branch_and_the_old_one_can_be_gone_back_to() {
    let plan = friendly();
    let mut played = Played::new(&plan);
    let old = played.play_to(TICKS, busy_person(&plan));
    played.seek(150);
    played.ask(Request::Radio(RadioChange::Jam(true)));
    let new = played.watch_to(TICKS);
    assert_ne!(old[TICKS as usize - 1], new[new.len() - 1]);
    let branch = played.rewind.branch(BranchId(1));
    assert_eq!((branch.parent, branch.from, branch.end), (Some(BranchId(0)), 150, TICKS));
    assert_eq!(branch.name, "the radio jammed");
    played.switch(0, 170);
    assert_eq!(played.watch_to(TICKS), old[170..]);
    played.switch(1, 0);
    assert_eq!(played.watch_to(150), old[..150]);
    assert_eq!(played.watch_to(TICKS), new);
    // And a branch of the branch, in what it shares with the first.
    played.seek(20);
    played.ask(Request::Robot(MINE, RobotChange::Fail(RobotFailure::Mute)));
    played.watch_to(40);
    let branch = played.rewind.branch(played.rewind.present());
    assert_eq!((branch.parent, branch.from), (Some(BranchId(0)), 20));
}

#[test]
fn in_a_new_branch_all_else_is_asked_for_again_but_not_the_driving_if_a_person_drives() {
    let plan = friendly();
    let later = |played: &Played| -> Vec<(u64, String)> {
        let branch = played.rewind.branch(played.rewind.present());
        let words = branch.requests().iter().filter_map(|made| Some((made.tick, meddling(&made.request)?)));
        words.filter(|(_, words)| words.contains("driven") || words.contains("weight")).collect()
    };
    let mut played = Played::new(&plan);
    played.play_to(TICKS, busy_person(&plan));
    played.seek(190);
    played.ask(Request::Radio(RadioChange::ExtraDelay(0.1)));
    played.watch_to(230);
    let drive = |tick| (tick, "home 1 driven".to_owned());
    let weight = (220, "a weight of home".to_owned());
    assert_eq!(later(&played), [drive(196), drive(200), weight.clone()]);
    played.switch(0, 190);
    played.ask(Request::TakeOver(RobotId::new(Team::Home, 2)));
    played.watch_to(230);
    let taken = (190, "home 2 driven".to_owned());
    assert_eq!(later(&played), [taken, drive(190), weight], "the other robot is handed back");
    let mut seats = played.game.world_mut().query::<(&RobotId, &Pilot)>();
    let seats: Vec<RobotId> = seats.iter(played.game.world()).map(|(robot, _)| *robot).collect();
    assert_eq!(seats, [RobotId::new(Team::Home, 2)]);
}

#[test]
fn a_branch_plays_on_beside_another_as_it_would_have_gone() {
    let plan = friendly();
    let mut alone = Played::new(&plan);
    let digests = alone.watch_to(TICKS);
    let mut played = Played::new(&plan);
    played.watch_to(250);
    played.seek(200);
    played.ask(Request::Body(BodyChange::Ball { at: Vec2::ONE, velocity: Vec2::ZERO }));
    let new = played.watch_to(300);
    assert!(played.rewind.ghost(BranchId(0), 300).is_none());
    let Played { game, rewind } = &mut played;
    let mut ghost = GhostMatch::new(rewind, &plan, BranchId(0)).expect("it is the same match");
    ghost.play_to(rewind, TICKS);
    assert_eq!(digest(game.world_mut()), new[new.len() - 1], "the match in the window is left alone");
    for tick in [0, 100, 200, 201, 250, 300, TICKS] {
        let (here, there) = (rewind.ghost(BranchId(0), tick), alone.rewind.ghost(BranchId(0), tick));
        assert!(here.is_some() && here == there, "at {tick}");
    }
    assert_ne!(rewind.ghost(BranchId(1), 260), rewind.ghost(BranchId(0), 260));
    assert_eq!(rewind.ghost(BranchId(1), 150), rewind.ghost(BranchId(0), 150));
    assert!(rewind.ghost(BranchId(1), 301).is_none());
    played.switch(0, 240);
    assert_eq!(played.watch_to(TICKS), digests[240..]);
}

#[test]
fn the_last_meddling_is_undone_as_a_whole_and_the_one_before_it_after_that() {
    let plan = friendly();
    let jam = |jammed| Request::Radio(RadioChange::Jam(jammed));
    let loss = |share| Request::Radio(RadioChange::ExtraLoss(share));
    let person = |tick| match tick {
        20 => vec![Request::TakeOver(MINE)],
        21..40 => vec![steer(1.0, 0.0)],
        60 => vec![jam(true)],
        100..110 => vec![loss(tick as f32 / 200.0)],
        _ => Vec::new(),
    };
    let mut played = Played::new(&plan);
    played.play_to(150, person);
    let undo = |played: &mut Played| {
        let undone = played.rewind.undo(played.game.world_mut(), &mut |_| ()).expect("it can");
        (undone, played.game.clock().tick)
    };
    played.ask(loss(0.9));
    assert_eq!(undo(&mut played), (Some("extra loss".into()), 150), "it waited and is taken back");
    assert_eq!(undo(&mut played), (Some("extra loss".into()), 100));
    let mut without = Played::new(&plan);
    let digests = without.play_to(150, |tick| if tick < 100 { person(tick) } else { Vec::new() });
    assert_eq!(played.watch_to(150), digests[100..]);
    assert_eq!(undo(&mut played), (Some("the radio jammed".into()), 60));
    assert_eq!(undo(&mut played), (Some("home 1 driven".into()), 20));
    let nothing = Played::new(&plan).watch_to(150);
    assert_eq!(played.watch_to(150), nothing[20..]);
    assert_eq!(undo(&mut played), (None, 150));
    let names: Vec<&str> = played.rewind.branches().map(|(_, branch)| branch.name.as_str()).collect();
    assert_eq!(names[1..], ["without extra loss", "without the radio jammed", "without home 1 driven"]);
}

#[test]
fn a_match_over_sockets_stays_where_it_is() {
    let ears = std::net::UdpSocket::bind("127.0.0.1:0").expect("a free port");
    let network = net::NetworkPlan { announce: ears.local_addr().ok(), ..Default::default() };
    let plan = plan(Choice { network: Box::new(network), ..Choice::default() });
    let mut played = Played::new(&plan);
    net::open(played.game.world_mut(), &plan).expect("it can be announced");
    played.watch_to(10);
    let refused = played.rewind.seek(played.game.world_mut(), 5, &mut |_| ());
    assert_eq!(refused, Err(CannotRewind::Sockets));
    assert_eq!(played.game.clock().tick, 10);
    net::close(played.game.world_mut());
    played.seek(5);
    assert_eq!(played.game.clock().tick, 5);
}

#[test]
fn who_looks_on_goes_back_too() {
    #[derive(Resource, Clone, Default, PartialEq, Debug)]
    struct Seen(Vec<u64>);
    let look = |world: &mut World| {
        let tick = world.resource::<Clock>().tick;
        world.resource_mut::<Seen>().0.push(tick);
    };
    let mut app = App::new();
    app.add_plugins(crate::game::simulation).init_resource::<Seen>().goes_back::<Seen>();
    app.finish();
    app.cleanup();
    let world = app.world_mut();
    crate::game::start_match(world, &friendly());
    let mut rewind = Rewind::begin(world);
    (0..200).for_each(|_| rewind.play(world, look));
    rewind.seek(world, 150, &mut { look }).expect("it can go back");
    assert_eq!(world.resource::<Seen>().0, (1..=150).collect::<Vec<_>>());
    rewind.seek(world, 125, &mut { look }).expect("it can go back");
    assert_eq!(world.resource::<Seen>().0, (1..=125).collect::<Vec<_>>());
}

#[test]
fn swaps_and_crashes_are_events_and_those_of_a_branch_are_its_own() {
    let plan = scenario("swap_figure_8");
    let mut played = Played::new(&plan);
    played.watch_to(600);
    let of = |played: &Played, branch| -> Vec<MatchEvent> {
        let mut events: Vec<_> = played.rewind.events(BranchId(branch)).cloned().collect();
        events.sort_by_key(|event| event.tick);
        events
    };
    let swapped = of(&played, 0);
    let first = swapped.iter().find(|event| matches!(event.what, MatchEventKind::RoleTaken { .. }));
    let first = first.expect("the scenario is about a swap").tick;
    played.seek(0);
    played.watch_to(600);
    assert_eq!(of(&played, 0), swapped, "nothing is noted twice");
    played.seek(first);
    played.ask(Request::Robot(MINE, RobotChange::Fail(RobotFailure::Crashed)));
    played.watch_to(first + 10);
    let shared: Vec<_> = swapped.iter().filter(|event| event.tick < first).cloned().collect();
    let branched = of(&played, 1);
    assert_eq!(branched[..shared.len()], shared);
    let crash = &branched[shared.len()];
    assert_eq!((crash.tick, &crash.what), (first, &MatchEventKind::Crashed { robot: MINE }));
    assert_eq!(of(&played, 0), swapped);
}

#[test]
fn notes_are_kept_with_the_branch_in_which_their_tick_was_played() {
    let mut played = Played::new(&friendly());
    played.watch_to(100);
    played.rewind.set_bookmark(80, "here".into());
    played.seek(50);
    played.ask(Request::Radio(RadioChange::Jam(true)));
    played.watch_to(90);
    played.rewind.set_bookmark(50, "fork".into());
    played.rewind.set_bookmark(70, "there".into());
    let notes = |played: &Played, branch| -> Vec<(u64, String)> {
        played.rewind.bookmarks(BranchId(branch)).map(|(tick, note)| (tick, note.to_owned())).collect()
    };
    assert_eq!(notes(&played, 0), [(50, "fork".into()), (80, "here".into())]);
    assert_eq!(notes(&played, 1), [(70, "there".into()), (50, "fork".into())]);
    played.rewind.set_bookmark(70, String::new());
    assert_eq!(notes(&played, 1), [(50, "fork".into())]);
}

#[test]
fn keyframes_lie_close_together_in_the_near_past_and_ten_seconds_apart_before_it() {
    let mut world = World::new();
    world.init_resource::<crate::state::StateRegister>();
    let mut keyframes = Keyframes::default();
    for tick in (0..=72_000).step_by(120) {
        keyframes.insert(tick, Keyframe::take(&mut world));
    }
    assert_eq!(keyframes.len(), 60 + 108 + 1);
    let nearest = |tick| keyframes.before(tick).map(|(tick, _)| tick);
    assert_eq!([nearest(71_999), nearest(30_599), nearest(0)], [Some(71_880), Some(30_000), Some(0)]);
}

#[test]
fn a_single_message_under_way_is_dropped_or_arrives_at_once_and_a_lost_one_arrives_after_all() {
    let mut played = Played::new(&friendly());
    let states = |played: &Played| -> Vec<(u64, TransmissionState)> {
        let radio = played.game.world().resource::<RadioRecord>();
        radio.transmissions().map(|sent| (sent.id, sent.state)).collect()
    };
    let state =
        |played: &Played, id| states(played).into_iter().find(|(known, _)| *known == id).map(|(_, it)| it);
    let far = |played: &Played| {
        let now = played.game.clock().tick;
        let is_far = |(_, state): &(u64, TransmissionState)| matches!(state, TransmissionState::InFlight(due) if *due > now + 3);
        states(played).into_iter().find(is_far).map(|(id, _)| id)
    };
    played.watch_to(100);
    while far(&played).is_none() {
        let next = played.game.clock().tick + 1;
        played.watch_to(next);
    }
    let (id, tick) = (far(&played).expect("one is under way"), played.game.clock().tick);
    let (lost, _) = states(&played)
        .into_iter()
        .find(|(_, state)| matches!(state, TransmissionState::Lost(_)))
        .expect("an awful radio loses some");
    played.watch_to(tick + 60);
    for (request, wanted) in [
        (RadioChange::Drop(id), (id, TransmissionState::Lost(Loss::Fault))),
        (RadioChange::Deliver(id), (id, TransmissionState::Arrived(tick))),
        (RadioChange::Deliver(lost), (lost, TransmissionState::Arrived(tick))),
    ] {
        played.switch(0, tick);
        played.ask(Request::Radio(request));
        played.watch_to(tick + 1);
        assert_eq!(state(&played, wanted.0), Some(wanted.1));
        played.watch_to(tick + 60);
        assert_eq!(state(&played, wanted.0), Some(wanted.1), "a copy that comes later changes nothing");
    }
}
