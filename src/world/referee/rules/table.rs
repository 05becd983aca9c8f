//! A table-top match for the tests: ball and robots are points that obey the referee and stand still otherwise.

use bevy::prelude::Vec2;

use super::referee;
use crate::ids::{RobotId, Team};
use crate::pitch::{Goal, PenaltyArea, Pitch, Walls};
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{KickOffStyle, RuleBook};
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::MatchState;

/// Seconds from the placing of the robots to play, with the default book.
pub const KICK_OFF_SECONDS: f64 = 4.0;

pub const BALL_RADIUS: f32 = 0.11;

pub struct Table {
    pub pitch: Pitch,
    pub book: RuleBook,
    pub state: MatchState,
    pub ball: Vec2,
    pub robots: Vec<(RobotId, Vec2)>,
    pub touching: Vec<RobotId>,
    pub held_by: Option<RobotId>,
    pub contacts: Vec<(RobotId, RobotId)>,
    pub shoving: Vec<(RobotId, RobotId)>,
    pub still: Vec<RobotId>,
    pub ball_radius: f32,
    /// Whether ball and robots go where the referee puts them.
    pub obeys: bool,
    pub log: Vec<(f64, Decision)>,
    pub time: f64,
    pub(super) hertz: u32,
}

/// A 9 m × 5 m pitch with nine spots.
pub fn pitch() -> Pitch {
    let spots = [-2.5, 0.0, 2.5].into_iter().flat_map(|x| [-1.25, 0.0, 1.25].map(|y| Vec2::new(x, y)));
    Pitch {
        name: "Table".into(),
        length: 9.0,
        width: 5.0,
        goal: Goal { width: 2.0, depth: 0.4 },
        penalty_area: PenaltyArea { depth: 1.0, width: 3.0 },
        centre_circle_radius: 0.5,
        penalty_spots: spots.collect(),
        beacons: Vec::new(),
        walls: Walls { thickness: 0.5, friction: 0.2, restitution: 0.6, margin: 0.0 },
    }
}

/// Four robots a team, out of the way: 1.6 m and more from the goal lines and off the spots.
pub fn line_up() -> Vec<(RobotId, Vec2)> {
    let home = (0..4_u8).map(|n| (RobotId::new(Team::Home, n), Vec2::new(-1.0, 0.6 * f32::from(n) - 0.9)));
    let away = (0..4_u8).map(|n| (RobotId::new(Team::Away, n), Vec2::new(1.0, 0.6 * f32::from(n) - 0.9)));
    home.chain(away).collect()
}

impl Table {
    /// A match with home's kick-off that has not begun.
    pub fn new(hertz: u32) -> Table {
        let book = RuleBook::default();
        let state = MatchState::new(Team::Home, &book);
        Table {
            pitch: pitch(),
            book,
            state,
            ball: Vec2::ZERO,
            robots: line_up(),
            touching: Vec::new(),
            held_by: None,
            contacts: Vec::new(),
            shoving: Vec::new(),
            still: Vec::new(),
            ball_radius: BALL_RADIUS,
            obeys: true,
            log: Vec::new(),
            time: 0.0,
            hertz,
        }
    }

    /// A match that has just begun.
    pub fn playing(hertz: u32) -> Table {
        let mut table = Table::new(hertz);
        table.run(KICK_OFF_SECONDS);
        table.log.clear();
        table
    }

    /// Begins again with the present book.
    pub fn restart(&mut self, kick_off: Team) {
        self.state = MatchState::new(kick_off, &self.book);
    }

    /// One look of the referee after `dt` seconds.
    pub fn look(&mut self, dt: f64) {
        self.time += dt;
        let laws = Laws { pitch: &self.pitch, book: &self.book, ball_radius: self.ball_radius };
        let observation = Observation {
            ball: self.ball,
            robots: &self.robots,
            touching: &self.touching,
            held_by: self.held_by,
            contacts: &self.contacts,
            shoving: &self.shoving,
            still: &self.still,
        };
        let mut decisions = Vec::new();
        referee(&laws, &observation, dt, &mut self.state, &mut decisions);
        for decision in decisions {
            self.log.push((self.time, decision));
            if self.obeys {
                self.obey(decision);
            }
        }
    }

    fn obey(&mut self, decision: Decision) {
        match decision {
            Decision::BallPlaced { at, .. } => self.ball = at,
            Decision::RobotsPlaced { .. } => {
                let is_four_legged = self.pitch.margin() > 0.0;
                let places = if is_four_legged { four_legged_line_up() } else { line_up() };
                let place = |robot| places.iter().find(|(other, _)| *other == robot).expect("it lines up").1;
                self.robots.iter_mut().for_each(|(robot, at)| *at = place(*robot));
            }
            Decision::RobotRemoved { robot, .. } => self.take_off(robot),
            Decision::RobotReturned { robot, at } | Decision::RobotPlaced { robot, at } => {
                self.put(robot, at.position)
            }
            _ => {}
        }
    }

    /// Looks at a table on which nothing moves by itself, for some seconds, rounded to whole samples.
    pub fn run(&mut self, seconds: f64) {
        let hertz = f64::from(self.hertz);
        for _ in 0..(seconds * hertz).round() as u32 {
            self.look(1.0 / hertz);
        }
    }

    /// Lets the ball roll between two places in the north, so that it makes progress.
    pub fn roll_about_in_the_north(&mut self, seconds: f64) {
        for half_second in 0..(2.0 * seconds).round() as u32 {
            self.ball = Vec2::new(if half_second % 2 == 0 { -1.0 } else { 1.0 }, 2.0);
            self.run(0.5);
        }
    }

    /// Rolls the ball over the eastern goal line within two samples.
    pub fn shoot_east(&mut self) {
        self.shoot(1.0);
    }

    /// Rolls the ball over the western goal line within two samples.
    pub fn shoot_west(&mut self) {
        self.shoot(-1.0);
    }

    fn shoot(&mut self, side: f32) {
        let line = self.pitch.length / 2.0;
        for beyond in [-0.1, 0.2] {
            self.ball = Vec2::new(side * (line + beyond), 0.2);
            self.look(1.0 / f64::from(self.hertz));
        }
    }

    /// Puts a robot somewhere, also one that was off the field.
    pub fn put(&mut self, robot: RobotId, at: Vec2) {
        self.take_off(robot);
        let place = self.robots.partition_point(|(other, _)| *other < robot);
        self.robots.insert(place, (robot, at));
    }

    pub fn take_off(&mut self, robot: RobotId) {
        self.robots.retain(|(other, _)| *other != robot);
    }

    pub fn place(&self, robot: RobotId) -> Vec2 {
        self.robots.iter().find(|(other, _)| *other == robot).expect("it is on the field").1
    }

    /// The robots that were taken off for a reason.
    pub fn removals(&self, why: RemovalReason) -> Vec<RobotId> {
        let removed = |decision| match decision {
            Decision::RobotRemoved { robot, reason } if reason == why => Some(robot),
            _ => None,
        };
        self.decisions().into_iter().filter_map(removed).collect()
    }

    pub fn decisions(&self) -> Vec<Decision> {
        self.log.iter().map(|(_, decision)| *decision).collect()
    }

    /// When decisions of a kind were made, in seconds.
    pub fn times(&self, kind: impl Fn(&Decision) -> bool) -> Vec<f64> {
        self.log.iter().filter(|(_, decision)| kind(decision)).map(|(time, _)| *time).collect()
    }
}

/// The field of the four-legged league.
pub fn four_legged_pitch() -> Pitch {
    let text = include_str!("../../../../assets/pitches/four_legged_2005.ron");
    ron::from_str(text).expect("the file is a pitch")
}

/// The rules of the four-legged league, as a match file gives them.
const FOUR_LEGGED: &str = "(
    kick_off: Walked,
    ready_seconds: 30.0,
    goal_from_kick_off: false,
    mercy: 10,
    out: ThrowIn(),
    stuck: LocalGlobal(),
    defenders: KeeperOnly,
    ball_holding: (),
    pushing: (),
    leaving: 0.3,
    removal_outlasts_play: false,
    returns: HalfWayLine,
    spot_clearance: 0.2,
)";

pub fn four_legged_book() -> RuleBook {
    read_book(FOUR_LEGGED).expect("the book is sound")
}

/// A rule book out of RON, read as Touchline reads its files.
pub fn read_book(text: &str) -> Result<RuleBook, ron::error::SpannedError> {
    use ron::extensions::Extensions;
    let newtypes = Extensions::UNWRAP_NEWTYPES | Extensions::UNWRAP_VARIANT_NEWTYPES;
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME | newtypes);
    options.from_str(text)
}

/// Four robots a team, legally placed for a four-legged kick-off by home and off the places where robots return.
pub fn four_legged_line_up() -> Vec<(RobotId, Vec2)> {
    let own = [Vec2::new(-2.4, 0.0), Vec2::new(-1.8, 0.9), Vec2::new(-1.8, -0.9), Vec2::new(-1.5, 0.0)];
    let of = |team, end: f32| (0..4_u8).zip(own).map(move |(n, at)| (RobotId::new(team, n), at * end));
    of(Team::Home, 1.0).chain(of(Team::Away, -1.0)).collect()
}

impl Table {
    /// A four-legged match with home's kick-off that has not begun.
    pub fn four_legged(hertz: u32) -> Table {
        let book = four_legged_book();
        let state = MatchState::new(Team::Home, &book);
        let (pitch, robots) = (four_legged_pitch(), four_legged_line_up());
        Table { pitch, robots, book, state, ball_radius: 0.045, ..Table::new(hertz) }
    }

    /// A four-legged match that has just begun, in which all stand on their places and did not walk there.
    pub fn four_legged_playing(hertz: u32) -> Table {
        let mut table = Table::four_legged(hertz);
        table.book.kick_off = KickOffStyle::Carried;
        table.run(table.kick_off_seconds());
        assert_eq!(table.state.phase, Phase::Playing);
        table.book.kick_off = KickOffStyle::Walked;
        table.log.clear();
        table
    }

    /// Seconds from the placing of the robots to play.
    pub fn kick_off_seconds(&self) -> f64 {
        f64::from(self.book.ready_seconds + self.book.set_seconds)
    }

    /// Goes through another kick-off by the same team, after which goals count at once and ball and robots are where they
    /// are now.
    pub fn restart_in_play(&mut self) {
        let (obeyed, style) = (self.obeys, self.book.kick_off);
        let shot = std::mem::replace(&mut self.book.goal_from_kick_off, true);
        self.obeys = false;
        self.book.kick_off = KickOffStyle::Carried;
        self.state.phase = Phase::Initial;
        self.run(self.kick_off_seconds() + 1.0 / f64::from(self.hertz));
        assert_eq!(self.state.phase, Phase::Playing);
        (self.obeys, self.book.kick_off, self.book.goal_from_kick_off) = (obeyed, style, shot);
    }

    /// A four-legged match in which the robots have just walked to legal places, two seconds after its beginning.
    pub fn walked(hertz: u32) -> Table {
        let mut table = Table::four_legged(hertz);
        table.run(2.0);
        table.robots = four_legged_line_up();
        table.log.clear();
        table
    }

    pub fn all_stand_still(&mut self) {
        self.still = self.robots.iter().map(|(robot, _)| *robot).collect();
    }

    /// The robots that people put somewhere.
    pub fn placed_by_hand(&self) -> Vec<RobotId> {
        let placed = |decision| match decision {
            Decision::RobotPlaced { robot, .. } => Some(robot),
            _ => None,
        };
        self.decisions().into_iter().filter_map(placed).collect()
    }
}
