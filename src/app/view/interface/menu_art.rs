//! Small pictures on the menu's cards: a robot in hand before the goal, and one that is looked at.

use bevy::prelude::Vec2 as Metres;
use bevy_egui::egui;
use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};

use crate::app::view::colours::{self, egui as paint};
use crate::geometry::unit;
use crate::ids::Team;

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    Play,
    Watch,
}

/// Length of a robot in a picture, in points.
const ROBOT: f32 = 26.0;

/// Paints a picture into a rectangle.
pub fn paint_picture(painter: &Painter, rect: Rect, picture: Picture) {
    let painter = painter.with_clip_rect(rect);
    painter.rect_filled(rect, 6.0, paint(colours::CARPET));
    let chalk = Stroke::new(2.5, paint(colours::CHALK));
    let at = |x: f32, y: f32| pos2(rect.left() + x * rect.width(), rect.top() + y * rect.height());
    match picture {
        Picture::Play => {
            let goal = Rect::from_min_max(at(0.93, 0.2), at(1.0, 0.8));
            painter.rect_filled(goal, 0.0, paint(colours::YELLOW_GOAL));
            painter.vline(goal.left(), rect.y_range(), chalk);
            painter.circle_stroke(at(0.36, 0.55), 30.0, Stroke::new(3.0, paint(colours::PILOT)));
            robot(&painter, at(0.36, 0.55), 0.18, Team::Home);
            robot(&painter, at(0.82, 0.42), 3.0, Team::Away);
            ball(&painter, at(0.46, 0.49));
        }
        Picture::Watch => {
            let from = at(0.2, 0.62);
            let wedge = [-0.35, 0.0, 0.35].map(|turn| from + 170.0 * to_screen(unit(0.15 + turn)));
            let seen = paint(colours::CARPET).lerp_to_gamma(Color32::WHITE, 0.25);
            let outline = [from].into_iter().chain(wedge).collect();
            painter.add(Shape::convex_polygon(outline, seen, Stroke::NONE));
            painter.vline(at(0.5, 0.0).x, rect.y_range(), chalk);
            painter.circle_stroke(at(0.5, 0.5), 24.0, chalk);
            robot(&painter, from, 0.15, Team::Home);
            robot(&painter, at(0.8, 0.3), 3.5, Team::Away);
            robot(&painter, at(0.74, 0.78), 2.4, Team::Away);
            ball(&painter, at(0.5, 0.46));
        }
    }
}

fn to_screen(v: Metres) -> egui::Vec2 {
    vec2(v.x, -v.y)
}

/// A drive unit and its trailer.
fn robot(painter: &Painter, at: Pos2, heading: f32, team: Team) {
    let ahead = unit(heading);
    let place = |x: f32, y: f32| at + ROBOT * to_screen(ahead * x + ahead.perp() * y);
    let quad = |x: f32, half: Metres, colour: Color32| {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let points = corners.map(|(i, j)| place(x + i * half.x, j * half.y)).to_vec();
        painter.add(Shape::convex_polygon(points, colour, Stroke::NONE));
    };
    let dark = paint(colours::ROBOT);
    quad(-0.35, Metres::new(0.35, 0.4), dark);
    quad(0.25, Metres::new(0.24, 0.44), dark);
    quad(-0.4, Metres::new(0.22, 0.24), paint(colours::team(team)));
    let chevron = vec![place(0.18, 0.22), place(0.38, 0.0), place(0.18, -0.22)];
    painter.add(Shape::line(chevron, Stroke::new(4.0, paint(colours::team(team)))));
}

fn ball(painter: &Painter, at: Pos2) {
    painter.circle(at, 7.0, paint(colours::BALL), (1.5, paint(colours::BALL_EDGE)));
}
