//! Paints a state machine's chart, and says what is under the pointer.

use bevy_egui::egui::epaint::CubicBezierShape;
use bevy_egui::egui::{self, Align2, Color32, FontId, Pos2, Rect, Shape, Stroke, StrokeKind, pos2, vec2};

use super::graph::{ChartGraph, Pointed};
use super::heat::Heat;
use super::layout::{ChartLayout, ChartSketch, SketchedBox, SketchedLine, along, controls};
use super::trail::TrailStep;
use super::viewport::Projection;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::format;
use crate::app::view::style::SMALL;
use crate::strategy::StateRef;

/// A chart with everything that is to be seen on it.
pub struct ChartScene<'a> {
    pub graph: &'a ChartGraph,
    pub layout: &'a ChartLayout,
    /// The box of the robot's state, and of those around it, the innermost first, each with the time in it in s.
    pub lit: Vec<(usize, f32)>,
    /// How the robot came there, the newest step first.
    pub trail: Vec<TrailStep>,
    /// The box whose ways out are looked at.
    pub looked: usize,
    /// Whether conditions stand at all lines, or only at those that are looked at.
    pub conditions: bool,
    /// How often everything was reached, if that is to be shown.
    pub heat: Option<Heat>,
    /// Breakpoints of the robot by box and by line: whether they are on.
    pub marks: Marks,
}

/// Where a chart has breakpoints, and whether they are on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    pub boxes: Vec<Option<bool>>,
    pub lines: Vec<Option<bool>>,
}

/// Around a name in its box, and around a condition, in points.
const BOX_PAD: egui::Vec2 = vec2(10.0, 5.0);
const LABEL_PAD: egui::Vec2 = vec2(4.0, 1.0);
/// Text is left out of a chart that is smaller than this.
const NAMES_FROM: f32 = 0.4;
const CONDITIONS_FROM: f32 = 0.7;
/// The pointer means a line that is no farther away than this, in points.
const NEAR: f32 = 5.0;
/// Points of a curve that are looked at for that.
const STEPS: usize = 12;

/// What is laid out for a graph, with text as wide as `measure` says for each row.
pub fn sketch(graph: &ChartGraph, measure: impl Fn(&str) -> egui::Vec2) -> ChartSketch {
    let row = measure("M").y;
    let boxes = graph.boxes.iter().map(|state| SketchedBox {
        size: vec2(measure(&state.name).x.max(measure("for 59:59 min").x), 2.0 * row) + 2.0 * BOX_PAD,
        band: match state.state {
            StateRef::Composite(own) => own + 1,
            StateRef::Plain(_) => state.within.map_or(0, |around| around + 1),
        },
    });
    let lines = graph.lines.iter().map(|line| {
        let rows = line.label();
        let width = rows.iter().map(|row| measure(row).x).fold(0.0, f32::max);
        let label = vec2(width, row * rows.len() as f32) + 2.0 * LABEL_PAD;
        SketchedLine { from: line.from, to: line.to, label: (!rows.is_empty()).then_some(label) }
    });
    let frames = graph.boxes.iter().filter(|state| matches!(state.state, StateRef::Composite(_)));
    ChartSketch {
        boxes: boxes.collect(),
        start: graph.start,
        lines: lines.collect(),
        frames: frames.map(|state| state.within.map_or(0, |around| around + 1)).collect(),
    }
}

impl ChartScene<'_> {
    /// What is at a point of the screen.
    pub fn pointed(&self, seen: &Projection, at: Pos2) -> Option<Pointed> {
        let place = seen.to_chart(at);
        let inside = |rect: &Rect| rect.contains(place);
        if let Some(found) = self.layout.boxes.iter().position(inside) {
            return Some(Pointed::Box(found));
        }
        if let Some(found) = self.layout.lines.iter().position(|route| inside(&route.label)) {
            return Some(Pointed::Line(found));
        }
        let lines = self.layout.lines.iter().enumerate().map(|(line, route)| {
            let steps = route
                .pieces
                .iter()
                .flat_map(|piece| (0..=STEPS).map(|step| along(*piece, step as f32 / STEPS as f32)));
            let nearest = steps.map(|on| (on - place).length()).fold(f32::INFINITY, f32::min);
            (nearest * seen.zoom, line)
        });
        let near = lines.filter(|(distance, _)| *distance < NEAR).min_by(|a, b| a.0.total_cmp(&b.0));
        near.map(|(_, line)| Pointed::Line(line))
    }

    /// Paints everything.
    pub fn paint(&self, painter: &egui::Painter, seen: &Projection, pointed: Option<Pointed>) {
        for frame in &self.layout.frames {
            let place = seen.place(*frame);
            painter.rect(
                place,
                8.0,
                paint(colours::RAISED).gamma_multiply(0.35),
                (1.0, paint(colours::QUIET).gamma_multiply(0.5)),
                StrokeKind::Inside,
            );
        }
        // What matters lies above what does not.
        let mut lines: Vec<usize> = (0..self.graph.lines.len()).collect();
        lines.sort_by_key(|line| (pointed == Some(Pointed::Line(*line)), self.weight(*line)));
        for line in &lines {
            self.paint_line(painter, seen, *line, pointed == Some(Pointed::Line(*line)));
        }
        for line in &lines {
            self.paint_label(painter, seen, *line, pointed == Some(Pointed::Line(*line)));
        }
        for state in 0..self.graph.boxes.len() {
            self.paint_box(painter, seen, state, pointed == Some(Pointed::Box(state)));
        }
        self.paint_start(painter, seen);
    }

    /// 2 for a line that was taken of late, 1 for one that is looked at, 0 for others.
    fn weight(&self, line: usize) -> u8 {
        if self.step(line).is_some() { 2 } else { u8::from(self.graph.lines[line].from == self.looked) }
    }

    /// The last time that a line was taken, as far as it is shown.
    fn step(&self, line: usize) -> Option<&TrailStep> {
        self.trail.iter().find(|step| step.line == line)
    }

    fn stroke(&self, line: usize, pointed: bool, zoom: f32) -> Stroke {
        let base = paint(colours::QUIET).gamma_multiply(0.6);
        let call = paint(colours::CALL);
        let (width, colour) = match self.step(line) {
            _ if pointed => (2.2, paint(colours::PILOT)),
            Some(step) => {
                let faded = base.lerp_to_gamma(call, step.strength);
                (1.6 + 3.0 * step.flash, faded.lerp_to_gamma(paint(colours::PILOT), 0.7 * step.flash))
            }
            None if self.heat.is_some() => match self.heat_of_line(line) {
                Some(share) => (1.1 + 1.8 * share, paint(colours::heat(share))),
                None => (1.0, paint(colours::NEVER).gamma_multiply(0.6)),
            },
            None if self.graph.lines[line].from == self.looked => (1.3, paint(colours::TEXT)),
            None => (1.0, base),
        };
        Stroke::new(width * zoom.clamp(0.6, 1.5), colour)
    }

    fn heat_of_line(&self, line: usize) -> Option<f32> {
        self.heat.as_ref()?.of_line(line)
    }

    fn paint_line(&self, painter: &egui::Painter, seen: &Projection, line: usize, pointed: bool) {
        let stroke = self.stroke(line, pointed, seen.zoom);
        let route = &self.layout.lines[line];
        let is_dead = self.heat.is_some() && self.heat_of_line(line).is_none();
        if self.graph.lines[line].ways.is_empty() || is_dead {
            // Between two pieces is the condition.
            for piece in &route.pieces {
                let along = (0..=STEPS).map(|step| along(*piece, step as f32 / STEPS as f32));
                let points: Vec<Pos2> = along.map(|at| seen.to_screen(at)).collect();
                if is_dead {
                    painter.extend(Shape::dashed_line(&points, stroke, 5.0, 4.0));
                } else {
                    painter.extend(Shape::dotted_line(&points, stroke.color, 4.0, 1.0));
                }
            }
        } else {
            for piece in &route.pieces {
                let [from, to] = piece.map(|at| seen.to_screen(at));
                if from.x == to.x || from.y == to.y {
                    painter.line_segment([from, to], stroke);
                } else {
                    let [leave, arrive] = controls(*piece).map(|at| seen.to_screen(at));
                    let curve = [from, leave, arrive, to];
                    painter.add(CubicBezierShape::from_points_stroke(
                        curve,
                        false,
                        Color32::TRANSPARENT,
                        stroke,
                    ));
                }
            }
        }
        if let Some([from, to]) = route.pieces.last().map(|piece| piece.map(|at| seen.to_screen(at))) {
            let way = if from.x == to.x {
                vec2(0.0, (to.y - from.y).signum())
            } else {
                vec2((to.x - from.x).signum(), 0.0)
            };
            tip(painter, to, way, 7.0 * seen.zoom.clamp(0.6, 1.5), stroke.color);
        }
    }

    fn paint_label(&self, painter: &egui::Painter, seen: &Projection, line: usize, pointed: bool) {
        let chosen = pointed || self.weight(line) > 0;
        if seen.zoom < CONDITIONS_FROM || !(self.conditions || chosen) {
            return;
        }
        let place = seen.place(self.layout.lines[line].label);
        if !seen.rect.intersects(place) {
            return;
        }
        let colour = match self.step(line) {
            _ if pointed => paint(colours::PILOT),
            Some(step) => paint(colours::QUIET).lerp_to_gamma(paint(colours::CALL), step.strength),
            None if chosen => paint(colours::TEXT),
            None => paint(colours::QUIET).gamma_multiply(0.8),
        };
        let flash = self.step(line).map_or(0.0, |step| step.flash);
        if flash > 0.0 {
            painter.rect_filled(place, 3.0, paint(colours::CALL).gamma_multiply(0.35 * flash));
        }
        self.paint_mark(
            painter,
            place.left_center() - vec2(3.0 * seen.zoom, 0.0),
            seen.zoom,
            self.marks.lines.get(line),
        );
        let rows = self.graph.lines[line].label().join("\n");
        let at = place.min + LABEL_PAD * seen.zoom;
        painter.text(at, Align2::LEFT_TOP, rows, font(seen.zoom), colour);
    }

    fn paint_box(&self, painter: &egui::Painter, seen: &Projection, state: usize, pointed: bool) {
        let place = seen.place(self.layout.boxes[state]);
        if !seen.rect.intersects(place) {
            return;
        }
        let lit = self.lit.iter().position(|(lit, _)| *lit == state);
        let is_composite = matches!(self.graph.boxes[state].state, StateRef::Composite(_));
        let fill = match lit {
            Some(0) => paint(colours::ACCENT).gamma_multiply(0.9),
            _ if self.heat.is_some() => match self.heat_of_box(state) {
                Some(share) => paint(colours::RAISED).lerp_to_gamma(paint(colours::heat(share)), 0.45),
                None => paint(colours::SUNKEN),
            },
            _ if is_composite => paint(colours::PANEL),
            _ => paint(colours::RAISED),
        };
        let edge = match lit {
            _ if pointed => Stroke::new(2.0, paint(colours::PILOT)),
            Some(_) => Stroke::new(2.0, paint(colours::ACCENT)),
            None if state == self.looked => Stroke::new(1.5, paint(colours::TEXT)),
            None => Stroke::new(1.0, paint(colours::QUIET).gamma_multiply(0.7)),
        };
        painter.rect(place, 5.0, fill, edge, StrokeKind::Inside);
        self.paint_mark(
            painter,
            place.right_top() + vec2(-7.0, 7.0) * seen.zoom,
            seen.zoom,
            self.marks.boxes.get(state),
        );
        if seen.zoom < NAMES_FROM {
            return;
        }
        let time = lit.map(|lit| format!("for {}", format::seconds(self.lit[lit].1)));
        let counted =
            self.heat.as_ref().and_then(|heat| heat.boxes.get(state)).map(|counted| match counted.entered {
                0 => "never".to_owned(),
                entered => format!("{entered}×, {}", format::seconds(counted.seconds)),
            });
        let time = time.or(counted);
        let colour = if lit == Some(0) { paint(colours::PILOT) } else { paint(colours::TEXT) };
        let name = &self.graph.boxes[state].name;
        let up = if time.is_some() { -0.5 * SMALL * seen.zoom } else { 0.0 };
        let middle = place.center() + vec2(0.0, up);
        painter.text(middle, Align2::CENTER_CENTER, name, font(seen.zoom), colour);
        if let Some(time) = time {
            let below = place.center() + vec2(0.0, 0.65 * SMALL * seen.zoom);
            painter.text(below, Align2::CENTER_CENTER, time, font(seen.zoom), colour);
        }
    }

    /// A breakpoint: a full dot, or a ring if it is off.
    fn paint_mark(&self, painter: &egui::Painter, at: Pos2, zoom: f32, mark: Option<&Option<bool>>) {
        let colour = paint(colours::BREAKPOINT);
        match mark.copied().flatten() {
            Some(true) => drop(painter.circle_filled(at, 4.0 * zoom, colour)),
            Some(false) => drop(painter.circle_stroke(at, 3.5 * zoom, (1.3, colour))),
            None => {}
        }
    }

    fn heat_of_box(&self, state: usize) -> Option<f32> {
        self.heat.as_ref()?.of_box(state)
    }

    /// An arrow to where robots begin.
    fn paint_start(&self, painter: &egui::Painter, seen: &Projection) {
        let Some(start) = self.layout.boxes.get(self.graph.start) else { return };
        let corner = seen.to_screen(pos2(start.left(), start.top() + 5.0));
        let colour = paint(colours::TEXT);
        let from = corner - vec2(11.0 * seen.zoom, 0.0);
        painter.circle_filled(from, 2.5 * seen.zoom, colour);
        painter.line_segment([from, corner], (1.0, colour));
        tip(painter, corner, vec2(1.0, 0.0), 5.0 * seen.zoom, colour);
    }
}

/// Text on the chart grows and shrinks with it.
fn font(zoom: f32) -> FontId {
    FontId::proportional(SMALL * zoom)
}

fn tip(painter: &egui::Painter, at: Pos2, along: egui::Vec2, length: f32, colour: Color32) {
    let back = at - length * along;
    let aside = 0.45 * length * along.rot90();
    painter.add(Shape::convex_polygon(vec![at, back + aside, back - aside], colour, Stroke::NONE));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::inspector::chart::layout::tests::assert_readable;
    use crate::data::{AssetFolder, AssetKind, Source};
    use crate::strategy::Strategy;

    #[test]
    fn the_charts_of_all_shipped_machines_are_readable() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let mut largest = 0;
        for name in assets.names(AssetKind::Strategy) {
            let source = Source::read(assets.file(AssetKind::Strategy, &name)).expect("it can be read");
            let strategy = Strategy::parse(&assets, &source, None).unwrap_or_else(|error| panic!("{error}"));
            for (index, machine) in strategy.machines.iter().enumerate() {
                let graph = ChartGraph::of(machine, index);
                let sketch = sketch(&graph, |text| vec2(6.5 * text.chars().count() as f32, 16.0));
                let layout = sketch.lay_out();
                assert_readable(&sketch, &layout);
                largest = largest.max(graph.lines.len());
            }
        }
        assert!(largest > 30, "{largest} lines");
    }
}
