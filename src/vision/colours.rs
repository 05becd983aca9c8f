//! Colour classes, and what each looks like to a camera.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::image::Yuv;
use crate::data::{Fault, Validate, ensure};
use crate::ids::Team;

/// The colours that mean something on a pitch of both leagues. Their order is the order in which a pixel that fits several is
/// decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum ColourClass {
    /// The ball.
    Orange,
    /// The goal that stands in the west.
    Yellow,
    /// The goal that stands in the east.
    SkyBlue,
    /// The beacons, together with the colour of a goal.
    Pink,
    /// Markers of the home team.
    Red,
    /// Markers of the away team.
    DarkBlue,
    /// Lines and walls.
    White,
    /// The carpet.
    Green,
}

impl ColourClass {
    /// All of them, in order.
    pub const ALL: [ColourClass; 8] = [
        ColourClass::Orange,
        ColourClass::Yellow,
        ColourClass::SkyBlue,
        ColourClass::Pink,
        ColourClass::Red,
        ColourClass::DarkBlue,
        ColourClass::White,
        ColourClass::Green,
    ];

    /// The colour of a team's markers.
    pub const fn marker(team: Team) -> ColourClass {
        match team {
            Team::Home => ColourClass::Red,
            Team::Away => ColourClass::DarkBlue,
        }
    }

    /// Its place among [all](ColourClass::ALL).
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// In words for people.
impl fmt::Display for ColourClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ColourClass::Orange => "orange",
            ColourClass::Yellow => "yellow",
            ColourClass::SkyBlue => "sky blue",
            ColourClass::Pink => "pink",
            ColourClass::Red => "red",
            ColourClass::DarkBlue => "dark blue",
            ColourClass::White => "white",
            ColourClass::Green => "green",
        })
    }
}

/// The pixels of a class: from the least to the greatest value of each channel, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColourBox {
    /// Brightness.
    pub y: (u8, u8),
    /// Blue against brightness.
    pub u: (u8, u8),
    /// Red against brightness.
    pub v: (u8, u8),
}

impl ColourBox {
    /// Whether a pixel is of the class.
    pub fn holds(&self, pixel: Yuv) -> bool {
        let within = |(least, most): (u8, u8), value: u8| (least..=most).contains(&value);
        within(self.y, pixel.y) && within(self.u, pixel.u) && within(self.v, pixel.v)
    }

    /// By a margin to both sides of each channel.
    pub fn widened(self, margin: u8) -> ColourBox {
        let wider = |(least, most): (u8, u8)| (least.saturating_sub(margin), most.saturating_add(margin));
        ColourBox { y: wider(self.y), u: wider(self.u), v: wider(self.v) }
    }

    /// The smallest box that holds both.
    pub fn joined(self, other: ColourBox) -> ColourBox {
        let both = |a: (u8, u8), b: (u8, u8)| (a.0.min(b.0), a.1.max(b.1));
        ColourBox { y: both(self.y, other.y), u: both(self.u, other.u), v: both(self.v, other.v) }
    }

    /// Without a pixel that it holds and what is beyond it on the nearest side; nothing, if nothing is left.
    pub fn without(self, pixel: Yuv) -> Option<ColourBox> {
        let (mut rest, channel_values) = (self, [pixel.y, pixel.u, pixel.v]);
        let channels = [&mut rest.y, &mut rest.u, &mut rest.v];
        let (channel, value) = channels
            .into_iter()
            .zip(channel_values)
            .min_by_key(|(channel, value)| (value - channel.0).min(channel.1 - value))?;
        if value - channel.0 < channel.1 - value {
            channel.0 = value + 1;
        } else {
            channel.1 = value.checked_sub(1).filter(|most| *most >= channel.0)?;
        }
        Some(rest)
    }
}

/// Thresholds for each class that a robot knows, as CMVision has them: a class that is missing is never seen.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ColourTable(pub BTreeMap<ColourClass, ColourBox>);

impl ColourTable {
    /// The first class that a pixel fits.
    pub fn class_of(&self, pixel: Yuv) -> Option<ColourClass> {
        self.0.iter().find(|(_, colour)| colour.holds(pixel)).map(|(class, _)| *class)
    }
}

impl Validate for ColourTable {
    fn validate(&self) -> Result<(), Fault> {
        self.0.iter().try_for_each(|(class, colour)| {
            [("y", colour.y), ("u", colour.u), ("v", colour.v)].into_iter().try_for_each(
                |(channel, (least, most))| {
                    ensure(least <= most, &format!("{class:?}.{channel}"), || {
                        format!("the least value, {least}, is greater than the greatest, {most}")
                    })
                },
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_of_the_first_class_that_it_fits() {
        let orange = ColourBox { y: (80, 200), u: (40, 110), v: (160, 230) };
        let wide = ColourBox { y: (0, 255), u: (0, 255), v: (150, 255) };
        let table = ColourTable(BTreeMap::from([(ColourClass::Orange, orange), (ColourClass::Red, wide)]));
        let class = |y, u, v| table.class_of(Yuv { y, u, v });
        assert_eq!(class(80, 110, 160), Some(ColourClass::Orange), "edges are included");
        assert_eq!(class(79, 110, 160), Some(ColourClass::Red));
        assert_eq!(class(79, 110, 149), None);
    }

    #[test]
    fn a_box_whose_ends_are_exchanged_is_a_fault_at_its_channel() {
        let wrong = ColourBox { y: (0, 255), u: (120, 110), v: (0, 255) };
        let table = ColourTable(BTreeMap::from([(ColourClass::Pink, wrong)]));
        let fault = table.validate().unwrap_err();
        assert!(format!("{fault:?}").contains("120"), "{fault:?}");
    }
}
