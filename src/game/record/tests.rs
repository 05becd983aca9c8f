//! What is recorded of a world that is arranged by hand.

use super::*;
use crate::comms::radio::RadioRecord;
use crate::geometry::{Pose, Twist};
use crate::ids::Team::{Away, Home};
use crate::rng::Seed;
use crate::robot::handling::Handling;
use crate::robot::{DriveCommand, OffPitch, Trailer, WheelSpeeds};
use crate::strategy::{Activity, Role, Strategies};
use crate::testing::BALL;
use crate::world::referee::RuleBook;
use crate::world::{BodyEvents, ContactImpulses};

fn record(seed: u64) -> Record {
    Record::new(
        Seed(seed),
        [Home, Away].into_iter().flat_map(|team| (0..4).map(move |n| RobotId::new(team, n))),
    )
}

/// A match at play with the ball at the origin and one robot of each team far away, after no tick.
fn app() -> App {
    let mut app = App::new();
    app.add_plugins((crate::schedule::plugin, plugin));
    let mut state = MatchState::new(Home, &RuleBook::default());
    state.phase = Phase::Playing;
    app.insert_resource(record(1));
    app.insert_resource(Clock::new(60.0));
    app.insert_resource(state);
    app.init_resource::<RadioRecord>();
    app.init_resource::<Invariants>();
    app.insert_resource(RuleBook::default());
    app.insert_resource(crate::testing::pitch());
    let strategy = std::sync::Arc::new(crate::testing::idle());
    app.insert_resource(Strategies([strategy.clone(), strategy]));
    app.insert_resource(BALL);
    app.init_resource::<Calls>();
    app.init_resource::<ContactImpulses>();
    app.init_resource::<BodyEvents>();
    app.world_mut().spawn((Ball, Pose::default(), Twist::default()));
    robot(&mut app, Home, 0, 3.0);
    robot(&mut app, Away, 0, -3.0);
    app
}

/// A robot on the x axis.
fn robot(app: &mut App, team: Team, number: u8, x: f32) -> Entity {
    let id = RobotId::new(team, number);
    let activity = Activity::new(&crate::testing::idle(), 0, 0);
    let trailer = Trailer { of: id, middle: Vec2::ZERO, radius: 0.3 };
    app.world_mut().spawn((trailer, Pose::new(x, 1.0, 0.0)));
    let clock = Clock::new(60.0);
    let (kind, sensing) = (crate::testing::cye().into(), crate::testing::perfect_sensing().into());
    let body = (
        Robot::new(kind, sensing, &clock),
        DriveCommand::Wheels(WheelSpeeds::default()),
        Handling::new(Seed(1), id),
        Orders { state: RobotState::Playing, ..Orders::default() },
    );
    app.world_mut().spawn((id, Pose::new(x, 0.0, 0.0), Twist::default(), Role(0), activity, body)).id()
}

/// The record after so many more ticks.
fn after(app: &mut App, ticks: u64) -> Record {
    (0..ticks).for_each(|_| app.world_mut().run_schedule(Tick));
    app.world().resource::<Record>().clone()
}

fn of_robot(app: &mut App, team: Team) -> Entity {
    let mut robots = app.world_mut().query::<(Entity, &RobotId)>();
    let found = robots.iter(app.world()).find(|(_, id)| id.team == team);
    found.map(|(entity, _)| entity).expect("each team has a robot")
}

fn put(app: &mut App, robot: Entity, x: f32) {
    app.world_mut().get_mut::<Pose>(robot).expect("the robot is somewhere").position.x = x;
}

fn set_phase(app: &mut App, phase: Phase) {
    app.world_mut().resource_mut::<MatchState>().phase = phase;
}

#[track_caller]
fn assert_seconds(got: [f64; 2], want: [f64; 2]) {
    assert!((got[0] - want[0]).abs() < 1e-4 && (got[1] - want[1]).abs() < 1e-4, "got {got:?}, want {want:?}");
}

#[test]
fn possession_is_the_nearest_robots_from_when_it_gets_near_until_another_does() {
    let mut app = app();
    let (home, away) = (of_robot(&mut app, Home), of_robot(&mut app, Away));
    assert_seconds(after(&mut app, 60).possession, [0.0, 0.0]);
    put(&mut app, home, 0.49);
    assert_seconds(after(&mut app, 60).possession, [1.0, 0.0]);
    put(&mut app, away, -0.48);
    assert_seconds(after(&mut app, 60).possession, [1.0, 1.0]);
    put(&mut app, away, -0.5);
    assert_seconds(after(&mut app, 60).possession, [2.0, 1.0]);
    put(&mut app, home, 2.0);
    let record = after(&mut app, 60);
    assert_seconds(record.possession, [3.0, 1.0]);
    assert_seconds(record.possession_shares(), [0.75, 0.25]);
}

#[test]
fn nobodys_ball_is_half_of_each() {
    assert_eq!(after(&mut app(), 60).possession_shares(), [0.5, 0.5]);
}

#[test]
fn a_ball_is_crowded_by_two_of_one_team_and_not_by_one_of_each() {
    let mut app = app();
    let (home, away) = (of_robot(&mut app, Home), of_robot(&mut app, Away));
    put(&mut app, home, 0.9);
    put(&mut app, away, -0.9);
    assert_seconds(after(&mut app, 60).crowding.seconds(CROWD), [0.0, 0.0]);
    let second = robot(&mut app, Away, 1, 0.99);
    assert_seconds(after(&mut app, 60).crowding.seconds(CROWD), [0.0, 1.0]);
    robot(&mut app, Away, 2, 0.5);
    assert_seconds(after(&mut app, 60).crowding.seconds(CROWD), [0.0, 2.0]);
    put(&mut app, away, -1.0);
    put(&mut app, second, 1.01);
    assert_seconds(after(&mut app, 60).crowding.seconds(CROWD), [0.0, 2.0]);
}

#[test]
fn a_removed_robot_neither_has_nor_crowds_the_ball_nor_drives() {
    let mut app = app();
    let home = of_robot(&mut app, Home);
    put(&mut app, home, 0.1);
    app.world_mut().entity_mut(home).insert((OffPitch, Twist { linear: Vec2::X, angular: 0.0 }));
    robot(&mut app, Home, 1, 0.9);
    let record = after(&mut app, 60);
    assert_seconds(record.possession, [0.0, 0.0]);
    assert_seconds(record.crowding.seconds(CROWD), [0.0, 0.0]);
    assert_eq!(record.driven_by(Home), 0.0);
}

#[test]
fn driven_metres_are_speed_times_time_whatever_the_direction_and_belong_to_their_robot() {
    let mut app = app();
    let home = of_robot(&mut app, Home);
    app.world_mut().entity_mut(home).insert(Twist { linear: Vec2::new(-0.3, 0.4), angular: 2.0 });
    let other = robot(&mut app, Away, 2, 2.0);
    app.world_mut().entity_mut(other).insert(Twist { linear: Vec2::new(0.0, -1.0), angular: 0.0 });
    let record = after(&mut app, 120);
    assert_seconds(Team::BOTH.map(|team| record.driven_by(team)), [1.0, 2.0]);
    let drove: Vec<RobotId> = record.driven.iter().filter(|(_, way)| *way > 0.0).map(|(id, _)| *id).collect();
    assert_eq!(drove, [RobotId::new(Home, 0), RobotId::new(Away, 2)]);
}

#[test]
fn only_play_is_measured_and_every_tick_is_counted() {
    let mut app = app();
    let home = of_robot(&mut app, Home);
    put(&mut app, home, 0.1);
    app.world_mut().entity_mut(home).insert(Twist { linear: Vec2::X, angular: 0.0 });
    let before = after(&mut app, 60);
    assert!((before.played - 1.0).abs() < 1e-4, "{}", before.played);
    // The whistle ends stretches of time and what is undecided about a loose ball.
    set_phase(&mut app, Phase::Set);
    let before = after(&mut app, 1);
    for phase in [Phase::Initial, Phase::Ready, Phase::Set, Phase::Finished] {
        set_phase(&mut app, phase);
        let record = after(&mut app, 10);
        assert_ne!(record.digest, before.digest);
        assert_eq!(Record { digest: before.digest, ..record }, before, "{phase}");
    }
    assert_eq!(app.world().resource::<Clock>().tick, 101);
}

/// The digest of one tick after a change.
fn digest_with(change: impl FnOnce(&mut App)) -> u64 {
    let mut app = app();
    change(&mut app);
    after(&mut app, 1).digest
}

fn changed<T: Component<Mutability = bevy::ecs::component::Mutable>>(
    team: Team,
    change: impl FnOnce(&mut T),
) -> u64 {
    digest_with(|app| {
        let robot = of_robot(app, team);
        change(&mut app.world_mut().get_mut::<T>(robot).expect("the robot has it"));
    })
}

/// The digest after changing the pose of the ball or of a trailer.
fn moved<With: Component>(change: impl FnOnce(&mut Pose)) -> u64 {
    digest_with(|app| {
        let mut poses = app.world_mut().query_filtered::<&mut Pose, bevy::prelude::With<With>>();
        change(&mut poses.iter_mut(app.world_mut()).next().expect("there is one"));
    })
}

#[test]
fn equal_worlds_have_equal_digests_and_any_change_another_one() {
    let base = digest_with(|_| {});
    assert_eq!(base, digest_with(|_| {}));
    let nudge = |value: &mut f32| *value = value.next_up();
    let state = |change: fn(&mut MatchState)| digest_with(|app| change(&mut app.world_mut().resource_mut()));
    let digests = [
        ("home x", changed(Home, |pose: &mut Pose| nudge(&mut pose.position.x))),
        ("home y", changed(Home, |pose: &mut Pose| nudge(&mut pose.position.y))),
        ("home heading", changed(Home, |pose: &mut Pose| nudge(&mut pose.heading))),
        ("away x", changed(Away, |pose: &mut Pose| nudge(&mut pose.position.x))),
        ("trailer x", moved::<Trailer>(|pose| nudge(&mut pose.position.x))),
        ("trailer heading", moved::<Trailer>(|pose| nudge(&mut pose.heading))),
        ("ball x", moved::<Ball>(|pose| nudge(&mut pose.position.x))),
        ("ball y", moved::<Ball>(|pose| nudge(&mut pose.position.y))),
        ("home role", changed(Home, |role: &mut Role| role.0 = 1)),
        ("away role", changed(Away, |role: &mut Role| role.0 = 1)),
        ("home sub-role", changed(Home, |activity: &mut Activity| activity.acting_as = 1)),
        ("home state", changed(Home, |activity: &mut Activity| activity.state = 1)),
        ("away state", changed(Away, |activity: &mut Activity| activity.state = 1)),
        ("home score", state(|state| state.score[0] = 1)),
        ("away score", state(|state| state.score[1] = 1)),
        ("phase", state(|state| state.phase = Phase::Ready)),
        ("seed", digest_with(|app| *app.world_mut().resource_mut() = record(2))),
    ];
    let distinct: std::collections::BTreeSet<u64> = digests.iter().map(|(_, digest)| *digest).collect();
    for (what, digest) in digests {
        assert_ne!(digest, base, "{what} does not change the digest");
    }
    assert_eq!(distinct.len(), digests.len(), "two changes look alike");
}

#[test]
fn the_digest_does_not_depend_on_the_order_in_which_robots_were_put_on_the_pitch() {
    let arranged = |order: [(Team, u8, f32); 3]| {
        digest_with(|app| {
            for (team, number, x) in order {
                robot(app, team, number, x);
            }
        })
    };
    let (a, b, c) = ((Home, 1, 1.0), (Home, 2, 2.0), (Away, 1, -1.0));
    assert_eq!(arranged([a, b, c]), arranged([c, b, a]));
    let (a, b) = ((Home, 1, 2.0), (Home, 2, 1.0));
    assert_ne!(arranged([a, b, c]), arranged([(Home, 1, 1.0), (Home, 2, 2.0), c]), "two changed places");
}

#[test]
fn the_digest_remembers_what_was_and_is_no_more() {
    let mut app = app();
    let home = of_robot(&mut app, Home);
    put(&mut app, home, 3.5);
    after(&mut app, 1);
    put(&mut app, home, 3.0);
    assert_ne!(after(&mut app, 1).digest, after(&mut self::app(), 2).digest);
}
