//! Watching a condition from tick to tick: whether it holds, and the values that make it so.

use super::condition::{Condition, Packets, Thing};
use super::scene::{RobotScene, Scene};
use super::words::{list, metres_of};
use crate::ids::{RobotId, Team};

/// A condition and what has to be remembered of earlier ticks.
#[derive(Clone, Debug)]
pub(super) struct Watch {
    condition: Condition,
    /// The conditions inside it.
    parts: Vec<Watch>,
    /// Length of a tick, s.
    dt: f32,
    /// Whether it held at the last tick observed.
    holds: bool,
    /// The tick since which the part of a `For` holds.
    since: Option<u64>,
    /// The messages up to the time from which they count.
    before: u64,
}

/// The number of ticks that is nearest to a time in seconds.
pub(super) fn ticks(seconds: f32, dt: f32) -> u64 {
    (f64::from(seconds) / f64::from(dt)).round() as u64
}

impl Watch {
    pub(super) fn new(condition: &Condition, dt: f32) -> Watch {
        let parts = match condition {
            Condition::All(parts) | Condition::Any(parts) => parts.iter().collect(),
            Condition::Not(part) | Condition::For { what: part, .. } => vec![&**part],
            _ => Vec::new(),
        };
        Watch {
            condition: condition.clone(),
            parts: parts.into_iter().map(|part| Watch::new(part, dt)).collect(),
            dt,
            holds: false,
            since: None,
            before: 0,
        }
    }

    /// Looks at the next tick and says whether the condition holds. Every part is looked at, since some remember.
    pub(super) fn observe(&mut self, scene: &Scene) -> bool {
        for part in &mut self.parts {
            part.observe(scene);
        }
        self.holds = match &self.condition {
            Condition::All(_) => self.parts.iter().all(|part| part.holds),
            Condition::Any(_) => self.parts.iter().any(|part| part.holds),
            Condition::Not(_) => !self.parts[0].holds,
            Condition::For { seconds, .. } => {
                self.since = if self.parts[0].holds { self.since.or(Some(scene.tick)) } else { None };
                self.since.is_some_and(|since| scene.tick - since >= ticks(*seconds, self.dt))
            }
            Condition::Sent(packets) | Condition::Delivered(packets) => {
                let count = self.count(packets, scene);
                if scene.tick <= ticks(packets.since, self.dt) {
                    self.before = count;
                }
                count - self.before >= packets.at_least
            }
            atom => holds(atom, scene),
        };
        self.holds
    }

    /// Why the condition held, or did not, at the tick observed last.
    pub(super) fn why(&self, scene: &Scene) -> String {
        match &self.condition {
            Condition::All(_) | Condition::Any(_) => {
                let telling = self.parts.iter().filter(|part| part.holds == self.holds);
                list(telling.map(|part| part.why(scene)), " and ")
            }
            Condition::Not(_) => self.parts[0].why(scene),
            Condition::For { .. } => {
                let why = self.parts[0].why(scene);
                match self.since {
                    Some(since) => {
                        let seconds = (scene.tick - since) as f32 * self.dt;
                        format!("{why} for {seconds:.2} s so far")
                    }
                    None => why,
                }
            }
            Condition::Sent(packets) | Condition::Delivered(packets) => {
                let count = self.count(packets, scene) - self.before;
                let verb = if matches!(self.condition, Condition::Sent(_)) { "sent" } else { "delivered" };
                let were = if count == 1 { "was" } else { "were" };
                format!("{count} {were} {verb}")
            }
            atom => fact(atom, self.holds, scene),
        }
    }

    fn count(&self, packets: &Packets, scene: &Scene) -> u64 {
        let counted = scene.radio.of_kind(packets.kind, packets.from, packets.to);
        if matches!(self.condition, Condition::Sent(_)) { counted.on_air() } else { counted.delivered }
    }
}

fn holds(condition: &Condition, scene: &Scene) -> bool {
    let of = |robot: &RobotId, test: &dyn Fn(&RobotScene) -> bool| scene.robot(*robot).is_some_and(test);
    match condition {
        Condition::RoleOf(robot, role) => of(robot, &|it| it.role == role),
        Condition::ActingAs(robot, role) => of(robot, &|it| it.acting_as == role),
        Condition::ActivityOf(robot, names) => of(robot, &|it| names.iter().any(|name| it.activity == name)),
        Condition::Claims(robot) => of(robot, &|it| it.claims),
        Condition::Holder { robot, seen_by } => {
            let mut eyes = eyes(scene, *robot, *seen_by).peekable();
            eyes.peek().is_some() && eyes.all(|it| it.holder == Some(robot.number))
        }
        Condition::Goes(robot) => of(robot, &|it| it.on && it.goes),
        Condition::Going { team, at_least, at_most } => {
            let going = scene.going(*team);
            at_least.is_none_or(|least| going >= least) && at_most.is_none_or(|most| going <= most)
        }
        Condition::Booker { robot, seen_by } => {
            let mut eyes = eyes(scene, *robot, *seen_by).peekable();
            eyes.peek().is_some() && eyes.all(|it| it.booker == Some(robot.number))
        }
        Condition::Locked { robot, by } => {
            of(robot, &|it| it.locked_by.is_some_and(|locked_by| by.is_none_or(|by| by.number == locked_by)))
        }
        Condition::Unlocked(team) => locked(scene, *team).next().is_none(),
        Condition::Distance { from, to, below, above } => {
            distance(scene, *from, *to).is_some_and(|metres| within(metres, *below, *above))
        }
        Condition::Speed { of, below, above } => {
            scene.speed(*of).is_some_and(|speed| within(speed, *below, *above))
        }
        Condition::InZone { what, zone } => {
            scene.position(*what).is_some_and(|point| scene.contains(*zone, point))
        }
        Condition::Goals { team, at_least, at_most } => {
            let goals = scene.score[team.index()];
            at_least.is_none_or(|least| goals >= least) && at_most.is_none_or(|most| goals <= most)
        }
        Condition::RolesDistinct(team) => {
            scene.switched_on(*team).next().is_some() && same_role(scene, *team).is_none()
        }
        Condition::RolesAre(team, roles) => {
            roles.iter().all(|(number, role)| of(&RobotId::new(*team, *number), &|it| it.role == role))
        }
        Condition::ConfigurationsAgree(team) => {
            let mut known = scene.switched_on(*team).map(|it| it.configuration);
            known.next().flatten().is_some_and(|first| known.all(|other| other == Some(first)))
        }
        // Their watches see to these.
        Condition::Sent(_)
        | Condition::Delivered(_)
        | Condition::All(_)
        | Condition::Any(_)
        | Condition::Not(_)
        | Condition::For { .. } => false,
    }
}

/// The values behind a condition that `held` or not.
fn fact(condition: &Condition, held: bool, scene: &Scene) -> String {
    let not = |wanted: &str| if held { String::new() } else { format!(", not {wanted}") };
    let of = |robot: &RobotId, words: &dyn Fn(&RobotScene) -> String| match scene.robot(*robot) {
        Some(it) => format!("{robot} {}", words(it)),
        None => format!("{robot} did not take part"),
    };
    match condition {
        Condition::RoleOf(robot, role) => of(robot, &|it| format!("was {}{}", it.role, not(role))),
        Condition::ActingAs(robot, role) => {
            of(robot, &|it| format!("acted as {}{}", it.acting_as, not(role)))
        }
        Condition::ActivityOf(robot, names) => {
            of(robot, &|it| format!("was in {}{}", it.activity, not(&list(names, " or "))))
        }
        Condition::Claims(robot) => {
            of(robot, &|it| if it.claims { "claimed the ball" } else { "did not claim the ball" }.into())
        }
        Condition::Holder { robot, seen_by } => {
            let mut beliefs = eyes(scene, *robot, *seen_by).map(|it| match it.holder {
                Some(holder) => {
                    format!("{} took {} for the holder", it.id, RobotId::new(robot.team, holder))
                }
                None => format!("{} knew no holder", it.id),
            });
            list(&mut beliefs, ", ").non_empty_or("no team mate was switched on")
        }
        Condition::Goes(robot) => {
            of(robot, &|it| if it.goes { "went for the ball" } else { "did not go for the ball" }.into())
        }
        Condition::Going { team, .. } => {
            let going = scene.switched_on(*team).filter(|it| it.goes).map(|it| it.id.to_string());
            list(going, " and ").non_empty_or("nobody") + " went for the ball"
        }
        Condition::Booker { robot, seen_by } => {
            let mut beliefs = eyes(scene, *robot, *seen_by).map(|it| match it.booker {
                Some(booker) => {
                    format!("{} took {} for the booker", it.id, RobotId::new(robot.team, booker))
                }
                None => format!("{} knew no booker", it.id),
            });
            list(&mut beliefs, ", ").non_empty_or("no team mate was switched on")
        }
        Condition::Locked { robot, .. } => of(robot, &|it| match it.locked_by {
            Some(by) => format!("was locked by {}", RobotId::new(robot.team, by)),
            None => "was not locked".into(),
        }),
        Condition::Unlocked(team) => {
            let locked = locked(scene, *team);
            let locked = locked.map(|(id, by)| format!("{id} was locked by {}", RobotId::new(*team, by)));
            list(locked, " and ").non_empty_or("no robot was locked")
        }
        Condition::Distance { from, to, .. } => match distance(scene, *from, *to) {
            Some(metres) => format!("{from} was {metres:.2} m from {to}"),
            None => format!("{from} or {to} did not take part"),
        },
        Condition::Speed { of, .. } => match scene.speed(*of) {
            Some(speed) => format!("{of} went at {speed:.2} m/s"),
            None => format!("{of} did not take part"),
        },
        Condition::InZone { what, .. } => match scene.position(*what) {
            Some(point) => format!("{what} was at {}", metres_of(point)),
            None => format!("{what} did not take part"),
        },
        Condition::Goals { team, .. } => format!("{team} had scored {}", scene.score[team.index()]),
        Condition::RolesDistinct(team) => match same_role(scene, *team) {
            Some((a, b)) => format!("{} and {} were both {}", a.id, b.id, a.role),
            None => roles(scene, *team),
        },
        Condition::RolesAre(team, wanted) => {
            let telling = wanted.iter().filter_map(|(number, role)| {
                let robot = RobotId::new(*team, *number);
                let fits = scene.robot(robot).is_some_and(|it| it.role == role);
                let not = if fits { String::new() } else { format!(", not {role}") };
                (fits == held).then(|| of(&robot, &|it| format!("was {}{not}", it.role)))
            });
            list(telling, " and ")
        }
        Condition::ConfigurationsAgree(team) => configurations(scene, *team),
        composite => composite.to_string(),
    }
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

fn distance(scene: &Scene, from: Thing, to: Thing) -> Option<f32> {
    Some(scene.position(from)?.distance(scene.position(to)?))
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
