//! The production interpreter, for embedding in a controller: program text to settings and effects.
//!
//! ```text
//! Source ─► Interpreter ─► Sink        program text to settings and effects, a block at a time
//! Source ─► Task ─► Machine             the same within a controller: modes, pauses, requests, inputs, outputs, pins
//! CustomMacros ─► Sink                 programs with custom macros as on NCT controllers, a step at a time
//! PostProcessor ─► Sink                a post-processor's program and a toolpath to what it prints, a step at a time
//! Effect ─► Resolver ─► Segment         effects in machine coordinates, for `gaugeblock-planner` (feature `path`)
//! ```
//!
//! How a program flows through the interpreter:
//!
//! ```text
//! Source      bytes, as many as lie ready
//!   reader      lines, in place                                     control/reader
//!   fast path   a plain line is evaluated while it is read          control/fast_path
//!   compiler    a line becomes a block of operations, once          syntax/
//!   bytecode    blocks that can run again, stored together          syntax/bytecode, control/compile
//!   evaluator   operations become words and settings of parameters  control/evaluate, parameters/
//!   control     o-words, calls, M98, M99: which block comes next    control/
//!   modal       words become settings and effects, in order         modal/
//! Sink        settings, effects, and a look at each block when it is done
//!   task        the sink of a controller: what a machine may have, and when    task/
//! ```
//!
//! A plain line of the main program takes the fast path, from text to words in one pass. Every other block of it is
//! compiled, executed and forgotten. A loop is compiled when its head is executed, a sub when its definition is, the
//! numbered subprograms when M98 first looks for them. A line that cannot be compiled is kept as a block that is
//! refused when it is executed, because the documents refuse blocks and not programs.
//!
//! An embedder of the interpreter alone supplies a sink and does the rest itself. [`task`] is that rest, as far as
//! documents describe it: it runs an interpreter on a machine that has a clock, inputs, pins and an operator. An
//! interpreter without it pays nothing for it.
//!
//! A number such as `11.5.20` in a comment is the section of the manual of LinuxCNC 2.9.0~pre1, from the Debian package
//! `linuxcnc-doc-en`. Comments name the other documents: EMC2 2.5, LinuxCNC 2.8, the draft of M70 to M73. G codes are
//! kept in tenths (`281` is G28.1), since some have a digit after the point. M codes are kept as they are.
//!
//! **State of this crate:** the interpreter does text, expressions, parameters, o-words, numbered programs, modes,
//! straight moves, arcs, cutter compensation, canned cycles, lathe cycles, probes, splines and threads, the task every
//! request of an operator. What the documents leave open of compensated moves and of profiles of lathe cycles ends a
//! run as [`gaugeblock_vocabulary::End::Unsupported`], and what else they leave undefined as
//! [`gaugeblock_vocabulary::End::Unspecified`].
//!
//! **Invariants.**
//! * It is written from the documents, without reading the reference model, and shares only the vocabulary with it.
//! * It has no `std`: it reaches no clock, file, environment or thread. Time passes only where the embedder lets it.
//! * It never panics, on any program; the lints below refuse what could.
//! * A step of the interpreter is at most one block, or a part of a long canned cycle. It skips or compiles the text
//!   at most once. A caller can always stop.
//! * In steady state a block allocates nothing, except for the text of a message. Memory is bounded by [`Limits`],
//!   whatever the length of the program.
//! * Where a program is cut into pieces by its source changes nothing.
//! * A refused block changes nothing: modes, tools and parameters are those after the block before. A probe that
//!   finds nothing has moved, though: what its block did up to there stays.
//! * A fast path has the outcome of the path that it shortens, and leaves to it whatever is unusual or refused. Its
//!   documentation names that path.
//! * Names are looked up when a line is read, and never when a compiled block runs.
#![no_std]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable,
        clippy::indexing_slicing,
        clippy::string_slice,
        clippy::arithmetic_side_effects,
        clippy::integer_division,
        clippy::as_conversions
    )
)]

extern crate alloc;

mod block_end;
mod block_start;
mod canon;
mod control;
mod dialect;
mod error;
#[cfg(feature = "faults")]
pub mod faults;
#[cfg(not(feature = "faults"))]
#[expect(unreachable_pub, reason = "who embeds the interpreter cannot plant faults")]
mod faults;
pub mod gpp;
mod index_range;
mod interpret;
mod limits;
mod math;
mod modal;
pub mod nct;
mod parameters;
#[cfg(feature = "path")]
pub mod path;
mod probe_move;
mod quirks;
mod source;
mod syntax;
pub mod task;
#[cfg(test)]
mod tests;
mod words;

pub use block_end::{BlockEnd, BlockKind};
pub use block_start::BlockStart;
pub use canon::{Reply, Sink, Waiting};
pub use error::Error;
pub use interpret::{Interpreter, Progress, Scratch};
pub use limits::{Limit, Limits};
pub use parameters::ItemName;
pub use probe_move::ProbeMove;
pub use source::{Memory, Source, SourceError};
