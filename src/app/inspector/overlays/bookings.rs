//! Ball bookings on the pitch: a line in the team's colour from the booker to the ball, with the announced distance and its age.
//! The selected robot's team is shown as that robot believes, other teams as their bookers believe.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, egui};

use super::pens::Pens;
use crate::app::view::picture::camera::PitchCamera;
use crate::app::view::picture::label_placement::{LabelPlace, LabelPlacement};
use crate::app::view::picture::labels::{GROUND, PADDING, lay_out};
use crate::app::view::picture::robots::reach;
use crate::app::view::picture::visuals::BodyVisual;
use crate::app::view::state::{FreeArea, Overlay, Overlays, Selected};
use crate::app::view::{colours, format};
use crate::clock::Clock;
use crate::ids::{RobotId, Team};
use crate::mind::teamwork::Booking;
use crate::pitch::BallKind;
use crate::protocol::b3p::{B3p, Distance};
use crate::robot::{OffPitch, Robot};
use crate::world::ball::Ball;

/// A booking as somebody believes it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Line {
    booker: RobotId,
    distance: Distance,
    /// Ticks since it was made or renewed.
    age: u64,
}

/// Radius of the ring around a booked ball, in radii of the ball.
const ROUND: f32 = 1.9;

/// How far off its line a label is written, in points: nearest first, farther in a crowd.
const OFF: [f32; 4] = [6.0, 20.0, 40.0, 70.0];

impl Line {
    /// What a robot believes, if that has not expired.
    fn believed_by(robot: RobotId, machine: &B3p, tick: u64) -> Option<Line> {
        let known = machine.booking().filter(|_| machine.is_booked(tick))?;
        let booker = RobotId { number: known.robot_booker, ..robot };
        Some(Line { booker, distance: known.distance, age: tick.saturating_sub(known.timestamp) })
    }

    fn words(&self, clock: &Clock) -> String {
        let age = format::seconds(format::span(0, self.age, clock.dt));
        format!("{}, {age}", format::metres(self.distance.metres()))
    }
}

/// The bookings to draw: for the selected robot's team what it believes, for other robots that of each that goes to the ball.
fn lines<'a>(
    robots: impl Iterator<Item = (RobotId, &'a B3p)>,
    selected: Option<RobotId>,
    tick: u64,
) -> Vec<Line> {
    robots
        .filter(|(robot, machine)| match selected.filter(|looked_at| looked_at.team == robot.team) {
            Some(looked_at) => looked_at == *robot,
            None => machine.goes(),
        })
        .filter_map(|(robot, machine)| Line::believed_by(robot, machine, tick))
        .collect()
}

/// What there is to see of bookings.
#[derive(bevy::ecs::system::SystemParam)]
pub(super) struct Booked<'w, 's> {
    overlays: Res<'w, Overlays>,
    clock: Res<'w, Clock>,
    selected: Res<'w, Selected>,
    robots: Query<'w, 's, (&'static RobotId, &'static Robot, &'static Booking), Without<OffPitch>>,
    kind: Res<'w, BallKind>,
    ball: Query<'w, 's, Entity, With<Ball>>,
    shown: Query<'w, 's, &'static BodyVisual>,
}

impl Booked<'_, '_> {
    /// Each line with its two ends on the pitch: beside the booker, and at the ball.
    fn placed(&self) -> Vec<(Line, Vec2, Vec2)> {
        let Some(ball) = self.ball.iter().next().filter(|_| self.overlays.shows(Overlay::Teamwork)) else {
            return Vec::new();
        };
        let at = |found: &dyn Fn(&BodyVisual) -> bool| {
            self.shown.iter().find(|shown| found(shown)).map(|shown| shown.pose.position)
        };
        let Some(to) = at(&|shown| shown.body == ball) else { return Vec::new() };
        // Beliefs are as of the last tick.
        let tick = self.clock.tick.saturating_sub(1);
        let machines = self.robots.iter().map(|(id, _, booking)| (*id, &booking.0));
        let mut lines = lines(machines, self.selected.0, tick);
        lines.sort_unstable_by_key(|line| line.booker);
        let ends = lines.into_iter().filter_map(|line| {
            let from = at(&|shown| shown.robot == Some(line.booker))?;
            let robot = self.robots.iter().find(|(id, ..)| **id == line.booker);
            let room = robot.map_or(0.0, |(_, robot, _)| 0.6 * reach(&robot.kind));
            let way = (to - from).normalize_or_zero();
            let (from, end) = (from + room * way, to - ROUND * self.kind.radius * way);
            // A booker at the ball needs no line.
            let from = if (end - from).dot(way) > 0.0 { from } else { end };
            Some((line, from, end))
        });
        ends.collect()
    }
}

pub(super) fn draw(booked: Booked, mut pens: Pens) {
    let radius = ROUND * booked.kind.radius;
    for (line, from, to) in booked.placed() {
        let tint = colours::team_text(line.booker.team);
        pens.strong.line_2d(from, to, tint);
        let way = (to - from).normalize_or_zero();
        let around = to + radius * way;
        if way != Vec2::ZERO {
            pens.strong.circle_2d(around, radius, tint).resolution(32);
        }
    }
}

pub(super) fn write(
    mut contexts: EguiContexts,
    (area, camera): (Res<FreeArea>, Res<PitchCamera>),
    mut placed: ResMut<LabelPlacement>,
    booked: Booked,
    mut choices: Local<[LabelPlace; 2]>,
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let layer = egui::LayerId::new(egui::Order::Background, egui::Id::new("bookings on the pitch"));
    let painter = ctx.layer_painter(layer).with_clip_rect(area.0);
    let mut told = [false; 2];
    for (line, from, to) in booked.placed() {
        let team: Team = line.booker.team;
        if std::mem::replace(&mut told[team.index()], true) {
            continue;
        }
        let galley = lay_out(&painter, &[(line.words(&booked.clock), colours::team_text(team))]);
        let room = galley.size() + 2.0 * PADDING;
        let middle = camera.to_screen(from.midpoint(to));
        let choice = &mut choices[team.index()];
        let free = OFF.into_iter().find(|off| placed.has_room(middle, *off, room));
        let (rect, taken) = placed.place(middle, free.unwrap_or(OFF[0]), room, *choice);
        *choice = taken;
        painter.rect_filled(rect, 4.0, GROUND);
        painter.galley(rect.center_top() + egui::vec2(0.0, PADDING.y), galley, egui::Color32::WHITE);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::b3p::{Book, BookingInput, BookingSettings, Rules};

    const SETTINGS: BookingSettings = BookingSettings {
        rules: Rules::Hardened { release: false },
        threshold: Distance(300),
        timeout: 60,
        renewal: 12,
    };

    fn robot(team: Team, number: u8) -> RobotId {
        RobotId::new(team, number)
    }

    /// A robot that booked the ball in tick 10, and a team mate that heard so in tick 12.
    fn pair() -> [B3p; 2] {
        let (mut booker, mut mate) = (B3p::new(1, SETTINGS), B3p::new(2, SETTINGS));
        let distance = Distance(840);
        booker.step(10, BookingInput::Turn { distance: Some(distance) });
        mate.step(12, BookingInput::Hear { from: 1, book: Book { distance, term: 1, key: distance } });
        [booker, mate]
    }

    #[test]
    fn without_a_selection_the_bookers_are_shown_and_with_one_what_it_believes() {
        let [booker, mate] = pair();
        let robots = || [(robot(Team::Home, 1), &booker), (robot(Team::Home, 2), &mate)].into_iter();
        let line = |age| Line { booker: robot(Team::Home, 1), distance: Distance(840), age };
        assert_eq!(lines(robots(), None, 20), [line(10)]);
        assert_eq!(lines(robots(), Some(robot(Team::Home, 2)), 20), [line(8)]);
        assert_eq!(lines(robots(), Some(robot(Team::Away, 2)), 20), [line(10)]);
        assert_eq!(lines(robots(), Some(robot(Team::Home, 3)), 20), []);
    }

    #[test]
    fn an_expired_booking_is_none() {
        let [_, mate] = pair();
        let id = robot(Team::Home, 2);
        assert!(Line::believed_by(id, &mate, 72).is_some());
        assert_eq!(Line::believed_by(id, &mate, 73), None);
    }

    #[test]
    fn a_line_tells_distance_and_age() {
        let line = Line { booker: robot(Team::Home, 1), distance: Distance(840), age: 18 };
        assert_eq!(line.words(&Clock::new(60.0)), "0.84 m, 0.3 s");
    }
}
