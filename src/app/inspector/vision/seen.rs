//! What was recognised in a picture, where it lies in that, and what it is called. Pure.

use bevy::math::{Vec2, Vec3};

use crate::app::view::format;
use crate::geometry::Sighting;
use crate::ids::Team;
use crate::ops;
use crate::vision::paint::{BEACON_HEIGHT, BEACON_RADIUS, beacon_colours, goal_colour};
use crate::vision::{ColourClass, Gaze, KnownObjects, Landmark, LandmarkSighting, Optics, Recognised};

/// Something that a robot has recognised in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenThing {
    /// Its left upper and its right lower corner, as it would lie there if it were where it is taken to be, in pixels.
    pub corners: [Vec2; 2],
    /// Its colour.
    pub class: ColourClass,
    /// What it was taken for and how far away; points of lines and walls are too many to be named.
    pub words: Option<String>,
}

/// How a picture was taken.
#[derive(Clone, Copy, Debug)]
pub struct CameraView<'a> {
    pub optics: &'a Optics,
    /// Width and height of the picture, pixels.
    pub size: (usize, usize),
    pub gaze: Gaze,
}

/// An upright thing: how wide it is, and from how high to how high it reaches, m.
#[derive(Clone, Copy, Debug)]
struct Extent {
    width: f32,
    bottom: f32,
    top: f32,
}

/// Half the width of the mark of a point, m.
const POINT: f32 = 0.02;

/// Everything that was recognised, where it lies in the picture.
pub fn seen_things(view: &CameraView, known: &KnownObjects, recognised: &Recognised) -> Vec<SeenThing> {
    let ball = recognised.ball.and_then(|ball| {
        let extent = Extent { width: 2.0 * known.ball_radius, bottom: 0.0, top: 2.0 * known.ball_radius };
        view.thing(ball, extent, ColourClass::Orange, Some("ball".into()))
    });
    let robots = recognised.robots.iter().filter_map(|(team, at)| view.robot(known, *team, *at));
    let landmarks = recognised.landmarks.iter().filter_map(|seen| view.landmark(known, seen));
    landmarks.chain(robots).chain(ball).collect()
}

impl CameraView<'_> {
    fn robot(&self, known: &KnownObjects, team: Team, at: Sighting) -> Option<SeenThing> {
        let paint = known.robots[team.index()];
        let radius = paint.marker_radius.unwrap_or(BODY);
        let extent = Extent { width: 2.0 * radius, bottom: paint.marker.bottom, top: paint.marker.top };
        self.thing(at, extent, ColourClass::marker(team), Some(format!("{team} robot")))
    }

    fn landmark(&self, known: &KnownObjects, seen: &LandmarkSighting) -> Option<SeenThing> {
        let post = Extent { width: 2.0 * POINT, bottom: 0.0, top: known.paint.goal_height };
        let beacon = Extent { width: 2.0 * BEACON_RADIUS, bottom: 0.0, top: BEACON_HEIGHT };
        let point = Extent { width: 2.0 * POINT, bottom: 0.0, top: POINT };
        let (extent, class, words) = match seen.landmark {
            Landmark::GoalPost { east, north } => {
                (post, goal_colour(east), Some(format!("{} post {}", end(east), side(north))))
            }
            Landmark::Beacon { east, north } => {
                let [_, upper] = beacon_colours(east, north);
                (beacon, upper, Some(format!("{} beacon {}", end(east), side(north))))
            }
            Landmark::Line | Landmark::Wall => (point, ColourClass::White, None),
        };
        self.thing(seen.sighting, extent, class, words)
    }

    /// Nothing, if it would be behind the lens.
    fn thing(
        &self,
        at: Sighting,
        extent: Extent,
        class: ColourClass,
        words: Option<String>,
    ) -> Option<SeenThing> {
        let foot = at.range * Vec2::new(ops::cos(at.bearing), ops::sin(at.bearing));
        let height = |height: f32| {
            let way: Vec3 = foot.extend(height - self.optics.mount);
            self.optics.project(self.size, self.gaze, way)
        };
        let (bottom, top) = (height(extent.bottom)?, height(extent.top)?);
        // As wide at its range as it is high, unless the camera looks far down.
        let scale = self.optics.focal_length(self.size.0) / at.range.max(self.optics.mount);
        let half = (scale * extent.width / 2.0).max(1.0);
        let words = words.map(|words| format!("{words} {}", format::metres(at.range)));
        let corners = [
            Vec2::new(bottom.x.min(top.x) - half, top.y),
            Vec2::new(bottom.x.max(top.x) + half, bottom.y.max(top.y + 1.0)),
        ];
        Some(SeenThing { corners, class, words })
    }
}

/// Half the width of a body that wears its marker like a shirt, m.
const BODY: f32 = 0.1;

fn end(east: bool) -> &'static str {
    if east { "east" } else { "west" }
}

fn side(north: bool) -> &'static str {
    if north { "N" } else { "S" }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn a_ball_lies_where_it_is_and_is_as_large_as_it_would_look() {
        let known = samples::known();
        let optics =
            Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 0.0, nod: 0.0 };
        let view = CameraView { optics: &optics, size: (208, 160), gaze: Gaze { pan: 0.4, tilt: 0.2 } };
        let ball = Sighting { range: 1.5, bearing: 0.4 };
        let recognised = Recognised { ball: Some(ball), ..Recognised::default() };
        let [seen] = &seen_things(&view, &known, &recognised)[..] else { panic!("one thing was seen") };
        let [least, most] = seen.corners;
        let middle = (least + most) / 2.0;
        let way = Vec2::new(0.92106, 0.38942) * 1.5;
        let centre =
            optics.project(view.size, view.gaze, way.extend(known.ball_radius - optics.mount)).unwrap();
        assert!(middle.distance(centre) < 0.5, "{seen:?} {centre}");
        let wide = optics.focal_length(208) * 2.0 * known.ball_radius / 1.5;
        assert!((most.x - least.x - wide).abs() < 1.0 && (most.y - least.y - wide).abs() < 1.5, "{seen:?}");
        assert_eq!(seen.words.as_deref(), Some("ball 1.50 m"));
    }

    #[test]
    fn what_would_be_behind_the_lens_is_not_drawn() {
        let view =
            CameraView { optics: &samples::calibration().optics, size: (64, 48), gaze: Gaze::default() };
        let ball = Sighting { range: 1.0, bearing: std::f32::consts::PI };
        let recognised = Recognised { ball: Some(ball), ..Recognised::default() };
        assert_eq!(seen_things(&view, &samples::known(), &recognised), []);
    }
}
