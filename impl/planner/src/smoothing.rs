//! Smoothing: the commanded motion is a moving average of the planned one, so that its acceleration does not jump.
//!
//! The average of N samples in a row keeps every limit that each of them keeps. Its third difference is the change of
//! the second difference over N cycles, divided by their time. So jerk is limited by limits of acceleration.

use crate::limits::squared;
use crate::math;
use crate::motion::MotionState;
use crate::parameters::Axes;
use crate::path_element::{Averaged, Smoothing};
use crate::ring::Ring;

/// A sum whose rounding errors are summed, too, so that adding and subtracting does not drift.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    sum: f64,
    error: f64,
}

impl Sum {
    #[inline]
    fn add(&mut self, value: f64) {
        let sum = self.sum + value;
        let rounded = sum - self.sum;
        self.error += (self.sum - (sum - rounded)) + (value - rounded);
        self.sum = sum;
    }

    #[inline]
    fn over(self, count: f64) -> f64 {
        (self.sum + self.error) / count
    }
}

/// What is averaged, for one cycle.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    /// From where the average began.
    offset: Axes,
    /// Along the path, from where the average began.
    distance: f64,
    /// The distance at which the last segment begins of those that begin in the cycle; no distance where none does.
    begin_distance: Option<f64>,
    /// That segment: the planner's number and the caller's.
    begun: u64,
    number: u64,
}

/// Where the smoothed motion is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Smoothed {
    /// The position; of a lone element only where the motion rests.
    pub(crate) position: Axes,
    /// The parameter of a lone element, while the motion does not rest.
    pub(crate) parameter: Option<f64>,
}

/// The moving average. The window changes only at rest.
#[derive(Debug)]
pub(crate) struct Smoother {
    samples: Ring<Sample>,
    smoothing: Smoothing,
    /// How many leading axes move, 3 or 9.
    axes: usize,
    /// Where the average began.
    origin: Axes,
    /// The lone element, and where its parameter was.
    lone: u64,
    lone_origin: f64,
    /// Sums over the window.
    offsets: [Sum; 9],
    distance: Sum,
    /// The last planned sample.
    planned: Axes,
    planned_distance: f64,
    /// For how many cycles the planned motion has rested.
    rested: u16,
    /// The first sample whose segment has not begun in the smoothed motion.
    unbegun: u64,
    /// The segment that the smoothed motion has begun: the planner's number and the caller's.
    pub(crate) begun: u64,
    pub(crate) number: u64,
}

impl Smoother {
    /// Allocates room for a window of so many cycles.
    pub(crate) fn new(cycles: u16, position: Axes) -> Self {
        Self {
            samples: Ring::new(usize::from(cycles).saturating_add(1)),
            smoothing: Smoothing { window: 1, ..Smoothing::default() },
            axes: 9,
            origin: position,
            lone: 0,
            lone_origin: 0.0,
            offsets: [Sum::default(); 9],
            distance: Sum::default(),
            planned: position,
            planned_distance: 0.0,
            rested: u16::MAX,
            unbegun: 0,
            begun: 0,
            number: 0,
        }
    }

    /// Whether the smoothed motion rests where the planned one does.
    pub(crate) fn is_settled(&self) -> bool {
        self.rested >= self.smoothing.window
    }

    /// Whether it does so since the last cycle.
    pub(crate) fn has_just_settled(&self) -> bool {
        self.rested == self.smoothing.window
    }

    /// Whether the planned position has not changed in the last cycle.
    pub(crate) fn has_rested(&self) -> bool {
        self.rested > 1
    }

    /// Whether motion on an element is smoothed like this. `lone` is the number of the element.
    pub(crate) fn is_set_for(&self, smoothing: Smoothing, lone: u64) -> bool {
        self.smoothing == smoothing
            && (self.lone == lone || smoothing.averaged == Averaged::Position)
    }

    /// The number of the lone element that the motion is on or next to, if it is one.
    pub(crate) fn lone(&self) -> Option<u64> {
        (self.smoothing.averaged != Averaged::Position).then_some(self.lone)
    }

    /// Begins another average, at rest. `lone` is the number of an element and the parameter on it.
    pub(crate) fn restart(&mut self, smoothing: Smoothing, lone: (u64, f64)) {
        self.smoothing = smoothing;
        self.axes = if smoothing.has_more_axes { 9 } else { 3 };
        // It rests, whatever the new window is.
        self.rested = u16::MAX;
        (self.lone, self.lone_origin) = lone;
        self.origin = self.planned;
        self.samples.clear();
        self.unbegun = self.samples.end();
        self.offsets = [Sum::default(); 9];
        self.distance = Sum::default();
        self.planned_distance = 0.0;
    }

    /// The segment of the planned motion begins at once: it rests, or it is cleared.
    pub(crate) fn begin_all(&mut self, motion: &MotionState) {
        (self.begun, self.number) = (motion.begun, motion.number);
        self.unbegun = self.samples.end();
    }

    /// Adds the planned position of a cycle, and the parameter of a lone element. `after_begin` is the way since the
    /// segment began that the planned motion has begun in it.
    pub(crate) fn add(
        &mut self,
        position: &Axes,
        parameter: f64,
        motion: &MotionState,
        after_begin: Option<f64>,
    ) -> Smoothed {
        let before = self.planned_distance;
        let is_lone = self.lone().is_some();
        let mut sample = Sample { begun: motion.begun, number: motion.number, ..Sample::default() };
        if is_lone {
            self.planned_distance = parameter - self.lone_origin;
        } else {
            let mut way = 0.0;
            let places = position.iter().zip(&self.planned).zip(&self.origin);
            for (offset, ((place, before), origin)) in
                sample.offset.iter_mut().zip(places).take(self.axes)
            {
                *offset = place - origin;
                way += squared(place - before);
            }
            let way = math::sqrt(way);
            self.planned_distance += if motion.is_reversed { -way } else { way };
        }
        sample.distance = self.planned_distance;
        sample.begin_distance =
            after_begin.map(|after| math::max(before, self.planned_distance - after));
        let rests = position.iter().zip(&self.planned).all(|(a, b)| a.to_bits() == b.to_bits());
        self.rested = if rests { self.rested.saturating_add(1) } else { 1 };
        self.planned = *position;
        self.drop_oldest();
        self.distance.add(sample.distance);
        if !is_lone {
            for (sum, offset) in self.offsets.iter_mut().zip(&sample.offset).take(self.axes) {
                sum.add(*offset);
            }
        }
        self.samples.push(&sample);
        let count = f64::from(self.smoothing.window);
        let distance = self.distance.over(count);
        self.begin_up_to(distance);
        let mut smoothed = Smoothed { position: *position, parameter: None };
        if self.is_settled() {
            return smoothed;
        }
        if is_lone {
            smoothed.parameter = Some(self.lone_origin + distance);
        }
        let places = smoothed.position.iter_mut().zip(&self.origin).zip(&self.offsets);
        for ((place, origin), sum) in places.take(if is_lone { 0 } else { self.axes }) {
            *place = origin + sum.over(count);
        }
        smoothed
    }

    /// Takes the oldest sample off the sums once there are as many as the window covers.
    fn drop_oldest(&mut self) {
        let first = self.samples.first();
        if self.samples.end().saturating_sub(first) < u64::from(self.smoothing.window) {
            return;
        }
        if let Some(oldest) = self.samples.get(first) {
            self.distance.add(-oldest.distance);
            for (sum, offset) in self.offsets.iter_mut().zip(&oldest.offset).take(self.axes) {
                sum.add(-offset);
            }
        }
        self.samples.drop_first();
    }

    /// Begins the segments that the smoothed motion has reached.
    fn begin_up_to(&mut self, distance: f64) {
        self.unbegun = self.unbegun.max(self.samples.first());
        while let Some(sample) = self.samples.get(self.unbegun) {
            if sample.begin_distance.is_some_and(|begins| begins > distance) && !self.is_settled() {
                return;
            }
            self.begun = self.begun.max(sample.begun);
            self.number = sample.number;
            self.unbegun = self.unbegun.saturating_add(1);
        }
    }
}
