//! The state of smoothing: the moving average, the stretch that segments may join, and the last output.

use crate::limits::LimitTable;
use crate::parameters::Axes;
use crate::smoothing::Smoother;
use crate::stretch::{Stretch, WINDOW_CYCLES_MAX};

/// The state of smoothing.
#[derive(Debug)]
pub(crate) struct PathSmoothing {
    pub(crate) smoother: Smoother,
    /// What the segments of the last stretch have in common, if another one may join them.
    pub(crate) open: Option<Stretch>,
    /// Of the last output.
    pub(crate) position: Axes,
    pub(crate) velocity: Axes,
}

impl PathSmoothing {
    /// The state at rest; `None` where motions are not smoothed.
    pub(crate) fn new(table: &LimitTable, position: Axes) -> Option<Self> {
        // The average on an arc between two rests covers twice as many cycles as its limits say.
        let cycles = table.cycles_max().saturating_mul(2).min(WINDOW_CYCLES_MAX);
        (cycles > 0).then(|| Self {
            smoother: Smoother::new(cycles, position),
            open: None,
            position,
            velocity: Axes::default(),
        })
    }
}
