//! Where things go in the sequence chart: time runs to the right, each robot has a lane, and a message is an arrow from lane
//! to lane. Pure geometry in points; times are ticks.

use bevy_egui::egui::{Pos2, Rect, Vec2, pos2, vec2};

use crate::comms::radio::{Loss, Transmission, TransmissionState};
use crate::ids::RobotId;

/// The chart's rectangle, the time that it shows and its number of lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    pub rect: Rect,
    /// The tick at the right edge.
    pub now: f64,
    /// The ticks from edge to edge.
    pub span: f64,
    pub lanes: usize,
}

/// A message in the chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrow {
    pub from: Pos2,
    pub to: Pos2,
    pub end: End,
}

/// What is at the end of an arrow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    Arrived,
    /// It ends where the message is by now.
    OnItsWay,
    Lost(Loss),
}

/// How far to the right the arrow of a lost message leans, from lane to lane, in points.
const LEAN: f32 = 10.0;

impl Axes {
    /// The first tick that is shown.
    pub fn start(&self) -> f64 {
        self.now - self.span
    }

    pub fn x(&self, tick: f64) -> f32 {
        let share = (tick - self.start()) / self.span.max(1.0);
        self.rect.left() + share as f32 * self.rect.width()
    }

    /// The middle of a lane.
    pub fn y(&self, lane: usize) -> f32 {
        self.rect.top() + (lane as f32 + 0.5) * self.lane_height()
    }

    pub fn lane_height(&self) -> f32 {
        self.rect.height() / self.lanes.max(1) as f32
    }

    /// The arrow of a message between two of these robots; none if no part of it is within the time that is shown.
    pub fn arrow(&self, message: &Transmission, lanes: &[RobotId]) -> Option<Arrow> {
        let lane = |robot| lanes.iter().position(|lane| *lane == robot);
        let (from_y, to_y) = (self.y(lane(message.packet.from)?), self.y(lane(message.packet.to)?));
        let sent = message.sent as f64;
        let from = pos2(self.x(sent), from_y);
        let (to, end) = match message.state {
            TransmissionState::Arrived(tick) => (pos2(self.x(tick as f64), to_y), End::Arrived),
            TransmissionState::InFlight(due) => {
                let whole = pos2(self.x(due as f64), to_y);
                let share = (self.now - sent) / (due as f64 - sent).max(1.0);
                (from.lerp(whole, share.clamp(0.0, 1.0) as f32), End::OnItsWay)
            }
            TransmissionState::Lost(loss) => {
                let share = way_of_a_lost_one(loss);
                (from.lerp(pos2(from.x + LEAN, to_y), share), End::Lost(loss))
            }
        };
        let is_seen = from.x <= self.rect.right() && to.x >= self.rect.left();
        is_seen.then_some(Arrow { from, to, end })
    }

    /// The ticks at which the time is written: round seconds, not too near to each other. With them, the seconds between two.
    pub fn marks(&self, dt: f32) -> (Vec<u64>, u64) {
        let seconds = self.span * f64::from(dt);
        let steps = [1_u64, 2, 5, 10, 20, 60];
        let room = f64::from(self.rect.width() / MARK);
        let step = steps.into_iter().find(|step| seconds / *step as f64 <= room + 0.01).unwrap_or(60);
        let ticks = (step as f64 / f64::from(dt)).round() as u64;
        let first = (self.start().max(0.0) / ticks as f64).ceil() as u64;
        let last = (self.now.max(0.0) / ticks as f64).floor() as u64;
        ((first..=last).map(|mark| mark * ticks).collect(), step)
    }
}

/// Room for one time on the axis, in points.
const MARK: f32 = 64.0;

/// How far a lost message comes: not out of a mute robot, to a deaf one, and half-way otherwise.
pub fn way_of_a_lost_one(loss: Loss) -> f32 {
    match loss {
        Loss::Mute => 0.15,
        Loss::Deaf => 0.85,
        _ => 0.5,
    }
}

impl Arrow {
    /// How far a point is from the arrow.
    pub fn distance(&self, point: Pos2) -> f32 {
        let along = self.to - self.from;
        let share = (point - self.from).dot(along) / along.length_sq().max(1e-6);
        point.distance(self.from + share.clamp(0.0, 1.0) * along)
    }
}

/// Places for labels that do not overlap.
#[derive(Clone, Debug, Default)]
pub struct Labels(Vec<Rect>);

impl Labels {
    /// Finds a place for a label of a size beside an arrow's beginning within the bounds: at first on the arrow's side of
    /// the lane, else on the other, and, if it is important, up to three labels farther away.
    pub fn place(&mut self, arrow: &Arrow, size: Vec2, bounds: Rect, important: bool) -> Option<Rect> {
        let side = if arrow.to.y >= arrow.from.y { 1.0 } else { -1.0 };
        let steps = if important { 4 } else { 1 };
        let places = (0..steps).flat_map(|step| {
            let aside = 3.0 + size.x / 2.0 + step as f32 * (size.x + 2.0);
            let aloft = 2.0 + size.y / 2.0;
            [(1.0, side), (-1.0, side), (-1.0, -side), (1.0, -side)]
                .map(|(x, y)| Rect::from_center_size(arrow.from + vec2(x * aside, y * aloft), size))
        });
        let free = |place: &Rect| {
            bounds.contains_rect(*place) && !self.0.iter().any(|other| other.intersects(*place))
        };
        let place = places.into_iter().find(free)?;
        self.0.push(place);
        Some(place)
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{home, transmission};
    use super::*;
    use crate::comms::tcm::DataType;

    /// Ten ticks on a hundred points, up to tick 110, with two lanes of 20 points.
    fn axes() -> Axes {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 40.0));
        Axes { rect, now: 110.0, span: 10.0, lanes: 2 }
    }

    fn arrow(sent: u64, state: TransmissionState) -> Option<Arrow> {
        axes().arrow(&transmission(DataType::LOCK, 1, 2, sent, state), &[home(1), home(2)])
    }

    #[test]
    fn an_arrow_goes_from_the_senders_lane_to_the_receivers_between_the_two_times() {
        let arrow = arrow(102, TransmissionState::Arrived(105)).unwrap();
        assert_eq!((arrow.from, arrow.to), (pos2(20.0, 10.0), pos2(50.0, 30.0)));
        assert_eq!(arrow.end, End::Arrived);
    }

    #[test]
    fn a_message_on_its_way_is_as_far_as_the_time() {
        let arrow = arrow(108, TransmissionState::InFlight(112)).unwrap();
        assert_eq!((arrow.to, arrow.end), (pos2(100.0, 20.0), End::OnItsWay));
    }

    #[test]
    fn a_lost_message_ends_between_the_lanes() {
        let lost = |loss| arrow(102, TransmissionState::Lost(loss)).unwrap();
        let (chance, deaf, mute) = (lost(Loss::Chance), lost(Loss::Deaf), lost(Loss::Mute));
        assert_eq!(chance.to, pos2(25.0, 20.0));
        assert!(mute.to.y < chance.to.y && chance.to.y < deaf.to.y && deaf.to.y < 30.0);
        assert_eq!(deaf.end, End::Lost(Loss::Deaf));
    }

    #[test]
    fn only_what_is_within_the_time_and_on_a_lane_is_drawn() {
        assert!(arrow(90, TransmissionState::Arrived(95)).is_none());
        assert!(arrow(99, TransmissionState::Arrived(101)).is_some());
        let stranger = transmission(DataType::LOCK, 1, 3, 102, TransmissionState::Arrived(105));
        assert_eq!(axes().arrow(&stranger, &[home(1), home(2)]), None);
    }

    #[test]
    fn times_are_round_and_apart() {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(640.0, 40.0));
        let axes = Axes { rect, now: 730.0, span: 600.0, lanes: 2 };
        let (marks, step) = axes.marks(1.0 / 60.0);
        assert_eq!((marks.first(), marks.last(), step), (Some(&180), Some(&720), 1));
        let (marks, step) = Axes { span: 3600.0, now: 100.0, ..axes }.marks(1.0 / 60.0);
        assert_eq!((marks, step), (vec![0], 10));
    }

    #[test]
    fn labels_do_not_lie_upon_each_other_and_important_ones_go_farther() {
        let bounds = Rect::from_min_size(pos2(0.0, -20.0), vec2(400.0, 80.0));
        let arrow = Arrow { from: pos2(200.0, 10.0), to: pos2(205.0, 30.0), end: End::Arrived };
        let mut labels = Labels::default();
        let mut place = |important| labels.place(&arrow, vec2(40.0, 14.0), bounds, important);
        let placed: Vec<_> = (0..4).filter_map(|_| place(false)).collect();
        assert_eq!(placed.len(), 4);
        assert!(placed[0].top() > 10.0, "on the arrow's side first");
        assert_eq!(place(false), None);
        let farther = place(true).unwrap();
        assert!(placed.iter().all(|other| !other.intersects(farther)));
    }

    #[test]
    fn the_pointer_means_the_arrow_that_it_is_near() {
        let arrow = Arrow { from: pos2(0.0, 0.0), to: pos2(10.0, 0.0), end: End::Arrived };
        assert_eq!(arrow.distance(pos2(5.0, 3.0)), 3.0);
        assert_eq!(arrow.distance(pos2(13.0, 4.0)), 5.0);
    }
}
