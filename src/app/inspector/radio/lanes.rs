//! The ground of the charts: a lane for each robot, and the times below the lanes.

use bevy_egui::egui::{self, Align2, Rect, pos2, vec2};

use super::data::{ChartSpan, RadioData, RadioView};
use super::layout::Axes;
use crate::app::view::colours;

/// Width of the robots' names before the lanes, in points.
pub const NAMES: f32 = 106.0;
/// Height of the times below the lanes, and the least height of a lane, in points.
const TIMES: f32 = 18.0;
const LANE: f32 = 20.0;
/// Size of the text in charts, in points.
pub const TEXT: f32 = 13.0;

/// Shows the ground of a chart that fills the panel. Returns the axes, and the response of the whole with the names.
pub fn show_lanes(
    ui: &mut egui::Ui,
    lanes: usize,
    heard: &RadioData,
    view: &RadioView,
) -> (Axes, egui::Response) {
    let room = ui.available_size().max(vec2(200.0, lanes as f32 * LANE + TIMES));
    let (whole, response) = ui.allocate_exact_size(room, egui::Sense::CLICK);
    let rect = Rect::from_min_max(whole.min + vec2(NAMES, 0.0), whole.max - vec2(4.0, TIMES));
    let axes = Axes {
        rect,
        now: heard.clock.tick as f64 - 1.0 + f64::from(heard.playback.between),
        span: f64::from(view.span.seconds()) / f64::from(heard.clock.dt),
        lanes,
    };
    ui.painter().rect_filled(rect, 3.0, colours::egui(colours::SUNKEN));
    paint_times(ui.painter(), &axes, heard.clock.dt);
    (axes, response)
}

/// The time that the charts show.
pub fn show_spans(ui: &mut egui::Ui, view: &mut RadioView) {
    ui.weak("Last");
    for span in ChartSpan::ALL {
        let tip = "The time from the left edge to the right one";
        ui.selectable_value(&mut view.span, span, format!("{} s", span.seconds())).on_hover_text(tip);
    }
}

/// Writes the times below the lanes, with a faint line through them at each.
fn paint_times(painter: &egui::Painter, axes: &Axes, dt: f32) {
    let quiet = colours::egui(colours::QUIET);
    let (marks, _) = axes.marks(dt);
    for mark in marks {
        let x = axes.x(mark as f64);
        painter.vline(x, axes.rect.y_range(), (1.0, quiet.gamma_multiply(0.18)));
        let seconds = (mark as f64 * f64::from(dt)).round();
        let text = format!("{seconds} s");
        let at = pos2(x, axes.rect.bottom() + 2.0);
        let half = 18.0;
        if x - half > axes.rect.left() && x + half < axes.rect.right() + 4.0 {
            painter.text(at, Align2::CENTER_TOP, text, egui::FontId::proportional(TEXT), quiet);
        }
    }
}
