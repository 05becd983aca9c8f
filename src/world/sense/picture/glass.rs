//! What a lens does to pictures: less light towards the edges, and other colours there.

/// For each pixel how much light it gets and by how much its colours are shifted. Made once for a size.
#[derive(Clone, Debug, Default)]
pub struct Glass {
    size: (usize, usize),
    /// 256ths of the light.
    pub light: Vec<u8>,
    /// Added to blue against brightness, and half of it taken from red.
    pub shift: Vec<i8>,
}

/// What a corner lacks of the light of the middle. ASSUMPTION.
const FALL_OFF: f32 = 0.25;
/// By how much blue against brightness is shifted in a corner: pictures of the AIBO have a blue ring. ASSUMPTION.
const SHIFT: f32 = 10.0;

impl Glass {
    /// Prepares for pictures of this size.
    pub fn fit(&mut self, size: (usize, usize)) {
        if self.size == size {
            return;
        }
        let (width, height) = size;
        let (half_x, half_y) = (width as f32 / 2.0, height as f32 / 2.0);
        let share = |index: usize| {
            let (x, y) = ((index % width) as f32 + 0.5 - half_x, (index / width) as f32 + 0.5 - half_y);
            (x * x + y * y) / (half_x * half_x + half_y * half_y)
        };
        self.size = size;
        self.light =
            (0..width * height).map(|index| (256.0 * (1.0 - FALL_OFF * share(index))) as u8).collect();
        self.shift = (0..width * height).map(|index| (SHIFT * share(index)).round() as i8).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_darker_and_bluer_than_the_middle_at_every_size() {
        let mut glass = Glass::default();
        for (width, height) in [(208, 160), (52, 40)] {
            glass.fit((width, height));
            let middle = height / 2 * width + width / 2;
            assert_eq!((glass.light[middle], glass.shift[middle]), (255, 0));
            assert!((190..200).contains(&glass.light[0]) && (9..=10).contains(&glass.shift[0]));
        }
    }
}
