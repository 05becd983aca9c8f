//! What the runs measure: how many robots go to the ball, how long too many or none do, and whether that comes again.

use stateright::{Checker, Model, Property};

use super::model::{Action, Robot, State};
use super::team::Team;
use crate::support::explorer::Explored;

/// What the whole graph of a model says.
pub struct Findings {
    pub graph: Explored<Team>,
    pub nobody: Vec<bool>,
    pub one: Vec<bool>,
    pub several: Vec<bool>,
}

impl Findings {
    /// Explores all states, of which there are so many. Somewhere exactly one robot goes, so that all else is not about nothing.
    pub fn of(team: Team, states: usize) -> Findings {
        let findings = Findings::explored(team);
        assert_eq!(findings.graph.states.len(), states, "the number of states");
        findings
    }

    /// The same where the number is not worth telling.
    pub fn explored(team: Team) -> Findings {
        let graph = Explored::of(&team);
        let nobody = graph.marked(|state| state.going() == 0);
        let one = graph.marked(|state| state.going() == 1);
        let several = graph.marked(|state| state.going() > 1);
        assert!(one.contains(&true), "sometimes one robot goes");
        Findings { graph, nobody, one, several }
    }

    fn lasts(&self, within: &[bool]) -> Option<usize> {
        self.graph.lasts(within, ends_a_tick)
    }

    /// How many ticks in a row may end with nobody going; `None` if for ever.
    pub fn nobody_goes_for(&self) -> Option<usize> {
        self.lasts(&self.nobody)
    }

    /// How many ticks in a row may end with several going; `None` if for ever.
    pub fn several_go_for(&self) -> Option<usize> {
        self.lasts(&self.several)
    }

    /// Whether somebody once goes and then, by no misfortune, nobody does, be it for a moment.
    pub fn lets_go(&self) -> bool {
        self.graph.leads(|from, to| {
            let unlucky = self.graph.states[from].happened != self.graph.states[to].happened;
            !self.nobody[from] && self.nobody[to] && !unlucky
        })
    }

    /// How many ticks may end before exactly one goes for good; `None` if that is not certain.
    pub fn settles_after(&self) -> Option<usize> {
        let wrong: Vec<bool> = self.one.iter().map(|one| !one).collect();
        self.lasts(&self.graph.reaching(&wrong))
    }

    /// Where the ball lies in those rounds that may go on for ever and have nobody or several go again and again. A place
    /// comes once for every such round.
    pub fn wrong_for_ever(&self) -> Vec<Vec<u8>> {
        let wrong: Vec<bool> = self.one.iter().map(|one| !one).collect();
        let distances =
            |place: usize| self.graph.states[place].robots.iter().map(|robot| robot.distance).collect();
        self.graph.recurring(&wrong, ends_a_tick).into_iter().map(distances).collect()
    }

    /// Whether no tick at all ends with exactly one robot going.
    pub fn is_never_right(&self) -> bool {
        self.lasts(&self.one) == Some(0)
    }

    /// How many ticks in a row may end with a robot going although another is nearer by the threshold; `None` if for ever.
    pub fn the_wrong_one_goes_for(&self, threshold: u8) -> Option<usize> {
        let wrong = self.graph.marked(|state| {
            let nearest =
                state.robots.iter().filter(|robot| robot.up && robot.sees).map(|robot| robot.distance).min();
            let farther =
                |robot: &Robot| nearest.is_some_and(|nearest| nearest + threshold <= robot.distance);
            state.robots.iter().any(|robot| robot.goes() && farther(robot))
        });
        assert!(wrong.contains(&true), "sometimes the wrong robot goes");
        self.lasts(&wrong)
    }
}

fn ends_a_tick(action: &Action) -> bool {
    *action == Action::Tick
}

pub fn properties() -> Vec<Property<Team>> {
    vec![
        Property::always("who goes believes in itself", |_, state: &State| {
            let believes_in = |robot: &Robot| robot.machine.booking().map(|known| known.robot_booker);
            (0..)
                .zip(&state.robots)
                .all(|(number, robot)| !robot.goes() || believes_in(robot) == Some(number))
        }),
        Property::sometimes("one robot goes", |_, state: &State| state.going() == 1),
        Property::sometimes("several robots go", |_, state: &State| state.going() > 1),
    ]
}

impl Team {
    /// The checker's own count of the states.
    pub fn unique_states(self) -> usize {
        let checker = self.checker().spawn_bfs().join();
        checker.assert_properties();
        checker.unique_state_count()
    }
}
