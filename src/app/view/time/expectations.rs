//! The state of a scenario's expectations while it is played: its judge looks at each tick and changes nothing.

use bevy::prelude::*;

use crate::app::view::state::{AfterTick, Announcement, Playback};
use crate::clock::Clock;
use crate::lab::rewind::GoesBack;
use crate::lab::scenario::{Judge, Scenario, observe};

pub(super) fn plugin(app: &mut App) {
    app.goes_back::<Expectations>();
    app.add_systems(AfterTick, look).add_systems(Last, tell_whoever_started_us);
}

/// The code with which the app ends when its scenario has failed. Bevy ends with 1 when something of its own fails.
pub const FAILED: u8 = 10;

/// The judge of the scenario that is played; none in a match.
#[derive(Resource, Clone, Debug, Default)]
pub struct Expectations {
    judge: Option<Judge>,
    /// The tick after which the scenario is over.
    end: u64,
}

/// How an expectation stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExpectationStatus {
    /// It may still be met, or fail.
    Pending,
    /// It was met.
    Met,
    /// It failed.
    Failed,
}

impl Expectations {
    /// Those of a scenario, none without one.
    pub fn of(scenario: Option<&Scenario>, dt: f32) -> Expectations {
        Expectations {
            judge: scenario.map(|scenario| Judge::new(scenario, scenario.first_place(), dt)),
            end: scenario.map_or(0, |scenario| scenario.ticks(dt)),
        }
    }

    /// The tick after which the scenario is over; none in a match.
    pub fn end(&self) -> Option<u64> {
        self.judge.as_ref().map(|_| self.end)
    }

    /// Each expectation in words, in the order of the file.
    pub fn standings(&self) -> impl Iterator<Item = (&str, ExpectationStatus)> {
        self.judge.iter().flat_map(Judge::standings).map(|(words, met)| {
            let standing = match met {
                None => ExpectationStatus::Pending,
                Some(true) => ExpectationStatus::Met,
                Some(false) => ExpectationStatus::Failed,
            };
            (words, standing)
        })
    }

    /// Why expectations failed, so far.
    pub fn reasons(&self) -> Vec<(String, String)> {
        let failed = |words: &str| self.standings().any(|known| known == (words, ExpectationStatus::Failed));
        let verdict = self.judge.as_ref().map(Judge::verdict).unwrap_or_default();
        let failures = verdict.failures.into_iter().filter(|failure| failed(&failure.expectation));
        failures
            .map(|failure| {
                let told = format!("after {:.1} s: {}", failure.seconds, failure.reason);
                (failure.expectation, told)
            })
            .collect()
    }

    /// Met or failed as a whole, or still open.
    pub fn whole(&self) -> ExpectationStatus {
        let mut all = self.standings().map(|(_, standing)| standing).peekable();
        if all.peek().is_none() {
            return ExpectationStatus::Pending;
        }
        all.fold(ExpectationStatus::Met, |whole, standing| match (whole, standing) {
            (ExpectationStatus::Failed, _) | (_, ExpectationStatus::Failed) => ExpectationStatus::Failed,
            (ExpectationStatus::Pending, _) | (_, ExpectationStatus::Pending) => ExpectationStatus::Pending,
            _ => ExpectationStatus::Met,
        })
    }
}

/// Shows the judge the tick that is just over, and stops the time when the scenario is over.
fn look(world: &mut World) {
    let Some(mut expectations) = world.remove_resource::<Expectations>() else { return };
    let tick = world.resource::<Clock>().tick;
    let mut ends = false;
    if let Some(judge) = &mut expectations.judge {
        if tick <= expectations.end {
            observe(world, judge);
        }
        ends = tick == expectations.end;
    }
    if ends {
        if let Some(mut playback) = world.get_resource_mut::<Playback>() {
            playback.paused = true;
        }
        let passed = expectations.whole() == ExpectationStatus::Met;
        let news = if passed { "The scenario is over: passed" } else { "The scenario is over: failed" };
        world.resource_mut::<Announcement>().tell(news.into());
    }
    world.insert_resource(expectations);
}

/// When the window is closed on a scenario that has failed, the app ends with [`FAILED`].
fn tell_whoever_started_us(expectations: Res<Expectations>, mut exits: ResMut<Messages<AppExit>>) {
    let is_closed = exits.iter_current_update_messages().any(AppExit::is_success);
    if is_closed && expectations.whole() == ExpectationStatus::Failed {
        exits.write(AppExit::from_code(FAILED));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AssetFolder;
    use crate::game::Match;
    use crate::lab::scenario::{Condition, Expectation, ScenarioPlan, ScenarioRef, Thing};

    #[test]
    fn the_window_judges_as_the_headless_runner_and_leaves_the_match_alone() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let plan = ScenarioPlan::read(&assets, &ScenarioRef::named(&assets, "swap_figure_8")).unwrap();
        let (mut seen, mut unseen) = (Match::new(&plan.with_seed(1)), Match::new(&plan.with_seed(1)));
        let dt = seen.clock().dt;
        let mut expectations = Expectations::of(Some(&plan.scenario), dt);
        assert!(expectations.standings().all(|(_, standing)| standing == ExpectationStatus::Pending));
        assert_eq!(expectations.whole(), ExpectationStatus::Pending);
        for _ in 0..expectations.end {
            seen.tick();
            unseen.tick();
            observe(seen.world_mut(), expectations.judge.as_mut().unwrap());
        }
        assert_eq!(seen.record().digest, unseen.record().digest);
        let passed = plan.play(plan.scenario.first_place(), 1).passed();
        assert_eq!(expectations.whole() == ExpectationStatus::Met, passed);
        assert_eq!(expectations.reasons().is_empty(), passed);
    }

    #[test]
    fn a_window_that_is_closed_on_a_failed_scenario_says_so_when_it_ends() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let mut plan = ScenarioPlan::read(&assets, &ScenarioRef::named(&assets, "swap_figure_8")).unwrap();
        let never = Condition::Distance { from: Thing::Ball, to: Thing::Ball, below: None, above: Some(1.0) };
        for (what, expected) in
            [(never.clone(), AppExit::from_code(FAILED)), (Condition::Not(Box::new(never)), AppExit::Success)]
        {
            plan.scenario.expect =
                vec![Expectation::Always { what, from: 0.0, until: None, because: String::new() }];
            let mut game = Match::new(&plan.with_seed(1));
            let mut expectations = Expectations::of(Some(&plan.scenario), game.clock().dt);
            game.tick();
            observe(game.world_mut(), expectations.judge.as_mut().unwrap());
            let mut app = App::new();
            app.insert_resource(expectations).add_systems(Last, tell_whoever_started_us);
            app.update();
            assert_eq!(app.should_exit(), None);
            // Bevy notices within a frame that its window has been closed.
            app.add_systems(PostUpdate, |mut exits: MessageWriter<AppExit>| {
                exits.write(AppExit::Success);
            });
            app.update();
            assert_eq!(app.should_exit(), Some(expected));
        }
    }

    #[test]
    fn a_match_expects_nothing() {
        let none = Expectations::of(None, 0.1);
        assert_eq!((none.standings().count(), none.whole()), (0, ExpectationStatus::Pending));
    }
}
