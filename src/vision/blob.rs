//! Patches of one colour in a picture.

use bevy::math::Vec2;

use super::colours::ColourClass;

/// A box of whole pixels, counted from a picture's left upper corner; its edges are included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "each field is named after its edge")]
pub struct PixelBox {
    pub left: usize,
    pub top: usize,
    pub right: usize,
    pub bottom: usize,
}

impl PixelBox {
    /// Pixels from edge to edge.
    pub const fn width(self) -> usize {
        self.right + 1 - self.left
    }

    /// Pixels from edge to edge.
    pub const fn height(self) -> usize {
        self.bottom + 1 - self.top
    }

    /// The smallest box that holds both.
    pub fn joined(self, other: PixelBox) -> PixelBox {
        PixelBox {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// Pixels between two boxes across and down; 0 where they meet.
    pub fn gap(self, other: PixelBox) -> (usize, usize) {
        let between = |(from, to): (usize, usize), (other_from, other_to): (usize, usize)| {
            from.saturating_sub(other_to + 1).max(other_from.saturating_sub(to + 1))
        };
        (
            between((self.left, self.right), (other.left, other.right)),
            between((self.top, self.bottom), (other.top, other.bottom)),
        )
    }
}

/// Connected pixels of one class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourBlob {
    /// Of all its pixels.
    pub class: ColourClass,
    /// The number of its pixels.
    pub area: usize,
    /// What holds them.
    pub bounds: PixelBox,
    /// The mean of their middles, in pixels from the picture's left upper corner.
    pub centroid: Vec2,
}

impl ColourBlob {
    /// The share of its box that it fills.
    pub fn density(&self) -> f32 {
        self.area as f32 / (self.bounds.width() * self.bounds.height()) as f32
    }

    /// Both as one blob.
    pub fn joined(&self, other: &ColourBlob) -> ColourBlob {
        let area = self.area + other.area;
        let moment = self.centroid * self.area as f32 + other.centroid * other.area as f32;
        let bounds = self.bounds.joined(other.bounds);
        ColourBlob { class: self.class, area, bounds, centroid: moment / area as f32 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_touch_have_no_gap() {
        let a = PixelBox { left: 2, top: 3, right: 4, bottom: 5 };
        assert_eq!((a.width(), a.height()), (3, 3));
        assert_eq!(a.gap(PixelBox { left: 5, top: 8, right: 9, bottom: 9 }), (0, 2));
        assert_eq!(a.gap(PixelBox { left: 0, top: 0, right: 0, bottom: 1 }), (1, 1));
    }

    #[test]
    fn a_joined_blob_has_its_centroid_between_both() {
        let at = |x: usize, area| ColourBlob {
            class: ColourClass::Pink,
            area,
            bounds: PixelBox { left: x, top: 0, right: x, bottom: 2 },
            centroid: Vec2::new(x as f32 + 0.5, 1.5),
        };
        let both = at(1, 3).joined(&at(5, 1));
        assert_eq!((both.area, both.centroid), (4, Vec2::new(2.5, 1.5)));
        assert!((both.density() - 4.0 / 15.0).abs() < 1e-6);
    }
}
