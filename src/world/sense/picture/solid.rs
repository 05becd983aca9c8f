//! What stands on the floor: upright walls and the tops of things, all convex.

use bevy::math::Vec2;
use smallvec::SmallVec;

use super::evenness::Evenness;
use super::material::Material;
use super::raster::Raster;
use super::shot::{Corner, Viewpoint};
use crate::ids::RobotId;
use crate::vision::paint::HeightBand;

/// Corners of a convex outline, counter-clockwise seen from above.
pub type Outline = SmallVec<[Vec2; 8]>;

/// An upright rectangle, seen from the right of the way from one of its ends to the other.
#[derive(Clone, Copy, Debug)]
struct Panel {
    owner: Option<RobotId>,
    from: Vec2,
    to: Vec2,
    band: HeightBand,
    material: Material,
    /// Its shade as a share of that of the floor.
    share: f32,
}

/// A level surface, seen from above.
#[derive(Clone, Debug)]
struct Top {
    owner: Option<RobotId>,
    outline: Outline,
    height: f32,
    material: Material,
}

/// Solid things, as surfaces.
#[derive(Clone, Debug, Default)]
pub struct Solids {
    panels: Vec<Panel>,
    tops: Vec<Top>,
}

/// How the light of a picture is spread.
#[derive(Clone, Copy, Debug)]
pub struct Spread<'a> {
    /// Over the hall.
    pub evenness: &'a Evenness,
    /// See [`Lighting`](super::Lighting).
    pub unevenness: f32,
}

impl Spread<'_> {
    /// The shade of a surface at a place that gets this share of the light of a level one.
    pub fn shade(&self, at: Vec2, share: f32) -> f32 {
        self.evenness.shade(at, self.unevenness) * share
    }
}

impl Solids {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.panels.clear();
        self.tops.clear();
    }

    /// An upright rectangle, seen from the right of the way from one end to the other.
    pub fn panel(&mut self, [from, to]: [Vec2; 2], band: HeightBand, material: Material) {
        self.owned_panel(None, [from, to], band, material);
    }

    /// The sides of a column with this outline. It belongs to a robot, if it is a part of one.
    pub fn sides(&mut self, owner: Option<RobotId>, outline: &[Vec2], band: HeightBand, material: Material) {
        for (index, from) in outline.iter().enumerate() {
            self.owned_panel(owner, [*from, outline[(index + 1) % outline.len()]], band, material);
        }
    }

    /// The top of a column with this outline.
    pub fn top(&mut self, owner: Option<RobotId>, outline: &[Vec2], height: f32, material: Material) {
        self.tops.push(Top { owner, outline: outline.into(), height, material });
    }

    /// Gives a panel a share of the light by the way it looks: what looks to the windows in the north gets more. ASSUMPTION: less
    /// than what looks up to the lamps.
    fn owned_panel(
        &mut self,
        owner: Option<RobotId>,
        [from, to]: [Vec2; 2],
        band: HeightBand,
        material: Material,
    ) {
        let outwards = -(to - from).perp().normalize_or_zero();
        let share = 0.88 + 0.08 * outwards.y + 0.04 * outwards.x;
        self.panels.push(Panel { owner, from, to, band, material, share });
    }

    /// Paints all but what belongs to a robot.
    pub fn paint(&self, view: &Viewpoint, light: &Spread, except: RobotId, raster: &mut Raster) {
        for panel in self.panels.iter().filter(|panel| panel.owner != Some(except)) {
            if (panel.to - panel.from).perp_dot(view.eye - panel.from) >= 0.0 {
                continue;
            }
            let corner = |at: Vec2, height| view.corner(at, height, light.shade(at, panel.share));
            let (Panel { from, to, .. }, HeightBand { bottom, top }) = (*panel, panel.band);
            let corners = [corner(from, bottom), corner(to, bottom), corner(to, top), corner(from, top)];
            raster.polygon(view, &corners, panel.material);
        }
        for top in self.tops.iter().filter(|top| top.owner != Some(except) && top.height < view.height) {
            let corners = level(view, &top.outline, top.height, |at| light.shade(at, 1.0));
            raster.polygon(view, &corners, top.material);
        }
    }
}

/// A level polygon as a camera has it.
pub fn level(
    view: &Viewpoint,
    outline: &[Vec2],
    height: f32,
    shade: impl Fn(Vec2) -> f32,
) -> SmallVec<[Corner; 8]> {
    outline.iter().map(|at| view.corner(*at, height, shade(*at))).collect()
}

/// A rectangle with sides along the axes, by its middle and half its size.
pub fn rectangle(middle: Vec2, half: Vec2) -> [Vec2; 4] {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| middle + Vec2::new(x, y) * half)
}

/// A circle as an octagon that is as wide, averaged over all directions.
pub fn circle(middle: Vec2, radius: f32) -> Outline {
    let half = std::f32::consts::FRAC_PI_8;
    // The mean width of a convex polygon is its circumference over π.
    let reach = radius * half / crate::ops::sin(half);
    (0..8).map(|corner| middle + crate::geometry::unit((2 * corner) as f32 * half) * reach).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_as_wide_as_its_diameter_on_average() {
        let outline = circle(Vec2::new(1.0, 2.0), 0.05);
        let around: f32 = (0..8).map(|index| outline[index].distance(outline[(index + 1) % 8])).sum();
        assert!((around / std::f32::consts::PI - 0.1).abs() < 1e-4, "{around}");
    }
}
