//! Pictures for tests: patches written as letters, in the nominal paints without light or noise.

use std::collections::BTreeMap;

use super::colours::{ColourBox, ColourClass, ColourTable};
use super::image::{Image, Yuv};
use super::paint::{HALL_GREY, paint};

/// Thresholds close around the nominal paints.
pub fn nominal_table() -> ColourTable {
    let channel = |value: u8| (value.saturating_sub(10), value.saturating_add(10));
    let colour = |class: ColourClass| {
        let Yuv { y, u, v } = colour_of(Some(class));
        (class, ColourBox { y: channel(y), u: channel(u), v: channel(v) })
    };
    ColourTable(BTreeMap::from(ColourClass::ALL.map(colour)))
}

/// A picture of rows of letters: the first of each colour's name, B for dark blue; anything else is grey.
pub fn picture(rows: &[&str]) -> Image {
    let class = |letter| match letter {
        'O' => Some(ColourClass::Orange),
        'Y' => Some(ColourClass::Yellow),
        'S' => Some(ColourClass::SkyBlue),
        'P' => Some(ColourClass::Pink),
        'R' => Some(ColourClass::Red),
        'B' => Some(ColourClass::DarkBlue),
        'W' => Some(ColourClass::White),
        'G' => Some(ColourClass::Green),
        _ => None,
    };
    let width = rows.first().map_or(0, |row| row.len());
    let pixels = rows.iter().flat_map(|row| row.chars()).map(|letter| colour_of(class(letter))).collect();
    Image { width, height: rows.len(), pixels }
}

/// The nominal colour of a class, or grey.
pub fn colour_of(class: Option<ColourClass>) -> Yuv {
    Yuv::from_rgb(class.map_or(HALL_GREY, paint))
}
