//! Places of boxes and ways of arrows: layers from the bottom up, few crossings, boxes near what they use.

use std::collections::{BTreeMap, BTreeSet};

use crate::report;

/// Pixels between boxes of a layer, between layers, and of the gap that an arrow takes on its way through a layer.
const GAP: f64 = 24.0;
const LAYER_GAP: f64 = 60.0;
const WAY_WIDTH: f64 = 8.0;
/// Sweeps down and up that order and then place the nodes; more change nothing that is seen.
const SWEEPS: usize = 24;

/// Where a box is, in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Box {
    pub(super) centre: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// Boxes by name of the node, and the points of each arrow from top to bottom.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) boxes: BTreeMap<String, Box>,
    pub(super) ways: Vec<Vec<(f64, f64)>>,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// A box, or a place at which an arrow goes through a layer.
#[derive(Debug, Clone)]
struct Cell {
    width: f64,
    height: f64,
    centre: f64,
    above: Vec<usize>,
    below: Vec<usize>,
}

struct Grid {
    cells: Vec<Cell>,
    /// Cells of each layer from left to right, the top layer first.
    rows: Vec<Vec<usize>>,
}

impl Layout {
    pub(super) fn of(
        edges: &BTreeMap<String, BTreeSet<String>>,
        sizes: &BTreeMap<&str, (f64, f64)>,
    ) -> Self {
        let mut layers = report::layers(edges);
        layers.reverse();
        let mut grid = Grid { cells: Vec::new(), rows: Vec::new() };
        let mut cell_of = BTreeMap::new();
        let mut row_of = BTreeMap::new();
        for (row, layer) in layers.iter().enumerate() {
            grid.rows.push(Vec::new());
            for name in layer {
                let (width, height) = sizes[name.as_str()];
                cell_of.insert(name.clone(), grid.add(row, width, height));
                row_of.insert(name.clone(), row);
            }
        }
        let mut chains = Vec::new();
        for (name, on) in report::reduced(edges) {
            for other in on {
                let ways =
                    (row_of[&name] + 1..row_of[&other]).map(|row| grid.add(row, WAY_WIDTH, 0.0));
                let mut chain = vec![cell_of[&name]];
                chain.extend(ways);
                chain.push(cell_of[&other]);
                grid.join(&chain);
                chains.push(chain);
            }
        }
        grid.order();
        grid.place();
        grid.layout(&cell_of, &chains)
    }
}

impl Grid {
    fn add(&mut self, row: usize, width: f64, height: f64) -> usize {
        let cell = self.cells.len();
        self.cells.push(Cell { width, height, centre: 0.0, above: Vec::new(), below: Vec::new() });
        self.rows[row].push(cell);
        cell
    }

    fn join(&mut self, chain: &[usize]) {
        for pair in chain.windows(2) {
            if let [upper, lower] = pair {
                self.cells[*upper].below.push(*lower);
                self.cells[*lower].above.push(*upper);
            }
        }
    }

    /// Mean centre of a cell's neighbours above or below, or its own where it has none.
    fn wanted(&self, cell: usize, is_down: bool) -> f64 {
        let cell = &self.cells[cell];
        let neighbours = if is_down { &cell.above } else { &cell.below };
        let sum: f64 = neighbours.iter().map(|other| self.cells[*other].centre).sum();
        if neighbours.is_empty() { cell.centre } else { sum / count(neighbours.len()) }
    }

    /// Orders each row by the places of its neighbours, downwards and upwards in turn.
    fn order(&mut self) {
        for sweep in 0..SWEEPS {
            let is_down = sweep % 2 == 0;
            for row in self.in_turn(is_down) {
                let mut cells = self.rows[row].clone();
                cells.sort_by(|one, other| {
                    self.wanted(*one, is_down).total_cmp(&self.wanted(*other, is_down))
                });
                let mut edge = 0.0;
                for cell in &cells {
                    let width = self.cells[*cell].width;
                    self.cells[*cell].centre = edge + width / 2.0;
                    edge += width + GAP;
                }
                for cell in &cells {
                    self.cells[*cell].centre -= edge / 2.0;
                }
                self.rows[row] = cells;
            }
        }
    }

    /// Moves the cells of each row towards their neighbours; their order and the gaps between them stay.
    fn place(&mut self) {
        for sweep in 0..SWEEPS {
            let is_down = sweep % 2 == 1;
            for row in self.in_turn(is_down) {
                let cells = self.rows[row].clone();
                let mut shift = 0.0;
                let mut shifts = Vec::new();
                for pair in cells.windows(2) {
                    shifts.push(shift);
                    if let [one, other] = pair {
                        shift +=
                            f64::midpoint(self.cells[*one].width, self.cells[*other].width) + GAP;
                    }
                }
                shifts.push(shift);
                let wanted = cells
                    .iter()
                    .zip(&shifts)
                    .map(|(cell, shift)| self.wanted(*cell, is_down) - shift);
                for ((cell, place), shift) in cells.iter().zip(ascending(wanted)).zip(&shifts) {
                    self.cells[*cell].centre = place + shift;
                }
            }
        }
    }

    fn in_turn(&self, is_down: bool) -> Vec<usize> {
        let rows = 0..self.rows.len();
        if is_down { rows.collect() } else { rows.rev().collect() }
    }

    fn layout(&self, cell_of: &BTreeMap<String, usize>, chains: &[Vec<usize>]) -> Layout {
        let edge = |cell: &Cell, side: f64| cell.centre + side * cell.width / 2.0;
        let left = self.cells.iter().map(|cell| edge(cell, -1.0)).fold(f64::INFINITY, f64::min);
        let right = self.cells.iter().map(|cell| edge(cell, 1.0)).fold(f64::NEG_INFINITY, f64::max);
        let mut boxes = BTreeMap::new();
        let mut top = 0.0;
        for row in &self.rows {
            let height = row.iter().map(|cell| self.cells[*cell].height).fold(0.0, f64::max);
            for cell in row {
                let of = &self.cells[*cell];
                // An arrow goes straight through a layer.
                let own = if of.height > 0.0 { of.height } else { height };
                let place = Box {
                    centre: of.centre - left,
                    top: top + (height - own) / 2.0,
                    width: of.width,
                    height: own,
                };
                boxes.insert(*cell, place);
            }
            top += height + LAYER_GAP;
        }
        let way = |chain: &Vec<usize>| {
            let mut points = Vec::new();
            for (place, cell) in chain.iter().enumerate() {
                let at = &boxes[cell];
                if place > 0 {
                    points.push((at.centre, at.top));
                }
                if place + 1 < chain.len() {
                    points.push((at.centre, at.top + at.height));
                }
            }
            points
        };
        Layout {
            ways: chains.iter().map(way).collect(),
            boxes: cell_of.iter().map(|(name, cell)| (name.clone(), boxes[cell])).collect(),
            width: right - left,
            height: top - LAYER_GAP,
        }
    }
}

/// The ascending numbers nearest to these, by least squares: neighbours out of order share their mean.
fn ascending(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for number in numbers {
        blocks.push((number, 1));
        while let [.., (before, many), (last, few)] = blocks.as_slice() {
            if before <= last {
                break;
            }
            let all = many + few;
            let mean = (before * count(*many) + last * count(*few)) / count(all);
            blocks.truncate(blocks.len() - 2);
            blocks.push((mean, all));
        }
    }
    blocks.into_iter().flat_map(|(mean, many)| std::iter::repeat_n(mean, many)).collect()
}

/// A number of things as a measure.
pub(super) fn count(number: usize) -> f64 {
    u32::try_from(number).map_or(f64::INFINITY, f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_out_of_order_share_their_mean() {
        assert_eq!(ascending([1.0, 4.0, 2.0, 5.0].into_iter()), [1.0, 3.0, 3.0, 5.0]);
    }

    #[test]
    fn user_is_above_what_it_uses() {
        let on = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let edges = BTreeMap::from([
            ("a".to_owned(), on(&["b", "c"])),
            ("b".to_owned(), on(&["c"])),
            ("c".to_owned(), on(&[])),
        ]);
        let sizes = ["a", "b", "c"].into_iter().map(|name| (name, (50.0, 20.0))).collect();
        let layout = Layout::of(&edges, &sizes);
        assert!(layout.boxes["a"].top < layout.boxes["b"].top);
        assert!(layout.boxes["b"].top < layout.boxes["c"].top);
        assert_eq!(layout.ways.len(), 2, "the arrow from a to c follows from the others");
    }
}
