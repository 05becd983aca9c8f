//! Messages between robots that stand in an otherwise empty world.

use crate::testing::perfect_sensing;
use std::sync::Arc;

use super::*;
use crate::comms::messages::{self, HaveBall, Inbox, Received, TeamMessage};
use crate::comms::tcm::{self, Addresses, Directory, Tcm, TcmClient, TcmSettings};
use crate::ids::Team::{Away, Home};
use crate::rng::Seed;
use crate::robot::RobotFailure;
use crate::schedule;
use crate::testing::{cye, perfect_radio};

fn home(number: u8) -> RobotId {
    RobotId::new(Home, number)
}

/// Robots 0 to 2 of home and 0 of away, 1 m apart, with this radio.
fn app(radio: Radio) -> App {
    let mut app = App::new();
    app.add_plugins((schedule::plugin, tcm::plugin, messages::plugin, plugin));
    app.insert_resource(Channel::new(Seed(1), radio));
    app.init_resource::<Interference>().init_resource::<FaultRules>().init_resource::<RadioRecord>();
    let directory = Directory::loopback(7400, &[3, 1]).expect("there are ports enough");
    app.insert_resource(Addresses(directory));
    let clock = *app.world().resource::<Clock>();
    for (i, id) in [home(0), home(1), home(2), RobotId::new(Away, 0)].into_iter().enumerate() {
        let robot = Robot::new(Arc::new(cye()), Arc::new(perfect_sensing()), &clock);
        app.world_mut().spawn((
            id,
            robot,
            Pose::new(i as f32, 0.0, 0.0),
            Inbox::default(),
            TcmClient::new(id, TcmSettings::default().queue),
            Tcm::new(TcmSettings::default(), &clock),
        ));
    }
    app
}

fn tick(app: &mut App) {
    app.world_mut().run_schedule(Tick);
    app.world_mut().resource_mut::<Clock>().tick += 1;
}

fn say(app: &mut App, from: RobotId, what: impl Fn(&mut TcmClient)) {
    let mut robots = app.world_mut().query::<(&RobotId, &mut TcmClient)>();
    let speaker = robots.iter_mut(app.world_mut()).find(|(id, _)| **id == from);
    what(&mut speaker.expect("the robot exists").1);
}

/// The times of the messages in each robot's inbox, in order of arrival.
fn heard(app: &mut App, robot: RobotId) -> Vec<u32> {
    let mut robots = app.world_mut().query::<(&RobotId, &Inbox)>();
    let (_, inbox) = robots.iter(app.world()).find(|(id, _)| **id == robot).expect("the robot exists");
    let time = |received: &Received| match &received.message {
        TeamMessage::HaveBall(message) => message.time,
        other => panic!("{other:?}"),
    };
    inbox.0.iter().map(time).collect()
}

fn message(time: u32) -> TeamMessage {
    TeamMessage::HaveBall(HaveBall { time, robot: 0, have_ball: true, role: 0 })
}

#[test]
fn a_broadcast_reaches_the_team_mates_in_the_next_tick_and_nobody_else() {
    let mut app = app(perfect_radio());
    say(&mut app, home(0), |client| client.broadcast(&message(7)));
    tick(&mut app);
    assert!(heard(&mut app, home(1)).is_empty(), "a message takes a tick at least");
    tick(&mut app);
    assert_eq!((heard(&mut app, home(1)), heard(&mut app, home(2))), (vec![7], vec![7]));
    assert!(heard(&mut app, home(0)).is_empty() && heard(&mut app, RobotId::new(Away, 0)).is_empty());
}

#[test]
fn what_is_for_one_reaches_one_and_waits_until_it_is_taken() {
    let mut app = app(perfect_radio());
    say(&mut app, home(0), |client| client.send(2, &message(1)));
    for _ in 0..4 {
        tick(&mut app);
    }
    assert_eq!((heard(&mut app, home(1)), heard(&mut app, home(2))), (vec![], vec![1]));
}

#[test]
fn messages_that_are_due_together_arrive_in_the_order_of_their_sending() {
    let mut app = app(perfect_radio());
    for sender in [1, 0] {
        say(&mut app, home(sender), |client| {
            client.send(2, &message(10 * u32::from(sender)));
            client.send(2, &message(10 * u32::from(sender) + 1));
        });
    }
    tick(&mut app);
    tick(&mut app);
    assert_eq!(heard(&mut app, home(2)), [0, 1, 10, 11]);
}

#[test]
fn a_robot_that_fell_deaf_while_a_message_was_in_flight_does_not_hear_it() {
    let mut app = app(perfect_radio());
    say(&mut app, home(0), |client| client.broadcast(&message(7)));
    tick(&mut app);
    let mut robots = app.world_mut().query::<(&RobotId, &mut Robot)>();
    for (_, mut robot) in robots.iter_mut(app.world_mut()).filter(|(id, _)| **id == home(1)) {
        robot.health = robot.health.with(RobotFailure::Deaf);
    }
    tick(&mut app);
    assert_eq!((heard(&mut app, home(1)), heard(&mut app, home(2))), (vec![], vec![7]));
    assert_eq!(app.world().resource::<RadioRecord>().link(home(0), home(1)).lost_to(Loss::Deaf), 1);
    let states: Vec<_> =
        app.world().resource::<RadioRecord>().transmissions().map(|entry| entry.state).collect();
    assert_eq!(states, [TransmissionState::Lost(Loss::Deaf), TransmissionState::Arrived(1)]);
}

#[test]
fn the_record_forgets_transmissions_older_than_a_minute() {
    let mut app = app(perfect_radio());
    say(&mut app, home(0), |client| client.broadcast(&message(7)));
    tick(&mut app);
    assert_eq!(app.world().resource::<RadioRecord>().transmissions().count(), 2);
    app.world_mut().resource_mut::<Clock>().tick += 3600;
    tick(&mut app);
    let record = app.world().resource::<RadioRecord>();
    assert_eq!((record.transmissions().count(), record.transmitted()), (0, 2));
}
