//! The trajectory planner: canonical moves in, one servo sample out per cycle.
//!
//! A caller queues [`Segment`]s while the planner runs, and calls [`Planner::update`] once per servo cycle with what the
//! outside wants now ([`InputParameter`]); it gets where the machine shall be next ([`OutputParameter`]).
//!
//! **Invariants.** No limit of an axis is broken, whatever the feed of segments, overrides, holds or aborts. A cycle's work is
//! bounded and allocates nothing: all memory is taken by [`Planner::new`]. When the queue runs short, the machine stops
//! on its path.

mod parameters;
mod segment;

pub use parameters::{Axes, Hold, InputParameter, OutputParameter, Phase};
pub use segment::{Blend, Feed, OutputSwitch, Path, Segment};

use crate::error::Error;

/// What the machine can do, and how the planner is built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics {
    /// Highest velocity per axis, millimetres or degrees per second.
    pub velocity: Axes,
    /// Highest acceleration per axis, millimetres or degrees per second squared.
    pub acceleration: Axes,
    /// Highest jerk per axis, millimetres or degrees per second cubed; `None` for profiles that are not limited in jerk.
    pub jerk: Option<Axes>,
    /// Servo cycle, seconds.
    pub cycle: f64,
    /// How many segments the queue holds.
    pub queue: u32,
}

/// A planner for nine axes in machine coordinates.
#[derive(Debug)]
pub struct Planner {
    dynamics: Dynamics,
}

/// Why a segment was not queued.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotQueued {
    /// The queue is full; try again after the next cycle.
    Full,
    /// A number is not finite, a feed not positive, or a radius is zero.
    Malformed,
    /// This version plans nothing.
    NotYet,
}

impl Planner {
    /// A planner that stands still at a position, with all its memory taken.
    ///
    /// # Errors
    /// [`Error::NotYet`], always, in this version.
    pub fn new(dynamics: Dynamics, position: Axes) -> Result<Self, Error> {
        let (_dynamics, _position) = (dynamics, position);
        Err(Error::NotYet("the trajectory planner"))
    }

    /// Queues a segment that begins where the last one ends.
    ///
    /// # Errors
    /// The queue is full, or the segment is none.
    pub fn queue(&mut self, segment: &Segment) -> Result<(), NotQueued> {
        let _segment = segment;
        Err(NotQueued::NotYet)
    }

    /// Moves on by one servo cycle.
    pub fn update(&mut self, input: &InputParameter, output: &mut OutputParameter) -> Phase {
        let _input = input;
        output.phase = Phase::Idle;
        output.phase
    }

    /// What the machine can do.
    pub fn dynamics(&self) -> &Dynamics {
        &self.dynamics
    }
}
