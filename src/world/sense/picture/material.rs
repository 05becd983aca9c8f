//! What a pixel shows, and how bright it is: one number a pixel.

use crate::vision::ColourClass;
use crate::vision::paint::{CLOTHES, DARK_GREY, FENCE_GREY, HALL_GREY, LIGHT_GREY, Rgb, paint};

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Material(u8);

/// Steps from bare carpet to a line that fills a pixel.
pub const LINE_STEPS: u8 = 7;
/// How bright a pixel can be, in steps.
pub const SHADES: usize = 64;
/// The brightest shade.
pub const TOP_SHADE: f32 = (SHADES - 1) as f32;
/// The shade of a surface that looks up, in the mean light of the hall.
pub const FULL_SHADE: f32 = 40.0;

impl Material {
    /// The floor beyond fences and walls.
    pub const BEYOND: Material = Material(LINE_STEPS + 1);
    /// See [`HALL_GREY`].
    pub const HALL: Material = Material(9);
    /// See [`FENCE_GREY`].
    pub const FENCE: Material = Material(10);
    /// See [`LIGHT_GREY`].
    pub const LIGHT: Material = Material(11);
    /// See [`DARK_GREY`].
    pub const DARK: Material = Material(12);
    const FIRST_CLOTHES: u8 = 13;
    const FIRST_CLASS: u8 = Material::FIRST_CLOTHES + CLOTHES.len() as u8;
    /// The number of materials.
    pub const COUNT: usize = Material::FIRST_CLASS as usize + ColourClass::ALL.len();

    /// Carpet of which a share of so many [steps](LINE_STEPS) is line.
    pub const fn floor(line: u8) -> Material {
        Material(line)
    }

    /// Something in the colour of a class.
    pub const fn of(class: ColourClass) -> Material {
        Material(Material::FIRST_CLASS + class.index() as u8)
    }

    /// One of the [clothes](CLOTHES).
    pub const fn clothes(index: usize) -> Material {
        Material(Material::FIRST_CLOTHES + (index % CLOTHES.len()) as u8)
    }

    /// Body paint.
    pub fn body(paint: Rgb) -> Material {
        if paint == LIGHT_GREY { Material::LIGHT } else { Material::DARK }
    }

    /// As a number below [their count](Material::COUNT).
    pub const fn index(self) -> u8 {
        self.0
    }

    /// The class that it really is of, if it is of one. A pixel of line and carpet is what most of it is.
    pub fn class(self) -> Option<ColourClass> {
        match self.0 {
            step if step <= LINE_STEPS / 2 => Some(ColourClass::Green),
            ..=LINE_STEPS => Some(ColourClass::White),
            number => ColourClass::ALL.get(usize::from(number.checked_sub(Material::FIRST_CLASS)?)).copied(),
        }
    }

    /// Its paint, in the hall's own light.
    pub fn paint(self) -> [f32; 3] {
        let of = |paint: Rgb| paint.map(f32::from);
        match self.0 {
            step @ ..=LINE_STEPS => {
                let share = f32::from(step) / f32::from(LINE_STEPS);
                let (line, carpet) = (of(paint(ColourClass::White)), of(paint(ColourClass::Green)));
                [0, 1, 2].map(|channel| carpet[channel] + share * (line[channel] - carpet[channel]))
            }
            number if (Material::FIRST_CLOTHES..Material::FIRST_CLASS).contains(&number) => {
                of(CLOTHES[usize::from(number - Material::FIRST_CLOTHES)])
            }
            _ => of(match self {
                Material::FENCE => FENCE_GREY,
                Material::LIGHT => LIGHT_GREY,
                Material::DARK => DARK_GREY,
                _ => self.class().map_or(HALL_GREY, paint),
            }),
        }
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Material> {
        (0..Material::COUNT as u8).map(Material)
    }
}

/// What a pixel shows and its shade.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tone(u16);

/// Bits of a tone that hold its shade.
const SHADE_BITS: u32 = SHADES.trailing_zeros();
/// One more than the largest [index](Tone::index), rounded up such that a bit mask keeps below it.
pub const TONES: usize = (Material::COUNT * SHADES).next_power_of_two();

impl Tone {
    /// A shade beyond the largest is an error of the caller and shows another material.
    pub const fn new(material: Material, shade: u16) -> Tone {
        Tone(((material.0 as u16) << SHADE_BITS) | shade)
    }

    /// What it shows.
    pub const fn material(self) -> Material {
        Material((self.0 >> SHADE_BITS) as u8)
    }

    const fn shade(self) -> u16 {
        self.0 & (SHADES as u16 - 1)
    }

    /// With less light, in 256ths.
    pub const fn darkened(self, left: u16) -> Tone {
        Tone(self.0 - self.shade() + ((self.shade() * left) >> 8))
    }

    /// Its place in a table of all tones.
    pub const fn index(self) -> usize {
        self.0 as usize & (TONES - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_of_a_class_has_its_paint() {
        for class in ColourClass::ALL {
            let material = Material::of(class);
            assert_eq!(material.class(), Some(class));
            assert_eq!(material.paint(), paint(class).map(f32::from));
        }
        for material in [Material::BEYOND, Material::HALL, Material::FENCE, Material::LIGHT, Material::DARK] {
            assert_eq!(material.class(), None);
        }
        assert_eq!(Material::floor(3).class(), Some(ColourClass::Green));
        assert_eq!(Material::floor(4).class(), Some(ColourClass::White));
    }

    #[test]
    fn a_darkened_tone_keeps_its_material() {
        for material in Material::all() {
            let tone = Tone::new(material, 60).darkened(128);
            assert_eq!((tone.material(), tone.shade()), (material, 30));
        }
    }
}
