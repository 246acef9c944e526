//! The state that a series of contiguous blocks of one motion keeps from block to block: sticky words and the initial
//! level of canned cycles (11.5.43.2, 11.5.61), and an open data block of G5.2 (11.5.9).
//!
//! A motion mode that ends a series does not clear it: the series counts only while the motion mode in force is one
//! of its own.

use gaugeblock_vocabulary::Motion;

use crate::faults::{PlantedFault, planted};

use super::super::coordinates::{Conversion, Coordinates};
use super::super::motion_codes::is_cycle;
use super::numbers::Numbers;

/// The state of a series.
#[derive(Clone, Copy, Debug, Default)]
pub(in super::super) struct MotionSeries {
    /// Where the point was before the first cycle.
    start: Option<Coordinates>,
    /// The numbers of the last cycle, and its code in tenths.
    sticky: Option<(u16, Numbers)>,
    /// Whether the last spline was a G5, whose end gives the next one its direction.
    pub(in super::super) cubic: bool,
    /// The data block that G5.2 opened.
    pub(in super::super) curve: Option<Curve>,
}

/// A data block that G5.2 opened.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Curve {
    /// How many control points there are; the first one is where the point was.
    pub(in super::super) points: u32,
    /// L.
    pub(in super::super) order: i32,
    /// The last control point.
    pub(in super::super) last: Coordinates,
}

/// A series of cycles that a block continues or begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct CycleSeries {
    start: Coordinates,
    sticky: Option<(u16, Numbers)>,
}

impl MotionSeries {
    /// The series of cycles under a motion mode; a new one begins where the point is.
    pub(super) fn cycle_series(&self, motion: Motion, position: Coordinates) -> CycleSeries {
        match self.start {
            Some(start) if is_cycle(motion) => CycleSeries { start, sticky: self.sticky },
            Some(start) if motion == Motion::None && planted(PlantedFault::CancelKeepsLevel) => {
                CycleSeries { start, sticky: None }
            }
            Some(_) | None => CycleSeries { start: position, sticky: None },
        }
    }

    /// The series after a spline.
    pub(in super::super) fn of_spline(cubic: bool) -> Self {
        Self { cubic, ..Self::default() }
    }

    /// An open data block.
    pub(in super::super) fn of_curve(curve: Curve) -> Self {
        Self { curve: Some(curve), ..Self::default() }
    }

    /// The series after a change of the motion mode by M72: it continues only from cycle to cycle.
    pub(in super::super) fn changed(self, from: Motion, to: Motion) -> Self {
        if from == to || is_cycle(from) && is_cycle(to) { self } else { Self::default() }
    }

    /// Converts lengths to another unit; sticky words are numbers and stay.
    pub(in super::super) fn convert(&mut self, by: Conversion) {
        self.each_point(|point| point.converted(by));
    }

    /// Changes every point that is kept, as the controlled point changes when offsets do.
    pub(in super::super) fn each_point(&mut self, change: impl Fn(Coordinates) -> Coordinates) {
        if let Some(start) = &mut self.start {
            *start = change(*start);
        }
        if let Some(curve) = &mut self.curve {
            curve.last = change(curve.last);
        }
    }
}

impl CycleSeries {
    /// The series with another start.
    pub(super) fn from(self, start: Coordinates) -> Self {
        Self { start, ..self }
    }

    /// Where the point was before the series.
    pub(super) fn start(&self) -> Coordinates {
        self.start
    }

    /// The numbers to keep for a cycle: those of a block of the same one (11.5.43.2).
    pub(super) fn sticky(&self, code: u16) -> Option<Numbers> {
        self.sticky.filter(|(kept, _)| *kept == code).map(|(_, numbers)| numbers)
    }

    /// The depth of any earlier cycle: a planted fault.
    pub(super) fn foreign_depth(&self) -> Option<f64> {
        let kept = self.sticky.filter(|_| planted(PlantedFault::DepthAcrossCycles));
        kept.map(|(_, numbers)| numbers.bottom)
    }

    /// The series with the numbers of this block.
    pub(super) fn with_sticky(&self, code: u16, numbers: Numbers) -> MotionSeries {
        MotionSeries {
            start: Some(self.start),
            sticky: Some((code, numbers)),
            ..MotionSeries::default()
        }
    }
}
