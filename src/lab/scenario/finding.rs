//! What a condition finds at one tick: whether it holds, and the values that make it so. Conditions that have parts or
//! remember earlier ticks are left to [`super::watch`].

use super::condition::{Condition, Thing};
use super::scene::{RobotScene, Scene};
use super::words::{list, metres_of};
use crate::game::record::ContactTotal;
use crate::ids::{RobotId, Team};

/// What a condition finds.
pub(super) struct Finding<'s> {
    pub holds: bool,
    /// The values behind it, put into words when they are asked for.
    pub words: Box<dyn Fn() -> String + 's>,
}

fn finding<'s>(holds: bool, words: impl Fn() -> String + 's) -> Finding<'s> {
    Finding { holds, words: Box::new(words) }
}

/// What a condition without parts and memory finds in a scene.
pub(super) fn find<'s>(condition: &'s Condition, scene: &'s Scene) -> Finding<'s> {
    match condition {
        Condition::RoleOf(robot, role) => of(
            scene,
            *robot,
            move |it| it.role == role,
            move |it, held| format!("was {}{}", it.role, unless(held, role)),
        ),
        Condition::ActingAs(robot, role) => of(
            scene,
            *robot,
            move |it| it.acting_as == role,
            move |it, held| format!("acted as {}{}", it.acting_as, unless(held, role)),
        ),
        Condition::ActivityOf(robot, names) => of(
            scene,
            *robot,
            move |it| names.iter().any(|name| it.activity == name || it.within.contains(&name.as_str())),
            move |it, held| format!("was in {}{}", it.activity, unless(held, &list(names, " or "))),
        ),
        Condition::Claims(robot) => of(
            scene,
            *robot,
            |it| it.claims,
            |it, _| if it.claims { "claimed the ball" } else { "did not claim the ball" }.into(),
        ),
        Condition::Holder { robot, seen_by } => beliefs(scene, *robot, *seen_by, "holder", |it| it.holder),
        Condition::Goes(robot) => of(
            scene,
            *robot,
            |it| it.on && it.goes,
            |it, _| if it.goes { "went for the ball" } else { "did not go for the ball" }.into(),
        ),
        Condition::Drives(robot) => of(
            scene,
            *robot,
            |it| it.drives,
            |it, _| if it.drives { "drove at the ball" } else { "did not drive at the ball" }.into(),
        ),
        Condition::Driving { team, at_least, at_most } => {
            let driving = || scene.switched_on(*team).filter(|it| it.drives);
            finding(is_between(driving().count() as u32, *at_least, *at_most), move || {
                list(driving().map(|it| it.id.to_string()), " and ").non_empty_or("nobody")
                    + " drove at the ball"
            })
        }
        Condition::Going { team, at_least, at_most } => {
            finding(is_between(scene.going(*team), *at_least, *at_most), move || {
                let going = scene.switched_on(*team).filter(|it| it.goes).map(|it| it.id.to_string());
                list(going, " and ").non_empty_or("nobody") + " went for the ball"
            })
        }
        Condition::Booker { robot, seen_by } => beliefs(scene, *robot, *seen_by, "booker", |it| it.booker),
        Condition::Locked { robot, by } => of(
            scene,
            *robot,
            move |it| it.locked_by.is_some_and(|lock| by.is_none_or(|by| by.number == lock)),
            move |it, _| match it.locked_by {
                Some(by) => format!("was locked by {}", RobotId::new(robot.team, by)),
                None => "was not locked".into(),
            },
        ),
        Condition::Unlocked(team) => finding(locked(scene, *team).next().is_none(), move || {
            let locked = locked(scene, *team);
            let locked = locked.map(|(id, by)| format!("{id} was locked by {}", RobotId::new(*team, by)));
            list(locked, " and ").non_empty_or("no robot was locked")
        }),
        Condition::Distance { from, to, below, above } => {
            let metres = distance(scene, *from, *to);
            finding(metres.is_some_and(|it| within(it, *below, *above)), move || match metres {
                Some(metres) => format!("{from} was {metres:.2} m from {to}"),
                None => format!("{from} or {to} did not take part"),
            })
        }
        Condition::Behind { what, of, toward, near, far, aside: (least, most) } => {
            let found = behind(scene, *what, *of, *toward);
            let holds = found.is_some_and(|(behind, aside)| {
                (*near..=*far).contains(&behind) && (*least..=*most).contains(&aside)
            });
            finding(holds, move || match found {
                Some((behind, aside)) => {
                    format!("{what} was {behind:.2} m behind {of} and {aside:.2} m aside")
                }
                None => format!("{what}, {of} or {toward} did not take part"),
            })
        }
        Condition::Speed { of, below, above } => {
            let speed = scene.speed(*of);
            finding(speed.is_some_and(|it| within(it, *below, *above)), move || match speed {
                Some(speed) => format!("{of} went at {speed:.2} m/s"),
                None => format!("{of} did not take part"),
            })
        }
        Condition::InZone { what, zone } => {
            let point = scene.position(*what);
            finding(point.is_some_and(|it| scene.contains(*zone, it)), move || match point {
                Some(point) => format!("{what} was at {}", metres_of(point)),
                None => format!("{what} did not take part"),
            })
        }
        Condition::Goals { team, at_least, at_most } => {
            let goals = scene.score[team.index()];
            let words = move || format!("{team} had scored {goals}");
            finding(is_between(goals, *at_least, *at_most), words)
        }
        Condition::Touching(a, b) => {
            finding(scene.contacts.touch(*a, *b), move || match (scene.robot(*a), scene.robot(*b)) {
                (Some(one), Some(other)) => {
                    let metres = one.pose.position.distance(other.pose.position);
                    let touched = if scene.contacts.touch(*a, *b) { "touched" } else { "did not touch" };
                    format!("{a} {touched} {b}, {metres:.2} m away")
                }
                _ => format!("{a} or {b} did not take part"),
            })
        }
        Condition::MateContacts { team, at_least, at_most } => {
            let total = scene.contacts.of_mates(*team);
            finding(is_between(total.number, *at_least, *at_most), move || contacts(*team, total))
        }
        Condition::MateContactTime { team, below, above } => {
            let total = scene.contacts.of_mates(*team);
            finding(within(total.seconds as f32, *below, *above), move || contacts(*team, total))
        }
        Condition::RolesDistinct(team) => {
            let same = same_role(scene, *team);
            let holds = scene.switched_on(*team).next().is_some() && same.is_none();
            finding(holds, move || match same {
                Some((a, b)) => format!("{} and {} were both {}", a.id, b.id, a.role),
                None => roles(scene, *team),
            })
        }
        Condition::RolesAre(team, wanted) => {
            let fits = move |(number, role): (&u8, &String)| {
                scene.robot(RobotId::new(*team, *number)).is_some_and(|it| it.role == role)
            };
            let holds = wanted.iter().all(fits);
            finding(holds, move || {
                let telling = wanted.iter().filter(|pair| fits(*pair) == holds);
                let told = telling.map(|(number, role)| {
                    let robot = RobotId::new(*team, *number);
                    let words = move |it: &RobotScene, held| format!("was {}{}", it.role, unless(held, role));
                    (of(scene, robot, move |it| it.role == role, words).words)()
                });
                list(told, " and ")
            })
        }
        Condition::ConfigurationsAgree(team) => {
            let mut known = scene.switched_on(*team).map(|it| it.configuration);
            let holds = known.next().flatten().is_some_and(|first| known.all(|other| other == Some(first)));
            finding(holds, move || configurations(scene, *team))
        }
        Condition::Broken { invariant, team } => {
            let broken = scene.invariants.broken_now(*invariant, *team);
            finding(broken.is_some(), move || match broken {
                Some(since) => format!("{invariant}, since tick {since}"),
                None => "it was not so, or not for long".into(),
            })
        }
        // Their watches see to these.
        Condition::Sent(_)
        | Condition::Delivered(_)
        | Condition::All(_)
        | Condition::Any(_)
        | Condition::Not(_)
        | Condition::For { .. } => finding(false, || condition.to_string()),
    }
}

/// What there is to see of one robot; the words get to know whether the condition holds.
fn of<'s>(
    scene: &'s Scene,
    robot: RobotId,
    holds: impl Fn(&RobotScene) -> bool,
    words: impl Fn(&RobotScene, bool) -> String + 's,
) -> Finding<'s> {
    let seen = scene.robot(robot);
    let holds = seen.is_some_and(holds);
    finding(holds, move || match seen {
        Some(it) => format!("{robot} {}", words(it, holds)),
        None => format!("{robot} did not take part"),
    })
}

/// What was wanted, where it did not hold.
fn unless(held: bool, wanted: &str) -> String {
    if held { String::new() } else { format!(", not {wanted}") }
}

/// Whether all in whose eyes a robot may hold or have booked the ball believe that it does.
fn beliefs<'s>(
    scene: &'s Scene,
    robot: RobotId,
    seen_by: Option<RobotId>,
    what: &'static str,
    belief: fn(&RobotScene) -> Option<u8>,
) -> Finding<'s> {
    let mut all = eyes(scene, robot, seen_by).peekable();
    let holds = all.peek().is_some() && all.all(|it| belief(it) == Some(robot.number));
    finding(holds, move || {
        let beliefs = eyes(scene, robot, seen_by).map(|it| match belief(it) {
            Some(other) => format!("{} took {} for the {what}", it.id, RobotId::new(robot.team, other)),
            None => format!("{} knew no {what}", it.id),
        });
        list(beliefs, ", ").non_empty_or("no team mate was switched on")
    })
}

fn is_between(count: u32, at_least: Option<u32>, at_most: Option<u32>) -> bool {
    at_least.is_none_or(|least| count >= least) && at_most.is_none_or(|most| count <= most)
}

/// Those in whose eyes a robot may hold the ball.
fn eyes<'s>(
    scene: &'s Scene,
    robot: RobotId,
    seen_by: Option<RobotId>,
) -> impl Iterator<Item = &'s RobotScene<'s>> {
    scene.robots.iter().filter(move |it| match seen_by {
        Some(seen_by) => it.id == seen_by,
        None => it.on && it.id.team == robot.team && it.id != robot,
    })
}

/// The robots of a team that have given their locks, and whom.
fn locked(scene: &Scene, team: Team) -> impl Iterator<Item = (RobotId, u8)> {
    let team = scene.robots.iter().filter(move |it| it.id.team == team);
    team.filter_map(|it| Some((it.id, it.locked_by?)))
}

fn contacts(team: Team, total: ContactTotal) -> String {
    let ContactTotal { number, seconds } = total;
    let times = if number == 1 { "once" } else { &format!("{number} times") };
    format!("robots of {team} had touched each other {times}, for {seconds:.2} s")
}

fn distance(scene: &Scene, from: Thing, to: Thing) -> Option<f32> {
    Some(scene.position(from)?.distance(scene.position(to)?))
}

/// How far a thing is behind another on its way to a third, and how far off that way.
fn behind(scene: &Scene, what: Thing, of: Thing, toward: Thing) -> Option<(f32, f32)> {
    let of = scene.position(of)?;
    let way = (scene.position(toward)? - of).try_normalize()?;
    let offset = scene.position(what)? - of;
    Some((-way.dot(offset), way.perp_dot(offset).abs()))
}

fn within(value: f32, below: Option<f32>, above: Option<f32>) -> bool {
    below.is_none_or(|below| value < below) && above.is_none_or(|above| value > above)
}

/// The first two robots of a team that have the same role.
fn same_role<'s>(scene: &'s Scene, team: Team) -> Option<(&'s RobotScene<'s>, &'s RobotScene<'s>)> {
    scene.switched_on(team).find_map(|a| {
        let mut others = scene.switched_on(team).filter(|b| b.id > a.id);
        others.find(|b| b.role == a.role).map(|b| (a, b))
    })
}

fn roles(scene: &Scene, team: Team) -> String {
    let roles = scene.switched_on(team).map(|it| format!("{} was {}", it.id, it.role));
    list(roles, ", ").non_empty_or("no robot of the team was switched on")
}

/// "home 0 had A, home 1 had B, home 2 had none": letters stand for configurations in the order of the robots.
fn configurations(scene: &Scene, team: Team) -> String {
    let mut seen = Vec::new();
    let known = scene.switched_on(team).map(|it| match it.configuration {
        Some(configuration) => {
            let place = seen.iter().position(|other| *other == configuration).unwrap_or_else(|| {
                seen.push(configuration);
                seen.len() - 1
            });
            format!("{} had {}", it.id, char::from(b'A' + (place % 26) as u8))
        }
        None => format!("{} had none", it.id),
    });
    list(known, ", ").non_empty_or("no robot of the team was switched on")
}

trait NonEmptyOr {
    fn non_empty_or(self, other: &str) -> String;
}

impl NonEmptyOr for String {
    fn non_empty_or(self, other: &str) -> String {
        if self.is_empty() { other.to_owned() } else { self }
    }
}
