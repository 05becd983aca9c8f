//! From a strategy file to a strategy: looks every name up, checks every number, and numbers the memories of stateful
//! operators. The first fault is reported with its place in the file.

use std::collections::BTreeMap;

use super::file::{AssemblageFile, MachineFile, RoleFile, StateFile, StrategyFile, TurnFile};
use super::language::{Feature, Point, Points, Schema, ZoneName};
use super::{
    Assemblage, Combination, Machine, Part, RoleSpec, State, Strategy, SubRole, Term, Transition, Turn,
};
use crate::data::{DataError, Field, Source};

type Result<T> = std::result::Result<T, DataError>;

pub(super) fn resolve(file: &StrategyFile, source: &Source) -> Result<Strategy> {
    let mut resolver = Resolver { file, source, slots: 0, open: Vec::new() };
    let root = Field::default();
    resolver.check_named_pieces()?;
    let assemblages = (file.assemblages.iter())
        .map(|(name, assemblage)| resolver.assemblage(name, assemblage, &root.key("assemblages").key(name)))
        .collect::<Result<Vec<_>>>()?;
    let machines = (file.machines.iter())
        .map(|(name, machine)| resolver.machine(name, machine, &root.key("machines").key(name)))
        .collect::<Result<Vec<_>>>()?;
    let roles = (file.roles.iter())
        .map(|(name, role)| resolver.role(name, role, &root.key("roles").key(name)))
        .collect::<Result<Vec<_>>>()?;
    let players = resolver.players(&root.key("players"))?;
    resolver.kick_off(players.len())?;
    Ok(Strategy {
        name: file.name.clone(),
        description: file.description.clone(),
        robot_kinds: file.robot_kinds.clone(),
        roles,
        players,
        kick_off: file.kick_off.clone(),
        machines,
        assemblages,
        slots: resolver.slots,
    })
}

struct Resolver<'a> {
    file: &'a StrategyFile,
    source: &'a Source,
    slots: usize,
    /// Names that are being looked up, to notice one that is defined by itself.
    open: Vec<String>,
}

impl Resolver<'_> {
    fn fault<T>(&self, at: &Field, message: impl Into<String>) -> Result<T> {
        Err(self.source.error_at(at, message))
    }

    /// The place of a name among the keys of a map.
    fn index<T>(&self, map: &BTreeMap<String, T>, what: &str, name: &str, at: &Field) -> Result<usize> {
        match map.keys().position(|key| key == name) {
            Some(index) => Ok(index),
            None => self.fault(at, unknown(map, what, name)),
        }
    }

    fn finite(&self, value: f32, at: &Field) -> Result<f32> {
        if value.is_finite() {
            Ok(value)
        } else {
            self.fault(at, format!("{value} is not a number to work with"))
        }
    }

    fn not_negative(&self, value: f32, at: &Field) -> Result<f32> {
        if value.is_finite() && value >= 0.0 {
            Ok(value)
        } else {
            self.fault(at, format!("must be a number of at least 0, not {value}"))
        }
    }

    fn slot(&mut self) -> usize {
        self.slots += 1;
        self.slots - 1
    }

    /// Checks what is named but perhaps never used.
    fn check_named_pieces(&mut self) -> Result<()> {
        let root = Field::default();
        for (name, zone) in &self.file.zones {
            if !zone.is_finite() {
                return self.fault(&root.key("zones").key(name), "needs finite corners, min below max");
            }
        }
        for (name, point) in &self.file.percepts {
            self.point(point, &root.key("percepts").key(name))?;
        }
        for (name, points) in &self.file.point_sets {
            self.points(points, &root.key("point_sets").key(name))?;
        }
        for (name, feature) in &self.file.features {
            self.feature(feature, &root.key("features").key(name))?;
        }
        for (name, schema) in &self.file.schemas {
            self.schema(schema, &root.key("schemas").key(name))?;
        }
        self.slots = 0;
        Ok(())
    }

    /// Replaces a name by its definition, unless it is defined by itself.
    fn expand<T: Clone, R>(
        &mut self,
        map: &BTreeMap<String, T>,
        what: &str,
        name: &str,
        at: &Field,
        resolve: impl FnOnce(&mut Self, &T) -> Result<R>,
    ) -> Result<R> {
        let Some(definition) = map.get(name) else {
            return self.fault(at, unknown(map, what, name));
        };
        let key = format!("{what} {name}");
        if self.open.contains(&key) {
            return self.fault(at, format!("`{name}` is defined by itself"));
        }
        self.open.push(key);
        let resolved = resolve(self, definition);
        self.open.pop();
        resolved
    }

    fn boxed(&mut self, point: &Point, at: &Field) -> Result<Box<Point>> {
        self.point(point, at).map(Box::new)
    }

    fn point(&mut self, point: &Point, at: &Field) -> Result<Point> {
        Ok(match point {
            Point::Named(name) => {
                return self.expand(&self.file.percepts, "percept", name, at, |s, p| s.point(p, at));
            }
            Point::Ball | Point::OurGoal | Point::TheirGoal | Point::Homebase | Point::Own => point.clone(),
            Point::BallIn(seconds) => Point::BallIn(self.not_negative(*seconds, at)?),
            Point::At(place) if place.is_finite() => point.clone(),
            Point::At(_) => return self.fault(at, "needs finite coordinates"),
            Point::Closest(of) => Point::Closest(Box::new(self.points(of, &at.index(0))?)),
            Point::Average(of) => Point::Average(Box::new(self.points(of, &at.index(0))?)),
            Point::Midpoint(a, b) => {
                Point::Midpoint(self.boxed(a, &at.index(0))?, self.boxed(b, &at.index(1))?)
            }
            Point::Moved { of, from, to } => Point::Moved {
                of: self.boxed(of, &at.key("of"))?,
                from: self.boxed(from, &at.key("from"))?,
                to: self.boxed(to, &at.key("to"))?,
            },
            Point::Toward { from, to, distance } => Point::Toward {
                from: self.boxed(from, &at.key("from"))?,
                to: self.boxed(to, &at.key("to"))?,
                distance: self.finite(*distance, &at.key("distance"))?,
            },
            Point::SweetSpot { of, toward, offset } => Point::SweetSpot {
                of: self.boxed(of, &at.key("of"))?,
                toward: self.boxed(toward, &at.key("toward"))?,
                offset: self.finite(*offset, &at.key("offset"))?,
            },
            Point::Intercept { max_speed } => {
                Point::Intercept { max_speed: self.not_negative(*max_speed, &at.key("max_speed"))? }
            }
            Point::Into { zone, point } => Point::Into {
                zone: self.zone(zone, &at.key("zone"))?,
                point: self.boxed(point, &at.key("point"))?,
            },
        })
    }

    fn share(&self, value: f32, at: &Field) -> Result<f32> {
        if (0.0..=1.0).contains(&value) {
            Ok(value)
        } else {
            self.fault(at, format!("must lie between 0 and 1, not {value}"))
        }
    }

    fn points(&mut self, points: &Points, at: &Field) -> Result<Points> {
        Ok(match points {
            Points::Named(name) => {
                return self.expand(&self.file.point_sets, "point set", name, at, |s, p| s.points(p, at));
            }
            Points::Teammates | Points::Opponents | Points::Walls => points.clone(),
            Points::These(list) => Points::These(
                list.iter().enumerate().map(|(i, p)| self.point(p, &at.index(i))).collect::<Result<_>>()?,
            ),
            Points::Union(sets) => Points::Union(
                sets.iter().enumerate().map(|(i, p)| self.points(p, &at.index(i))).collect::<Result<_>>()?,
            ),
            Points::Within { of, radius } => Points::Within {
                of: Box::new(self.points(of, &at.key("of"))?),
                radius: self.not_negative(*radius, &at.key("radius"))?,
            },
            Points::WithinOrClosest { of, radius } => Points::WithinOrClosest {
                of: Box::new(self.points(of, &at.key("of"))?),
                radius: self.not_negative(*radius, &at.key("radius"))?,
            },
            Points::FartherThan { of, from, radius } => Points::FartherThan {
                of: Box::new(self.points(of, &at.key("of"))?),
                from: self.boxed(from, &at.key("from"))?,
                radius: self.not_negative(*radius, &at.key("radius"))?,
            },
            Points::Remember { of, seconds, merge, blend, .. } => Points::Remember {
                of: Box::new(self.points(of, &at.key("of"))?),
                seconds: self.not_negative(*seconds, &at.key("seconds"))?,
                merge: self.not_negative(*merge, &at.key("merge"))?,
                blend: self.share(*blend, &at.key("blend"))?,
                slot: self.slot(),
            },
            Points::Shifted { of, by } if by.is_finite() => {
                Points::Shifted { of: Box::new(self.points(of, &at.key("of"))?), by: *by }
            }
            Points::Shifted { .. } => return self.fault(&at.key("by"), "needs finite coordinates"),
        })
    }

    fn zone(&mut self, zone: &ZoneName, at: &Field) -> Result<ZoneName> {
        match zone {
            ZoneName::Named(name) => match self.file.zones.get(name) {
                Some(zone) => Ok(ZoneName::Exactly(*zone)),
                None => self.fault(at, unknown(&self.file.zones, "zone", name)),
            },
            ZoneName::Exactly(zone) if !zone.is_finite() => {
                self.fault(at, "needs finite corners, min below max")
            }
            ZoneName::Exactly(_) | ZoneName::DangerZone | ZoneName::PenaltyArea => Ok(zone.clone()),
        }
    }

    fn feature(&mut self, feature: &Feature, at: &Field) -> Result<Feature> {
        Ok(match feature {
            Feature::Is(name) => {
                return self.expand(&self.file.features, "feature", name, at, |s, f| s.feature(f, at));
            }
            Feature::Always => Feature::Always,
            Feature::Not(what) => Feature::Not(Box::new(self.feature(what, &at.index(0))?)),
            Feature::All(list) => Feature::All(self.features(list, at)?),
            Feature::Any(list) => Feature::Any(self.features(list, at)?),
            Feature::Known(point) => Feature::Known(self.point(point, &at.index(0))?),
            Feature::BallSeenWithin(seconds) => Feature::BallSeenWithin(self.not_negative(*seconds, at)?),
            Feature::Near { a, b, radius } => Feature::Near {
                a: self.point(a, &at.key("a"))?,
                b: self.point(b, &at.key("b"))?,
                radius: self.not_negative(*radius, &at.key("radius"))?,
            },
            Feature::NearLatch { a, b, enter, leave, .. } => Feature::NearLatch {
                a: self.point(a, &at.key("a"))?,
                b: self.point(b, &at.key("b"))?,
                enter: self.not_negative(*enter, &at.key("enter"))?,
                leave: self.not_negative(*leave, &at.key("leave"))?,
                slot: self.slot(),
            },
            Feature::NearerThan { a, b } => {
                Feature::NearerThan { a: self.point(a, &at.key("a"))?, b: self.point(b, &at.key("b"))? }
            }
            Feature::In { zone, point } => Feature::In {
                zone: self.zone(zone, &at.key("zone"))?,
                point: self.point(point, &at.key("point"))?,
            },
            Feature::Facing { point, within } => Feature::Facing {
                point: self.point(point, &at.key("point"))?,
                within: self.not_negative(*within, &at.key("within"))?,
            },
            Feature::BehindBall { toward, within } => Feature::BehindBall {
                toward: self.point(toward, &at.key("toward"))?,
                within: self.not_negative(*within, &at.key("within"))?,
            },
            Feature::BallInScoop { gap, aside } => Feature::BallInScoop {
                gap: self.not_negative(*gap, &at.key("gap"))?,
                aside: self.not_negative(*aside, &at.key("aside"))?,
            },
            Feature::Stalled(seconds) => Feature::Stalled(self.not_negative(*seconds, at)?),
            Feature::After(seconds) => Feature::After(self.not_negative(*seconds, at)?),
            Feature::HoldFor { what, seconds, .. } => Feature::HoldFor {
                what: Box::new(self.feature(what, &at.key("what"))?),
                seconds: self.not_negative(*seconds, &at.key("seconds"))?,
                slot: self.slot(),
            },
            Feature::Lasting { what, seconds, .. } => Feature::Lasting {
                what: Box::new(self.feature(what, &at.key("what"))?),
                seconds: self.not_negative(*seconds, &at.key("seconds"))?,
                slot: self.slot(),
            },
            Feature::Watchdog { what, patience, seconds, .. } => Feature::Watchdog {
                what: Box::new(self.feature(what, &at.key("what"))?),
                patience: self.not_negative(*patience, &at.key("patience"))?,
                seconds: self.not_negative(*seconds, &at.key("seconds"))?,
                slot: self.slot(),
            },
        })
    }

    fn features(&mut self, list: &[Feature], at: &Field) -> Result<Vec<Feature>> {
        list.iter().enumerate().map(|(i, feature)| self.feature(feature, &at.index(i))).collect()
    }

    fn schema(&mut self, schema: &Schema, at: &Field) -> Result<Schema> {
        Ok(match schema {
            Schema::GoTo { target, controlled_zone, dead_zone } => {
                let target = self.point(target, &at.key("target"))?;
                let (controlled_zone, dead_zone) = self.attraction(*controlled_zone, *dead_zone, at)?;
                Schema::GoTo { target, controlled_zone, dead_zone }
            }
            Schema::GoToAll { targets, controlled_zone, dead_zone } => {
                let targets = self.points(targets, &at.key("targets"))?;
                let (controlled_zone, dead_zone) = self.attraction(*controlled_zone, *dead_zone, at)?;
                Schema::GoToAll { targets, controlled_zone, dead_zone }
            }
            Schema::AttractNear { to, sphere, safety } => {
                let to = self.points(to, &at.key("to"))?;
                let (sphere, safety) = self.repulsion(*sphere, *safety, at)?;
                Schema::AttractNear { to, sphere, safety }
            }
            Schema::Avoid { of, sphere, safety } => {
                let of = self.points(of, &at.key("of"))?;
                let (sphere, safety) = self.repulsion(*sphere, *safety, at)?;
                Schema::Avoid { of, sphere, safety }
            }
            Schema::Swirl { around, toward, sphere, safety } => {
                let around = self.points(around, &at.key("around"))?;
                let toward = self.point(toward, &at.key("toward"))?;
                let (sphere, safety) = self.repulsion(*sphere, *safety, at)?;
                Schema::Swirl { around, toward, sphere, safety }
            }
            Schema::SwirlLeft { around, sphere, safety } => {
                let around = self.points(around, &at.key("around"))?;
                let (sphere, safety) = self.repulsion(*sphere, *safety, at)?;
                Schema::SwirlLeft { around, sphere, safety }
            }
            Schema::GeoField { around, toward, sphere, safety } => {
                let around = self.points(around, &at.key("around"))?;
                let toward = self.point(toward, &at.key("toward"))?;
                let (sphere, safety) = self.repulsion(*sphere, *safety, at)?;
                Schema::GeoField { around, toward, sphere, safety }
            }
            Schema::Noise { period, .. } => {
                Schema::Noise { period: self.not_negative(*period, &at.key("period"))?, slot: self.slot() }
            }
            Schema::DockBehind { ball, toward, standoff, enter_cone, leave_cone, .. } => Schema::DockBehind {
                ball: self.point(ball, &at.key("ball"))?,
                toward: self.point(toward, &at.key("toward"))?,
                standoff: self.not_negative(*standoff, &at.key("standoff"))?,
                enter_cone: self.not_negative(*enter_cone, &at.key("enter_cone"))?,
                leave_cone: self.not_negative(*leave_cone, &at.key("leave_cone"))?,
                slot: self.slot(),
            },
            Schema::Dribble { ball, toward, tight } => Schema::Dribble {
                ball: self.point(ball, &at.key("ball"))?,
                toward: self.point(toward, &at.key("toward"))?,
                tight: self.not_negative(*tight, &at.key("tight"))?,
            },
            Schema::Constant(vector) if vector.is_finite() => schema.clone(),
            Schema::Constant(_) => return self.fault(at, "needs finite coordinates"),
        })
    }

    fn attraction(&self, controlled: f32, dead: f32, at: &Field) -> Result<(f32, f32)> {
        self.not_negative(controlled, &at.key("controlled_zone"))?;
        self.not_negative(dead, &at.key("dead_zone"))?;
        if dead > controlled {
            return self.fault(
                &at.key("dead_zone"),
                format!("the dead zone of {dead} m is larger than the controlled zone of {controlled} m"),
            );
        }
        Ok((controlled, dead))
    }

    fn repulsion(&self, sphere: f32, safety: f32, at: &Field) -> Result<(f32, f32)> {
        self.not_negative(sphere, &at.key("sphere"))?;
        self.not_negative(safety, &at.key("safety"))?;
        if safety > sphere {
            return self.fault(
                &at.key("safety"),
                format!("the safety radius of {safety} m is larger than the sphere of {sphere} m"),
            );
        }
        Ok((sphere, safety))
    }

    fn assemblage(&mut self, name: &str, file: &AssemblageFile, at: &Field) -> Result<Assemblage> {
        let (combination, terms, at) = match file {
            AssemblageFile::WeightedSum(terms) => (Combination::WeightedSum, terms, at.key("WeightedSum")),
            AssemblageFile::WinnerTakeAll(terms) => (Combination::WinnerTakeAll, terms, at.key("WinnerTakeAll")),
        };
        let terms = (terms.iter().enumerate())
            .map(|(i, (weight, schema))| self.term(*weight, schema, &at.index(i)))
            .collect::<Result<_>>()?;
        Ok(Assemblage { name: name.into(), combination, terms })
    }

    fn term(&mut self, weight: f32, name: &str, at: &Field) -> Result<Term> {
        let weight = self.finite(weight, &at.index(0))?;
        let schema = self.expand(&self.file.schemas, "schema", name, &at.index(1), |s, schema| {
            s.schema(schema, &Field::default().key("schemas").key(name))
        })?;
        Ok(Term { weight, name: name.into(), schema })
    }

    fn machine(&mut self, name: &str, file: &MachineFile, at: &Field) -> Result<Machine> {
        let start = self.index(&file.states, "state", &file.start, &at.key("start"))?;
        let states = (file.states.iter())
            .map(|(name, state)| self.state(name, state, file, &at.key("states").key(name)))
            .collect::<Result<_>>()?;
        Ok(Machine { name: name.into(), start, states })
    }

    fn state(&mut self, name: &str, file: &StateFile, machine: &MachineFile, at: &Field) -> Result<State> {
        let assemblage = match &file.run {
            Some(run) => Some(self.index(&self.file.assemblages, "assemblage", run, &at.key("run"))?),
            None => None,
        };
        let turn = match &file.turn {
            TurnFile::Stay => Turn::Stay,
            TurnFile::Face(point) => Turn::Face(self.point(point, &at.key("turn"))?),
            TurnFile::Spin(rate) => Turn::Spin(self.finite(*rate, &at.key("turn"))?.to_radians()),
        };
        let mut transitions = Vec::with_capacity(file.on.len());
        for (i, transition) in file.on.iter().enumerate() {
            let at = at.key("on").index(i);
            transitions.push(Transition {
                when: self.feature(&transition.when, &at.key("when"))?,
                go: self.index(&machine.states, "state", &transition.go, &at.key("go"))?,
                label: transition.when.to_string(),
            });
        }
        Ok(State {
            name: name.into(),
            assemblage,
            speed: self.share(file.speed, &at.key("speed"))?,
            reverse: file.reverse,
            turn,
            transitions,
        })
    }

    fn role(&mut self, name: &str, file: &RoleFile, at: &Field) -> Result<RoleSpec> {
        let (tag, part) = match file {
            RoleFile::Plays { tag, machine, danger_zone, homebases } => {
                let machine = self.index(&self.file.machines, "machine", machine, &at.key("machine"))?;
                if !danger_zone.is_finite() {
                    return self.fault(&at.key("danger_zone"), "needs finite corners, min below max");
                }
                if homebases.is_empty() || homebases.iter().any(|home| !home.is_finite()) {
                    return self
                        .fault(&at.key("homebases"), "needs at least one homebase, all of them finite");
                }
                (tag, Part::Plays { machine, danger_zone: *danger_zone, homebases: homebases.clone() })
            }
            RoleFile::ActsAs { tag, sub_roles } => {
                let at = at.key("sub_roles");
                let mut list = Vec::with_capacity(sub_roles.len());
                for (i, sub_role) in sub_roles.iter().enumerate() {
                    let at = at.index(i);
                    let role = self.index(&self.file.roles, "role", &sub_role.role, &at.key("role"))?;
                    if !matches!(self.file.roles.get(&sub_role.role), Some(RoleFile::Plays { .. })) {
                        return self.fault(&at.key("role"), "a sub-role must be a role that plays a machine");
                    }
                    list.push(SubRole { when: self.feature(&sub_role.when, &at.key("when"))?, role });
                }
                if list.is_empty() {
                    return self.fault(&at, "needs at least one sub-role");
                }
                (tag, Part::ActsAs(list))
            }
        };
        Ok(RoleSpec { name: name.into(), tag: tag.clone(), part })
    }

    fn players(&self, at: &Field) -> Result<Vec<usize>> {
        if self.file.players.is_empty() || self.file.players.len() > MAX_PLAYERS {
            return self.fault(
                at,
                format!("a team has 1 to {MAX_PLAYERS} players, not {}", self.file.players.len()),
            );
        }
        (self.file.players.iter().enumerate())
            .map(|(i, role)| self.index(&self.file.roles, "role", role, &at.index(i)))
            .collect()
    }

    fn kick_off(&self, players: usize) -> Result<()> {
        for (side, places) in [("ours", &self.file.kick_off.ours), ("theirs", &self.file.kick_off.theirs)] {
            let at = Field::default().key("kick_off").key(side);
            if places.len() != players {
                return self.fault(&at, format!("{} places for {players} players", places.len()));
            }
            if let Some(i) = places.iter().position(|place| !(place.is_finite() && place.x <= 0.0)) {
                return self.fault(&at.index(i), "must lie in the team's own half: x of 0 at most");
            }
        }
        Ok(())
    }
}

/// Robots that one team can field.
const MAX_PLAYERS: usize = 8;

fn unknown<T>(map: &BTreeMap<String, T>, what: &str, name: &str) -> String {
    let known = map.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
    format!("there is no {what} `{name}`; known: {}", if known.is_empty() { "none" } else { &known })
}
