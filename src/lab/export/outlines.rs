//! What a robot looks like from above: the true outlines of its parts, and what tells its team, its number and its heading.

use bevy::math::Vec2;
use serde::Serialize;

use crate::geometry::unit;
use crate::robot::{Drive, RobotKind, jaws};

/// What a part of a robot goes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyPart {
    /// The drive unit, or the trunk of a walker.
    Unit,
    /// The trailer.
    Trailer,
    /// The head, which turns around its joint.
    Head,
}

/// How a part is painted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ink {
    /// Dark, with a line around.
    Body,
    /// As the line around bodies.
    Edge,
    /// In the team's colour.
    Team,
    /// Pale.
    Head,
    /// Dark, without a line.
    Dark,
}

/// A part of a robot, filled. Those that come later lie over those before.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyOutline {
    /// What it goes with.
    pub of: BodyPart,
    /// How it is painted.
    pub ink: Ink,
    /// Its corners in the frame of what it goes with, m.
    pub points: Vec<Vec2>,
}

/// All that is drawn of a kind of robot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobotOutlines {
    /// Its parts.
    pub parts: Vec<BodyOutline>,
    /// What bears the robot's number.
    pub plate_on: BodyPart,
    /// The middle of that plate, m.
    pub plate: Vec2,
    /// Half the size of the plate, m.
    pub plate_half: f32,
    /// Where the head turns, in the frame of the unit, m.
    pub neck: Vec2,
    /// The radius of a circle around the unit's centre that holds the unit, m.
    pub reach: f32,
}

/// Half the size of a plate as a share of how far a trailer reaches back, and the room between the two.
const ON_TRAILER: (f32, f32) = (0.27, 0.012);
/// Half the size of a plate on a body and how far behind the middle it is, as shares of the body's length.
const ON_BODY: (f32, f32) = (0.22, 0.2);

impl RobotOutlines {
    /// Those of a kind.
    pub fn of(kind: &RobotKind) -> RobotOutlines {
        let mut parts = Vec::new();
        let half = Vec2::new(kind.body.length, kind.body.width) / 2.0;
        let (plate_on, plate, plate_half) = match &kind.trailer {
            Some(trailer) => {
                parts.push(BodyOutline {
                    of: BodyPart::Trailer,
                    ink: Ink::Body,
                    points: trailer.outline.clone(),
                });
                let back = trailer.outline.iter().map(|corner| -corner.x).fold(half.x, f32::max);
                let size = ON_TRAILER.0 * back;
                (BodyPart::Trailer, Vec2::X * (size + ON_TRAILER.1 - back), size)
            }
            None => {
                let length = kind.body.length;
                (BodyPart::Unit, Vec2::X * (-ON_BODY.1 * length), ON_BODY.0 * length)
            }
        };
        let plate_outline = BodyOutline {
            of: plate_on,
            ink: Ink::Team,
            points: box_at(plate, Vec2::splat(plate_half)).into(),
        };
        let is_behind = plate_on == BodyPart::Trailer;
        parts.extend(is_behind.then(|| plate_outline.clone()));
        let neck = match kind.drive {
            Drive::Differential(_) => {
                parts.extend(wheeled(kind, half));
                Vec2::ZERO
            }
            Drive::Walker(_) => {
                parts.extend(walking(half));
                WalkerOutline { half }.neck()
            }
        };
        parts.extend((!is_behind).then_some(plate_outline));
        RobotOutlines { parts, plate_on, plate, plate_half, neck, reach: kind.reach() }
    }
}

fn on_unit(ink: Ink, points: impl Into<Vec<Vec2>>) -> BodyOutline {
    BodyOutline { of: BodyPart::Unit, ink, points: points.into() }
}

/// A box with its jaws, and a chevron that points ahead.
fn wheeled(kind: &RobotKind, half: Vec2) -> Vec<BodyOutline> {
    let mut parts = vec![on_unit(Ink::Body, box_at(Vec2::ZERO, half))];
    parts.extend(jaws(kind).into_iter().map(|jaw| on_unit(Ink::Edge, jaw)));
    parts.extend(chevron(half).map(|bar| on_unit(Ink::Team, bar)));
    parts
}

/// Two bars that meet ahead, for a body of this half size, m.
pub fn chevron(half: Vec2) -> [[Vec2; 4]; 2] {
    let reach = Vec2::new(0.62 * half.x, 0.55 * half.y.min(2.0 * half.x));
    let thick = Vec2::X * (0.55 * half.x);
    [1.0, -1.0].map(|side| {
        let (tip, tail) = (Vec2::new(reach.x, 0.0), Vec2::new(thick.x - reach.x, side * reach.y));
        [tip, tail, tail - thick, tip - thick]
    })
}

/// Paws, a trunk, and a head that narrows to the muzzle, with ears and a dark nose.
fn walking(half: Vec2) -> Vec<BodyOutline> {
    let walker = WalkerOutline { half };
    let paws = walker.hind_paws().into_iter().chain(walker.front_paws());
    let mut parts: Vec<BodyOutline> = paws.map(|at| on_unit(Ink::Edge, walker.paw(at))).collect();
    parts.push(on_unit(Ink::Body, walker.trunk()));
    let on_head = |ink, points: Vec<Vec2>| BodyOutline { of: BodyPart::Head, ink, points };
    parts.extend(walker.ears().map(|ear| on_head(Ink::Dark, ear.into())));
    parts.push(on_head(Ink::Head, walker.skull()));
    parts.push(on_head(Ink::Dark, walker.nose()));
    parts
}

/// The parts of a robot on four legs with a body of this half size, m: paws and trunk in the frame of the body, the parts of the
/// head around its joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkerOutline {
    /// Half the length and half the width of its body.
    pub half: Vec2,
}

impl WalkerOutline {
    fn at(self, x: f32, y: f32) -> Vec2 {
        Vec2::new(x, y) * self.half
    }

    /// Where the head turns.
    pub fn neck(self) -> Vec2 {
        self.at(0.55, 0.0)
    }

    /// The middles of the hind paws, the left one first.
    pub fn hind_paws(self) -> [Vec2; 2] {
        [1.0, -1.0].map(|side| self.at(-0.7, 0.79 * side))
    }

    /// The middles of the front paws, the left one first.
    pub fn front_paws(self) -> [Vec2; 2] {
        [1.0, -1.0].map(|side| self.at(0.72, 0.79 * side))
    }

    /// A paw around its middle.
    pub fn paw(self, middle: Vec2) -> Vec<Vec2> {
        rounded_box_at(middle, self.at(0.26, 0.2), 0.18 * self.half.y)
    }

    /// The trunk.
    pub fn trunk(self) -> Vec<Vec2> {
        rounded_box_at(self.at(-0.12, 0.0), self.at(0.82, 0.8), 0.45 * self.half.y)
    }

    /// The ears, the left one first.
    pub fn ears(self) -> [[Vec2; 4]; 2] {
        let corners = [(0.0, 0.42), (-0.28, 0.78), (-0.3, 0.5), (-0.16, 0.36)];
        [1.0, -1.0].map(|side| corners.map(|(x, y)| self.at(x, side * y)))
    }

    /// A skull that narrows to the muzzle.
    pub fn skull(self) -> Vec<Vec2> {
        let right = [(-0.22, 0.18), (-0.18, 0.4), (0.02, 0.5), (0.22, 0.42), (0.48, 0.3), (0.6, 0.12)]
            .map(|(x, y)| self.at(x, -y));
        let left = right.into_iter().rev().map(|corner| Vec2::new(corner.x, -corner.y));
        right.into_iter().chain(left).collect()
    }

    /// The nose.
    pub fn nose(self) -> Vec<Vec2> {
        rounded_box_at(self.at(0.5, 0.0), self.at(0.1, 0.14), 0.1 * self.half.y)
    }
}

/// The corners of a box around a point.
pub fn box_at(centre: Vec2, half: Vec2) -> [Vec2; 4] {
    [Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0), Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0)]
        .map(|corner| centre + corner * half)
}

/// The corners of a box with rounded corners around a point, counter-clockwise.
pub fn rounded_box_at(centre: Vec2, half: Vec2, radius: f32) -> Vec<Vec2> {
    const STEPS: u8 = 5;
    let radius = radius.min(half.x).min(half.y);
    let quarter = std::f32::consts::FRAC_PI_2;
    box_at(Vec2::ZERO, half - radius)
        .into_iter()
        .zip(0_u8..)
        .flat_map(|(inner, turns)| {
            (0..STEPS).map(move |step| {
                let angle = quarter * (f32::from(turns) + f32::from(step) / f32::from(STEPS - 1));
                centre + inner + radius * unit(angle)
            })
        })
        .collect()
}
