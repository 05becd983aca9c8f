//! Which part of a chart is seen, and how large. Pure.

use bevy_egui::egui::{Pos2, Rect, Vec2, vec2};

/// How large a chart is at first, in points a point: as large as it fits, within these.
const AT_FIRST: (f32, f32) = (1.0, 1.2);
/// How small and how large a person may make it.
pub const ZOOM: (f32, f32) = (0.25, 3.0);
/// The share of the window at each edge that what is followed keeps free.
const EDGE: f32 = 0.12;

/// Which part of a chart is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Points of the screen for each of the chart; none before the chart has been shown.
    zoom: Option<f32>,
    /// The point of the chart in the middle.
    centre: Pos2,
    /// Whether it moves along with the robot's state.
    pub follows: bool,
}

impl Default for Viewport {
    fn default() -> Viewport {
        Viewport { zoom: None, centre: Pos2::ZERO, follows: true }
    }
}

/// A viewport on a place of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// The place on the screen.
    pub rect: Rect,
    /// Points of the screen for each of the chart.
    pub zoom: f32,
    centre: Pos2,
}

impl Viewport {
    /// Shows a chart of this size in a place of the screen, such that the box that is followed is seen.
    pub fn project(&mut self, rect: Rect, size: Vec2, followed: Option<Rect>) -> Projection {
        if self.zoom.is_none() {
            self.zoom = Some(fit(rect, size).clamp(AT_FIRST.0, AT_FIRST.1));
            self.centre = (size / 2.0).to_pos2();
        }
        let zoom = self.zoom.unwrap_or(1.0);
        if let Some(followed) = followed.filter(|_| self.follows) {
            self.bring_into_sight(rect.size() / zoom, followed);
        }
        self.keep_near(rect.size() / zoom, size);
        Projection { rect, zoom, centre: self.centre }
    }

    /// Shows the whole.
    pub fn fit(&mut self, rect: Rect, size: Vec2) {
        self.zoom = Some(fit(rect, size).clamp(ZOOM.0, AT_FIRST.1));
        self.centre = (size / 2.0).to_pos2();
        self.follows = false;
    }

    /// Shows another chart from the beginning.
    pub fn begin(&mut self) {
        self.zoom = None;
    }

    /// Moves the chart by a way on the screen.
    pub fn pan(&mut self, by: Vec2) {
        self.centre -= by / self.zoom.unwrap_or(1.0);
        self.follows = false;
    }

    /// Zooms in such a way that the point of the chart at a point of the screen stays there.
    pub fn zoom(&mut self, factor: f32, at: Pos2, seen: &Projection) {
        let zoom = (seen.zoom * factor).clamp(ZOOM.0, ZOOM.1);
        let held = seen.to_chart(at);
        self.centre = held - (at - seen.rect.center()) / zoom;
        self.zoom = Some(zoom);
    }

    fn bring_into_sight(&mut self, window: Vec2, followed: Rect) {
        let room = Rect::from_center_size(self.centre, window * (1.0 - 2.0 * EDGE));
        let aside = |low: f32, high: f32, room_low: f32, room_high: f32| {
            let (before, beyond) = (low - room_low, high - room_high);
            if high - low > room_high - room_low {
                (low + high - room_low - room_high) / 2.0
            } else {
                before.min(0.0) + beyond.max(0.0)
            }
        };
        self.centre += vec2(
            aside(followed.left(), followed.right(), room.left(), room.right()),
            aside(followed.top(), followed.bottom(), room.top(), room.bottom()),
        );
    }

    /// A chart that fits is in the middle; a larger one fills the window.
    fn keep_near(&mut self, window: Vec2, size: Vec2) {
        let keep = |centre: f32, window: f32, size: f32| {
            if size <= window { size / 2.0 } else { centre.clamp(window / 2.0, size - window / 2.0) }
        };
        self.centre.x = keep(self.centre.x, window.x, size.x);
        self.centre.y = keep(self.centre.y, window.y, size.y);
    }
}

/// How large a chart may be that just fits.
fn fit(rect: Rect, size: Vec2) -> f32 {
    let fits = rect.size() / size.max(Vec2::splat(1.0));
    fits.min_elem()
}

impl Projection {
    /// A point of the chart on the screen.
    pub fn to_screen(self, at: Pos2) -> Pos2 {
        self.rect.center() + (at - self.centre) * self.zoom
    }

    /// A point of the screen in the chart.
    pub fn to_chart(self, at: Pos2) -> Pos2 {
        self.centre + (at - self.rect.center()) / self.zoom
    }

    /// A part of the chart on the screen.
    pub fn place(self, rect: Rect) -> Rect {
        Rect::from_min_max(self.to_screen(rect.min), self.to_screen(rect.max))
    }
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::pos2;

    use super::*;

    const WINDOW: Rect = Rect { min: Pos2::new(100.0, 50.0), max: Pos2::new(900.0, 350.0) };

    #[test]
    fn a_chart_that_fits_is_in_the_middle_and_a_larger_one_stays_readable() {
        let mut view = Viewport::default();
        let seen = view.project(WINDOW, vec2(700.0, 280.0), None);
        assert!(WINDOW.contains_rect(seen.place(Rect::from_min_size(Pos2::ZERO, vec2(700.0, 280.0)))));
        assert_eq!(seen.to_screen(pos2(350.0, 140.0)), WINDOW.center());
        assert_eq!(Viewport::default().project(WINDOW, vec2(3000.0, 280.0), None).zoom, AT_FIRST.0);
    }

    #[test]
    fn what_is_followed_is_seen_until_a_person_moves_the_chart() {
        let mut view = Viewport::default();
        let size = vec2(3000.0, 1000.0);
        for x in [10.0, 2900.0, 1500.0] {
            let state = Rect::from_min_size(pos2(x, 900.0), vec2(90.0, 30.0));
            let seen = view.project(WINDOW, size, Some(state));
            assert!(WINDOW.contains_rect(seen.place(state)), "{x}");
        }
        view.pan(vec2(900.0, 0.0));
        let state = Rect::from_min_size(pos2(2900.0, 900.0), vec2(90.0, 30.0));
        let seen = view.project(WINDOW, size, Some(state));
        assert!(!WINDOW.contains_rect(seen.place(state)));
    }

    #[test]
    fn the_point_under_the_pointer_stays_while_a_person_zooms() {
        let mut view = Viewport::default();
        let size = vec2(3000.0, 1000.0);
        let before = view.project(WINDOW, size, None);
        let pointer = pos2(400.0, 200.0);
        let held = before.to_chart(pointer);
        view.zoom(1.5, pointer, &before);
        let after = view.project(WINDOW, size, None);
        assert!((after.to_screen(held) - pointer).length() < 0.01 && after.zoom > before.zoom);
        view.fit(WINDOW, size);
        let whole = view.project(WINDOW, size, None).place(Rect::from_min_size(Pos2::ZERO, size));
        assert!(WINDOW.expand(0.1).contains_rect(whole));
    }
}
