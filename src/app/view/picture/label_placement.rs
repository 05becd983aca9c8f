//! Keeps text on the pitch apart: a label goes beside its robot where there is room, and stays there while there is.

use bevy::prelude::Resource;
use bevy_egui::egui;
use egui::{Pos2, Rect, Vec2, vec2};

/// What has been placed in this frame; each text on the pitch gets its place from it.
#[derive(Resource, Clone, Debug, Default)]
pub struct LabelPlacement {
    /// Where labels are seen; everywhere, if not given.
    bounds: Option<Rect>,
    /// Never covered.
    labels: Vec<Rect>,
    /// Covered only if there is no other place.
    bodies: Vec<Rect>,
}

/// Which of its places a label has taken; the label keeps to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LabelPlace(usize);

/// Room between a label and what is beside it, in points.
const GAP: f32 = 2.0;
/// A label goes back to its first place when there is this much room, in points.
const ROOM: f32 = 7.0;
/// Share of a label by which it has to cover less of bodies at another place before it goes there.
const MATTERS: f32 = 0.25;
/// Where a label may go around its robot, best first: below, above, aside, and at the corners.
const PLACES: [Vec2; 8] = [
    vec2(0.0, 1.0),
    vec2(0.0, -1.0),
    vec2(1.0, 0.0),
    vec2(-1.0, 0.0),
    vec2(0.8, 0.8),
    vec2(-0.8, 0.8),
    vec2(0.8, -0.8),
    vec2(-0.8, -0.8),
];

impl LabelPlacement {
    /// Begins a frame, in which labels are seen within these bounds.
    pub fn clear(&mut self, bounds: Rect) {
        self.bounds = Some(bounds);
        self.labels.clear();
        self.bodies.clear();
    }

    /// Something that labels should not cover.
    pub fn add_body(&mut self, body: Rect) {
        self.bodies.push(body);
    }

    /// Whether there is a place for a label that covers nothing.
    pub fn has_room(&self, middle: Pos2, reach: f32, size: Vec2) -> bool {
        let at = |way: Vec2| Rect::from_center_size(middle + way * (vec2(reach, reach) + size / 2.0), size);
        PLACES.into_iter().any(|way| self.is_free(at(way)))
    }

    /// Finds a place for a label of a size around a robot whose outline reaches so far from its middle.
    pub fn place(&mut self, middle: Pos2, reach: f32, size: Vec2, last: LabelPlace) -> (Rect, LabelPlace) {
        let at = |place: usize| {
            let way = PLACES[place];
            Rect::from_center_size(middle + way * (vec2(reach, reach) + size / 2.0), size)
        };
        let kept = LabelPlace(last.0.min(PLACES.len() - 1));
        let home = (kept.0 != 0 && self.is_free(at(0).expand(ROOM))).then_some(0);
        let order = || home.into_iter().chain([kept.0]).chain(0..PLACES.len());
        let found = order()
            .find(|place| self.is_free(at(*place)))
            .or_else(|| self.least_covering(order().map(|place| (place, at(place))), kept));
        let (rect, choice) = match found {
            Some(place) => (at(place), LabelPlace(place)),
            None => (self.below_all(at(0)), kept),
        };
        self.labels.push(rect);
        (rect, choice)
    }

    /// Where no place is free: the one at which a label covers least of any body. It stays where it is unless another place is better
    /// by more than a little.
    fn least_covering(&self, places: impl Iterator<Item = (usize, Rect)>, kept: LabelPlace) -> Option<usize> {
        let covers = |(place, rect): &(usize, Rect)| {
            let areas = self.bodies.iter().map(|body| body.intersect(*rect)).filter(Rect::is_positive);
            let covered: f32 = areas.map(|area| area.area()).sum();
            covered - if *place == kept.0 { MATTERS * rect.area() } else { 0.0 }
        };
        let apart = places.filter(|(_, rect)| self.is_apart(*rect));
        apart.min_by(|one, other| covers(one).total_cmp(&covers(other))).map(|(place, _)| place)
    }

    fn is_apart(&self, rect: Rect) -> bool {
        let is_seen = self.bounds.is_none_or(|bounds| bounds.contains_rect(rect));
        is_seen && self.labels.iter().all(|other| !other.expand(GAP).intersects(rect))
    }

    fn is_free(&self, rect: Rect) -> bool {
        self.is_apart(rect) && self.bodies.iter().all(|body| !body.intersects(rect))
    }

    /// The nearest place further down that covers no label.
    fn below_all(&self, mut rect: Rect) -> Rect {
        while let Some(other) = self.labels.iter().find(|other| other.expand(GAP).intersects(rect)) {
            rect = rect.translate(vec2(0.0, other.bottom() + 2.0 * GAP - rect.top()));
        }
        rect
    }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    const SIZE: Vec2 = vec2(30.0, 16.0);

    #[test]
    fn a_label_alone_is_below_its_robot() {
        let mut placed = LabelPlacement::default();
        let (rect, choice) = placed.place(pos2(100.0, 100.0), 20.0, SIZE, LabelPlace::default());
        assert_eq!(choice, LabelPlace(0));
        assert_eq!(rect.center_top(), pos2(100.0, 120.0));
    }

    #[test]
    fn no_two_labels_overlap_however_many_robots_crowd_together() {
        let mut placed = LabelPlacement::default();
        for number in 0..16 {
            let middle = pos2(100.0 + number as f32, 100.0 - 2.0 * number as f32);
            placed.add_body(Rect::from_center_size(middle, vec2(40.0, 40.0)));
            placed.place(middle, 20.0, SIZE, LabelPlace::default());
        }
        for (i, a) in placed.labels.iter().enumerate() {
            assert!(placed.labels[..i].iter().all(|b| !a.intersects(*b)), "{a} in {:?}", placed.labels);
        }
    }

    #[test]
    fn where_no_place_is_free_a_label_covers_as_little_as_it_can_and_does_not_hop() {
        let mut placed = LabelPlacement::default();
        let middle = pos2(100.0, 100.0);
        placed.add_body(Rect::from_center_size(middle, vec2(70.0, 70.0)));
        let on = |x: f32| Rect::from_center_size(pos2(x, 128.0), vec2(20.0, 20.0));
        placed.add_body(on(100.0));
        let (rect, choice) = placed.place(middle, 20.0, SIZE, LabelPlace(0));
        assert!(choice != LabelPlace(0) && !rect.intersects(on(100.0)), "{rect}");
        let mut placed = LabelPlacement { labels: Vec::new(), ..placed };
        assert_eq!(placed.place(middle, 20.0, SIZE, choice).1, choice);
    }

    #[test]
    fn there_is_room_farther_off_where_a_crowd_is() {
        let mut placed = LabelPlacement::default();
        let middle = pos2(100.0, 100.0);
        placed.add_body(Rect::from_center_size(middle, vec2(60.0, 60.0)));
        assert!(!placed.has_room(middle, 5.0, SIZE));
        assert!(placed.has_room(middle, 40.0, SIZE));
    }

    #[test]
    fn a_label_stays_in_sight_if_it_can() {
        let mut placed = LabelPlacement::default();
        placed.clear(Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 110.0)));
        let (rect, choice) = placed.place(pos2(100.0, 100.0), 20.0, SIZE, LabelPlace::default());
        assert_eq!((choice, rect.center_bottom()), (LabelPlace(1), pos2(100.0, 80.0)));
    }

    #[test]
    fn a_label_keeps_its_place_until_the_first_one_is_really_free() {
        let middle = pos2(100.0, 100.0);
        let below = |distance: f32| Rect::from_center_size(middle + vec2(0.0, distance), vec2(10.0, 10.0));
        let choice_with = |body: Rect, last: LabelPlace| {
            let mut placed = LabelPlacement::default();
            placed.add_body(body);
            placed.place(middle, 20.0, SIZE, last).1
        };
        assert_eq!(choice_with(below(30.0), LabelPlace(0)), LabelPlace(1));
        assert_eq!(choice_with(below(45.0), LabelPlace(1)), LabelPlace(1), "almost in the way");
        assert_eq!(choice_with(below(60.0), LabelPlace(1)), LabelPlace(0));
    }
}
