//! What must not matter to what a team arranges: which side it is on, which of its robots has which number, and a robot far away that
//! neither hears nor says anything.

use std::collections::BTreeMap;
use std::path::PathBuf;

use touchline::comms::radio::RadioRecord;
use touchline::data::AssetTexts;
use touchline::game::Match;
use touchline::ids::{RobotId, Team};
use touchline::lab::scenario::{ScenarioPlan, ScenarioRef};
use touchline::strategy::Role;

use crate::support::assets;

/// The robots of a team: where the one stands that is called so in the first place, and its role.
const PLAYERS: [(f32, f32, &str); 4] =
    [(-4.1, 0.0, "goalie"), (-1.0, 0.3, "halfback"), (-2.0, -1.5, "floater"), (-0.7, 1.7, "forward")];

/// Who asks for a swap when, and which roles change.
const SWAPS: [(f32, usize, &str); 2] = [
    (1.0, 1, r#"("halfback", "forward"), ("forward", "floater"), ("floater", "halfback")"#),
    (4.0, 3, r#"("floater", "forward"), ("forward", "floater")"#),
];

/// A team that swaps roles twice.
struct Setting {
    team: Team,
    /// The number of each of [`PLAYERS`].
    numbers: [u8; 4],
    /// What else is on the pitch and happens.
    other_side: &'static str,
    script: &'static str,
}

impl Default for Setting {
    fn default() -> Setting {
        Setting { team: Team::Home, numbers: [0, 1, 2, 3], other_side: "", script: "" }
    }
}

/// What came of it: how many messages of each kind each of [`PLAYERS`] sent to each other one, and the role of each at the end.
#[derive(Debug, PartialEq)]
struct Outcome {
    steps: BTreeMap<(String, usize, usize), usize>,
    roles: Vec<usize>,
}

impl Setting {
    fn text(&self) -> String {
        let (sign, facing) = if self.team == Team::Home { (1.0, 0) } else { (-1.0, 180) };
        let players = PLAYERS.iter().zip(self.numbers).map(|((x, y, role), number)| {
            let (x, y) = (x * sign, y * sign);
            format!(r#"(number: {number}, at: ({x:?}, {y:?}), facing: {facing}, role: "{role}")"#)
        });
        let swaps = SWAPS.iter().map(|(at, who, roles)| {
            let robot = RobotId::new(self.team, self.numbers[*who]);
            format!(r#"(at: {at:?}, what: InitiateSwap(robot: "{robot}", roles: [{roles}]))"#)
        });
        let team = if self.team == Team::Home { "Home" } else { "Away" };
        let side = if self.team == Team::Home { "home" } else { "away" };
        let players = players.collect::<Vec<_>>().join(", ");
        let swaps = swaps.collect::<Vec<_>>().join(", ");
        let Setting { other_side, script, .. } = self;
        format!(
            r#"(name: "two swaps", source: "a test", seconds: 8, ball: (at: (0.0, 0.0)),
            {side}: (strategy: "hammerheads_swap", sensing: "cye_2001", players: [{players}]),
            {other_side}
            script: [{swaps}, {script}],
            expect: [Finally(what: Unlocked({team}))])"#
        )
    }

    fn play(&self, seed: u64) -> Outcome {
        let path = PathBuf::from("setting.ron");
        let assets = assets().with_texts(AssetTexts::from([(path.clone(), self.text())]));
        let scenario = ScenarioPlan::read(&assets, &ScenarioRef::from(path));
        let scenario = scenario.unwrap_or_else(|error| panic!("{error}\n{}", self.text()));
        let mut game = Match::new(&scenario.with_seed(seed));
        for _ in 0..8 * 60 {
            game.tick();
        }
        let place = |robot: RobotId| self.numbers.iter().position(|number| *number == robot.number);
        let mut steps = BTreeMap::new();
        for transmission in game.world().resource::<RadioRecord>().transmissions() {
            let packet = &transmission.packet;
            let is_step = packet.message().is_some_and(|message| message.is_step());
            if let (true, Some(from), Some(to)) = (is_step, place(packet.from), place(packet.to)) {
                *steps.entry((packet.kind.to_string(), from, to)).or_insert(0) += 1;
            }
        }
        let world = game.world_mut();
        let mut robots = world.query::<(&RobotId, &Role)>();
        let mut roles: Vec<(Option<usize>, usize)> = robots
            .iter(world)
            .filter(|(id, _)| id.team == self.team)
            .map(|(id, role)| (place(*id), role.0))
            .collect();
        roles.sort_unstable();
        Outcome { steps, roles: roles.into_iter().map(|(_, role)| role).collect() }
    }
}

#[track_caller]
fn assert_same(setting: &Setting) {
    for seed in [1, 2] {
        let usual = Setting::default().play(seed);
        assert!(usual.steps.len() >= 12, "both swaps happen: {usual:?}");
        assert_eq!(setting.play(seed), usual, "seed {seed}");
    }
}

#[test]
fn a_team_arranges_the_same_on_the_other_side() {
    assert_same(&Setting {
        team: Team::Away,
        // A scenario has a home team.
        other_side: r#"home: (strategy: "hammerheads_swap", players: [(number: 3, at: (-4.0, 2.0), off: true)]),"#,
        ..Setting::default()
    });
}

#[test]
fn a_team_arranges_the_same_if_its_robots_change_numbers() {
    assert_same(&Setting { numbers: [2, 0, 3, 1], ..Setting::default() });
    assert_same(&Setting { numbers: [0, 3, 1, 2], ..Setting::default() });
}

#[test]
fn a_robot_far_away_that_is_off_changes_nothing() {
    assert_same(&Setting {
        other_side: r#"away: (strategy: "hammerheads_swap", players: [(number: 3, at: (4.0, -2.0), facing: 180, off: true)]),"#,
        ..Setting::default()
    });
}

#[test]
fn a_robot_far_away_that_neither_hears_nor_speaks_nor_moves_changes_nothing() {
    assert_same(&Setting {
        other_side: r#"away: (strategy: "hammerheads_swap", players: [(number: 1, at: (4.0, 2.0), facing: 0)]),"#,
        script: r#"(at: 0, what: Freeze("away 1")), (at: 0, what: Deaf("away 1")), (at: 0, what: Mute("away 1")),"#,
        ..Setting::default()
    });
}
