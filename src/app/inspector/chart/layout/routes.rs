//! From columns and heights to boxes, lines and frames.

use bevy_egui::egui::{Pos2, Rect, Vec2, pos2, vec2};

use super::columns::{Columns, ItemKind, LOOP};
use super::sketch::{ChartLayout, ChartSketch, FRAME, MARGIN, Route};

/// Between a column and the next where few lines run, and what each line adds, in points.
const BETWEEN: f32 = 22.0;
const A_LINE: f32 = 1.5;
/// The widest that this becomes, in points.
const WIDEST: f32 = 64.0;
/// By how much the two ends of a line that turns back at its label lie apart, in points.
const TURN: f32 = 3.0;

/// The left and right edge of each column.
fn edges(columns: &Columns, deepest: usize) -> Vec<[f32; 2]> {
    let mut lines = vec![0; columns.columns.len()];
    columns.links().for_each(|[left, _]| lines[columns.items[left].column] += 1);
    let mut at = MARGIN + FRAME * deepest as f32;
    let mut edges = Vec::new();
    for (column, lines) in columns.columns.iter().zip(lines) {
        let width = column.iter().map(|item| columns.items[*item].size.x).fold(0.0, f32::max);
        edges.push([at, at + width]);
        at += width + (BETWEEN + A_LINE * lines as f32).min(WIDEST);
    }
    edges
}

pub fn draw(sketch: &ChartSketch, columns: &Columns, middles: &[f32]) -> ChartLayout {
    let depths = depths(&sketch.frames);
    let edges = edges(columns, depths.into_iter().max().unwrap_or(0));
    let cells: Vec<Rect> = (columns.items.iter().zip(middles))
        .map(|(item, y)| {
            let [left, right] = edges[item.column];
            Rect::from_center_size(pos2((left + right) / 2.0, *y), item.size)
        })
        .collect();
    // Loops are above the box, within its cell.
    let boxes: Vec<Rect> = (cells.iter().zip(&columns.ends))
        .map(|(cell, ends)| Rect::from_min_max(cell.min + vec2(0.0, ends.loops.y), cell.max))
        .collect();
    let ends = line_ends(columns, middles, &boxes);
    let mut above: Vec<f32> = cells.iter().map(Rect::top).collect();
    let lines = (columns.chains.iter().enumerate())
        .map(|(line, chain)| match &chain[..] {
            [] => {
                let sketched = &sketch.lines[line];
                self_loop(boxes[sketched.from], sketched.label.unwrap_or_default(), &mut above[sketched.from])
            }
            chain => route(columns, chain, &cells, &edges, ends[line]),
        })
        .collect();
    let frames = frames(sketch, columns, &cells);
    let inside = cells.iter().chain(&frames).fold(Rect::NOTHING, |all, rect| all.union(*rect));
    let size =
        if inside.is_positive() { inside.max.to_vec2() + vec2(MARGIN, MARGIN) } else { vec2(0.0, 0.0) };
    ChartLayout { boxes, lines, frames, size }
}

/// Where each line begins and ends: spread over the side of the box, by where it comes from or goes to.
fn line_ends(columns: &Columns, middles: &[f32], boxes: &[Rect]) -> Vec<[Pos2; 2]> {
    let mut ends = vec![[Pos2::ZERO; 2]; columns.chains.len()];
    for (at, place) in boxes.iter().enumerate() {
        // Left and right side: which end of which line, and how high the item beside it is.
        let mut sides: [Vec<(f32, usize, usize)>; 2] = Default::default();
        for (line, chain) in columns.chains.iter().enumerate().filter(|(_, chain)| !chain.is_empty()) {
            let last = chain.len() - 1;
            for (end, own, beside) in [(0, chain[0], chain[1]), (1, chain[last], chain[last - 1])] {
                if own == at {
                    let is_right = columns.items[beside].column > columns.items[own].column;
                    sides[usize::from(is_right)].push((middles[beside], line, end));
                }
            }
        }
        for (side, mut list) in sides.into_iter().enumerate() {
            list.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
            let x = if side == 0 { place.left() } else { place.right() };
            let step = place.height() / (list.len() + 1) as f32;
            for (number, (_, line, end)) in list.into_iter().enumerate() {
                ends[line][end] = pos2(x, place.top() + step * (number + 1) as f32);
            }
        }
    }
    ends
}

/// A line from box to box through the places that are its own.
fn route(
    columns: &Columns,
    chain: &[usize],
    cells: &[Rect],
    edges: &[[f32; 2]],
    [start, end]: [Pos2; 2],
) -> Route {
    let (first, last) = (chain[0], chain[chain.len() - 1]);
    // Level to the edge of its column first, where wider boxes may be above and below.
    let edge = |item: usize, end: Pos2| {
        let [left, right] = edges[columns.items[item].column];
        pos2(if end.x > (left + right) / 2.0 { right } else { left }, end.y)
    };
    let mut route = Route { pieces: vec![[start, edge(first, start)]], label: Rect::NOTHING };
    let mut at = edge(first, start);
    let turns = columns.items[first].column == columns.items[last].column;
    for item in &chain[1..chain.len() - 1] {
        let cell = cells[*item];
        let [left, right] = edges[columns.items[*item].column];
        let is_label = matches!(columns.items[*item].kind, ItemKind::Label(_));
        if is_label {
            route.label = cell;
        }
        let y = cell.center().y;
        if turns {
            // Its label is at the far end of it, on the side from which it comes.
            let (near, side) = if at.x <= left { (left, cell.left()) } else { (right, cell.right()) };
            let down = if start.y <= end.y { TURN } else { -TURN };
            route.pieces.extend([[at, pos2(near, y - down)], [pos2(near, y - down), pos2(side, y - down)]]);
            route.pieces.push([pos2(side, y + down), pos2(near, y + down)]);
            at = pos2(near, y + down);
            continue;
        }
        let (enters, leaves) = if at.x <= left { (left, right) } else { (right, left) };
        route.pieces.push([at, pos2(enters, y)]);
        let (before, behind) =
            if enters == left { (cell.left(), cell.right()) } else { (cell.right(), cell.left()) };
        if is_label && cell.width() > 0.0 {
            route.pieces.extend([[pos2(enters, y), pos2(before, y)], [pos2(behind, y), pos2(leaves, y)]]);
        } else {
            route.pieces.push([pos2(enters, y), pos2(leaves, y)]);
        }
        at = pos2(leaves, y);
    }
    route.pieces.extend([[at, edge(last, end)], [edge(last, end), end]]);
    route.pieces.retain(|[from, to]| from != to);
    route
}

/// A line from a box to itself: up at its left, along its label and down at its right.
fn self_loop(place: Rect, size: Vec2, above: &mut f32) -> Route {
    let label = Rect::from_min_size(pos2(place.center().x - size.x / 2.0, *above), size);
    *above += size.y + LOOP;
    let [left, right] = [place.left() + 8.0, place.right() - 8.0];
    let y = label.bottom() + LOOP / 2.0;
    let pieces = vec![
        [pos2(left, place.top()), pos2(left, y)],
        [pos2(left, y), pos2(right, y)],
        [pos2(right, y), pos2(right, place.top())],
    ];
    Route { pieces, label }
}

fn frames(sketch: &ChartSketch, columns: &Columns, cells: &[Rect]) -> Vec<Rect> {
    let mut frames = vec![Rect::NOTHING; sketch.frames.len()];
    for (item, cell) in columns.items.iter().zip(cells) {
        if let Some(frame) = item.band.checked_sub(1) {
            frames[frame] = frames[frame].union(cell.expand(FRAME));
        }
    }
    for frame in (0..frames.len()).rev() {
        if let Some(around) = sketch.frames[frame].checked_sub(1) {
            frames[around] = frames[around].union(frames[frame].expand2(vec2(FRAME, FRAME)));
        }
    }
    frames
}

/// How many frames deep what is in each frame lies.
fn depths(frames: &[usize]) -> Vec<usize> {
    let mut depths = Vec::with_capacity(frames.len());
    for around in frames {
        depths.push(1 + around.checked_sub(1).map_or(0, |frame| depths[frame]));
    }
    depths
}
