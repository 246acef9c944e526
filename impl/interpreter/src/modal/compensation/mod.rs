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
//! * Without compensation a move pays one test: [`CompensationState::is_idle`].

mod corner;
mod entry;
mod exit;
mod moves;
mod plane;
mod switch;
mod waiting;

use alloc::format;

use gaugeblock_vocabulary::{Axis, Compensation, Plane};

use super::Modal;
use super::coordinates::{Conversion, Coordinates};
use super::refusal::Refusal;
use super::saved_states::Saved;

pub(super) use plane::Cutter;
use plane::{Circle, Segment, Vector};
use waiting::Queue;
pub(super) use waiting::waits_after_move;

/// State of compensation besides the settings in force.
#[derive(Clone, Debug)]
pub(super) struct CompensationState {
    /// Whether compensation is off and no exit is due: a plain move needs nothing of this module.
    is_idle: bool,
    /// What a refused block restores.
    path: PathState,
    /// `path` before the block, once it has changed.
    before: Option<PathState>,
    /// What waits for the next move in the plane.
    queue: Queue,
}

/// The part of the state that moves change.
#[derive(Clone, Copy, Debug, Default)]
struct PathState {
    /// The last compensated move.
    last: Option<LastMove>,
    /// G40 has ended a compensated path, and the straight move that leads away from it has not come yet.
    exit_due: bool,
    /// Why no compensated move can follow, where a restore has changed the compensation.
    undefined: Option<&'static str>,
}

/// The last compensated move in the plane. Lengths are in the active unit; points are those of an unshifted cutter.
#[derive(Clone, Copy, Debug)]
struct LastMove {
    plane: Plane,
    segment: Segment,
    /// The circle on which it ends, if it is an arc. An entry has its own one.
    circle: Option<Circle>,
    /// Whether it leads to the path.
    is_entry: bool,
    /// Whether it is refused where the corners leave nothing of it.
    has_to_fit: bool,
    /// Where it starts after the corner before it.
    start: Vector,
    /// Where its own curve ends.
    end: Vector,
}

impl CompensationState {
    /// Compensation is off.
    pub(super) fn new(limit: u32) -> Self {
        Self { is_idle: true, path: PathState::default(), before: None, queue: Queue::new(limit) }
    }

    /// Whether a plain move needs nothing of compensation.
    #[inline]
    pub(super) fn is_idle(&self) -> bool {
        self.is_idle
    }

    /// Whether a move waits, and what follows it has to wait too.
    #[inline]
    pub(super) fn waits(&self) -> bool {
        !self.queue.is_empty()
    }

    /// Whether a compensated move was made since compensation was switched on.
    pub(super) fn has_path(&self) -> bool {
        self.path.last.is_some()
    }

    /// Begins a block that can be rolled back.
    #[inline]
    pub(super) fn begin_notes(&mut self) {
        self.before = None;
    }

    /// The part that moves change, for a change that a refusal rolls back.
    fn path_mut(&mut self) -> &mut PathState {
        if self.before.is_none() {
            self.before = Some(self.path);
        }
        &mut self.path
    }

    /// The block is refused: its moves are forgotten, and what waited is lost.
    pub(super) fn roll_back(&mut self) {
        if let Some(before) = self.before.take() {
            self.path = before;
        }
        self.queue.clear();
    }

    /// What waits is lost.
    pub(super) fn lose_waiting(&mut self) {
        self.queue.clear();
    }

    /// Converts lengths to another unit. What waits keeps the unit of its block.
    pub(super) fn convert(&mut self, by: Conversion) {
        if let Some(last) = &mut self.path_mut().last {
            last.segment.convert(by);
            last.circle = last.circle.map(|circle| circle.converted(by));
            last.start = last.start.converted(by);
            last.end = last.end.converted(by);
        }
        self.queue.convert(by);
    }
}

impl Modal {
    /// Notes whether plain moves need compensation; after each change of the setting or of the path.
    pub(super) fn note_compensation(&mut self) {
        let is_off = self.active.now().compensation == Compensation::Off;
        let path = &self.compensation.path;
        self.compensation.is_idle = is_off && !path.exit_due && path.last.is_none();
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
            return Err(Refusal::Unsupported(format!("{what} between compensated moves")));
        }
        Ok(())
    }

    /// A refusal has cut the run off: what waits is lost.
    pub(crate) fn lose_waiting(&mut self) {
        self.compensation.lose_waiting();
    }

    /// Sets how many settings and effects may wait.
    pub(crate) fn limit_waiting(&mut self, limit: u32) {
        self.compensation.queue = Queue::new(limit);
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
