//! Requests, carried out by hand.

use std::net::SocketAddr;
use std::sync::Arc;

use proptest::prelude::*;
use proptest::strategy::Strategy as _;

use super::*;
use crate::clock::Clock;
use crate::comms::messages::TeamMessage;
use crate::comms::radio::{Channel, FaultRules, Interference};
use crate::comms::tcm::ExternalMessage;
use crate::comms::tcm::fragments::{USUAL_DATAGRAM, cut};
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::ids::Team::{self, Away, Home};
use crate::mind::perception::Memory;
use crate::mind::{behaviour, teamwork};
use crate::rng::Seed;
use crate::robot::pilot::Pilot;
use crate::robot::{HeadIntent, KickIntent, Restart, SteeringIntent};
use crate::strategy::{Activity, Role, Strategies, Strategy};
use crate::testing::{perfect_radio, strategy};
use crate::world::sense::{HallLight, Light};

/// Two schemas in one assemblage, one machine, two roles; the first one plays.
const PIECES: &str = r#"
    schemas: {"a": Constant(1, 0), "b": Constant(0, 1)},
    assemblages: {"both": WeightedSum([(1.0, "a"), (2.0, "b")])},
    features: {"never": Lasting(what: Known(Ball), seconds: 1)},
    machines: {"m": (start: "s", states: {"s": (run: "both", on: [(when: Is("never"), go: "t")]), "t": ()})},
    roles: {
        "one": Plays(tag: "1", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)]),
        "two": Plays(tag: "2", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)]),
    },
"#;

const FIRST: RobotId = RobotId::new(Home, 0);
const SECOND: RobotId = RobotId::new(Away, 0);
const NOBODY: RobotId = RobotId::new(Away, 7);

fn one() -> Strategy {
    strategy("one", PIECES)
}

fn app() -> App {
    let mut app = App::new();
    app.add_plugins((crate::schedule::plugin, teamwork::state, behaviour::state, plugin));
    let strategy = Arc::new(one());
    for id in [FIRST, SECOND] {
        let role = strategy.players[0];
        let activity = Activity::new(&strategy, role, 0);
        app.world_mut().spawn((id, Role(role), activity, Memory::new(strategy.slots)));
    }
    app.insert_resource(Strategies([strategy.clone(), strategy]));
    app.insert_resource(Channel::new(Seed(1), perfect_radio()));
    app.insert_resource(Interference::default()).insert_resource(FaultRules::default());
    app.insert_resource(crate::testing::pitch());
    app.insert_resource(HallLight::new(Light::default(), Seed(1)));
    app
}

/// Makes the requests and lets a tick pass.
fn ask(app: &mut App, requests: impl IntoIterator<Item = Request>) {
    let mut waiting = app.world_mut().resource_mut::<Requests>();
    requests.into_iter().for_each(|request| waiting.ask(request));
    app.world_mut().run_schedule(Tick);
}

fn pilots(app: &mut App) -> Vec<(RobotId, Pilot)> {
    let mut piloted = app.world_mut().query::<(&RobotId, &Pilot)>();
    let mut pilots: Vec<_> = piloted.iter(app.world()).map(|(id, pilot)| (*id, *pilot)).collect();
    pilots.sort_by_key(|(id, _)| *id);
    pilots
}

fn weights(app: &App, team: Team) -> Vec<f32> {
    let strategy = app.world().resource::<Strategies>().of(team);
    strategy.assemblages[0].terms.iter().map(|term| term.weight).collect()
}

fn set_weight(team: Team, term: usize, weight: f32) -> Request {
    Request::SetWeight { team, assemblage: 0, term, weight }
}

fn steer(robot: RobotId, throttle: f32) -> Request {
    Request::Steer { robot, pilot: Pilot { throttle, turn: 0.25, ..Pilot::default() } }
}

#[test]
fn requests_take_effect_at_the_next_tick_and_once() {
    let mut app = app();
    app.world_mut().resource_mut::<Requests>().ask(Request::TakeOver(SECOND));
    assert_eq!(pilots(&mut app), []);
    ask(&mut app, []);
    assert_eq!(pilots(&mut app), [(SECOND, Pilot::default())]);
    ask(&mut app, [Request::HandBack(SECOND)]);
    assert_eq!(pilots(&mut app), []);
    ask(&mut app, []);
    assert_eq!(pilots(&mut app), []);
}

#[test]
fn requests_are_carried_out_in_the_order_in_which_they_were_made() {
    let mut app = app();
    ask(&mut app, [Request::TakeOver(FIRST), steer(FIRST, 0.5), steer(FIRST, -0.5)]);
    assert_eq!(pilots(&mut app), [(FIRST, Pilot { throttle: -0.5, turn: 0.25, ..Pilot::default() })]);
    ask(&mut app, [Request::HandBack(FIRST), Request::TakeOver(FIRST)]);
    assert_eq!(pilots(&mut app), [(FIRST, Pilot::default())]);
    ask(&mut app, [Request::TakeOver(SECOND), Request::HandBack(SECOND), set_weight(Home, 0, 3.0)]);
    assert_eq!(pilots(&mut app), [(FIRST, Pilot::default())]);
    ask(&mut app, [set_weight(Home, 0, 4.0), set_weight(Home, 0, 5.0)]);
    assert_eq!(weights(&app, Home), [5.0, 2.0]);
}

#[test]
fn levers_are_kept_within_their_stops() {
    let mut app = app();
    ask(&mut app, [Request::TakeOver(FIRST), Request::TakeOver(SECOND)]);
    ask(&mut app, [steer(FIRST, 7.0), steer(SECOND, f32::NAN)]);
    let throttles = pilots(&mut app).iter().map(|(_, pilot)| pilot.throttle).collect::<Vec<_>>();
    assert_eq!(throttles, [1.0, 0.0]);
}

#[test]
fn requests_for_unknown_robots_are_ignored_and_the_others_carried_out() {
    let mut app = app();
    let requests =
        [Request::TakeOver(NOBODY), Request::HandBack(NOBODY), steer(NOBODY, 1.0), Request::TakeOver(SECOND)];
    ask(&mut app, requests);
    assert_eq!(pilots(&mut app), [(SECOND, Pilot::default())]);
}

#[test]
fn a_weight_is_set_for_one_team_and_not_in_the_strategy_that_both_were_given() {
    let mut app = app();
    let given = app.world().resource::<Strategies>().0[1].clone();
    ask(&mut app, [set_weight(Away, 1, -0.5)]);
    assert_eq!((weights(&app, Home), weights(&app, Away)), (vec![1.0, 2.0], vec![1.0, -0.5]));
    assert_eq!(given.assemblages[0].terms[1].weight, 2.0);
}

#[test]
fn weights_that_are_no_numbers_or_belong_to_nothing_are_ignored() {
    let mut app = app();
    let nowhere = Request::SetWeight { team: Home, assemblage: 1, term: 0, weight: 9.0 };
    let senseless = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].map(|weight| set_weight(Home, 0, weight));
    ask(&mut app, senseless.into_iter().chain([nowhere, set_weight(Home, 2, 9.0)]));
    assert_eq!((weights(&app, Home), weights(&app, Away)), (vec![1.0, 2.0], vec![1.0, 2.0]));
}

#[test]
fn another_strategy_gives_the_robots_of_one_team_their_roles_by_name_and_a_new_memory() {
    let mut app = app();
    let mut other = strategy("two", &PIECES.replace("\"one\"", "\"zero\""));
    other.slots = 5;
    let mut same = one();
    same.roles.reverse();
    let change = |team, strategy: &Strategy| Request::ChangeStrategy {
        team,
        strategy: Arc::new(strategy.clone()),
        texts: Arc::default(),
    };
    ask(&mut app, [change(Home, &other), change(Away, &same), set_weight(Away, 0, 7.0)]);
    let mut robots = app.world_mut().query::<(&RobotId, &Role, &Activity, &mut Memory)>();
    let mut acting = Vec::new();
    for (id, role, activity, mut memory) in robots.iter_mut(app.world_mut()) {
        let strategy = if id.team == Home { &other } else { &same };
        let name = |role: usize| strategy.roles[role].name.clone();
        acting.push((*id, name(role.0), name(activity.acting_as)));
        // It would panic if there were too few.
        memory.lasting(strategy.slots - 1).update(true, 0.0, 1.0);
    }
    let want = |id, role: &str| (id, role.to_owned(), role.to_owned());
    assert_eq!(acting, [want(FIRST, "two"), want(SECOND, "one")]);
    assert_eq!((weights(&app, Home), weights(&app, Away)), (vec![1.0, 2.0], vec![7.0, 2.0]));
}

/// What sockets may bring in one tick, each of another origin than the others or as its origin has sent it.
fn from_sockets() -> Vec<Request> {
    let address = |port: u16| SocketAddr::from(([127, 0, 0, 1], port));
    let packet = |port| Request::RefereeBox { from: address(port), bytes: [7].into() };
    let wants = |robot: RobotId| {
        let wants = RobotWants {
            tick: 3,
            steering: SteeringIntent::Stop,
            kick: KickIntent::Nothing,
            head: HeadIntent::default(),
            role: 0,
            acting_as: 0,
            state: 0,
            pose: Pose::default(),
            ball: None,
        };
        Request::Remote(robot, RemoteNews::Wants { wants, said: 1 })
    };
    let heard = |to: RobotId, from: RobotId, sent: u64, counter: u32| {
        let message = ExternalMessage::of(&TeamMessage::Text("hello".into()), from.into(), to.into());
        let bytes = cut(&message, counter, USUAL_DATAGRAM).unwrap().remove(0).into();
        Request::Datagram(NetworkDatagram { to, sent: Some(sent), bytes })
    };
    vec![
        packet(1),
        packet(2),
        wants(FIRST),
        wants(SECOND),
        heard(FIRST, SECOND, 1, 9),
        heard(FIRST, NOBODY, 1, 4),
        heard(FIRST, SECOND, 2, 3),
        heard(FIRST, SECOND, 2, 8),
        heard(SECOND, FIRST, 1, 1),
    ]
}

proptest! {
    #[test]
    fn what_arrives_first_within_a_tick_does_not_matter(mixed in Just(from_sockets()).prop_shuffle()) {
        let mut app = app();
        ask(&mut app, mixed);
        let due: Vec<Request> = app.world().resource::<Requests>().due().cloned().collect();
        prop_assert_eq!(due, from_sockets());
    }
}

#[test]
fn a_log_has_the_requests_of_each_tick_in_the_order_in_which_they_were_carried_out() {
    let mut app = app();
    app.insert_resource(RequestLog::default());
    app.insert_resource(Script::new(&[(1, Request::TakeOver(SECOND))]));
    let change = Request::ChangeStrategy { team: Home, strategy: Arc::new(one()), texts: Arc::default() };
    ask(&mut app, [set_weight(Home, 0, 3.0), change.clone()]);
    app.world_mut().resource_mut::<Clock>().tick = 1;
    ask(&mut app, [steer(SECOND, 0.5)]);
    ask(&mut app, []);
    let RequestLog(log) = app.world().resource::<RequestLog>().clone();
    let expected =
        [(0, change), (0, set_weight(Home, 0, 3.0)), (1, steer(SECOND, 0.5)), (1, Request::TakeOver(SECOND))];
    assert_eq!(log, expected);
}

#[test]
fn a_log_can_be_written_to_a_file_and_read_again() {
    let mut asked = from_sockets();
    asked.extend([Request::TakeOver(FIRST), steer(FIRST, 0.5), set_weight(Away, 1, 2.5)]);
    asked.extend(
        [RobotChange::Penalise, RobotChange::Revive(Restart::Kept)].map(|it| Request::Robot(SECOND, it)),
    );
    asked.push(Request::Radio(RadioChange::Change(perfect_radio())));
    asked.push(Request::Body(BodyChange::Ball { at: Vec2::X, velocity: Vec2::Y }));
    let log = RequestLog(asked.into_iter().map(|request| (7, request)).collect());
    let text = ron::to_string(&log).unwrap();
    assert_eq!(ron::from_str::<RequestLog>(&text).unwrap(), log);
    let bytes = postcard::to_stdvec(&log).unwrap();
    assert_eq!(postcard::from_bytes::<RequestLog>(&bytes).unwrap(), log);
}

#[test]
fn cleared_requests_are_never_carried_out() {
    let mut app = app();
    app.world_mut().resource_mut::<Requests>().ask(Request::TakeOver(FIRST));
    app.world_mut().resource_mut::<Requests>().clear();
    ask(&mut app, []);
    assert_eq!(pilots(&mut app), []);
}

#[test]
fn a_robot_that_nobody_drives_is_not_steered() {
    let mut app = app();
    ask(&mut app, [steer(FIRST, 0.5)]);
    assert_eq!(pilots(&mut app), []);
    ask(&mut app, [Request::TakeOver(FIRST), Request::HandBack(FIRST), steer(FIRST, 0.5)]);
    assert_eq!(pilots(&mut app), []);
}

#[test]
fn what_a_hand_asks_for_is_kept_within_the_bounds_of_files() {
    let mut app = app();
    let weight = Request::SetWeight { team: Home, assemblage: 0, term: 0, weight: 1e30 };
    let changes = [RadioChange::ExtraDelay(1e30), RadioChange::ExtraLoss(-5.0)].map(Request::Radio);
    ask(&mut app, [weight].into_iter().chain(changes));
    assert_eq!(weights(&app, Home), [1000.0, 2.0]);
    let interference = app.world().resource::<Interference>();
    assert_eq!((interference.extra_delay, interference.extra_loss), (600.0, 0.0));
}
