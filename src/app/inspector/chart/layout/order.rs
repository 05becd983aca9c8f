//! The order within each column: as few lines cross as the barycentre method finds (Sugiyama and others, 1981, section III). Items of
//! a band stay together.

use super::columns::Columns;
use super::sketch::GAP;

/// Passes over all columns.
const SWEEPS: usize = 24;
/// In a chart with more links, crossings are not counted, and the order after few passes is taken.
const MANY: usize = 1500;
const FEW_SWEEPS: usize = 4;

pub fn order(columns: &mut Columns) {
    let neighbours = columns.neighbours();
    let links: Vec<[usize; 2]> = columns.links().collect();
    let counts = links.len() <= MANY;
    for column in &mut columns.columns {
        column.sort_by_key(|item| columns.items[*item].band);
    }
    let mut best = (usize::MAX, columns.columns.clone());
    for sweep in 0..if counts { SWEEPS } else { FEW_SWEEPS } {
        // To the right by what is at the left, and back.
        let side = sweep % 2;
        let count = columns.columns.len();
        for step in 0..count {
            let column = if side == 0 { step } else { count - 1 - step };
            let places = places(columns);
            let wanted = |item: usize| {
                let beside = &neighbours[item][side];
                let sum: f32 = beside.iter().map(|other| places[*other]).sum();
                if beside.is_empty() { places[item] } else { sum / beside.len() as f32 }
            };
            let mut sorted: Vec<(usize, f32, usize)> = columns.columns[column]
                .iter()
                .map(|item| (columns.items[*item].band, wanted(*item), *item))
                .collect();
            sorted.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
            columns.columns[column] = sorted.into_iter().map(|(.., item)| item).collect();
        }
        let crossings = if counts { crossings(columns, &links) } else { 0 };
        if crossings < best.0 || !counts {
            best = (crossings, columns.columns.clone());
        }
    }
    columns.columns = best.1;
}

/// The middle of each item, where the columns are stacked around a common line.
fn places(columns: &Columns) -> Vec<f32> {
    let mut places = vec![0.0; columns.items.len()];
    for column in &columns.columns {
        let height = |item: &usize| columns.items[*item].size.y + GAP;
        let mut at = -column.iter().map(height).sum::<f32>() / 2.0;
        for item in column {
            places[*item] = at + height(item) / 2.0;
            at += height(item);
        }
    }
    places
}

/// How often lines cross between columns.
pub fn crossings(columns: &Columns, links: &[[usize; 2]]) -> usize {
    let mut rank = vec![0; columns.items.len()];
    for column in &columns.columns {
        column.iter().enumerate().for_each(|(place, item)| rank[*item] = place);
    }
    let crosses = |a: &[usize; 2], b: &[usize; 2]| {
        columns.items[a[0]].column == columns.items[b[0]].column
            && (rank[a[0]] < rank[b[0]] && rank[a[1]] > rank[b[1]]
                || rank[a[0]] > rank[b[0]] && rank[a[1]] < rank[b[1]])
    };
    links.iter().enumerate().map(|(i, a)| links[..i].iter().filter(|b| crosses(a, b)).count()).sum()
}
