//! Modules of robots that stand in an otherwise empty world, over a radio that loses nothing.

use crate::testing::perfect_sensing;
use std::iter::zip;

use super::counters::{Dropped, TypeCount};
use super::queues::{QueueCounters, QueueRule, WhenFull};
use super::*;
use crate::comms::radio::{self, Channel, FaultRules, Interference, RadioRecord};
use crate::data::ron_options;
use crate::geometry::Pose;
use crate::ids::Team::{Away, Home};
use crate::rng::Seed;
use crate::robot::Robot;
use crate::schedule;
use crate::testing::{cye, perfect_radio};

/// What a user's module says: a line of text, of a type and from a module of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Note<const TYPE: u16, const MODULE: u8>(Vec<u8>);

impl<const TYPE: u16, const MODULE: u8> Data for Note<TYPE, MODULE> {
    const TYPES: &'static [TypeInfo] = &[TypeInfo {
        number: DataType(TYPE),
        name: "note",
        module: Module(MODULE),
        priority: Priority::Routine,
    }];

    fn serialise(&self) -> (&'static TypeInfo, Vec<u8>) {
        (&Self::TYPES[0], self.0.clone())
    }

    fn unserialise(_: DataType, bytes: &[u8]) -> Option<Self> {
        std::str::from_utf8(bytes).ok().map(|_| Note(bytes.to_vec()))
    }
}

/// The type that users' modules exchange.
const NOTE: DataType = DataType(1024);
/// A type that nobody has registered.
const UNKNOWN: DataType = DataType(1025);

/// Registered by [`app`].
type UserNote = Note<1024, 128>;
/// Of the same type, from another module.
type Reply = Note<1024, 129>;
/// Registered by nobody.
type Unknown = Note<1025, 128>;

const HOME_0: RobotId = RobotId::new(Home, 0);
const HOME_1: RobotId = RobotId::new(Home, 1);
const HOME_2: RobotId = RobotId::new(Home, 2);
const AWAY_0: RobotId = RobotId::new(Away, 0);
const USERS: Module = Module(128);
const OTHERS: Module = Module(129);

/// Cuts a message into pieces of twelve bytes.
fn small() -> TcmSettings {
    TcmSettings { datagram: fragments::HEADER + 12, ..usual() }
}

fn usual() -> TcmSettings {
    TcmSettings::default()
}

/// What the observer of the user's type has been called with: by whom, from whom, what.
#[derive(Resource, Default)]
struct Notes(Vec<(RobotId, Peer, Vec<u8>)>);

fn hear(arrived: On<Arrived<UserNote>>, robots: Query<&RobotId>, mut heard: ResMut<Notes>) {
    let id = robots.get(arrived.entity).expect("it arrives at a robot");
    heard.0.push((*id, arrived.from, arrived.data.0.clone()));
}

/// Robots 0 to 2 of home and 0 of away, with these settings.
fn app(settings: TcmSettings) -> App {
    let mut app = App::new();
    app.add_plugins((schedule::plugin, plugin, radio::plugin));
    app.insert_resource(Channel::new(Seed(1), perfect_radio()));
    app.init_resource::<Interference>().init_resource::<FaultRules>();
    app.init_resource::<RadioRecord>().init_resource::<Notes>();
    app.insert_resource(Addresses(Directory::loopback(7400, &[3, 1]).expect("there are ports enough")));
    app.register_data::<UserNote>().add_observer(hear);
    let clock = *app.world().resource::<Clock>();
    for (place, id) in zip(0u8.., [HOME_0, HOME_1, HOME_2, AWAY_0]) {
        app.world_mut().spawn((
            id,
            Robot::new(Arc::new(cye()), Arc::new(perfect_sensing()), &clock),
            Pose::new(f32::from(place), 0.0, 0.0),
            TcmClient::new(id, settings.queue),
            Tcm::new(settings, &clock),
        ));
    }
    app
}

fn ticks(app: &mut App, ticks: u64) {
    for _ in 0..ticks {
        app.world_mut().run_schedule(Tick);
        app.world_mut().resource_mut::<Clock>().tick += 1;
    }
}

/// Lets a robot's modules say something.
fn say(app: &mut App, from: RobotId, what: impl Fn(&mut TcmClient)) {
    let mut robots = app.world_mut().query::<(&RobotId, &mut TcmClient)>();
    let (_, mut client) = robots.iter_mut(app.world_mut()).find(|(id, _)| **id == from).expect("it exists");
    what(&mut client);
}

fn note(text: &str) -> UserNote {
    Note(text.into())
}

/// What has reached the observer since the last call, as text.
fn heard(app: &mut App) -> Vec<(RobotId, String)> {
    let heard = std::mem::take(&mut app.world_mut().resource_mut::<Notes>().0);
    let text = |bytes| String::from_utf8(bytes).expect("others are no notes");
    heard.into_iter().map(|(id, _, bytes)| (id, text(bytes))).collect()
}

/// What one robot has heard since the last call of [`heard`].
fn heard_by(app: &mut App, robot: RobotId) -> Vec<String> {
    heard(app).into_iter().filter(|(id, _)| *id == robot).map(|(_, text)| text).collect()
}

fn tcm(app: &mut App, robot: RobotId) -> Tcm {
    let mut robots = app.world_mut().query::<(&RobotId, &Tcm)>();
    let found = robots.iter(app.world()).find(|(id, _)| **id == robot);
    found.expect("the robot exists").1.clone()
}

fn queue(app: &mut App, robot: RobotId, module: Module) -> (usize, QueueCounters) {
    let mut robots = app.world_mut().query::<(&RobotId, &TcmClient)>();
    let (_, client) = robots.iter(app.world()).find(|(id, _)| **id == robot).expect("the robot exists");
    let row = client.rows().find(|(of, ..)| *of == module).expect("the module has said something");
    (row.1, row.2)
}

/// The datagrams of a message from robot 0 of home, as if a carrier brought them to another in the next tick.
fn bring(app: &mut App, to: RobotId, destination: Peer, counter: u32, text: &str) {
    let address = |peer| Address { peer, module: USERS };
    let (source, destination) = (address(HOME_0.into()), address(destination));
    let message = ExternalMessage { source, destination, data_type: NOTE, data: text.into() };
    let datagrams = cut(&message, counter, small().datagram).expect("it can be cut");
    let mut incoming = app.world_mut().resource_mut::<Incoming>();
    incoming.0.extend(datagrams.into_iter().map(|datagram| (to, datagram.into())));
}

/// Lets the radio do this to the packets that the rule names.
fn spoil(app: &mut App, rule: &str) {
    let rule = ron_options().from_str(rule).expect("the rule is sound");
    app.world_mut().resource_mut::<FaultRules>().add(rule);
}

/// One message was dropped, for this reason.
fn only(reason: Dropped) -> [u64; Dropped::ALL.len()] {
    Dropped::ALL.map(|other| u64::from(other == reason))
}

/// 1000 bytes, no two pieces of which are alike.
fn long_text() -> String {
    (100..350).map(|number| format!("{number} ")).collect()
}

#[test]
fn data_of_a_users_own_type_are_given_to_who_observes_it() {
    let mut app = app(usual());
    say(&mut app, HOME_0, |client| client.send(1, &note("to you")));
    ticks(&mut app, 2);
    let expected = (HOME_1, Peer::from(HOME_0), b"to you".to_vec());
    assert_eq!(app.world().resource::<Notes>().0, [expected]);
    let sent = TypeCount { messages_sent: 1, bytes_sent: 6, datagrams_sent: 1, ..TypeCount::default() };
    let received = TypeCount { messages_received: 1, bytes_received: 6, ..TypeCount::default() };
    assert_eq!(tcm(&mut app, HOME_0).counters.of(USERS, NOTE), sent);
    assert_eq!(tcm(&mut app, HOME_1).counters.of(USERS, NOTE), received);
}

#[test]
fn data_that_nobody_has_registered_are_counted_and_do_not_keep_the_next_message_back() {
    let mut app = app(usual());
    say(&mut app, HOME_0, |client| {
        client.send::<Unknown>(1, &Note(b"lost".into()));
        client.send(1, &note("found"));
    });
    ticks(&mut app, 2);
    assert_eq!(heard(&mut app), [(HOME_1, "found".into())]);
    let count = tcm(&mut app, HOME_1).counters.of(USERS, UNKNOWN);
    assert_eq!(count.dropped, only(Dropped::UnknownType));
    assert_eq!(count.messages_received, 0);
}

#[test]
fn data_that_cannot_be_unserialised_are_counted_and_do_not_keep_the_next_message_back() {
    let mut app = app(usual());
    say(&mut app, HOME_0, |client| {
        client.send::<UserNote>(1, &Note(vec![0xFF]));
        client.send(1, &note("sound"));
    });
    ticks(&mut app, 2);
    assert_eq!(heard(&mut app), [(HOME_1, "sound".into())]);
    let count = tcm(&mut app, HOME_1).counters.of(USERS, NOTE);
    assert_eq!(count.dropped, only(Dropped::NotUnserialisable));
    assert_eq!((count.messages_received, count.bytes_received), (1, 5));
}

#[test]
fn bytes_that_are_no_datagram_are_counted_and_do_no_harm() {
    let mut app = app(usual());
    app.world_mut().resource_mut::<Incoming>().0.push((HOME_1, Arc::from(&b"hello"[..])));
    say(&mut app, HOME_0, |client| client.send(1, &note("sound")));
    ticks(&mut app, 2);
    assert_eq!(heard(&mut app), [(HOME_1, "sound".into())]);
    assert_eq!(tcm(&mut app, HOME_1).counters.malformed, 1);
}

#[test]
fn a_message_that_needs_many_datagrams_arrives_whole() {
    let mut app = app(small());
    say(&mut app, HOME_0, |client| {
        client.broadcast(&note(&long_text()));
        client.broadcast(&note("short"));
    });
    ticks(&mut app, 2);
    for robot in [HOME_1, HOME_2] {
        let assembly = tcm(&mut app, robot).assembly.counters();
        assert_eq!((assembly.completed, assembly.single), (1, 1), "{robot}");
    }
    let expected = [HOME_1, HOME_2].map(|robot| [(robot, long_text()), (robot, "short".into())]);
    let mut heard = heard(&mut app);
    heard.sort_by_key(|(robot, _)| *robot);
    assert_eq!(heard, expected.concat());
    let count = tcm(&mut app, HOME_0).counters.of(USERS, NOTE);
    // The long one in pieces of twelve bytes, each for two mates and a computer that may listen.
    assert_eq!((count.bytes_sent, count.datagrams_sent), (1005, 3 * (84 + 1)));
}

#[test]
fn a_message_that_lost_a_fragment_expires_and_only_for_who_missed_it() {
    let mut app = app(small());
    spoil(&mut app, r#"(to: "home 1", which: Nth(40), act: Drop)"#);
    say(&mut app, HOME_0, |client| client.broadcast(&note(&long_text())));
    ticks(&mut app, 61);
    assert_eq!(heard(&mut app), [(HOME_2, long_text())]);
    let unfinished: Vec<_> =
        tcm(&mut app, HOME_1).assembly.in_assembly().map(|it| (it.have, it.of)).collect();
    assert_eq!((unfinished, tcm(&mut app, HOME_1).counters.expired), (vec![(83, 84)], 0));
    ticks(&mut app, 1);
    assert_eq!(tcm(&mut app, HOME_1).assembly.in_assembly().len(), 0);
    assert_eq!((tcm(&mut app, HOME_1).counters.expired, tcm(&mut app, HOME_2).counters.expired), (1, 0));
    say(&mut app, HOME_0, |client| client.broadcast(&note("next")));
    ticks(&mut app, 2);
    assert_eq!(heard_by(&mut app, HOME_1), ["next"]);
}

#[test]
fn fragments_that_come_in_another_order_and_twice_make_one_message() {
    let mut app = app(small());
    bring(&mut app, HOME_1, Peer::Team(0), 5, &long_text());
    app.world_mut().resource_mut::<Incoming>().0.reverse();
    bring(&mut app, HOME_1, Peer::Team(0), 5, &long_text());
    ticks(&mut app, 1);
    assert_eq!(heard(&mut app), [(HOME_1, long_text())]);
    assert_eq!(tcm(&mut app, HOME_1).assembly.counters().late, 84);
}

#[test]
fn a_message_that_no_datagrams_can_carry_is_counted_and_does_not_keep_the_next_back() {
    let mut app = app(TcmSettings { datagram: fragments::HEADER + 1, ..usual() });
    say(&mut app, HOME_0, |client| {
        client.broadcast(&note(&"a".repeat(65_536)));
        client.broadcast(&note("b"));
    });
    ticks(&mut app, 2);
    assert_eq!(heard_by(&mut app, HOME_1), ["b"]);
    let count = tcm(&mut app, HOME_0).counters.of(USERS, NOTE);
    assert_eq!((count.dropped_as(Dropped::TooLarge), count.messages_sent), (1, 1));
}

#[test]
fn a_module_that_says_too_much_drops_its_oldest_or_its_newest_and_nothing_of_another_module() {
    let kept = [(WhenFull::DropOldest, ["3", "4"]), (WhenFull::DropNewest, ["0", "1"])];
    for (when_full, expected) in kept {
        let mut app = app(TcmSettings { queue: QueueRule { capacity: 2, when_full }, ..usual() });
        say(&mut app, HOME_0, |client| {
            (0..5).for_each(|number| client.send(1, &note(&number.to_string())));
            client.send::<Reply>(2, &Note(b"also".into()));
        });
        let counters = QueueCounters { put_in: 5, handed_over: 0, dropped: 3 };
        assert_eq!(queue(&mut app, HOME_0, USERS), (2, counters), "{when_full:?}");
        ticks(&mut app, 2);
        let heard = heard(&mut app);
        let by = |robot| heard.iter().filter(move |(id, _)| *id == robot).map(|(_, text)| &**text);
        assert_eq!(by(HOME_1).collect::<Vec<_>>(), expected, "{when_full:?}");
        assert_eq!(by(HOME_2).collect::<Vec<_>>(), ["also"], "{when_full:?}");
        assert_eq!(queue(&mut app, HOME_0, USERS), (0, QueueCounters { handed_over: 2, ..counters }));
        assert_eq!(queue(&mut app, HOME_0, OTHERS).1.dropped, 0);
    }
}

#[test]
fn modules_take_turns_when_the_tcm_takes_less_than_they_say() {
    let mut app = app(TcmSettings { messages_per_tick: 2, ..usual() });
    say(&mut app, HOME_0, |client| {
        (0..6).for_each(|number| client.send(1, &note(&number.to_string())));
        client.send::<Reply>(1, &Note(b"also".into()));
    });
    ticks(&mut app, 2);
    assert_eq!(heard_by(&mut app, HOME_1), ["0", "also"]);
    ticks(&mut app, 1);
    assert_eq!(heard_by(&mut app, HOME_1), ["1", "2"]);
    assert_eq!(queue(&mut app, HOME_0, USERS).0, 1, "and the last one is due");
}

#[test]
fn what_is_for_one_reaches_one_and_what_is_for_the_team_all_mates_but_the_sender() {
    let mut app = app(usual());
    say(&mut app, HOME_0, |client| client.send(2, &note("you")));
    ticks(&mut app, 2);
    assert_eq!(heard(&mut app), [(HOME_2, "you".into())]);
    say(&mut app, HOME_0, |client| client.broadcast(&note("we")));
    ticks(&mut app, 2);
    assert_eq!(heard(&mut app), [(HOME_1, "we".into()), (HOME_2, "we".into())]);
    say(&mut app, HOME_0, |client| client.post(Peer::Everybody, &note("all")));
    ticks(&mut app, 2);
    assert_eq!(heard(&mut app), [HOME_1, HOME_2, AWAY_0].map(|robot| (robot, "all".into())));
    for robot in [HOME_0, HOME_1, HOME_2, AWAY_0] {
        assert_eq!(tcm(&mut app, robot).counters.foreign, 0, "{robot}");
    }
}

#[test]
fn what_is_for_the_team_also_goes_to_computers_that_listen_but_not_to_the_match_itself() {
    let mut app = app(usual());
    let address = |port| std::net::SocketAddr::from(([127, 0, 0, 1], port));
    let known = app.world().resource::<Addresses>().0.clone();
    let host = (HOST, address(7498));
    app.insert_resource(Addresses(known.entries().chain([host]).collect()));
    say(&mut app, HOME_0, |client| {
        client.broadcast(&note("we"));
        client.send(1, &note("you"));
    });
    // Not by the radio, which has no antenna for computers.
    app.world_mut().run_system_cached(send_messages).expect("it runs");
    let to: Vec<_> = app.world().resource::<OnAir>().0.iter().map(|datagram| datagram.to).collect();
    assert_eq!(to, [Peer::from(HOME_1), Peer::from(HOME_2), Peer::Computer(0), Peer::from(HOME_1)]);
}

#[test]
fn a_message_that_is_meant_for_somebody_else_is_foreign() {
    let mut app = app(usual());
    bring(&mut app, HOME_1, Peer::from(HOME_2), 1, "for another");
    bring(&mut app, HOME_1, Peer::Team(1), 2, "for the others");
    bring(&mut app, HOME_1, Peer::from(HOME_1), 3, "for me");
    ticks(&mut app, 1);
    assert_eq!(heard(&mut app), [(HOME_1, "for me".into())]);
    assert_eq!(tcm(&mut app, HOME_1).counters.foreign, 2);
    assert_eq!(tcm(&mut app, HOME_1).counters.of(USERS, NOTE).messages_received, 1);
}
