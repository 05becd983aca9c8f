//! What must hold of every match is looked at in every match, and what breaks it is found.

use touchline::data::AssetFolder;
use touchline::game::record::{Invariant, Invariants};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::ids::Team;
use touchline::lab::scenario::{RunWatcher, ScenarioPlan, ScenarioRef};

use crate::support::assets;

/// What the runs of a scenario have broken.
#[derive(Default)]
struct Broken {
    runs: Vec<Invariants>,
}

impl RunWatcher for Broken {
    fn begin(&mut self, _: (bevy::prelude::Vec2, u64), game: &mut Match) {
        self.runs.push(game.world().resource::<Invariants>().clone());
    }

    fn after_tick(&mut self, game: &mut Match) {
        if let Some(last) = self.runs.last_mut() {
            last.clone_from(game.world().resource::<Invariants>());
        }
    }
}

/// In how many of its runs a variant of a scenario breaks an invariant of home, and in how many there are.
fn broken_by(name: &str, variant: &str, invariant: Invariant) -> (usize, usize) {
    let assets = assets();
    let plans = ScenarioPlan::read_all(&assets, &ScenarioRef::named(&assets, name)).expect("it is sound");
    let plan = plans.iter().find(|plan| plan.origin.variant.as_deref() == Some(variant));
    let mut broken = Broken::default();
    plan.expect("it has the variant").run_watched(None, &mut broken);
    let is_broken = |run: &&Invariants| run.broken.contains_key(&(invariant, Some(Team::Home)));
    (broken.runs.iter().filter(is_broken).count(), broken.runs.len())
}

#[test]
fn the_papers_swap_breaks_where_two_messages_are_lost_and_the_hardened_one_does_not() {
    let name = "counterexample_03_two_generals_two_losses";
    let (broken, runs) = broken_by(name, "paper", Invariant::OneRobotARole);
    assert_eq!(broken, runs, "a role is doubled for good");
    assert_eq!(broken_by(name, "hardened", Invariant::OneRobotARole).0, 0);
}

fn played(assets: &AssetFolder, choice: Choice) -> Invariants {
    let plan = MatchPlan::read(assets, &choice).expect("the match is sound");
    let mut game = Match::new(&plan);
    while !game.is_over() {
        game.tick();
    }
    game.world().resource::<Invariants>().clone()
}

#[test]
fn several_robots_drive_at_a_booked_ball_for_longer_where_nobody_hears_of_a_booking() {
    let seconds = |radio: &str| {
        let choice = Choice {
            file: Some("four_legged_2005".into()),
            radio: Some(radio.into()),
            half_minutes: Some(1.0),
            ..Choice::default()
        };
        let invariants = played(&assets(), choice);
        assert!(!invariants.is_unsafe(), "{:?}", invariants.breaches);
        let count = invariants.broken.get(&(Invariant::OneAtBookedBall, Some(Team::Home)));
        count.map_or(0.0, |count| count.seconds)
    };
    let (heard, unheard) = (seconds("perfect"), seconds("dead"));
    assert!(unheard > 5.0 + heard, "{unheard} s without a radio, {heard} s with one");
}

#[test]
fn whatever_radio_and_strategy_what_is_safe_stays_safe() {
    for (home, away, radio) in [
        ("hammerheads_swap", "hammerheads_swap_paper", "awful"),
        ("art", "cs_freiburg", "bursty"),
        ("italian_golem", "rmit", "awful"),
    ] {
        let choice = Choice {
            home: Some(home.into()),
            away: Some(away.into()),
            radio: Some(radio.into()),
            half_minutes: Some(1.0),
            ..Choice::default()
        };
        let invariants = played(&assets(), choice);
        assert!(!invariants.is_unsafe(), "{home} against {away}: {:?}", invariants.breaches);
    }
}
