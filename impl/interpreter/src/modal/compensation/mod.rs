//! Cutter compensation (11.2.4, 11.5.25 to 11.5.27): the path of a cutter at a distance of R from the programmed one.
//!
//! ```text
//! a move's words ─► Segment (plane) ─► entry, or the corner with the last move ─► what waits ─► Sink
//! ```
//!
//! The formulas, and what of them the manual leaves open, are in `docs/compensation.md`.
//!
//! **Invariants.**
//! * A move in the plane waits until the next one is known, and what follows it waits too ([`waiting`]).
//! * [`Modal::position`](super::Modal) is the compensated end of the last move, as if no inner corner followed. The
//!   programmed point is the end of the last segment.
//! * Without compensation a move pays one test: [`path::CompensationState::is_idle`].

mod corner;
mod entry;
mod exit;
mod moves;
pub(super) mod path;
pub(super) mod plane;
mod queue;
mod switch;
mod waiting;

use alloc::format;

use gaugeblock_vocabulary::{Axis, Compensation, Plane};

use crate::limits::Limits;

use super::Modal;
use super::coordinates::Coordinates;
use super::refusal::Refusal;
use super::saved_states::Saved;
use super::vector::Vector;

use path::PathState;
pub(super) use plane::Cutter;
use queue::Queue;
pub(super) use waiting::waits_after_move;

impl Modal {
    /// Notes whether plain moves need compensation; after each change of the setting or of the path.
    pub(super) fn note_compensation(&mut self) {
        let is_off = self.active.now().compensation == Compensation::Off;
        let path = &self.compensation.path;
        self.compensation.is_idle = is_off && path.exit.is_none() && path.last.is_none();
    }

    /// Forgets the path and what waits: a program begins, or the run was aborted. The point is where the machine is.
    pub(super) fn forget_compensated_path(&mut self) {
        self.position = self.reached_point();
        self.compensation.lose_waiting();
        self.compensation.path = PathState::default();
        self.compensation.before = None;
        self.note_compensation();
    }

    /// The cutter of a restored state. What moves follow a restore of another compensation, the documents leave open.
    #[inline]
    pub(super) fn restore_cutter(&mut self, saved: &Saved) {
        // Without compensation no move reads the cutter.
        if !(self.compensation.is_idle && saved.modes.compensation == Compensation::Off) {
            self.restore_other_cutter(saved);
        }
    }

    fn restore_other_cutter(&mut self, saved: &Saved) {
        let (now, restored) = (self.active.now(), &saved.modes);
        let is_same = now.compensation == restored.compensation
            && now.work_offset == restored.work_offset
            && (now.tool_offset == restored.tool_offset || !self.compensation.has_path())
            && self.cutter.is_like(&saved.cutter);
        self.cutter = saved.cutter;
        if is_same {
            return;
        }
        let is_off = restored.compensation == Compensation::Off && !self.compensation.has_path();
        let why = "a move after a restore of another cutter compensation";
        self.compensation.path_mut().undefined = (!is_off).then_some(why);
    }

    /// Ends the run where something changes under a compensated path that the documents leave open.
    pub(super) fn check_without_path(&self, what: &str) -> Result<(), Refusal> {
        if self.compensation.has_path() {
            return Err(Refusal::Unspecified(format!("{what} between compensated moves")));
        }
        Ok(())
    }

    /// A refusal has cut the run off: what waits is lost, unless it was only read ahead.
    pub(crate) fn lose_waiting(&mut self) {
        if !self.reads_ahead() {
            self.compensation.lose_waiting();
        }
    }

    /// Sets how many settings and effects may wait, and how many moves a profile may have.
    pub(crate) fn set_limits(&mut self, limits: &Limits) {
        self.compensation.queue = Queue::new(limits.waiting_effects);
        self.profile_moves = limits.profile_moves;
    }
}

/// The axes of the plane's first and second coordinate.
const fn axes_of(plane: Plane) -> [Axis; 2] {
    match plane {
        Plane::Zx => [Axis::Z, Axis::X],
        Plane::Xy | Plane::Yz | Plane::Uv | Plane::Wu | Plane::Vw => [Axis::X, Axis::Y],
    }
}

/// The axis that is normal to the plane.
const fn normal_of(plane: Plane) -> Axis {
    match plane {
        Plane::Zx => Axis::Y,
        Plane::Xy | Plane::Yz | Plane::Uv | Plane::Wu | Plane::Vw => Axis::Z,
    }
}

impl Coordinates {
    /// Its point in the plane.
    fn in_plane(self, plane: Plane) -> Vector {
        let [p, q] = axes_of(plane).map(|axis| self.coordinate_of(axis));
        Vector { p, q }
    }

    /// With another point in the plane.
    fn with_in_plane(self, plane: Plane, point: Vector) -> Self {
        let [first, second] = axes_of(plane);
        self.with_axis(first, point.p).with_axis(second, point.q)
    }
}
