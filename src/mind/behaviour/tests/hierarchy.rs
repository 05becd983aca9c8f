//! States within states: which transition is taken, what begins anew, and that the rows of a loaded machine play as the tree in
//! its file says.

use proptest::prelude::{ProptestConfig, any, prop, prop_assert_eq, prop_oneof, proptest};
use proptest::strategy::Strategy as _;

use super::*;

/// A team of one whose machine has these states and starts in `start`.
fn machine(start: &str, states: &str) -> Strategy {
    strategy(
        "r",
        &format!(
            r#"schemas: {{}}, assemblages: {{}}, machines: {{"m": (start: "{start}", states: {{{states}}})}},
            roles: {{"r": Plays(tag: "R", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)])}},"#
        ),
    )
}

/// A robot that plays while it knows the ball, and rests otherwise.
fn player() -> Bench {
    let states = r#"
        "rest": (on: [(when: Known(Ball), go: "play")]),
        "play": (start: "near", on: [(when: Not(Known(Ball)), go: "rest"), (when: After(0.5), go: "rest")], states: {
            "near": (on: [(when: Always, go: "far")]),
            "far": (on: [(when: After(0.1), go: "near")]),
        })"#;
    Bench::new(machine("rest", states), "r")
}

#[test]
fn a_transition_of_an_outer_state_is_taken_from_every_state_in_it_and_before_that_states_own() {
    for inner in 1..4 {
        let mut bench = player();
        for decision in 1..=inner {
            bench.decide(decision * DECISION, here().ball(1.0, 0.0));
        }
        assert_ne!(bench.state(), "rest");
        bench.decide((inner + 1) * DECISION, here());
        assert_eq!(bench.state(), "rest", "after {inner} decisions");
    }
}

#[test]
fn a_transition_that_was_taken_is_known_by_the_level_of_its_state_and_its_place_there() {
    let mut bench = player();
    bench.decide(3, here().ball(1.0, 0.0));
    bench.decide(6, here().ball(1.0, 0.0));
    let activity = bench.decide(9, here());
    let ids: Vec<_> = activity.history.iter().filter_map(|taken| taken.transition).collect();
    let id = |of, number| TransitionId { machine: 0, of, number };
    let machine = &bench.strategy.machines[0];
    let plain = |name| StateRef::Plain(machine.find(name).expect("the state exists"));
    assert_eq!(ids, [id(plain("rest"), 0), id(plain("near"), 0), id(StateRef::Composite(0), 0)]);
    let targets = ids.iter().map(|id| machine.target(&machine.transitions_of(id.of)[id.number]));
    assert_eq!(targets.collect::<Vec<_>>(), [StateRef::Composite(0), plain("far"), plain("rest")]);
    assert_eq!(activity.taken_in(9).count(), 1);
    assert_eq!(activity.taken_in(10).count(), 0);
}

#[test]
fn the_time_in_an_outer_state_goes_on_from_one_state_in_it_to_the_next() {
    let mut bench = player();
    let mut states = Vec::new();
    for decision in 0..12 {
        bench.decide(decision * DECISION, here().ball(1.0, 0.0));
        states.push(bench.state().to_owned());
    }
    // Each state in it lasts a tenth of a second at most, and after half a second all of it is left.
    let play = ["near", "far", "far", "near", "far", "far", "near", "far", "far", "near"];
    assert_eq!(states, [&play[..], &["rest", "near"]].concat());
}

#[test]
fn a_memory_of_an_outer_state_goes_on_from_one_state_in_it_to_the_next() {
    let states = r#"
        "play": (start: "a", on: [(when: Lasting(what: Known(Ball), seconds: 0.3), go: "done")], states: {
            "a": (on: [(when: Always, go: "b")]),
            "b": (on: [(when: Always, go: "a")]),
        }),
        "done": ()"#;
    let mut bench = Bench::new(machine("play", states), "r");
    for decision in 0..6 {
        bench.decide(decision * DECISION, here().ball(1.0, 0.0));
        assert_ne!(bench.state(), "done");
    }
    bench.decide(6 * DECISION, here().ball(1.0, 0.0));
    assert_eq!(bench.state(), "done");
}

#[test]
fn under_a_changed_strategy_the_times_of_outer_states_of_the_same_names_go_on() {
    let mut bench = player();
    for decision in 1..=3 {
        bench.decide(decision * DECISION, here().ball(1.0, 0.0));
    }
    let activity = bench.activity();
    assert_eq!((bench.state(), activity.since, &activity.entered[..]), ("far", 6, &[3][..]));
    let wrapped = machine(
        "rest",
        r#""rest": (), "all": (start: "play", states: {
            "play": (start: "near", states: {"near": (), "far": ()}),
        })"#,
    );
    let carried = activity.carried_over(&bench.strategy, &wrapped, 0, 99);
    assert_eq!(wrapped.machines[0].path(wrapped.state(0, carried.state)), "all/play/far");
    assert_eq!((carried.since, &carried.entered[..]), (6, &[6, 3][..]));
}

/// A state of a machine as a tree; those without states of their own are plain.
#[derive(Clone, Debug)]
struct Tree {
    name: String,
    ways: Vec<(Cause, usize)>,
    states: Vec<Tree>,
    start: usize,
}

/// What takes a transition of the test.
#[derive(Clone, Copy, Debug)]
enum Cause {
    /// The ball lies between this many metres up the field and one more.
    BallAt(i32),
    /// This many decisions in the state.
    Decisions(u64),
}

impl Cause {
    fn written(self) -> String {
        match self {
            Cause::BallAt(x) => {
                format!("In(zone: Exactly(min: ({x}, -9), max: ({}, 9)), point: Ball)", x + 1)
            }
            // A little less than the span, which is no number of binary places.
            Cause::Decisions(count) => format!("After({})", count as f32 * 0.05 - 0.01),
        }
    }
}

/// A state that a robot is in, and since which tick.
type In = (String, u64);

impl Tree {
    fn written(&self, names: &[String]) -> String {
        let ways = self
            .ways
            .iter()
            .map(|(cause, to)| format!("(when: {}, go: \"{}\")", cause.written(), names[to % names.len()]));
        let on = ways.collect::<Vec<_>>().join(", ");
        let inner = match &self.states[..] {
            [] => String::new(),
            states => {
                let written: Vec<String> = states.iter().map(|state| state.written(names)).collect();
                format!(", start: \"{}\", states: {{{}}}", self.first().name, written.join(", "))
            }
        };
        format!("\"{}\": (on: [{on}]{inner})", self.name)
    }

    fn first(&self) -> &Tree {
        &self.states[self.start % self.states.len()]
    }

    /// Names every state differently, and lists the names.
    fn name_all(&mut self, names: &mut Vec<String>) {
        self.name = format!("s{}", names.len());
        names.push(self.name.clone());
        self.states.iter_mut().for_each(|state| state.name_all(names));
    }

    /// The way from this state to the one of a name in it, both included.
    fn way_to(&self, name: &str) -> Option<Vec<&Tree>> {
        if self.name == name {
            return Some(vec![self]);
        }
        let way = self.states.iter().find_map(|state| state.way_to(name))?;
        Some([vec![self], way].concat())
    }

    /// The states that a robot is in after a decision, by the tree itself; this tree is the machine, in which it always is.
    fn decide(&self, names: &[String], now: Vec<In>, tick: u64, ball: i32) -> Vec<In> {
        for (name, since) in &now {
            let way = self.way_to(name).expect("the state is in the tree");
            let holds = |cause: &Cause| match cause {
                Cause::BallAt(x) => *x == ball,
                Cause::Decisions(count) => tick - since >= count * DECISION,
            };
            let Some((_, to)) = way[way.len() - 1].ways.iter().find(|(cause, _)| holds(cause)) else {
                continue;
            };
            return self.go(&names[to % names.len()], now, tick);
        }
        now
    }

    /// Leaves what is not around the new state, and enters that and its start.
    fn go(&self, name: &str, mut now: Vec<In>, tick: u64) -> Vec<In> {
        let way = self.way_to(name).expect("the state is in the tree");
        let mut entered: Vec<&Tree> = way[1..].to_vec();
        let kept = now.iter().zip(&entered[..entered.len() - 1]).take_while(|(old, new)| old.0 == new.name);
        now.truncate(kept.count());
        while let Some(deepest) = entered.last().filter(|state| !state.states.is_empty()) {
            entered.push(deepest.first());
        }
        now.extend(entered[now.len()..].iter().map(|state| (state.name.clone(), tick)));
        now
    }
}

fn trees() -> impl proptest::strategy::Strategy<Value = Tree> {
    let cause = prop_oneof![(-3..3).prop_map(Cause::BallAt), (1u64..5).prop_map(Cause::Decisions)];
    let ways = prop::collection::vec((cause, any::<usize>()), 0..4);
    let tree = |states| move |(ways, start)| Tree { name: String::new(), ways, states, start };
    let plain = (ways.clone(), any::<usize>()).prop_map(move |parts| tree(Vec::new())(parts));
    plain.prop_recursive(3, 12, 4, move |inner| {
        let states = prop::collection::vec(inner, 1..4);
        (ways.clone(), any::<usize>(), states)
            .prop_map(move |(ways, start, states)| tree(states)((ways, start)))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn a_loaded_machine_plays_as_the_tree_in_its_file_says(
        states in prop::collection::vec(trees(), 1..4), start in any::<usize>(),
        balls in prop::collection::vec(-3..3, 1..20),
    ) {
        let mut whole = Tree { name: String::new(), ways: Vec::new(), states, start };
        let mut names = Vec::new();
        whole.name_all(&mut names);
        names.remove(0);
        let written: Vec<String> = whole.states.iter().map(|state| state.written(&names)).collect();
        let mut bench = Bench::new(machine(&whole.first().name, &written.join(", ")), "r");
        let mut expected = whole.go(&whole.first().name, Vec::new(), 0);
        for (decision, ball) in (1..).zip(balls) {
            let tick = decision * DECISION;
            expected = whole.decide(&names, expected, tick, ball);
            let activity = bench.decide(tick, here().ball(ball as f32 + 0.5, 0.0));
            let machine = &bench.strategy.machines[0];
            let names = machine.names_of(&machine.states[activity.state]).map(String::from);
            let since = activity.entered.iter().copied().chain([activity.since]);
            prop_assert_eq!(names.zip(since).collect::<Vec<In>>(), expected.clone());
        }
    }
}
