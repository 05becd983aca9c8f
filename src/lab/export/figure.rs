//! A picture as figures in metres of the pitch frame, whatever it is written as.

use bevy::math::Vec2;

/// A colour and how opaque it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// Red, green and blue in the three lower bytes.
    pub colour: u32,
    /// 0 to 1.
    pub opacity: f32,
}

impl Tint {
    /// An opaque colour.
    pub const fn solid(colour: u32) -> Tint {
        Tint { colour, opacity: 1.0 }
    }

    /// One that lets through what is under it.
    pub const fn faint(colour: u32, opacity: f32) -> Tint {
        Tint { colour, opacity }
    }
}

/// A figure of a drawing. Lengths are metres.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Figure {
    /// A filled polygon.
    Polygon { points: Vec<Vec2>, fill: Tint },
    /// A line of some width through points, dashed if dashes have a length.
    Line { points: Vec<Vec2>, closed: bool, width: f32, tint: Tint, dash: Option<f32> },
    /// A filled disc.
    Disc { centre: Vec2, radius: f32, fill: Tint },
    /// A circle of some width, dashed if dashes have a length.
    Circle { centre: Vec2, radius: f32, width: f32, tint: Tint, dash: Option<f32> },
    /// Upright text around a point, as high as its digits are.
    Text { at: Vec2, height: f32, text: String, tint: Tint },
}

/// A picture: figures in the order in which they lie over each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Half of its length and width around the pitch's middle, m.
    pub half: Vec2,
    /// What is around.
    pub ground: u32,
    /// Its figures.
    pub figures: Vec<Figure>,
}
