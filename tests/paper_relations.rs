//! Relations between constants that the Hammerheads' paper states: read from every shipped team of theirs as it is played, so
//! that a constant may be tuned and a relation may not be tuned away.

use bevy::prelude::Vec2;
use touchline::data::AssetKind;
use touchline::geometry::angle;
use touchline::pitch::Pitch;
use touchline::strategy::language::{Feature, Point, Points, Schema, ZoneName};
use touchline::strategy::{
    Assemblage, Influence, Part, Play, RoleSpec, State, Strategy, SubRole, Term, played,
};

use crate::support::{assets, friendly};

/// A sentence of the paper, and what a team has against it.
type Relation = (&'static str, fn(&Strategy) -> Vec<String>);

const RELATIONS: [Relation; 12] = [
    ("the goalie moves the fastest (section IV)", goalie_is_fastest),
    ("the halfback is slower while it acquires the ball and speeds up once it has it (section IV)", halfback),
    ("the forward moves the slowest when it acquires the ball and when it dribbles (section IV)", forward),
    ("the floater's zone and homebases are those of the role that it plays (figure 2)", floater),
    ("the supporter is just behind and to one side of the robot with the ball (section VI-C)", support),
    ("on the way home repulsion from team mates is linear before all (section V-A)", home_is_linear),
    ("on the way to the ball and with it a swirl leads around team mates (section V-A)", progress_swirls),
    ("avoidance is greater on the way home than on the way to the ball (section VI-A)", less_on_the_ball),
    ("whoever has the ball is avoided in all behaviours (section VI-B)", claimant_is_avoided),
    (
        "before the goal the halfback intercepts a ball in the goalie's danger zone (figure 4)",
        halfback_covers,
    ),
    ("the goalie leaves the penalty area to clear the ball (section VI-C)", goalie_is_aggressive),
    ("the forward's homebases are penalty spots (section V-B)", forward_waits_on_spots),
];

#[test]
fn every_team_of_hammerheads_keeps_the_relations_that_the_paper_states() {
    let names = assets().names(AssetKind::Strategy);
    let teams: Vec<&String> = names.iter().filter(|name| name.starts_with("hammerheads_")).collect();
    assert!(teams.len() >= 4, "{teams:?}");
    let faults: Vec<String> = (teams.iter())
        .flat_map(|name| {
            let team = shipped(name);
            let told = RELATIONS.into_iter().flat_map(move |(sentence, faults)| {
                faults(&team).into_iter().map(move |fault| format!("{sentence}: {fault}"))
            });
            told.map(move |fault| format!("{name}: {fault}")).collect::<Vec<_>>()
        })
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Each robot counts alike, the floater as half a halfback and half a forward.
#[test]
fn the_ball_chasers_drive_at_the_mean_speeds_of_the_hammerheads_and_are_stuck_after_the_same_time() {
    let (team, chasers) = (shipped("hammerheads_2001"), shipped("ball_chasers"));
    for (doing, theirs, own) in [
        ("acquire the ball", Doing::Acquire, Doing::Acquire),
        ("drive it", Doing::Dribble, Doing::Dribble),
        ("go home", Doing::GoHome, Doing::GoHome),
    ] {
        let [goalie, halfback, forward] =
            ["goalie", "halfback", "forward"].map(|role| speed(&team, role, theirs));
        let mean = (goalie + halfback + (halfback + forward) / 2.0 + forward) / 4.0;
        for role in &chasers.roles {
            let speed = speed(&chasers, &role.name, own);
            assert!((speed - mean).abs() < 1e-4, "the {} {doing} at {speed}, the team at {mean}", role.name);
        }
    }
    let patience = |strategy: &Strategy| {
        let mut all = stuck_times(strategy);
        all.dedup();
        all
    };
    assert_eq!(patience(&team).len(), 1, "the same times in all states: {:?}", patience(&team));
    assert_eq!(patience(&team)[0].len(), 2, "after a bump, and without one");
    assert_eq!(patience(&team), patience(&chasers));
}

fn shipped(name: &str) -> Strategy {
    let path = assets().file(AssetKind::Strategy, name);
    Strategy::read(&assets(), &path, None).strategy.unwrap_or_else(|error| panic!("{error}"))
}

/// What a robot does, told by the schemas that steer it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Doing {
    Acquire,
    Dribble,
    GoHome,
    Support,
}

/// The paper adds schemas, and its teams blend nothing.
fn schema_of(term: &Term) -> Option<&Schema> {
    match &term.influence {
        Influence::Schema(schema) => Some(schema),
        Influence::Assemblage { .. } => None,
    }
}

fn does(term: &Term, doing: Doing) -> bool {
    match (schema_of(term), doing) {
        (Some(Schema::DockBehind { .. }), Doing::Acquire)
        | (Some(Schema::Dribble { .. }), Doing::Dribble) => true,
        (Some(Schema::GoTo { target, .. }), Doing::GoHome) => *target == Point::Homebase,
        (Some(Schema::GoTo { target, .. }), Doing::Support) => matches!(target, Point::SupportSpot { .. }),
        _ => false,
    }
}

fn role<'a>(team: &'a Strategy, name: &str) -> &'a RoleSpec {
    team.roles.iter().find(|role| role.name == name).unwrap_or_else(|| panic!("no role {name}"))
}

fn states<'a>(team: &'a Strategy, role_name: &str) -> impl Iterator<Item = &'a State> {
    team.machines[played(role(team, role_name)).machine].states.iter()
}

fn assemblage<'a>(team: &'a Strategy, state: &State) -> Option<&'a Assemblage> {
    state.assemblage.map(|index| &team.assemblages[index])
}

/// The state in which a role does it, and what steers it there.
fn doing<'a>(team: &'a Strategy, role_name: &str, doing: Doing) -> (&'a State, &'a Assemblage) {
    let mut found = states(team, role_name)
        .filter_map(|state| Some((state, assemblage(team, state)?)))
        .filter(|(_, assemblage)| assemblage.terms.iter().any(|term| does(term, doing)));
    let first = found.next().unwrap_or_else(|| panic!("{role_name} never does {doing:?}"));
    assert!(found.next().is_none(), "{role_name} does {doing:?} in two states");
    first
}

fn speed(team: &Strategy, role_name: &str, what: Doing) -> f32 {
    doing(team, role_name, what).0.speed
}

fn unless(holds: bool, fault: String) -> Vec<String> {
    if holds { Vec::new() } else { vec![fault] }
}

fn goalie_is_fastest(team: &Strategy) -> Vec<String> {
    let at_ball = [Doing::Acquire, Doing::Dribble];
    let slowest = at_ball.map(|what| speed(team, "goalie", what)).into_iter().fold(1.0, f32::min);
    let others = ["halfback", "forward"].into_iter().flat_map(|role| at_ball.map(|what| (role, what)));
    let faults = others.filter(|(role, what)| speed(team, role, *what) >= slowest);
    faults.map(|(role, what)| format!("the {role} does {what:?} at {}", speed(team, role, what))).collect()
}

fn halfback(team: &Strategy) -> Vec<String> {
    let [acquires, dribbles] = [Doing::Acquire, Doing::Dribble].map(|what| speed(team, "halfback", what));
    unless(acquires < dribbles, format!("it acquires at {acquires} and drives it at {dribbles}"))
}

fn forward(team: &Strategy) -> Vec<String> {
    let slower = |what, role| {
        let (own, other) = (speed(team, "forward", what), speed(team, role, what));
        unless(own < other, format!("it does {what:?} at {own}, the {role} at {other}"))
    };
    let pairs =
        [Doing::Acquire, Doing::Dribble].into_iter().flat_map(|what| [(what, "halfback"), (what, "goalie")]);
    pairs.flat_map(|(what, role)| slower(what, role)).collect()
}

/// Which role a sub-role of the floater stands in for: the one whose machine it plays.
fn floater(team: &Strategy) -> Vec<String> {
    let Part::ActsAs(sub_roles) = &role(team, "floater").part else {
        return vec!["the floater plays a machine of its own".into()];
    };
    let mut faults: Vec<String> = sub_roles.iter().flat_map(|sub_role| stands_in(team, sub_role)).collect();
    for part in ["halfback", "forward"] {
        let wanted = played(role(team, part)).machine;
        if !sub_roles.iter().any(|sub_role| played(&team.roles[sub_role.role]).machine == wanted) {
            faults.push(format!("it never plays the {part}"));
        }
    }
    faults
}

fn stands_in(team: &Strategy, sub_role: &SubRole) -> Vec<String> {
    let name = &team.roles[sub_role.role].name;
    let play = played(&team.roles[sub_role.role]);
    let models = ["halfback", "forward"].map(|role_name| (role_name, played(role(team, role_name))));
    let Some((model, its)) = models.into_iter().find(|(_, model)| model.machine == play.machine) else {
        return vec![format!("{name} plays neither the halfback nor the forward")];
    };
    let sorted = |play: &Play| {
        let mut homebases = play.homebases.clone();
        homebases.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        homebases
    };
    let mut faults =
        unless(play.danger_zone == its.danger_zone, format!("{name}'s zone is not the {model}'s"));
    faults.extend(unless(sorted(play) == sorted(its), format!("{name}'s homebases are not the {model}'s")));
    faults
}

/// Just behind: nearer than a metre and a quarter. To one side: between 20 and 60 degrees off straight behind.
fn support(team: &Strategy) -> Vec<String> {
    let (_, steers) = doing(team, "forward", Doing::Support);
    let spots = steers.terms.iter().filter_map(|term| match schema_of(term) {
        Some(Schema::GoTo { target: Point::SupportSpot { behind, aside }, .. }) => Some((*behind, *aside)),
        _ => None,
    });
    let fits = |behind: f32, aside: f32| {
        let off = angle(Vec2::new(behind, aside)).to_degrees();
        Vec2::new(behind, aside).length() < 1.25 && (20.0..=60.0).contains(&off)
    };
    let faults = spots.filter(|(behind, aside)| !fits(*behind, *aside));
    faults.map(|(behind, aside)| format!("it is {behind} m behind and {aside} m aside")).collect()
}

/// Team mates that a robot may have to get around.
const MATES: [Points; 3] = [Points::Superiors, Points::Peers, Points::Claimant];

fn has(of: &Points, wanted: &Points) -> bool {
    match of {
        Points::Union(sets) => sets.iter().any(|set| has(set, wanted)),
        Points::Teammates => MATES.contains(wanted),
        Points::Within { of, .. }
        | Points::WithinOrClosest { of, .. }
        | Points::FartherThan { of, .. }
        | Points::Remember { of, .. } => has(of, wanted),
        other => other == wanted,
    }
}

/// The weights of linear repulsion from such mates, and of swirls around them.
fn avoidance(assemblage: &Assemblage, mates: &Points) -> (f32, f32) {
    assemblage.terms.iter().fold((0.0, 0.0), |(linear, swirl), term| match schema_of(term) {
        Some(Schema::Avoid { of, .. }) if has(of, mates) => (linear + term.weight, swirl),
        Some(Schema::Swirl { around, .. } | Schema::SwirlLeft { around, .. }) if has(around, mates) => {
            (linear, swirl + term.weight)
        }
        _ => (linear, swirl),
    })
}

const EVERYBODY: [&str; 3] = ["goalie", "halfback", "forward"];

fn home_is_linear(team: &Strategy) -> Vec<String> {
    let pairs = EVERYBODY.into_iter().flat_map(|role| MATES.map(|mates| (role, mates)));
    pairs
        .flat_map(|(role, mates)| {
            let (linear, swirl) = avoidance(doing(team, role, Doing::GoHome).1, &mates);
            unless(linear > swirl, format!("{role}, {mates:?}: linear {linear}, swirl {swirl}"))
        })
        .collect()
}

fn progress_swirls(team: &Strategy) -> Vec<String> {
    let roles = EVERYBODY.into_iter().flat_map(|role| [(role, Doing::Acquire), (role, Doing::Dribble)]);
    roles
        .flat_map(|(role, what)| {
            let (linear, swirl) = avoidance(doing(team, role, what).1, &Points::Claimant);
            unless(swirl > linear, format!("{role}, {what:?}: linear {linear}, swirl {swirl}"))
        })
        .collect()
}

fn less_on_the_ball(team: &Strategy) -> Vec<String> {
    let all = |role, what, mates: &Points| {
        let (linear, swirl) = avoidance(doing(team, role, what).1, mates);
        linear + swirl
    };
    let pairs = EVERYBODY.into_iter().flat_map(|role| MATES.map(|mates| (role, mates)));
    pairs
        .flat_map(|(role, mates)| {
            let [home, ball] = [Doing::GoHome, Doing::Acquire].map(|what| all(role, what, &mates));
            unless(
                home > ball,
                format!("{role}, {mates:?}: {home} on the way home, {ball} on the way to the ball"),
            )
        })
        .collect()
}

/// In reverse a robot gets out of a jam, which is none of the paper's behaviours.
fn claimant_is_avoided(team: &Strategy) -> Vec<String> {
    let all = EVERYBODY.into_iter().flat_map(|role| states(team, role).map(move |state| (role, state)));
    let careless = all.filter(|(_, state)| {
        let (linear, swirl) =
            assemblage(team, state).map_or((0.0, 0.0), |steers| avoidance(steers, &Points::Claimant));
        !state.reverse && linear + swirl <= 0.0
    });
    careless.map(|(role, state)| format!("not by the {role} in {}", state.name)).collect()
}

fn halfback_covers(team: &Strategy) -> Vec<String> {
    let zone = played(role(team, "goalie")).danger_zone;
    let asks = |feature: &Feature| match feature {
        Feature::In { zone: ZoneName::Exactly(asked), point: Point::Ball } => *asked == zone,
        _ => false,
    };
    let acquires = doing(team, "halfback", Doing::Acquire).0;
    let states_of = || states(team, "halfback");
    let acquiring = states_of().position(|state| state == acquires);
    let mut ways = states_of().flat_map(|state| &state.transitions).filter(|way| Some(way.go) == acquiring);
    let covers = ways.any(|way| match &way.when {
        Feature::All(parts) => parts.iter().any(asks),
        other => asks(other),
    });
    unless(covers, "it never asks whether the ball is in that zone".into())
}

fn pitch() -> Pitch {
    friendly(1, 1.0).pitch
}

fn goalie_is_aggressive(team: &Strategy) -> Vec<String> {
    let (zone, area) = (played(role(team, "goalie")).danger_zone, pitch().own_penalty_area());
    let room = zone.max.x - area.max.x;
    unless(room > 0.25, format!("its zone ends {room} m beyond the area"))
}

fn forward_waits_on_spots(team: &Strategy) -> Vec<String> {
    let spots = pitch().penalty_spots;
    let off = played(role(team, "forward")).homebases.iter().filter(|home| !spots.contains(home));
    off.map(|home| format!("{home} is none")).collect()
}

/// The times after which a robot takes itself to be stuck, for each transition that asks.
fn stuck_times(team: &Strategy) -> Vec<Vec<f32>> {
    fn of(feature: &Feature, all: &mut Vec<f32>) {
        match feature {
            Feature::Stalled(seconds) => all.push(*seconds),
            Feature::Lasting { what, seconds, .. } if **what == Feature::Bumped => all.push(*seconds),
            Feature::Not(what)
            | Feature::HoldFor { what, .. }
            | Feature::Lasting { what, .. }
            | Feature::Watchdog { what, .. } => of(what, all),
            Feature::All(parts) | Feature::Any(parts) => parts.iter().for_each(|part| of(part, all)),
            _ => {}
        }
    }
    let transitions =
        team.machines.iter().flat_map(|machine| &machine.states).flat_map(|state| &state.transitions);
    let times = transitions.map(|transition| {
        let mut times = Vec::new();
        of(&transition.when, &mut times);
        times
    });
    times.filter(|times| !times.is_empty()).collect()
}
