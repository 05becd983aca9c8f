//! The present moment of a match as a scenario: who stands where in which role and takes itself to be where, where the ball rolls, and what ails robots and radio. What a scenario cannot say is told in its description.

use bevy::prelude::*;

use super::condition::{Area, Condition, Expectation, Thing};
use super::event::{Event, TimedEvent};
use super::file::{BallFile, BallPlaces, PlayerFile, Referee, ScenarioFile, Seeds, SideFile};
use crate::clock::Clock;
use crate::comms::radio::{Channel, Interference, Radio};
use crate::data::{AssetFolder, AssetKind, Bound};
use crate::game::{MatchPlan, TeamPlan, checked};
use crate::geometry::{Pose, Twist, Zone, wrap_angle};
use crate::ids::{RobotId, Team};
use crate::mind::world_model::WorldModel;
use crate::pitch::Pitch;
use crate::robot::{OffPitch, Robot};
use crate::strategy::{Role, Strategies};
use crate::world::ball::Ball;
use crate::world::physics::{Footprint, nearest_free};
use crate::world::referee::{MatchState, Phase};

/// What a moment is of.
#[derive(Clone, Copy, Debug)]
pub struct CapturedMoment<'a> {
    /// What was read of the match.
    pub plan: &'a MatchPlan,
    /// The match's file, as people name it.
    pub game: &'a str,
    /// Another pitch than that match's, if it has one.
    pub pitch: Option<&'a str>,
    /// What the script of a scenario has planned for later, with times from its beginning, s.
    pub script: &'a [TimedEvent],
    /// How long the scenario is to take, s.
    pub seconds: f32,
}

/// Robots that err by less than this take themselves to be where they are, m and rad.
const ERROR: (f32, f32) = (0.05, 0.05);
/// A robot that is slower than this stands, m/s.
const STANDS: f32 = 0.01;
/// A robot is moved at most this far to stand apart from others, m.
const APART: f32 = 0.6;
/// How far beyond the lines the ball is still in the hall, m.
const HALL: f32 = 3.0;

type OnPitch<'a> = (&'a RobotId, &'a Robot, &'a Pose, &'a Twist, &'a Role, &'a WorldModel);

/// A robot as a scenario places it.
struct CapturedRobot {
    id: RobotId,
    player: PlayerFile,
    events: Vec<Event>,
}

impl CapturedMoment<'_> {
    /// The scenario that begins with what is in the world now.
    ///
    /// # Errors
    /// If no scenario can begin so, as one line.
    pub fn capture(&self, world: &mut World) -> Result<ScenarioFile, String> {
        let state = world.resource::<MatchState>().clone();
        if state.phase != Phase::Playing {
            return Err("a scenario begins with the ball in play: wait until it is".into());
        }
        let clock = *world.resource::<Clock>();
        let radio = self.radio(world.resource::<Channel>().radio())?;
        let mut standing = vec![(Footprint::of_walls(&self.plan.pitch), Pose::default())];
        let robots = self.robots(world, &state, &mut standing);
        let ball = self.ball(world, &state, &standing)?;
        let interference = radio_events(world.resource::<Interference>());
        let of_robots = robots.iter().flat_map(|robot| robot.events.clone());
        let now = clock.now() as f32;
        let begin = interference.into_iter().chain(of_robots).map(|what| TimedEvent { at: 0.0, what });
        let later = self.script.iter().filter(|event| event.at >= now && event.at - now <= self.seconds);
        let later = later.map(|event| TimedEvent { at: event.at - now, ..event.clone() });
        let [home, away] = Team::BOTH.map(|team| side(self.plan.team(team), team, &robots));
        Ok(ScenarioFile {
            name: Some(format!("{} after {:.1} s", self.plan.name, clock.now())),
            source: Some(format!("saved from {}, seed {}, tick {}", self.game, self.plan.seed, clock.tick)),
            description: Some(DESCRIPTION.into()),
            game: Some(self.game.to_owned()),
            pitch: self.pitch.map(str::to_owned),
            radio: Some(radio),
            seeds: Some(Seeds::List(vec![self.plan.seed])),
            seconds: Some(self.seconds),
            referee: Some(if state.refereed { Referee::Whole } else { Referee::Nobody }),
            home: Some(home.ok_or("a scenario needs a robot of home on the pitch")?),
            away,
            ball: Some(ball),
            faults: self.plan.faults.clone(),
            script: begin.chain(later).collect(),
            expect: vec![in_the_hall(&self.plan.pitch)],
            ..ScenarioFile::default()
        })
    }

    /// The name of the radio in force among the assets.
    fn radio(&self, radio: &Radio) -> Result<String, String> {
        let assets: &AssetFolder = &self.plan.assets;
        let is_it = |name: &String| {
            checked::<Radio>(assets, &assets.file(AssetKind::Radio, name)).is_ok_and(|known| known == *radio)
        };
        let known = assets.names(AssetKind::Radio).into_iter().find(is_it);
        known.ok_or_else(|| {
            format!("the radio `{}` is not among the assets, so no scenario can name it", radio.name)
        })
    }

    /// Those on the pitch, home attacking east as scenarios have it, none in another.
    fn robots(
        &self,
        world: &mut World,
        state: &MatchState,
        standing: &mut Vec<(Footprint, Pose)>,
    ) -> Vec<CapturedRobot> {
        let mut found = world.query_filtered::<OnPitch, Without<OffPitch>>();
        let mut found: Vec<_> = found.iter(world).collect();
        found.sort_unstable_by_key(|(id, ..)| **id);
        let strategies = world.resource::<Strategies>();
        let place = |(id, robot, pose, twist, role, model): OnPitch| {
            let ends = state.home_attacks;
            let footprint = Footprint::of_robot(&robot.kind);
            let free_near = |wanted: Pose| {
                let is_free = |pose: Pose| {
                    let apart = |(other, there): &(Footprint, Pose)| !footprint.overlaps(pose, other, *there);
                    self.plan.pitch.holds(pose.position, 0.0) && standing.iter().all(apart)
                };
                nearest_free(wanted, APART, is_free)
            };
            let seen = ends.turn_pose(*pose);
            let believed = ends.turn_pose(state.attacking(id.team).turn_pose(model.pose));
            // It begins where it takes itself to be, and is carried to where it is without being told.
            let is_known = model.is_localised() && self.plan.pitch.holds(seen.position, 0.0);
            let errs = is_known && differs(seen, believed);
            let told = Some(believed).filter(|_| errs).and_then(free_near);
            let mut events = ailments(*id, robot);
            let start = match told {
                Some(told) => {
                    let (to, facing) = (rounded(seen.position), degrees(seen.heading));
                    events.push(Event::Kidnap { robot: *id, to, facing });
                    told
                }
                None => free_near(seen).unwrap_or(seen),
            };
            let player = PlayerFile {
                number: id.number,
                at: rounded(start.position),
                facing: degrees(start.heading),
                role: strategies.of(id.team).roles.get(role.0).map(|role| role.name.clone()),
                off: robot.health.crashed,
            };
            let velocity = ends.turn(twist.linear);
            if velocity.length() > STANDS {
                let by = rounded(Bound::VELOCITY.clamp_vector(velocity));
                events.push(Event::Push { robot: *id, by });
            }
            standing.push((footprint, start));
            CapturedRobot { id: *id, player, events }
        };
        found.into_iter().map(place).collect()
    }

    fn ball(
        &self,
        world: &mut World,
        state: &MatchState,
        standing: &[(Footprint, Pose)],
    ) -> Result<BallFile, String> {
        let mut ball = world.query_filtered::<(&Pose, &Twist), With<Ball>>();
        let (pose, twist) = ball.single(world).map_err(|_| "there is no ball")?;
        let footprint = Footprint::of_ball(&self.plan.ball);
        let is_free = |pose: Pose| {
            let apart = |(other, there): &(Footprint, Pose)| !footprint.overlaps(pose, other, *there);
            self.plan.pitch.holds(pose.position, 0.0) && standing.iter().all(apart)
        };
        let seen = Pose { position: state.home_attacks.turn(pose.position), heading: 0.0 };
        let place = nearest_free(seen, APART, is_free).unwrap_or(seen);
        let velocity = Bound::VELOCITY.clamp_vector(state.home_attacks.turn(twist.linear));
        Ok(BallFile { at: BallPlaces::One(rounded(place.position)), velocity: rounded(velocity) })
    }
}

/// What stands in each saved scenario for those who read it.
const DESCRIPTION: &str = "Not in it, since no scenario can say it: score and clock, bent trailers, what robots remember \
    and have agreed on, messages under way, changed weights, extra loss and delay. Robots that stood in each other are \
    moved apart. Say in `expect` what must hold.";

/// Millimetres are enough.
fn rounded(v: Vec2) -> Vec2 {
    (v * 1000.0).round() / 1000.0
}

fn ailments(id: RobotId, robot: &Robot) -> Vec<Event> {
    let health = robot.health;
    [(health.frozen, Event::Freeze(id)), (health.deaf, Event::Deaf(id)), (health.mute, Event::Mute(id))]
        .into_iter()
        .filter_map(|(ails, event)| ails.then_some(event))
        .collect()
}

/// To tenths.
fn degrees(heading: f32) -> f32 {
    (heading.to_degrees() * 10.0).round() / 10.0
}

fn differs(truth: Pose, believed: Pose) -> bool {
    let by = believed.position.distance(truth.position);
    by > ERROR.0 || wrap_angle(believed.heading - truth.heading).abs() > ERROR.1
}

fn radio_events(interference: &Interference) -> Vec<Event> {
    let jammed = interference.jammed.then_some(Event::Jam(true));
    let cut_off = interference.cut_off.iter().map(|robot| Event::CutOff(*robot));
    let parted = interference.partitions.iter().map(|parted| {
        Event::Partition(parted.one.iter().copied().collect(), parted.other.iter().copied().collect())
    });
    jammed.into_iter().chain(cut_off).chain(parted).collect()
}

fn side(plan: &TeamPlan, team: Team, robots: &[CapturedRobot]) -> Option<SideFile> {
    let players: Vec<PlayerFile> =
        robots.iter().filter(|robot| robot.id.team == team).map(|robot| robot.player.clone()).collect();
    let names = &plan.names;
    (!players.is_empty()).then(|| SideFile {
        strategy: Some(names.strategy.clone()),
        teamwork: names.teamwork.clone(),
        robot: Some(names.robot.clone()),
        sensing: Some(names.sensing.clone()),
        line_up: None,
        players: Some(players),
    })
}

/// For a person to replace: the ball stays in the hall.
fn in_the_hall(pitch: &Pitch) -> Expectation {
    let edge = pitch.half_size() + HALL;
    let zone = Area::Rectangle(Zone { min: -edge, max: edge });
    let what = Condition::InZone { what: Thing::Ball, zone };
    Expectation::Always { what, from: 0.0, until: None, because: "say here what must hold".into() }
}

#[cfg(test)]
mod tests {
    use super::super::{ScenarioPlan, ScenarioRef};
    use super::*;
    use crate::data::ron_options;
    use crate::game::requests::{BodyChange, RadioChange, Request, Requests, RobotChange};
    use crate::game::{Choice, Match};
    use crate::robot::RobotFailure;

    fn assets() -> AssetFolder {
        AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))
    }

    /// Writes the moment, reads it back and plays it.
    fn saved_and_played(game: &mut Match, plan: &MatchPlan, file: &str) -> ScenarioPlan {
        let moment = CapturedMoment { plan, game: file, pitch: None, script: &[], seconds: 3.0 };
        let scenario = moment.capture(game.world_mut()).expect("the ball is in play");
        let text = ron_options().to_string_pretty(&scenario, ron::ser::PrettyConfig::default()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("moment.ron");
        std::fs::write(&path, text).unwrap();
        let read =
            ScenarioPlan::read(&assets(), &ScenarioRef::from(path)).unwrap_or_else(|error| panic!("{error}"));
        let report = read.run(None);
        assert!(report.runs.iter().all(|run| run.verdict.passed()), "{report:?}");
        read
    }

    #[test]
    fn any_moment_of_play_is_a_scenario_that_can_be_checked_and_played() {
        for (file, radio) in [("friendly", "awful"), ("four_legged_2005", "good")] {
            let choice =
                Choice { file: Some(file.into()), radio: Some(radio.into()), seed: 7, ..Choice::default() };
            let plan = MatchPlan::read(&assets(), &choice).unwrap();
            let mut game = Match::new(&plan);
            let mut taken = 0;
            while taken < 3 {
                (0..200).for_each(|_| game.tick());
                if game.state().phase == Phase::Playing {
                    saved_and_played(&mut game, &plan, file);
                    taken += 1;
                }
            }
        }
    }

    #[test]
    fn a_saved_moment_has_places_roles_health_and_radio_as_they_are() {
        let plan = MatchPlan::read(&assets(), &Choice { seed: 3, ..Choice::default() }).unwrap();
        let mut game = Match::new(&plan);
        let [mute, lost] = [1, 2].map(|number| RobotId::new(Team::Home, number));
        let mut requests = game.world_mut().resource_mut::<Requests>();
        requests.ask(Request::Robot(mute, RobotChange::Fail(RobotFailure::Mute)));
        requests.ask(Request::Radio(RadioChange::CutOff(lost)));
        while game.state().phase != Phase::Playing {
            game.tick();
        }
        (0..300).for_each(|_| game.tick());
        let to = Pose::new(-2.0, -1.8, 0.5);
        game.world_mut()
            .resource_mut::<Requests>()
            .ask(Request::Body(BodyChange::Kidnap { robot: lost, to }));
        game.tick();
        let read = saved_and_played(&mut game, &plan, "friendly");
        let script: Vec<&Event> = read.scenario.script.iter().map(|event| &event.what).collect();
        let mut robots = game.world_mut().query::<(&RobotId, &Pose, &WorldModel)>();
        for (id, pose, model) in robots.iter(game.world()) {
            let player =
                read.scenario.players().find(|player| player.id == *id).expect("all are on the pitch");
            let believed = game.state().attacking(id.team).turn_pose(model.pose);
            let carried = script.iter().find_map(|event| match event {
                Event::Kidnap { robot, to, .. } if robot == id => Some(*to),
                _ => None,
            });
            // One that errs where there is no room begins where it is.
            assert!(
                carried.is_none() || player.pose.position.distance(believed.position) < APART + 0.01,
                "{id}: {:?}",
                player.pose
            );
            let truth = carried.unwrap_or(player.pose.position);
            let most = if carried.is_some() { 0.01 } else { APART };
            assert!(truth.distance(pose.position) < most, "{id} is at {truth}");
            assert!(
                *id != lost || truth.distance(player.pose.position) > 0.5,
                "it does not know where it is"
            );
        }
        assert!(script.contains(&&Event::Mute(mute)) && script.contains(&&Event::CutOff(lost)), "{script:?}");
        let mut waiting = Match::new(&plan);
        let moment = CapturedMoment { plan: &plan, game: "friendly", pitch: None, script: &[], seconds: 3.0 };
        let refused = moment.capture(waiting.world_mut()).unwrap_err();
        assert!(refused.contains("wait until it is"), "{refused}");
    }
}
