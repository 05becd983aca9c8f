//! Pictures as a camera gives them.

/// One pixel: brightness and the two colour differences of BT.601, each from 0 to 255; 128 is no colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Yuv {
    /// Brightness.
    pub y: u8,
    /// Blue against brightness.
    pub u: u8,
    /// Red against brightness.
    pub v: u8,
}

/// A picture.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Image {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
    /// Row by row from the top, each from the left.
    pub pixels: Vec<Yuv>,
}

impl Image {
    /// A black picture.
    pub fn new(width: usize, height: usize) -> Image {
        Image { width, height, pixels: vec![Yuv { y: 0, u: 128, v: 128 }; width * height] }
    }

    /// A pixel, if the picture has it: from the left and from the top.
    pub fn at(&self, x: usize, y: usize) -> Option<Yuv> {
        (x < self.width).then(|| self.pixels.get(y * self.width + x).copied()).flatten()
    }
}

impl Yuv {
    /// Red, green and blue as a screen shows them.
    pub fn to_rgb(self) -> [u8; 3] {
        let (y, u, v) = (f32::from(self.y), f32::from(self.u) - 128.0, f32::from(self.v) - 128.0);
        [y + 1.402 * v, y - 0.344_136 * u - 0.714_136 * v, y + 1.772 * u].map(|value| value.round() as u8)
    }

    /// From red, green and blue.
    pub fn from_rgb([r, g, b]: [u8; 3]) -> Yuv {
        let [r, g, b] = [r, g, b].map(f32::from);
        let y = 0.299 * r + 0.587 * g + 0.114 * b;
        let byte = |value: f32| value.round() as u8;
        Yuv { y: byte(y), u: byte(128.0 + 0.564_334 * (b - y)), v: byte(128.0 + 0.713_267 * (r - y)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_survive_the_way_there_and_back_but_for_rounding() {
        for rgb in [[0, 0, 0], [255, 255, 255], [230, 100, 20], [20, 90, 40], [250, 230, 30], [40, 60, 200]] {
            let back = Yuv::from_rgb(rgb).to_rgb();
            let error = rgb.into_iter().zip(back).map(|(a, b)| a.abs_diff(b)).max();
            assert!(error <= Some(2), "{rgb:?} came back as {back:?}");
        }
    }

    #[test]
    fn a_pixel_beyond_the_edge_is_none_of_the_next_row() {
        let image = Image::new(4, 3);
        assert!(image.at(3, 2).is_some());
        assert!(image.at(4, 0).is_none() && image.at(0, 3).is_none());
    }
}
