//! The least time along exact curves, by reachability.
//!
//! Time-optimal path parametrisation after H. Pham and Q.-C. Pham, "A New Approach to Time-Optimal Path
//! Parameterization Based on Reachability Analysis", IEEE Transactions on Robotics, 2018: backwards over the path,
//! the set of squared speeds from which rest at its end can be reached; forwards, the highest speeds within these
//! sets. Here each cell is solved twice, with constraints that are weaker and stronger than the limits (see `cell`),
//! so that the least time is bracketed, and cells are divided until the bracket is narrow.

use super::cell::{Cell, Side, speed};
use super::smooth::Smooth;
use super::trapezoid::least_time;
use crate::motion::envelope::Envelope;

/// How narrow the bracket is to be, as a share of the time.
const NARROW: f64 = 1e-3;

/// The finest division, cells of a radian.
const FINEST: f64 = 1e5;

/// A bracket of the least time, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bracket {
    /// No motion is faster.
    pub(super) least: f64,
    /// A lawful motion takes so long; infinite where none was found.
    pub(super) achieved: f64,
}

/// The least time from rest to rest along curves that go on into each other without a break, each with the highest
/// speed that its feed allows.
pub(super) fn bracket(curves: &[(&dyn Smooth, f64)], envelope: &Envelope) -> Bracket {
    let mut per_radian = 50.0;
    let mut best = Bracket { least: 0.0, achieved: f64::INFINITY };
    loop {
        let time = |side: Side| {
            let cells = cells(curves, envelope, per_radian, side);
            seconds(&cells, side)
        };
        best.least = best.least.max(time(Side::Outer));
        best.achieved = best.achieved.min(time(Side::Inner));
        if best.achieved - best.least <= NARROW * best.least || per_radian >= FINEST {
            return best;
        }
        per_radian *= 4.0;
    }
}

fn cells(
    curves: &[(&dyn Smooth, f64)],
    envelope: &Envelope,
    per_radian: f64,
    side: Side,
) -> Vec<Cell> {
    let mut cells = Vec::new();
    for (curve, feed) in curves {
        let count = curve.cells(per_radian);
        let mut done = 0.0;
        while done < count {
            cells.push(Cell::of(*curve, (done / count, 1.0 / count), (envelope, *feed), side));
            done += 1.0;
        }
    }
    cells
}

/// The time over cells from rest to rest; infinite where the constraints leave no motion.
fn seconds(cells: &[Cell], side: Side) -> f64 {
    // From which y where each cell starts rest at the end can be reached.
    let mut controllable = vec![0.0; cells.len() + 1];
    for place in (0..cells.len()).rev() {
        let cell = &cells[place];
        // What the next cell allows, in terms of this one.
        let next =
            cells.get(place + 1).map_or(0.0, |next| controllable[place + 1] / cell.into(next));
        controllable[place] = cell.controllable(next.min(cell.highest), side);
    }
    let (mut y, mut total) = (0.0, 0.0);
    for (place, cell) in cells.iter().enumerate() {
        let start: f64 = if place == 0 { 0.0 } else { y };
        let reached = match side {
            Side::Outer => cell.reached_from_below(start),
            Side::Inner => cell.reached(start),
        };
        let next = cells.get(place + 1);
        let allowed = next.map_or(0.0, |next| controllable[place + 1] / cell.into(next));
        let end = reached.min(allowed).min(cell.highest);
        total += match side {
            Side::Outer => least_time((start, end), cell.width, cell.steepest, cell.highest),
            Side::Inner if !cell.straight => 2.0 * cell.width / (speed(start) + speed(end)),
            Side::Inner => least_time((start, end), cell.width, cell.steepest, cell.highest),
        };
        y = next.map_or(0.0, |next| end * cell.into(next));
    }
    total
}
