//! A drawing as SVG, in centimetres, y downwards.

use bevy::math::Vec2;
use svg::Document;
use svg::node::element::{Circle, Polygon, Polyline, Rectangle, Text, Title};

use super::figure::{Drawing, Figure, Tint};
use super::palette;

/// Units of the picture in a metre.
const CENTIMETRES: f32 = 100.0;

/// The whole file. Its title says what it shows.
pub fn svg_of(drawing: &Drawing, title: &str) -> String {
    let half = drawing.half * CENTIMETRES;
    let corner = (-rounded(half.x), -rounded(half.y));
    let size = (rounded(2.0 * half.x), rounded(2.0 * half.y));
    let ground = Rectangle::new()
        .set("x", corner.0)
        .set("y", corner.1)
        .set("width", size.0)
        .set("height", size.1)
        .set("fill", palette::hex(drawing.ground));
    let document = Document::new()
        .set("viewBox", (corner.0, corner.1, size.0, size.1))
        .set("font-family", "Ubuntu, DejaVu Sans, sans-serif")
        .set("text-anchor", "middle")
        .add(Title::new(title))
        .add(ground);
    let document = drawing.figures.iter().fold(document, add);
    format!("{document}\n")
}

fn add(document: Document, figure: &Figure) -> Document {
    match figure {
        Figure::Polygon { points, fill } => {
            let polygon = Polygon::new().set("points", listed(points));
            document.add(filled(polygon, *fill))
        }
        Figure::Line { points, closed: true, width, tint, dash } => {
            let line = Polygon::new().set("points", listed(points)).set("stroke-linejoin", "miter");
            document.add(stroked(line, *width, *tint, *dash))
        }
        Figure::Line { points, closed: false, width, tint, dash } => {
            let line = Polyline::new().set("points", listed(points)).set("stroke-linejoin", "round");
            document.add(stroked(line, *width, *tint, *dash))
        }
        Figure::Disc { centre, radius, fill } => document.add(filled(circle(*centre, *radius), *fill)),
        Figure::Circle { centre, radius, width, tint, dash } => {
            document.add(stroked(circle(*centre, *radius), *width, *tint, *dash))
        }
        Figure::Text { at, height, text, tint } => {
            // Digits are about seven tenths as high as their font.
            let size = height / 0.72;
            let text = Text::new(text.as_str())
                .set("x", coordinate(at.x))
                .set("y", coordinate(height / 2.0 - at.y))
                .set("font-size", coordinate(size));
            document.add(filled(text, *tint))
        }
    }
}

fn circle(centre: Vec2, radius: f32) -> Circle {
    Circle::new()
        .set("cx", coordinate(centre.x))
        .set("cy", coordinate(-centre.y))
        .set("r", coordinate(radius))
}

fn filled<T: svg::Node>(mut node: T, fill: Tint) -> T {
    node.assign("fill", palette::hex(fill.colour));
    if fill.opacity < 1.0 {
        node.assign("fill-opacity", rounded(fill.opacity));
    }
    node
}

fn stroked<T: svg::Node>(mut node: T, width: f32, tint: Tint, dash: Option<f32>) -> T {
    node.assign("fill", "none");
    node.assign("stroke", palette::hex(tint.colour));
    node.assign("stroke-width", coordinate(width));
    if tint.opacity < 1.0 {
        node.assign("stroke-opacity", rounded(tint.opacity));
    }
    if let Some(dash) = dash {
        node.assign("stroke-dasharray", coordinate(dash));
    }
    node
}

fn listed(points: &[Vec2]) -> String {
    let points = points.iter().map(|point| format!("{},{}", coordinate(point.x), coordinate(-point.y)));
    points.collect::<Vec<_>>().join(" ")
}

fn coordinate(metres: f32) -> f32 {
    rounded(metres * CENTIMETRES)
}

/// To hundredths, without a negative zero.
fn rounded(value: f32) -> f32 {
    (value * 100.0).round() / 100.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_stand_where_they_are_with_y_downwards() {
        let fill = Tint { colour: 0xFF_8A_1F, opacity: 0.5 };
        let drawing = Drawing {
            half: Vec2::new(2.0, 1.0),
            ground: 0x36_3D_3A,
            figures: vec![
                Figure::Disc { centre: Vec2::new(0.5, 0.25), radius: 0.11, fill },
                Figure::Text { at: Vec2::ZERO, height: 0.2, text: "<3>".into(), tint: Tint::solid(0) },
            ],
        };
        let text = svg_of(&drawing, "A & B");
        for wanted in [
            "viewBox=\"-200 -100 400 200\"",
            "cx=\"50\" cy=\"-25\"",
            "fill=\"#FF8A1F\" fill-opacity=\"0.5\"",
            "&lt;3&gt;",
            "A &amp; B",
        ] {
            assert!(text.contains(wanted), "{wanted} in {text}");
        }
    }
}
