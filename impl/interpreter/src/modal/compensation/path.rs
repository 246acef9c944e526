//! The state of a compensated path: data alone.

use gaugeblock_vocabulary::Plane;

use super::super::coordinates::{Conversion, Coordinates};
use super::super::vector::Vector;
use super::plane::{Circle, Segment};
use super::queue::Queue;

/// State of compensation besides the settings in force.
#[derive(Clone, Debug)]
pub(in super::super) struct CompensationState {
    /// Whether compensation is off and the exit was made: a plain move needs nothing of this module.
    pub(super) is_idle: bool,
    /// What a refused block restores.
    pub(super) path: PathState,
    /// `path` before the block, once it has changed.
    pub(super) before: Option<PathState>,
    /// What waits for the next move in the plane.
    pub(super) queue: Queue,
    /// The length of the queue before the block.
    pub(super) queued: usize,
}

/// The part of the state that moves change.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PathState {
    /// The last compensated move.
    pub(super) last: Option<LastMove>,
    /// G40 has ended compensation, and the move that leads away has not come yet.
    pub(super) exit: Option<Exit>,
    /// Why no compensated move can follow, where a restore has changed the compensation.
    pub(super) undefined: Option<&'static str>,
}

/// What the move that leads away from a compensated path has to be longer than.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exit {
    /// The diameter of the cutter, active length unit.
    pub(super) diameter: f64,
    /// From the programmed point to the cutter.
    pub(super) gap: Coordinates,
    /// The rotation in which the gap was measured, degrees.
    pub(super) rotation: f64,
}

/// The last compensated move in the plane. Lengths are in the active unit; points are those of an unshifted cutter.
#[derive(Clone, Copy, Debug)]
pub(super) struct LastMove {
    pub(super) plane: Plane,
    pub(super) segment: Segment,
    /// The circle on which it ends, if it is an arc. An entry has its own one.
    pub(super) circle: Option<Circle>,
    /// Whether it leads to the path.
    pub(super) is_entry: bool,
    /// Whether it is refused where the corners leave nothing of it.
    pub(super) has_to_fit: bool,
    /// Where it starts after the corner before it.
    pub(super) start: Vector,
    /// Where its own curve ends.
    pub(super) end: Vector,
}

impl CompensationState {
    /// Compensation is off.
    pub(in super::super) fn new(limit: u32) -> Self {
        let (path, queue) = (PathState::default(), Queue::new(limit));
        Self { is_idle: true, path, before: None, queue, queued: 0 }
    }

    /// Whether a plain move needs nothing of compensation.
    #[inline]
    pub(in super::super) fn is_idle(&self) -> bool {
        self.is_idle
    }

    /// Whether a move waits, and what follows it has to wait too.
    #[inline]
    pub(in super::super) fn waits(&self) -> bool {
        !self.queue.is_empty()
    }

    /// Whether a compensated move was made since compensation was switched on.
    pub(in super::super) fn has_path(&self) -> bool {
        self.path.last.is_some()
    }

    /// Begins a block that can be rolled back.
    #[inline]
    pub(in super::super) fn begin_notes(&mut self) {
        self.before = None;
        self.queued = self.queue.items.len();
    }

    /// The part that moves change, for a change that a refusal rolls back.
    pub(super) fn path_mut(&mut self) -> &mut PathState {
        if self.before.is_none() {
            self.before = Some(self.path);
        }
        &mut self.path
    }

    /// The block is refused: removes its moves, and its items from the queue.
    pub(in super::super) fn roll_back(&mut self) {
        if let Some(before) = self.before.take() {
            self.path = before;
        }
        self.queue.items.truncate(self.queued);
    }

    /// What waits is lost.
    pub(in super::super) fn lose_waiting(&mut self) {
        self.queue.clear();
    }

    /// Converts lengths to another unit. What waits keeps the unit of its block.
    pub(in super::super) fn convert(&mut self, by: Conversion) {
        if let Some(last) = &mut self.path_mut().last {
            last.segment.convert(by);
            last.circle = last.circle.map(|circle| circle.converted(by));
            last.start = last.start.converted(by);
            last.end = last.end.converted(by);
        }
        if let Some(exit) = &mut self.path_mut().exit {
            exit.diameter = by.of(exit.diameter);
            exit.gap = exit.gap.converted(by);
        }
        self.queue.convert(by);
    }
}
