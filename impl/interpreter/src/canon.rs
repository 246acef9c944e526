//! Where settings and effects go: the canonical commands, as a caller receives them.

use gaugeblock_vocabulary::{Effect, FaultKind, Position, Settings};

use crate::block_end::BlockEnd;
use crate::block_start::BlockStart;
use crate::gpp::StatementEnd;
use crate::nct::MacroStep;
use crate::probe_move::ProbeMove;

/// Receives the commands of a program, in order.
///
/// Under cutter compensation the end of a move follows from the next one, so that the move waits, and with it the
/// settings, moves and dwells after it. All of them come later, in program order: what a sink receives is always what a
/// machine does next. Effects that need no place in that order do not wait: messages, and the selection of a tool
/// (`docs/compensation.md`, "What waits"). A sink that needs to know which block has programmed an effect implements
/// [`Self::hold`] and [`Self::release`]; for others their defaults do nothing.
///
/// A sink that only queues answers [`Reply::Done`] to most effects. Some effects wait for the machine (a queue
/// buster): a probe, an input, a tool change. For those the reply carries the result.
pub trait Sink {
    /// Takes over settings that changed: only the fields that are set in `changed`.
    ///
    /// `line` is the line of the block, from 1, in its file.
    fn set(&mut self, line: u32, changed: &Settings);

    /// Performs an effect, or queues it, under the settings in force.
    fn perform(&mut self, line: u32, effect: &Effect) -> Reply;

    /// Reserves a place for what has to wait: the block in execution has programmed it, and it comes later. Returns
    /// the number of the place.
    ///
    /// What is held may still change: the end of a move and of those out of the plane after it. What is never
    /// released is not done: the program was refused or aborted before, or ended by a percent sign.
    #[inline]
    fn hold(&mut self, _line: u32, _waiting: Waiting<'_>) -> u64 {
        0
    }

    /// The next call of [`Self::set`] or [`Self::perform`] is what was held at this place. Places are released in the
    /// order in which they were held.
    #[inline]
    fn release(&mut self, _place: u64) {}

    /// Performs a straight probe. A sink with a probe replies where the probe changed. The default forwards to
    /// [`Self::perform`].
    #[inline]
    fn probe(&mut self, line: u32, effect: &Effect, _probe_move: &ProbeMove) -> Reply {
        self.perform(line, effect)
    }

    /// Receives the words of a block before they are checked and executed. For a sink that reports what a program
    /// says in addition to what it does.
    #[inline]
    fn start_block(&mut self, _start: &BlockStart<'_>) {}

    /// Receives the state after a block, for a sink that records. It is not called for a refused block.
    #[inline]
    fn end_block(&mut self, _end: &mut BlockEnd<'_>) {}

    /// Receives the state after a step of a program with custom macros. It is not called for a refused step.
    #[inline]
    fn end_macro_step(&mut self, _step: &MacroStep<'_>) {}

    /// Receives the state after a step of a post-processor. It is not called for a refused step.
    #[inline]
    fn end_statement(&mut self, _end: &StatementEnd<'_>) {}
}

/// Something that has to wait under cutter compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Waiting<'a> {
    /// Settings that changed. They are in force for the blocks that follow, and not yet for what is performed.
    Settings(&'a Settings),
    /// An effect; a move as far as it is known, with its end as if no inner corner followed.
    Effect(&'a Effect),
}

/// The reply of a sink to an effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reply {
    /// It is done or queued.
    Done,
    /// Where the probe changed, in program coordinates and the active length unit; `None` where it did not. A probe
    /// without this reply has not changed. If the probe was in the target state before the move, the reply is
    /// [`Reply::Failed`] with [`FaultKind::Probe`].
    Contact(Option<Position>),
    /// The value that M66 read: a level of 0 or 1, a voltage, or -1 after a time-out.
    Input(f64),
    /// Which tool is in the spindle now; 0 for none.
    Tool(i32),
    /// The machine cannot do it: there is no program for a user-defined code, or it failed, or a spindle did not reach
    /// its angle. The block is refused with this kind.
    Failed(FaultKind),
    /// Stop here. The interpreter keeps its place and can be stepped on or aborted.
    Stop,
    /// The block is aborted here: this effect was not done, and nothing after it is. What the block did before stays.
    /// Only [`Interpreter::abort`](crate::Interpreter::abort) or [`begin`](crate::Interpreter::begin) may follow.
    Aborted,
    /// The block is aborted here, and what follows is only read: it changes modes and parameters, and nothing of the
    /// machine. The interpreter continues as if this effect were done, until
    /// [`Interpreter::end_read_ahead`](crate::Interpreter::end_read_ahead).
    ReadOnly,
}
