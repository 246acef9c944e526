//! Finds the first move that waits under cutter compensation. It is issued once the next one is known, and no command
//! shows to which block it belongs.

use gaugeblock_vocabulary::{BlockLocation, Effect, End, Event, Outcome, Position};

use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::state;

/// Why a run is not judged from there on.
const WHAT: &str =
    "moves under cutter compensation: they are issued late, and not attributed to their blocks";

/// What the interpreter's position is counted in.
#[derive(Clone, Debug, Default, PartialEq)]
struct Scale {
    metric: i64,
    diameter: i64,
}

impl Scale {
    fn of(checkpoint: &Checkpoint) -> Self {
        Self {
            metric: checkpoint.mode("_metric"),
            diameter: checkpoint.mode("_lathe_diameter_mode"),
        }
    }
}

/// The first block with a move that waits.
#[derive(Debug, Default)]
pub(super) struct Waiting {
    position: Position,
    scale: Scale,
    /// The block, and how many blocks were recorded before it.
    first: Option<(BlockLocation, usize)>,
}

impl Waiting {
    /// The state before the first block.
    pub(super) fn begin(&mut self, checkpoint: &Checkpoint) {
        (self.position, self.scale) = (state::position(checkpoint), Scale::of(checkpoint));
    }

    /// A block was executed, after `taken` others. Its move waits if the interpreter is elsewhere under compensation
    /// and no move was issued.
    pub(super) fn block(
        &mut self,
        checkpoint: &Checkpoint,
        events: &[Event],
        taken: usize,
        block: impl FnOnce() -> BlockLocation,
    ) {
        let (position, scale) = (state::position(checkpoint), Scale::of(checkpoint));
        let moved = scale == self.scale && position != self.position;
        let is_on = checkpoint.mode("_ccomp") != 400;
        if self.first.is_none() && is_on && moved && !events.iter().any(is_move) {
            self.first = Some((block(), taken));
        }
        (self.position, self.scale) = (position, scale);
    }

    /// Ends an outcome before the first block with a move that waits.
    pub(super) fn cut_off(self, outcome: &mut Outcome) {
        let Some((block, taken)) = self.first else { return };
        outcome.steps.truncate(taken);
        outcome.parameters = None;
        outcome.end = End::Unsupported { block, what: WHAT.to_owned() };
    }
}

fn is_move(event: &Event) -> bool {
    matches!(
        event,
        Event::Do(
            Effect::StraightTraverse { .. } | Effect::StraightFeed { .. } | Effect::ArcFeed { .. }
        )
    )
}
