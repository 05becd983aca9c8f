//! The pixels of a picture before light and lens: convex polygons, each pixel the nearest.

use std::ops::Range;

use smallvec::SmallVec;

use super::material::{Material, TOP_SHADE, Tone};
use super::shot::{Corner, Viewpoint};

/// What each pixel shows, how bright, and how near that is.
#[derive(Clone, Debug, Default)]
pub struct Raster {
    size: (usize, usize),
    tones: Vec<Tone>,
    /// 1 / depth, 1/m; 0 where nothing stands on the floor.
    nearness: Vec<f32>,
    /// Of the polygon at hand: from where to where it covers a row.
    chords: Vec<(f32, f32)>,
}

/// What is nearer to the lens than this is not drawn, m.
const NEAREST: f32 = 0.03;
/// Polygons that cover less of a picture are seen edge-on, pixels.
const LEAST_AREA: f32 = 0.01;
/// Fixed-point numbers have 16 bits behind the point.
pub const FIXED: f32 = 65_536.0;

/// A corner in the picture.
#[derive(Clone, Copy)]
struct Dot {
    x: f32,
    y: f32,
    nearness: f32,
    shade: f32,
}

/// A value that changes evenly over the picture.
#[derive(Clone, Copy)]
struct Slope {
    x: f32,
    y: f32,
    /// At the left upper corner.
    base: f32,
}

type Dots = SmallVec<[Dot; 16]>;

impl Raster {
    /// Prepares for a picture of this size. What the last one showed stays until it is overpainted.
    pub fn begin(&mut self, size: (usize, usize)) {
        if self.size != size {
            self.size = size;
            self.tones = vec![Tone::default(); size.0 * size.1];
            self.nearness = vec![0.0; size.0 * size.1];
            self.chords = vec![(0.0, 0.0); size.1];
        }
        self.nearness.fill(0.0);
    }

    /// Width and height, pixels.
    pub fn size(&self) -> (usize, usize) {
        self.size
    }

    /// All pixels, row by row.
    pub fn tones(&self) -> &[Tone] {
        &self.tones
    }

    /// A row from the top, to be painted without regard to depth.
    pub fn row(&mut self, row: usize) -> &mut [Tone] {
        &mut self.tones[row * self.size.0..][..self.size.0]
    }

    /// Paints a convex polygon of at most 12 corners where nothing nearer is.
    pub fn polygon(&mut self, view: &Viewpoint, corners: &[Corner], material: Material) {
        let spots = seen(view, corners);
        let Some((nearness, shade)) = slopes(&spots) else { return };
        let Some(rows) = self.trace(&spots) else { return };
        for row in rows {
            let Some(columns) = self.columns(row) else { continue };
            let (x, y) = (columns.start as f32 + 0.5, row as f32 + 0.5);
            let [from, to] =
                [x, columns.end as f32 - 0.5].map(|x| shade.at(x, y).clamp(0.0, TOP_SHADE) * FIXED);
            let step = (to - from) / columns.len().saturating_sub(1).max(1) as f32;
            let start = row * self.size.0;
            let span = start + columns.start..start + columns.end;
            let line = Stroke {
                nearness: nearness.at(x, y),
                deeper: nearness.x,
                shade: from as i32,
                step: step as i32,
            };
            line.paint(&mut self.tones[span.clone()], &mut self.nearness[span], material);
        }
    }

    /// Leaves so many 256ths of the light on a convex polygon of the floor.
    pub fn darken(&mut self, view: &Viewpoint, corners: &[Corner], left: u16) {
        let spots = seen(view, corners);
        let Some(rows) = self.trace(&spots) else { return };
        for row in rows {
            let Some(columns) = self.columns(row) else { continue };
            let line = &mut self.row(row)[columns];
            line.iter_mut().for_each(|tone| *tone = tone.darkened(left));
        }
    }

    /// Paints one pixel if nothing nearer is there.
    pub fn dot(&mut self, index: usize, nearness: f32, tone: Tone) {
        if nearness > self.nearness[index] {
            self.nearness[index] = nearness;
            self.tones[index] = tone;
        }
    }

    /// Notes from where to where a polygon covers each row, and returns the rows.
    fn trace(&mut self, spots: &[Dot]) -> Option<Range<usize>> {
        let (width, height) = (self.size.0 as f32, self.size.1);
        let bounds = |value: fn(&Dot) -> f32| {
            spots
                .iter()
                .map(value)
                .fold((f32::MAX, f32::MIN), |(least, most), value| (least.min(value), most.max(value)))
        };
        let ((left, right), (top, bottom)) = (bounds(|spot| spot.x), bounds(|spot| spot.y));
        let rows = pixels(top, bottom, height);
        if rows.is_empty() || right < 0.0 || left > width {
            return None;
        }
        self.chords[rows.clone()].fill((f32::MAX, f32::MIN));
        for (index, from) in spots.iter().enumerate() {
            let to = spots[(index + 1) % spots.len()];
            let (above, below) = if from.y < to.y { (*from, to) } else { (to, *from) };
            let slope = (below.x - above.x) / (below.y - above.y);
            for row in pixels(above.y, below.y, height) {
                let x = above.x + (row as f32 + 0.5 - above.y) * slope;
                let chord = &mut self.chords[row];
                *chord = (chord.0.min(x), chord.1.max(x));
            }
        }
        Some(rows)
    }

    /// The pixels of a row that the traced polygon covers.
    fn columns(&self, row: usize) -> Option<Range<usize>> {
        let (from, to) = self.chords[row];
        Some(pixels(from, to, self.size.0)).filter(|columns| !columns.is_empty())
    }
}

/// Pixels whose middles are between two edges, of so many.
pub fn pixels(from: f32, to: f32, count: usize) -> Range<usize> {
    let most = count as f32;
    let [from, to] = [from, to].map(|edge| (edge + 0.5).clamp(0.0, most) as usize);
    from..to
}

/// A part of a row to be painted.
struct Stroke {
    nearness: f32,
    deeper: f32,
    /// Fixed-point.
    shade: i32,
    step: i32,
}

impl Stroke {
    /// Written without branches, so that several pixels are painted at once.
    fn paint(&self, tones: &mut [Tone], nearness: &mut [f32], material: Material) {
        for (index, (tone, nearest)) in tones.iter_mut().zip(nearness).enumerate() {
            let index = index as i32;
            let here = self.nearness + self.deeper * index as f32;
            let shade = self.shade + self.step * index;
            let new = Tone::new(material, (shade >> 16) as u16);
            let is_nearer = here > *nearest;
            *tone = if is_nearer { new } else { *tone };
            *nearest = if is_nearer { here } else { *nearest };
        }
    }
}

/// The part of a polygon that is before the lens, in the picture.
fn seen(view: &Viewpoint, corners: &[Corner]) -> Dots {
    let middle = view.middle();
    let spot = |corner: Corner| {
        let nearness = 1.0 / corner.depth;
        let scale = view.focal * nearness;
        Dot {
            x: middle.x - corner.left * scale,
            y: middle.y - corner.up * scale,
            nearness,
            shade: corner.shade,
        }
    };
    let mut spots = Dots::new();
    for (index, from) in corners.iter().enumerate() {
        let to = corners[(index + 1) % corners.len()];
        if from.depth >= NEAREST {
            spots.push(spot(*from));
        }
        if (from.depth >= NEAREST) != (to.depth >= NEAREST) {
            spots.push(spot(between(*from, to, (NEAREST - from.depth) / (to.depth - from.depth))));
        }
    }
    spots
}

fn between(from: Corner, to: Corner, share: f32) -> Corner {
    let mix = |from: f32, to: f32| from + share * (to - from);
    Corner {
        left: mix(from.left, to.left),
        up: mix(from.up, to.up),
        depth: mix(from.depth, to.depth),
        shade: mix(from.shade, to.shade),
    }
}

/// How nearness and shade change over a polygon, by the largest triangle at its first corner; nothing, if it is seen edge-on.
fn slopes(spots: &[Dot]) -> Option<(Slope, Slope)> {
    let (first, rest) = spots.split_first()?;
    let area = |pair: &[Dot]| {
        (pair[0].x - first.x) * (pair[1].y - first.y) - (pair[1].x - first.x) * (pair[0].y - first.y)
    };
    let pair = rest.windows(2).max_by(|one, other| area(one).abs().total_cmp(&area(other).abs()))?;
    let size = area(pair);
    let slope = |value: fn(&Dot) -> f32| {
        let [one, other] = [value(&pair[0]) - value(first), value(&pair[1]) - value(first)];
        let x = (one * (pair[1].y - first.y) - other * (pair[0].y - first.y)) / size;
        let y = (other * (pair[0].x - first.x) - one * (pair[1].x - first.x)) / size;
        Slope { x, y, base: value(first) - x * first.x - y * first.y }
    };
    (size.abs() >= LEAST_AREA).then(|| (slope(|spot| spot.nearness), slope(|spot| spot.shade)))
}

impl Slope {
    fn at(self, x: f32, y: f32) -> f32 {
        self.base + self.x * x + self.y * y
    }
}

#[cfg(test)]
mod tests {
    use bevy::math::Vec2;

    use super::*;
    use crate::vision::ColourClass;

    const VIEW: Viewpoint = Viewpoint {
        eye: Vec2::ZERO,
        height: 0.0,
        ahead: Vec2::X,
        tilt: (0.0, 1.0),
        focal: 10.0,
        size: (20, 20),
    };

    fn square(depth: f32, half: f32) -> [Corner; 4] {
        [(half, -half), (-half, -half), (-half, half), (half, half)].map(|(left, up)| Corner {
            left,
            up,
            depth,
            shade: 20.0,
        })
    }

    fn count(raster: &Raster, material: Material) -> usize {
        raster.tones().iter().filter(|tone| tone.material() == material).count()
    }

    #[test]
    fn the_nearer_polygon_is_seen_whichever_is_painted_first() {
        let (pink, red) = (Material::of(ColourClass::Pink), Material::of(ColourClass::Red));
        for near_first in [true, false] {
            let mut raster = Raster::default();
            raster.begin((20, 20));
            let mut things = [(square(1.0, 0.3), pink), (square(2.0, 1.0), red)];
            if !near_first {
                things.reverse();
            }
            things.iter().for_each(|(corners, material)| raster.polygon(&VIEW, corners, *material));
            assert_eq!((count(&raster, pink), count(&raster, red)), (36, 100 - 36), "{near_first}");
        }
    }

    #[test]
    fn what_reaches_behind_the_lens_is_cut_off_and_what_is_behind_it_is_not_seen() {
        let mut raster = Raster::default();
        raster.begin((20, 20));
        let wall = |depths: [f32; 2]| {
            [(depths[0], -0.5), (depths[1], -0.5), (depths[1], 0.5), (depths[0], 0.5)]
                .map(|(depth, up)| Corner { left: 0.4, up, depth, shade: 20.0 })
        };
        raster.polygon(&VIEW, &wall([-2.0, -0.5]), Material::DARK);
        assert_eq!(count(&raster, Material::DARK), 0);
        raster.polygon(&VIEW, &wall([-1.0, 1.0]), Material::DARK);
        // From the left edge to x = 10 - 4; at the edge it is taller than the picture.
        assert_eq!(raster.row(10).iter().filter(|tone| tone.material() == Material::DARK).count(), 6);
        assert!(count(&raster, Material::DARK) > 6 * 10);
    }

    #[test]
    fn polygons_that_share_an_edge_leave_no_gap_and_share_no_pixel() {
        let mut raster = Raster::default();
        raster.begin((20, 20));
        let corner = |left, up| Corner { left, up, depth: 1.0, shade: 20.0 };
        let (a, b, c, d) = (corner(0.71, 0.62), corner(-0.83, 0.55), corner(-0.7, -0.6), corner(0.64, -0.77));
        raster.polygon(&VIEW, &[a, b, c, d], Material::DARK);
        let whole = count(&raster, Material::DARK);
        raster.begin((20, 20));
        raster.polygon(&VIEW, &[a, b, c], Material::LIGHT);
        let half = count(&raster, Material::LIGHT);
        raster.polygon(&VIEW, &[a, c, d], Material::FENCE);
        assert_eq!(half + count(&raster, Material::FENCE), whole);
        assert_eq!(count(&raster, Material::DARK), 0);
    }
}
