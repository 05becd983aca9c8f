use bevy_egui::egui::{Pos2, Rect, vec2};
use proptest::prelude::*;

use super::sketch::Route;
use super::*;

fn sketched(boxes: &[(f32, f32, usize)], lines: &[(usize, usize, f32)], frames: &[usize]) -> ChartSketch {
    let count = boxes.len();
    let bands = frames.len() + 1;
    ChartSketch {
        boxes: (boxes.iter())
            .map(|(width, height, band)| SketchedBox { size: vec2(*width, *height), band: band % bands })
            .collect(),
        start: 0,
        lines: (lines.iter())
            .map(|(from, to, width)| SketchedLine {
                from: from % count,
                to: to % count,
                label: (*width > 10.0).then_some(vec2(*width, 16.0)),
            })
            .collect(),
        // A frame lies in one before it, or in none.
        frames: frames.iter().enumerate().map(|(frame, around)| around % (frame + 1)).collect(),
    }
}

fn any_sketch() -> impl Strategy<Value = ChartSketch> {
    let boxes = proptest::collection::vec((40.0f32..160.0, 20.0f32..50.0, 0usize..9), 1..12);
    let lines = proptest::collection::vec((0usize..99, 0usize..99, 0.0f32..180.0), 0..40);
    let frames = proptest::collection::vec(0usize..9, 0..4);
    (boxes, lines, frames).prop_map(|(boxes, lines, frames)| sketched(&boxes, &lines, &frames))
}

fn overlap(a: Rect, b: Rect) -> bool {
    let common = a.intersect(b);
    common.width() > 0.1 && common.height() > 0.1
}

/// Whether a frame is around something in a band.
fn is_in(sketch: &ChartSketch, mut band: usize, frame: usize) -> bool {
    while band > 0 {
        if band == frame + 1 {
            return true;
        }
        band = sketch.frames[band - 1];
    }
    false
}

/// Everything that a reader of the chart relies on.
pub fn assert_readable(sketch: &ChartSketch, layout: &ChartLayout) {
    let whole = Rect::from_min_size(Pos2::ZERO, layout.size);
    let labels = || layout.lines.iter().zip(&sketch.lines).filter(|(_, line)| line.label.is_some());
    let boxes = layout.boxes.iter().copied().chain(labels().map(|(route, _)| route.label));
    let boxes: Vec<Rect> = boxes.collect();
    for (number, a) in boxes.iter().enumerate() {
        assert!(whole.contains_rect(*a), "{a} is outside of {whole}");
        for b in &boxes[..number] {
            assert!(!overlap(*a, *b), "{a} and {b} overlap");
        }
    }
    for (place, wanted) in layout.boxes.iter().zip(&sketch.boxes) {
        assert!(place.width() + 0.1 >= wanted.size.x && place.height() + 0.1 >= wanted.size.y);
    }
    for (route, line) in layout.lines.iter().zip(&sketch.lines) {
        assert_joined(route, [layout.boxes[line.from], layout.boxes[line.to]]);
        for place in boxes.iter().map(|place| place.shrink(0.5)) {
            for piece in &route.pieces {
                let inside =
                    (0..=20).map(|step| along(*piece, step as f32 / 20.0)).find(|at| place.contains(*at));
                assert!(
                    inside.is_none(),
                    "a line from {} to {} crosses {place} at {inside:?}",
                    line.from,
                    line.to
                );
            }
        }
    }
    for (frame, place) in layout.frames.iter().enumerate() {
        for (at, wanted) in layout.boxes.iter().zip(&sketch.boxes) {
            if is_in(sketch, wanted.band, frame) {
                assert!(place.contains_rect(*at), "frame {frame}, {place}, is not around {at}");
            } else {
                assert!(!overlap(*place, *at), "frame {frame}, {place}, has the alien {at} in it");
            }
        }
    }
    assert_distinguishable(layout);
}

/// A line begins at the edge of its first box and ends at that of its last one, without a gap but for its label.
fn assert_joined(route: &Route, [from, to]: [Rect; 2]) {
    let on_edge = |place: Rect, at: Pos2| place.expand(0.6).contains(at) && !place.shrink(0.6).contains(at);
    let (first, last) = (route.pieces[0], route.pieces[route.pieces.len() - 1]);
    assert!(on_edge(from, first[0]) && on_edge(to, last[1]), "{route:?} between {from} and {to}");
    for pair in route.pieces.windows(2) {
        let gap = Rect::from_two_pos(pair[0][1], pair[1][0]);
        assert!(
            gap.width() < 0.1 && gap.height() < 0.1 || route.label.expand(1.0).contains_rect(gap),
            "{route:?}"
        );
    }
}

/// No two lines begin or end at the same point.
fn assert_distinguishable(layout: &ChartLayout) {
    let ends =
        layout.lines.iter().flat_map(|route| [route.pieces[0][0], route.pieces[route.pieces.len() - 1][1]]);
    let mut ends: Vec<(i32, i32)> =
        ends.map(|at| ((10.0 * at.x).round() as i32, (10.0 * at.y).round() as i32)).collect();
    let all = ends.len();
    ends.sort_unstable();
    ends.dedup();
    assert_eq!(ends.len(), all, "lines meet at their ends");
}

/// Self loops of one box share its upper edge.
fn without_double_loops(mut sketch: ChartSketch) -> ChartSketch {
    let mut seen = Vec::new();
    sketch.lines.retain(|line| {
        let new = !seen.contains(&(line.from, line.to));
        seen.push((line.from, line.to));
        new
    });
    sketch
}

proptest! {
    #[test]
    fn boxes_and_labels_lie_apart_lines_cross_no_box_and_frames_hold_what_is_theirs(sketch in any_sketch()) {
        let sketch = without_double_loops(sketch);
        let layout = sketch.lay_out();
        assert_readable(&sketch, &layout);
        assert_eq!(layout, sketch.lay_out());
    }
}

#[test]
fn a_chain_runs_from_left_to_right_on_one_line_and_a_way_back_has_a_place_of_its_own() {
    let boxes = [(80.0, 30.0, 0); 3];
    let layout = sketched(&boxes, &[(0, 1, 60.0), (1, 2, 60.0), (2, 0, 60.0)], &[]).lay_out();
    let [a, b, c] = [0, 1, 2].map(|at| layout.boxes[at].center());
    assert!(a.x < b.x && b.x < c.x, "{a} {b} {c}");
    let back = layout.lines[2].label.center();
    assert!((back.y - layout.lines[0].label.center().y).abs() > 16.0, "{layout:?}");
    assert!(layout.lines[2].pieces[0][0].x < layout.boxes[2].center().x, "it leaves at the left");
}

#[test]
fn a_loop_stands_above_its_box() {
    let sketch = sketched(&[(80.0, 30.0, 0)], &[(0, 0, 60.0)], &[]);
    let layout = sketch.lay_out();
    assert!(layout.lines[0].label.bottom() < layout.boxes[0].top());
    assert_readable(&sketch, &layout);
}

#[test]
fn nothing_is_laid_out_as_nothing() {
    assert_eq!(ChartSketch::default().lay_out(), ChartLayout::default());
}
