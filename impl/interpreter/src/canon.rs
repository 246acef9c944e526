//! Where settings and effects go: the canonical commands, as a caller receives them.

use gaugeblock_vocabulary::{Effect, FaultKind, Position, Settings};

use crate::begun::BlockBegun;
use crate::done::BlockDone;
use crate::gpp::StatementDone;
use crate::nct::MacroStep;
use crate::probing::Probing;

/// What receives the commands of a program, in order.
///
/// A sink that only queues answers [`Reply::Done`] to most effects. Some effects wait for the outside (a queue
/// buster): a probe, an input, a tool change. To those the reply says what came of it.
pub trait Sink {
    /// Takes over settings that changed: only the fields that stand in `changed`.
    ///
    /// `line` is the line of the block, from 1, in its file.
    fn set(&mut self, line: u32, changed: &Settings);

    /// Performs an effect, or queues it, under the settings in force.
    fn perform(&mut self, line: u32, effect: &Effect) -> Reply;

    /// Performs a straight probe. Whoever knows a probe answers where it changed; this answers what [`Self::perform`]
    /// does.
    #[inline]
    fn probe(&mut self, line: u32, effect: &Effect, probing: &Probing) -> Reply {
        let _nothing = probing;
        self.perform(line, effect)
    }

    /// The words of a block are about to be checked and executed; for those who show what a program says, besides
    /// what it does.
    #[inline]
    fn block_begun(&mut self, begun: &BlockBegun<'_>) {
        let _nothing = begun;
    }

    /// A block is done; for those who record. A refused block is never done.
    #[inline]
    fn block_done(&mut self, done: &mut BlockDone<'_>) {
        let _nothing = done;
    }

    /// A step of a program with custom macros is done; for those who record. A refused one is never done.
    #[inline]
    fn macro_step(&mut self, done: &MacroStep<'_>) {
        let _nothing = done;
    }

    /// A step of a post-processor is done; for those who record. A refused one is never done.
    #[inline]
    fn statement_done(&mut self, done: &StatementDone<'_>) {
        let _nothing = done;
    }
}

/// What a sink answers to an effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reply {
    /// It is done or queued.
    Done,
    /// Where the probe changed, in program coordinates and the active length unit; `None` where it did not. A probe
    /// that is not answered has not changed. That it was in the target state before is a [`Reply::Failed`] of
    /// [`FaultKind::Probe`].
    Contact(Option<Position>),
    /// What M66 read: a level of 0 or 1, a voltage, or -1 after a time-out.
    Input(f64),
    /// Which tool is in the spindle now; 0 for none.
    Tool(i32),
    /// The outside says no: a user-defined code that is not there or failed, a spindle that did not reach its angle.
    /// The block is refused with this kind.
    Failed(FaultKind),
    /// Stop here; the interpreter stays where it is and can be stepped on or aborted.
    Stop,
    /// The block is broken off here: this effect was not done, and nothing after it is. What the block did before
    /// stays, as the interpreter stands then; only [`Interpreter::abort`](crate::Interpreter::abort) or
    /// [`begin`](crate::Interpreter::begin) lead on.
    Broken,
    /// The block is broken off here, and what follows is only read: it changes modes and parameters, and nothing of
    /// the machine. The interpreter goes on as if this effect were done, until
    /// [`Interpreter::stand`](crate::Interpreter::stand).
    Ahead,
}
