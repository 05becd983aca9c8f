//! A scenario as it is written: the serde types of `assets/scenarios/*.ron`, not yet checked.

use std::collections::BTreeMap;

use bevy::prelude::Vec2;
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};

use super::condition::Expectation;
use super::event::{Dependency, TimedEvent};
use crate::comms::radio::FaultRule;
use crate::data::{DataError, Field, Source, ron_options};
use crate::game::TeamFile;
use crate::strategy::teamwork::TeamworkFile;

/// A whole scenario file, or what one of its variants says. Points and velocities are in the pitch frame, which is home's team
/// frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ScenarioFile {
    /// What the scenario shows, as a sentence; needed.
    pub name: Option<String>,
    /// Where the claim comes from, such as "Hammerheads 2001, section VI-B"; needed.
    pub source: Option<String>,
    /// More about it, for people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// The match whose pitch, ball and rules it has, by its file's name; `friendly` if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub game: Option<String>,
    /// Another pitch than that match's, by its file's name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch: Option<String>,
    /// A radio, by its file's name; `perfect` if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radio: Option<String>,
    /// The seeds that it is played with; ten if not given. With a [`Expectation::Probability`], as many of them as decide it; 500 at the
    /// most if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seeds: Option<Seeds>,
    /// With how many of the seeds it may fail, at each place of the ball; none if not given. Not with a [`Expectation::Probability`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub may_fail: Option<u16>,
    /// How long it takes; needed.
    pub seconds: Option<f32>,
    /// Whether the rules of a match are enforced; they are not if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub referee: Option<Referee>,
    /// The home team; needed.
    pub home: Option<SideFile>,
    /// The away team; nobody if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub away: Option<SideFile>,
    /// Where the ball starts; needed.
    pub ball: Option<BallFile>,
    /// What the radio does to which packets.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<FaultRule>,
    /// What happens when.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub script: Vec<TimedEvent>,
    /// What must hold.
    pub expect: Vec<Expectation>,
    /// What the scenario is about: without it, it must fail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depends_on: Option<Dependency>,
    /// Scenarios of which each is this file with changes: `faults`, `script` and `expect` are added to the file's own, sides are
    /// filled field by field, and anything else takes the place of what the file says. A file with variants is played as
    /// each of them, and not by itself.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub variants: BTreeMap<String, ScenarioFile>,
}

impl ScenarioFile {
    /// What is played: the file itself or each of its variants, with its name.
    pub fn scenarios(&self) -> Vec<(Option<&str>, ScenarioFile)> {
        if self.variants.is_empty() {
            return vec![(None, self.clone())];
        }
        let variants = self.variants.iter();
        variants.map(|(name, variant)| (Some(name.as_str()), variant.clone().over(self.clone()))).collect()
    }

    /// As the text of a file.
    ///
    /// # Errors
    /// If a number of it cannot be written.
    pub fn text(&self) -> Result<String, ron::Error> {
        ron_options().to_string_pretty(self, PrettyConfig::default().depth_limit(3))
    }

    /// The text that tells where the fields of a variant of this file stand in it.
    pub(super) fn source_of(&self, source: &Source, variant: Option<&str>) -> Source {
        let Some(name) = variant else { return source.clone() };
        let lists =
            [("faults", self.faults.len()), ("script", self.script.len()), ("expect", self.expect.len())];
        source.overlaid(Field::root().key("variants").key(name), lists.into())
    }

    fn over(self, base: ScenarioFile) -> ScenarioFile {
        ScenarioFile {
            name: self.name.or(base.name),
            source: self.source.or(base.source),
            description: self.description.or(base.description),
            game: self.game.or(base.game),
            pitch: self.pitch.or(base.pitch),
            radio: self.radio.or(base.radio),
            seeds: self.seeds.or(base.seeds),
            may_fail: self.may_fail.or(base.may_fail),
            seconds: self.seconds.or(base.seconds),
            referee: self.referee.or(base.referee),
            home: SideFile::over(self.home, base.home),
            away: SideFile::over(self.away, base.away),
            ball: self.ball.or(base.ball),
            faults: [base.faults, self.faults].concat(),
            script: [base.script, self.script].concat(),
            expect: [base.expect, self.expect].concat(),
            depends_on: self.depends_on.or(base.depends_on),
            variants: self.variants,
        }
    }
}

/// Whether a value need not be written.
fn is_usual<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// The seeds that a scenario is played with: `10` for 1 to 10, or a list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number of seeds or a list of seeds")]
pub enum Seeds {
    /// The seeds 1 to this one.
    Count(u16),
    /// Exactly these.
    List(Vec<u64>),
}

impl Default for Seeds {
    fn default() -> Seeds {
        Seeds::Count(10)
    }
}

impl Seeds {
    /// The seeds one by one.
    pub fn to_vec(&self) -> Vec<u64> {
        match self {
            Seeds::Count(count) => (1..=u64::from(*count)).collect(),
            Seeds::List(seeds) => seeds.clone(),
        }
    }
}

/// Who enforces the rules.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Referee {
    /// The ball is in play from the first tick on, and nobody whistles.
    #[default]
    Nobody,
    /// All rules of a match.
    Whole,
}

/// One side of a scenario: names of files, and the robots that take part.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SideFile {
    /// The strategy's file; needed.
    pub strategy: Option<String>,
    /// What differs from the strategy's own `teamwork`, field by field.
    #[serde(skip_serializing_if = "is_usual")]
    pub teamwork: TeamworkFile,
    /// The file of the robots' kind; `cye` if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot: Option<String>,
    /// The file of the robots' senses; `perfect` if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensing: Option<String>,
    /// All of the strategy's players, at the places of one of its line-ups; those for its own kick-off if neither this nor
    /// `players` is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line_up: Option<String>,
    /// The robots that take part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub players: Option<Vec<PlayerFile>>,
}

impl SideFile {
    fn over(own: Option<SideFile>, base: Option<SideFile>) -> Option<SideFile> {
        let (Some(own), Some(base)) = (&own, &base) else { return own.or(base) };
        let (own, base) = (own.clone(), base.clone());
        let placed = if own.line_up.is_some() || own.players.is_some() { &own } else { &base };
        Some(SideFile {
            line_up: placed.line_up.clone(),
            players: placed.players.clone(),
            teamwork: own.teamwork.over(base.teamwork),
            strategy: own.strategy.or(base.strategy),
            robot: own.robot.or(base.robot),
            sensing: own.sensing.or(base.sensing),
        })
    }

    /// The files that it names.
    ///
    /// # Errors
    /// If there is no strategy among them; the side stands at `at`.
    pub(super) fn files(&self, source: &Source, at: &Field) -> Result<TeamFile, DataError> {
        Ok(TeamFile {
            strategy: source.required(&self.strategy, at, "strategy")?,
            teamwork: self.teamwork.clone(),
            robot: self.robot.clone().unwrap_or_else(|| "cye".into()),
            sensing: self.sensing.clone().unwrap_or_else(|| "perfect".into()),
            sensing_of: BTreeMap::new(),
            team_number: None,
        })
    }
}

/// A robot that takes part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlayerFile {
    /// Its number in the team, from 0.
    pub number: u8,
    /// Where it starts, m.
    pub at: Vec2,
    /// Degrees, counter-clockwise from east.
    #[serde(default)]
    pub facing: f32,
    /// The strategy's role for that number if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub role: Option<String>,
    /// Stands on the pitch switched off.
    #[serde(default, skip_serializing_if = "is_usual")]
    pub off: bool,
}

impl PlayerFile {
    /// Looks to the east.
    pub(super) fn at(number: u8, at: Vec2) -> PlayerFile {
        PlayerFile { number, at, facing: 0.0, role: None, off: false }
    }
}

/// Where the ball starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BallFile {
    /// Its places, m.
    pub at: BallPlaces,
    /// m/s
    #[serde(default)]
    pub velocity: Vec2,
}

/// One place, or the crossings of a grid: the scenario is played at each of them, with each of its seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a place, such as (1, 2), or a grid, such as (x: [0, 1], y: [-2, 2])")]
pub enum BallPlaces {
    /// One place.
    One(Vec2),
    /// Every x with every y.
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    Grid { x: Vec<f32>, y: Vec<f32> },
}

impl BallPlaces {
    /// The number of places.
    pub fn count(&self) -> usize {
        match self {
            BallPlaces::One(_) => 1,
            BallPlaces::Grid { x, y } => x.len().saturating_mul(y.len()),
        }
    }

    /// Column by column from the grid's first x.
    pub fn to_vec(&self) -> Vec<Vec2> {
        match self {
            BallPlaces::One(place) => vec![*place],
            BallPlaces::Grid { x, y } => x.iter().flat_map(|x| y.iter().map(|y| Vec2::new(*x, *y))).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::stage::{EXAMPLE, example};
    use super::super::{Area, Condition, Event, Expectation, Packets, Thing};
    use super::*;
    use crate::comms::tcm::DataType;
    use crate::geometry::Zone;
    use crate::ids::{RobotId, Team};
    use crate::robot::Restart;

    fn home(number: u8) -> RobotId {
        RobotId::new(Team::Home, number)
    }

    fn parsed<T: serde::de::DeserializeOwned>(text: &str) -> T {
        Source::new("x.ron", text).parse().unwrap()
    }

    fn trouble(text: &str) -> String {
        Source::new("x.ron", text).parse::<ScenarioFile>().unwrap_err().to_string()
    }

    #[test]
    fn what_is_left_out_takes_its_usual_value() {
        let text = r#"(name: "a", source: "b", seconds: 3, ball: (at: (0, 0)), expect: [],
            home: (strategy: "s", players: [(number: 1, at: (1, 2))]))"#;
        let file: ScenarioFile = parsed(text);
        let home = file.home.unwrap();
        let files = home.files(&Source::new("x.ron", text), &Field::root().key("home")).unwrap();
        assert_eq!((files.robot.as_str(), files.sensing.as_str()), ("cye", "perfect"));
        assert_eq!(file.seeds.unwrap_or_default().to_vec(), (1..=10).collect::<Vec<_>>());
        assert_eq!((file.referee.unwrap_or_default(), file.depends_on), (Referee::Nobody, None));
        let at = Vec2::new(1.0, 2.0);
        assert_eq!(home.players, Some(vec![PlayerFile::at(1, at)]));
        assert_eq!(file.ball.unwrap().velocity, Vec2::ZERO);
    }

    #[test]
    fn seeds_are_a_number_or_a_list() {
        assert_eq!(parsed::<Seeds>("3").to_vec(), [1, 2, 3]);
        assert_eq!(parsed::<Seeds>("[7, 11]").to_vec(), [7, 11]);
        let text = EXAMPLE.replace("seeds: 3", "seeds: -3");
        assert!(trouble(&text).ends_with("seeds: expected a number of seeds or a list of seeds"));
    }

    #[test]
    fn the_ball_is_at_one_place_or_at_the_crossings_of_a_grid() {
        assert_eq!(parsed::<BallPlaces>("(1, -2)").to_vec(), [Vec2::new(1.0, -2.0)]);
        let grid = parsed::<BallPlaces>("(x: [0, 1.5], y: [-2, 2])").to_vec();
        let crossings = [(0.0, -2.0), (0.0, 2.0), (1.5, -2.0), (1.5, 2.0)];
        assert_eq!(grid, crossings.map(|(x, y)| Vec2::new(x, y)));
        let error = trouble(&EXAMPLE.replace("at: (-1.5, 0.5)", "at: (x: [0])"));
        assert!(error.contains("ball.at: expected a place, such as (1, 2), or a grid"), "{error}");
    }

    #[test]
    fn events_name_robots_as_people_do() {
        assert_eq!(parsed::<Event>(r#"Crash("home 1")"#), Event::Crash(home(1)));
        let partition = Event::Partition(vec![home(0)], vec![home(1), RobotId::new(Team::Away, 2)]);
        assert_eq!(parsed::<Event>(r#"Partition(["home 0"], ["home 1", "away:2"])"#), partition);
        let revival = Event::Revive { robot: home(1), memory: Restart::Lost };
        assert_eq!(parsed::<Event>(r#"Revive(robot: "home 1", memory: Lost)"#), revival);
        let ball = Event::Ball { at: Vec2::new(1.0, 0.0), velocity: Vec2::ZERO };
        assert_eq!(parsed::<Event>("Ball(at: (1, 0))"), ball);
    }

    #[test]
    fn conditions_are_written_without_superfluous_brackets() {
        let text =
            r#"Not(For(seconds: 2, what: Distance(from: Robot("home 1"), to: At(1, -2), below: 0.5)))"#;
        let (from, to) = (Thing::Robot(home(1)), Thing::At(1.0, -2.0));
        let what = Box::new(Condition::Distance { from, to, below: Some(0.5), above: None });
        let condition = Condition::Not(Box::new(Condition::For { seconds: 2.0, what }));
        assert_eq!(parsed::<Condition>(text), condition);

        let zone = Area::Rectangle(Zone { min: Vec2::ZERO, max: Vec2::ONE });
        let condition = Condition::InZone { what: Thing::Ball, zone };
        assert_eq!(
            parsed::<Condition>("InZone(what: Ball, zone: Rectangle(min: (0, 0), max: (1, 1)))"),
            condition
        );

        let packets =
            Packets { kind: DataType::LOCK, from: Some(home(1)), to: None, at_least: 1, since: 0.0 };
        assert_eq!(parsed::<Condition>(r#"Sent(kind: Lock, from: "home 1")"#), Condition::Sent(packets));

        let roles = [(0, "goalie".to_owned()), (2, "forward".to_owned())].into();
        let condition = Condition::RolesAre(Team::Home, roles);
        assert_eq!(parsed::<Condition>(r#"RolesAre(Home, {0: "goalie", 2: "forward"})"#), condition);
    }

    #[test]
    fn what_is_no_robot_is_reported_where_it_stands() {
        let text = EXAMPLE.replace(r#"Crash("home 1")"#, r#"Crash("guest 1")"#);
        let error = trouble(&text);
        assert!(error.starts_with("x.ron:17:"), "{error}");
        assert!(error.contains("script[0].what.Crash: `guest 1` is no robot"), "{error}");
        let text = EXAMPLE.replace("within: 5", "within: 5, unless: 3");
        assert!(trouble(&text).contains("there is no field `unless`; known: what, within"));
    }

    #[test]
    fn a_scenario_that_is_written_reads_back() {
        let file = example();
        let text = ron_options().to_string_pretty(&file, ron::ser::PrettyConfig::default()).unwrap();
        assert_eq!(parsed::<ScenarioFile>(&text), file);
        assert!(matches!(&file.expect[0], Expectation::Eventually { within, .. } if *within == 5.0));
    }
}
