//! A table-top match by the rules of the four-legged league.

use bevy::prelude::Vec2;

use super::table::Table;
use crate::ids::{RobotId, Team};
use crate::pitch::Pitch;
use crate::world::referee::decision::Decision;
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{KickOffStyle, RuleBook};
use crate::world::referee::state::MatchState;

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
