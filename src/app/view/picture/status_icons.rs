//! Small signs beside robots that something is wrong with: each has a shape of its own, not only a colour.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_3, TAU};

use bevy::prelude::*;
use bevy_egui::egui;
use egui::{Color32, Painter, Pos2, Shape, Stroke, vec2};
use smallvec::SmallVec;

use crate::app::view::colours::{self, egui as paint};
use crate::geometry::unit;
use crate::robot::Health;

/// What is the matter with a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatusIcon {
    /// Taken off, or serving a penalty.
    Penalised,
    /// Switched off.
    Crashed,
    /// It does not decide.
    Frozen,
    /// It hears nobody.
    Deaf,
    /// Nobody hears it.
    Mute,
    /// The radio reaches it no more.
    CutOff,
    /// Another robot holds its lock.
    Locked,
}

/// Radius of a sign, in points.
pub const RADIUS: f32 = 8.5;

impl StatusIcon {
    /// All signs, in the order in which they stand beside a robot.
    pub const ALL: [StatusIcon; 7] = [
        StatusIcon::Penalised,
        StatusIcon::Crashed,
        StatusIcon::Frozen,
        StatusIcon::Deaf,
        StatusIcon::Mute,
        StatusIcon::CutOff,
        StatusIcon::Locked,
    ];

    /// The signs of a robot.
    pub fn of(health: Health, off_pitch: bool, cut_off: bool, locked: bool) -> SmallVec<[StatusIcon; 4]> {
        let shown = |sign: &StatusIcon| match sign {
            StatusIcon::Penalised => off_pitch,
            StatusIcon::Crashed => health.crashed,
            StatusIcon::Frozen => health.frozen,
            StatusIcon::Deaf => health.deaf,
            StatusIcon::Mute => health.mute,
            StatusIcon::CutOff => cut_off,
            StatusIcon::Locked => locked,
        };
        StatusIcon::ALL.into_iter().filter(shown).collect()
    }

    /// What the icon says, in words for people.
    pub fn words(self) -> &'static str {
        match self {
            StatusIcon::Penalised => "sent off",
            StatusIcon::Crashed => "crashed",
            StatusIcon::Frozen => "frozen wheels",
            StatusIcon::Deaf => "deaf",
            StatusIcon::Mute => "mute",
            StatusIcon::CutOff => "cut off from the radio",
            StatusIcon::Locked => "locked for a role swap",
        }
    }

    /// Paints the sign around a point.
    pub fn paint(self, painter: &Painter, at: Pos2) {
        let (ground, ink) = match self {
            StatusIcon::Penalised => (paint(colours::TROUBLE), paint(colours::PILOT)),
            StatusIcon::Crashed => (Color32::from_rgb(0x16, 0x16, 0x1A), paint(colours::PENALTY)),
            StatusIcon::Frozen => (Color32::from_rgb(0xD8, 0xEE, 0xFF), Color32::from_rgb(0x1C, 0x5E, 0xA8)),
            StatusIcon::Deaf | StatusIcon::Mute | StatusIcon::CutOff => {
                (paint(colours::CHALK), paint(colours::ROBOT))
            }
            StatusIcon::Locked => (paint(colours::ROBOT), paint(colours::LOCK)),
        };
        painter.circle(at, RADIUS, ground, (1.2, ink));
        let pen = Pen { painter, at, stroke: Stroke::new(1.6, ink), ground };
        match self {
            StatusIcon::Penalised => pen.block(-4.5, -1.5, 4.5, 1.5),
            StatusIcon::Crashed => pen.power(),
            StatusIcon::Frozen => pen.flake(),
            StatusIcon::Deaf => pen.ear(),
            StatusIcon::Mute => pen.bubble(),
            StatusIcon::CutOff => pen.mast(),
            StatusIcon::Locked => pen.padlock(),
        }
    }
}

/// Paints around a point; y grows downwards.
struct Pen<'a> {
    painter: &'a Painter,
    at: Pos2,
    stroke: Stroke,
    ground: Color32,
}

impl Pen<'_> {
    fn line(&self, points: &[(f32, f32)]) {
        let points = points.iter().map(|(x, y)| self.at + vec2(*x, *y)).collect();
        self.painter.add(Shape::line(points, self.stroke));
    }

    fn arc(&self, (x, y): (f32, f32), radius: f32, from: f32, to: f32) {
        const STEPS: u8 = 12;
        let points: Vec<_> = (0..=STEPS)
            .map(|step| radius * unit(from + (to - from) * f32::from(step) / f32::from(STEPS)))
            .map(|v| (x + v.x, y + v.y))
            .collect();
        self.line(&points);
    }

    fn block(&self, left: f32, top: f32, right: f32, bottom: f32) {
        let rect = egui::Rect::from_min_max(self.at + vec2(left, top), self.at + vec2(right, bottom));
        self.painter.rect_filled(rect, 0.5, self.stroke.color);
    }

    /// Across what is missing.
    fn slash(&self) {
        let ends = [self.at + vec2(-5.0, 5.0), self.at + vec2(5.0, -5.0)];
        self.painter.line_segment(ends, (2.4, self.ground));
        self.painter.line_segment(ends, (1.4, paint(colours::TROUBLE)));
    }

    /// The sign on a switch.
    fn power(&self) {
        self.arc((0.0, 0.5), 4.2, -FRAC_PI_3, TAU - 2.0 * FRAC_PI_3);
        self.line(&[(0.0, -5.0), (0.0, 0.5)]);
    }

    fn flake(&self) {
        for spoke in 0..3_u8 {
            let tip = 5.4 * unit(FRAC_PI_2 + f32::from(spoke) * FRAC_PI_3);
            self.line(&[(tip.x, tip.y), (-tip.x, -tip.y)]);
        }
    }

    fn ear(&self) {
        self.arc((0.0, -1.0), 3.8, -0.6 * TAU, 0.12 * TAU);
        self.line(&[(2.6, 1.6), (0.6, 3.4), (0.0, 5.2), (-2.4, 4.6)]);
        self.slash();
    }

    fn bubble(&self) {
        self.line(&[
            (-4.6, -4.0),
            (4.6, -4.0),
            (4.6, 2.0),
            (0.0, 2.0),
            (-2.2, 4.8),
            (-2.2, 2.0),
            (-4.6, 2.0),
            (-4.6, -4.0),
        ]);
        self.slash();
    }

    fn mast(&self) {
        self.line(&[(-2.8, 5.4), (0.0, -2.0), (2.8, 5.4)]);
        self.arc((0.0, -2.4), 3.8, -0.13 * TAU, 0.13 * TAU);
        self.arc((0.0, -2.4), 3.8, 0.37 * TAU, 0.63 * TAU);
        self.slash();
    }

    fn padlock(&self) {
        self.block(-4.0, -0.6, 4.0, 5.0);
        self.arc((0.0, -0.8), 2.8, -0.5 * TAU, 0.0);
    }
}

/// All signs with what they mean, in a row that wraps.
pub fn show_legend(ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        for sign in StatusIcon::ALL {
            let size = egui::Vec2::splat(2.0 * RADIUS + 3.0);
            let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
            sign.paint(ui.painter(), rect.center());
            ui.label(sign.words());
            ui.add_space(8.0);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::RobotFailure;

    #[test]
    fn a_robot_has_a_sign_for_each_thing_that_is_wrong() {
        let ill = Health::default().with(RobotFailure::Deaf).with(RobotFailure::Frozen);
        assert_eq!(
            StatusIcon::of(ill, false, false, true).as_slice(),
            [StatusIcon::Frozen, StatusIcon::Deaf, StatusIcon::Locked]
        );
        assert!(StatusIcon::of(Health::default(), false, false, false).is_empty());
        assert_eq!(
            StatusIcon::of(Health::default(), true, true, false).as_slice(),
            [StatusIcon::Penalised, StatusIcon::CutOff]
        );
    }

    #[test]
    fn every_sign_has_words_of_its_own() {
        let mut words = StatusIcon::ALL.map(StatusIcon::words).to_vec();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), StatusIcon::ALL.len());
    }
}
